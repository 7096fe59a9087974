// The explorer as one module: the same text in the page that `nmatrix explore` writes and in a notebook.
const MARKUP = "MARKUP_TEXT";
const STYLE = "STYLE_TEXT";

ARITHMETIC_TEXT
// Put an explorer into an element. Its keeper holds what differs from the start: it reads and writes it, says when others
// change it, and names the element whose `data-theme` counts.
export function mount(element, data, keeper) {
const leaving = new AbortController(), { signal } = leaving, { house } = keeper, style = new CSSStyleSheet();
const root = element.shadowRoot || element.attachShadow({ mode: "open" }), byId = (id) => root.getElementById(id);
style.replaceSync(STYLE); root.adoptedStyleSheets = [style]; root.innerHTML = MARKUP;

PARTS_TEXT
}

// --- Keepers: the address of a page, the model of a notebook's widget ------------------------------------
const ADDRESS = {
  isPage: true, house: document.documentElement,
  read: () => Object.fromEntries(location.hash.slice(1).split("&").map((part) => part.split("="))),
  write(changes) {
    const words = Object.entries(changes).map((pair) => pair.join("=")).join("&");
    try { history.replaceState(null, "", `#${words}`); } catch { /* a frame without an address of its own keeps none */ }
  },
  listen: (follow, signal) => addEventListener("hashchange", follow, { signal }),
};
const keptBy = (model, house) => ({
  isPage: false, house,
  read: () => model.get("state") || {},
  write(changes) { model.set("state", changes); model.save_changes(); },
  listen(follow, signal) { model.on("change:state", follow); signal.addEventListener("abort", () => model.off?.("change:state", follow)); },
});
export default {
  render({ model, el }) {
    const place = el.appendChild(document.createElement("div")), explorer = mount(place, model.get("data"), keptBy(model, place));
    return () => { explorer.remove(); place.remove(); };
  },
};

const place = document.getElementById("nmatrix-explorer");
if (place) mount(place, JSON.parse(document.getElementById("nmatrix-explorer-data").textContent), ADDRESS);
