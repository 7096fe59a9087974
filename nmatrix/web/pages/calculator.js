// The calculator as a notebook: statements, their answers, and the way to each.
import {ask, progress} from "./engine.js";
import {at, button, copy, element, examples, fill, keep, remember, remembered, save, say, sentence, trouble} from "./parts.js";

const EXAMPLES = [
  ["A⁻ᵀ of a stretch", "A = [1 0 0; 0 2 0; 0 0 1]\nA^-T"],
  ["invert, with steps", "steps on\ninverse([2 1; 1 3])"],
  ["turn, then move", "translate(3,0,0) * rotate_y(30)"],
  ["from object to clip", "P * V * M * point(1,2,0)"],
  ["exact roots", "normalize([1, 1, 0])"],
  ["help", "help"],
];
const SIGNS = ["=", "*", "^-1", "^-T", "^T", "[", ";", "]", "(", ")"];
const SHOWN = 2000; // characters of a statement that waits
const NUMBERS = ["exact", "decimal", "both"];

const input = at("calc-input");
const transcript = at("transcript");
const said = []; // what was typed, for the arrow keys
let recalled = 0;
let draft = "";
let session = "";
let shown = null; // the statements that the address tells and the transcript has

// A worker counts its statements anew, so that what another one answered is asked of nobody.
let life = 0;
progress((told) => { if (told.failed || (told.stage === "loading" && told.total === 0)) life += 1; });

function again(told, how) {
  if (told.life !== life) throw new Error("Python began anew since: press Edit, then run it again");
  return ask("again", {number: told.number, ...how});
}

// --- the transcript ---

function entry(statement) {
  const made = element("li", {});
  const short = statement.length > SHOWN ? `${statement.slice(0, SHOWN)} …` : statement;
  made.append(element("pre", {className: "said", textContent: short}));
  return made;
}

function settle(made, told) {
  told.life = life;
  made.dataset.text = `${told.echo}${told.text}`;
  made.removeAttribute("aria-busy");
  made.classList.toggle("failed", told.failed);
  made.replaceChildren();
  if (told.failed) {
    const [before, after] = told.text.split(/^error: /m);
    const marked = before.trim() ? `${told.echo}${before}` : told.echo;
    made.append(element("pre", {className: "said", textContent: marked.trimEnd()}), trouble(after ?? told.text));
    made.append(element("p", {className: "tries"}, button("Edit", () => put(told.statement))));
    return;
  }
  made.append(element("pre", {className: "said", textContent: told.echo.trimEnd()}));
  const body = element("div", {className: "report"});
  write(body, told);
  made.append(body);
  const hands = element("p", {className: "tries"});
  if (told.is_value) hands.append(stepping(told, body), taking(told, "LaTeX", "latex"));
  if (told.text) hands.append(button("Text", (event) => copy(told.text, event.target), {"aria-label": "Copy as text"}));
  hands.append(button("Edit", () => put(told.statement)));
  made.append(hands);
}

function write(body, {html, text}) {
  if (html) fill(body, html);
  else if (text) body.replaceChildren(element("pre", {textContent: text, tabIndex: 0}));
}

function stepping(told, body) {
  return button("Steps", async ({target}) => {
    const open = target.getAttribute("aria-expanded") !== "true";
    try {
      if (open) write(body, await again(told, {steps: true}));
      else write(body, told);
      target.setAttribute("aria-expanded", String(open));
    } catch (error) {
      body.append(trouble(error.message));
    }
  }, {"aria-expanded": "false"});
}

function taking(told, name, format) {
  return button(name, async ({target}) => {
    try {
      copy((await again(told, {format})).text, target);
    } catch (error) {
      target.closest("li").append(trouble(error.message));
    }
  }, {"aria-label": `Copy as ${name}`});
}

// --- what is said ---

async function run(text, {whole = false} = {}) {
  at("calc-empty").hidden = true;
  const pending = entry(text);
  pending.setAttribute("aria-busy", "true");
  transcript.append(pending);
  pending.scrollIntoView({block: "nearest"});
  said.push(text);
  recalled = said.length;
  let told;
  try {
    told = await ask("say", {text, whole});
  } catch (error) {
    pending.removeAttribute("aria-busy");
    pending.classList.add("failed");
    pending.append(trouble(error.message));
    return;
  }
  const made = told.turns.map((one) => {
    const next = element("li", {});
    settle(next, one);
    return next;
  });
  pending.replaceWith(...made);
  if (told.more) {
    put(`${told.more}\n`);
    say("The statement goes on: close it, then press Enter");
  }
  for (const one of told.files) save(one.name.endsWith(".calc") ? one.name : `${one.name}.calc`, one.text);
  if (told.closed) at("calc-hint").textContent = "The session ended with quit; the next line begins where it was.";
  state(told);
  made.at(-1)?.scrollIntoView({block: "nearest"});
}

function state(told) {
  session = told.session;
  shown = session;
  if (!at("page-calc").hidden) keep("calc", {s: session.trimEnd()});
  remember("session", session);
  at("names").replaceChildren(...told.names.map(({name, value}) => element(
    "li", {}, button(name, () => insert(name), {"aria-label": `Insert ${name}, ${value}`}), element("span", {className: "soft"}, value))));
  at("steps-on").checked = told.settings.steps;
  for (const one of at("numbers").children) one.setAttribute("aria-pressed", String(one.textContent === told.settings.numbers));
}

// An order of the session that changes how it answers, not what.
async function order(line) {
  try {
    state(await ask("say", {text: line}));
  } catch (error) {
    transcript.append(element("li", {className: "failed"}, trouble(error.message)));
  }
}

// --- the input ---

function grow() {
  input.rows = Math.min(12, input.value.split("\n").length);
}

function put(text) {
  input.value = text;
  grow();
  input.focus();
  input.setSelectionRange(text.length, text.length);
  offer();
}

function insert(text, from = input.selectionStart) {
  input.setRangeText(text, from, input.selectionEnd, "end");
  grow();
  input.focus();
  offer();
}

let offered = 0;
async function offer() {
  const cursor = input.selectionStart;
  const word = input.value.slice(0, cursor).match(/[A-Za-z_][\w]*$/)?.[0] ?? "";
  const mine = offered += 1;
  let words = [];
  if (word.length > 1) {
    try {
      const told = await ask("complete", {text: input.value, cursor});
      words = told.words.slice(0, 8).map((one) => [one, () => insert(one, cursor - told.begun.length)]);
    } catch { /* nothing is offered */ }
  }
  if (mine !== offered) return;
  if (words.length === 0) words = SIGNS.map((one) => [one, () => insert(one)]);
  at("offers").replaceChildren(...words.map(([text, act]) => button(text, act, {className: "pill sign"})));
}

function recall(step) {
  const next = recalled + step;
  if (next < 0 || next > said.length) return;
  if (recalled === said.length) draft = input.value;
  recalled = next;
  const text = next === said.length ? draft : said[next];
  input.value = text;
  grow();
  input.setSelectionRange(text.length, text.length);
}

input.addEventListener("input", () => {
  grow();
  offer();
});
input.addEventListener("keydown", (event) => {
  if (event.isComposing) return;
  const {selectionStart: from, value} = input;
  if (event.key === "Enter" && !event.shiftKey) {
    event.preventDefault();
    at("calc-form").requestSubmit();
  } else if (event.key === "ArrowUp" && !value.slice(0, from).includes("\n")) {
    event.preventDefault();
    recall(-1);
  } else if (event.key === "ArrowDown" && !value.slice(from).includes("\n")) {
    event.preventDefault();
    recall(1);
  }
});
at("calc-form").addEventListener("submit", (event) => {
  event.preventDefault();
  const text = input.value.trim();
  if (!text) return;
  input.value = "";
  grow();
  offer();
  run(text);
});

// --- the tools ---

at("numbers").append(...NUMBERS.map((one) => button(one, () => order(`numbers ${one}`), {className: "", "aria-pressed": String(one === NUMBERS[0])})));
at("steps-on").addEventListener("change", ({target}) => order(`steps ${target.checked ? "on" : "off"}`));
at("calc-undo").addEventListener("click", () => run("undo"));
at("calc-clear").addEventListener("click", async () => {
  transcript.replaceChildren();
  at("calc-empty").hidden = false;
  try {
    state(await ask("resume"));
  } catch (error) {
    transcript.append(element("li", {className: "failed"}, trouble(error.message)));
  }
  input.focus();
});
at("calc-copy").addEventListener("click", ({target}) => copy([...transcript.querySelectorAll("li")].map((one) => one.dataset.text ?? one.innerText).join("\n"), target));
at("calc-link").addEventListener("click", ({target}) => {
  if (keep("calc", {s: session.trimEnd()})) copy(location.href, target);
  else copy("", target, "Too long: save it");
});
at("calc-save").addEventListener("click", () => save("session.calc", session));
at("calc-open").addEventListener("change", async ({target}) => {
  const [file] = target.files;
  if (file) run((await file.text()).trimEnd(), {whole: true});
  target.value = "";
});
examples(at("calc-examples"), EXAMPLES, (text) => run(text, {whole: true}));
offer();

export function open(asked) {
  const statements = asked.get("s");
  if (statements !== null && statements.trim() !== (shown ?? "").trim()) {
    run(statements, {whole: true});
    return;
  }
  const before = remembered("session");
  if (shown === null && typeof before === "string" && before.trim()) {
    const count = before.trim().split("\n").length;
    const again = button(`your last session, ${count} ${count === 1 ? "line" : "lines"}`, () => run(before.trim(), {whole: true}));
    at("calc-examples").prepend(again);
    shown = "";
  } else if (shown) keep("calc", {s: shown.trimEnd()});
}
