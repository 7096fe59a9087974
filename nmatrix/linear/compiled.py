"""Normal matrices in one compiled loop over the batch: bit for bit those of the arrays.

NumPy takes a pass over memory for each of a hundred operations; a compiled loop takes one for all.
Numba compiles these functions when they are first called, without fused or reordered sums, so every
operation rounds as in `plain` and `compensated`. What they scale, or decide by exact sums, is
left to the arrays. Nothing imports this module before `NMATRIX_COMPILED` asks for it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ParamSpec, TypeVar, cast

import numba
import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import Level, NormalMatrixKind
from nmatrix.linear import compensated, plain
from nmatrix.linear.certified import PAIRS
from nmatrix.linear.compensated import SPLITTER, UNIT

Array = NDArray[Any]
Nine = tuple[float, float, float, float, float, float, float, float, float]
P = ParamSpec("P")
R = TypeVar("R")

FLOATS = (np.dtype(np.float32), np.dtype(np.float64))
WINDOW = compensated.SMALLEST, compensated.LARGEST
PLAIN_WINDOW = plain.SMALLEST, plain.LARGEST
STEEP = plain.STEEP


def compiled(function: Callable[P, R]) -> Callable[P, R]:
    """Compile a function when it is first called, and keep the result for later processes."""
    made = numba.njit(function, cache=True, nogil=True, error_model="numpy")
    return cast("Callable[P, R]", made)


def write(A: Array, out: Array, kind: NormalMatrixKind, level: Level) -> Array:
    """Write normal matrices (N, 3, 3) into `out`; return the places that are left as they were.

    Both are float32 or float64 in the byte order of this machine.
    """
    limits = np.finfo(out.dtype)
    is_left = np.zeros(len(A), np.bool_)
    is_oriented = kind is NormalMatrixKind.ORIENTED
    range_of_type = float(limits.tiny), float(limits.max)
    _write_all(A, (out, is_left), level is Level.GUARDED, is_oriented, range_of_type)
    return np.flatnonzero(is_left)


@compiled
def _write_all(
    A: Array,
    written: tuple[Array, Array],
    is_guarded: bool,  # noqa: FBT001  a compiled function takes no keywords cheaply
    is_oriented: bool,  # noqa: FBT001
    range_of_type: tuple[float, float],
) -> None:
    out, is_left = written
    for t in range(len(A)):
        M = A[t]
        entries: Nine = (
            np.float64(M[0, 0]), np.float64(M[0, 1]), np.float64(M[0, 2]),
            np.float64(M[1, 0]), np.float64(M[1, 1]), np.float64(M[1, 2]),
            np.float64(M[2, 0]), np.float64(M[2, 1]), np.float64(M[2, 2]),
        )  # fmt: skip
        found, is_settled = entries, False
        if is_guarded and _lie_within(PLAIN_WINDOW, entries):
            is_settled, found = _plain(entries, is_oriented)
        if not is_settled and _lie_within(PLAIN_WINDOW if is_guarded else WINDOW, entries):
            is_settled, found = _certified(entries, is_oriented)
        if is_settled and _lie_within(range_of_type, found):
            for i in range(9):
                out[t, i // 3, i % 3] = found[i]
        else:
            is_left[t] = True


@compiled
def _lie_within(limits: tuple[float, float], values: Nine) -> bool:
    """Check that every value is 0 or has its size between two limits."""
    least, most = limits
    for x in values:
        size = abs(x)
        if not (least <= size <= most or size == 0):
            return False
    return True


@compiled
def _plain(A: Nine, is_oriented: bool) -> tuple[bool, Nine]:  # noqa: FBT001
    """Compute as `plain` does; False for a doubtful matrix."""
    a, b, c, d, e, f, g, h, i = A
    x, y, z = e * i - f * h, f * g - d * i, d * h - e * g
    det = a * x + b * y + c * z
    largest = 0.0
    for entry in A:
        largest = max(largest, abs(entry))
    factor = np.copysign(1.0, det) if is_oriented else 1.0 / det
    a, b, c = a * factor, b * factor, c * factor
    found = (
        x * factor + 0.0, y * factor + 0.0, z * factor + 0.0,
        h * c - i * b + 0.0, i * a - g * c + 0.0, g * b - h * a + 0.0,
        b * f - c * e + 0.0, c * d - a * f + 0.0, a * e - b * d + 0.0,
    )  # fmt: skip
    return abs(det) > largest * largest * largest * STEEP, found


@compiled
def _certified(A: Nine, is_oriented: bool) -> tuple[bool, Nine]:  # noqa: FBT001
    """Compute as `compensated` does; False where the determinant takes exact sums."""
    a, b, c, d, e, f, g, h, i = A
    C = (
        _difference(e, i, f, h), _difference(f, g, d, i), _difference(d, h, e, g),
        _difference(h, c, i, b), _difference(i, a, g, c), _difference(g, b, h, a),
        _difference(b, f, c, e), _difference(c, d, a, f), _difference(a, e, b, d),
    )  # fmt: skip
    if is_oriented:
        x, y, z = a * C[0], b * C[1], c * C[2]
        det = x + y + z
        is_settled = abs(det) > 8 * UNIT * (abs(x) + abs(y) + abs(z))
        det = np.copysign(1.0, det)
    else:
        is_settled, det = _determinant(A)
        is_settled &= det != 0
    return is_settled, (
        C[0] / det + 0.0, C[1] / det + 0.0, C[2] / det + 0.0,
        C[3] / det + 0.0, C[4] / det + 0.0, C[5] / det + 0.0,
        C[6] / det + 0.0, C[7] / det + 0.0, C[8] / det + 0.0,
    )  # fmt: skip


@compiled
def _determinant(A: Nine) -> tuple[bool, float]:
    """Sum three products in pairs of floats; False where the last bit takes exact sums."""
    a, b, c, d, e, f, g, h, i = A
    high, low, size = 0.0, 0.0, 0.0
    for entry, p, q, r, s in ((a, e, i, f, h), (b, f, g, d, i), (c, d, h, e, g)):
        first, first_rest = _two_product(p, q)
        other, other_rest = _two_product(r, s)
        value, rest = _two_sum(first, -other)
        term, term_rest = _two_product(value, entry)
        high, total_rest = _two_sum(high, term)
        low += total_rest + term_rest + (rest + (first_rest - other_rest)) * entry
        size += (abs(first) + abs(other)) * abs(entry)
    total, rest = _two_sum(high, low)
    error = 2 * PAIRS * size
    return total + (rest - error) == total and total + (rest + error) == total, total


@compiled
def _difference(a: float, d: float, b: float, c: float) -> float:
    """Compute a·d − b·c within 2u."""
    p, p_rest = _two_product(a, d)
    q, q_rest = _two_product(b, c)
    return (p - q) + (p_rest - q_rest)


@compiled
def _two_product(a: float, b: float) -> tuple[float, float]:
    product = a * b
    a_high, a_low = _halves(a)
    b_high, b_low = _halves(b)
    return product, a_high * b_high - product + a_high * b_low + a_low * b_high + a_low * b_low


@compiled
def _two_sum(a: float, b: float) -> tuple[float, float]:
    total = a + b
    other = total - a
    return total, (a - (total - other)) + (b - other)


@compiled
def _halves(a: float) -> tuple[float, float]:
    big = SPLITTER * a
    high = big - (big - a)
    return high, a - high
