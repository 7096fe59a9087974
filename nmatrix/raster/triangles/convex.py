"""Convex sets as edges and planes: boxes around meshes, the view's frustum, and where two meet.

Points are rows of homogeneous coordinates with w ≥ 0, so that a frustum may reach to infinity. A
corner of what two sets share lies on an edge of one of them: edges cut by the other's planes find
all of it.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import DepthRange

Array = NDArray[Any]

CORNERS = np.array(list(product((-1.0, 1.0), repeat=3)))
EDGES = np.array([(i, i | 1 << axis) for axis in range(3) for i in range(8) if not i >> axis & 1])
NEAR_CORNERS = CORNERS[:, 2] < 0  # of a frustum
SKIN = 1e-9  # of the radius: boxes are this much larger, so that rounding loses no corner


@dataclass(frozen=True, eq=False)
class Convex:
    """A hexahedron: its corners (8, 4), and planes (6, 4) that are ≥ 0 inside of it."""

    corners: Array
    planes: Array

    def meeting(self, *others: Convex) -> Array:
        """Return the corners (n, 4) of what sets share that lie on an edge of one of them.

        Of two sets these are all; of more, a corner where three faces cross is not among them.
        """
        sets = (self, *others)
        return np.concatenate(
            [
                _inside(one, np.concatenate([other.planes for other in sets if other is not one]))
                for one in sets
            ]
        )


def _inside(one: Convex, planes: Array) -> Array:
    """Return the ends of what planes leave of a set's edges."""
    a, b = one.corners[EDGES[:, 0]], one.corners[EDGES[:, 1]]
    at_a, at_b = a @ planes.T, b @ planes.T
    with np.errstate(divide="ignore", invalid="ignore"):
        crossing = at_a / (at_a - at_b)
    first = np.where((at_a < 0) & (at_b >= 0), crossing, 0.0).max(axis=1)
    last = np.where((at_a >= 0) & (at_b < 0), crossing, 1.0).min(axis=1)
    kept = (first <= last) & ~((at_a < 0) & (at_b < 0)).any(axis=1)
    a, way = a[kept], (b - a)[kept]
    return np.concatenate([a + first[kept, None] * way, a + last[kept, None] * way])


def box_around(low: Array, high: Array, world_from_object: Array) -> Convex:
    """Return the box of an object's coordinates, carried to the world by a matrix (3 or 4, 4).

    A box that the map or the mesh flattens keeps its six planes: thin ones along the way.
    """
    matrix = world_from_object[:3]
    edges = (matrix[:, :3] * ((high - low) / 2)).T
    middle = matrix[:, :3] @ ((low + high) / 2) + matrix[:, 3]
    radius = float(np.abs(edges).sum(axis=0).max()) or 1.0
    corners = middle + CORNERS @ edges
    spanning = _spanning(edges, radius)
    planes = []
    for i in range(3):
        normal = np.cross(spanning[i - 2], spanning[i - 1])
        size = float(np.sqrt(normal @ normal))
        if size == 0.0:
            continue
        normal /= size
        reach = float(np.abs(edges @ normal).sum()) + SKIN * radius
        planes += [(*(sign * normal), reach - sign * (normal @ middle)) for sign in (1.0, -1.0)]
    return Convex(np.column_stack([corners, np.ones(8)]), np.array(planes).reshape(-1, 4))


def _spanning(edges: Array, radius: float) -> Array:
    """Return three vectors along a box's edges, where those without a length are made up."""
    found: Array = edges / radius
    for i in range(3):
        if not np.abs(found[i]).max() > SKIN:
            others = np.delete(found, i, axis=0)
            across = np.cross(*others)
            if not np.abs(across).max() > SKIN**2:
                longest = others[np.abs(others).max(axis=1).argmax()]
                across = np.cross(longest, np.eye(3)[np.abs(longest).argmin()])
            size = float(np.sqrt(across @ across))
            found[i] = across / size if size else np.eye(3)[i]
    return found


def frustum(clip_from_world: Array, world_from_clip: Array, depth: DepthRange) -> Convex:
    """Return what a camera sees: clip space between its six planes, carried to the world."""
    x, y, z, w = clip_from_world
    behind_near = {
        DepthRange.MINUS_ONE_TO_ONE: (w + z, w - z),
        DepthRange.ZERO_TO_ONE: (z, w - z),
        DepthRange.REVERSED: (w - z, z),
    }[depth]
    nearest = -1.0 if depth is DepthRange.MINUS_ONE_TO_ONE else 0.0
    in_clip = np.column_stack([CORNERS, np.ones(8)])
    in_clip[:, 2] = np.where(CORNERS[:, 2] > 0, 1.0, nearest)
    return Convex(in_clip @ world_from_clip.T, np.array([w + x, w - x, w + y, w - y, *behind_near]))
