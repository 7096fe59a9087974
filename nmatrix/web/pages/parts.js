// What all pages are made of: elements, answers, examples, the address, and a memory that may be refused.
import {ask} from "./engine.js";

export const at = (id) => document.getElementById(id);

// Makes an element: properties by name, attributes by names with a hyphen or for ARIA, children last.
export function element(name, properties = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(properties)) {
    if (key in made && !key.includes("-")) made[key] = value;
    else made.setAttribute(key, value);
  }
  made.append(...children);
  return made;
}

export function button(text, act, properties = {}) {
  const made = element("button", {type: "button", className: "pill", ...properties}, text);
  made.addEventListener("click", act);
  return made;
}

export const say = (sentence) => {
  at("announced").textContent = "";
  requestAnimationFrame(() => { at("announced").textContent = sentence; });
};

// --- memory: a convenience that a browser may refuse ---

export function remembered(key) {
  try {
    return JSON.parse(localStorage.getItem(`nmatrix.${key}`));
  } catch {
    return null;
  }
}

export function remember(key, value) {
  try {
    localStorage.setItem(`nmatrix.${key}`, JSON.stringify(value));
  } catch { /* the page works without it */ }
}

// --- the address ---

const LONGEST_ADDRESS = 8000;

export function place() {
  const [page, asked = ""] = location.hash.slice(1).split(/\?(.*)/s);
  return {page, asked: new URLSearchParams(asked)};
}

export function address(page, values) {
  const told = Object.entries(values).filter(([, value]) => value !== "" && value != null && value !== false);
  return `#${page}${told.length ? `?${new URLSearchParams(told)}` : ""}`;
}

// Keeps what a page shows in its address; what is too long for one is left out.
export function keep(page, values) {
  const hash = address(page, values);
  const fits = hash.length <= LONGEST_ADDRESS;
  history.replaceState(null, "", fits ? hash : `#${page}`);
  return fits;
}

// --- copying, saving ---

export async function copy(text, pressed, done = "Copied") {
  let told = done;
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    const area = element("textarea", {value: text, className: "unseen"});
    document.body.append(area);
    area.select();
    if (!document.execCommand("copy")) told = "Not allowed";
    area.remove();
    pressed.focus();
  }
  const before = pressed.dataset.text ??= pressed.textContent;
  pressed.textContent = told;
  say(told);
  clearTimeout(Number(pressed.dataset.timer));
  pressed.dataset.timer = setTimeout(() => { pressed.textContent = before; }, 1600);
}

export function save(name, content, kind = "text/plain") {
  const url = URL.createObjectURL(new Blob([content], {type: kind}));
  const link = element("a", {href: url, download: name});
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}

export function commandLine(line) {
  const found = element("code", {textContent: line, translate: false});
  const made = element("p", {className: "command"}, found);
  made.append(button("Copy", (event) => copy(line, event.target), {"aria-label": `Copy the command ${line}`}));
  return made;
}

// --- answers ---

// Puts HTML of the program into an element; wide tables scroll in their own box.
export function fill(target, html) {
  target.innerHTML = html;
  for (const table of target.querySelectorAll("table")) {
    const box = element("div", {className: "scroll"});
    table.replaceWith(box);
    box.append(table);
  }
  for (const math of target.querySelectorAll("math[display=block]")) {
    const box = element("div", {className: "scroll formula"});
    math.replaceWith(box);
    box.append(math);
  }
  for (const code of target.closest(".card") ? [] : target.querySelectorAll("pre > code[class]")) {
    code.parentElement.after(element("p", {className: "tries"}, button("Copy", (event) => copy(code.textContent.trimEnd(), event.target), {"aria-label": "Copy what stands above"})));
  }
  for (const one of target.querySelectorAll("p")) { // what a step did, and that it was checked
    if (!one.textContent.endsWith(PROVED)) continue;
    one.className = "step";
    one.lastChild.textContent = one.lastChild.textContent.slice(0, -PROVED.length);
  }
  return target;
}

const PROVED = " (proved)";

// A sentence of the program without the word before it, on one line.
export const sentence = (text) => text.replace(/^error: /, "").replace(/\s*\n\s*/g, " ").trim();

export const trouble = (text) => element("p", {className: "note"}, sentence(text));

// The verdict of every picture of this program: another colour, and another shape.
export function verdict(right, text) {
  const badge = element("span", {className: "badge", "aria-hidden": "true"});
  badge.innerHTML = right
    ? '<svg viewBox="0 0 28 28"><circle cx="14" cy="14" r="13"/><path d="M8 14.5l4 4 8-9"/></svg>'
    : '<svg viewBox="0 0 28 28"><rect x="1" y="1" width="26" height="26" rx="3"/><path d="M9 9l10 10M19 9L9 19"/></svg>';
  return element("p", {className: `told ${right ? "right" : "wrong"}`}, badge, text);
}

export function waiting(target) {
  target.setAttribute("aria-busy", "true");
  target.replaceChildren(element("p", {className: "soft waits"}, "Working it out"));
}

// Asks, and shows what comes: formulas, what was refused, the same on a terminal.
export async function answer(target, name, asked) {
  const turn = (Number(target.dataset.turn) || 0) + 1;
  target.dataset.turn = turn;
  waiting(target);
  try {
    const told = await ask(name, asked);
    if (Number(target.dataset.turn) !== turn) return null; // another question came meanwhile
    target.replaceChildren(...shown(told));
    target.scrollIntoView({block: "nearest"});
    return told;
  } catch (error) {
    if (Number(target.dataset.turn) === turn) target.replaceChildren(trouble(error.message));
    return null;
  } finally {
    if (Number(target.dataset.turn) === turn) target.removeAttribute("aria-busy");
  }
}

function shown({html, text, err, command}) {
  const made = [];
  if (html) made.push(fill(element("div", {className: "report"}), html));
  if (err && !html) made.push(trouble(err));
  if (!html && text) made.push(element("pre", {textContent: text, tabIndex: 0}));
  if (html) made.push(element("details", {className: "same"}, element("summary", {}, "The same in a terminal"), commandLine(command), element("pre", {textContent: text + err, tabIndex: 0})));
  else made.push(element("p", {className: "soft small"}, "The same in a terminal:"), commandLine(command));
  return made;
}

// --- examples, and the fields of a scene ---

export function examples(target, list, act) {
  target.append(...list.map(([text, value]) => button(text, () => act(value))));
}

// What a scene may say; an empty field has its usual value, and `of` are the subjects that it belongs to.
const SCENE = [
  {key: "scale", label: "Scale", hint: "1 2 1"},
  {key: "rotate", label: "Rotate, degrees about x y z", hint: "0 30 0"},
  {key: "translate", label: "Translate", hint: "0 0 -3"},
  {key: "eye", label: "Eye", hint: "0 0 5"},
  {key: "target", label: "Looks at", hint: "0 0 0"},
  {key: "light-direction", label: "Direction of the light", hint: "-1 -1 -1"},
  {key: "space", label: "Shading space", hint: "world"},
  {key: "point", label: "Vertex", hint: "0 0 0", of: ["trace"]},
  {key: "from", label: "From axes", hint: "blender", of: ["axes"]},
  {key: "to", label: "To axes", hint: "unity", of: ["axes"]},
  {key: "more", label: "More options, as in a terminal", hint: "--order SRT --fov 60"},
];

export function sceneFields(target, prefix, {without = []} = {}) {
  const boxes = new Map();
  for (const {key, label, hint, of} of SCENE.filter((one) => !without.includes(one.key))) {
    const input = element("input", {id: `${prefix}-${key}`, placeholder: hint, autocomplete: "off", spellcheck: false, autocapitalize: "off", enterKeyHint: "go"});
    const box = element("div", {className: key === "more" ? "wide" : ""}, element("label", {htmlFor: input.id}, label), input);
    boxes.set(key, {box, input, of});
    target.append(box);
  }
  const seen = () => [...boxes].filter(([, one]) => !one.box.hidden && one.input.value.trim());
  return {
    about(subject) {
      for (const {box, of} of boxes.values()) box.hidden = Boolean(of && !of.includes(subject));
    },
    words: () => seen().flatMap(([key, {input}]) => {
      const parts = input.value.trim().split(/[\s,]+/);
      return key === "more" ? inWords(input.value) : [`--${key}`, ...parts];
    }),
    values: () => Object.fromEntries(seen().map(([key, {input}]) => [key, input.value.trim()])),
    set(asked) {
      for (const [key, {input}] of boxes) input.value = asked.get?.(key) ?? asked[key] ?? "";
    },
  };
}

// Parts a line at its blanks, but not within quotation marks.
function inWords(line) {
  return (line.match(/"[^"]*"|'[^']*'|[^\s"']+/g) ?? []).map((one) => one.replace(/^(["'])(.*)\1$/s, "$2"));
}

// The catalogue is asked for once, and a page goes on without it.
let known = null;
export function catalogue(act) {
  known ??= ask("catalogue");
  known.then(act, () => {});
}
