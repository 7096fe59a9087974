"""Tacks: the marks of normals, and the places where a body shows them best.

Upright means right and leaning means wrong, from any side: seen edge-on the disc becomes the
tangent. So most of them stand on the silhouette, and some inside where the body faces the eye.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.scene.meshes.mesh import Mesh

Array = NDArray[Any]

CANDIDATES = 4000
ON_SILHOUETTE, INSIDE = 8, 5  # tacks
APART, INNER_APART = 0.45, 0.34  # of the radius, in the picture
SILHOUETTE = 0.12  # the largest |n·v| there
FACING = (0.4, 0.96)  # n·v inside
GOLDEN = (0.7548776662466927, 0.5698402909980532)  # the plane's most even sequence, R₂


@dataclass(frozen=True)
class Tack:
    """The mark of a normal: a disc at a point of the surface, and an arrow from its middle.

    The true normal (3,) places the disc; `arrow` (3,) is the normal by the rule under test.
    """

    place: Array
    normal: Array
    arrow: Array


@dataclass(frozen=True, eq=False)
class Places:
    """Points on triangles: which triangle (n,), and how much of each corner (n, 3)."""

    triangle: Array
    weights: Array

    def of(self, mesh: Mesh, values: Array) -> Array:
        """Interpolate values (V, 3) of vertices."""
        corners = values[mesh.triangles[self.triangle]]
        return np.asarray(np.einsum("nc,nck->nk", self.weights, corners))

    def some(self, which: Array) -> Places:
        """Return some of them, in an order of their own."""
        return Places(self.triangle[which], self.weights[which])


def spread_over(mesh: Mesh, points: Array, count: int = CANDIDATES) -> Places:
    """Return places spread evenly over a mesh whose vertices are at `points` (V, 3).

    They are the same each time: triangles take their share by area, in order, and places inside
    them follow the plane's most even sequence.
    """
    a, b, c = (points[mesh.triangles[:, i]] for i in range(3))
    area = np.sqrt((np.cross(b - a, c - a) ** 2).sum(axis=1))
    total = np.cumsum(area)
    if not total[-1] > 0:
        return Places(np.zeros(0, np.intp), np.zeros((0, 3)))
    steps = np.arange(count)
    triangle = np.searchsorted(total, (steps + 0.5) / count * total[-1]).clip(0, len(area) - 1)
    u, v = ((steps * one + 0.5) % 1 for one in GOLDEN)
    folded = u + v > 1
    u, v = np.where(folded, 1 - u, u), np.where(folded, 1 - v, v)
    return Places(triangle, np.stack([1 - u - v, u, v], axis=1))


def farthest_apart(points: Array, count: int, least: float, taken: Array | None = None) -> Array:
    """Choose points (n, k), each the farthest from those before, while farther than `least`.

    Begins with the first point, or beside those that are taken already; returns indices.

    Examples
    --------
    >>> farthest_apart(np.array([[0.0], [1.0], [5.0], [4.9]]), 3, 0.5).tolist()
    [0, 2, 1]
    """
    chosen: list[int] = []
    distance = np.full(len(points), np.inf)
    for one in [] if taken is None else taken:
        distance = np.minimum(distance, np.sqrt(((points - one) ** 2).sum(axis=1)))
    while len(chosen) < count and len(points):
        best = int(distance.argmax())
        if not distance[best] >= least:
            break
        chosen.append(best)
        distance = np.minimum(distance, np.sqrt(((points - points[best]) ** 2).sum(axis=1)))
    return np.array(chosen, np.intp)
