"""The condition number and the worst angle, from exact characteristic polynomials.

G = AᵀA; its eigenvalues λ₁ ≥ λ₂ ≥ λ₃ are the squared singular values; κ = σ₁/σ₃. A singular value
decomposition in float64 loses κ beyond 1e16 and κ − 1 below 1e-16; what is done here loses neither,
since λ₁ − λ₃ and λ₃ each come from a polynomial of their own.
"""

from __future__ import annotations

from collections.abc import Sequence
from decimal import Context, Decimal, localcontext
from fractions import Fraction

from nmatrix.linear.angle import PI
from nmatrix.linear.arctangent import arctangent
from nmatrix.linear.exact import LinearMap
from nmatrix.linear.rounding import nearest

DIGITS = 130  # a triple root costs two thirds of them
SETTLED = Decimal(10) ** -90
CONTEXT = Context(prec=DIGITS, Emax=10**9, Emin=-(10**9))


def gram(linear_map: LinearMap) -> list[list[int]]:
    """Return AᵀA of the integer entries: lengths and angles of the columns of A."""
    columns = list(zip(*linear_map.entries, strict=True))
    return [[sum(x * y for x, y in zip(p, q, strict=True)) for q in columns] for p in columns]


def condition(linear_map: LinearMap) -> Decimal | None:
    """Return κ = σ₁/σ₃ to 30 digits and more, or None for a singular map.

    Examples
    --------
    >>> print(condition(LinearMap.of([[1, 0, 0], [0, 2, 0], [0, 0, 1]])).normalize())
    2
    """
    if linear_map.rank < 3:
        return None
    with localcontext(CONTEXT):
        return (1 + _excess(linear_map)).sqrt()


def worst_angle_deg(linear_map: LinearMap) -> float | None:
    """Return the largest angle between A n and the right normal, over all n, in degrees.

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
    return nearest(arctangent(Fraction(tangent)) * 180 / PI)


def _excess(linear_map: LinearMap) -> Decimal:
    """Return κ² − 1 = (λ₁ − λ₃)/λ₃, to 30 digits of itself, however small it is."""
    G = gram(linear_map)
    # λ³ − t λ² + m λ − d = 0; y = (d/m)/λ for the smallest root.
    t = Decimal(G[0][0] + G[1][1] + G[2][2])
    m = Decimal(_principal_minors(G))
    d = Decimal(linear_map.integer_determinant) ** 2
    y = _largest_root(t * d / m**2, d * d / m**3)
    return _spread(G) * y * m / d


def _spread(G: Sequence[Sequence[int]]) -> Decimal:
    """Return λ₁ − λ₃ from D = 3 G − t, whose eigenvalues are 3 λ − t and have the sum 0.

    They solve e³ − p e − q = 0; with e = √p x that is x³ − x − q/√p³ = 0, where nothing is small.
    """
    t = G[0][0] + G[1][1] + G[2][2]
    D = [[3 * G[i][j] - t * (i == j) for j in range(3)] for i in range(3)]
    p = sum(entry * entry for row in D for entry in row) // 2
    if p == 0:
        return Decimal(0)
    root = Decimal(p).sqrt()
    x = _largest_depressed_root(Decimal(LinearMap.of(D).integer_determinant) / root**3)
    return root * (3 * x + max(Decimal(0), 4 - 3 * x * x).sqrt()) / 6


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


def _principal_minors(G: Sequence[Sequence[int]]) -> int:
    return sum(G[i][i] * G[j][j] - G[i][j] ** 2 for i, j in ((0, 1), (0, 2), (1, 2)))


def _largest_root(b: Decimal, c: Decimal) -> Decimal:
    """Return the largest root of x³ − x² + b x − c, whose roots are real, positive, of sum 1.

    Laguerre's iteration from 1 comes down to it and never passes it, however close the roots are.
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
