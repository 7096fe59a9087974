// The shading spaces, and the sheet of each.
import {answer, at, catalogue, element, keep, sceneFields} from "./parts.js";

const list = at("spaces-list");
const scene = sceneFields(at("spaces-scene"), "spaces", {without: ["space"]});
scene.about("space");
let wanted = "world";
let shown = null;

const chosen = () => list.querySelector("input:checked")?.value ?? wanted;

function run() {
  const space = chosen();
  const full = at("spaces-full").checked;
  const values = {space, ...scene.values(), full: full ? "1" : ""};
  keep("spaces", values);
  shown = new URLSearchParams(values).toString();
  answer(at("spaces-answer"), "sheet", {space, options: [...scene.words(), ...(full ? ["--full"] : [])]});
}

catalogue(({spaces}) => {
  list.querySelector("p").remove();
  list.append(...spaces.map(({name, used}) => element(
    "label", {className: "choice"},
    element("input", {type: "radio", name: "space", value: name, checked: name === wanted}),
    element("span", {}, element("b", {}, name), element("span", {className: "soft"}, used)),
  )));
});
list.addEventListener("change", () => chosen() !== "custom" && run());
at("spaces-form").addEventListener("submit", (event) => {
  event.preventDefault();
  run();
});

export function open(asked) {
  if ([...asked].length === 0 || asked.toString() === shown) return;
  wanted = asked.get("space") ?? "world";
  for (const one of list.querySelectorAll("input")) one.checked = one.value === wanted;
  scene.set(asked);
  at("spaces-full").checked = asked.has("full");
  run();
}
