"""Normals of arrays: normal matrices, normals through maps, and the kinds of maps.

Matrices are row-major and act on column vectors. Everything runs over the leading axes. A float
type that comes in goes out again; integers and lists give float64.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from nmatrix.api import arrays
from nmatrix.api.showing import MOST, first_rows
from nmatrix.enums import Level, NormalMatrixKind, chosen
from nmatrix.errors import IllegalValueError, NMatrixError, NoAnswerError
from nmatrix.linear import angle, batched, rational, rounding
from nmatrix.linear.certified import STATUSES, UNDEFINED
from nmatrix.linear.classify import BUILT, Classification
from nmatrix.linear.classify import classify as _classify
from nmatrix.linear.exact import LinearMap
from nmatrix.linear.values import flag, real
from nmatrix.report import Displayed, Report

Array = NDArray[Any]


@dataclass(frozen=True, eq=False)
class TransformedNormals(Displayed):
    """What became of normals.

    Parameters
    ----------
    normals
        (..., 3) unit vectors; zeros where the status is undefined.
    status
        (...) text, one of `NormalStatus`: "ok", "two-sided" where the map flattens space to a plane
        whose sides are alike, "undefined" where there is no normal.
    bound_rad
        (...) float64: the angle to the true normal is at most this; 0 where it is undefined.
    """

    normals: Array
    status: Array
    bound_rad: Array

    def _repr_report_(self) -> Report:
        """Tell the first normals, each with its status and its bound."""
        flat = (self.normals.reshape(-1, 3), self.status.ravel(), self.bound_rad.ravel())
        shown = zip(*(one[:MOST].tolist() for one in flat), strict=True)
        rows = [(*normal, status, bound) for normal, status, bound in shown]
        columns = ("x", "y", "z", "status", "within (rad)")
        return Report.of_value(*first_rows(columns, rows, self.status.size))


def normal_matrix(
    A: ArrayLike,
    *,
    kind: NormalMatrixKind | str = NormalMatrixKind.INVERSE_TRANSPOSE,
    level: Level | str = Level.EXACT,
    out: Array | None = None,
) -> Array:
    """Compute the matrices that normals are multiplied by: A⁻ᵀ, or sign(det A)·cofactors.

    A tangent t of a surface becomes A t, and A⁻ᵀ n stays perpendicular to it:
    (A⁻ᵀ n)·(A t) = n·t = 0. The oriented kind is |det A| times that, and exists where an inverse
    does not. Of that kind only the direction matters: where the type of the result would not hold
    every entry as a normal number, a matrix comes times a power of two, and an entry is lost only
    if no power of two holds it beside the largest one. An inverse transpose comes as it is: what
    its type holds no number small enough for is 0.

    A matrix gives the same bits alone as in a batch. With `NMATRIX_COMPILED=1` in the environment,
    and the extra `fast` installed, one compiled loop computes them: the same bits, in less time.

    Parameters
    ----------
    A
        (..., 3, 3), or affine (..., 4, 4), of which the 3×3 blocks count. The result has the same
        float type.
    kind
        "inverse-transpose" or "oriented".
    level
        With u = 2⁻⁵³, before the one rounding to a type narrower than float64:

        - "exact": every entry correctly rounded, about 20 µs a matrix;
        - "certified": oriented entries within 2u, inverse transposes within 4u, signs and zeros
          exact; for many, less time than `np.linalg.inv`;
        - "guarded": several times faster for many; a column of an oriented matrix is within
          2⁻³⁶ rad, an entry of an inverse transpose within 2⁻³⁶ of the largest one.
    out
        Where to write, (..., 3, 3) of any float type; it may be A, or overlap it. After an error it
        holds a part of the answer.

    Raises
    ------
    NoAnswerError
        If an inverse transpose is asked of a singular matrix, which is decided exactly at every
        level; it names the index.
    IllegalValueError
        If A is no array of finite linear or affine maps, if an inverse transpose has an entry
        beyond the largest number of its type, or for an unknown word.

    Examples
    --------
    >>> normal_matrix(np.diag([1.0, 2.0, 4.0])).diagonal().tolist()
    [1.0, 0.5, 0.25]
    >>> normal_matrix(np.diag([-1.0, 2.0, 0.0]), kind="oriented").diagonal().tolist()
    [0.0, 0.0, -2.0]
    """
    asked, how = chosen(NormalMatrixKind, kind, "kind"), chosen(Level, level, "level")
    given = arrays.matrices(A, "A")[..., :3, :3]
    found = arrays.room(out, given.shape, arrays.native(given))
    if batched.write_few(given, found, asked, how):
        return found
    source, target = arrays.apart(given, found), found
    if given.ndim == 2:
        source, target = source[None], target[None]
    with np.errstate(all="ignore"):
        for line in arrays.lines(source.shape[:-2]):
            bad = batched.normal_matrices(source[line], target[line], asked, how)
            if bad is not None:
                index = arrays.place(line, bad)
                raise _no_inverse(target[index], index[: given.ndim - 2])
    return found


def _no_inverse(found: Array, index: arrays.Index) -> NMatrixError:
    name = arrays.named("A", index)
    if np.isnan(found).any():
        return NoAnswerError(
            name,
            "its determinant is exactly 0, so it has no inverse transpose",
            'ask for kind="oriented", which exists for every matrix',
        )
    return IllegalValueError(
        name,
        f"its inverse transpose has an entry beyond the largest {found.dtype.name}",
        'ask for kind="oriented", which comes times a power of two',
    )


def cofactor_matrix(A: ArrayLike) -> Array:
    """Compute the cofactor matrices det A · A⁻ᵀ of the 3×3 blocks, which exist for singular A too.

    Parameters
    ----------
    A
        (..., 3, 3) or affine (..., 4, 4).

    Returns
    -------
    Array
        (..., 3, 3), correctly rounded to float64, and then to the float type of A.

    Raises
    ------
    IllegalValueError
        If A is no array of finite linear or affine maps, or if a cofactor is beyond the largest
        number of its type.

    Examples
    --------
    >>> cofactor_matrix(np.diag([1.0, 2.0, 0.0])).diagonal().tolist()
    [0.0, 0.0, 2.0]
    """
    given = arrays.matrices(A, "A")[..., :3, :3]
    found = np.empty(given.shape, arrays.native(given))
    for index in np.ndindex(given.shape[:-2]):
        try:
            with np.errstate(all="ignore"):
                found[index] = rational.to_floats(
                    LinearMap.of(given[index].tolist()).cofactor_matrix
                )
        except IllegalValueError:
            found[index] = np.inf
        if not np.isfinite(found[index]).all():
            raise IllegalValueError(
                arrays.named("A", index),
                f"a cofactor is beyond the largest {found.dtype.name}",
                'ask for normal_matrix(A, kind="oriented"), which comes times a power of two',
            )
    return found


@overload
def transform_normals(
    A: ArrayLike,
    n: ArrayLike,
    *,
    level: Level | str = ...,
    out: Array | None = ...,
    status: Literal[False] = ...,
) -> Array: ...
@overload
def transform_normals(
    A: ArrayLike,
    n: ArrayLike,
    *,
    level: Level | str = ...,
    out: Array | None = ...,
    status: Literal[True],
) -> TransformedNormals: ...
def transform_normals(
    A: ArrayLike,
    n: ArrayLike,
    *,
    level: Level | str = Level.EXACT,
    out: Array | None = None,
    status: bool = False,
) -> Array | TransformedNormals:
    """Carry normals through maps to unit length: sign(det A)·C n, with C the cofactors of A.

    Tangent planes are carried along, and outward sides stay outward under mirrors too. A map of
    rank 2 gives the normal of the plane that it flattens space to, on the side of +C n.

    Parameters
    ----------
    A
        One or many maps (..., 3, 3), or affine (..., 4, 4), of which the 3×3 blocks count.
    n
        One or many normals (..., 3) of any length but zero, broadcast against the maps. The result
        has the same float type.
    level
        Before the one rounding to a type narrower than float64:

        - "exact": every component correctly rounded, about 20 µs a normal;
        - "certified": within 10⁻¹⁴ rad;
        - "guarded": within 2⁻³⁶ rad, for one map of float32 normals within 2⁻¹⁷ rad; the certified
          level takes over where that could fail.
    out
        Where to write, of any float type; it may be n or A, or overlap them. After an error it
        holds a part of the answer.
    status
        Return `TransformedNormals`, with a status and a bound for each, in place of the array.

    Raises
    ------
    NoAnswerError
        Without `status`, for the first normal that has no image: the zero vector, or a silhouette
        of a flattening map; it names the index and the reason.
    IllegalValueError
        If A or n is no such array, if they do not broadcast, or for an unknown word.

    Examples
    --------
    >>> transform_normals(np.diag([1.0, 2.0, 1.0]), [1, 2, 0]).round(4).tolist()
    [0.7071, 0.7071, 0.0]
    >>> found = transform_normals(np.diag([1.0, 0.0, 1.0]), [[1, 2, 0], [1, 0, 0]], status=True)
    >>> found.normals.tolist(), found.status.tolist()
    ([[0.0, 1.0, 0.0], [0.0, 0.0, 0.0]], ['two-sided', 'undefined'])
    """
    how, status = chosen(Level, level, "level"), flag(status, "status")
    maps, normals = arrays.matrices(A, "A")[..., :3, :3], arrays.vectors(n, "n")
    shape = _broadcast("A", maps.shape[:-2], "n", normals.shape[:-1])
    found = arrays.room(out, (*shape, 3), arrays.native(normals))
    maps, normals = arrays.apart(maps, found), arrays.apart(normals, found)
    size = shape or (1,)
    maps = np.broadcast_to(maps, (*size, 3, 3))
    normals = np.broadcast_to(normals, (*size, 3))
    target = found if shape else found[None]
    codes, bounds = (np.zeros(size, np.int8), np.zeros(size)) if status else (None, None)
    with np.errstate(all="ignore"):
        for line in arrays.lines(size):
            A, n = maps[line], normals[line]
            is_one = A.strides[0] == 0 or len(A) == 1
            for part, carried in batched.transform_normals(A[:1] if is_one else A, n, how):
                if codes is not None and bounds is not None:
                    codes[line][part], bounds[line][part] = carried.status, carried.bound_rad
                    if carried.directions.dtype.itemsize > found.dtype.itemsize:
                        bounds[line][part] += batched.rounding_bound(found.dtype)
                elif carried.status.max() == UNDEFINED:
                    first = part.start + int(carried.status.argmax())
                    raise _no_normal(A[first], n[first], arrays.place(line, first)[: len(shape)])
                target[line][part] = carried.directions.T
    if codes is None or bounds is None:
        return found
    bounds[codes == UNDEFINED] = 0.0
    words = np.array([str(one) for one in STATUSES])
    return TransformedNormals(found, words[codes].reshape(shape), bounds.reshape(shape))


def _broadcast(
    one: str, axes: tuple[int, ...], other: str, others: tuple[int, ...]
) -> tuple[int, ...]:
    try:
        return np.broadcast_shapes(axes, others)
    except ValueError:
        raise IllegalValueError(
            f"{one} and {other}",
            f"their leading axes {axes} and {others} do not broadcast",
            "give one of them an axis of length 1",
        ) from None


def _no_normal(A: Array, n: Array, index: arrays.Index) -> NoAnswerError:
    reason = LinearMap.of(A.tolist()).normal(n.tolist()).reason
    components = " ".join(f"{x:g}" for x in n.tolist())
    return NoAnswerError(
        f"{arrays.named('n', index)} ({components})", reason, "leave it out, or ask for status=True"
    )


def normalize(v: ArrayLike) -> Array:
    """Bring vectors (..., 3) to length one, whatever their length was.

    Returns
    -------
    Array
        (..., 3), every component correctly rounded to float64, and then to the float type of v.

    Raises
    ------
    NoAnswerError
        For a zero vector; it names the index.
    IllegalValueError
        If v is no array of finite vectors.

    Examples
    --------
    >>> normalize([3e-320, 4e-320, 0]).tolist()
    [0.6, 0.8, 0.0]
    """
    given = arrays.vectors(v, "v")
    found = np.empty(given.shape, arrays.native(given))
    for index in np.ndindex(given.shape[:-1]):
        _check_length(given[index], "v", index)
        found[index] = rounding.normalize(given[index].tolist())
    return found


def angle_between(a: ArrayLike, b: ArrayLike) -> Array | np.float64:
    """Compute the angles between vectors (..., 3) in radians, to a relative 1e-15.

    tan = |a × b| / a·b, both exact, so small angles keep their digits, which an acos would lose.

    Returns
    -------
    Array | numpy.float64
        Float64, of the shape that the leading axes broadcast to; one number for two vectors.

    Raises
    ------
    NoAnswerError
        For a zero vector; it names the index.
    IllegalValueError
        If a or b is no array of finite vectors, or if they do not broadcast.

    Examples
    --------
    >>> float(angle_between((1, 0, 0), (1, 1e-200, 0)))
    1e-200
    """
    pair = arrays.vectors(a, "a"), arrays.vectors(b, "b")
    for given, parameter in zip(pair, "ab", strict=True):
        for zero in np.argwhere(~given.any(axis=-1))[:1].tolist():
            _check_length(given[tuple(zero)], parameter, tuple(zero))
    shape = _broadcast("a", pair[0].shape[:-1], "b", pair[1].shape[:-1])
    found = np.empty(shape)
    first, second = (np.broadcast_to(given, (*shape, 3)) for given in pair)
    for index in np.ndindex(shape):
        found[index] = angle.angle_between(first[index].tolist(), second[index].tolist())
    return found if shape else np.float64(found)


def _check_length(v: Array, parameter: str, index: arrays.Index) -> None:
    if not v.any():
        raise NoAnswerError(
            f"{arrays.named(parameter, index)} (0 0 0)",
            "it has length zero and no direction",
            "give one non-zero component",
        )


def classify(A: ArrayLike, tolerance: float = BUILT) -> Classification:
    """Find what kind of map one matrix is: rotation, shear, singular and so on.

    Rank and mirroring are exact, whatever the tolerance.

    Parameters
    ----------
    A
        (3, 3) or affine (4, 4).
    tolerance
        How far lengths and cosines of columns may be off, relative to 1.

    Raises
    ------
    IllegalValueError
        If A is not one finite linear or affine map, or if the tolerance is negative.

    Examples
    --------
    >>> classify(np.diag([1.0, -1.0, 1.0])).mirrored
    True
    """
    given = arrays.matrices(A, "A")
    if given.ndim > 2:
        raise IllegalValueError(
            f"A of shape {given.shape}",
            "a Classification describes one matrix",
            "classify them in turn: [classify(one) for one in A]",
        )
    limit = real(tolerance, "tolerance")
    if limit < 0:
        raise IllegalValueError(f"tolerance ({limit})", "it is a number from 0 up", "try 1e-12")
    return _classify(given.tolist(), limit)
