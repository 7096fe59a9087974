"""The condition number and the worst angle, from the exact characteristic polynomial.

G = AᵀA; its eigenvalues are the squared singular values; κ = σ₁/σ₃. A singular value
decomposition in float64 loses κ beyond 1e16; decimals of `DIGITS` digits do not.
"""

from __future__ import annotations

from collections.abc import Sequence
from decimal import Context, Decimal, localcontext
from math import atan2, degrees

from nmatrix.linear.exact import LinearMap

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
        return _condition_squared(linear_map).sqrt()


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
        squared = _condition_squared(linear_map)
        opposite, adjacent = squared - 1, 2 * squared.sqrt()
        larger = max(opposite, adjacent)
        return degrees(atan2(float(opposite / larger), float(adjacent / larger)))


def _condition_squared(linear_map: LinearMap) -> Decimal:
    G = gram(linear_map)
    if _is_multiple_of_identity(G):
        return Decimal(1)
    # λ³ − t λ² + m λ − d = 0; x = λ/t for the largest root, y = (d/m)/λ for the smallest.
    t = Decimal(G[0][0] + G[1][1] + G[2][2])
    m = Decimal(_principal_minors(G))
    d = Decimal(linear_map.integer_determinant) ** 2
    x = _largest_root(m / t**2, d / t**3)
    y = _largest_root(t * d / m**2, d * d / m**3)
    return max(Decimal(1), t * x * y * m / d)


def _is_multiple_of_identity(G: Sequence[Sequence[int]]) -> bool:
    equal = G[0][0] == G[1][1] == G[2][2]
    return equal and G[0][1] == G[0][2] == G[1][2] == 0


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
