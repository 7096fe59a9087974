// Matrices in double precision, and exact where they are fractions. They mirror nmatrix: column
// vectors, M = T·R·S·H with R = Rx·Ry·Rz, matrices as arrays of rows.
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
const cofactor = (A) => [cross(A[1], A[2]), cross(A[2], A[0]), cross(A[0], A[1])];
const determinant = (A) => dot(A[0], cross(A[1], A[2]));
const scaled = (A, s) => A.map((row) => row.map((x) => x * s));
const inverse3 = (A) => scaled(transpose(cofactor(A)), 1 / determinant(A));
const inverse4 = (M) => { const A = inverse3(linear(M)); return affine(A, apply(A, M.slice(0, 3).map((row) => -row[3]))); };
const identity3 = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
const identity4 = affine(identity3, [0, 0, 0]);
const norm = (A) => length(A.flat());
const AXES = ["x", "y", "z"];
const LARGEST = 1e6;  // a number of the state beyond it is none
const rounded = (x, digits) => Number(x.toFixed(digits));

// Exact at quarter turns, where a sine of floats would leave 6e-17.
function turn(degrees) {
  const d = ((degrees % 360) + 360) % 360;
  if (d % 90 === 0) return [[0, 1, 0, -1][d / 90], [1, 0, -1, 0][d / 90]];
  return [Math.sin((d * Math.PI) / 180), Math.cos((d * Math.PI) / 180)];
}
function rotation(x, y, z) {
  const [sx, cx] = turn(x), [sy, cy] = turn(y), [sz, cz] = turn(z);
  return times(times([[1, 0, 0], [0, cx, -sx], [0, sx, cx]], [[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]]),
    [[cz, -sz, 0], [sz, cz, 0], [0, 0, 1]]);
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
function worldMatrix(s) {
  const [x, y, z] = scaleOf(s);
  const H = [[1, s.hxy, s.hxz], [0, 1, s.hyz], [0, 0, 1]];
  return affine(times(times(rotation(s.rx, s.ry, s.rz), [[x, 0, 0], [0, y, 0], [0, 0, z]]), H), placeOf(s));
}
function lookingAlong(eye, forward, up) {
  let right = cross(forward, up);
  if (!right.some((x) => x)) {
    const axis = Math.abs(forward[2]) <= Math.abs(forward[1]) ? 2 : 1;
    right = cross(forward, [0, 1, 2].map((i) => Number(i === axis)));
    if (right.find((x) => x) < 0) right = right.map((x) => -x);
  }
  const rows = [right, cross(right, forward), forward.map((x) => -x)].map(unit);
  return affine(rows, rows.map((row) => -dot(row, eye)));
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
  plus(o) { return new Fraction(this.top * o.bottom + o.top * this.bottom, this.bottom * o.bottom); }
  minus(o) { return new Fraction(this.top * o.bottom - o.top * this.bottom, this.bottom * o.bottom); }
  times(o) { return new Fraction(this.top * o.top, this.bottom * o.bottom); }
  over(o) { return new Fraction(this.top * o.bottom, this.bottom * o.top); }
  get isZero() { return this.top === 0n; }
  toString() { return `${this.top < 0n ? "−" : ""}${this.top < 0n ? -this.top : this.top}${this.bottom === 1n ? "" : `/${this.bottom}`}`; }
}
const exactTimes = (A, B) => A.map((row) => B[0].map((_, j) => row.reduce((sum, x, i) => sum.plus(x.times(B[i][j])), new Fraction(0n))));
const exactCross = (a, b) => [[1, 2], [2, 0], [0, 1]].map(([i, j]) => a[i].times(b[j]).minus(a[j].times(b[i])));
const exactCofactor = (A) => [exactCross(A[1], A[2]), exactCross(A[2], A[0]), exactCross(A[0], A[1])];
// A in fractions, or null where an angle is no quarter turn: its sine is no fraction then.
function exactLinear(s) {
  if ([s.rx, s.ry, s.rz].some((angle) => angle % 90 !== 0)) return null;
  const [x, y, z] = scaleOf(s), of = (A) => A.map((row) => row.map(Fraction.of));
  return [of([[x, 0, 0], [0, y, 0], [0, 0, z]]), of([[1, s.hxy, s.hxz], [0, 1, s.hyz], [0, 0, 1]])].reduce(exactTimes, of(rotation(s.rx, s.ry, s.rz)));
}
const exactDeterminant = (A) => A[0].reduce((sum, x, i) => sum.plus(x.times(exactCofactor(A)[0][i])), new Fraction(0n));
function exactRule(rule, A) {
  const C = exactCofactor(A), det = exactDeterminant(A);
  const divided = (B) => (det.isZero ? null : B.map((row) => row.map((x) => x.over(det))));
  return { none: A, cofactor: C, "not-inverted": transpose(A), "not-transposed": divided(transpose(C)), exact: divided(C) }[rule];
}
const arithmetic = {
  AXES, point, transpose, times, apply, linear, cofactor, determinant, inverse3, inverse4, unit, rotation, about, lookingAlong, worldMatrix, angleBetween,
  Fraction, exactLinear, exactDeterminant, exactCofactor, exactRule,
};
