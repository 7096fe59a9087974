"""Normals and kinds of maps for arrays: batches run over the leading axes, each one exact."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from nmatrix.errors import IllegalValueError, NoAnswerError
from nmatrix.linear import rational
from nmatrix.linear.classify import Classification
from nmatrix.linear.classify import classify as _classify
from nmatrix.linear.exact import LinearMap
from nmatrix.linear.vectors import normalize as _normalize

Array = NDArray[np.float64]


def classify(matrix: ArrayLike, tolerance: float = 1e-12) -> Classification:
    """Say what kind of map a (3, 3) or affine (4, 4) matrix is; rank and mirroring are exact.

    Examples
    --------
    >>> classify(np.diag([1.0, -1.0, 1.0])).mirrored
    True
    """
    return _classify(_finite(matrix).tolist(), tolerance)


def normal_matrix(matrices: ArrayLike) -> Array:
    """Return the inverse transpose of the 3×3 blocks, (..., 3, 3), correctly rounded.

    Raises
    ------
    NoAnswerError
        If a matrix is singular; `cofactor_matrix` exists even then.

    Examples
    --------
    >>> normal_matrix(np.diag([1.0, 2.0, 4.0])).diagonal().tolist()
    [1.0, 0.5, 0.25]
    """
    return _for_each_block(matrices, lambda block: block.inverse_transpose)


def cofactor_matrix(matrices: ArrayLike) -> Array:
    """Return det · inverse transpose of the 3×3 blocks, (..., 3, 3), correctly rounded.

    Examples
    --------
    >>> cofactor_matrix(np.diag([1.0, 2.0, 0.0])).diagonal().tolist()
    [0.0, 0.0, 2.0]
    """
    return _for_each_block(matrices, lambda block: block.cofactor_matrix)


def transform_normals(matrix: ArrayLike, normals: ArrayLike) -> Array:
    """Carry normals (..., 3) through one (3, 3) or (4, 4) matrix, to unit length.

    Every component is correctly rounded; mirrors keep the outward side.

    Raises
    ------
    NoAnswerError
        If a normal has no image: the zero vector, or a silhouette of a flattening map.

    Examples
    --------
    >>> transform_normals(np.diag([1.0, 2.0, 1.0]), [1, 2, 0]).round(4).tolist()
    [0.7071, 0.7071, 0.0]
    """
    block = LinearMap.of(_finite(matrix)[:3, :3].tolist())
    given = _finite(normals)
    out = np.empty_like(given)
    for index in np.ndindex(given.shape[:-1]):
        found = block.normal(given[index].tolist())
        if found.direction is None:
            raise NoAnswerError(
                f"normal {list(index)} ({given[index].tolist()})", found.reason, "leave it out"
            )
        out[index] = found.direction
    return out


def normalize(vectors: ArrayLike) -> Array:
    """Return vectors (..., 3) at length one, correctly rounded, whatever their length was.

    Examples
    --------
    >>> normalize([3e-320, 4e-320, 0]).tolist()
    [0.6, 0.8, 0.0]
    """
    given = _finite(vectors)
    out = np.empty_like(given)
    for index in np.ndindex(given.shape[:-1]):
        out[index] = _normalize(given[index].tolist())
    return out


def _for_each_block(
    matrices: ArrayLike, answer: Callable[[LinearMap], rational.RationalMatrix]
) -> Array:
    given = _finite(matrices)
    if given.ndim < 2 or given.shape[-2:] not in ((3, 3), (4, 4)):
        raise IllegalValueError(
            f"an array of shape {given.shape}",
            "matrices are (..., 3, 3) or (..., 4, 4)",
            "reshape it",
        )
    out = np.empty((*given.shape[:-2], 3, 3))
    for index in np.ndindex(given.shape[:-2]):
        block = LinearMap.of(given[index][:3, :3].tolist())
        out[index] = rational.to_floats(answer(block))
    return out


def _finite(values: ArrayLike) -> NDArray[Any]:
    given = np.asarray(values, dtype=np.float64)
    if not np.isfinite(given).all():
        first = np.argwhere(~np.isfinite(given))[0].tolist()
        raise IllegalValueError(
            f"entry {first} ({given[tuple(first)]})",
            "it is not a finite number",
            "use finite numbers",
        )
    return given
