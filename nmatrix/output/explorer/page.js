// The page: its state in the controls and in the address, what is drawn when, and every hand on it.
const byId = (id) => document.getElementById(id);
const CHECK = "M5 12.5 L10 17.5 L19.5 7", CROSS = "M6.5 6.5 L17.5 17.5 M17.5 6.5 L6.5 17.5";
const badge = (kind) => `<svg viewBox="0 0 24 24" aria-hidden="true">${kind === "right" ? '<circle cx="12" cy="12" r="12"/>' : '<rect width="24" height="24" rx="4"/>'}<path d="${kind === "right" ? CHECK : CROSS}"/></svg>`;

// --- Stories: each sets a few things and shows the sliders that belong to it -----------------------------
const PLAIN = { sx: 1, sy: 1, sz: 1, mx: 0, my: 0, mz: 0, rx: 0, ry: 0, rz: 0, hxy: 0, hxz: 0, hyz: 0, rule: "none", shape: "egg", yaw: 0, tilt: 0,
  lx: data.start.lx, ly: data.start.ly, lz: data.start.lz };
const STORIES = {
  stretch: { name: "Stretch", set: { sy: 2 }, group: "scale" },
  mirror: { name: "Mirror", set: { mx: 1, rule: "cofactor", shape: "R", lx: -0.55, ly: -0.6, lz: -1 }, group: "mirror" },
  flatten: { name: "Flatten", set: { sy: 0, tilt: 16 }, group: "scale" },
  shear: { name: "Shear", set: { hxy: 1 }, group: "shear" },
  stuck: { name: "Stuck light", set: { ry: 60, rule: STUCK, shape: "R", lx: -1, ly: -0.45, lz: 0.1 }, group: "turn" },
  turn: { name: "Only turn: proves nothing", set: { rz: 30, shape: "R" }, group: "turn" },
  even: { name: "Even scale: proves nothing", set: { sx: 1.5, sy: 1.5, sz: 1.5, shape: "torus", tilt: 12 }, group: "even" },
};
function storyOf(s) {
  const found = meaning({ ...s, shape: "egg", yaw: 0, tilt: 0, v: 0 }, 0);
  if (s.rule === STUCK) return "stuck";
  if (found.isFlat) return "flatten";
  if (found.isConformal) return found.det < 0 ? "mirror" : found.isRigid ? "turn" : "even";
  return ["hxy", "hxz", "hyz"].some((key) => s[key] !== 0) ? "shear" : "stretch";
}
const START = { ...data.start, shape: "egg", yaw: 0, tilt: 0, v: 0.23, cut: 0.5, mode: "arrows", layout: "pair" };
START.story = storyOf(START);
START.shape = STORIES[START.story].set.shape || "egg";
if (START.story === "flatten") START.tilt = STORIES.flatten.set.tilt;
const storyStart = (story) => (story === START.story ? START : { ...PLAIN, ...STORIES[story].set });

// --- State: in the controls and in the address ---------------------------------------------------------------
const NUMBERS = Object.keys(START).filter((key) => typeof START[key] === "number");
const CHOICES = {
  space: Object.keys(data.shaders), rule: Object.keys(MISTAKES), shape: Object.keys(MESHES), story: Object.keys(STORIES),
  mode: ["arrows", "heat", "plain"], layout: ["pair", "divider"],
};
let state = { ...START };
function readHash() {
  state = { ...START };
  for (const part of location.hash.slice(1).split("&")) {
    const [key, value = ""] = part.split("=");
    if (NUMBERS.includes(key) && value !== "" && Number.isFinite(Number(value)) && Math.abs(Number(value)) < 1e6) state[key] = Number(value);
    if (Object.hasOwn(CHOICES, key) && CHOICES[key].includes(value)) state[key] = value;
  }
}
let isUnwritten = false, written = 0;
function writeHash() {
  isUnwritten = false;
  const changed = Object.keys(state).filter((key) => state[key] !== START[key]);
  history.replaceState(null, "", "#" + changed.map((key) => `${key}=${state[key]}`).join("&"));
}
function changed(input) {
  fill(input); schedule();
  isUnwritten = true; clearTimeout(written); written = setTimeout(writeHash, input === undefined ? 150 : 0);  // browsers allow few changes a second
}

// --- Sliders, buttons, choices ---------------------------------------------------------------------------------
const rows = (letter, names, label, range) => names.map((name) => ({ keys: [letter + name], label: label(name), range }));
const GROUPS = {
  scale: { title: "Stretch", rows: rows("s", AXES, (axis) => `stretch along ${axis}`, [0, 4, 0.05]) },
  even: { title: "Even scale", rows: [{ keys: ["sx", "sy", "sz"], label: "scale in every direction", range: [0.25, 4, 0.05] }] },
  mirror: { title: "Mirror", switches: AXES.map((axis) => [`m${axis}`, `mirror along ${axis}`]) },
  turn: { title: "Turn", rows: rows("r", AXES, (axis) => `turn about ${axis}, in degrees`, [-180, 180, 1]) },
  shear: { title: "Shear", rows: [["hxy", "x", "y"], ["hxz", "x", "z"], ["hyz", "y", "z"]].map(([key, moved, by]) => ({ keys: [key], label: `shear ${moved} along ${by}`, range: [-2, 2, 0.05] })) },
  ...(data.has_direction ? { light: { title: "Light", rows: rows("l", AXES, (axis) => `light travels along ${axis}`, [-3, 3, 0.05]) } } : {}),
  ...(data.has_position ? { lamp: { title: "Lamp", rows: rows("p", AXES, (axis) => `place of the lamp along ${axis}`, [-9, 9, 0.1]) } } : {}),
  camera: { title: "Camera", rows: [{ keys: ["yaw"], label: "walk round, in degrees", range: [-180, 180, 1] }, { keys: ["tilt"], label: "rise, in degrees", range: [-90, 90, 1] }] },
};
const open = new Set();
function buildGroups() {
  for (const [name, group] of Object.entries(GROUPS)) {
    const field = document.createElement("fieldset");
    field.id = `group-${name}`; field.innerHTML = `<legend>${group.title}</legend>`;
    for (const { keys, label, range } of group.rows || []) {
      const id = keys.length > 1 ? "even" : keys[0], row = document.createElement("div");
      row.className = "row";
      row.innerHTML = `<label for="${id}">${label}</label><input type="range" id="${id}" min="${range[0]}" max="${range[1]}" step="${range[2]}"><input type="number" id="${id}-n" step="any" aria-label="${label}, as a number">`;
      for (const input of row.querySelectorAll("input")) {
        input.dataset.keys = keys.join(" ");
        input.addEventListener("input", () => {
          const value = Number(input.value);
          if (input.value !== "" && Number.isFinite(value) && Math.abs(value) < 1e6) { for (const key of keys) state[key] = value; changed(input); }
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
    more.addEventListener("click", () => { if (open.has(name)) open.delete(name); else open.add(name); fill(null); });
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
    state = { ...state, ...kept, story: value }; open.clear();
  } else state[key] = value;
  changed(null);
}
function fill(except) {
  for (const input of document.querySelectorAll("input[data-keys]")) if (input !== except) input.value = state[input.dataset.keys.split(" ")[0]];
  for (const [key] of GROUPS.mirror.switches) byId(key).setAttribute("aria-pressed", String(Boolean(state[key])));
  for (const key of ["shape", "rule"]) byId(key).value = state[key];
  byId("theme").setAttribute("aria-pressed", String(themeNow() === "dark"));
  for (const key of ["story", "mode", "layout", "space"]) for (const button of document.querySelectorAll(`button[data-${key}]`)) button.setAttribute("aria-pressed", String(button.dataset[key] === state[key]));
  for (const name of Object.keys(GROUPS)) {
    const isOwn = STORIES[state.story].group === name;
    byId(`group-${name}`).hidden = !isOwn && !open.has(name);
    byId(`more-${name}`).hidden = isOwn; byId(`more-${name}`).setAttribute("aria-expanded", String(open.has(name)));
  }
  if (byId("vertex") !== except) byId("vertex").value = state.v;
  byId("divider").setAttribute("aria-valuenow", String(Math.round(100 * state.cut)));
}

// --- Colours -------------------------------------------------------------------------------------------------------
const darkScheme = matchMedia("(prefers-color-scheme: dark)"), onPaper = matchMedia("print"), narrow = matchMedia("(max-width: 760px)");
let isPrinting = false;
function themeNow() {
  if (isPrinting || onPaper.matches) return "print";
  return document.documentElement.dataset.theme || (darkScheme.matches ? "dark" : "light");
}

// --- Words and numbers ---------------------------------------------------------------------------------------------
// Entries by which the mistake and the right matrix differ, where they differ by more than a length.
function matrixTable(name, label, A, kind, other) {
  const rowsOf = A.map((row, i) => `<tr>${row.map((x, j) => {
    const isZero = x instanceof Fraction ? x.isZero : x === 0, differs = other && String(other[i][j]) !== String(x);
    return `<td class="${differs ? kind : isZero ? "zero" : ""}">${x instanceof Fraction ? fractionText(x) : figure(x, 4)}</td>`;
  }).join("")}</tr>`).join("");
  return `<div class="matrix"><span>${name}</span><table aria-label="${label}"><tbody>${rowsOf}</tbody></table></div>`;
}
const fractionText = (x) => (String(x).length > 11 ? figure(Number(x.top) / Number(x.bottom), 4) : String(x));
function matricesHtml(s, found) {
  const exact = exactLinear(s), rule = s.rule === STUCK ? "none" : s.rule;
  const of = (name) => (exact ? exactRule(name, exact) : name === "exact" ? found.N : name === "not-transposed" && found.isFlat ? null : ruleMatrix(name, found.A, found.isFlat));
  const A = of("none"), N = of("exact"), W = of(rule), right = N || of("cofactor"), isTold = !found.isSame && s.rule !== STUCK && found.rank > 1 && W;
  const parts = [];
  if (rule === "none") parts.push(matrixTable("A", "A, the linear part of M", A, "wrong", isTold && right));
  else {
    parts.push(matrixTable("A", "A, the linear part of M", A));
    if (W) parts.push(matrixTable(SYMBOLS[rule], data.rules[rule], W, "wrong", isTold && right)); else parts.push(goneHtml(SYMBOLS[rule]));
  }
  if (N) parts.push(matrixTable(SYMBOLS.exact, "A⁻ᵀ, the inverse transpose", N, "right", isTold && W));
  else { parts.push(goneHtml(SYMBOLS.exact)); if (rule !== "cofactor") parts.push(matrixTable("C", "C, the cofactors", right, "right", isTold && W)); }
  const note = exact ? "" : `<p class="note-small">Decimals to four digits: sines of these angles are no fractions.</p>`;
  return `<div class="matrices">${parts.join("")}</div><p class="note-small">det A = ${exact ? detText(exact, found) : figure(found.det)}</p>${note}`;
}
const detText = (exact, found) => { const C = exactCofactor(exact); return fractionText(exact[0].reduce((sum, x, i) => sum.plus(x.times(C[0][i])), new Fraction(0n))); };
const goneHtml = (name) => `<div class="matrix"><span>${name}</span><p class="gone">1 / 0<br>does not exist</p></div>`;

const given = (option, values, usual) => (values.every((x, i) => x === usual[i]) ? "" : `--${option} ${values.join(" ")}`);
function worldWords(s) {
  return [given("scale", scaleOf(s), [1, 1, 1]), given("rotate", [s.rx, s.ry, s.rz], [0, 0, 0]), given("shear", [s.hxy, s.hxz, s.hyz], [0, 0, 0]), given("translate", data.translate, [0, 0, 0])];
}
const cameraWords = (s, found) => (data.looks ? [given("eye", found.eye, [0, 0, 5]), data.options.camera] : [`--view-matrix "${found.camera.map((row) => row.join(" ")).join("; ")}"`]).concat(data.options.lens);
function lightWords(found) {
  const usual = data.has_position ? [NaN, NaN, NaN] : [-1, -1, -1];  // beside a lamp it is always told
  return [data.has_direction ? given("light-direction", found.light, usual) : "", found.lamp ? `--light-position ${found.lamp.join(" ")}` : ""];
}
const spoken = (words) => words.filter(Boolean).join(" ");
const commands = (s, found) => ({
  command: spoken(["nmatrix world", ...worldWords(s)]),
  "shader-command": spoken([`nmatrix space ${s.space} --reflection lambert -f glsl`, ...worldWords(s), ...cameraWords(s, found), ...lightWords(found), s.space === "custom" ? data.options.space : ""]),
  "trace-command": spoken([`nmatrix trace --point ${found.mesh.points[vertexNumber(s, found)].join(" ")}`, ...worldWords(s), ...cameraWords(s, found)]),
});
function glsl() { const pair = shadersOf(state.space, meaningNow()); return `${pair.vertex}// ---- fragment shader ----\n${pair.fragment}`; }

const put = (id, html) => { const at = byId(id); if (at.told !== html) at.innerHTML = at.told = html; };  // what stays is not laid out again
function writeWords(s, found) {
  const { title, number } = numberWords(s, found), names = tags(s, found), isStuck = s.rule === STUCK;
  put("sentence", sentence(s, found));
  put("number-title", title); put("number", number);
  const top = isStuck ? found.brightness : found.largest;
  byId("bar").hidden = !top; byId("bar-top").textContent = isStuck ? `${Math.round(100 * top)} %` : degreesText(top || 0); byId("bar-low").textContent = isStuck ? "0 %" : "0°";
  byId("map-title").textContent = isStuck ? (top ? "brightness is off by" : "brightness is right everywhere") : found.largest === null ? "no angle to show" : top ? "angle to the true normal" : "0° everywhere";
  for (const tag of document.querySelectorAll(".tag")) {
    const side = tag.dataset.side, kind = side === "wrong" && !found.isSame ? "wrong" : "right";
    const html = `${badge(kind)}<span>${names[side]}</span>`;
    tag.hidden = found.rank < 2 && !isStuck;  // a line has no normal to be right
    if (tag.told !== html) { tag.className = `tag ${kind}`; tag.innerHTML = tag.told = html; }
  }
  byId("same").hidden = !found.isSame;
  put("matrices", matricesHtml(s, found));
  for (const [id, text] of Object.entries(commands(s, found))) put(id, text.replace(/</g, "&lt;"));
  put("shader", glsl().replace(/&/g, "&amp;").replace(/</g, "&lt;"));
  put("shader-title", `The shader of ${s.space} space`);
  put("journey", journey(s, found).map(rowOf).join(""));
  const plain = byId("sentence").textContent;
  for (const [id, words] of [["wrong", `The ${BODY_NAMES[s.shape]} by the mistake, ${MISTAKES[s.rule]}.`], ["right", `The ${BODY_NAMES[s.shape]} as it should be.`], ["both", `The ${BODY_NAMES[s.shape]}: the mistake at the left of the divider, right at its right.`]]) byId(id).setAttribute("aria-label", `${words} Arrow keys turn the view. ${plain}`);
  byId("map").setAttribute("aria-label", `Map of the error over the surface, from 0 to ${byId("bar-top").textContent}.`);
  byId("state").textContent = JSON.stringify({
    A: found.A, N: found.N, C: found.C, det: found.det, largest: found.largest, isSame: found.isSame, brightness: found.brightness, eye: found.eye, camera: found.camera,
    light: found.light, spaces: Object.fromEntries(CHOICES.space.map((space) => [space, spaceFromWorld(space, found)])), journey: journey(s, found).map(([name, , values]) => [name, values]),
    exact: exactLinear(s) && exactLinear(s).map((row) => row.map(String)), arrows: drawnArrows, errors: painter.errors,
  });
}

// --- Drawing, on demand alone ------------------------------------------------------------------------------------------
const painter = new Painter();
let drawnArrows = {}, framesDrawn = 0, isScheduled = false, isMoving = false, later = 0;
const isDivided = () => narrow.matches || state.layout === "divider";
let known = { key: "" };
function meaningNow() {
  const { yaw, tilt, v, cut, mode, layout, ...rest } = state, key = JSON.stringify(rest);
  const story = storyStart(state.story), first = worldMatrix({ ...state, ...Object.fromEntries(Object.keys(PLAIN).filter((k) => /^[smrh][xyz]/.test(k) && typeof PLAIN[k] === "number").map((k) => [k, story[k]])) }, data.translate);
  if (known.key !== key) {
    const found = meaning(state, radius(meshOf(state.shape), first));
    known = { key, found: Object.assign(found, { radii: radiiOf(found), brightness: state.rule === STUCK ? brightnessError(found) : 0 }) };
  }
  const found = { ...known.found, ...cameraOf(state, known.found.reach) };
  found.clip_from_world = times(data.clip_from_camera, found.camera);
  if (["camera", "light"].includes(state.space)) { found.S = spaceFromWorld(state.space, found); }
  return found;
}
// While a hand moves, a pixel is drawn once; where it rests, as four.
function paint(pen, body) {
  const samples = isMoving ? 1 : 2;
  painter.picture({ ...body, size: pen.size, samples, ink: rgb(pen.palette.ink), outline: 1.7 * pen.k * samples });
  painter.copyTo(pen.context, pen.size, samples);
}
function drawSide(pen, s, side, found, tacks) {
  pen.clear();
  if (s.rule === STUCK && s.story === "stuck" && found.rank === 3) drawTurntable(pen, s, found);
  const body = s.mode === "heat" ? mapOf(s, side, found) : bodyOf(s, side, found);
  if (!body) { pen.hatch(["1 / 0", "no answer"]); return; }
  if (painter.gl && found.rank > 1) {
    paint(pen, body);
  } else if (found.rank < 2) drawLine(pen, found);
  if (s.mode === "arrows") drawnArrows[side] = drawTacks(pen, s, side, found, tacks);
  if (s.mode !== "heat" || s.rule === STUCK) drawLight(pen, s, side, found);
}
// What is left of a body without any area: a line, or a point.
function drawLine(pen, found) {
  const seen = found.mesh.points.map((p) => onStage(found, point(found.M, p), pen.size)).filter(Boolean);
  if (!seen.length) return;
  const far = (from) => seen.reduce((best, p) => (Math.hypot(...minus(p, from)) > Math.hypot(...minus(best, from)) ? p : best)), a = far(seen[0]);
  pen.line([a, far(a)], pen.palette.ink, 4); pen.disc(a, 3, pen.palette.ink, null);
}
function placeHandle(handle, at, size) { handle.hidden = !at; if (at) { handle.style.left = `${(100 * at[0]) / size}%`; handle.style.top = `${(100 * at[1]) / size}%`; } }
const sizeOf = (canvas) => Math.max(64, Math.round((canvas.clientWidth || 440) * Math.min(2, devicePixelRatio || 1)));
function drawViews(s, found) {
  const tacks = s.mode === "arrows" ? tacksOf(found) : [], theme = themeNow();
  drawnArrows = {};
  const lightAt = (size) => (found.lamp ? onStage(found, found.lamp, size) : data.has_direction ? sunPlace(found, found.light, size).at : null);
  if (!isDivided()) for (const side of ["wrong", "right"]) {
    const size = sizeOf(byId(side));
    drawSide(new Pen(byId(side), size, theme), s, side, found, tacks);
    placeHandle(byId(`light-${side}`), side === "wrong" && s.rule === STUCK && !found.isSame ? null : lightAt(size), size);
  } else {
    const canvas = byId("both"), size = sizeOf(canvas), pen = new Pen(canvas, size, theme), context = pen.context, x = s.cut * size;
    drawSide(pen, s, "wrong", found, tacks);
    context.save(); context.beginPath(); context.rect(x, 0, size, size); context.clip();
    drawSide(pen, s, "right", found, tacks); context.restore();
    pen.line([[x, 0], [x, size]], pen.palette.ink, 3);
    byId("divider").style.left = `${100 * s.cut}%`; placeHandle(byId("light-both"), lightAt(size), size);
  }
}
function drawMap(s, found) {
  const canvas = byId("map");
  if (!canvas.offsetParent) return;
  const size = sizeOf(canvas), pen = new Pen(canvas, size, themeNow()), body = mapOf(s, "wrong", found);
  pen.clear();
  if (!body || found.largest === null) { pen.hatch(["—", "no answer"]); return; }
  if (painter.gl && found.rank > 1) paint(pen, body);
}
function drawPlaces() {
  const found = meaningNow();
  for (const button of document.querySelectorAll(".place")) { const canvas = button.querySelector("canvas"); drawPlace(canvas, sizeOf(canvas), state, found, button.dataset.space); }
}
function draw() {
  isScheduled = false;
  const found = meaningNow();
  document.body.classList.toggle("divided", isDivided());
  drawViews(state, found); writeWords(state, found);
  if (!isMoving || framesDrawn % 2) drawMap(state, found);  // the small map may lag by a frame
  framesDrawn += 1;
  clearTimeout(later);
  if (isMoving) later = setTimeout(settle, 160);
}
function settle() { isMoving = false; draw(); drawPlaces(); }  // the small stages follow when the hand rests
function schedule() { isMoving = true; if (!isScheduled) { isScheduled = true; requestAnimationFrame(draw); } }
function drawNow() { fill(null); settle(); }

// --- Hands: drag, touch and keys ------------------------------------------------------------------------------------------
const STEPS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
function orbit(dx, dy) {
  state.yaw = ((((state.yaw - dx + 180) % 360) + 360) % 360) - 180;
  state.tilt = Math.max(-90, Math.min(90, state.tilt + dy));
  for (const key of ["yaw", "tilt"]) state[key] = rounded(state[key], 1);
}
// The light turns about the line of sight, and out of the stage or into it.
function turnLight(around, outward) {
  const found = meaningNow(), back = transpose(linear(found.camera)), l = apply(linear(found.camera), unit(lightOf(state)));
  const flat = Math.hypot(l[0], l[1]) > 1e-6 ? unit([l[1], -l[0], 0]) : [1, 0, 0];
  const moved = apply(back, apply(about([0, 0, 1], around), apply(about(flat, outward), l)));
  AXES.forEach((axis, i) => { state[`l${axis}`] = rounded(moved[i], 3); });
}
function moveLamp(dx, dy, size) {
  const found = meaningNow(), camera = point(found.camera, found.lamp), w = apply(data.clip_from_camera, [...camera, 1])[3];
  const step = [(2 * dx * w) / size / data.clip_from_camera[0][0], (-2 * dy * w) / size / Math.abs(data.clip_from_camera[1][1]), 0];
  const moved = plus(found.lamp, apply(transpose(linear(found.camera)), step));
  AXES.forEach((axis, i) => { state[`p${axis}`] = rounded(moved[i], 2); });
}
function dragged(element, move, keys) {
  let last = null;
  element.addEventListener("pointerdown", (event) => { if (event.button) return; last = [event.clientX, event.clientY]; element.setPointerCapture(event.pointerId); element.focus({ preventScroll: true }); event.preventDefault(); });
  element.addEventListener("pointermove", (event) => { if (last) { move(event.clientX - last[0], event.clientY - last[1], event); last = [event.clientX, event.clientY]; changed(); } });
  for (const name of ["pointerup", "pointercancel"]) element.addEventListener(name, () => { last = null; });
  element.addEventListener("keydown", (event) => { const step = STEPS[event.key]; if (step) { keys(...step); changed(null); event.preventDefault(); } });
}
function connect() {
  for (const id of ["wrong", "right", "both"]) {
    dragged(byId(id), (dx, dy) => { const turned = 200 / byId(id).clientWidth; orbit(dx * turned, dy * turned); }, (x, y) => orbit(5 * x, 5 * y));
    dragged(byId(`light-${id}`), (dx, dy, event) => {
      const box = byId(id).getBoundingClientRect();
      if (data.has_position) { moveLamp(dx, dy, box.width); return; }
      const at = [event.clientX - box.left - box.width / 2, event.clientY - box.top - box.height / 2], before = [at[0] - dx, at[1] - dy];
      const around = ((Math.atan2(before[1], before[0]) - Math.atan2(at[1], at[0])) * 180) / Math.PI;
      turnLight(around, ((Math.hypot(...at) - Math.hypot(...before)) * 180) / box.width);
    }, (x, y) => (data.has_position ? moveLamp(8 * x, 8 * y, byId(id).clientWidth) : turnLight(-5 * x, -5 * y)));
  }
  dragged(byId("divider"), (dx) => { state.cut = Math.max(0, Math.min(1, rounded(state.cut + dx / byId("both").clientWidth, 3))); }, (x, y) => { state.cut = Math.max(0, Math.min(1, rounded(state.cut + 0.05 * (x - y), 3))); });
  byId("vertex").addEventListener("input", () => { state.v = Number(byId("vertex").value); changed(byId("vertex")); });
  for (const id of ["command", "shader-command", "trace-command"]) byId(`copy-${id}`).addEventListener("click", () => copy(byId(id).textContent, "command"));
  byId("copy-glsl").addEventListener("click", () => copy(glsl(), "GLSL"));
  byId("copy-link").addEventListener("click", () => { writeHash(); copy(location.href, "link"); });
  byId("reset").addEventListener("click", () => { state = { ...START }; open.clear(); changed(null); });
  byId("theme").addEventListener("click", () => { document.documentElement.dataset.theme = themeNow() === "dark" ? "light" : "dark"; drawNow(); });
  byId("print").addEventListener("click", () => window.print());
  addEventListener("hashchange", () => { readHash(); drawNow(); });
  addEventListener("beforeprint", () => { isPrinting = true; drawNow(); });
  addEventListener("afterprint", () => { isPrinting = false; drawNow(); });
  for (const media of [darkScheme, onPaper, narrow]) media.addEventListener("change", drawNow);
  let width = byId("views").clientWidth;
  new ResizeObserver(() => { if (byId("views").clientWidth !== width) { width = byId("views").clientWidth; schedule(); } }).observe(byId("views"));
}
async function copy(text, what) {
  try { await navigator.clipboard.writeText(text); byId("said").textContent = `The ${what} is copied.`; }
  catch { byId("said").textContent = `This browser lets no page copy; the ${what} can be selected on the page.`; }
}
readHash(); buildGroups(); buildChoices(); connect();
byId("no-gl").hidden = Boolean(painter.gl);
document.body.classList.toggle("without-pictures", !painter.gl);
drawNow();
