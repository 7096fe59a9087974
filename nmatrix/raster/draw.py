"""The pipeline: vertices to clip space, clip, snap, cover, see; attributes where it is seen."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import ClipY, DepthRange
from nmatrix.linear.projection import ClipSpace
from nmatrix.linear.rational import Rows
from nmatrix.raster.clip import Triangles, clip, whole
from nmatrix.raster.cover import SUBPIXELS, snap
from nmatrix.raster.visibility import visible
from nmatrix.scene.mesh import Mesh

Array = NDArray[Any]

BAND_SAMPLES = 1 << 18  # about 100 MB of samples, fragments and their attributes


@dataclass(frozen=True)
class Canvas:
    """A picture's size in pixels, and samples along one side of a pixel."""

    width: int
    height: int
    per_side: int = 1

    @property
    def columns(self) -> int:
        """Return the samples in a row."""
        return self.width * self.per_side

    @property
    def rows(self) -> int:
        """Return the samples in a column."""
        return self.height * self.per_side


@dataclass(frozen=True, eq=False)
class Frame:
    """What is seen: for each covered sample its place, triangle and perspective-correct weights."""

    canvas: Canvas
    pixel: Array
    triangle: Array
    weights: Array
    triangles: int
    fragments: int

    def interpolate(self, mesh: Mesh, values: Array) -> Array:
        """Return values given per vertex at every covered sample."""
        corners = values[mesh.triangles[self.triangle]]
        return np.asarray((corners * self.weights[:, :, None]).sum(axis=1))

    def resolve(self, values: Array) -> Array:
        """Return (height, width, …): values of the samples, averaged into pixels, 0 where empty."""
        canvas, k = self.canvas, self.canvas.per_side
        image = np.zeros((canvas.rows * canvas.columns, *values.shape[1:]))
        image[self.pixel] = values
        grid = image.reshape(canvas.height, k, canvas.width, k, *values.shape[1:])
        return np.asarray(grid.mean(axis=(1, 3)))


@dataclass(frozen=True, eq=False)
class Projected:
    """Triangles on the canvas: snapped corners (N, 3, 2), depth and w (N, 3), and their origin."""

    canvas: Canvas
    triangles: int
    points: Array
    depth: Array
    w: Array
    cut: Triangles

    def bands(self) -> Iterator[Frame]:
        """Draw the canvas from top to bottom, as many pixel rows at a time as memory is meant for.

        Corners are integers, so moving them up by whole rows changes no sample.
        """
        per_row = self.canvas.columns * self.canvas.per_side
        step = max(1, BAND_SAMPLES // per_row)
        for top in range(0, self.canvas.height, step):
            yield self.band(top, min(step, self.canvas.height - top))

    def band(self, top: int, height: int) -> Frame:
        """Return what is seen in some pixel rows; weights are perspective-correct, in [0, 1]."""
        canvas = Canvas(self.canvas.width, height, self.canvas.per_side)
        points = self.points - np.array([0, top * canvas.per_side * SUBPIXELS])
        seen = visible(points, self.depth, canvas.columns, canvas.rows)
        weights = np.clip(seen.barycentric, 0.0, 1.0) / self.w[seen.triangle]
        weights /= weights.sum(axis=1, keepdims=True)
        original = np.einsum("si,sij->sj", weights, self.cut.weights[seen.triangle])
        source = self.cut.source[seen.triangle]
        return Frame(canvas, seen.pixel, source, original, self.triangles, seen.fragments)


def project(mesh: Mesh, clip_from_object: Rows, canvas: Canvas, space: ClipSpace) -> Projected:
    """Return the triangles of a mesh on the canvas: in clip space, cut, divided by w, snapped."""
    ones = np.ones((len(mesh.positions), 1))
    corners = np.hstack([mesh.positions, ones]) @ np.array(clip_from_object).T
    cut = clip(whole(corners[mesh.triangles]), space.depth, canvas.columns, canvas.rows)
    w = cut.corners[:, :, 3]
    ndc = cut.corners[:, :, :3] / w[:, :, None]
    depth = _depth(ndc[:, :, 2], space.depth)
    return Projected(canvas, len(mesh.triangles), snap(_pixels(ndc, canvas, space)), depth, w, cut)


def draw(mesh: Mesh, clip_from_object: Rows, canvas: Canvas, space: ClipSpace) -> Frame:
    """Return what a camera sees of a mesh, as one band; memory follows the canvas."""
    return project(mesh, clip_from_object, canvas, space).band(0, canvas.height)


def _pixels(ndc: Array, canvas: Canvas, space: ClipSpace) -> Array:
    """Return sample coordinates, x to the right and y downwards."""
    down = 1.0 if space.clip_y is ClipY.DOWN else -1.0
    size = np.array([canvas.columns, canvas.rows])
    return np.asarray((ndc[:, :, :2] * np.array([1.0, down]) + 1) / 2 * size)


def _depth(z: Array, depth: DepthRange) -> Array:
    if depth is DepthRange.MINUS_ONE_TO_ONE:
        return np.asarray((z + 1) / 2)
    return np.asarray(1 - z if depth is DepthRange.REVERSED else z)
