"""Normal matrices of many maps: sign(det A)·C, chunk by chunk, at one of two levels.

*Certified*: every entry within 2u, signs and zeros exact. *Guarded*: plain cofactors, which lose
u·σ₁/σ₂, as an inverse does; where the largest cofactor is much smaller than the largest product,
or the sign of the determinant is in doubt, the certified level takes over. Directions are all that
a normal matrix is for, so each may come out times a power of two, where floats would not hold it.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import Level
from nmatrix.linear.certified import determinant_signs
from nmatrix.linear.compensated import AFTER, NEXT, Scaled, cofactors
from nmatrix.linear.exact import LinearMap

Array = NDArray[Any]

CHUNK = 1 << 12  # matrices whose entries, cofactors and scratch stay in the second-level cache
FLATTEST = 2.0**-10  # of the largest cofactor to the largest product that plain ones are taken for
DOUBT = 2.0**-40  # of the determinant to the cube of the largest entry


def normal_matrices(A: Array, out: Array, level: Level) -> Array:
    """Write sign(det A)·C for structures of arrays (3, 3, N) into `out`, and return it.

    A singular map's sign counts as +1: the cofactors of rank 2 still hold the plane's normal.

    Examples
    --------
    >>> A = np.diag([-1.0, 2, 4])[:, :, None]
    >>> normal_matrices(A, np.empty_like(A), Level.CERTIFIED)[:, :, 0].diagonal().tolist()
    [-8.0, 4.0, 2.0]
    """
    for first in range(0, A.shape[2], CHUNK):
        part = slice(first, first + CHUNK)
        _chunk(np.ascontiguousarray(A[:, :, part], np.float64), out[:, :, part], level)
    return out


def normal_matrices_by_row(A: Array, out: Array, level: Level) -> Array:
    """Do the same for arrays of structures (N, 3, 3); each chunk is turned once, in the cache."""
    turned = np.empty((3, 3, CHUNK))
    found = np.empty((3, 3, CHUNK))
    for first in range(0, len(A), CHUNK):
        some = A[first : first + CHUNK]
        count = len(some)
        np.copyto(turned[:, :, :count], some.transpose(1, 2, 0))
        whole = count == CHUNK
        given = turned if whole else np.ascontiguousarray(turned[:, :, :count])
        result = found if whole else np.empty((3, 3, count))
        _chunk(given, result, level)
        np.copyto(out[first : first + CHUNK], result.transpose(2, 0, 1), casting="same_kind")
    return out


def _chunk(A: Array, out: Array, level: Level) -> None:
    if level is Level.CERTIFIED:
        _certified(A, out)
        return
    doubtful = np.flatnonzero(_plain(A, out))
    if len(doubtful):
        again = np.empty((3, 3, len(doubtful)))
        _certified(np.ascontiguousarray(A[:, :, doubtful]), again)
        out[:, :, doubtful] = again


def _plain(A: Array, out: Array) -> Array:
    """Write sign(det A)·C by plain cofactors, and return where that is not good enough."""
    scratch = np.empty(A.shape[2])
    with np.errstate(over="ignore", invalid="ignore", under="ignore"):
        for i in range(3):
            for j in range(3):
                r, s, k, m = NEXT[i], AFTER[i], NEXT[j], AFTER[j]
                np.multiply(A[r, k], A[s, m], out=out[i, j])
                np.multiply(A[r, m], A[s, k], out=scratch)
                out[i, j] -= scratch
        determinant = A[0, 0] * out[0, 0]
        determinant += A[0, 1] * out[0, 1]
        determinant += A[0, 2] * out[0, 2]
        largest = np.maximum(A.max(axis=(0, 1)), -A.min(axis=(0, 1)))
        cofactor = np.maximum(out.max(axis=(0, 1)), -out.min(axis=(0, 1)))
        square = largest * largest
        good = cofactor >= FLATTEST * square
        good &= np.abs(determinant) >= DOUBT * square * largest
        good &= (largest < 2.0**150) & (largest > 2.0**-150)
    np.copysign(1.0, determinant, out=scratch)
    out *= scratch
    return np.asarray(~good)


def _certified(A: Array, out: Array) -> None:
    """Write sign(det A)·C within 2u, scaled by a power of two for each matrix that needs it."""
    C = cofactors(A)
    signs = _signs(A, C)
    if C.exponent.any():
        np.copyto(out, _at_one_scale(C))
    else:
        np.copyto(out, C.mantissa)
    out *= signs


def _at_one_scale(C: Scaled) -> Array:
    """Return cofactors with their exponents put back, less the largest where it would overflow."""
    mantissa, more = np.frexp(C.mantissa)
    exponent = np.where(mantissa == 0, np.iinfo(np.int32).min // 2, C.exponent + more)
    largest = exponent.max(axis=(0, 1))
    too_far = (largest > 1000) | (largest < -900)
    shift = np.maximum(exponent - np.where(too_far, largest, 0), -2000)
    return np.asarray(np.ldexp(mantissa, shift))


def _signs(A: Array, C: Scaled) -> Array:
    """Return 1 or −1: the exact sign of each determinant, 1 where it is zero."""
    sign, sure = determinant_signs(A, C)
    for i in np.flatnonzero(~sure).tolist():
        sign[i] = LinearMap.of(A[:, :, i].tolist()).determinant_sign
    return np.where(sign < 0, -1.0, 1.0)
