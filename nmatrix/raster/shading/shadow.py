"""Shadow maps: how far a lamp's light gets, seen from the lamp, by the same rasterizer.

A map holds distances along the lamp's axis. Where a point looks into it, the four texels around it
are compared with the point's own distance, and weighted bilinearly: the share of them that is lit
is the share of light that arrives.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import DepthRange, Handedness
from nmatrix.linear import rational
from nmatrix.linear.projection import ClipSpace
from nmatrix.linear.rational import RationalMatrix
from nmatrix.raster.loaded_scene import Body
from nmatrix.raster.shading.opacity import solid
from nmatrix.raster.shading.space import ShadingSpace, as_array
from nmatrix.raster.triangles.products import multiply
from nmatrix.raster.triangles.spans import Canvas
from nmatrix.raster.triangles.vertices import project
from nmatrix.raster.triangles.visibility import EMPTY, STEPS, TRIANGLE_BITS, Tile
from nmatrix.scene.words import DepthBuffer
from nmatrix.shaders.shaded import LEAST_COSINE

Array = NDArray[Any]

CLIP = ClipSpace(DepthRange.ZERO_TO_ONE, Handedness.RIGHT)
# A texel that has a say is less than √2 texels away. On a plane that light meets with the cosine c,
# distances differ there by less than √2/c texels, under a parallel view and a perspective alike.
SLACK = 1.5


@dataclass(frozen=True)
class LightView:
    """One view from a lamp, fitted to what is seen and what can cast a shadow there.

    The rows of `light_from_world` are x, y, the distance along the lamp's axis, and w: what lies in
    the view has −w < x < w and −w < y < w. w is the distance in a perspective, and 1 in a parallel
    view. All that casts, and all that it falls on, is between `near` and `far`;
    `texel` is a texel's width where w is 1.
    """

    light_from_world: RationalMatrix
    near: float
    far: float
    texel: float
    casters: tuple[Body, ...]

    @property
    def is_perspective(self) -> bool:
        """True where w grows with the distance."""
        return any(self.light_from_world[3][:3])

    @property
    def slack(self) -> float:
        """The distance that light may lack where it falls in straight and w is 1."""
        return SLACK * self.texel

    def clip_from(self, world_from_space: RationalMatrix) -> Array:
        """Return the map to a clip space whose depth is 0 at `near` and 1 at `far`."""
        matrix = as_array(rational.product(self.light_from_world, world_from_space))
        scale = (self.far if self.is_perspective else 1.0) / (self.far - self.near)
        matrix[2] = (matrix[2] - (0.0, 0.0, 0.0, self.near)) * scale
        return matrix

    def distances(self, depth: Array) -> Array:
        """Return distances along the axis for depths from 0 to 1."""
        if not self.is_perspective:
            return np.asarray(self.near + depth * (self.far - self.near))
        return self.near * self.far / (self.far - depth * (self.far - self.near))


@dataclass(frozen=True, eq=False)
class ShadowMap:
    """A view from a lamp, and the distance (size, size) that its light gets in each texel."""

    view: LightView
    distance: Array

    def arriving(self, in_light: Array, cosine: Array) -> Array:
        """Return the share of light, 0 to 1, that arrives at points (4, m) of the view.

        `cosine` is that of the angle at which light falls in. All of it arrives outside the view.
        """
        x, y, here, w = in_light
        found = np.ones(len(w))
        which = np.flatnonzero((w > 0) & (np.abs(x) < w) & (np.abs(y) < w))
        x, y, here, w, cosine = (one.take(which) for one in (x, y, here, w, cosine))
        size = len(self.distance)
        right, column = np.modf((x / w + 1.0) * (size / 2) + 0.5)
        down, row = np.modf((1.0 - y / w) * (size / 2) + 0.5)
        limit = here - self.view.slack * w / np.maximum(cosine, LEAST_COSINE)
        columns = [np.clip(column - step, 0, size - 1).astype(np.intp) for step in (1, 0)]
        rows = [size * np.clip(row - step, 0, size - 1).astype(np.intp) for step in (1, 0)]
        texels = self.distance.ravel()
        (a, b), (c, d) = (
            [limit <= texels.take(down_to + across) for across in columns] for down_to in rows
        )
        above, below = a + right * (b * 1.0 - a), c + right * (d * 1.0 - c)
        found[which] = above + down * (below - above)
        return found


@dataclass(frozen=True, eq=False)
class Occluded:
    """The shadow maps of one lamp, as one body's shading space reaches them.

    Points are asked where the round surface is that a body's normals feign: the triangles below it
    would stand in their own light where it grazes them.
    """

    maps: Sequence[ShadowMap]
    space: ShadingSpace

    @cached_property
    def light_from_space(self) -> tuple[Array, ...]:
        """Return the map from the shading space to each view."""
        return tuple(self.space.light_from_space(one.view.light_from_world) for one in self.maps)

    def __call__(self, positions: Array, normals: Array, cosine: Array) -> Array:
        """Return the share of light, 0 to 1, that arrives at positions (3, m) with unit normals."""
        if self.space.body.sagitta:
            positions = self.space.raised(positions, normals, self.space.body.sagitta)
        found = np.ones(positions.shape[1])
        for one, matrix in zip(self.maps, self.light_from_space, strict=True):
            found = np.minimum(found, one.arriving(multiply(matrix, positions), cosine))
        return found


def shadow_map(view: LightView, size: int) -> ShadowMap:
    """Draw what a lamp sees of the casters: infinite distances where it sees none."""
    canvas = Canvas(size, size)
    tile = Tile.empty((0, size), size, DepthBuffer.FULL)
    for one in view.casters:
        projected = project(one.mesh, view.clip_from(one.world_from_object.exact), canvas, CLIP)
        tile.add(projected, 0, solid(one, projected))
    keys = tile.keys.reshape(size, size)
    depth = (keys >> TRIANGLE_BITS) / STEPS[DepthBuffer.FULL]
    return ShadowMap(view, np.where(keys == EMPTY, np.inf, view.distances(depth)))
