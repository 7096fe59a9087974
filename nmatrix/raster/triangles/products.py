"""Multiply many points or vectors by one matrix in a fixed order of summation.

A library's matrix product may round the last columns of an array otherwise than the rest. Here two
vertices in one place come out in one place, bit for bit, wherever they stand in their arrays.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]

PART = 1 << 20  # vertices that are held at once besides a mesh's own


def multiply(matrix: Array, vectors: Array) -> Array:
    """Multiply a matrix (k, 3) by vectors (3, …), or a matrix (k, 4) by points (w = 1).

    Examples
    --------
    >>> multiply(np.array([[0.0, 2, 0, 1]]), np.array([[1.0], [5], [0]])).tolist()
    [[11.0]]
    """
    out = np.empty((len(matrix), *vectors.shape[1:]))
    for i, row in enumerate(matrix):
        np.multiply(vectors[0], row[0], out=out[i])
        out[i] += vectors[1] * row[1]
        out[i] += vectors[2] * row[2]
        if matrix.shape[1] == 4:
            out[i] += row[3]
    return out


def chunks(columns: Array) -> Iterator[Array]:
    """Cut an array (k, n) into groups of columns, so that memory is bounded."""
    for first in range(0, columns.shape[1], PART):
        yield columns[:, first : first + PART]
