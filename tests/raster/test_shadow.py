"""Shadows: a lamp is kept off by what is opaque, and by nothing else."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from small_scenes import LAMBERT, LENS

from nmatrix.raster.loaded_scene import loaded
from nmatrix.raster.planning.plan import planned
from nmatrix.raster.render import render
from nmatrix.scene.camera import View
from nmatrix.scene.geometry import ShapeGeometry
from nmatrix.scene.light import SceneLight
from nmatrix.scene.scene import Scene, SceneObject, Settings
from nmatrix.scene.words import LightKind, Shape
from nmatrix.scene.world import World

FLOOR, BALL = World(scale=(1.5, 1, 1.5)), World(translate=(0, 1, 0), scale=(0.2, 0.2, 0.2))
CASTING = [kind for kind in LightKind if kind is not LightKind.AMBIENT]


def darkened(kind: LightKind, opacity: float) -> np.ndarray:
    """Mask the pixels of a floor under a small ball that shadows make darker."""
    lamp = SceneLight("lamp", kind, position=(0, 3, 0), direction=(0, -1, 0), cone_degrees=(60, 70))
    floor = replace(LAMBERT, opacity=opacity)
    objects = (
        SceneObject("floor", ShapeGeometry(Shape.PLANE), FLOOR.world_from_object, floor),
        SceneObject("ball", ShapeGeometry(Shape.SPHERE), BALL.world_from_object, LAMBERT),
    )
    view, settings = View(eye=(0, 3, 4), target=(0, 0, 0)), Settings(size=(96, 96), samples=1)
    with_shadows, without = (
        render(
            planned(loaded(Scene(objects, (replace(lamp, shadows=on),), view, LENS, settings)))
        ).image
        for on in (True, False)
    )
    return (without - with_shadows)[:, :, 0] > 0.01


@pytest.mark.parametrize("kind", CASTING)
@pytest.mark.parametrize("opacity", [1.0, 0.5])
def test_a_small_ball_darkens_a_small_part_of_the_floor(kind: LightKind, opacity: float) -> None:
    assert 0.002 < darkened(kind, opacity).mean() < 0.05


@pytest.mark.parametrize("kind", CASTING)
def test_glass_is_dark_where_an_opaque_floor_would_be(kind: LightKind) -> None:
    assert (darkened(kind, 1.0) != darkened(kind, 0.5)).mean() < 0.002
