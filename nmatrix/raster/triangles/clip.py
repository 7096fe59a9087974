"""Clip triangles in homogeneous coordinates, before anything is divided by w.

A triangle is three rows of clip coordinates and three rows of weights: how much of each of its
original vertices a corner holds, so that attributes can follow later.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import DepthRange
from nmatrix.raster.triangles.spans import Canvas

Array = NDArray[Any]

GUARD = 2.0**15  # samples on either side of the middle; beyond them triangles are cut
PLANES = (
    "behind the eye",
    "nearer than the near plane",
    "beyond the far plane",
    *("off the screen",) * 4,
)
SMALLEST_W = 1e-300  # a corner with w > 0 stays away from the eye plane


@dataclass(frozen=True, eq=False)
class Triangles:
    """Corners (N, 3, 4) in clip space, weights (N, 3, 3), and the original triangle of each."""

    corners: Array
    weights: Array
    source: Array

    def kept(self, which: Array) -> Triangles:
        """Return some of the triangles."""
        return Triangles(self.corners[which], self.weights[which], self.source[which])


def whole(corners: Array, source: Array) -> Triangles:
    """Return triangles that nothing has cut yet."""
    return Triangles(corners, np.broadcast_to(np.eye(3), (len(corners), 3, 3)), source)


def clip(triangles: Triangles, depth: DepthRange, canvas: Canvas) -> Triangles:
    """Cut triangles to what lies between near and far and inside the guard band.

    Every plane is a linear function of the clip coordinates that is ≥ 0 inside; a point with
    w ≤ 0 is outside of at least one, so none survives.
    """
    for plane in _planes(depth, canvas):
        triangles = _cut(triangles, np.array(plane))
    return triangles.kept(np.asarray((triangles.corners[:, :, 3] > SMALLEST_W).all(axis=1)))


def inside(corners: Array, depth: DepthRange, canvas: Canvas) -> Array:
    """Return a mask of the corners (4, V) that nothing cuts off; what is not finite is outside."""
    x, y, z, w = corners
    near, far = (w - z, z) if depth is DepthRange.REVERSED else (z, w - z)
    if depth is DepthRange.MINUS_ONE_TO_ONE:
        near = z + w
    kept = (w > SMALLEST_W) & (near >= 0) & (far >= 0)
    kept &= np.abs(x) <= 2 * GUARD / canvas.columns * w
    kept &= np.abs(y) <= 2 * GUARD / canvas.rows * w
    return np.asarray(kept)


def all_beyond(corners: Array, depth: DepthRange) -> Array:
    """Tell for each plane of the view, named in `PLANES`, if all corners (4, V) lie beyond it.

    Then no triangle between them covers a sample: the edge of the canvas is half a sample away
    from the nearest, and the snap moves corners by a 512th at the most.
    """
    x, y, z, w = corners
    near, far = (w - z, z) if depth is DepthRange.REVERSED else (z, w - z)
    if depth is DepthRange.MINUS_ONE_TO_ONE:
        near = z + w
    beyond = (w <= SMALLEST_W, near < 0, far < 0, x < -w, x > w, y < -w, y > w)
    return np.array([one.all() for one in beyond])


def _planes(depth: DepthRange, canvas: Canvas) -> list[tuple[float, float, float, float]]:
    near, far = {
        DepthRange.MINUS_ONE_TO_ONE: ((0.0, 0.0, 1.0, 1.0), (0.0, 0.0, -1.0, 1.0)),
        DepthRange.ZERO_TO_ONE: ((0.0, 0.0, 1.0, 0.0), (0.0, 0.0, -1.0, 1.0)),
        DepthRange.REVERSED: ((0.0, 0.0, -1.0, 1.0), (0.0, 0.0, 1.0, 0.0)),
    }[depth]
    eye = (0.0, 0.0, 0.0, 1.0)
    x, y = 2 * GUARD / canvas.columns, 2 * GUARD / canvas.rows
    return [near, eye, far, (1, 0, 0, x), (-1, 0, 0, x), (0, 1, 0, y), (0, -1, 0, y)]


def _cut(triangles: Triangles, plane: Array) -> Triangles:
    distance = triangles.corners @ plane
    inside = distance >= 0
    count = inside.sum(axis=1)
    if (count == 3).all():
        return triangles
    parts = [triangles.kept(count == 3)]
    for kept in (1, 2):
        which = np.flatnonzero(count == kept)
        if len(which):
            parts.append(_cut_group(triangles.kept(which), distance[which], inside[which], kept))
    return Triangles(
        np.concatenate([part.corners for part in parts]),
        np.concatenate([part.weights for part in parts]),
        np.concatenate([part.source for part in parts]),
    )


def _cut_group(triangles: Triangles, distance: Array, inside: Array, kept: int) -> Triangles:
    """Cut triangles with one or two corners inside; the odd corner is turned to the front."""
    odd = np.argmax(inside if kept == 1 else ~inside, axis=1)
    turn = (odd[:, None] + np.arange(3)) % 3
    corners = np.take_along_axis(triangles.corners, turn[:, :, None], 1)
    weights = np.take_along_axis(triangles.weights, turn[:, :, None], 1)
    d = np.take_along_axis(distance, turn, 1)
    joined = np.concatenate([corners, weights], axis=2)
    p, q, r = joined[:, 0], joined[:, 1], joined[:, 2]
    pq = _crossing(p, q, d[:, 0], d[:, 1])
    pr = _crossing(p, r, d[:, 0], d[:, 2])
    pieces = [(p, pq, pr)] if kept == 1 else [(pq, q, r), (pq, r, pr)]
    stacked = np.concatenate([np.stack(piece, axis=1) for piece in pieces])
    source = np.concatenate([triangles.source] * len(pieces))
    return Triangles(stacked[:, :, :4], stacked[:, :, 4:], source)


def _crossing(a: Array, b: Array, da: Array, db: Array) -> Array:
    """Return the points where edges meet the plane, from the smaller end: neighbours agree."""
    swap = _is_larger(a[:, :4], b[:, :4])[:, None]
    a, b = np.where(swap, b, a), np.where(swap, a, b)
    da, db = np.where(swap[:, 0], db, da), np.where(swap[:, 0], da, db)
    t = (da / (da - db))[:, None]
    return np.asarray(a + t * (b - a))


def _is_larger(a: Array, b: Array) -> Array:
    """Compare rows in lexicographic order."""
    first = np.argmax(a != b, axis=1)[:, None]
    larger = np.take_along_axis(a, first, 1) > np.take_along_axis(b, first, 1)
    return np.asarray(larger[:, 0])
