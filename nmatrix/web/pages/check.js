// Is my answer right? What it is, its numbers, the scene; and which mistake gives them.
import {answer, at, catalogue, element, examples, keep, sceneFields, verdict} from "./parts.js";

const EXAMPLES = [
  ["a normal matrix", {what: "normal", answer: "1 0 0\n0 2 0\n0 0 1", scale: "1 2 1"}],
  ["a world matrix", {what: "world", answer: "2 0 0 6\n0 1 0 0\n0 0 1 0\n0 0 0 1", scale: "2 1 1", translate: "3 0 0"}],
  ["a view matrix", {what: "view", answer: "1 0 0 0\n0 1 0 0\n0 0 1 5\n0 0 0 1", eye: "0 0 5"}],
  ["a vertex in NDC", {what: "trace", answer: "0 0 0.5", point: "0 0 0"}],
];
const what = at("check-what");
const numbers = at("check-answer");
const scene = sceneFields(at("check-scene"), "check");
let shown = null;

function subjects(names) {
  const chosen = what.value;
  what.replaceChildren(...names.map((name) => element("option", {value: name}, name)));
  if (names.includes(chosen)) what.value = chosen;
  scene.about(what.value);
}

function put(asked) {
  const wanted = asked.get?.("what") ?? asked.what ?? "normal";
  if (![...what.options].some((one) => one.value === wanted)) what.append(element("option", {value: wanted}, wanted));
  what.value = wanted;
  numbers.value = asked.get?.("answer") ?? asked.answer ?? "";
  scene.set(asked);
  scene.about(wanted);
}

async function run() {
  const text = numbers.value.trim();
  if (!text) {
    numbers.focus();
    return;
  }
  const values = {what: what.value, answer: text, ...scene.values()};
  keep("check", values);
  shown = new URLSearchParams(values).toString();
  const told = await answer(at("check-answered"), "shown", {words: ["check", what.value, ...scene.words(), "--", text]});
  if (told?.html) at("check-answered").firstChild.prepend(verdict(told.code === 0, told.code === 0 ? "Right" : "Not right"));
}

subjects([...new Set(EXAMPLES.map(([, {what: name}]) => name))]); // until the program tells all
catalogue(({subjects: all}) => subjects(all));
what.addEventListener("change", () => scene.about(what.value));
at("check-form").addEventListener("submit", (event) => {
  event.preventDefault();
  run();
});
numbers.addEventListener("keydown", (event) => {
  if (event.key === "Enter" && (event.ctrlKey || event.metaKey)) run();
});
examples(at("check-examples"), EXAMPLES, (asked) => {
  put(asked);
  run();
});

export function open(asked) {
  if ([...asked].length === 0 || asked.toString() === shown) return;
  put(asked);
  if (numbers.value) run();
}
