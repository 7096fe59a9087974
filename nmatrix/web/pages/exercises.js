// A sheet of exercises: fields for an answer, a verdict at once, and what is done so far in the address.
import {ask} from "./engine.js";
import {address, at, button, catalogue, commandLine, copy, element, fill, keep, place, remember, remembered, trouble, verdict} from "./parts.js";

const MARKS = {".": "not tried", w: "not right yet", r: "right"};
let sheet = null; // {seed, student, course}
let count = 10; // one of each kind, as the catalogue tells
let number = 1;
let all = false;
let done = []; // a mark for each exercise
let typed = {}; // the answers so far, by exercise

const key = () => `sheet.${sheet.seed}.${sheet.student}`;

// --- which sheet ---

function begin(asked, {focus = false} = {}) {
  sheet = {seed: asked.get("seed") || "1", student: asked.get("student") ?? "", course: asked.get("course") ?? ""};
  const before = remembered(key()) ?? {};
  typed = before.typed ?? {};
  done = marks(asked.get("done") ?? before.done ?? "");
  number = Math.min(count, Math.max(1, Number(asked.get("n")) || 1));
  at("sheet-form").hidden = true;
  at("sheet").hidden = false;
  at("teach").hidden = true;
  at("whose").replaceChildren([`Sheet ${sheet.seed}`, sheet.student].filter(Boolean).join(" · "));
  at("exercises-lead").hidden = true;
  at("exercises-title").textContent = sheet.course || "Exercises";
  show({focus});
}

const marks = (text) => Array.from({length: count}, (_, i) => (text[i] in MARKS ? text[i] : "."));

function setUp(asked) {
  sheet = null;
  at("sheet-form").hidden = false;
  at("sheet").hidden = true;
  at("teach").hidden = false;
  at("cards").replaceChildren();
  at("sheet-seed").value = asked.get("seed") || "1";
  at("sheet-student").value = asked.get("student") ?? remembered("student") ?? "";
  at("sheet-form").dataset.course = asked.get("course") ?? "";
  at("exercises-title").textContent = asked.get("course") || "Exercises";
  at("exercises-lead").hidden = false;
  if (asked.has("teach")) at("teach").open = true;
  linked();
}

function kept() {
  const {seed, student, course} = sheet;
  const told = done.join("");
  keep("exercises", {seed, student, course, n: all ? "" : number, all: all ? "1" : "", done: /[rw]/.test(told) ? told : "", go: student ? "" : "1"});
  remember(key(), {typed, done: told});
}

// --- what is shown ---

function show({focus = false} = {}) {
  kept();
  at("one-each").setAttribute("aria-pressed", String(!all));
  at("all-ten").setAttribute("aria-pressed", String(all));
  dots();
  const numbers = all ? done.map((_, i) => i + 1) : [number];
  at("cards").replaceChildren(...numbers.map(card));
  if (focus) at("cards").querySelector("h2").focus();
}

function dots() {
  at("dots").replaceChildren(...done.map((mark, i) => {
    const made = button(String(i + 1), () => go(i + 1), {className: `dot ${MARKS[mark].replaceAll(" ", "-")}`, "aria-label": `Exercise ${i + 1}, ${MARKS[mark]}`});
    if (!all && i + 1 === number) made.setAttribute("aria-current", "step");
    return element("li", {}, made);
  }));
  const right = done.filter((one) => one === "r").length;
  at("score").textContent = right === count ? `All ${count} right. Well done.` : `${right} of ${count} right`;
}

function go(to) {
  number = to;
  if (all) {
    kept();
    const heading = at(`exercise-${to}`);
    heading.scrollIntoView();
    heading.focus({preventScroll: true});
  } else show({focus: true});
}

function mark(which, right) {
  if (right) done[which - 1] = "r";
  else if (done[which - 1] !== "r") done[which - 1] = "w";
  kept();
  dots();
}

// --- one exercise ---

function card(which) {
  const made = element("article", {className: "card", "aria-labelledby": `exercise-${which}`});
  const title = element("h2", {id: `exercise-${which}`, tabIndex: -1}, `${which}.`);
  const body = element("div", {className: "report", "aria-busy": "true"}, element("p", {className: "soft waits"}, "The exercise is being written"));
  made.append(title, body);
  const whose = {seed: sheet.seed, student: sheet.student};
  ask("exercise", {number: which, ...whose}).then((told) => {
    title.textContent = told.title;
    body.removeAttribute("aria-busy");
    fill(body, told.html);
    made.append(form(told, whose));
  }, (error) => {
    body.removeAttribute("aria-busy");
    body.replaceChildren(trouble(error.message), button("Try again", () => made.replaceWith(card(which))));
  });
  return made;
}

function form(told, whose) {
  const made = element("form", {noValidate: true});
  const judgement = element("div", {className: "judgement", "aria-live": "polite"});
  const answer = told.fields ? cells(told, made) : choices(told, made);
  const hands = element("div", {className: "tries"}, element("button", {className: "main"}, "Check"));
  if (told.fields && told.fields.columns > 1) hands.append(button("0 into empty cells", answer.zeros));
  made.append(answer.body, hands, judgement);
  made.addEventListener("submit", async (event) => {
    event.preventDefault();
    const given = answer.read();
    if (given === null) return;
    typed[told.number] = given;
    made.setAttribute("aria-busy", "true");
    try {
      const found = await ask("grade", {number: told.number, answer: given, ...whose});
      const right = found.verdict === "correct";
      answer.marked(found.wrong ?? [], right);
      judgement.replaceChildren(...judged(found, right, told, whose));
      mark(told.number, right);
    } catch (error) {
      judgement.replaceChildren(trouble(error.message));
    }
    made.removeAttribute("aria-busy");
  });
  if (done[told.number - 1] !== ".") judgement.append(solution(told, whose));
  return made;
}

function judged(found, right, told, whose) {
  const made = [verdict(right, right ? "Right" : found.mistake ? "Not right: a known slip" : "Not right")];
  if (found.explanation) made.push(element("p", {}, found.explanation));
  if (found.rule && !found.explanation.includes(found.rule)) made.push(element("p", {className: "rule"}, found.rule));
  if (!right && found.next) {
    const [, line] = found.next.match(/^try (nmatrix .+)$/) ?? [];
    made.push(line ? element("p", {className: "soft"}, "In a terminal, ", element("code", {}, line), " shows why.") : element("p", {className: "soft"}, capital(found.next)));
  }
  const hands = element("div", {className: "tries"});
  const next = following(told.number);
  if (right && next && !all) hands.append(button(`Go on to ${next}`, () => go(next), {className: "main"}));
  hands.append(solution(told, whose));
  made.push(hands, element("details", {className: "same"}, element("summary", {}, "The same in a terminal"), commandLine(found.command)));
  return made;
}

const capital = (text) => `${text.slice(0, 1).toUpperCase()}${text.slice(1)}.`;

// The next one that is not right yet, or none.
function following(from) {
  const order = done.map((_, i) => ((from + i) % count) + 1);
  return order.find((one) => done[one - 1] !== "r") ?? null;
}

function solution(told, whose) {
  const pressed = button("Show me", async () => {
    try {
      const {html} = await ask("key", {number: told.number, ...whose});
      const shown = fill(element("div", {className: "report key", tabIndex: -1, "aria-label": "Solution", role: "group"}), html);
      const after = pressed.closest(".tries") ?? pressed;
      after.after(shown);
      pressed.remove();
      shown.focus();
    } catch (error) {
      pressed.after(trouble(error.message));
    }
  });
  return pressed;
}

// --- answers ---

function cells(told, owner) {
  const {rows, columns} = told.fields;
  const before = typed[told.number];
  const inputs = Array.from({length: rows}, (_, i) => Array.from({length: columns}, (__, j) => element("input", {
    "aria-label": columns > 1 ? `row ${i + 1}, column ${j + 1}` : rows > 1 ? `${"xyzw"[i]}` : "number",
    autocomplete: "off", autocapitalize: "off", spellcheck: false, enterKeyHint: "go", size: 4,
    value: before?.[i]?.[j] ?? "",
  })));
  const grid = element("div", {className: "grid", role: "group", "aria-label": "Your answer"});
  grid.style.setProperty("--columns", columns);
  grid.append(...inputs.flat());
  grid.addEventListener("keydown", (event) => {
    const [i, j] = where(event.target);
    const step = {ArrowUp: -1, ArrowDown: 1}[event.key];
    if (step && inputs[i + step]) {
      event.preventDefault();
      inputs[i + step][j].select();
    } else if (event.key === " ") { // a blank parts numbers, so it goes on to the next cell
      event.preventDefault();
      inputs.flat()[i * columns + j + 1]?.select();
    }
  });
  grid.addEventListener("input", ({target}) => {
    target.removeAttribute("aria-invalid");
    typed[told.number] = read();
    remember(key(), {typed, done: done.join("")});
  });
  grid.addEventListener("paste", (event) => { // a whole answer fills all cells
    const numbers = event.clipboardData.getData("text").replace(/[[\]{}();,|]/g, " ").trim().split(/\s+/);
    if (numbers.length !== rows * columns) return;
    event.preventDefault();
    inputs.flat().forEach((one, i) => { one.value = numbers[i]; });
    typed[told.number] = read();
  });
  const where = (input) => {
    const i = inputs.findIndex((row) => row.includes(input));
    return [i, inputs[i]?.indexOf(input)];
  };
  const read = () => inputs.map((row) => row.map((one) => one.value.trim()));
  const body = element("div", {}, element("p", {className: "hint"}, `${told.form} Fractions and roots count: 1/3, √3/2 or sqrt(3)/2.`), grid);
  return {
    body,
    zeros() {
      for (const one of inputs.flat()) one.value ||= "0";
      owner.querySelector("button.main").focus();
    },
    read() {
      const empty = inputs.flat().find((one) => !one.value.trim());
      if (!empty) return read();
      empty.focus();
      empty.setAttribute("aria-invalid", "true");
      const note = owner.querySelector(".judgement");
      note.replaceChildren(trouble("A cell is empty: write a number there"));
      return null;
    },
    marked(wrong, right) {
      for (const one of inputs.flat()) one.removeAttribute("aria-invalid");
      for (const [i, j] of right ? [] : wrong) inputs[i]?.[j]?.setAttribute("aria-invalid", "true");
      grid.classList.toggle("right", right);
    },
  };
}

function choices(told, owner) {
  const before = typed[told.number];
  const radios = told.choices.map(({letter, html}) => {
    const radio = element("input", {type: "radio", name: `choice-${told.number}`, value: letter, checked: before === letter});
    const text = element("span", {});
    text.innerHTML = html;
    return {radio, label: element("label", {className: "choice"}, radio, element("b", {}, letter), text)};
  });
  const body = element("fieldset", {}, element("legend", {className: "hint"}, told.form), ...radios.map((one) => one.label));
  owner.addEventListener("keydown", (event) => { // a letter chooses, Enter checks
    const found = radios.find(({radio}) => radio.value === event.key.toLowerCase());
    if (!found || event.ctrlKey || event.metaKey || event.altKey) return;
    found.radio.checked = true;
    found.radio.focus();
  });
  body.addEventListener("keydown", (event) => {
    if (event.key === "Enter") {
      event.preventDefault();
      owner.requestSubmit();
    }
  });
  return {
    body,
    read() {
      const chosen = radios.find(({radio}) => radio.checked);
      if (chosen) return chosen.radio.value;
      radios[0].radio.focus();
      owner.querySelector(".judgement").replaceChildren(trouble("Nothing is chosen: choose one"));
      return null;
    },
    marked(_, right) {
      for (const {radio, label} of radios) label.dataset.mark = radio.checked ? (right ? "right" : "wrong") : "";
    },
  };
}

// --- the buttons around ---

catalogue(({kinds}) => {
  if (kinds.length === count) return;
  count = kinds.length;
  if (sheet) begin(place().asked);
});
at("sheet-form").addEventListener("submit", (event) => {
  event.preventDefault();
  const student = at("sheet-student").value.trim();
  remember("student", student);
  all = false;
  begin(new URLSearchParams({seed: at("sheet-seed").value.trim() || "1", student, course: at("sheet-form").dataset.course}), {focus: true});
});
at("other-sheet").addEventListener("click", () => {
  const {seed, student, course} = sheet;
  setUp(new URLSearchParams({seed, student, course}));
  keep("exercises", {seed, course});
  at("sheet-student").focus();
});
at("one-each").addEventListener("click", () => {
  all = false;
  show();
});
at("all-ten").addEventListener("click", () => {
  all = true;
  show();
});
at("sheet-link").addEventListener("click", ({target}) => copy(location.href, target));

const classLink = () => new URL(address("exercises", {seed: at("teach-seed").value.trim() || "1", course: at("teach-course").value.trim()}), location.href).href;
function linked() {
  const seed = at("teach-seed").value.trim() || "1";
  const word = /^[\w.]+$/.test(seed) ? seed : `'${seed.replaceAll("'", "'\\''")}'`;
  at("teach-link").textContent = classLink();
  at("teach-command").replaceChildren(commandLine(`nmatrix handout --roster class.csv --seed ${word} --salt secret.txt --key -o sheets`));
}
at("teach-form").addEventListener("input", linked);
at("teach-form").addEventListener("submit", (event) => {
  event.preventDefault();
  copy(classLink(), at("teach-form").querySelector("button"));
});

export function open(asked) {
  if (asked.get("student") || asked.has("go")) {
    const {seed, student, course} = sheet ?? {};
    all = asked.has("all");
    if (sheet && seed === (asked.get("seed") || "1") && student === (asked.get("student") ?? "") && course === (asked.get("course") ?? "")) {
      number = Number(asked.get("n")) || number;
      show();
    } else begin(asked);
  } else if (sheet && [...asked].length === 0) kept();
  else setUp(asked);
}
