"""Vertices on the canvas: clip space, the clip, the one division by w, the snap to 1/256 sample.

Triangles are columns of indices, and corners that the clip makes are new vertices at the end. From
here on nothing knows that anything was cut.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import DepthRange
from nmatrix.linear.projection import ClipSpace
from nmatrix.raster.triangles.clip import clip, inside, whole
from nmatrix.raster.triangles.products import chunks, multiply
from nmatrix.raster.triangles.spans import SUBPIXELS, Canvas
from nmatrix.scene.meshes.mesh import Mesh

Array = NDArray[Any]


class Corners(NamedTuple):
    """The corners (3, N) of some triangles, and the name of each triangle."""

    x: Array
    y: Array
    z: Array
    triangle: Array


class Cut(NamedTuple):
    """Corners that the clip made: the vertices (3, N) of their triangle, and how much of each."""

    vertices: Array
    weights: Array


@dataclass(frozen=True, eq=False)
class Projected:
    """A mesh on the canvas.

    Parameters
    ----------
    x, y
        (V,) whole numbers of 1/256 sample; sample (i, j) is at 256·(i, j), y runs down.
    depth
        (V,) what a depth buffer stores: 0 near and 1 far, or the other way where `is_reversed`.
    inverse_w
        (V,) 1/w, positive.
    triangles
        (3, F) indices.
    culled
        The sign of the area of triangles that are left out; 0 keeps both sides.
    cut
        The vertices that the clip made, or None; they stand at the end.
    source
        (F,) the mesh's own triangle that each comes from, or None where they are the same.
    """

    x: Array
    y: Array
    depth: Array
    inverse_w: Array
    triangles: Array
    culled: int = 0
    cut: Cut | None = None
    source: Array | None = None
    is_reversed: bool = False

    @cached_property
    def box(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """The least and the largest x and y of all vertices, in samples."""
        low, high = ((f(self.x), f(self.y)) for f in (np.min, np.max))
        return tuple((float(x) / SUBPIXELS, float(y) / SUBPIXELS) for x, y in (low, high))  # type: ignore[return-value]  # two

    def chunks(self, size: int, rows: tuple[int, int]) -> Iterator[Corners]:
        """Return triangles that can cover something, some at a time, so that memory is bounded."""
        low, high = (row * SUBPIXELS for row in rows)
        for first in range(0, self.triangles.shape[1], size):
            indices = np.ascontiguousarray(self.triangles[:, first : first + size])
            y = self.y.take(indices)
            if y.min() >= high or y.max() < low:
                continue
            x = self.x.take(indices)
            area = signed_area(x, y)
            kept = np.flatnonzero(area * self.culled < 0 if self.culled else area)
            if len(kept) < indices.shape[1]:
                x, y, indices = (one.take(kept, 1) for one in (x, y, indices))
            if len(kept):
                yield Corners(x, y, self.depth.take(indices), kept + first)

    def corners(self, triangles: Array) -> Array:
        """Return the vertices (3, n) of some triangles; whole rows of indices are read at once."""
        return np.ascontiguousarray(self.triangles.T.take(triangles, 0).T)

    def per_triangle(self, values: Array) -> Array:
        """Return values (k, F) of the mesh's triangles for those of the clip too."""
        return values if self.source is None else values[:, self.source]

    def per_vertex(self, values: Array) -> Array:
        """Return values (k, V) of the mesh's vertices for those of the clip too."""
        if self.cut is None:
            return values
        of_corners = values[:, self.cut.vertices]
        made = np.einsum("ksn,nis->kni", of_corners, self.cut.weights)
        return np.concatenate([values, made.reshape(len(values), -1)], axis=1)


def signed_area(x: Array, y: Array) -> Array:
    """Return twice the area of triangles (3, N), exactly: products of whole numbers below 2⁵³."""
    return np.asarray((x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]))


def project(
    mesh: Mesh, clip_from_object: Array, canvas: Canvas, space: ClipSpace, culled: int = 0
) -> Projected:
    """Return a mesh on the canvas.

    Where every vertex lies inside, nothing is cut and nothing is copied.
    """
    is_reversed = space.depth is DepthRange.REVERSED
    divided = _all_inside(mesh, clip_from_object, canvas, space)
    if divided is not None:
        x, y, z, inverse_w = divided
        return Projected(x, y, z, inverse_w, mesh.triangles.T, culled, is_reversed=is_reversed)
    with np.errstate(over="ignore", invalid="ignore"):
        corners = multiply(clip_from_object, mesh.positions.T)
        seen = inside(corners, space.depth, canvas)
    whole_ones = seen.take(mesh.triangles).all(axis=1)
    uncut, crossing = np.flatnonzero(whole_ones), np.flatnonzero(~whole_ones)
    cut = clip(whole(corners.T[mesh.triangles[crossing]], crossing), space.depth, canvas)
    made = cut.corners.reshape(-1, 4).T
    corners[:, ~seen] = 1.0  # no triangle uses these any more
    added = np.arange(made.shape[1]).reshape(-1, 3) + corners.shape[1]
    return Projected(
        *_divided(np.concatenate([corners, made], axis=1), canvas, space),
        np.concatenate([mesh.triangles[uncut], added]).T,
        culled,
        Cut(mesh.triangles[cut.source].T, cut.weights),
        np.concatenate([uncut, cut.source]),
        is_reversed,
    )


def _all_inside(
    mesh: Mesh, clip_from_object: Array, canvas: Canvas, space: ClipSpace
) -> Array | None:
    """Return x, y, depth and 1/w of every vertex, or None if something cuts one of them off."""
    found = np.empty((4, len(mesh.positions)))
    first = 0
    for part in chunks(mesh.positions.T):
        with np.errstate(over="ignore", invalid="ignore"):
            corners = multiply(clip_from_object, part)
            if not inside(corners, space.depth, canvas).all():
                return None
        last = first + part.shape[1]
        found[:, first:last] = _divided(corners, canvas, space)
        first = last
    return found


def _divided(corners: Array, canvas: Canvas, space: ClipSpace) -> tuple[Array, Array, Array, Array]:
    """Return snapped x and y, window depth and 1/w of corners (4, V) with w > 0."""
    inverse_w = 1.0 / corners[3]
    ndc = corners[:3] * inverse_w
    half = SUBPIXELS / 2
    x = np.rint((ndc[0] + 1.0) * (canvas.columns * half) - half)
    y = np.rint((1.0 - space.y_sign * ndc[1]) * (canvas.rows * half) - half)
    depth = (ndc[2] + 1.0) / 2 if space.depth is DepthRange.MINUS_ONE_TO_ONE else ndc[2]
    return x, y, depth, inverse_w
