// The page's state: stories that set it, the address that keeps it, the theme that shows it.
const byId = (id) => document.getElementById(id);

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

// --- Colours -------------------------------------------------------------------------------------------------------
const darkScheme = matchMedia("(prefers-color-scheme: dark)"), onPaper = matchMedia("print"), narrow = matchMedia("(max-width: 760px)");
let isPrinting = false;
function themeNow() {
  if (isPrinting || onPaper.matches) return "print";
  return document.documentElement.dataset.theme || (darkScheme.matches ? "dark" : "light");
}
