// Hands on the page: drag, touch and keys, for the camera, the light and the divider.
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
  element.addEventListener("pointerdown", (event) => {
    if (event.button) return;
    last = [event.clientX, event.clientY];
    element.setPointerCapture(event.pointerId); element.focus({ preventScroll: true }); event.preventDefault();
  });
  element.addEventListener("pointermove", (event) => {
    if (!last) return;
    move(event.clientX - last[0], event.clientY - last[1], event);
    last = [event.clientX, event.clientY]; changed();
  });
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
  const cutAt = (x) => { state.cut = Math.max(0, Math.min(1, rounded(x, 3))); };
  dragged(byId("divider"), (dx) => cutAt(state.cut + dx / byId("both").clientWidth), (x, y) => cutAt(state.cut + 0.05 * (x - y)));
  byId("vertex").addEventListener("input", () => { state.v = Number(byId("vertex").value); changed(byId("vertex")); });
  for (const id of ["command", "shader-command", "trace-command"]) byId(`copy-${id}`).addEventListener("click", () => copy(byId(id).textContent, "command"));
  byId("copy-glsl").addEventListener("click", () => copy(glsl(), "GLSL"));
  byId("copy-link").addEventListener("click", () => { write(); copy(location.href, "link"); });
  byId("reset").addEventListener("click", () => { state = { ...START }; shown.clear(); changed(null); });
  byId("theme").addEventListener("click", () => { house.dataset.theme = themeNow() === "dark" ? "light" : "dark"; drawNow(); });
  byId("print").addEventListener("click", () => window.print());
  for (const id of ["copy-link", "print"]) byId(id).hidden = !keeper.isPage;
  keeper.listen(follow, signal);
  addEventListener("beforeprint", () => { isPrinting = true; drawNow(); }, { signal });
  addEventListener("afterprint", () => { isPrinting = false; drawNow(); }, { signal });
  for (const media of [darkScheme, onPaper]) media.addEventListener("change", drawNow, { signal });
  let width = byId("views").clientWidth;
  const resized = new ResizeObserver(() => { if (byId("views").clientWidth !== width) { width = byId("views").clientWidth; schedule(); } });
  resized.observe(byId("views")); signal.addEventListener("abort", () => resized.disconnect());
  // Who changes the theme around wins over what was chosen here before.
  const themed = new MutationObserver((records) => { if (records.some(({ target }) => target !== house)) delete house.dataset.theme; drawNow(); });
  for (const place of [house, around.documentElement, around.body]) if (place) themed.observe(place, { attributeFilter: ["data-theme", "data-jp-theme-light", "data-vscode-theme-kind"] });
  signal.addEventListener("abort", () => themed.disconnect());
}
async function copy(text, what) {
  try { await navigator.clipboard.writeText(text); byId("said").textContent = `The ${what} is copied.`; }
  catch { byId("said").textContent = `This browser lets no page copy; the ${what} can be selected on the page.`; }
}
