"""`cost shading`: the renderer's dials against a picture that takes no shortcut."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import Effort, LampKind, Reflection, Shading, Shape
from nmatrix.raster.plan import plan_for
from nmatrix.raster.render import render
from nmatrix.raster.studio import studio
from nmatrix.scene.camera import View
from nmatrix.scene.geometry import ShapeGeometry
from nmatrix.scene.lamp import Lamp
from nmatrix.scene.lens import Lens
from nmatrix.scene.material import CHECKER, Material, grey
from nmatrix.scene.scene import Scene, SceneObject, Settings
from nmatrix.scene.world import World
from nmatrix.studies.harness import Harness
from nmatrix.studies.rows import Row, with_fronts

Array = NDArray[Any]

FULL, QUICK = (256, 256), (96, 96)
TESSELLATIONS = ((8, 16), (16, 32), (32, 64), (64, 128))
REFERENCE = (96, 192)
SAMPLES = (1, 4, 16, 64)
SHADOW_MAPS = (64, 256, 1024)
SHINY = Material("shiny", specular=grey(0.4), shininess=48, reflection=Reflection.BLINN_PHONG)
FLOOR = Material("floor", texture=CHECKER)
SUN = Lamp("sun", LampKind.DIRECTIONAL, direction=(-1, -2, -1), intensity=0.8, shadows=True)


@dataclass(frozen=True)
class Dial:
    """One setting of one dial: its name in the table, and the scene that it makes."""

    dial: str
    value: str
    scene: Scene


def scene(size: tuple[int, int], tessellation: tuple[int, int] = REFERENCE) -> Scene:
    """Return a stretched torus over a checkered floor, with a highlight and a shadow."""
    torus = World(rotate_degrees=(60, 0, 20), scale=(1, 1.4, 0.8))
    floor = World(translate=(0, -1.5, 0), scale=(4, 1, 4))
    return Scene(
        (
            SceneObject("floor", ShapeGeometry(Shape.PLANE), floor.world_from_object, FLOOR),
            SceneObject(
                "torus", ShapeGeometry(Shape.TORUS, tessellation), torus.world_from_object, SHINY
            ),
        ),
        (SUN,),
        View(eye=(1, 1.6, 4.5)),
        Lens(fov_degrees=45, aspect=size[0] / size[1], near=0.5, far=20),
        Settings(size=size, samples=4, shadow_map=512),
    )


def dials(size: tuple[int, int]) -> Iterator[Dial]:
    """Return every setting: one dial is turned, the others stand as they are."""
    usual = scene(size)
    settings = usual.settings
    for shading in Shading:
        turned = replace(usual, settings=replace(settings, shading=shading))
        yield Dial("shading", shading.value, turned)
    for samples in SAMPLES:
        yield Dial(
            "samples", str(samples), replace(usual, settings=replace(settings, samples=samples))
        )
    for rings, sectors in TESSELLATIONS:
        yield Dial("tessellation", f"{rings} × {sectors}", scene(size, (rings, sectors)))
    for texels in SHADOW_MAPS:
        turned = replace(usual, settings=replace(settings, shadow_map=texels))
        yield Dial("shadow map", str(texels), turned)
    for effort in Effort:
        yield Dial(
            "effects", effort.value, replace(usual, settings=replace(settings, effort=effort))
        )


def reference(size: tuple[int, int]) -> Array:
    """Return the picture without a shortcut: 64 samples, light at fragments, a fine shadow map."""
    usual = scene(size)
    settings = replace(usual.settings, samples=64, shadow_map=2048, effort=Effort.ALL)
    return _image(replace(usual, settings=settings))


def shading(harness: Harness, size: tuple[int, int]) -> tuple[Row, ...]:
    """Return a row for each setting: the largest error in levels, and the time of a frame."""
    true = reference(size)
    usual = scene(size)
    standard = _frame(usual)
    rows = []
    for one in dials(size):
        image = _image(one.scene)
        error = float(np.abs(image - true).max() * 255)
        mean = float(np.abs(image - true).mean() * 255)
        timing = harness.ratio(_frame(one.scene), standard)
        rows.append(
            Row(f"{one.dial} {one.value}", one.dial, error, f"levels, mean {mean:.2f}", timing)
        )
    return with_fronts(rows)


def _image(shown: Scene) -> Array:
    return np.asarray(render(plan_for(studio(shown))).rgb)


def _frame(shown: Scene) -> Any:  # noqa: ANN401  # a function without arguments
    plan = plan_for(studio(shown))
    return lambda: render(plan)
