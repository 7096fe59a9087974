"""The kind of map that a matrix is, decided exactly on the given floats and again to rounding.

A is the 3×3 block, G = AᵀA. A itself transforms normals rightly when G = s²I; a matrix built from
a rotation by 30° fulfils that to rounding only, and both facts are worth knowing.

λ₁ ≥ λ₂ ≥ λ₃ are the eigenvalues of G, the squared singular values; κ = σ₁/σ₃. A singular value
decomposition in float64 loses κ beyond 1e16 and κ − 1 below 1e-16; what is done here loses neither,
since λ₁ − λ₃ and λ₃ each come from an exact characteristic polynomial of their own.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from decimal import MAX_EMAX, MIN_EMIN, Context, Decimal, localcontext
from fractions import Fraction
from functools import cached_property, lru_cache
from math import acos, atan, cos, degrees, inf, nextafter

from nmatrix.enums import Kind
from nmatrix.linear.angle import DEGREES, arctangent
from nmatrix.linear.exact import Integers, LinearMap
from nmatrix.linear.rational import (
    RationalMatrix,
    RationalVector,
    RoundedMatrix,
    linear_part,
    rational_matrix,
    translation,
)
from nmatrix.linear.rounding import nearest, short_text
from nmatrix.report import Displayed, Quantity, Report

BUILT = 1e-12  # columns of a matrix built from angles agree to a few 1e-16; room for products
FROM_FILE = 1e-6  # float32 files: 6e-8 a component, room for products

DIGITS = 130  # a triple root costs two thirds of them
SETTLED = Decimal(10) ** -90
LOST = 1e-12  # of the trace: what is left of a smaller eigenvalue in floats is not enough
# The platform's own limits: what fits 64 bits is refused where decimals have 32.
CONTEXT = Context(prec=DIGITS, Emax=MAX_EMAX, Emin=MIN_EMIN)

RIGID_KINDS = {Kind.IDENTITY, Kind.TRANSLATION, Kind.ROTATION, Kind.RIGID}
SETTLED_KINDS = RIGID_KINDS | {Kind.SINGULAR}  # no digits make more of them, and rank is exact
ALWAYS_EXACT = {Kind.SHEAR, Kind.SINGULAR}  # what no tolerance makes more special
_NEEDS_INVERSE_TRANSPOSE = {Kind.NON_UNIFORM_SCALE, Kind.SHEAR, Kind.SINGULAR}


@dataclass(frozen=True)
class Classification(Displayed):
    """The kind of one map, with the numbers that belong to it.

    `kind` is to the digits given, `kind_as_typed` that of the very floats to rounding, and
    `kind_exact` says whether `kind` holds on them without any tolerance.
    """

    kind: Kind
    kind_as_typed: Kind
    kind_exact: bool
    linear_map: LinearMap

    def _repr_report_(self) -> Report:
        """Tell the kind of map, its determinant, its rank and its condition."""
        return Report.of_value(
            Quantity("transform", self.kind.value.replace("-", " "), "kind"),
            Quantity("determinant", self.linear_map.determinant, "determinant"),
            Quantity("rank", self.rank, "rank"),
            Quantity("condition", self.condition_text, "condition σ₁/σ₃"),
        )

    @property
    def determinant_sign(self) -> int:
        """Return the exact sign of the determinant."""
        return self.linear_map.determinant_sign

    @property
    def mirrored(self) -> bool:
        """True if the map turns left hands into right hands."""
        return self.determinant_sign < 0

    @property
    def rank(self) -> int:
        """Return the exact rank of the 3×3 block."""
        return self.linear_map.rank

    @property
    def needs_inverse_transpose(self) -> bool:
        """True if A itself would bend normals."""
        return self.kind in _NEEDS_INVERSE_TRANSPOSE

    @property
    def is_rigid(self) -> bool:
        """True if lengths and angles stay as they are."""
        return self.kind in RIGID_KINDS

    @cached_property
    def condition(self) -> Fraction | None:
        """Return κ = σ₁/σ₃, or None for a singular map."""
        kappa = condition(self.linear_map)
        return None if kappa is None else Fraction(kappa)

    @property
    def condition_text(self) -> str:
        """Return κ in four digits, also where it is beyond every float; ∞ for a singular map.

        Where these would be 1 and κ is not, what is above 1 is written by itself.
        """
        return condition_text(self.linear_map)

    @cached_property
    def worst_angle_deg(self) -> float | None:
        """Return the largest angle that A n can be wrong by, in degrees."""
        return worst_angle_deg(self.linear_map)


def classify(
    rows: Sequence[Sequence[float | Fraction]],
    tolerance: float | Fraction = BUILT,
    stands_for: RationalMatrix | None = None,
) -> Classification:
    """Classify a 3×3 or an affine 4×4 matrix by the kind of map that it is.

    Rank and mirroring are exact. Lengths and angles of the columns may be off by `tolerance`
    (relative); `kind_exact` says whether the kind holds without it. Rows that were rounded have the
    kind of what they stand for: `stands_for`, or else the most special map that rounds to them.

    Examples
    --------
    >>> found = classify([[0, 2, 0], [2, 0, 0], [0, 0, 2]])
    >>> found.kind.value, found.kind_exact, found.mirrored
    ('similarity', True, True)
    """
    A = rational_matrix(rows)
    offset = translation(A) if len(A) == 4 else (Fraction(0),) * 3
    linear_map = LinearMap.of(linear_part(A))
    as_typed = _kind(linear_map, offset, Fraction(tolerance))
    exact = as_typed if as_typed in ALWAYS_EXACT else _kind(linear_map, offset, Fraction(0))
    kind = as_typed
    if as_typed not in SETTLED_KINDS:
        if isinstance(rows, RoundedMatrix) and stands_for is None:
            from nmatrix.linear.rounded import meant  # most matrices are exact

            stands_for = meant(rows)
        if stands_for is not None:
            kind = _kind(LinearMap.of(linear_part(stands_for)), offset, Fraction(tolerance))
    return Classification(kind, as_typed, kind is exact, linear_map)


def _kind(linear_map: LinearMap, offset: RationalVector, tau: Fraction) -> Kind:
    if linear_map.rank < 3:
        return Kind.SINGULAR
    G = linear_map.gram
    if not _orthogonal(G, tau):
        return Kind.SHEAR
    squares = [G[i][i] for i in range(3)]
    # τ = p/q, and everything is compared in integers: it takes a fourth of the time.
    below, above = tau.denominator**2, (tau.denominator + tau.numerator) ** 2
    if max(squares) * below > above * min(squares):
        return Kind.NON_UNIFORM_SCALE
    one = linear_map.denominator**2
    if max(squares) * below > above * one or one * below > above * min(squares):
        return Kind.SIMILARITY
    if _is_identity(linear_map, tau):
        return Kind.TRANSLATION if any(offset) else Kind.IDENTITY
    return Kind.RIGID if any(offset) else Kind.ROTATION


def _orthogonal(G: Integers, tau: Fraction) -> bool:
    p, q = tau.numerator**2, tau.denominator**2
    pairs = ((0, 1), (0, 2), (1, 2))
    return all(q * G[i][j] ** 2 <= p * (G[i][i] * G[j][j]) for i, j in pairs)


def _is_identity(linear_map: LinearMap, tau: Fraction) -> bool:
    one, most = linear_map.denominator, tau.numerator * linear_map.denominator
    return all(
        abs(entry - one * (i == j)) * tau.denominator <= most
        for i, row in enumerate(linear_map.entries)
        for j, entry in enumerate(row)
    )


def condition(linear_map: LinearMap) -> Decimal | None:
    """Compute κ = σ₁/σ₃ to 30 digits and more; None for a singular map.

    Examples
    --------
    >>> print(condition(LinearMap.of([[1, 0, 0], [0, 2, 0], [0, 0, 1]])).normalize())
    2
    """
    if linear_map.rank < 3:
        return None
    with localcontext(CONTEXT):
        return (1 + _excess(linear_map)).sqrt()


def condition_text(linear_map: LinearMap) -> str:
    """Write κ in four digits, ∞ for a singular map; next to 1, what is above 1 by itself."""
    found = condition(linear_map)
    if found is None:
        return "∞"
    kappa = Fraction(found)
    short = short_text(kappa, 4)
    return f"1 + {short_text(kappa - 1, 3)}" if short == "1" != str(kappa) else short


def most_excess(linear_map: LinearMap) -> float:
    """Bound κ² − 1 from above, fast, by Gershgorin's discs around the entries of AᵀA.

    It is far too large for a shear, and sharp where A is all but a turn; infinite where the discs
    reach 0. What A itself does to a normal is at most half of it, in radians.

    Examples
    --------
    >>> most_excess(LinearMap.of([[2, 0, 0], [0, 2, 0], [0, 0, 2]]))
    0.0
    """
    G = linear_map.gram
    around = [sum(abs(G[i][j]) for j in range(3) if j != i) for i in range(3)]
    high = max(G[i][i] + around[i] for i in range(3))
    low = min(G[i][i] - around[i] for i in range(3))
    if low <= 0 or high > low << 1000:
        return inf
    return nextafter(nearest(Fraction(high - low, low)), inf) if high > low else 0.0


def worst_angle_deg(linear_map: LinearMap) -> float | None:
    """Compute the largest angle between A n and the right normal, over all n, in degrees.

    It is arctan((κ − 1/κ)/2), reached for n halfway between the directions that A stretches most
    and least; a map of rank 2 reaches 90°; below that there is no normal to compare with.

    Examples
    --------
    >>> round(worst_angle_deg(LinearMap.of([[1, 0, 0], [0, 2, 0], [0, 0, 1]])), 12)
    36.869897645844
    """
    if linear_map.rank < 3:
        return 90.0 if linear_map.rank == 2 else None
    with localcontext(CONTEXT):
        excess = _excess(linear_map)
        tangent = excess / (2 * (1 + excess).sqrt())
    return nearest(arctangent(Fraction(tangent)) * DEGREES)


def near_worst_angle_deg(linear_map: LinearMap) -> float:
    """Compute the worst angle to a millionth of a degree, fast: to put many maps in order.

    λ₁ comes from Viète's cosine, in floats; λ₂ + λ₃ and λ₂ λ₃ from it and from the exact trace and
    determinant. Where λ₃ is lost to rounding, and of a singular map, it is the exact angle; 90° of
    a map of rank 1 or 0.

    Examples
    --------
    >>> round(near_worst_angle_deg(LinearMap.of([[1, 0, 0], [0, 2, 0], [0, 0, 1]])), 6)
    36.869898
    """
    if linear_map.rank < 3:
        return 90.0
    G = linear_map.gram
    t = G[0][0] + G[1][1] + G[2][2]
    (a, d, e), (_, b, f), (_, _, c) = ([entry / t for entry in row] for row in G)
    a, b, c = a - 1 / 3, b - 1 / 3, c - 1 / 3
    spread = ((a * a + b * b + c * c) / 6 + (d * d + e * e + f * f) / 3) ** 0.5
    if spread < LOST:
        return 0.0
    half = (a * (b * c - f * f) - d * (d * c - f * e) + e * (d * f - b * e)) / (2 * spread**3)
    largest = 1 / 3 + 2 * spread * cos(acos(max(-1.0, min(1.0, half))) / 3)
    total, product = 1 - largest, linear_map.integer_determinant**2 / t**3 / largest
    if total < LOST or product < LOST * total:
        return worst_angle_deg(linear_map) or 90.0
    smallest = 2 * product / (total + max(0.0, total * total - 4 * product) ** 0.5)
    kappa = max(1.0, (largest / smallest) ** 0.5)
    return degrees(atan((kappa - 1 / kappa) / 2))


@lru_cache(maxsize=1)  # κ and the worst angle of one map are asked for one after the other
def _excess(linear_map: LinearMap) -> Decimal:
    """Return κ² − 1 = (λ₁ − λ₃)/λ₃, to 30 digits of itself, however small it is."""
    G = linear_map.gram
    largest, spread = _largest_and_spread(G)
    if 2 * spread <= largest:  # then their difference loses no digit
        return spread / (largest - spread)
    # λ³ − t λ² + m λ − d = 0; y = (d/m)/λ for the smallest root.
    t = Decimal(G[0][0] + G[1][1] + G[2][2])
    m = Decimal(_principal_minors(G))
    d = Decimal(linear_map.integer_determinant) ** 2
    y = _largest_root(t * d / m**2, d * d / m**3)
    return spread * y * m / d


def _largest_and_spread(G: Integers) -> tuple[Decimal, Decimal]:
    """Return λ₁ and λ₁ − λ₃ from D = 3 G − t, whose eigenvalues are 3 λ − t and have the sum 0.

    They solve e³ − p e − q = 0; with e = √p x that is x³ − x − q/√p³ = 0, where nothing is small.
    """
    t = G[0][0] + G[1][1] + G[2][2]
    D = [[3 * G[i][j] - t * (i == j) for j in range(3)] for i in range(3)]
    p = sum(entry * entry for row in D for entry in row) // 2
    if p == 0:
        return Decimal(t) / 3, Decimal(0)
    root = Decimal(p).sqrt()
    x = _largest_depressed_root(Decimal(LinearMap.of(D).integer_determinant) / root**3)
    spread = root * (3 * x + max(Decimal(0), 4 - 3 * x * x).sqrt()) / 6
    return (t + root * x) / 3, spread


def _largest_depressed_root(r: Decimal) -> Decimal:
    """Return the largest root of x³ − x − r, all of whose roots are real.

    Newton's iteration from 2/√3, the largest value it can have, comes down to it.
    """
    x = 2 / Decimal(3).sqrt()
    for _ in range(400):
        value, slope = (x * x - 1) * x - r, 3 * x * x - 1
        if value <= 0 or slope <= 0:
            break
        step = value / slope
        x -= step
        if step < x * SETTLED:
            break
    return x


def _principal_minors(G: Integers) -> int:
    return sum(G[i][i] * G[j][j] - G[i][j] ** 2 for i, j in ((0, 1), (0, 2), (1, 2)))


def _largest_root(b: Decimal, c: Decimal) -> Decimal:
    """Return the largest root of x³ − x² + b x − c, whose roots are real, positive, of sum 1.

    Laguerre's iteration from 1 comes down to it and never passes it, where not all three agree.
    """
    x = Decimal(1)
    for _ in range(400):
        value = ((x - 1) * x + b) * x - c
        slope = (3 * x - 2) * x + b
        if value <= 0 or slope <= 0:
            break
        curvature = 6 * x - 2
        inside = max(Decimal(0), 2 * (2 * slope * slope - 3 * value * curvature))
        step = 3 * value / (slope + inside.sqrt())
        x -= step
        if step < x * SETTLED:
            break
    return x
