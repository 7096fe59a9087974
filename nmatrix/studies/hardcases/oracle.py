"""The catalogue's own exact arithmetic, by textbook formulas, so that a fault of ours cannot hide.

It shares no code with what it judges: determinants by permutations, systems by elimination,
angles and roots by integers. A is a 3×3 matrix of fractions, C its cofactor matrix.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from itertools import permutations
from math import atan2, isqrt, pi, prod

Numbers = Sequence[Fraction]
Rows = Sequence[Sequence[Fraction]]

ROOT_BITS = 200


def exact_rows(rows: Iterable[Iterable[float]]) -> list[list[Fraction]]:
    """Convert floats to fractions, exactly."""
    return [[Fraction(entry) for entry in row] for row in rows]


def determinant(A: Rows) -> Fraction:
    """Return Σ sign(p) · a₁ₚ₁ ⋯ aₙₚₙ over all permutations p.

    Examples
    --------
    >>> determinant([[Fraction(1), Fraction(2)], [Fraction(3), Fraction(4)]])
    Fraction(-2, 1)
    """
    places = range(len(A))
    terms = (_parity(p) * _product(A[i][p[i]] for i in places) for p in permutations(places))
    return sum(terms, Fraction(0))


def _product(factors: Iterable[Fraction]) -> Fraction:
    return prod(factors, start=Fraction(1))


def _parity(p: Sequence[int]) -> int:
    inversions = sum(p[i] > p[j] for i in range(len(p)) for j in range(i + 1, len(p)))
    return -1 if inversions % 2 else 1


def true_normal(A: Rows, n: Numbers) -> tuple[Fraction, ...] | None:
    """Return a multiple of the transformed normal with the right sense, or None for none.

    sign(det A) · C n, each cofactor a signed minor; +C n for rank 2.
    """
    sense = -1 if determinant(A) < 0 else 1
    found = tuple(
        sum((sense * _cofactor(A, i, j) * n[j] for j in range(3)), Fraction(0)) for i in range(3)
    )
    return found if any(found) else None


def _cofactor(A: Rows, i: int, j: int) -> Fraction:
    minor = [[A[r][c] for c in range(3) if c != j] for r in range(3) if r != i]
    return determinant(minor) if (i + j) % 2 == 0 else -determinant(minor)


def solve(A: Rows, b: Numbers) -> tuple[Fraction, ...]:
    """Return x with A x = b by Gauss and Jordan, for an invertible A.

    Examples
    --------
    >>> [int(x) for x in solve([[Fraction(0), Fraction(2)], [Fraction(1), Fraction(0)]], [6, 5])]
    [5, 3]
    """
    rows = [[*row, Fraction(right)] for row, right in zip(A, b, strict=True)]
    for i in range(len(rows)):
        pivot = next(r for r in range(i, len(rows)) if rows[r][i])
        rows[i], rows[pivot] = rows[pivot], rows[i]
        rows[i] = [entry / rows[i][i] for entry in rows[i]]
        for r in range(len(rows)):
            if r != i:
                factor = rows[r][i]
                rows[r] = [x - factor * y for x, y in zip(rows[r], rows[i], strict=True)]
    return tuple(row[-1] for row in rows)


def root(x: Fraction) -> Fraction:
    """Return √x to a relative 2⁻²⁰⁰, however small or large x is."""
    bits = ROOT_BITS + max(0, x.denominator.bit_length() - x.numerator.bit_length())
    return Fraction(isqrt((x.numerator << 2 * bits) // x.denominator), 1 << bits)


def angle(a: Numbers, b: Numbers) -> float:
    """Return the angle between two vectors in radians, to a few units of the last place.

    Examples
    --------
    >>> angle([Fraction(1), Fraction(0), Fraction(0)], [Fraction(0), Fraction(-2), Fraction(0)])
    1.5707963267948966
    """
    cross = [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]
    sine, cosine = sum(x * x for x in cross), sum(x * y for x, y in zip(a, b, strict=True))
    if not cosine:
        return pi / 2
    tangent = float(min(root(sine / cosine**2), Fraction(10) ** 300))
    return atan2(tangent, 1.0) if cosine > 0 else pi - atan2(tangent, 1.0)
