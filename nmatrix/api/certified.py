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
    found = np.empty(given.shape, given.dtype) if out is None else _checked(out, given)
    if level is Level.EXACT:
        for i, matrix in enumerate(given.astype(np.float64).tolist()):
            found[i] = _exact(matrix)
        return found
    return batched.normal_matrices_by_row(given, found, level)


def _exact(matrix: list[list[float]]) -> Rows:
    block = LinearMap.of(matrix)
    sign = Fraction(-1 if block.determinant_sign < 0 else 1)
    return to_floats(scaled(block.cofactor_matrix, sign))


def _checked(out: Array, given: Array) -> Array:
    """Return where to write, if the answer fits there."""
    if out.shape != given.shape or out.dtype not in FLOATS:
        raise IllegalValueError(
            f"out of shape {out.shape}, {out.dtype}",
            f"the answer is {given.shape}, float32 or float64",
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
    A = _batch(np.asarray(matrix)[None], (3, 3), "matrices")
    carrier = normal_matrices(A.astype(np.float64), level=Level.EXACT)[0]
    carrier = carrier / (np.abs(carrier).max() or 1.0)
    return carried_by_row(carrier.astype(n.dtype), n, np.empty_like(n) if out is None else out)


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
    if given.ndim != 1 + len(shape) or given.shape[1:] != shape:
        wanted = ", ".join(map(str, ("N", *shape)))
        raise IllegalValueError(f"{what} of shape {given.shape}", f"they are ({wanted})", "reshape")
    if not len(given):
        raise IllegalValueError(f"0 {what}", "a batch has one at least", "leave the call out")
    good = np.isfinite(given)
    if not good.all():
        first = np.argwhere(~good)[0].tolist()
        raise IllegalValueError(
            f"{what} {first} ({given[tuple(first)]})", "it is not a finite number", "mend it"
        )
    return given
