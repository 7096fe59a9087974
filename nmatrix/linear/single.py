"""Normal matrices of a few maps in Python's own floats: bit for bit those of the arrays.

A call of NumPy takes as long as thirty products of Python, and a batch takes some thirty calls. So
a few matrices are faster one by one. Every operation is one of `plain` or `compensated`, and in the
same order. What takes more than that is left to the arrays: entries outside of the windows, where a
matrix is scaled first, and results outside of the range of their type.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import copysign

from nmatrix.enums import Level, NormalMatrixKind
from nmatrix.linear import compensated, plain
from nmatrix.linear.compensated import AFTER, NEXT, SPLITTER, UNIT
from nmatrix.linear.rounding import integers

FEW = 12  # matrices, of which so many are faster one by one

# Where the entries of both products of a cofactor are among the nine, row by row.
MINORS = tuple(
    (3 * NEXT[i] + NEXT[j], 3 * AFTER[i] + AFTER[j], 3 * NEXT[i] + AFTER[j], 3 * AFTER[i] + NEXT[j])
    for i in range(3)
    for j in range(3)
)


def normal_matrix(A: Sequence[float], kind: NormalMatrixKind, level: Level) -> list[float] | None:
    """Compute sign(det A)·C or C/det A of nine entries; None where that is left to the arrays.

    Examples
    --------
    >>> normal_matrix([-1, 0, 0, 0, 2, 0, 0, 0, 4], NormalMatrixKind.ORIENTED, Level.CERTIFIED)
    [-8.0, 0.0, 0.0, 0.0, 4.0, 0.0, 0.0, 0.0, 2.0]
    """
    if level is Level.GUARDED:
        if not lies_within(plain.SMALLEST, plain.LARGEST, A):
            return None
        found = _plain(A, kind)
        if found is not None:
            return found
    if not lies_within(compensated.SMALLEST, compensated.LARGEST, A):
        return None
    return _certified(A, kind)


def lies_within(least: float, most: float, values: Sequence[float]) -> bool:
    """Check that every value is 0 or has its size between two limits."""
    for x in values:  # noqa: SIM110  all() takes a third longer
        if not (least <= x <= most or least <= -x <= most or x == 0):
            return False
    return True


def _plain(A: Sequence[float], kind: NormalMatrixKind) -> list[float] | None:
    """Compute as `plain` does; None for a doubtful matrix."""
    first = [A[i] * A[j] - A[k] * A[m] for i, j, k, m in MINORS[:3]]
    det = A[0] * first[0] + A[1] * first[1] + A[2] * first[2]
    largest = max(*A, -min(A))
    if not abs(det) > largest * largest * largest * plain.STEEP:
        return None
    factor = copysign(1.0, det) if kind is NormalMatrixKind.ORIENTED else 1.0 / det
    A = [A[0] * factor, A[1] * factor, A[2] * factor, *A[3:]]
    found = [x * factor + 0.0 for x in first]
    found += [A[i] * A[j] - A[k] * A[m] + 0.0 for i, j, k, m in MINORS[3:]]
    return found


def _certified(A: Sequence[float], kind: NormalMatrixKind) -> list[float] | None:
    """Compute as `compensated` does; None for the inverse transpose of a singular matrix."""
    C = _cofactors(A)
    if kind is NormalMatrixKind.INVERSE_TRANSPOSE:
        det = determinant(A)
        return [x / det + 0.0 for x in C] if det else None
    terms = A[0] * C[0], A[1] * C[1], A[2] * C[2]
    det = terms[0] + terms[1] + terms[2]
    if not abs(det) > 8 * UNIT * (abs(terms[0]) + abs(terms[1]) + abs(terms[2])):
        det = determinant(A)
    return [0.0 - x for x in C] if det < 0 else [x + 0.0 for x in C]


def _cofactors(A: Sequence[float]) -> list[float]:
    halves = []
    for x in A:
        big = SPLITTER * x
        high = big - (big - x)
        halves.append((x, high, x - high))
    found = []
    for i, j, k, m in MINORS:
        (a, a_high, a_low), (d, d_high, d_low) = halves[i], halves[j]
        (b, b_high, b_low), (c, c_high, c_low) = halves[k], halves[m]
        p, q = a * d, b * c
        rest = a_high * d_high - p + a_high * d_low + a_low * d_high + a_low * d_low
        rest -= b_high * c_high - q + b_high * c_low + b_low * c_high + b_low * c_low
        found.append(p - q + rest)
    return found


def determinant(A: Sequence[float]) -> float:
    """Compute the determinant of nine entries within the window, correctly rounded.

    Examples
    --------
    >>> determinant([1.0, 0, 0, 0, 3.0, 0, 0, 0, 0.5])
    1.5
    """
    (a, b, c, d, e, f, g, h, i), denominator = integers(A)
    whole = a * (e * i - f * h) + b * (f * g - d * i) + c * (d * h - e * g)
    return whole / denominator**3
