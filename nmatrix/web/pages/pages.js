// The frame of the pages: which one is shown, the theme, and what is told while Python loads.
import {progress, restart, start, stop} from "./engine.js";
import {at, catalogue, element, place, remember, remembered, say} from "./parts.js";
import * as calculator from "./calculator.js";
import * as check from "./check.js";
import * as exercises from "./exercises.js";
import * as identify from "./identify.js";
import * as line from "./line.js";
import * as lint from "./lint.js";
import * as spaces from "./spaces.js";

const PAGES = {start: {}, calc: calculator, identify, check, exercises, spaces, explorer: {open: explore}, lint, line};
let current = null;
let begun = false;

function route() {
  const {page: asked, asked: values} = place();
  const page = asked in PAGES ? asked : "start";
  const section = at(`page-${page}`);
  for (const one of Object.keys(PAGES)) at(`page-${one}`).hidden = one !== page;
  document.body.dataset.page = page;
  const title = section.querySelector("h1");
  document.title = page === "start" ? "nmatrix" : `${title.textContent} · nmatrix`;
  for (const link of document.querySelectorAll("nav a")) {
    if (link.hash === `#${page}`) {
      link.setAttribute("aria-current", "page");
      const row = link.parentElement; // on a phone it scrolls, by itself and not with the page
      row.scrollLeft = link.offsetLeft - row.offsetLeft - (row.clientWidth - link.offsetWidth) / 2;
    } else link.removeAttribute("aria-current");
  }
  if (page !== current && begun) {
    scrollTo(0, 0);
    title.focus({preventScroll: true});
  }
  current = page;
  begun = true;
  PAGES[page].open?.(values);
}

function explore() {
  const frame = at("explorer-frame");
  if (!frame.getAttribute("src")) frame.src = "explorer.html";
}

// --- Python ---

const MEANWHILE = "You can read and type meanwhile: what you ask is answered when it is here.";
let stage = "";

function told(state) {
  const bar = at("loaded");
  const act = at("engine-button");
  at("engine").hidden = Boolean(state.ready) || state.stage === "idle";
  at("engine").classList.toggle("failed", Boolean(state.failed));
  bar.hidden = Boolean(state.failed || state.slow);
  act.hidden = !(state.failed || state.slow);
  if (state.failed) {
    at("engine-sentence").replaceChildren(`${state.failed.replace(/\.$/, "")}. `, element("a", {href: "#explorer"}, "The explorer"), " works without it.");
    act.textContent = "Try again";
    act.onclick = restart;
  } else if (state.slow) {
    at("engine-sentence").textContent = state.sentence;
    act.textContent = "Stop";
    act.onclick = stop;
  } else if (!state.ready) {
    at("engine-sentence").textContent = [state.sentence, MEANWHILE].filter(Boolean).join(". ");
    if (state.total) {
      bar.max = state.total;
      bar.value = state.done;
    } else bar.removeAttribute("value");
  }
  // A screen reader hears each stage once, not each byte.
  const now = state.failed || (state.ready && "Python is loaded") || (state.slow && state.sentence) || (state.stage === "loading" && "Python is loading") || "";
  if (now && now !== stage) say(now);
  stage = now || stage;
}

// --- theme ---

const dark = matchMedia("(prefers-color-scheme: dark)");

function painted(theme) {
  if (theme) document.documentElement.dataset.theme = theme;
  const now = document.documentElement.dataset.theme ?? (dark.matches ? "dark" : "light");
  at("theme").setAttribute("aria-pressed", String(now === "dark"));
  return now;
}

at("theme").addEventListener("click", () => {
  const chosen = painted() === "dark" ? "light" : "dark";
  painted(chosen);
  remember("theme", chosen);
});
dark.addEventListener("change", () => painted());
painted(["light", "dark"].find((one) => one === remembered("theme")));

at("skip").addEventListener("click", (event) => {
  event.preventDefault();
  at(`page-${current}`).querySelector("h1").focus();
});
for (const one of document.querySelectorAll("[data-print]")) one.addEventListener("click", () => print());

progress(told);
addEventListener("hashchange", route);
route();
// Who counts bytes is not made to load many: then Python comes with the first question.
if (!navigator.connection?.saveData) {
  start();
  catalogue(({version}) => { at("cite").querySelector("i").after(`, version ${version}`); });
}
