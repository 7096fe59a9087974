"""A camera that sees everything and a light that parts what it sees, for files without them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import atan, radians, sin, tan
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.scene.lens import Lens
from nmatrix.scene.light import SceneLight
from nmatrix.scene.scene import Scene
from nmatrix.scene.words import LightKind

Array = NDArray[Any]
Ball = tuple[Array, float]

# From above and from the left: on a cube, top, front and right side differ by more than 50 levels.
DAYLIGHT = SceneLight("daylight", LightKind.DIRECTIONAL, direction=(-1, -3, -2))
TOWARDS_EYE = (0.6, 0.6, 1.0)  # from the front, a little from the right and above
ROOM = 1.05
NEAREST = 1e-3  # of the radius, for an eye that stands inside


def fitted(scene: Scene, balls: Sequence[Ball]) -> Scene:
    """Return the scene with an eye that sees the balls (centre, radius) that hold its objects."""
    centre, radius = enclosing(balls)
    half = _half_angle(scene.lens)
    direction = np.array(TOWARDS_EYE) / np.sqrt(np.dot(TOWARDS_EYE, TOWARDS_EYE))
    distance = radius / sin(half) * ROOM
    eye = centre + direction * distance
    near = max(distance - radius * ROOM, radius * NEAREST)
    return replace(
        scene,
        view=replace(scene.view, eye=tuple(eye.tolist()), target=tuple(centre.tolist())),
        lens=replace(scene.lens, near=near, far=distance + radius * ROOM),
    )


def _half_angle(lens: Lens) -> float:
    """Find the smallest angle from the view axis to a side, in radians."""
    if lens.measured_sides is not None:
        return atan(min(abs(float(side)) for side in lens.measured_sides))
    half = radians(lens.fov_degrees / 2)
    return min(half, atan(tan(half) * lens.aspect_ratio))


def enclosing(balls: Sequence[Ball]) -> Ball:
    """Return a ball around balls: the middle of their box, and the farthest reach from there."""
    low = np.min([centre - radius for centre, radius in balls], axis=0)
    high = np.max([centre + radius for centre, radius in balls], axis=0)
    middle = (low + high) / 2
    reach = max(float(np.sqrt(((c - middle) ** 2).sum())) + r for c, r in balls)
    return middle, reach or 1.0
