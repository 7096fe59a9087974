"""Determinants of many maps and normals through them, each with its error proved as it is made.

Three levels, each asked only about what the one before could not settle:

1. compensated cofactors and a plain sum: the angle is within 5u·‖|C||n|‖/‖Cn‖;
2. products as pairs of floats: within 2⁻¹⁰⁰·‖P|n|‖/‖Cn‖, where P holds |ad| + |bc|;
3. exact sums of all the floats in the products, or whole numbers: correctly rounded.

A is (3, 3, N), n is (3, N). A power of two that multiplies a matrix changes no bit of a normal.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import fsum
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import NormalStatus
from nmatrix.linear.compensated import (
    SMALLEST,
    UNIT,
    Expansion,
    Scaled,
    cofactors,
    minor_products,
    outside_window,
    two_product,
    two_sum,
)
from nmatrix.linear.exact import LinearMap

Array = NDArray[Any]

TOLERANCE = 1e-14  # radians
NORMALISING = 4 * UNIT  # what bringing a vector to length one adds
CORRECTLY_ROUNDED = 2 * UNIT  # half a unit in each of three components
PAIRS = 2.0**-100
UNDERFLOW = 2.0**-1000  # more than all that products of pairs lose below the normal numbers
STATUSES = tuple(NormalStatus)
OK, TWO_SIDED, UNDEFINED = range(len(STATUSES))
ROWS = range(3)
NEVER = np.iinfo(np.int32).min // 2  # the exponent of zero


class Normals(NamedTuple):
    """Unit normals (3, N), zero where there is none; their places in `STATUSES`; their bounds."""

    directions: Array
    status: Array
    bound_rad: Array


def certified_normals(A: Array, n: Array) -> Normals:
    """Carry normals (3, N) through one map each, or through one for all: sign(det A)·C·n.

    Every angle is within its bound, and every bound within `TOLERANCE`.

    Parameters
    ----------
    A
        (3, 3, N), or (3, 3, 1) for all normals.

    Examples
    --------
    >>> found = certified_normals(np.diag([1.0, 2, 1])[:, :, None], np.array([[1.0], [1], [0]]))
    >>> found.directions.ravel().round(6).tolist(), bool(found.bound_rad[0] < 2e-15)
    ([0.894427, 0.447214, 0.0], True)
    """
    C = cofactors(A)
    sign = np.broadcast_to(determinant_signs(A, C), n.shape[1])
    carried, bound = _summed(C, n)
    A = np.broadcast_to(A, (3, 3, n.shape[1]))
    left = np.flatnonzero(~(bound <= TOLERANCE))
    if len(left):
        left = _settle(A, n, left, (carried, bound))
    directions = np.where(sign < 0, -1.0, 1.0) * carried
    directions /= np.sqrt((carried * carried).sum(axis=0))
    directions += 0.0  # no zero is negative
    status = np.where(sign == 0, TWO_SIDED, OK).astype(np.int8)
    nothing = ~carried.any(axis=0)
    directions[:, nothing], status[nothing] = 0.0, UNDEFINED
    for i in left.tolist():
        found = LinearMap.of(A[:, :, i].tolist()).normal(n[:, i].tolist())
        directions[:, i] = found.direction or (0.0, 0.0, 0.0)
        status[i], bound[i] = STATUSES.index(found.status), CORRECTLY_ROUNDED
    return Normals(directions, status, bound)


def _settle(A: Array, n: Array, places: Array, found: tuple[Array, Array]) -> Array:
    """Write C·n and its bound by pairs of floats, then by exact sums; find the places left."""
    carried, bound = found
    some, _, of_one_size = _largest_near_one(A[:, :, places])
    normals = np.ldexp(n[:, places], -np.frexp(np.abs(n[:, places]).max(axis=0))[1])
    by_pairs, some, normals = places[of_one_size], some[:, :, of_one_size], normals[:, of_one_size]
    carried[:, by_pairs], bound[by_pairs] = _summed_in_pairs(some, normals)
    exactly = ~(bound[by_pairs] <= TOLERANCE) & ~outside_window(np.abs(normals)[None])
    if exactly.any():
        by_sums, some, normals = by_pairs[exactly], some[:, :, exactly], normals[:, exactly]
        rows = _rows_exactly(some, ROWS, normals)
        carried[:, by_sums] = np.ldexp(rows, -np.frexp(np.abs(rows).max(axis=0))[1])
        bound[by_sums] = CORRECTLY_ROUNDED + NORMALISING
    return places[~(bound[places] <= TOLERANCE)]


def determinant_signs(A: Array, C: Scaled) -> Array:
    """Compute the exact signs of determinants: −1, 0 or 1.

    Expanded along a row, det = Σ aⱼ Cⱼ; three terms within 3u each, added up: 6u of their sizes.
    Pairs of floats, then whole numbers, decide where that is not enough.
    """
    terms = _terms(Scaled(C.mantissa[0], C.exponent[0]), A[0])
    total = terms[0] + terms[1] + terms[2]
    sign = np.sign(total)
    size = np.abs(terms).sum(axis=0)
    unsure = np.flatnonzero(~((np.abs(total) > 8 * UNIT * size) | (size == 0)))
    if len(unsure):
        some, _, of_one_size = _largest_near_one(A[:, :, unsure])
        (high, low), error = _rows_in_pairs(some, (0,), some[0])
        total = (high + low)[0]
        sign[unsure] = np.sign(total)
        unsure = unsure[~((np.abs(total) > 2 * error[0]) & of_one_size)]
    if len(unsure):
        sign[unsure] = np.sign(determinants(A[:, :, unsure]).mantissa)
    return np.asarray(sign)


def determinants(A: Array) -> Scaled:
    """Compute determinants, correctly rounded.

    Pairs of floats settle those that are no tie within their error, exact sums the others.

    Examples
    --------
    >>> found = determinants(np.diag([2.0, 2, 0.5])[:, :, None])
    >>> np.ldexp(*found).tolist()
    [2.0]
    """
    some, power, of_one_size = _largest_near_one(A)
    (high, low), error = _rows_in_pairs(some, (0,), some[0])
    (total,), (rest,) = two_sum(high, low)
    error = error[0]
    is_settled = (total + (rest - 2 * error) == total) & (total + (rest + 2 * error) == total)
    exactly = np.flatnonzero(of_one_size & ~is_settled)
    if len(exactly):
        total[exactly] = _rows_exactly(some[:, :, exactly], (0,), some[0][:, exactly])[0]
    mantissa, exponent = np.frexp(total)
    exponent += 3 * power
    for i in np.flatnonzero(~of_one_size).tolist():
        exact = LinearMap.of(A[:, :, i].tolist())
        bits = exact.integer_determinant.bit_length()
        mantissa[i] = exact.integer_determinant / (1 << bits)
        exponent[i] = bits - 3 * (exact.denominator.bit_length() - 1)
    return Scaled(mantissa, exponent)


def _largest_near_one(A: Array) -> tuple[Array, Array, Array]:
    """Scale matrices to a largest entry in [½, 1), unless all are within the window as they are.

    Returns them, the powers of two taken out, and where every entry is 0 or ≥ 2⁻²⁴⁰ then.
    """
    count = A.shape[2]
    size = np.abs(A)
    power = np.frexp(size.max(axis=(0, 1)))[1]
    size[size == 0] = np.inf
    least = size.min(axis=(0, 1))
    if least.min(initial=np.inf) >= SMALLEST and power.max(initial=0) <= 240:
        return A, np.zeros(count, np.int32), np.ones(count, bool)
    return np.ldexp(A, -power), power, np.asarray(np.ldexp(least, -power) >= SMALLEST)


def _terms(C: Scaled, n: Array) -> Array:
    """Multiply cofactors (…, 3, N) by components (3, N), at one scale for each of the N.

    What becomes too small for a float beside the largest is below every bound that is taken here.
    """
    if not C.exponent.any() and not _leaves_window(n):
        return np.asarray(C.mantissa * n)
    of_n, power = np.frexp(n)
    of_C, more = np.frexp(C.mantissa)
    mantissa, exponent = of_C * of_n, more + C.exponent + power
    exponent = np.where(mantissa == 0, NEVER, exponent)
    axes = tuple(range(exponent.ndim - 1))
    return np.asarray(np.ldexp(mantissa, np.maximum(exponent - exponent.max(axis=axes), -1000)))


def _leaves_window(n: Array) -> bool:
    return bool(outside_window(np.abs(n)[None]).any())


def _summed(C: Scaled, n: Array) -> tuple[Array, Array]:
    """Compute C·n up to a scale for each column, and the bound on its angle; 0 for no direction."""
    terms = _terms(C, n)
    carried = terms[:, 0] + terms[:, 1]
    carried += terms[:, 2]
    size = np.abs(terms).sum(axis=1)
    largest = np.abs(carried).max(axis=0)
    scale = np.where(largest > 0, largest, 1.0)
    bound = _angle_bound(5.01 * UNIT, size / scale, carried / scale)
    bound[~size.any(axis=0)] = 0.0  # every term is zero, and so is their sum
    return carried / scale, bound


def _angle_bound(relative: float, size: Array, carried: Array) -> Array:
    """Bound asin of error over length, and add what normalising adds; infinite where unknown."""
    ratio = relative * np.sqrt((size * size).sum(axis=0) / (carried * carried).sum(axis=0))
    ratio = np.where(np.isfinite(ratio) & (ratio < 0.5), ratio, np.inf)
    return np.asarray(ratio * 1.05 + NORMALISING)  # asin x ≤ 1.05 x below ½


def _summed_in_pairs(A: Array, n: Array) -> tuple[Array, Array]:
    """Compute C·n with every number held as two floats, and the bound on its angle."""
    (high, low), errors = _rows_in_pairs(A, ROWS, n)
    carried = high + low
    errors += UNDERFLOW
    power = np.frexp(np.abs(carried).max(axis=0))[1]
    carried, errors = np.ldexp(carried, -power), np.ldexp(errors, -power)
    return carried, _angle_bound(1.0, errors, carried)


def _rows_in_pairs(A: Array, rows: Sequence[int], n: Array) -> tuple[Expansion, Array]:
    """Compute rows of C·n in pairs of floats, and bound the errors."""
    high, low, size = (np.zeros((len(rows), A.shape[2])) for _ in range(3))
    for j in range(3):
        p, q = minor_products(A, rows, j)
        value = two_sum(p.high, -q.high)
        rest = value.low + (p.low - q.low)
        term = two_product(value.high, n[j])
        total = two_sum(high, term.high)
        high = total.high
        low = low + (total.low + term.low + rest * n[j])
        size += (np.abs(p.high) + np.abs(q.high)) * np.abs(n[j])
    return Expansion(high, low), PAIRS * size


def _rows_exactly(A: Array, rows: Sequence[int], n: Array) -> Array:
    """Compute rows of C·n correctly rounded, if the entries and components are of one size.

    Every product is the sum of 8 floats, and `fsum` rounds once.
    """
    parts: list[Array] = []
    for j in range(3):
        p, q = minor_products(A, rows, j)
        for factor in (p.high, p.low, -q.high, -q.low):
            parts += two_product(factor, n[j])
    sums = map(fsum, zip(*(part.ravel().tolist() for part in parts), strict=True))
    return np.array(list(sums)).reshape(len(rows), A.shape[2])
