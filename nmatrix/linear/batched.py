"""Many normal matrices and many normals at once, in chunks that stay in the cache.

u is the unit roundoff of float64. *Exact*: whole numbers, one matrix after the other. *Certified*:
compensated cofactors, within 2u with exact signs and zeros. *Guarded*: plain arithmetic where a
bound says that it is good enough, else the certified level. Whatever the level, the mantissas and
exponents that it finds are rounded to the type of the output in one place here.

A is (N, 3, 3), n is (N, 3). Nothing is written before the same places of the input have been read.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import cache
from importlib.util import find_spec
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import DTypeLike, NDArray

from nmatrix.enums import Level, NormalMatrixKind
from nmatrix.linear import compensated, plain, single
from nmatrix.linear.certified import (
    CORRECTLY_ROUNDED,
    NEVER,
    OK,
    STATUSES,
    Normals,
    certified_normals,
    determinant_signs,
    determinants,
)
from nmatrix.linear.compensated import Scaled, cofactors
from nmatrix.linear.exact import LinearMap
from nmatrix.linear.plain import LARGEST, SMALLEST
from nmatrix.requirements import missing

Array = NDArray[Any]

ENOUGH = 1 << 10  # matrices that are worth the calls of the certified level
PAIRS_CHUNK = 5 << 9  # matrices with a normal each: no more than 4 MiB are taken for them
LOOP_CHUNK = 1 << 12  # matrices that the compiled loop takes at a time
LONG_CHUNK = 1 << 16  # vectors whose products and lengths take 2 MiB
NOWHERE = np.empty(0, np.intp)


class PlainSums(NamedTuple):
    """How far plain sums in a type may be off, in radians, and which squared lengths are safe."""

    bound: float
    shortest: float
    longest: float


PLAIN_SUMS: dict[np.dtype[Any], PlainSums] = {
    np.dtype(np.float32): PlainSums(2.0**-17, 2.0**-100, 2.0**100),
    np.dtype(np.float64): PlainSums(2.0**-36, 2.0**-900, 2.0**900),
}
PLAIN_COFACTORS = 2.0**-36  # radians that plain cofactors and sums in float64 may be off


def chunks(count: int, size: int) -> Iterator[slice]:
    """Cut so many into slices of a size.

    Examples
    --------
    >>> [part.stop for part in chunks(5, 2)]
    [2, 4, 5]
    """
    return (slice(first, min(first + size, count)) for first in range(0, count, size))


def normal_matrices(A: Array, out: Array, kind: NormalMatrixKind, level: Level) -> int | None:
    """Write the normal matrices of (N, 3, 3) into `out`, of any float type.

    Returns
    -------
    int | None
        The first place whose answer is not finite: a singular matrix, for which NaN is written, or
        an inverse transpose with an entry beyond the type of `out`, infinite there.

    Examples
    --------
    >>> A = np.diag([-1.0, 2, 4])[None]
    >>> normal_matrices(A, A, NormalMatrixKind.ORIENTED, Level.CERTIFIED), A[0].diagonal().tolist()
    (None, [-8.0, 4.0, 2.0])
    """
    if level is not Level.EXACT and is_compiled():
        return _by_loop(A, out, kind, level)
    return _by_arrays(A, out, kind, level)


@cache
def is_compiled() -> bool:
    """Find out if the compiled loop is asked for, by `NMATRIX_COMPILED` in the environment.

    Raises
    ------
    MissingPackageError
        If it is, and Numba is missing.
    """
    if not os.environ.get("NMATRIX_COMPILED"):
        return False
    if find_spec("numba") is None:
        raise missing("NMATRIX_COMPILED is set", "numba")
    return True


def _by_loop(A: Array, out: Array, kind: NormalMatrixKind, level: Level) -> int | None:
    """Write by the compiled loop, and by arrays what it leaves."""
    from nmatrix.linear import compiled  # Numba takes a third of a second

    if A.dtype not in compiled.FLOATS or out.dtype not in compiled.FLOATS:
        return _by_arrays(A, out, kind, level)
    for part in chunks(len(A), LOOP_CHUNK):
        left = part.start + compiled.write(A[part], out[part], kind, level)
        if len(left):
            again = np.empty((len(left), 3, 3), out.dtype)
            bad = _by_arrays(A[left], again, kind, level)
            out[left] = again
            if bad is not None:
                return int(left[bad])
    return None


def _by_arrays(A: Array, out: Array, kind: NormalMatrixKind, level: Level) -> int | None:
    planes, room = A.transpose(1, 2, 0), out.transpose(1, 2, 0)
    if level is Level.GUARDED:
        return _guarded(planes, room, kind)
    write = _write_exact if level is Level.EXACT else _write_certified
    for part in chunks(len(A), compensated.CHUNK):
        bad = write(planes[:, :, part], room[:, :, part], kind)
        if len(bad):
            return int(part.start + bad[0])
    return None


def write_few(A: Array, out: Array, kind: NormalMatrixKind, level: Level) -> bool:
    """Write few normal matrices (..., 3, 3) one by one; False, and nothing written, if that fails.

    Examples
    --------
    >>> A = np.diag([-1.0, 2, 4])
    >>> write_few(A, A, NormalMatrixKind.ORIENTED, Level.CERTIFIED), A.diagonal().tolist()
    (True, [-8.0, 4.0, 2.0])
    """
    if A.size > 9 * single.FEW or level is Level.EXACT or is_compiled():
        return False
    entries, found = A.ravel().tolist(), []
    for first in range(0, len(entries), 9):
        one = single.normal_matrix(entries[first : first + 9], kind, level)
        if one is None:
            return False
        found += one
    is_oriented = kind is NormalMatrixKind.ORIENTED
    if not (is_oriented and out.dtype == np.float64) and not _are_normal(found, out.dtype):
        return False
    out[...] = np.array(found).reshape(out.shape)
    return True


def _are_normal(values: list[float], dtype: np.dtype[Any]) -> bool:
    limits = _limits(dtype)
    return single.lies_within(float(limits.tiny), float(limits.max), values)


def _guarded(A: Array, out: Array, kind: NormalMatrixKind) -> int | None:
    """Write plain normal matrices, and certified ones over the doubtful.

    The few of each chunk wait until there are enough of them: together they cost a tenth.
    """
    count = A.shape[2]
    is_direct = out.dtype == np.float64 and out.strides[2] == out.itemsize
    is_direct = is_direct and not np.may_share_memory(A, out)
    at: list[Array] = []
    waiting: list[Array] = []
    for part in chunks(count, plain.CHUNK):
        some, room = A[:, :, part], out[:, :, part]
        space = plain.Workspace.taken(some.shape[2], plain.CHUNK)
        found, is_doubtful = space.normal_matrices(some, kind, room if is_direct else None)
        if is_doubtful.any():
            doubtful = np.flatnonzero(is_doubtful)
            at.append(part.start + doubtful)
            waiting.append(some[:, :, doubtful])
            found.mantissa[:, :, doubtful] = 0.0
        bad = part.start + _put(found, room, kind)
        if at and (part.stop == count or len(bad) or sum(map(len, at)) >= ENOUGH):
            places, again = np.concatenate(at), np.concatenate(waiting, axis=2)
            for few in chunks(len(places), PAIRS_CHUNK):
                certified = np.empty((3, 3, few.stop - few.start), out.dtype)
                worse = _write_certified(again[:, :, few], certified, kind)
                out[:, :, places[few]] = certified
                bad = np.append(bad, places[few][worse])
            at, waiting = [], []
        if len(bad):
            return int(bad.min())
    return None


def _write_certified(A: Array, out: Array, kind: NormalMatrixKind) -> Array:
    """Write certified normal matrices; return the places of those that are not finite."""
    if write_few(A.transpose(2, 0, 1), out.transpose(2, 0, 1), kind, Level.CERTIFIED):
        return NOWHERE
    return _put(_certified(_float64(A), kind), out, kind)


def _write_exact(A: Array, out: Array, kind: NormalMatrixKind) -> Array:
    return _put(_exact(_float64(A), kind, out.dtype), out, kind)


def _certified(A: Array, kind: NormalMatrixKind) -> Scaled:
    """Compute sign(det A)·C within 2u, or C/det A within 4u, NaN for a singular matrix."""
    C = cofactors(A)
    if kind is NormalMatrixKind.ORIENTED:
        C.mantissa[...] *= np.where(determinant_signs(A, C) < 0, -1.0, 1.0)
        return C
    det = determinants(A)
    det.mantissa[det.mantissa == 0] = np.nan
    return Scaled(C.mantissa / det.mantissa, C.exponent - det.exponent)


def _exact(A: Array, kind: NormalMatrixKind, dtype: DTypeLike = np.float64) -> Scaled:
    """Compute sign(det A)·C or C/det A from whole numbers, every entry correctly rounded."""
    maps = [LinearMap.of(matrix) for matrix in A.transpose(2, 0, 1).tolist()]
    found = Scaled(np.empty(A.shape), np.zeros(A.shape, np.int32))
    if kind is NormalMatrixKind.ORIENTED:
        _write_oriented(maps, found)
        return _with_subnormals(maps, found, _limits(np.dtype(dtype)))
    for i, one in enumerate(maps):
        for j, row in enumerate(one.cofactors):
            for k, cofactor in enumerate(row):
                top = cofactor * one.denominator
                found.mantissa[j, k, i] = _quotient(top, one.integer_determinant)
    return found


def _sign_and_power(one: LinearMap) -> tuple[int, int]:
    """Return s and e for which s·2ᵉ times a whole cofactor is the oriented entry."""
    return -1 if one.integer_determinant < 0 else 1, -2 * (one.denominator.bit_length() - 1)


def _write_oriented(maps: Sequence[LinearMap], out: Scaled) -> None:
    for i, one in enumerate(maps):
        sign, power = _sign_and_power(one)
        for j, row in enumerate(one.cofactors):
            for k, cofactor in enumerate(row):
                bits = cofactor.bit_length()
                out.mantissa[j, k, i] = sign * cofactor / (1 << bits)
                out.exponent[j, k, i] = bits + power


def _with_subnormals(maps: Sequence[LinearMap], found: Scaled, limits: np.finfo[Any]) -> Scaled:
    """Round entries that come out subnormal once, to the bits that they have left there."""
    if limits.dtype != np.float64:
        return found  # a narrower type rounds from float64, which holds them as normal numbers
    powers = _powers(found, limits)
    size = np.abs(np.ldexp(found.mantissa, found.exponent + powers))
    for j, k, i in np.argwhere((size < limits.tiny) & (found.mantissa != 0)).tolist():
        sign, power = _sign_and_power(maps[i])
        exact = sign * maps[i].cofactors[j][k] * Fraction(2) ** (power + int(powers[i]))
        found.mantissa[j, k, i] = np.ldexp(float(exact), -int(limits.minexp))
        found.exponent[j, k, i] = int(limits.minexp) - powers[i]
    return found


def _quotient(top: int, bottom: int) -> float:
    """Divide whole numbers, correctly rounded; infinite beyond the largest float, NaN over 0."""
    try:
        return top / bottom + 0.0 if bottom else np.nan
    except OverflowError:
        return np.inf


def _put(found: Scaled, out: Array, kind: NormalMatrixKind) -> Array:
    """Round results to the type of `out`; return the places that are not finite there."""
    if kind is NormalMatrixKind.ORIENTED:
        values = within_range(found, out.dtype)
    else:
        values = np.ldexp(*found) if found.exponent.any() else found.mantissa
    if values is not out:  # which the guarded level has written by itself
        np.add(values, 0.0, out=out, casting="same_kind")  # no zero is negative
    if kind is NormalMatrixKind.ORIENTED:
        return NOWHERE
    bad = ~np.isfinite(values if out.dtype == values.dtype else out)
    return np.flatnonzero(bad.any(axis=(0, 1)))


def within_range(found: Scaled, dtype: DTypeLike) -> Array:
    """Put mantissas and exponents together, at a power of two for each matrix that needs one.

    A matrix that the type holds as it is, with every entry a normal number or zero, comes as it is.
    Else its largest entry comes near 1, or above that as far as its smallest one needs: an entry is
    rounded to fewer bits, or to zero, only where no power of two would hold it beside the largest.

    Examples
    --------
    >>> C = Scaled(np.array([[[0.5]], [[0.5]]]), np.array([[[601]], [[-899]]], np.int32))
    >>> np.log2(within_range(C, np.float64)).ravel().tolist()
    [600.0, -900.0]
    >>> wide = Scaled(C.mantissa, np.array([[[901]], [[-1099]]], np.int32))
    >>> np.log2(within_range(wide, np.float64)).ravel().tolist()
    [978.0, -1022.0]
    """
    limits = _limits(np.dtype(dtype))
    if not found.exponent.any() and _holds(limits, found.mantissa):
        return found.mantissa
    return np.asarray(np.ldexp(found.mantissa, found.exponent + _powers(found, limits)))


def _powers(found: Scaled, limits: np.finfo[Any]) -> Array:
    """Choose the power of two of each matrix from its entries as the type rounds them."""
    mantissa, exponent = np.frexp(found.mantissa)
    mantissa, more = np.frexp(mantissa.astype(limits.dtype).astype(np.float64))
    exponent = exponent + found.exponent + more
    is_zero = mantissa == 0
    largest = np.where(is_zero, NEVER, exponent).max(axis=(0, 1))
    smallest = np.where(is_zero, -NEVER, exponent).min(axis=(0, 1))
    lowest, highest = limits.minexp + 1, limits.maxexp
    fits = (largest <= highest) & (smallest >= lowest)
    shift = np.clip(lowest - smallest, -largest, highest - largest)
    return np.asarray(np.where(fits | (largest == NEVER), 0, shift))


def rounding_bound(dtype: DTypeLike) -> float:
    """Bound the angle, in radians, by which a unit vector turns when it is rounded to a type."""
    return 1.01 * float(_limits(np.dtype(dtype)).eps) / 2


@cache
def _limits(dtype: np.dtype[Any]) -> np.finfo[Any]:
    """Return the range of a type, or that of float64 for one that is wider."""
    return np.finfo(np.promote_types(dtype, np.float16) if np.can_cast(dtype, "f8") else "f8")


def _holds(limits: np.finfo[Any], values: Array) -> bool:
    """Check that every value is zero or a normal number of a type."""
    if limits.dtype == np.float64:
        return True  # no level leaves the normal numbers of float64 without an exponent
    size, tiny = np.abs(values), float(limits.tiny)
    has_tiny = size.min() < tiny and ((size < tiny) & (size > 0)).any()
    return bool(size.max() <= float(limits.max) and not has_tiny)


def transform_normals(A: Array, n: Array, level: Level) -> Iterator[tuple[slice, Normals]]:
    """Carry normals (N, 3) through one map each, or through one for all, chunk by chunk.

    Parameters
    ----------
    A
        (N, 3, 3), or (1, 3, 3) for all normals.

    Yields
    ------
    tuple[slice, Normals]
        The places of a chunk, and what is found for them. A chunk is read when it is asked for.

    Examples
    --------
    >>> A, n = np.diag([1.0, 1, 0.5])[None], np.array([[3.0, 0, 2.0]])
    >>> [found.directions.ravel().tolist() for _, found in transform_normals(A, n, Level.GUARDED)]
    [[0.6, 0.0, 0.8]]
    """
    if level is Level.EXACT:
        return _by_exact(A, n)
    if level is Level.CERTIFIED:
        return _by_certified(A, n)
    return _by_guarded_one(A, n) if len(A) == 1 else _by_guarded(A, n)


def _by_exact(A: Array, n: Array) -> Iterator[tuple[slice, Normals]]:
    only = LinearMap.of(A[0].tolist()) if len(A) == 1 else None
    for part in chunks(len(n), PAIRS_CHUNK):
        count = part.stop - part.start
        directions, status = np.zeros((3, count)), np.zeros(count, np.int8)
        for i, normal in enumerate(n[part].tolist()):
            found = (only or LinearMap.of(A[part.start + i].tolist())).normal(normal)
            directions[:, i] = found.direction or (0.0, 0.0, 0.0)
            status[i] = STATUSES.index(found.status)
        yield part, Normals(directions, status, np.full(count, CORRECTLY_ROUNDED))


def _by_certified(A: Array, n: Array) -> Iterator[tuple[slice, Normals]]:
    for part in chunks(len(n), PAIRS_CHUNK):
        yield part, certified_normals(_of(A, part), _float64(n[part].T))


def _by_guarded(A: Array, n: Array) -> Iterator[tuple[slice, Normals]]:
    """Use plain cofactors and plain sums, where |Cn| ≥ L²|n|/3072 keeps these within 2⁻³⁶."""
    for part in chunks(len(n), plain.CHUNK):
        some, vectors = A[part].transpose(1, 2, 0), _float64(n[part].T)
        space = plain.Workspace.taken(some.shape[2], plain.CHUNK)
        (N, _), doubtful = space.normal_matrices(some, NormalMatrixKind.ORIENTED)
        directions = N[:, 0] * vectors[0]
        directions += N[:, 1] * vectors[1]
        directions += N[:, 2] * vectors[2]
        directions /= np.sqrt((directions * directions).sum(axis=0))
        size = np.abs(vectors)
        doubtful |= (size > LARGEST).any(axis=0) | ((size < SMALLEST) & (size > 0)).any(axis=0)
        doubtful |= ~size.any(axis=0)
        yield part, _settled(directions, doubtful, (A[part], n[part]), PLAIN_COFACTORS)


def _by_guarded_one(A: Array, n: Array) -> Iterator[tuple[slice, Normals]]:
    """Use the exact matrix, rounded once, and plain sums where its condition keeps these good."""
    matrix = LinearMap.of(A[0].tolist())
    N = _exact(_float64(A.transpose(1, 2, 0)), NormalMatrixKind.ORIENTED)
    largest = N.exponent[N.mantissa != 0].max(initial=NEVER)
    carrier = np.ldexp(N.mantissa, N.exponent - largest)[:, :, 0]
    spread = np.linalg.svd(carrier, compute_uv=False)
    for work, limit in PLAIN_SUMS.items():
        unit = float(np.finfo(work).eps) / 2
        bound = float(4.5 * unit * np.linalg.norm(carrier) / spread[2] + 4 * unit)
        if matrix.rank == 3 and np.can_cast(n.dtype, work) and bound <= limit.bound:
            return _by_plain_sums(A, n, carrier.astype(work), bound)
    return _by_certified(A, n)


def _by_plain_sums(
    A: Array, n: Array, carrier: Array, bound: float
) -> Iterator[tuple[slice, Normals]]:
    work = carrier.dtype
    _, low, high = PLAIN_SUMS[work]
    scratch = np.empty((3, min(LONG_CHUNK, len(n))), work)
    for part in chunks(len(n), LONG_CHUNK):
        directions = scratch[:, : part.stop - part.start]
        np.matmul(carrier, np.asarray(n[part].T, work), out=directions)
        squares = directions[0] * directions[0]
        squares += directions[1] * directions[1]
        squares += directions[2] * directions[2]
        doubtful = None
        if not (squares.min() >= low and squares.max() <= high):
            doubtful = ~((squares >= low) & (squares <= high))
        directions /= np.sqrt(squares, out=squares)
        yield part, _settled(directions, doubtful, (A, n[part]), bound)


def _settled(
    directions: Array, doubtful: Array | None, given: tuple[Array, Array], bound: float
) -> Normals:
    """Replace what is doubtful by certified normals, and attach the bound to the others."""
    A, n = given
    count = directions.shape[1]
    if doubtful is None or not doubtful.any():
        return Normals(directions, np.zeros(count, np.int8), np.broadcast_to(bound, count))
    status, bounds = np.full(count, OK, np.int8), np.full(count, bound)
    places = np.flatnonzero(doubtful)
    for part in chunks(len(places), PAIRS_CHUNK):
        some = places[part]
        found = certified_normals(_of(A, some), _float64(n[some].T))
        directions[:, some], status[some], bounds[some] = found
    if directions.dtype.itemsize < 8:  # what was certified is rounded to the type, too
        bounds[places] += rounding_bound(directions.dtype)
    return Normals(directions, status, bounds)


def _of(A: Array, places: slice | Array) -> Array:
    """Take the planes of matrices at these places, or of the one that serves all of them."""
    return _float64((A if len(A) == 1 else A[places]).transpose(1, 2, 0))


def _float64(A: Array) -> Array:
    """Bring planes to float64, each in one piece: every one of them is read many times."""
    is_ready = A.dtype == np.float64 and A.strides[-1] == A.itemsize
    return A if is_ready else np.ascontiguousarray(A, np.float64)
