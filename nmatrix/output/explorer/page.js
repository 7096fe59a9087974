// What is drawn when: on demand alone, once a pixel while a hand moves, and finely where it rests.
const painter = new Painter(() => { showWhetherDrawn(); drawNow(); });
let drawnArrows = {}, framesDrawn = 0, isScheduled = false, isMoving = false, later = 0;
const isDivided = () => isNarrow() || state.layout === "divider";
let known = { key: "" };
function meaningNow() {
  const { yaw, tilt, v, cut, mode, layout, ...rest } = state, key = JSON.stringify(rest);
  if (known.key !== key) {
    const first = worldMatrix(storyStart(state.story)), found = meaning(state, radius(meshOf(state.shape), first));
    known = { key, found: Object.assign(found, { radii: radiiOf(found), brightness: state.rule === STUCK ? brightnessError(found) : 0 }) };
  }
  const found = { ...known.found, ...cameraOf(state, known.found.reach) };
  found.clip_from_world = times(data.clip_from_camera, found.camera);
  found.viewed = times(times(data.webgl_from_clip, found.clip_from_world), found.M);
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
function placeHandle(handle, at, size) {
  handle.hidden = !at;
  if (at) [handle.style.left, handle.style.top] = at.map((x) => `${(100 * x) / size}%`);
}
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
// A small stage is drawn when it is on the screen, or on paper.
const stages = () => root.querySelectorAll(".place canvas");
function drawStale() {
  const found = meaningNow();
  for (const canvas of stages()) {
    if (!canvas.isStale || !(canvas.isSeen || themeNow() === "print")) continue;
    drawPlace(canvas, sizeOf(canvas), state, found, canvas.parentElement.dataset.space);
    canvas.isStale = false;
  }
}
function drawPlaces() { for (const canvas of stages()) canvas.isStale = true; drawStale(); }
const seen = new IntersectionObserver((entries) => {
  for (const entry of entries) entry.target.isSeen = entry.isIntersecting;
  drawStale();
});
function draw() {
  isScheduled = false;
  if (signal.aborted) return;
  const found = meaningNow();
  paintPage();
  byId("sheet").classList.toggle("divided", isDivided());
  drawViews(state, found); writeWords(state, found);
  if (!isMoving || framesDrawn % 2) drawMap(state, found);  // the small map may lag by a frame
  framesDrawn += 1;
  clearTimeout(later);
  if (isMoving) later = setTimeout(settle, 160);
}
function settle() { isMoving = false; draw(); drawPlaces(); }  // the small stages follow when the hand rests
function schedule() { isMoving = true; if (!isScheduled) { isScheduled = true; requestAnimationFrame(draw); } }
function drawNow() { fill(null); settle(); }

function showWhetherDrawn() {
  byId("no-gl").hidden = Boolean(painter.gl);
  byId("sheet").classList.toggle("without-pictures", !painter.gl);
}

read(); buildGroups(); buildChoices(); connect();
for (const canvas of stages()) seen.observe(canvas);
signal.addEventListener("abort", () => { seen.disconnect(); clearTimeout(later); clearTimeout(written); painter.leave(); });
showWhetherDrawn(); drawNow();

// What others on the page may ask an explorer, and how it leaves.
const explorer = {
  remove() { leaving.abort(); root.replaceChildren(); },
  get state() { return state; }, get isBusy() { return isMoving || isScheduled || isUnwritten || [...stages()].some((one) => one.isSeen && one.isStale); },
  get framesDrawn() { return framesDrawn; },
  data, root, byId, read, fill, drawNow, writeWords, meaningNow, glsl, painter, Pen, bodyOf, onStage, tacksOf, arrowOf, stages,
  meaning, cameraOf, spaceFromWorld, journey, worstAngle, ruleMatrix, meshOf, START, ...arithmetic,
};
element.explorer = explorer;
return explorer;
