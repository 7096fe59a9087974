// The state: stories that set it, the keeper that holds it, the theme that shows it.

// --- Stories: each sets a few things and shows the sliders that belong to it -----------------------------
const PLAIN = { sx: 1, sy: 1, sz: 1, mx: 0, my: 0, mz: 0, rx: 0, ry: 0, rz: 0, hxy: 0, hxz: 0, hyz: 0, tx: data.start.tx, ty: data.start.ty, tz: data.start.tz, rule: "none", shape: "egg", yaw: 0, tilt: 0,
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
  if (found.isConformal) return found.sign < 0 ? "mirror" : found.isRigid ? "turn" : "even";
  return ["hxy", "hxz", "hyz"].some((key) => s[key] !== 0) ? "shear" : "stretch";
}
const START = { ...data.start, shape: "egg", yaw: 0, tilt: 0, v: 0.23, cut: 0.5, mode: "arrows", layout: "pair" };
START.story = storyOf(START);
START.shape = STORIES[START.story].set.shape || "egg";
if (START.story === "flatten") START.tilt = STORIES.flatten.set.tilt;
const storyStart = (story) => (story === START.story ? START : { ...PLAIN, ...STORIES[story].set });

// --- State: in the controls, and with its keeper ---------------------------------------------------------------
const NUMBERS = Object.keys(START).filter((key) => typeof START[key] === "number");
const CHOICES = {
  space: Object.keys(data.shaders), rule: Object.keys(MISTAKES), shape: Object.keys(MESHES), story: Object.keys(STORIES),
  mode: ["arrows", "heat", "plain"], layout: ["pair", "divider"],
};
let state = { ...START };
const isNumber = (value) => ["number", "string"].includes(typeof value) && value !== "" && Number.isFinite(Number(value)) && Math.abs(Number(value)) < data.largest;
function kept() {
  const found = { ...START };
  for (const [key, value] of Object.entries(keeper.read())) {
    if (NUMBERS.includes(key) && isNumber(value)) found[key] = Number(value);
    if (Object.hasOwn(CHOICES, key) && CHOICES[key].includes(value)) found[key] = value;
  }
  return found;
}
function read() { state = kept(); }
const changes = () => Object.fromEntries(Object.entries(state).filter(([key, value]) => value !== START[key]));
let isUnwritten = false, written = 0;
function write() { isUnwritten = false; clearTimeout(written); keeper.write(changes()); }
// What this explorer wrote itself comes back from some keepers: it changes nothing.
function follow() {
  if (signal.aborted) return;
  const found = kept();
  if (Object.keys(found).every((key) => found[key] === state[key])) return;
  state = found; drawNow();
}
function changed(input) {
  fill(input); schedule();
  isUnwritten = true; clearTimeout(written); written = setTimeout(write, input === undefined ? 150 : 0);  // browsers allow few changes a second
}

// --- Colours -------------------------------------------------------------------------------------------------------
const darkScheme = matchMedia("(prefers-color-scheme: dark)"), onPaper = matchMedia("print"), NARROW = 760;  // pixels, as in the style
let isPrinting = false;
const isNarrow = () => !isPrinting && !onPaper.matches && element.clientWidth > 0 && element.clientWidth <= NARROW;
// The document around: the page that holds this one in a frame, where it lets itself be seen; else its own, which may be a notebook.
function documentAround() { try { return parent.document; } catch { return document; } }
const around = documentAround(), SCHEMES = ["light", "dark"];
function schemeAround() {
  const { jpThemeLight, vscodeThemeKind = "" } = around.body?.dataset || {}, told = around.documentElement.dataset.theme;
  if (SCHEMES.includes(told)) return told;
  if (jpThemeLight) return jpThemeLight === "true" ? "light" : "dark";
  return vscodeThemeKind && (vscodeThemeKind.includes("light") ? "light" : "dark");
}
function themeNow() {
  if (isPrinting || onPaper.matches) return "print";
  return [house.dataset.theme, schemeAround()].find((one) => SCHEMES.includes(one)) || (darkScheme.matches ? "dark" : "light");
}
let painted = "";
function paintPage() {
  const theme = themeNow();
  if (painted === theme) return;
  painted = theme;
  const { heat, ...named } = data.palettes[theme], other = theme === "dark" ? "light" : "dark";
  for (const [name, colour] of Object.entries(named)) element.style.setProperty(`--${name}`, colour);
  element.style.setProperty("--heat", heat.join());
  element.dataset.scheme = theme === "dark" ? "dark" : "light";
  byId("theme").querySelector(".word").textContent = ` ${other}`; byId("theme").setAttribute("aria-label", `Change to ${other} colours`);
}
