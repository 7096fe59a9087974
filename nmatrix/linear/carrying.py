"""Many normals through one matrix, to length one: chunks that stay in the cache, one pass each.

For float64 and float32 alike, within a few u of the type. Vectors shorter or longer than squares
allow are scaled first; zero stays zero.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]

CHUNK = 1 << 16  # vectors whose products and lengths take 2 MiB


def carried_by_row(matrix: Array, normals: Array, out: Array) -> Array:
    """Write unit vectors along N n for rows (N, 3) into `out`, and return it.

    Examples
    --------
    >>> given = np.array([[3.0, 0, 2.0]])
    >>> carried_by_row(np.diag([1.0, 1, 2]), given, np.empty_like(given)).tolist()
    [[0.6, 0.0, 0.8]]
    """
    moved = np.empty((3, CHUNK), normals.dtype)
    for first in range(0, len(normals), CHUNK):
        some = normals[first : first + CHUNK]
        part = moved if len(some) == CHUNK else np.empty((3, len(some)), normals.dtype)
        np.matmul(matrix, some.T, out=part)
        _normalise(part)
        np.copyto(out[first : first + CHUNK], part.T)
    return out


def carried_by_column(matrix: Array, normals: Array, out: Array) -> Array:
    """Do the same for structures of arrays (3, N)."""
    for first in range(0, normals.shape[1], CHUNK):
        part = out[:, first : first + CHUNK]
        some = normals[:, first : first + CHUNK]
        np.matmul(matrix, some, out=part)
        _normalise(part)
    return out


def _normalise(vectors: Array) -> None:
    """Bring vectors (3, n) to length one, in place."""
    squares = vectors[0] * vectors[0]
    squares += vectors[1] * vectors[1]
    squares += vectors[2] * vectors[2]
    low, high = squares.min(initial=1.0), squares.max(initial=1.0)
    tiny = np.finfo(vectors.dtype).tiny
    if not (low > tiny / np.finfo(vectors.dtype).eps and np.isfinite(high)):
        largest = np.abs(vectors).max(axis=0)
        np.divide(vectors, largest, out=vectors, where=largest > 0)
        squares = (vectors * vectors).sum(axis=0)
    long = np.sqrt(squares, out=squares)
    if not long.all():
        long[long == 0] = 1.0
    vectors /= long
