"""A camera that sees everything and a light that parts what it sees, for files without them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import product
from math import atan, radians, sin, tan
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.scene.light import SceneLight
from nmatrix.scene.scene import Scene
from nmatrix.scene.words import LightKind

Array = NDArray[Any]
Ball = tuple[Array, float]

# From above and from the left: on a cube, top, front and right side differ by more than 50 levels.
DAYLIGHT = SceneLight("daylight", LightKind.DIRECTIONAL, direction=(-1, -3, -2))
SRGB_DAYLIGHT = replace(DAYLIGHT, direction=(-2, -10, -5))  # the same, where levels are sRGB
TOWARDS_EYE = (0.6, 0.6, 1.0)  # from the front, a little from the right and above
# The eye's octants, the usual one first, then those that turn it least: signs of x, y and z.
OCTANTS = sorted(product((1, -1), repeat=3), key=lambda signs: (-signs[1], -signs[2], -signs[0]))
MUCH_BETTER = 2.0  # times as much seen: then the eye leaves its usual place
UNLIT_PART = 0.25  # that a surface in the shade counts, of one that light falls on straight
ALONG_LIGHT = 0.97  # the cosine from which on an eye looks along the light
ROOM = 1.05
NEAREST = 1e-3  # of the radius, for an eye that stands inside


@dataclass(frozen=True, eq=False)
class Facets:
    """Some triangles in the world, as vectors (3, n): their normals, as long as their areas.

    Those that have a front alone show nothing to an eye behind them.
    """

    areas: Array
    has_front_alone: bool

    def seen_from(self, to_eye: Array, to_lights: Sequence[Array]) -> float:
        """Return the area that an eye far away sees, by how much light falls on the side seen."""
        facing = to_eye @ self.areas
        if self.has_front_alone:
            facing = np.maximum(facing, 0.0)
        length = np.sqrt((self.areas * self.areas).sum(axis=0))
        side = np.sign(facing)
        lit = np.zeros_like(length)
        for one in to_lights:
            lit += np.maximum(side * (one @ self.areas), 0.0)
        share = np.divide(lit, length, out=np.zeros_like(length), where=length > 0)
        return float((np.abs(facing) * (UNLIT_PART + np.minimum(share, 1.0))).sum())


def daylight(scene: Scene, signs: Sequence[int] = OCTANTS[0]) -> SceneLight:
    """Return daylight over the left shoulder of an eye in an octant."""
    light = SRGB_DAYLIGHT if scene.settings.gamma else DAYLIGHT
    x, y, z = (sign * part for sign, part in zip(signs, light.direction, strict=True))
    return replace(light, direction=(x, y, z))


def octant(scene: Scene, facets: Sequence[Facets]) -> tuple[int, ...]:
    """Choose the octant of the eye: the usual one, unless much more is seen from another.

    Fronts are seen from their side, flat models never from their edge; and an eye that looks along
    the light, or against it, sees no shape.
    """
    sights = {}
    for signs in OCTANTS:
        to_eye = np.array(signs) * TOWARDS_EYE
        to_eye /= np.sqrt(to_eye @ to_eye)
        to_lights = [_to_light(one) for one in scene.lights or (daylight(scene, signs),)]
        known = [one for one in to_lights if one is not None]
        sight = sum(one.seen_from(to_eye, known) for one in facets)
        if len(known) == 1 and abs(float(to_eye @ known[0])) > ALONG_LIGHT:
            sight /= MUCH_BETTER
        sights[signs] = sight
    best = max(sights.values())
    return next(signs for signs, sight in sights.items() if sight * MUCH_BETTER >= best)


def _to_light(light: SceneLight) -> Array | None:
    """Return the unit vector to a light that comes from one direction of the world."""
    if light.kind is not LightKind.DIRECTIONAL:
        return None
    way = -np.array(light.direction, dtype=float)
    return np.asarray(way / np.sqrt(way @ way))


def fitted(scene: Scene, balls: Sequence[Ball], signs: Sequence[int] = OCTANTS[0]) -> Scene:
    """Return the scene with an eye that sees the balls (centre, radius) that hold its objects."""
    centre, radius = enclosing(balls)
    half = radians(scene.lens.fov_degrees / 2)
    half = min(half, atan(tan(half) * scene.lens.aspect))
    direction = np.array(TOWARDS_EYE) / np.sqrt(np.dot(TOWARDS_EYE, TOWARDS_EYE)) * signs
    distance = radius / sin(half) * ROOM
    eye = centre + direction * distance
    near = max(distance - radius * ROOM, radius * NEAREST)
    return replace(
        scene,
        view=replace(scene.view, eye=tuple(eye.tolist()), target=tuple(centre.tolist())),
        lens=replace(scene.lens, near=near, far=distance + radius * ROOM),
    )


def enclosing(balls: Sequence[Ball]) -> Ball:
    """Return a ball around balls: the middle of their box, and the farthest reach from there."""
    low = np.min([centre - radius for centre, radius in balls], axis=0)
    high = np.max([centre + radius for centre, radius in balls], axis=0)
    middle = (low + high) / 2
    reach = max(float(np.sqrt(((c - middle) ** 2).sum())) + r for c, r in balls)
    return middle, reach or 1.0
