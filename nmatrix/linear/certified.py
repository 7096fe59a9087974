"""Normals of many surfaces through many maps, each with a bound on its error, proved as it is made.

Three levels, each asked only about what the one before could not settle:

1. compensated cofactors and a plain sum: the angle is within 5u·‖|C||n|‖/‖Cn‖;
2. products as pairs of floats: within 2⁻¹⁰⁰·‖P|n|‖/‖Cn‖, where P holds |ad| + |bc|;
3. whole numbers, correctly rounded.

Signs of determinants are certified likewise, and settled by whole numbers where a float cannot
tell. A is (3, 3, N), n is (3, N).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import NormalStatus
from nmatrix.linear.compensated import (
    LARGEST,
    SMALLEST,
    UNIT,
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
STATUSES = (NormalStatus.OK, NormalStatus.TWO_SIDED, NormalStatus.UNDEFINED)
NEVER = np.iinfo(np.int32).min // 2  # the exponent of zero


@dataclass(frozen=True, eq=False)
class CertifiedNormals:
    """Unit normals (3, N), zero where there is none, and what is known about them.

    Parameters
    ----------
    bound_rad
        (N,) the angle to the true normal is at most this.
    status
        (N,) index into `STATUSES`.
    determinant_sign
        (N,) the exact sign.
    by_pairs, by_integers
        How many the second and the third level settled.
    """

    normals: Array
    bound_rad: Array
    status: Array
    determinant_sign: Array
    by_pairs: int
    by_integers: int


def certified_normals(A: Array, n: Array, tolerance: float = TOLERANCE) -> CertifiedNormals:
    """Carry one normal through each map: sign(det A)·C·n at length one.

    Examples
    --------
    >>> found = certified_normals(np.diag([1.0, 2, 1])[:, :, None], np.array([[1.0], [1], [0]]))
    >>> found.normals.ravel().round(6).tolist(), bool(found.bound_rad[0] < 2e-15)
    ([0.894427, 0.447214, 0.0], True)
    """
    C = cofactors(A)
    sign, sure = determinant_signs(A, C)
    carried, bound = _summed(C, n)
    by_pairs = np.flatnonzero(~(bound <= tolerance) & ~outside_window(A))
    if len(by_pairs):
        some = np.ascontiguousarray(A[:, :, by_pairs])
        carried[:, by_pairs], bound[by_pairs] = _summed_in_pairs(some, n[:, by_pairs])
    with np.errstate(invalid="ignore"):
        normals = sign * carried / np.sqrt((carried * carried).sum(axis=0)) + 0.0
    status = np.zeros(A.shape[2], np.int8)
    unsettled = np.flatnonzero(~(bound <= tolerance) | ~sure | (sign == 0))
    for i in unsettled.tolist():
        exact = LinearMap.of(A[:, :, i].tolist())
        found = exact.normal(n[:, i].tolist())
        normals[:, i] = found.direction or (0.0, 0.0, 0.0)
        status[i] = STATUSES.index(found.status)
        sign[i], bound[i] = exact.determinant_sign, CORRECTLY_ROUNDED
    return CertifiedNormals(
        normals, bound, status, sign.astype(np.int8), len(by_pairs), len(unsettled)
    )


def determinant_signs(A: Array, C: Scaled) -> tuple[Array, Array]:
    """Return the signs of the determinants, and which of them floats can be sure of.

    Expanded along a row, det = Σ aⱼ Cⱼ; three terms within 3u each, added up: 6u of their sizes.
    """
    terms = _terms(Scaled(C.mantissa[0], C.exponent[0]), A[0])
    total = terms[0] + terms[1] + terms[2]
    size = np.abs(terms).sum(axis=0)
    return np.sign(total), np.abs(total) > 8 * UNIT * size


def _terms(C: Scaled, n: Array) -> Array:
    """Return cofactors (…, 3, N) times components (3, N), at one scale for each of the N.

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
    size = np.abs(n)
    return bool((size > LARGEST).any() or ((size < SMALLEST) & (size > 0)).any())


def _summed(C: Scaled, n: Array) -> tuple[Array, Array]:
    """Return C·n up to a scale for each column, and the bound on its angle."""
    terms = _terms(C, n)
    carried = terms[:, 0] + terms[:, 1]
    carried += terms[:, 2]
    size = np.abs(terms).sum(axis=1)
    largest = np.abs(carried).max(axis=0)
    scale = np.where(largest > 0, largest, 1.0)
    return carried / scale, _angle_bound(5.01 * UNIT, size / scale, carried / scale)


def _angle_bound(relative: float, size: Array, carried: Array) -> Array:
    """Return asin of error over length, and what normalising adds; infinite where it is unknown."""
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = relative * np.sqrt((size * size).sum(axis=0) / (carried * carried).sum(axis=0))
    ratio = np.where(np.isfinite(ratio) & (ratio < 0.5), ratio, np.inf)
    return np.asarray(ratio * 1.05 + NORMALISING)  # asin x ≤ 1.05 x below ½


def _summed_in_pairs(A: Array, n: Array) -> tuple[Array, Array]:
    """Return C·n with every number held as two floats, and the bound on its angle."""
    carried, sizes = np.empty((3, A.shape[2])), np.empty((3, A.shape[2]))
    n = np.ldexp(n, -np.frexp(np.abs(n).max(axis=0))[1])
    for i in range(3):
        high, low, size = (np.zeros(A.shape[2]) for _ in range(3))
        for j in range(3):
            p, q = minor_products(A, i, j)
            value = two_sum(p.high, -q.high)
            rest = value.low + (p.low - q.low)
            term = two_product(value.high, n[j])
            total = two_sum(high, term.high)
            high = total.high
            low = low + (total.low + term.low + rest * n[j])
            size += (np.abs(p.high) + np.abs(q.high)) * np.abs(n[j])
        carried[i], sizes[i] = high + low, size
    return carried, _angle_bound(PAIRS, sizes, carried)
