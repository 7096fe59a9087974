"""Facts that decisions about one body rest on: each a number, computed when it is asked for."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from math import e, inf, sqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import Reflection, Shading, Space
from nmatrix.linear.classify import Classification, classify
from nmatrix.raster.loaded_scene import Body, LoadedScene, PlacedLight
from nmatrix.raster.shading.space import ShadingSpace, as_array, dot
from nmatrix.raster.triangles.clip import inside
from nmatrix.raster.triangles.products import chunks, multiply

Array = NDArray[Any]

THINNEST = 1e6  # of length to thickness, for fronts and backs to be told apart by depth


@dataclass(frozen=True, eq=False)
class Facts:
    """One body, the lights that reach it, and the space that it is shaded in."""

    loaded: LoadedScene
    body: Body
    lights: tuple[PlacedLight, ...]

    @property
    def space(self) -> Space:
        """Return the shading space."""
        return self.loaded.settings.space

    @cached_property
    def map_to_space(self) -> Classification:
        """Return what kind of map takes the body to its shading space."""
        seen = ShadingSpace(self.loaded, self.body, self.space, uses_metric=False)
        return classify(seen.exact_from_object)

    @cached_property
    def space_is_rigid(self) -> bool:
        """Return whether lengths read off the space's coordinates are true, to rounding."""
        return self.loaded.maps(self.body).is_rigid(self.space)

    def clip_parts(self) -> Iterator[Array]:
        """Give the vertices in clip space, some at a time (4, n)."""
        matrix = as_array(self.loaded.clip_from_object(self.body))
        for part in chunks(self.body.mesh.positions.T):
            with np.errstate(over="ignore", invalid="ignore"):
                yield multiply(matrix, part)

    @cached_property
    def is_whole(self) -> bool:
        """Return whether no plane of the view cuts the body."""
        depth, canvas = self.loaded.clip.depth, self.loaded.canvas
        return all(bool(inside(part, depth, canvas).all()) for part in self.clip_parts())

    @property
    def is_thin(self) -> bool:
        """Return whether the map all but flattens the body: a front and a back in one place."""
        kappa = self.body.kind.condition
        return kappa is None or kappa > THINNEST

    @property
    def is_parallel(self) -> bool:
        """Return whether w is the same everywhere."""
        return not any(self.loaded.clip_from_object(self.body)[3][:3])

    @cached_property
    def w_ratio(self) -> float:
        """Return the largest ratio of w between corners of one triangle; infinite if it is cut."""
        if not self.is_whole:
            return inf
        w = np.concatenate([part[3] for part in self.clip_parts()])
        low, high = float(w.min()), float(w.max())
        if high <= 2.0 * low:  # one triangle's ratio is no larger than the whole body's
            return high / low
        of_corners = (w.take(part) for part in chunks(self.body.mesh.triangles.T))
        return max(float((one.max(axis=0) / one.min(axis=0)).max()) for one in of_corners)

    @cached_property
    def normal_cosine(self) -> float:
        """Return the smallest cosine between the world normals of one triangle's corners."""
        space = ShadingSpace(self.loaded, self.body, Space.WORLD, uses_metric=False)
        normals = space.normals(self.loaded.settings.normals)
        found = inf
        for part in chunks(self.body.mesh.triangles.T):
            a, b, c = (normals[:, corner] for corner in part)
            found = min(found, *(float(dot(p, q).min()) for p, q in ((a, b), (b, c), (c, a))))
        return found

    @property
    def shortest_normal(self) -> float:
        """Return the length that interpolation can shrink a normal to: √((1 + 2 cos θ)/3)."""
        return sqrt(max(0.0, (1.0 + 2.0 * self.normal_cosine) / 3.0))

    @cached_property
    def brightness(self) -> float:
        """Return the brightest channel of all the lights together."""
        return max(
            (sum(one) for one in zip(*(light.colour for light in self.lights), strict=True)),
            default=0.0,
        )

    @property
    def shines(self) -> bool:
        """Return whether there is a highlight: the material has one, and light comes."""
        return self.body.material.shines and bool(self.lights)

    @property
    def slope(self) -> float:
        """Return how much a channel moves at the most for a normal that turns by one radian.

        The slope of max(0, cos) is 1, that of cosˢ is √(s/e) at the most; a mirrored ray turns
        twice as far as the normal.
        """
        material = self.body.material
        found = max(material.diffuse)
        if self.shines:
            turns = 2.0 if material.reflection is Reflection.PHONG else 1.0
            found += max(material.specular) * turns * sqrt(material.shininess / e)
        return found * self.brightness * self.contrast

    @property
    def contrast(self) -> float:
        """Return how much levels move for light: 1, or the steepest part of sRGB."""
        return 12.92 if self.loaded.settings.gamma else 1.0

    @property
    def colour_range(self) -> float:
        """Return how far apart the light at two vertices can be."""
        material = self.body.material
        found = max(material.diffuse) + (max(material.specular) if self.shines else 0.0)
        return found * self.brightness * self.contrast

    @property
    def reads_places(self) -> bool:
        """Return whether fragments ask where they are: in the scene or on an image."""
        material, is_phong = self.body.material, self.loaded.settings.shading is Shading.PHONG
        placed = any(one.position is not None for one in self.lights)
        return bool(
            (is_phong and (placed or self.shines or material.outline))
            or material.texture
            or material.normal_map
            or material.vertex_colours
            or self.loaded.settings.fog
            or any(one.light.shadows for one in self.lights)
        )

    @property
    def has_jumps(self) -> bool:
        """Return whether colours jump: highlights at n·l = 0, bands and outlines at their edges."""
        material = self.body.material
        banded = material.reflection is Reflection.TOON or material.outline > 0
        return self.shines or banded

    @cached_property
    def eye(self) -> Array:
        """Return the eye in the world."""
        return np.array([float(one) for one in self.loaded.eye])

    @cached_property
    def eye_is_outside(self) -> bool:
        """Return whether the eye is outside of the box around the body."""
        low, high = self.body.box
        return bool((self.eye < low).any() or (self.eye > high).any())
