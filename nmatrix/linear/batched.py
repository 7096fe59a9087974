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
from nmatrix.linear.compensated import Scaled, cofactors
from nmatrix.linear.exact import LinearMap
from nmatrix.linear.plain import Workspace

Array = NDArray[Any]

CHUNK = 5 << 10  # matrices whose entries, cofactors and scratch stay in the second-level cache
ENOUGH = 1 << 10  # matrices that are worth the calls of the certified level


def normal_matrices_by_row(A: Array, out: Array, level: Level) -> Array:
    """Write sign(det A)·C for arrays of structures (N, 3, 3) into `out`, and return it.

    Each chunk is turned once, in the cache.
    """
    normal_matrices(A.transpose(1, 2, 0), out.transpose(1, 2, 0), level)
    return out


def normal_matrices(A: Array, out: Array, level: Level) -> Array:
    """Do the same for structures of arrays (3, 3, N).

    A singular map's sign counts as +1: the cofactors of rank 2 still hold the plane's normal.

    Examples
    --------
    >>> A = np.diag([-1.0, 2, 4])[:, :, None]
    >>> normal_matrices(A, np.empty_like(A), Level.CERTIFIED)[:, :, 0].diagonal().tolist()
    [-8.0, 4.0, 2.0]
    """
    write = _guarded if level is Level.GUARDED else _certified
    return write(A, out)


def _guarded(A: Array, out: Array) -> Array:
    """Write plain cofactors, and certified ones over those that may not be good enough.

    The few of each chunk wait until there are enough of them: together they cost a tenth.
    """
    space = Workspace.of(min(CHUNK, A.shape[2]))
    at, waiting = [np.empty(0, np.intp)], [np.empty((3, 3, 0))]
    for first in range(0, A.shape[2], CHUNK):
        some = A[:, :, first : first + CHUNK]
        doubtful = space.write(some, out[:, :, first : first + CHUNK])
        at.append(first + doubtful)
        waiting.append(_planes(some[:, :, doubtful]))
        count = sum(map(len, at))
        if count >= ENOUGH or (count and first + CHUNK >= A.shape[2]):
            out[:, :, np.concatenate(at)] = _certified_chunk(np.concatenate(waiting, axis=2))
            at, waiting = at[:1], waiting[:1]
    return out


def _certified(A: Array, out: Array) -> Array:
    for first in range(0, A.shape[2], CHUNK):
        part = slice(first, first + CHUNK)
        np.copyto(out[:, :, part], _certified_chunk(_planes(A[:, :, part])), casting="same_kind")
    return out


def _certified_chunk(A: Array) -> Array:
    """Return sign(det A)·C within 2u, scaled by a power of two for each matrix that needs it."""
    C = cofactors(A)
    found = _at_one_scale(C) if C.exponent.any() else C.mantissa
    found *= _signs(A, C)
    return found


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


def _planes(A: Array) -> Array:
    return np.ascontiguousarray(A, np.float64)
