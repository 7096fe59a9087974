// The command line: any line typed, and the bytes that a pipe would get.
import {ask} from "./engine.js";
import {at, button, catalogue, element, examples, keep, save, trouble, waiting, copy} from "./parts.js";

const EXAMPLES = [
  ["world", "nmatrix world --scale 1 2 1"],
  ["view", "nmatrix view --eye 3 3 2.5"],
  ["steps", "nmatrix world --scale 1 2 1 --steps"],
  ["as LaTeX", "nmatrix projection --fov 60 -f latex"],
  ["a vertex", "nmatrix trace 1 2 0"],
  ["help", "nmatrix --help"],
];
const input = at("line-input");
const target = at("line-answer");
const files = {};
let shown = null;
let turn = 0;

async function run() {
  const line = input.value.trim();
  keep("line", {line});
  shown = line;
  const mine = turn += 1;
  waiting(target);
  try {
    const told = await ask("command", {words: line, files});
    if (mine === turn) tell(told);
  } catch (error) {
    if (mine === turn) target.replaceChildren(trouble(error.message));
  }
  if (mine === turn) target.removeAttribute("aria-busy");
}

function tell({code, out, err, files: written}) {
  const made = [];
  if (out) made.push(element("pre", {textContent: out, tabIndex: 0}));
  if (err) made.push(element("pre", {textContent: err, tabIndex: 0, className: code ? "wrong" : ""}));
  const after = element("p", {className: "tries"}, element("span", {className: "soft"}, `exit code ${code}`));
  if (out) after.append(button("Copy", (event) => copy(out, event.target)));
  for (const one of written ?? []) {
    const content = one.text ?? Uint8Array.from(atob(one.base64), (letter) => letter.charCodeAt(0));
    after.append(button(`Save ${one.name}`, () => save(one.name.split("/").pop(), content)));
  }
  target.replaceChildren(...made, after);
}

at("line-form").addEventListener("submit", (event) => {
  event.preventDefault();
  run();
});
at("line-files").addEventListener("change", async ({target: chosen}) => {
  for (const one of chosen.files) files[one.name] = await one.text();
  at("line-added").textContent = Object.keys(files).join(", ");
  chosen.value = "";
});
const use = (line) => {
  input.value = line;
  run();
};
examples(at("line-examples"), EXAMPLES, use);
catalogue(({commands}) => {
  const panels = grouped(commands);
  at("commands").replaceChildren(...[...panels].flatMap(([panel, list]) => [
    element("h3", {}, panel),
    element("dl", {}, ...list.flatMap(({name, sentence, why_not: absent}) => [
      element("dt", {}, button(name, () => {
        use(`nmatrix ${name} --help`);
        input.scrollIntoView({block: "center"});
      })),
      element("dd", {}, sentence, ...(absent ? [element("span", {className: "soft"}, " · in a terminal only")] : [])),
    ])),
  ]));
});

function grouped(commands) {
  const panels = new Map();
  for (const one of commands) panels.set(one.panel, [...(panels.get(one.panel) ?? []), one]);
  return panels;
}

export function open(asked) {
  const line = asked.get("line");
  if (line === null || line === shown) return;
  use(line);
}
