// The bodies: an egg and a torus by the formulas of nmatrix's own shapes, and the letter R, which
// shows what round bodies hide: turning and mirroring. Each has the places of its tacks.
function grid(rings, sectors, at) {
  const positions = [], normals = [], triangles = [];
  for (let i = 0; i <= rings; i++) for (let j = 0; j <= sectors; j++) {
    const [p, n] = at(i / rings, ((j % sectors) / sectors) * 2 * Math.PI);
    positions.push(...p); normals.push(...n);
  }
  for (let i = 0; i < rings; i++) for (let j = 0; j < sectors; j++) {
    const a = i * (sectors + 1) + j, b = a + sectors + 1;
    triangles.push(a, a + 1, b, b, a + 1, b + 1);
  }
  return { positions, normals, triangles, creases: [] };
}
function onSphere(u, around) {
  const out = u === 1 ? 0 : Math.sin(u * Math.PI);
  const p = [out * Math.cos(around), Math.cos(u * Math.PI), out * Math.sin(around)];
  return [p, p];
}
function onTorus(u, around) {
  const [s, c] = u === 1 ? [0, 1] : [Math.sin(u * 2 * Math.PI), Math.cos(u * 2 * Math.PI)];
  const out = [Math.cos(around), 0, Math.sin(around)];
  const n = [s * out[0], c, s * out[2]];
  return [[out[0] + 0.4 * n[0], 0.4 * n[1], out[2] + 0.4 * n[2]], n];
}
const ringOf = (at, u, count, shift) => Array.from({ length: count }, (_, j) => at(u, ((j + shift) / count) * 2 * Math.PI));

const HALF_DEPTH = 0.24;
// Each part of the letter is a strip between two lines of points, from one to the other; `open`
// are the sides that another part covers, and `round` has normals that run on from wall to wall.
function letterR() {
  const mesh = { positions: [], normals: [], triangles: [], creases: [] };
  const vertex = (p, n) => { mesh.positions.push(...p.map((x) => rounded(x, 6))); mesh.normals.push(...n); return mesh.positions.length / 3 - 1; };
  const line = (a, b) => mesh.creases.push(vertex(a, [0, 0, 1]), vertex(b, [0, 0, 1]));
  const quad = (corners, normals) => { const [a, b, c, d] = corners.map((p, i) => vertex(p, normals[i])); mesh.triangles.push(a, b, c, a, c, d); };
  function wall(points, round, center, outward) {  // the body lies to the left of the way
    for (let i = 0; i + 1 < points.length; i++) {
      const [a, b] = [points[i], points[i + 1]], flat = unit([b[1] - a[1], a[0] - b[0], 0]);
      const at = (p) => (round(p) ? unit([outward * (p[0] - center[0]), outward * (p[1] - center[1]), 0]) : flat);
      const isBent = round(a) && round(b), [m, n] = isBent ? [at(a), at(b)] : [flat, flat];
      quad([[...a, HALF_DEPTH], [...a, -HALF_DEPTH], [...b, -HALF_DEPTH], [...b, HALF_DEPTH]], [m, m, n, n]);
      for (const z of [HALF_DEPTH, -HALF_DEPTH]) line([...a, z], [...b, z]);
      if (i === 0 || !isBent) line([...a, HALF_DEPTH], [...a, -HALF_DEPTH]);
    }
    const last = points[points.length - 1];
    line([...last, HALF_DEPTH], [...last, -HALF_DEPTH]);
  }
  function faces(outer, inner) {
    for (let i = 0; i + 1 < outer.length; i++) for (const side of [1, -1]) {
      const corners = [outer[i], inner[i], inner[i + 1], outer[i + 1]].map((p) => [...p, side * HALF_DEPTH]);
      if (side < 0) corners.reverse();
      quad(corners, corners.map(() => [0, 0, side]));
    }
  }
  const straight = () => false;
  const stem = [[-0.25, 1], [-0.65, 1], [-0.65, -1], [-0.25, -1]];
  faces([stem[0], stem[3]], [stem[1], stem[2]]);
  const [middle, steps] = [[0.1, 0.43], 24];
  const arc = (radius) => Array.from({ length: steps + 1 }, (_, i) => {
    const [s, c] = turn(90 - (180 * i) / steps);
    return [middle[0] + radius * c, middle[1] + radius * s];
  });
  const bowl = (radius) => [[-0.25, middle[1] + radius], ...arc(radius), [-0.25, middle[1] - radius]];
  const [outer, inner] = [bowl(0.57), bowl(0.2)];
  faces(outer, inner);
  const bent = (p) => p[0] >= middle[0] - 1e-9;
  wall([...stem, [-0.25, outer[steps + 2][1]]], straight);
  wall([[-0.25, inner[steps + 2][1]], [-0.25, inner[0][1]]], straight);
  wall([...outer].reverse(), bent, middle, 1);
  wall(inner, bent, middle, -1);
  const leg = [[-0.12, -0.14], [0.32, -1], [0.78, -1], [0.3, -0.1]];
  faces([leg[3], leg[2]], [leg[0], leg[1]]);
  wall(leg, straight);
  const front = [[-0.45, 0.62], [-0.45, -0.6], [0.45, -0.75], [0.48, 0.43]];
  mesh.tacks = [...front.map((p) => [[...p, HALF_DEPTH], [0, 0, 1]]), ...front.map((p) => [[...p, -HALF_DEPTH], [0, 0, -1]]),
    [[-0.45, 1, 0], [0, 1, 0]], [[-0.65, 0, 0], [-1, 0, 0]], [[0.1 + 0.57 * Math.SQRT1_2, 0.43 + 0.57 * Math.SQRT1_2, 0], [Math.SQRT1_2, Math.SQRT1_2, 0]],
    [[0.52, -0.521, 0], unit([0.9, 0.48, 0])], [[0.55, -1, 0], [0, -1, 0]]];
  return mesh;
}
const MESHES = {
  egg: () => Object.assign(grid(data.tessellation[0], data.tessellation[1], onSphere), {
    isSmooth: true,
    tacks: [[0.16, 4, 0.4], [0.34, 8, 0.15], [0.5, 8, 0.6], [0.66, 8, 0.15], [0.84, 4, 0.4]].flatMap(([u, count, shift]) => ringOf(onSphere, u, count, shift)),
  }),
  torus: () => Object.assign(grid(data.tessellation[0], data.tessellation[1], onTorus), {
    isSmooth: true,
    tacks: [[0.02, 7, 0.2], [0.16, 9, 0.5], [0.32, 9, 0], [0.5, 7, 0.3], [0.84, 7, 0.5]].flatMap(([u, count, shift]) => ringOf(onTorus, u, count, shift)),
  }),
  R: letterR,
};
const BODY_NAMES = { egg: "ball", torus: "torus", R: "letter R" };
// The edges between two triangles, by places: seams of a grid hold each place twice.
function edgesOf(points, triangles) {
  const places = new Map(), at = points.map((p) => {
    const key = p.map((x) => x.toFixed(9)).join();
    if (!places.has(key)) places.set(key, places.size);
    return places.get(key);
  });
  const open = new Map(), edges = [];
  for (let i = 0; i < triangles.length; i += 3) for (let k = 0; k < 3; k++) {
    if (new Set(triangles.slice(i, i + 3).map((vertex) => at[vertex])).size < 3) break;  // a sliver at a pole
    const a = triangles[i + k], b = triangles[i + ((k + 1) % 3)], key = at[a] < at[b] ? `${at[a]} ${at[b]}` : `${at[b]} ${at[a]}`;
    if (open.has(key)) edges.push([a, b, open.get(key), i]); else open.set(key, i);
  }
  return edges;
}
// The edges where the body turns away from the eye, and so ends for it: pairs of vertices.
function silhouette(mesh, clip_from_object) {
  const [X, Y, , W] = clip_from_object, { triangles } = mesh, seen = mesh.points.map(([x, y, z]) => {
    const w = W[0] * x + W[1] * y + W[2] * z + W[3];
    return [(X[0] * x + X[1] * y + X[2] * z + X[3]) / w, (Y[0] * x + Y[1] * y + Y[2] * z + Y[3]) / w];
  });
  const areas = new Float64Array(triangles.length);
  for (let i = 0; i < triangles.length; i += 3) {
    const a = seen[triangles[i]], b = seen[triangles[i + 1]], c = seen[triangles[i + 2]];
    areas[i] = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  }
  return mesh.edges.flatMap(([a, b, first, second]) => (areas[first] > 0 !== areas[second] > 0 ? [a, b] : []));
}
const built = {};
function meshOf(shape) {
  if (!built[shape]) {
    const mesh = MESHES[shape](), triples = (flat) => Array.from({ length: flat.length / 3 }, (_, i) => flat.slice(3 * i, 3 * i + 3));
    const points = triples(mesh.positions);
    built[shape] = { ...mesh, shape, points, directions: triples(mesh.normals), edges: edgesOf(points, mesh.triangles) };
  }
  return built[shape];
}
