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
  return { positions, normals, triangles };
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

// The letter is the one of the proofs; its tacks stand in the middle of its faces and walls.
function letterR() {
  const front = [[-0.42, 0.62], [-0.42, -0.6], [0.24, -0.62], [0.5, 0.44]], [bowl, slope] = [Math.SQRT1_2, unit([0.88, 0.54, 0])];
  const tacks = [1, -1].flatMap((side) => front.map((p) => [[...p, 0.24 * side], [0, 0, side]]));
  return {
    ...data.letter, isSmooth: false,
    tacks: [...tacks, [[-0.42, 1, 0], [0, 1, 0]], [[-0.62, 0, 0], [-1, 0, 0]], [[0.12 + 0.56 * bowl, 0.44 + 0.56 * bowl, 0], [bowl, bowl, 0]],
      [[0.39, -0.56, 0], slope], [[0.46, -1, 0], [0, -1, 0]]],
  };
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
// The edges at which a body is sharp: its two faces there are more than 22° apart.
function creasesOf(points, triangles, edges) {
  const faceNormal = (i) => { const [a, b, c] = [0, 1, 2].map((k) => points[triangles[i + k]]); return unit(cross(minus(b, a), minus(c, a))); };
  return edges.flatMap(([a, b, first, second]) => (dot(faceNormal(first), faceNormal(second)) < turn(22)[1] ? [a, b] : []));
}
// The edges where the body turns away from the eye, and so ends for it: pairs of vertices.
let outlined = {};  // both views and the map share the lines of one frame
function silhouette(mesh, clip_from_object) {
  if (outlined.from === clip_from_object) return outlined.lines;
  const [X, Y, , W] = clip_from_object, { triangles } = mesh, seen = mesh.points.map(([x, y, z]) => {
    const w = W[0] * x + W[1] * y + W[2] * z + W[3];
    return [(X[0] * x + X[1] * y + X[2] * z + X[3]) / w, (Y[0] * x + Y[1] * y + Y[2] * z + Y[3]) / w];
  });
  const areas = new Float64Array(triangles.length);
  for (let i = 0; i < triangles.length; i += 3) {
    const a = seen[triangles[i]], b = seen[triangles[i + 1]], c = seen[triangles[i + 2]];
    areas[i] = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  }
  const lines = mesh.edges.flatMap(([a, b, first, second]) => (areas[first] > 0 !== areas[second] > 0 ? [a, b] : []));
  outlined = { from: clip_from_object, lines };
  return lines;
}
const built = {};
function meshOf(shape) {
  if (!built[shape]) {
    const mesh = MESHES[shape](), triples = (flat) => Array.from({ length: flat.length / 3 }, (_, i) => flat.slice(3 * i, 3 * i + 3));
    const points = triples(mesh.positions), edges = edgesOf(points, mesh.triangles);
    built[shape] = { ...mesh, shape, points, directions: triples(mesh.normals), edges, creases: creasesOf(points, mesh.triangles, edges) };
  }
  return built[shape];
}
