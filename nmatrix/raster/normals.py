"""Normals of a whole mesh through one matrix, by the right rule and by the wrong one."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.linear.exact import LinearMap
from nmatrix.linear.rational import RationalMatrix
from nmatrix.linear.rounding import nearest

Array = NDArray[Any]


def outward(linear_map: LinearMap, normals: Array) -> Array:
    """Return sign(det A) · C n at length one; zero where no normal is left.

    The largest cofactor is scaled to one first: nothing over- or underflows.
    """
    sign = -1 if linear_map.integer_determinant < 0 else 1
    return through(_scaled(linear_map.cofactors, sign), normals)


def moved_by_matrix(linear_map: LinearMap, normals: Array) -> Array:
    """Return A n at length one: what a wrong shader does."""
    return through(_scaled(linear_map.entries, 1), normals)


def through(matrix: Array, normals: Array) -> Array:
    """Return the normals times a matrix, at length one, or zero where nothing is left."""
    return unit(normals @ matrix.T)


def unit(vectors: Array, shortest: float = 0.0) -> Array:
    """Return vectors (..., 3) at length one; what is not longer than `shortest` becomes zero.

    Each is scaled by its largest component first, so no square over- or underflows.

    Examples
    --------
    >>> unit(np.array([[3e-200, 0, 4e-200], [0, 0, 0]])).tolist()
    [[0.6, 0.0, 0.8], [0.0, 0.0, 0.0]]
    """
    largest = np.abs(vectors).max(axis=-1, keepdims=True)
    scaled = np.divide(vectors, largest, out=np.zeros_like(vectors), where=largest > 0)
    length = np.sqrt((scaled * scaled).sum(axis=-1, keepdims=True))
    kept = (largest > shortest) & (length > 0)
    return np.asarray(np.divide(scaled, length, out=np.zeros_like(vectors), where=kept))


def turned_towards(normals: Array, to_eye: Array) -> Array:
    """Return normals on the side that is seen, for surfaces whose sides are alike.

    Examples
    --------
    >>> turned_towards(np.array([[0.0, -1.0, 0.0]]), np.array([[0.0, 2.0, 1.0]])).tolist()
    [[-0.0, 1.0, -0.0]]
    """
    behind = (normals * to_eye).sum(axis=1, keepdims=True) < 0
    return np.asarray(np.where(behind, -normals, normals))


def angles_deg(a: Array, b: Array) -> Array:
    """Return the angles between unit vectors in degrees: atan2 of |a×b| and a·b, never acos."""
    sine = np.sqrt((np.cross(a, b) ** 2).sum(axis=1))
    return np.asarray(np.degrees(np.arctan2(sine, (a * b).sum(axis=1))))


def _scaled(entries: tuple[tuple[int, ...], ...], sign: int) -> Array:
    from fractions import Fraction

    largest = max(abs(entry) for row in entries for entry in row) or 1
    rows: RationalMatrix = tuple(
        tuple(Fraction(sign * entry, largest) for entry in row) for row in entries
    )
    return np.array([[nearest(entry) for entry in row] for row in rows])
