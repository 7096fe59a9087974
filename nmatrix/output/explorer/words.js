// Words and numbers beside the pictures: tags, matrices, commands, the shader, the journey.
const BADGES = {
  right: '<circle cx="12" cy="12" r="12"/><path d="M5 12.5 L10 17.5 L19.5 7"/>',
  wrong: '<rect width="24" height="24" rx="4"/><path d="M6.5 6.5 L17.5 17.5 M17.5 6.5 L6.5 17.5"/>',
};
// Entries by which the mistake and the right matrix differ, where they differ by more than a length.
function matrixTable(name, label, A, kind, other) {
  const rowsOf = A.map((row, i) => `<tr>${row.map((x, j) => `<td class="${other && other[i][j] !== x ? kind : x === "0" ? "zero" : ""}">${x}</td>`).join("")}</tr>`).join("");
  return `<div class="matrix"><span>${name}</span><div class="brackets"><table aria-label="${label}"><tbody>${rowsOf}</tbody></table></div></div>`;
}
const fractionText = (x) => (String(x).length > 11 ? figureOf(x, 4) : String(x));
function matricesHtml(s, found) {
  const exact = exactLinear(s), rule = s.rule === STUCK ? "none" : s.rule;
  const entries = exact || asFractions(found.whole), written = exact ? fractionText : (x) => figureOf(x, 4);
  const of = (name) => exactRule(name, entries, found.isFlat)?.map((row) => row.map(written)) ?? null;
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
  return `<div class="matrices">${parts.join("")}</div><p class="note-small">det A = ${found.isFlat ? 0 : written(exactDeterminant(entries))}</p>${note}`;
}
const goneHtml = (name) => `<div class="matrix"><span>${name}</span><p class="brackets gone">1 / 0<br>does not exist</p></div>`;

const given = (option, values, usual) => (values.every((x, i) => x === usual[i]) ? "" : `--${option} ${values.join(" ")}`);
function worldWords(s) {
  const none = [0, 0, 0], [turns, shears] = [[s.rx, s.ry, s.rz], [s.hxy, s.hxz, s.hyz]];
  return [given("scale", scaleOf(s), [1, 1, 1]), given("rotate", turns, none), given("shear", shears, none), given("translate", placeOf(s), none)];
}
function cameraWords(found) {
  if (data.looks) return [given("eye", found.eye, [0, 0, 5]), data.options.camera, data.options.lens];
  return [`--view-matrix "${found.camera.map((row) => row.join(" ")).join("; ")}"`, data.options.lens];
}
function lightWords(found) {
  const usual = data.has_position ? [NaN, NaN, NaN] : [-1, -1, -1];  // beside a lamp it is always told
  return [data.has_direction ? given("light-direction", found.light, usual) : "", found.lamp ? `--light-position ${found.lamp.join(" ")}` : ""];
}
const spoken = (words) => words.filter(Boolean).join(" ");
const commands = (s, found) => ({
  command: spoken(["nmatrix world", ...worldWords(s)]),
  "shader-command": spoken([
    `nmatrix space ${s.space} --reflection lambert -f glsl`, ...worldWords(s), ...cameraWords(found), ...lightWords(found),
    s.space === "custom" ? data.options.space : "",
  ]),
  "trace-command": spoken([`nmatrix trace --point ${found.mesh.points[vertexNumber(s, found)].join(" ")}`, ...worldWords(s), ...cameraWords(found)]),
});
function glsl() { const pair = shadersOf(state.space, meaningNow()); return `${pair.vertex}// ---- fragment shader ----\n${pair.fragment}`; }

const put = (id, html) => { const at = byId(id); if (at.told !== html) at.innerHTML = at.told = html; };  // what stays is not laid out again
function writeWords(s, found) {
  const { title, number } = numberWords(s, found), names = tags(s, found), isStuck = s.rule === STUCK;
  put("sentence", sentence(s, found));
  put("number-title", title); put("number", number);
  const top = isStuck ? found.brightness : found.largest;
  byId("bar").hidden = !top;
  put("bar-low", isStuck ? "0 %" : "0°"); put("bar-top", isStuck ? `${Math.round(100 * top)} %` : degreesText(top || 0));
  if (isStuck) put("map-title", top ? "brightness is off by" : "brightness is right everywhere");
  else put("map-title", found.largest === null ? "no angle to show" : top ? "angle to the true normal" : "0° everywhere");
  for (const tag of root.querySelectorAll(".tag")) {
    const side = tag.dataset.side, kind = verdictOf(side, found);
    const html = `<svg viewBox="0 0 24 24" aria-hidden="true">${BADGES[kind]}</svg><span>${names[side]}</span>`;
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
  const body = `The ${BODY_NAMES[s.shape]}`, shown = {
    wrong: `${body} by the mistake, ${MISTAKES[s.rule]}.`, right: `${body} as it should be.`,
    both: `${body}: the mistake at the left of the divider, right at its right.`,
  };
  for (const [id, words] of Object.entries(shown)) byId(id).setAttribute("aria-label", `${words} Arrow keys turn the view. ${plain}`);
  byId("map").setAttribute("aria-label", `Map of the error over the surface, from 0 to ${byId("bar-top").textContent}.`);
  byId("state").textContent = JSON.stringify({
    A: found.A, N: found.N, C: found.C, det: found.det, eye: found.eye, camera: found.camera, light: found.light,
    largest: found.largest, isSame: found.isSame, brightness: found.brightness,
    spaces: Object.fromEntries(CHOICES.space.map((space) => [space, spaceFromWorld(space, found)])),
    journey: journey(s, found).map(([name, , values]) => [name, values]),
    exact: exactLinear(s) && exactLinear(s).map((row) => row.map(String)), arrows: drawnArrows, errors: painter.errors,
  });
}
