// What a state means: its matrices, its camera, the right normals, and those of the mistake.
const STUCK = "stuck";  // the mistake that is no rule for normals: the light is left in the model
const SYMBOLS = { none: "A", cofactor: "C", "not-transposed": "A<sup>−1</sup>", "not-inverted": "A<sup>T</sup>", exact: "A<sup>−T</sup>" };
const MISTAKES = { ...data.rules, [STUCK]: "a light left in the model" };
const lightOf = (s) => AXES.map((axis) => s["l" + axis]);
const lampOf = (s) => (data.has_position ? AXES.map((axis) => s["p" + axis]) : null);

// A rule's matrix for normals under B, a whole matrix, or null where it has no answer.
function ruleMatrix(rule, B, isFlat) {
  if (rule === "none") return floatsOf(B);
  if (rule === "cofactor") return cofactor(B);
  if (rule === "not-inverted") return transpose(floatsOf(B));
  if (rule === "not-transposed") return isFlat ? null : transpose(inverseTranspose(B));
  return isFlat ? cofactor(B) : inverseTranspose(B);
}
function spaceFromWorld(space, found) {
  if (space === "camera") return found.camera;
  if (space === "object") return found.rank < 3 ? null : inverse4(found.M, found.whole);
  if (space === "light") {
    const from = found.lamp || [0, 0, 0], along = data.has_direction ? wholes(found.light)[0] : wholeDifference(data.target, from);
    return along.some((x) => x) ? lookingAlong(from, along, data.up) : null;
  }
  return space === "custom" ? data.custom_from_world : identity4;
}

// --- The camera: it turns about what it looks at, and steps back where the body would not fit -----
const ROOM = 1.36;  // of the body's radius, for arrows
function radius(mesh, M) { return Math.max(1e-9, ...mesh.points.map((p) => length(minus(point(M, p), data.target)))); }
function cameraOf(s, reach) {
  if (!data.looks) {
    const V = data.camera_from_world, B = linear(V), up = unit(data.up);
    const turned = times(about(apply(inverse3(B), [1, 0, 0]), s.tilt), about(up, s.yaw));
    const back = affine(transpose(turned), [0, 0, 0]), camera = s.yaw || s.tilt ? times(V, back) : V;
    return { camera, eye: apply(turned, data.eye) };
  }
  const away = minus(data.eye, data.target), up = unit(data.up);
  const yawed = apply(about(up, s.yaw), away), side = cross(up, yawed);
  let turned = yawed;
  if (side.some((x) => x)) {
    const rise = (Math.atan2(dot(yawed, up), length(side)) * 180) / Math.PI;  // never over the pole
    turned = apply(about(side, -Math.max(-88, Math.min(88, rise + s.tilt)) + rise), yawed);
  }
  const isPerspective = data.clip_from_camera[3][2] !== 0;
  const half = Math.atan(1 / Math.max(Math.abs(data.clip_from_camera[0][0]), Math.abs(data.clip_from_camera[1][1])));
  const needed = isPerspective ? (ROOM * reach) / Math.sin(half) : 0, given = length(away);
  const far = data.fits && isPerspective ? needed : Math.max(given, needed);
  // What is not moved keeps the eye's own numbers; else decimals, which the command repeats.
  const isMoved = s.yaw || s.tilt || far !== given;
  const decimals = Math.min(100, Math.max(4, 4 - Math.floor(Math.log10(far))));
  const eye = isMoved ? plus(data.target, turned, far / given).map((x) => rounded(x, decimals)) : data.eye;
  return { camera: lookingAlong(eye, wholeDifference(data.target, eye), data.up), eye };
}

function meaning(s, reach) {
  const mesh = meshOf(s.shape), exact = worldLinear(s), M = worldMatrix(s, exact), A = linear(M), scale = scaleOf(s);
  const rank = scale.filter((x) => x !== 0).length, isFlat = rank < 3;
  const det = isFlat ? 0 : determinant(exact), C = cofactor(exact), sign = isFlat ? 1 : orientation(exact);
  const found = { mesh, M, A, whole: exact, rank, isFlat, det, C, sign, scale, light: lightOf(s), lamp: lampOf(s) };
  found.reach = Math.max(reach, radius(mesh, M));
  Object.assign(found, cameraOf(s, found.reach));
  found.clip_from_world = times(data.clip_from_camera, found.camera);
  found.N = isFlat ? null : ruleMatrix("exact", exact, false);
  found.right = normalDirections(exact, sign);
  found.S = spaceFromWorld(s.space, found);
  found.isRigid = !isFlat && norm(minus2(times(transpose(A), A), identity3)) < 1e-12;
  const even = scaled(A, Math.sqrt(3) / norm(A));  // before squares, which can leave the floats
  found.isConformal = !isFlat && norm(minus2(times(transpose(even), even), identity3)) < 1e-12;
  const rule = s.rule === STUCK ? "exact" : s.rule;
  // What the rule makes of normals in the space of shading, brought back to the world by Bᵀ.
  found.wrong = null;
  if (rule === "exact") found.wrong = found.right;
  else if (s.space === "object") found.wrong = isFlat ? null : found.right;
  else if (found.S) {
    const B = linear(found.S), W = ruleMatrix(rule, wholeTimes(whole(B), exact), isFlat);
    found.wrong = W && times(transpose(B), W);
  }
  found.isRight = s.rule !== STUCK && (s.space === "object" || (rule === "cofactor" && isFlat));
  found.stuckLight = s.rule === STUCK && data.has_direction ? apply(A, found.light) : null;
  found.stuckLamp = s.rule === STUCK && found.lamp ? point(M, found.lamp) : null;
  return Object.assign(found, errorOf(s, found));
}
// A rule that is wrong stays so where a map hides it: equal pictures are told by their sign between.
const verdictOf = (side, found) => (side === "wrong" && !found.isRight ? "wrong" : "right");
const minus2 = (A, B) => A.map((row, i) => minus(row, B[i]));

// By how much the mistake is off, as one number: degrees between normals, or between lights.
function errorOf(s, found) {
  if (s.rule === STUCK) {
    const own = data.has_direction ? found.light : found.lamp, carried = apply(found.A, own), from = [data.has_direction ? own : minus(own, placeOf(s)), carried];
    if (!length(from[0]) || !(length(carried) > 1e-12 * norm(found.A) * length(own))) return { largest: null, isSame: false };
    const largest = angleBetween(unit(from[0]), unit(from[1]), false);
    return { largest: largest < 1e-9 ? 0 : largest, isSame: largest < 1e-9 && !(found.lamp && length(minus(found.stuckLamp, found.lamp)) > 1e-9) };
  }
  if (!found.wrong || found.rank < 2) return { largest: null, isSame: false };
  if (s.rule === "cofactor" && s.space !== "object") {  // (S A)'s cofactors are det S · Sᵀ⁻¹ C: only the sign can differ
    const isTurned = !found.isFlat && orientation(whole(linear(found.S))) * found.sign < 0;
    return { largest: isTurned ? 180 : 0, isSame: !isTurned };
  }
  const largest = worstAngle(found.wrong, found.right, found.mesh.directions, found.mesh.isSmooth, found.isFlat);
  return { largest, isSame: largest === 0 };
}
// How bright a matte surface is at a point of the world, by a light that may be where it is not.
function towardsLight(found, isStuck, p) {
  if (data.has_direction) return unit((isStuck ? found.stuckLight : found.light).map((x) => -x));
  return unit(minus(isStuck ? found.stuckLamp : found.lamp, p));
}
function brightnessError(found) {
  if (!found.stuckLight && !found.stuckLamp) return 0;
  let worst = 0;
  for (let i = 0; i < found.mesh.points.length; i++) {
    const n = unit(apply(found.right, found.mesh.directions[i])), p = point(found.M, found.mesh.points[i]);
    const [a, b] = [false, true].map((isStuck) => Math.max(0, dot(n, towardsLight(found, isStuck, p))));
    worst = Math.max(worst, Math.abs(a - b));
  }
  return worst;
}
