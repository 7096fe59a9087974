"""Batches at the speed of arrays: normal matrices and normals of many maps, with what is known."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from nmatrix.enums import Level
from nmatrix.errors import IllegalValueError
from nmatrix.linear import batched
from nmatrix.linear.carrying import carried_by_row
from nmatrix.linear.certified import TOLERANCE, CertifiedNormals
from nmatrix.linear.certified import certified_normals as _certified_normals
from nmatrix.linear.exact import LinearMap
from nmatrix.linear.rational import Rows, scaled, to_floats

Array = NDArray[Any]

FLOATS = (np.float32, np.float64)


def normal_matrices(
    matrices: ArrayLike, out: Array | None = None, level: Level = Level.CERTIFIED
) -> Array:
    """Return sign(det A)·cofactors of matrices (N, 3, 3): what outward normals are multiplied by.

    They are |det A| times the inverse transpose, and exist where an inverse does not. Only their
    direction matters: where floats would not hold one, it comes out times a power of two.

    Parameters
    ----------
    matrices
        (N, 3, 3), float32 or float64; other numbers are taken as float64. The products of float32
        numbers are exact here: the method's own share of the error is one rounding to float32.
    out
        Where to write, of the same shape; by default a new array of the input's type.
    level
        Certified: each entry within 2u, signs and zeros exact. Guarded: several times faster,
        as good as `np.linalg.inv`. Exact: correctly rounded, one matrix after the other.

    Raises
    ------
    IllegalValueError
        For another shape, an empty batch, or the first number that is not finite.

    Examples
    --------
    >>> normal_matrices([np.diag([-1.0, 2.0, 4.0])])[0].diagonal().tolist()
    [-8.0, 4.0, 2.0]
    """
    given = _batch(matrices, (3, 3), "matrices")
    found = _room(out, given)
    if level is Level.EXACT:
        for i, matrix in enumerate(given.astype(np.float64).tolist()):
            found[i] = _exact(matrix)
        return found
    return batched.normal_matrices_by_row(given, found, level)


def _exact(matrix: list[list[float]]) -> Rows:
    block = LinearMap.of(matrix)
    sign = Fraction(-1 if block.determinant_sign < 0 else 1)
    return to_floats(scaled(block.cofactor_matrix, sign))


def _room(out: Array | None, given: Array) -> Array:
    """Return where to write: what was given for that, if the answer fits there."""
    if out is None:
        return np.empty_like(given)
    if not isinstance(out, np.ndarray) or out.shape != given.shape or out.dtype not in FLOATS:
        is_array = isinstance(out, np.ndarray)
        is_what = (
            f"of shape {out.shape}, {out.dtype}" if is_array else f"of type {type(out).__name__}"
        )
        raise IllegalValueError(
            f"out {is_what}",
            f"the answer is an array {given.shape}, float32 or float64",
            "leave it out",
        )
    return out


def carry_normals(matrix: ArrayLike, normals: ArrayLike, out: Array | None = None) -> Array:
    """Return unit vectors along sign(det A)·C·n for many normals (N, 3) and one matrix (3, 3).

    The matrix is exact before its one rounding; the sums are those of the normals' own type.
    `transform_normals` rounds every component correctly, and takes its time for that.

    Raises
    ------
    IllegalValueError
        For another shape, an empty batch, or the first number that is not finite.

    Examples
    --------
    >>> carry_normals(np.diag([1.0, 2, 1]), [[1.0, 2, 0]]).round(4).tolist()
    [[0.7071, 0.7071, 0.0]]
    """
    n = _batch(normals, (3,), "normals")
    A = _finite(_numbers(matrix, "matrix"), "matrix")
    if A.shape != (3, 3):
        raise IllegalValueError(f"matrix of shape {A.shape}", "it is (3, 3)", "give the 3×3 part")
    carrier = _exact(A.astype(np.float64).tolist())
    largest = max(abs(x) for row in carrier for x in row) or 1.0
    return carried_by_row((np.array(carrier) / largest).astype(n.dtype), n, _room(out, n))


def certified_normals(
    matrices: ArrayLike, normals: ArrayLike, tolerance: float = TOLERANCE
) -> CertifiedNormals:
    """Carry one normal through each of many maps, each with a bound on the angle of its error.

    Parameters
    ----------
    matrices, normals
        (N, 3, 3) and (N, 3).
    tolerance
        In radians; what floats cannot promise within it is computed by whole numbers.

    Raises
    ------
    IllegalValueError
        For other shapes, an empty batch, or the first number that is not finite.

    Examples
    --------
    >>> found = certified_normals([np.diag([1.0, 2, 1]), np.diag([1.0, 0, 1])], [[1, 1, 0]] * 2)
    >>> found.normals.round(6).tolist()
    [[0.894427, 0.447214, 0.0], [0.0, 1.0, 0.0]]
    >>> bool((found.bound_rad < 1e-14).all()), found.status.tolist()  # the second one is two-sided
    (True, [0, 1])
    """
    if not tolerance > 0:
        raise IllegalValueError(f"tolerance ({tolerance})", "it is a positive angle", "try 1e-14")
    A = _batch(matrices, (3, 3), "matrices").astype(np.float64, copy=False)
    n = _batch(normals, (3,), "normals").astype(np.float64, copy=False)
    if len(A) != len(n):
        raise IllegalValueError(
            f"{len(A)} matrices and {len(n)} normals", "each matrix has one normal", "match them"
        )
    turned = np.ascontiguousarray(A.transpose(1, 2, 0))
    found = _certified_normals(turned, np.ascontiguousarray(n.T), tolerance)
    return replace(found, normals=found.normals.T)


def _batch(values: ArrayLike, shape: tuple[int, ...], what: str) -> Array:
    """Return an array (N, *shape) of finite floats, or say what is wrong and where."""
    given = _numbers(values, what)
    if given.ndim != 1 + len(shape) or given.shape[1:] != shape:
        wanted = ", ".join(map(str, ("N", *shape)))
        raise IllegalValueError(f"{what} of shape {given.shape}", f"they are ({wanted})", "reshape")
    if not len(given):
        raise IllegalValueError(f"0 {what}", "a batch has one at least", "leave the call out")
    return _finite(given, what)


def _numbers(values: ArrayLike, what: str) -> Array:
    """Return an array of float32 or float64."""
    try:
        given = np.asarray(values)
        if given.dtype not in FLOATS:
            given = given.astype(
                np.float64, casting="same_kind" if given.dtype.kind in "iub" else "no"
            )
    except (TypeError, ValueError):
        raise IllegalValueError(
            f"{what} of type {np.asarray(values, dtype=object).dtype}",
            "they are numbers, all of one shape",
            "give an array of floats",
        ) from None
    return given


def _finite(given: Array, what: str) -> Array:
    """Return an array if every number of it is finite."""
    good = np.isfinite(given)
    if not good.all():
        first = np.argwhere(~good)[0].tolist()
        raise IllegalValueError(
            f"{what} {first} ({given[tuple(first)]})", "it is not a finite number", "mend it"
        )
    return given
