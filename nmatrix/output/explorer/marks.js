// The marks over a picture: tacks, arrows, sun, lamp, eye, axes. Each is told by its shape as well as
// by its colour. Sizes are for a stage of 470, and scale with it.
const SHAFT = 4.8, HEAD_LONG = 3.6, HEAD_WIDE = 2.9, HALO = 1.6, EDGE = 1.6, SUN = 19;
const DISC = 0.09, ARROW = 0.27;  // of the body's mean and largest radius

class Pen {
  constructor(canvas, size, theme, k = size / 470) {
    this.context = canvas.getContext("2d", { willReadFrequently: true });
    if (canvas.width !== size) canvas.width = canvas.height = size;
    this.size = size; this.k = k; this.palette = data.palettes[theme]; this.context.lineCap = this.context.lineJoin = "round";
  }
  clear() {
    this.context.globalAlpha = 1;
    this.context.fillStyle = this.palette.stage; this.context.fillRect(0, 0, this.size, this.size);
  }
  line(points, colour, width, { dash = [], halo = false, closed = false } = {}) {
    const c = this.context;
    c.beginPath(); points.forEach(([x, y], i) => (i ? c.lineTo(x, y) : c.moveTo(x, y)));
    if (closed) c.closePath();
    if (halo) { c.setLineDash([]); c.strokeStyle = this.palette.paper; c.lineWidth = (width + 2 * HALO) * this.k; c.stroke(); }
    c.setLineDash(dash.map((d) => d * width * this.k)); c.strokeStyle = colour; c.lineWidth = width * this.k; c.stroke(); c.setLineDash([]);
  }
  shape(points, fill, edge, width = EDGE) {
    const c = this.context;
    c.beginPath(); points.forEach(([x, y], i) => (i ? c.lineTo(x, y) : c.moveTo(x, y))); c.closePath();
    if (fill) { c.fillStyle = fill; c.fill(); }
    if (edge) { c.strokeStyle = edge; c.lineWidth = width * this.k; c.stroke(); }
  }
  disc([x, y], radius, fill, edge, { width = EDGE, dash = [] } = {}) {
    const c = this.context;
    c.beginPath(); c.arc(x, y, radius * this.k, 0, 2 * Math.PI);
    if (fill) { c.fillStyle = fill; c.fill(); }
    if (edge) { c.setLineDash(dash.map((d) => d * this.k)); c.strokeStyle = edge; c.lineWidth = width * this.k; c.stroke(); c.setLineDash([]); }
  }
  text(words, [x, y], { size = 17, colour = this.palette.ink, bold = false, align = "center" } = {}) {
    const c = this.context;
    c.font = `${bold ? "bold " : ""}${size * this.k}px "DejaVu Sans", Verdana, sans-serif`; c.textAlign = align; c.textBaseline = "middle";
    c.lineWidth = 4 * this.k; c.strokeStyle = this.palette.stage; c.strokeText(words, x, y); c.fillStyle = colour; c.fillText(words, x, y);
  }
  // Right is solid with a filled head; wrong is dashed with an open one.
  arrow(a, b, kind, shaft = SHAFT, colour = this.palette[kind]) {
    const long = Math.hypot(b[0] - a[0], b[1] - a[1]);
    if (long < 0.5) return;
    shaft = Math.min(shaft, long / this.k / HEAD_LONG / 1.25);
    const along = [(b[0] - a[0]) / long, (b[1] - a[1]) / long], head = HEAD_LONG * shaft * this.k, wide = (HEAD_WIDE * shaft * this.k) / 2;
    const back = [b[0] - along[0] * head, b[1] - along[1] * head];
    const barbs = [1, -1].map((side) => [back[0] - side * along[1] * wide, back[1] + side * along[0] * wide]);
    const paper = this.palette.paper;
    if (kind === "wrong") {
      this.line([a, b], paper, shaft + 2 * HALO); this.line([barbs[0], b, barbs[1]], paper, shaft + 2 * HALO);
      this.context.lineCap = "butt"; this.line([a, b], colour, shaft, { dash: [2.1, 1.5] });
      this.context.lineCap = "round"; this.line([barbs[0], b, barbs[1]], colour, shaft);
    } else {
      this.line([a, back], paper, shaft + 2 * HALO); this.shape([b, ...barbs], paper, paper, 2 * HALO);
      this.line([a, back], colour, shaft); this.shape([b, ...barbs], colour, null);
    }
  }
  // Light from infinity: a disc and three arrows along the way that it goes.
  sun(at, along, { isStuck = false, radius = SUN } = {}) {
    const { light, ink, wrong, stage } = this.palette, long = Math.hypot(...along), k = this.k;
    if (isStuck) this.disc(at, radius, stage, wrong, { width: 3, dash: [6, 4] }); else this.disc(at, radius, light, ink);
    if (long < 0.08) return;
    const way = along.map((x) => x / long), side = [-way[1], way[0]], reach = (17 + 31 * long) * (radius / SUN);
    for (const shift of [-0.95 * radius, 0, 0.95 * radius]) {
      const from = [0, 1].map((i) => at[i] + k * ((radius + 6) * way[i] + shift * side[i])), to = [0, 1].map((i) => from[i] + k * reach * way[i]);
      if (isStuck) this.arrow(from, to, "wrong", 3); else { this.edged(from, to, 4, ink, 1.5); this.edged(from, to, 4, light, 0); }
    }
  }
  edged(a, b, shaft, colour, more) {
    const long = Math.hypot(b[0] - a[0], b[1] - a[1]), way = [(b[0] - a[0]) / long, (b[1] - a[1]) / long], k = this.k;
    const back = [b[0] - way[0] * 13 * k, b[1] - way[1] * 13 * k], barbs = [1, -1].map((s) => [back[0] - s * way[1] * 6.5 * k, back[1] + s * way[0] * 6.5 * k]);
    this.line([a, back], colour, shaft + 2 * more); this.shape([b, ...barbs], colour, more ? colour : null, 2 * more);
  }
  // A lamp that has a place: a disc with twelve rays.
  lamp(at, { isStuck = false, radius = 13 } = {}) {
    const { light, ink, wrong, stage } = this.palette, k = this.k;
    for (let i = 0; i < 12; i++) {
      const [y, x] = turn(30 * i), ray = [radius + 4, radius + 11].map((r) => [at[0] + r * k * x, at[1] + r * k * y]);
      if (isStuck) this.line(ray, wrong, 2.5); else { this.line(ray, ink, 4.5); this.line(ray, light, 2.2); }
    }
    if (isStuck) this.disc(at, radius, stage, wrong, { width: 3, dash: [5, 4] }); else this.disc(at, radius, light, ink);
  }
  // A lens of two arcs and an iris, turned along its sight line.
  eye(at, along, radius = 14) {
    const c = this.context, { eye, paper } = this.palette, r = radius * this.k;
    c.save(); c.translate(...at); c.rotate(Math.atan2(along[1], along[0]) + Math.PI / 2);
    c.beginPath(); c.moveTo(-r, 0); c.quadraticCurveTo(0, -1.15 * r, r, 0); c.quadraticCurveTo(0, 1.15 * r, -r, 0); c.closePath();
    c.fillStyle = paper; c.fill(); c.strokeStyle = eye; c.lineWidth = 2.4 * this.k; c.stroke(); c.restore();
    this.disc(at, radius * 0.36, eye, null);
  }
  hatch(reason) {
    const c = this.context, { rule, ink, stage } = this.palette, step = 18 * this.k;
    for (let x = -this.size; x < this.size; x += step) this.line([[x, this.size], [x + this.size, 0]], rule, 1.6);
    this.disc([this.size / 2, this.size / 2], 120, stage, ink, { width: 2, dash: [9, 7] });
    this.text(reason[0], [this.size / 2, this.size / 2 - 12 * this.k], { size: 44, bold: true });
    this.text(reason[1], [this.size / 2, this.size / 2 + 34 * this.k], { size: 17, colour: this.palette.soft });
    c.globalAlpha = 1;
  }
}

// --- From the world to the stage --------------------------------------------------------------------------
// A point of the world in pixels, or null behind the eye.
function onStage(found, p, size) {
  const [x, y, , w] = apply(found.clip_from_world, [...p, 1]);
  return w > 1e-9 ? [((x / w + 1) / 2) * size, ((1 - (data.webgl_from_clip[1][1] * y) / w) / 2) * size] : null;
}
function towardsEye(found, p) {
  if (data.clip_from_camera[3][2] !== 0) return unit(minus(found.eye, p));
  return unit(linear(found.camera)[2].map((x) => (data.looks_down === "−z" ? x : -x)));  // lines of sight never meet
}
// Whether a triangle of the body stands between a point and the eye.
function isHidden(found, from, way, placed) {
  const { triangles } = found.mesh;
  for (let i = 0; i < triangles.length; i += 3) {
    const a = placed[triangles[i]], b = placed[triangles[i + 1]], c = placed[triangles[i + 2]];
    const ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2], vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
    const px = way[1] * vz - way[2] * vy, py = way[2] * vx - way[0] * vz, pz = way[0] * vy - way[1] * vx, det = ux * px + uy * py + uz * pz;
    if (Math.abs(det) < 1e-14) continue;
    const tx = from[0] - a[0], ty = from[1] - a[1], tz = from[2] - a[2], u = (tx * px + ty * py + tz * pz) / det;
    if (u < 0 || u > 1) continue;
    const qx = ty * uz - tz * uy, qy = tz * ux - tx * uz, qz = tx * uy - ty * ux, v = (way[0] * qx + way[1] * qy + way[2] * qz) / det;
    if (v >= 0 && u + v <= 1 && (vx * qx + vy * qy + vz * qz) / det > 1e-6) return true;
  }
  return false;
}
// Where tacks stand: those places of the mesh that the eye sees, none too near to another.
function tacksOf(found) {
  if (found.rank < 2) return [];
  const R = found.radii.mean, placed = found.mesh.points.map((p) => point(found.M, p)), kept = [];
  for (const [p, n] of found.mesh.tacks) {
    const at = point(found.M, p), normal = unit(apply(found.right, n)), towards = towardsEye(found, at);
    if (length(apply(found.right, n)) < 1e-9 * norm(found.right)) continue;  // it lies in the plane that is left
    const facing = dot(normal, towards), upright = found.isFlat && facing < 0 ? normal.map((x) => -x) : normal;
    if ((!found.isFlat && facing < -0.02) || kept.some((other) => length(minus(other.at, at)) < 0.36 * R)) continue;
    if (!found.isFlat && isHidden(found, plus(at, upright, 0.004 * R), towards, placed)) continue;
    const seen = onStage(found, at, 1);
    if (!seen || kept.some((other) => Math.hypot(...minus(other.seen, seen)) < 0.075)) continue;
    kept.push({ at, seen, upright, n, depth: length(minus(found.eye, at)) });
  }
  return kept.sort((a, b) => b.depth - a.depth);
}
// How far the body reaches from its middle: along its axes on average, and at most.
function radiiOf(found) {
  const middle = point(found.M, [0, 0, 0]), away = found.mesh.points.map((p) => minus(point(found.M, p), middle)), far = Math.max(...away.map(length));
  const mean = [0, 1, 2].reduce((sum, i) => sum + Math.max(...away.map((p) => Math.abs(p[i]))) / 3, 0);
  return { far, mean: Math.max(0.45 * far, mean) };
}
// The arrow of one side on a tack: its two ends in the world, or null where the rule gives nothing.
function arrowOf(tack, W, isFlat, R) {
  const along = apply(W, tack.n);
  if (length(along) < 1e-12 * norm(W)) return null;
  const way = unit(along), turned = isFlat && dot(way, tack.upright) < -1e-9 ? way.map((x) => -x) : way;
  return [tack.at, plus(tack.at, turned, ARROW * R)];
}
function drawTacks(pen, s, side, found, tacks) {
  const W = side === "wrong" ? found.wrong : found.right, R = found.radii, drawn = [];
  const kind = s.rule === STUCK ? "right" : verdictOf(side, found);
  for (const tack of tacks) {
    const first = unit(cross(tack.upright, Math.abs(tack.upright[0]) < 0.7 ? [1, 0, 0] : [0, 1, 0])), second = cross(tack.upright, first);
    const rim = Array.from({ length: 30 }, (_, i) => {
      const [y, x] = turn(12 * i).map((side) => side * DISC * R.mean);
      return onStage(found, plus(plus(tack.at, first, x), second, y), pen.size);
    });
    if (rim.every(Boolean)) pen.shape(rim, pen.palette.paper, pen.palette.ink, 2.2);
  }
  for (const tack of tacks) {
    const ends = arrowOf(tack, W, found.isFlat, R.far), at = onStage(found, tack.at, pen.size);
    if (!at) continue;
    if (!ends) { pen.text("0", at, { size: 15, bold: true, colour: pen.palette[kind] }); continue; }
    const [a, b] = ends.map((p) => onStage(found, p, pen.size));
    if (!b) continue;
    pen.arrow(a, b, kind);
    drawn.push([a, b].map((p) => p.map((x) => x / pen.size)));
  }
  return drawn;
}

// --- The light ---------------------------------------------------------------------------------------------
// Where a sun is drawn: at the rim of the stage that its light comes from; and the light's way there.
function sunPlace(found, light, size) {
  const [x, y] = apply(linear(found.camera), unit(light)), along = [x, -y], flat = Math.hypot(x, y);
  const from = flat > 0.05 ? [-along[0] / flat, -along[1] / flat] : [Math.SQRT1_2, -Math.SQRT1_2];
  const pushed = from.map((d) => Math.sign(d) * Math.abs(d) ** 0.4), reach = 0.425 / Math.max(...pushed.map(Math.abs));  // towards a corner
  return { at: pushed.map((d) => (0.5 + d * reach) * size), along };
}
function drawLight(pen, s, side, found) {
  const isStuck = side === "wrong" && s.rule === STUCK && !found.isSame;
  let place = null;
  if (data.has_direction) {
    const { at, along } = sunPlace(found, found.light, pen.size);
    if (isStuck && found.stuckLight && length(found.stuckLight)) {
      const stuck = sunPlace(found, found.stuckLight, pen.size);
      pen.sun(stuck.at, stuck.along, { isStuck: true });
    }
    if (!isStuck) pen.sun(at, along);
    place = at;
  }
  if (found.lamp) {
    const at = onStage(found, found.lamp, pen.size), stuck = isStuck && found.stuckLamp && onStage(found, found.stuckLamp, pen.size);
    if (stuck) pen.lamp(stuck, { isStuck: true });
    if (at && !isStuck) pen.lamp(at);
    place = at || place;
  }
  return place;
}
// A turntable under the body shows how far it was turned, where the light is left on it.
function drawTurntable(pen, s, found) {
  const low = Math.min(...found.mesh.points.map((p) => p[1]));
  const at = (radius, degrees) => { const [z, x] = turn(degrees); return onStage(found, point(found.M, [radius * x, low, -radius * z]), pen.size); };
  const rim = Array.from({ length: 72 }, (_, i) => at(1.15, 5 * i));
  if (!rim.every(Boolean)) return;
  pen.shape(rim, pen.palette.paper, pen.palette.ink);
  for (let i = 0; i < 12; i++) {
    const ends = [at(i ? 1.02 : 0.8, 30 * i), at(1.15, 30 * i)];
    if (ends.every(Boolean)) pen.line(ends, pen.palette.ink, i ? 1.6 : 6);
  }
}
