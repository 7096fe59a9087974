"""Shadow maps: the distance that light gets, seen from the light, by the same rasterizer.

A map holds distances along the light's axis. A point is in shadow where the map ends before it, by
more than what one texel of a slanted surface spans.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import radians, tan
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import DepthRange, Handedness
from nmatrix.linear import rational
from nmatrix.linear.angle import Angle
from nmatrix.linear.projection import ClipSpace, Window, orthographic, perspective
from nmatrix.linear.rational import RationalMatrix, RationalVector, rational_vector
from nmatrix.linear.view import looking_along
from nmatrix.raster.loaded_scene import Body
from nmatrix.raster.shading.space import ShadingSpace, as_array, column
from nmatrix.raster.triangles.products import multiply
from nmatrix.raster.triangles.spans import Canvas
from nmatrix.raster.triangles.vertices import project
from nmatrix.raster.triangles.visibility import EMPTY, STEPS, TRIANGLE_BITS, Tile
from nmatrix.scene.fitting import Ball
from nmatrix.scene.light import PlacedLight
from nmatrix.scene.words import DepthBuffer

Array = NDArray[Any]

CLIP = ClipSpace(DepthRange.ZERO_TO_ONE, Handedness.RIGHT)
UP: RationalVector = rational_vector((0, 1, 0))
NEAREST = 1e-3  # of the farthest distance: what stands closer to a light casts no shadow
STEEPEST = 8.0  # texels of depth that a slanted surface may span
SIX_WAYS = tuple(
    rational_vector(way)
    for way in ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1))
)


@dataclass(frozen=True)
class LightView:
    """One view from a light: its clip space, and the distances along its axis that it reaches.

    `texel` is a texel's width, at distance 1 where the view is a perspective.
    """

    light_from_world: RationalMatrix
    near: float
    far: float
    texel: float
    is_perspective: bool

    def distances(self, depth: Array) -> Array:
        """Return distances along the axis for depths from 0 to 1."""
        if not self.is_perspective:
            return np.asarray(self.near + depth * (self.far - self.near))
        return self.near * self.far / (self.far - depth * (self.far - self.near))


@dataclass(frozen=True, eq=False)
class ShadowMap:
    """A view from a light, and the distance (size, size) that its light gets in each texel."""

    view: LightView
    distance: Array

    def arrives(self, in_clip: Array, cosine: Array) -> tuple[Array, Array]:
        """Return two masks for points (4, m) of the light's clip space: in its view, and lit by it.

        `cosine` is that of the angle at which light falls in: the flatter, the more depth a texel
        spans.
        """
        w = np.where(in_clip[3] > 0, in_clip[3], np.inf)
        x, y, z = in_clip[:3] / w
        inside = (in_clip[3] > 0) & (np.abs(x) < 1) & (np.abs(y) < 1)
        size = len(self.distance)
        column = np.clip((x + 1) / 2 * size, 0, size - 1).astype(np.intp)
        row = np.clip((1 - y) / 2 * size, 0, size - 1).astype(np.intp)
        here = self.view.distances(z)
        slope = np.sqrt(np.maximum(1 - cosine * cosine, 0.0)) / np.maximum(np.abs(cosine), 1e-9)
        texel = self.view.texel * (here if self.view.is_perspective else 1.0)
        slack = texel * (1.0 + np.minimum(slope, STEEPEST))
        return inside, here - slack <= self.distance[row, column]


@dataclass(frozen=True, eq=False)
class Occluded:
    """The shadow maps of one light, as one body's shading space reaches them."""

    maps: Sequence[ShadowMap]
    space: ShadingSpace

    def __call__(self, positions: Array, cosine: Array) -> Array:
        """Return 1 where light arrives at positions (3, m), else 0."""
        found = np.ones(positions.shape[1], bool)
        for one in self.maps:
            matrix = self.space.light_from_space(one.view.light_from_world)
            inside, arrives = one.arrives(multiply(matrix, positions), cosine)
            found &= arrives | ~inside
        return found.astype(np.float64)


def shadow_maps(placed: PlacedLight, bodies: Sequence[Body], size: int) -> list[ShadowMap]:
    """Return the shadow maps of a light: one for a direction or a cone, six for a point."""
    casters = [one for one in bodies if one.material.opacity == 1.0]
    views = _views(placed, [one.ball for one in bodies], size)
    return [ShadowMap(view, _drawn(view, casters, size)) for view in views]


def _views(placed: PlacedLight, balls: Sequence[Ball], size: int) -> list[LightView]:
    if placed.position is None:
        assert placed.direction is not None  # a light is somewhere or comes from somewhere
        return [_parallel(placed.direction, balls, size)]
    place = column(placed.position)[:, 0]
    far = max(float(np.sqrt(((c - place) ** 2).sum())) + r for c, r in balls)
    ways, half = SIX_WAYS, 45.0
    if placed.direction is not None:
        ways, half = (placed.direction,), min(placed.light.cone_degrees[1] + 1.0, 89.0)
    near, texel = far * NEAREST, 2 * tan(radians(half)) / size
    cone = perspective(Angle.degrees(half), 1.0, near, far, CLIP)
    return [
        LightView(
            _light_from_world(cone, placed.position, way), near, far, texel, is_perspective=True
        )
        for way in ways
    ]


def _parallel(direction: RationalVector, balls: Sequence[Ball], size: int) -> LightView:
    low = np.min([c - r for c, r in balls], axis=0)
    high = np.max([c + r for c, r in balls], axis=0)
    centre = rational_vector(((low + high) / 2).tolist())
    reach = float(np.sqrt(((high - low) ** 2).sum())) / 2
    box = orthographic(Window(-reach, reach, -reach, reach), -reach, reach, CLIP)
    light = _light_from_world(box, centre, direction)
    return LightView(light, -reach, reach, 2 * reach / size, is_perspective=False)


def _light_from_world(
    projection: RationalMatrix, place: RationalVector, direction: RationalVector
) -> RationalMatrix:
    view = looking_along(place, direction, UP, Handedness.RIGHT)
    return rational.product(projection, view.camera_from_world)


def _drawn(view: LightView, casters: Sequence[Body], size: int) -> Array:
    """Return the distance to what the light sees in each texel, infinite where it sees nothing."""
    canvas = Canvas(size, size)
    tile = Tile.empty((0, size), size, DepthBuffer.FULL)
    for one in casters:
        light = as_array(rational.product(view.light_from_world, one.world_from_object.exact))
        tile.add(project(one.mesh, light, canvas, CLIP), 0)
    keys = tile.keys.reshape(size, size)
    depth = (keys >> TRIANGLE_BITS) / STEPS[DepthBuffer.FULL]
    return np.where(keys == EMPTY, np.inf, view.distances(depth))
