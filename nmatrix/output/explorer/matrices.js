// Matrices as nmatrix has them: column vectors, M = T·R·S·H with R = Rx·Ry·Rz, arrays of rows. Cofactors,
// determinants, inverses and cameras are exact for the floats that they are given, and rounded once.
const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const plus = (a, b, t = 1) => a.map((x, i) => x + t * b[i]);
const minus = (a, b) => plus(a, b, -1);
const length = (v) => Math.hypot(...v);
const unit = (v) => { const long = length(v); return long ? v.map((x) => x / long) : v; };
const transpose = (A) => A[0].map((_, j) => A.map((row) => row[j]));
const times = (A, B) => { const columns = transpose(B); return A.map((row) => columns.map((c) => dot(row, c))); };
const apply = (A, v) => A.map((row) => dot(row, v));
const point = (M, p) => [0, 1, 2].map((i) => M[i][0] * p[0] + M[i][1] * p[1] + M[i][2] * p[2] + M[i][3]);
const linear = (M) => M.slice(0, 3).map((row) => row.slice(0, 3));
const affine = (A, t) => [...A.map((row, i) => [...row, t[i]]), [0, 0, 0, 1]];
const scaled = (A, s) => A.map((row) => row.map((x) => x * s));
const identity3 = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
const identity4 = affine(identity3, [0, 0, 0]);
const norm = (A) => length(A.flat());
const AXES = ["x", "y", "z"];
const rounded = (x, digits) => Number(x.toFixed(digits));

// --- Floats as whole numbers times a power of two -------------------------------------------------------
const memory = new DataView(new ArrayBuffer(8));
function parts(x) {
  memory.setFloat64(0, x);
  const bits = memory.getBigUint64(0), power = Number((bits >> 52n) & 2047n), top = (bits & (2n ** 52n - 1n)) | (power ? 2n ** 52n : 0n);
  return [x < 0 ? -top : top, Math.max(power, 1) - 1075];
}
// Floats as whole numbers over one power of two.
function wholes(floats) {
  const all = floats.map(parts), power = Math.min(0, ...all.filter(([top]) => top).map(([, own]) => own));
  return [all.map(([top, own]) => (top ? top << BigInt(own - power) : 0n)), power];
}
const bitsOf = (n) => n.toString(2).length;
// The float nearest to top / bottom · 2^power: the last bit even where two are as near.
function nearest(top, bottom = 1n, power = 0) {
  if (top === 0n || bottom === 0n) return top ? Infinity : 0;
  const isNegative = top < 0n !== bottom < 0n, a = top < 0n ? -top : top, b = bottom < 0n ? -bottom : bottom;
  const over = (shift) => (shift >= 0 ? [a << BigInt(shift), b] : [a, b << BigInt(-shift)]);
  let high = bitsOf(a) - bitsOf(b);
  const [x, y] = over(-high);
  if (x < y) high -= 1;
  const unit = Math.max(high + power - 52, -1074), [p, q] = over(power - unit), rest = 2n * (p % q);
  let digits = p / q;
  if (rest > q || (rest === q && digits & 1n)) digits += 1n;
  return (isNegative ? -1 : 1) * Number(digits) * 2 ** unit;
}
const wholeCross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
function whole(A) {
  const [flat, power] = wholes(A.flat());
  return { rows: [0, 3, 6].map((i) => flat.slice(i, i + 3)), power };
}
const wholeDot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0n);
const wholeTimes = (A, B) => { const columns = transpose(B.rows); return { rows: A.rows.map((row) => columns.map((c) => wholeDot(row, c))), power: A.power + B.power }; };
const wholeCofactors = ({ rows: [a, b, c] }) => [wholeCross(b, c), wholeCross(c, a), wholeCross(a, b)];
const wholeDeterminant = ({ rows: [a, b, c] }) => wholeDot(a, wholeCross(b, c));
const size = (x) => (x < 0n ? -x : x);
const mostBits = (all) => Math.max(...all.map((x) => bitsOf(size(x))));
const rounding = (rows, bottom, power) => rows.map((row) => row.map((x) => nearest(x, bottom, power)));
// Of whole matrices, each entry rounded once.
const floatsOf = (A) => rounding(A.rows, 1n, A.power);
const cofactor = (A) => rounding(wholeCofactors(A), 1n, 2 * A.power);
const determinant = (A) => nearest(wholeDeterminant(A), 1n, 3 * A.power);
const orientation = (A) => (wholeDeterminant(A) < 0n ? -1 : 1);
const inverseTranspose = (A) => rounding(wholeCofactors(A), wholeDeterminant(A), -A.power);
const inverse3 = (A) => transpose(inverseTranspose(whole(A)));
// A positive multiple of sign · C, with a largest entry near 1: by the sign of det A, a positive multiple of A⁻ᵀ too.
function normalDirections(A, sign) { const C = wholeCofactors(A); return rounding(C, BigInt(sign), -mostBits(C.flat())); }
function inverse4(M, A = whole(linear(M))) {
  const det = wholeDeterminant(A), back = transpose(wholeCofactors(A)), [t, power] = wholes(M.slice(0, 3).map((row) => row[3]));
  return affine(rounding(back, det, -A.power), back.map((row) => nearest(-wholeDot(row, t), det, power - A.power)));
}
function wholeDifference(a, b) {
  const [all] = wholes([...a, ...b]);
  return [0, 1, 2].map((i) => all[i] - all[i + 3]);
}

// Exact at quarter turns; else of the angle to the nearest one, which is known exactly.
function turn(degrees) {
  const quarters = Math.round((degrees % 360) / 90), angle = (((degrees % 360) - 90 * quarters) * Math.PI) / 180;
  const [s, c] = angle ? [Math.sin(angle), Math.cos(angle)] : [0, 1];
  return [[s, c], [c, -s], [-s, -c], [-c, s]][((quarters % 4) + 4) % 4].map((x) => x + 0);  // + 0: no −0
}
function rotations(x, y, z) {
  const [sx, cx] = turn(x), [sy, cy] = turn(y), [sz, cz] = turn(z);
  return [[[1, 0, 0], [0, cx, -sx], [0, sx, cx]], [[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]], [[cz, -sz, 0], [sz, cz, 0], [0, 0, 1]]];
}
function about(axis, degrees) {
  const [s, c] = turn(degrees), [x, y, z] = unit(axis), t = 1 - c;
  return [
    [t * x * x + c, t * x * y - s * z, t * x * z + s * y],
    [t * x * y + s * z, t * y * y + c, t * y * z - s * x],
    [t * x * z - s * y, t * y * z + s * x, t * z * z + c],
  ];
}
const scaleOf = (s) => AXES.map((axis) => s["s" + axis] * (s["m" + axis] ? -1 : 1));
const placeOf = (s) => AXES.map((axis) => s[`t${axis}`]);
function factors(s) {
  const [x, y, z] = scaleOf(s);
  return [...rotations(s.rx, s.ry, s.rz), [[x, 0, 0], [0, y, 0], [0, 0, z]], [[1, s.hxy, s.hxz], [0, 1, s.hyz], [0, 0, 1]]];
}
// A is the exact product of its factors' floats, and M holds it rounded.
const worldLinear = (s) => factors(s).map(whole).reduce(wholeTimes);
const worldMatrix = (s, A = worldLinear(s)) => affine(floatsOf(A), placeOf(s));
// A camera at an eye that looks along whole numbers, in which differences of places and cross products are exact.
function lookingAlong(eye, forward, up) {
  const [upright] = wholes(up);
  let right = wholeCross(forward, upright);
  if (!right.some((x) => x)) {
    const axis = size(forward[2]) <= size(forward[1]) ? 2 : 1;
    right = wholeCross(forward, [0, 1, 2].map((i) => BigInt(i === axis)));
    if (right.find((x) => x) < 0n) right = right.map((x) => -x);
  }
  const [place, power] = wholes(eye), rows = [right, wholeCross(right, forward), forward.map((x) => -x)].map((way) => {
    const largest = mostBits(way), floats = way.map((x) => nearest(x, 1n, -largest)), long = length(floats);
    return [...floats.map((x) => x / long), nearest(-wholeDot(way, place), 1n, power - largest) / long];
  });
  return [...rows, [0, 0, 0, 1]];
}

// How far the rule's normals are off: the largest angle between W n and N n over all directions n.
// With two sides a normal and its opposite are one. Where the directions are few, they are all.
function angleBetween(a, b, twoSided) {
  const across = length(cross(a, b)), along = dot(a, b);
  return (Math.atan2(across, twoSided ? Math.abs(along) : along) * 180) / Math.PI;
}
function worstAngle(W, N, normals, isSmooth, twoSided) {
  const at = (n) => {
    const a = apply(W, n), b = apply(N, n);
    return length(a) > 1e-12 * norm(W) && length(b) > 1e-12 * norm(N) ? angleBetween(unit(a), unit(b), twoSided) : 0;
  };
  let worst = 0, where = null;
  for (const n of normals) { const angle = at(n); if (angle > worst) [worst, where] = [angle, n]; }
  if (!isSmooth || !where || worst < 1e-9) return worst < 1e-9 ? 0 : worst;
  // A round body has every direction: climb from the best vertex to the top of the hill.
  for (let step = 0.05; step > 1e-9;) {
    const side = unit(cross(where, Math.abs(where[0]) < 0.7 ? [1, 0, 0] : [0, 1, 0])), other = cross(where, side);
    let climbed = false;
    for (const [a, b] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
      const next = unit(plus(plus(where, side, a * step), other, b * step)), angle = at(next);
      if (angle > worst) { [worst, where, climbed] = [angle, next, true]; break; }
    }
    if (!climbed) step /= 2;
  }
  return worst;
}

// --- Fractions, for what the sliders give in decimals ----------------------------------------
const gcd = (a, b) => { while (b) [a, b] = [b, a % b]; return a < 0n ? -a : a; };
class Fraction {
  constructor(top, bottom = 1n) {
    const shared = (gcd(top, bottom) || 1n) * (bottom < 0n ? -1n : 1n);
    this.top = top / shared; this.bottom = bottom / shared;
  }
  static of(x) {
    const [digits, exponent = "0"] = String(x).split("e"), [whole, rest = ""] = digits.split(".");
    const power = Number(exponent) - rest.length, number = BigInt(whole + rest);
    return power < 0 ? new Fraction(number, 10n ** BigInt(-power)) : new Fraction(number * 10n ** BigInt(power));
  }
  static ofWhole(top, power) { return power < 0 ? new Fraction(top, 1n << BigInt(-power)) : new Fraction(top << BigInt(power)); }
  plus(o) { return new Fraction(this.top * o.bottom + o.top * this.bottom, this.bottom * o.bottom); }
  minus(o) { return new Fraction(this.top * o.bottom - o.top * this.bottom, this.bottom * o.bottom); }
  times(o) { return new Fraction(this.top * o.top, this.bottom * o.bottom); }
  over(o) { return new Fraction(this.top * o.bottom, this.bottom * o.top); }
  get isZero() { return this.top === 0n; }
  get nearest() { return nearest(this.top, this.bottom); }
  toString() { return `${this.top < 0n ? "−" : ""}${this.top < 0n ? -this.top : this.top}${this.bottom === 1n ? "" : `/${this.bottom}`}`; }
}
const asFractions = (A) => A.rows.map((row) => row.map((x) => Fraction.ofWhole(x, A.power)));
const exactTimes = (A, B) => A.map((row) => B[0].map((_, j) => row.reduce((sum, x, i) => sum.plus(x.times(B[i][j])), new Fraction(0n))));
const exactCross = (a, b) => [[1, 2], [2, 0], [0, 1]].map(([i, j]) => a[i].times(b[j]).minus(a[j].times(b[i])));
const exactCofactor = (A) => [exactCross(A[1], A[2]), exactCross(A[2], A[0]), exactCross(A[0], A[1])];
// A in fractions, or null where an angle is no quarter turn: its sine is no fraction then.
function exactLinear(s) {
  if ([s.rx, s.ry, s.rz].some((angle) => angle % 90 !== 0)) return null;
  return factors(s).map((A) => A.map((row) => row.map(Fraction.of))).reduce(exactTimes);
}
const exactDeterminant = (A) => A[0].reduce((sum, x, i) => sum.plus(x.times(exactCofactor(A)[0][i])), new Fraction(0n));
// A rule's matrix for normals, or null where it has no answer; floats may round what is flat to what is not.
function exactRule(rule, A, isFlat) {
  const C = exactCofactor(A), det = exactDeterminant(A);
  const divided = (B) => (isFlat || det.isZero ? null : B.map((row) => row.map((x) => x.over(det))));
  return { none: A, cofactor: C, "not-inverted": transpose(A), "not-transposed": divided(transpose(C)), exact: divided(C) }[rule];
}
const arithmetic = {
  AXES, point, transpose, times, apply, linear, whole, wholes, nearest, cofactor, determinant, inverseTranspose, inverse3, inverse4, unit, turn,
  about, lookingAlong, wholeDifference, worldMatrix, angleBetween,
  Fraction, asFractions, exactLinear, exactDeterminant, exactCofactor, exactRule,
};
