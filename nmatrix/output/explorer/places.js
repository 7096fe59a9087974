// Where things are: each space as a small stage of its own, with its axes at its origin, the body, the
// light, the eye with its frustum, and the world's floor carried along; and one vertex on its way.
const PLACES = {
  object: "the shape is plain; light and eye are carried here by M⁻¹",
  world: "everything stands where you put it",
  camera: `the eye is the origin and looks down ${data.looks_down}`,
  light: data.has_position ? "the lamp is the origin and looks down −z" : "the light shines down −z",
  static: "M is baked into every vertex; no M is left",
  custom: "carried by any matrix S that you give",
};
const OBSERVER = [-0.62, 0.42, 0.9];

// The four corners of what the eye sees, at a distance, in camera space.
function frustumCorners(distance) {
  const P = data.clip_from_camera, ahead = P[3][2] !== 0 ? distance / P[3][2] : distance * Math.sign(P[2][2] || -1), w = P[3][2] * ahead + P[3][3];
  return [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([x, y]) => [(x * w - P[0][2] * ahead - P[0][3]) / P[0][0], (y * w - P[1][2] * ahead - P[1][3]) / P[1][1], ahead]);
}
// What stands in the world, by names, ready to be carried into any space.
function standing(s, found) {
  const R = found.reach, middle = point(found.M, [0, 0, 0]), back = inverse4(found.camera), floor = Math.min(...found.mesh.points.map((p) => point(found.M, p)[1]));
  const away = length(minus(found.eye, data.target)), grid = [];
  for (let i = -2; i <= 2; i++) for (const along of [0, 1]) {
    const at = (a) => plus(middle, along ? [(a * R) / 1.8, 0, (i * R) / 1.8] : [(i * R) / 1.8, 0, (a * R) / 1.8]).map((x, k) => (k === 1 ? floor : x));
    grid.push([at(-2), at(2)]);
  }
  const towards = data.has_direction ? unit(found.light.map((x) => -x)) : null;
  return {
    grid, eye: found.eye, target: data.target, corners: frustumCorners(away).map((p) => point(back, p)),
    sun: towards && plus(middle, towards, 2.7 * R), sunTip: towards && plus(middle, towards, 1.7 * R), lamp: found.lamp,
    vertex: point(found.M, found.mesh.points[vertexNumber(s, found)]),
  };
}
const vertexNumber = (s, found) => Math.min(found.mesh.points.length - 1, Math.max(0, Math.round(s.v * (found.mesh.points.length - 1))));

// An observer outside who sees everything: a parallel view that fits all the points.
function observed(points) {
  const rows = lookingAlong([0, 0, 0], wholes(OBSERVER.map((x) => -x))[0], [0, 1, 0]), seen = points.map((p) => point(rows, p));
  const [low, high] = [Math.min, Math.max].map((best) => [0, 1, 2].map((i) => best(...seen.map((p) => p[i]))));
  const middle = low.map((x, i) => (x + high[i]) / 2), size = Math.max(high[0] - low[0], high[1] - low[1]) * 0.58 || 1, deep = (high[2] - low[2]) * 0.6 || 1;
  return times([[1 / size, 0, 0, -middle[0] / size], [0, 1 / size, 0, -middle[1] / size], [0, 0, -1 / deep, middle[2] / deep], [0, 0, 0, 1]], rows);
}
function drawPlace(canvas, size, s, found, space) {
  const pen = new Pen(canvas, size, themeNow(), Math.max(size / 400, 0.6 * Math.min(2, devicePixelRatio))), S = spaceFromWorld(space, found);
  pen.clear();
  if (!S) { pen.hatch(["1 / 0", space === "object" ? "M has no inverse" : "no direction"]); return; }
  const there = standing(s, found), carry = (p) => point(S, p), reach = 0.9 * length(minus(found.eye, data.target)) ** 0.5;
  const axes = [0, 1, 2].map((i) => identity3[i].map((x) => x * reach)), body = found.mesh.points.filter((_, i) => i % 9 === 0).map((p) => carry(point(found.M, p)));
  const lights = [there.sun, there.lamp].filter(Boolean).map(carry);
  const letters = axes.map((tip) => tip.map((x) => 1.15 * x)), carried = [there.eye, ...there.corners, ...there.grid.flat()].map(carry);
  const view = observed([[0, 0, 0], ...letters, ...body, ...carried, ...lights]);
  const at = (p) => { const q = point(view, p); return [((q[0] + 1) / 2) * size, ((1 - q[1]) / 2) * size]; }, from = (p) => at(carry(p));
  const { ink, grid, eye, soft } = pen.palette;
  for (const line of there.grid) pen.line(line.map(from), grid, 1.4);
  const isAhead = point(view, axes[2])[2] < point(view, [0, 0, 0])[2];
  const drawAxes = () => axes.forEach((tip, i) => { pen.arrow(at([0, 0, 0]), at(tip), "ink", 3); pen.text(AXES[i], at(letters[i]), { bold: true }); });
  const isBodyInFront = body.length && point(view, carry(point(found.M, [0, 0, 0])))[2] < point(view, [0, 0, 0])[2] - 1e-9;
  if (isBodyInFront || !isAhead) drawAxes();
  const corners = there.corners.map(from), apex = data.clip_from_camera[3][2] !== 0 ? from(there.eye) : null;
  if (apex) corners.forEach((corner) => pen.line([apex, corner], eye, 1.2));
  pen.line(corners, eye, 1.2, { closed: true });
  if (painter.gl && found.rank > 1) {
    const inSpace = { ...found, S }, isBaked = space === "static";
    painter.picture({
      size, samples: 2, ink: rgb(ink), mesh: isBaked ? baked(found.mesh, found.M, found.right) : found.mesh, key: isBaked ? "baked" : undefined,
      pair: shadersOf(space, found), uniforms: uniformsFor(s, space, "right", inSpace, times(view, S)),
      isFlat: found.isFlat, outline: 3.2 * pen.k, viewed: times(times(view, S), found.M),
    });
    painter.copyTo(pen.context, size, 2);
  }
  if (space === "static") for (let i = 0; i < found.mesh.points.length; i += 37) {
    const p = point(found.M, found.mesh.points[i]), n = apply(found.right, found.mesh.directions[i]);
    if (dot(n, OBSERVER) > 0) pen.disc(from(p), 2.2, ink, null);
  }
  if (!(isBodyInFront || !isAhead)) drawAxes();
  pen.disc(at([0, 0, 0]), 5, ink, null);
  pen.line([from(there.eye), from(there.target)], eye, 1.8, { dash: [4, 4] });
  pen.eye(from(there.eye), minus(from(there.target), from(there.eye)), 17);
  if (there.sun) {
    const way = minus(from(there.sunTip), from(there.sun)), long = Math.max(length(way), 90 * pen.k);
    pen.sun(from(there.sun), way.map((x) => x / long), { radius: 14 });
  }
  if (there.lamp) pen.lamp(from(there.lamp));
  pen.disc(from(there.vertex), 6, pen.palette.normal, pen.palette.paper, { width: 2 });
}

// --- One vertex from the object to the window -------------------------------------------------------------
function journey(s, found) {
  const object = found.mesh.points[vertexNumber(s, found)], world = point(found.M, object), camera = point(found.camera, world);
  const clip = apply(data.clip_from_camera, [...camera, 1]), isSeen = clip[3] > 0, ndc = isSeen ? clip.slice(0, 3).map((x) => x / clip[3]) : null;
  return [
    ["object", "where the mesh has it", object], ["world", "M · object", world], ["camera", "V · world", camera], ["clip", "P · camera", clip],
    ["ndc", "clip / w", ndc], ["window", "in pixels, and depth", ndc && point(data.window_from_ndc, ndc)],
  ];
}
function rowOf([name, by, values]) {
  const numbers = values ? values.map((x) => `<span>${figure(x, 5)}</span>`).join("") : "behind the eye: nothing is divided by w ≤ 0";
  return `<tr><th scope="row">${name}</th><td>${by}</td><td>${numbers}</td></tr>`;
}
