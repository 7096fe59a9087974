// Sliders, buttons and choices, made once and filled from the state.
const rows = (letter, names, label, range) => names.map((name) => ({ keys: [letter + name], label: label(name), range }));
const GROUPS = {
  scale: { title: "Stretch", rows: rows("s", AXES, (axis) => `stretch along ${axis}`, [0, 4, 0.05]) },
  even: { title: "Even scale", rows: [{ keys: ["sx", "sy", "sz"], label: "scale in every direction", range: [0.25, 4, 0.05] }] },
  mirror: { title: "Mirror", switches: AXES.map((axis) => [`m${axis}`, `mirror along ${axis}`]) },
  turn: { title: "Turn", rows: rows("r", AXES, (axis) => `turn about ${axis}, in degrees`, [-180, 180, 1]) },
  shear: { title: "Shear", rows: rows("h", ["xy", "xz", "yz"], ([moved, by]) => `shear ${moved} along ${by}`, [-2, 2, 0.05]) },
  move: { title: "Move", rows: rows("t", AXES, (axis) => `move along ${axis}`, [-3, 3, 0.05]) },
  ...(data.has_direction ? { light: { title: "Light", rows: rows("l", AXES, (axis) => `light travels along ${axis}`, [-3, 3, 0.05]) } } : {}),
  ...(data.has_position ? { lamp: { title: "Lamp", rows: rows("p", AXES, (axis) => `place of the lamp along ${axis}`, [-9, 9, 0.1]) } } : {}),
  camera: {
    title: "Camera",
    rows: [
      { keys: ["yaw"], label: "walk round, in degrees", range: [-180, 180, 1] },
      { keys: ["tilt"], label: "rise, in degrees", range: [-90, 90, 1] },
    ],
  },
};
const shown = new Set();
function buildGroups() {
  for (const [name, group] of Object.entries(GROUPS)) {
    const field = document.createElement("fieldset");
    field.id = `group-${name}`; field.innerHTML = `<legend>${group.title}</legend>`;
    for (const { keys, label, range } of group.rows || []) {
      const id = keys.length > 1 ? "even" : keys[0], row = document.createElement("div");
      row.className = "row";
      row.innerHTML = `<label for="${id}">${label}</label>
        <input type="range" id="${id}" min="${range[0]}" max="${range[1]}" step="${range[2]}">
        <input type="number" id="${id}-n" step="any" aria-label="${label}, as a number">`;
      for (const input of row.querySelectorAll("input")) {
        input.dataset.keys = keys.join(" ");
        input.addEventListener("input", () => {
          const value = Number(input.value);
          if (input.value !== "" && isNumber(value)) { for (const key of keys) state[key] = value; changed(input); }
        });
      }
      field.append(row);
    }
    for (const [key, label] of group.switches || []) {
      const button = document.createElement("button");
      button.type = "button"; button.id = key; button.className = "pill"; button.textContent = label;
      button.addEventListener("click", () => { state[key] = Number(!state[key]); changed(null); });
      field.append(button);
    }
    byId("sliders").append(field);
    const more = document.createElement("button");
    more.type = "button"; more.className = "pill"; more.id = `more-${name}`; more.textContent = group.title; more.setAttribute("aria-controls", field.id);
    more.setAttribute("aria-label", `${group.title}: show its sliders`);
    more.addEventListener("click", () => { if (shown.has(name)) shown.delete(name); else shown.add(name); fill(null); });
    byId("more").append(more);
  }
}
function buildChoices() {
  const buttons = (place, key, words, label) => {
    for (const [value, text] of Object.entries(words)) {
      const button = document.createElement("button");
      button.type = "button"; button.textContent = text; button.dataset[key] = value;
      if (label) button.setAttribute("aria-label", label(text));
      button.addEventListener("click", () => choose(key, value));
      byId(place).append(button);
    }
  };
  buttons("stories", "story", Object.fromEntries(Object.entries(STORIES).map(([key, one]) => [key, one.name])));
  buttons("mode", "mode", { arrows: "arrows", heat: "heat", plain: "plain" }, (text) => `show ${text}`);
  buttons("layout", "layout", { pair: "two views", divider: "one view, divided" });
  for (const [key, words] of [["shape", BODY_NAMES], ["rule", MISTAKES]]) {
    byId(key).innerHTML = Object.entries(words).map(([value, text]) => `<option value="${value}">${text}</option>`).join("");
    byId(key).addEventListener("change", (event) => { state[key] = event.target.value; changed(null); });
  }
  for (const space of CHOICES.space) {
    const button = document.createElement("button");
    button.type = "button"; button.className = "place"; button.dataset.space = space;
    button.setAttribute("aria-label", `shade in ${space} space: ${PLACES[space]}`);
    button.innerHTML = `<strong>${space}</strong><canvas width="10" height="10"></canvas><span>${PLACES[space]}</span>`;
    button.addEventListener("click", () => choose("space", space));
    byId("stages").append(button);
  }
}
function choose(key, value) {
  if (key === "story") {
    const kept = Object.fromEntries(Object.keys(PLAIN).map((one) => [one, storyStart(value)[one]]));
    state = { ...state, ...kept, story: value }; shown.clear();
  } else state[key] = value;
  changed(null);
}
function fill(except) {
  for (const input of root.querySelectorAll("input[data-keys]")) if (input !== except) input.value = state[input.dataset.keys.split(" ")[0]];
  for (const [key] of GROUPS.mirror.switches) byId(key).setAttribute("aria-pressed", String(Boolean(state[key])));
  for (const key of ["shape", "rule"]) byId(key).value = state[key];
  for (const key of ["story", "mode", "layout", "space"]) {
    for (const button of root.querySelectorAll(`button[data-${key}]`)) button.setAttribute("aria-pressed", String(button.dataset[key] === state[key]));
  }
  for (const name of Object.keys(GROUPS)) {
    const isOwn = STORIES[state.story].group === name;
    byId(`group-${name}`).hidden = !isOwn && !shown.has(name);
    byId(`more-${name}`).hidden = isOwn; byId(`more-${name}`).setAttribute("aria-expanded", String(shown.has(name)));
  }
  if (byId("vertex") !== except) byId("vertex").value = state.v;
  byId("divider").setAttribute("aria-valuenow", String(Math.round(100 * state.cut)));
}
