"""The pipeline: vertices to clip space, clip, snap, cover, see; attributes where it is seen."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import ClipY, DepthRange
from nmatrix.linear.projection import ClipSpace
from nmatrix.linear.rational import Rows
from nmatrix.raster.clip import clip, whole
from nmatrix.raster.cover import snap
from nmatrix.raster.visibility import visible
from nmatrix.scene.mesh import Mesh

Array = NDArray[Any]


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

    def picture(self, colours: Array, background: float) -> Array:
        """Return an image (height, width, 3): samples averaged into pixels."""
        canvas = self.canvas
        image = np.full((canvas.rows * canvas.columns, 3), background)
        image[self.pixel] = colours
        k = canvas.per_side
        return np.asarray(image.reshape(canvas.height, k, canvas.width, k, 3).mean(axis=(1, 3)))


def draw(mesh: Mesh, clip_from_object: Rows, canvas: Canvas, space: ClipSpace) -> Frame:
    """Return what a camera sees of a mesh.

    Weights are divided by w and made to add up to one again: perspective-correct, and each lies
    in [0, 1].
    """
    matrix = np.array(clip_from_object)
    ones = np.ones((len(mesh.positions), 1))
    corners = np.hstack([mesh.positions, ones]) @ matrix.T
    cut = clip(whole(corners[mesh.triangles]), space.depth, canvas.columns, canvas.rows)
    w = cut.corners[:, :, 3]
    ndc = cut.corners[:, :, :3] / w[:, :, None]
    points = snap(_pixels(ndc, canvas, space))
    seen = visible(points, _depth(ndc[:, :, 2], space.depth), canvas.columns, canvas.rows)
    weights = np.clip(seen.barycentric, 0.0, 1.0) / w[seen.triangle]
    weights /= weights.sum(axis=1, keepdims=True)
    original = np.einsum("si,sij->sj", weights, cut.weights[seen.triangle])
    return Frame(
        canvas,
        seen.pixel,
        cut.source[seen.triangle],
        original,
        len(mesh.triangles),
        seen.fragments,
    )


def _pixels(ndc: Array, canvas: Canvas, space: ClipSpace) -> Array:
    """Return sample coordinates, x to the right and y downwards."""
    down = 1.0 if space.clip_y is ClipY.DOWN else -1.0
    size = np.array([canvas.columns, canvas.rows])
    return np.asarray((ndc[:, :, :2] * np.array([1.0, down]) + 1) / 2 * size)


def _depth(z: Array, depth: DepthRange) -> Array:
    if depth is DepthRange.MINUS_ONE_TO_ONE:
        return np.asarray((z + 1) / 2)
    return np.asarray(1 - z if depth is DepthRange.REVERSED else z)
