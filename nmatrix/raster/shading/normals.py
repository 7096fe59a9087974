"""Many normals at once: length one, the side that is seen, the angle between two."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]


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
    """Return normals (3, …) on the side that is seen, for surfaces whose sides are alike.

    Examples
    --------
    >>> turned_towards(np.array([[0.0], [-1.0], [0.0]]), np.array([[0.0], [2.0], [1.0]])).tolist()
    [[-0.0], [1.0], [-0.0]]
    """
    behind = (normals * to_eye).sum(axis=0) < 0
    return np.asarray(np.where(behind, -normals, normals))


def angles_deg(a: Array, b: Array) -> Array:
    """Return the angles between unit vectors in degrees: atan2 of |a×b| and a·b, never acos."""
    sine = np.sqrt((np.cross(a, b) ** 2).sum(axis=1))
    return np.asarray(np.degrees(np.arctan2(sine, (a * b).sum(axis=1))))
