"""`cost shading`: the renderer's dials, compared with a picture that takes no shortcut.

One dial is turned at a time, the others stay as they are. A picture's error is the root of the
mean square of its differences, in 8-bit levels: the largest difference is that of some pixel on an
edge, in every picture.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import Effect, Effort, Reflection, Shading
from nmatrix.raster.loaded_scene import loaded
from nmatrix.raster.planning.plan import Plan, plan_for
from nmatrix.raster.render import Change, Rendered, render
from nmatrix.scene.camera import View
from nmatrix.scene.geometry import ShapeGeometry
from nmatrix.scene.lens import Lens
from nmatrix.scene.light import SceneLight
from nmatrix.scene.material import CHECKER, Material, grey
from nmatrix.scene.scene import Scene, SceneObject, Settings
from nmatrix.scene.words import LightKind, Shape
from nmatrix.scene.world import World
from nmatrix.studies.harness import Timed
from nmatrix.studies.measurements import Measurement, Task, Unit
from nmatrix.studies.surfaces import as_it_is, in_float32, normal_angles, normals_seen, with_effect

Array = NDArray[Any]

TESSELLATIONS = ((8, 16), (16, 32), (32, 64), (64, 128))
SAMPLES = (1, 4, 16, 64)
SHADOW_MAPS = (8, 16, 64)
FINEST_MAP = 2048
SHINY = Material("shiny", specular=grey(0.4), shininess=48, reflection=Reflection.BLINN_PHONG)
FLOOR = Material("floor", texture=CHECKER)
SUN = SceneLight("sun", LightKind.DIRECTIONAL, direction=(-1, -2, -1), intensity=0.8, shadows=True)


@dataclass(frozen=True)
class Resolution:
    """The size of the pictures, and the torus's tessellation where no dial sets it."""

    size: tuple[int, int] = (256, 256)
    tessellation: tuple[int, int] = (96, 192)


FULL, QUICK = Resolution(), Resolution((64, 64), TESSELLATIONS[-1])


@dataclass(frozen=True)
class Dial:
    """One setting of one dial: its name in the table, the scene, the change of its surfaces."""

    dial: str
    value: str
    scene: Scene
    change: Change = as_it_is

    @cached_property
    def plan(self) -> Plan:
        """The plan that draws the scene."""
        return plan_for(loaded(self.scene))

    def rendered(self) -> Rendered:
        """Render the picture."""
        return render(self.plan, change=self.change)


def levels(drawn: Rendered) -> Array:
    """Convert a picture to levels of 0 to 255, not rounded."""
    return np.asarray(drawn.rgb) * 255.0


def scene(resolution: Resolution, tessellation: tuple[int, int] | None = None) -> Scene:
    """Build a stretched torus over a checkered floor, with a highlight and a shadow."""
    size, fine = resolution.size, tessellation or resolution.tessellation
    torus = World(rotate_degrees=(60, 0, 20), scale=(1, 1.4, 0.8))
    floor = World(translate=(0, -1.5, 0), scale=(4, 1, 4))
    return Scene(
        (
            SceneObject("floor", ShapeGeometry(Shape.PLANE), floor.world_from_object, FLOOR),
            SceneObject("torus", ShapeGeometry(Shape.TORUS, fine), torus.world_from_object, SHINY),
        ),
        (SUN,),
        View(eye=(1, 1.6, 4.5)),
        Lens(fov_degrees=45, aspect=size[0] / size[1], near=0.5, far=20),
        Settings(size=size, samples=4, shadow_map=512),
    )


def dials(resolution: Resolution) -> Iterator[Dial]:
    """Generate every setting of every dial."""
    usual = scene(resolution)

    def turned(**settings: object) -> Scene:
        return replace(usual, settings=replace(usual.settings, **settings))  # type: ignore[arg-type]  # names of settings

    for shading in Shading:
        yield Dial("shading", shading.value, turned(shading=shading))
    for value, on in (("left out", False), ("done", True)):
        yield Dial("normalising", value, usual, with_effect(Effect.RENORMALISE, on=on))
    for value, on in (("affine", False), ("perspective", True)):
        yield Dial("interpolation", value, usual, with_effect(Effect.PERSPECTIVE, on=on))
    for samples in SAMPLES:
        yield Dial("samples", str(samples), turned(samples=samples))
    for value, change in (("float32", in_float32), ("float64", as_it_is)):
        yield Dial("attributes", value, usual, change)
    for rings, sectors in TESSELLATIONS:
        yield Dial("tessellation", f"{rings} × {sectors}", scene(resolution, (rings, sectors)))
    for texels in SHADOW_MAPS:
        yield Dial("shadow map", str(texels), turned(shadow_map=texels))
    for effort in Effort:
        yield Dial("effects", effort.value, turned(effort=effort))


def reference(resolution: Resolution) -> Dial:
    """Return the picture without a shortcut: 64 samples, light at fragments, a fine shadow map."""
    usual = scene(resolution)
    settings = replace(usual.settings, samples=64, shadow_map=FINEST_MAP, effort=Effort.ALL)
    return Dial("reference", "", replace(usual, settings=settings))


class Comparison:
    """Compares settings with the reference picture and the usual frame, each made once."""

    def __init__(self, timed: Timed, resolution: Resolution) -> None:
        self.timed = timed
        self.reference = reference(resolution)
        self.usual = Dial("usual", "", scene(resolution))

    @cached_property
    def image(self) -> Array:
        """The reference picture."""
        return levels(self.reference.rendered())

    @cached_property
    def normals(self) -> Array:
        """The reference's normals."""
        return normals_seen(self.reference.plan)

    def row(self, one: Dial) -> Measurement:
        """Measure the errors of a setting, and the time of its frame over that of the usual one."""
        drawn = one.rendered()
        off = np.abs(levels(drawn) - self.image)
        rms = float(np.sqrt((off * off).mean()))
        angles = normal_angles(one.plan, one.change, self.normals)
        more = {
            "max_levels": float(off.max()),
            "mean_levels": float(off.mean()),
            "rms_levels": rms,
            "max_normal_deg": None if angles is None else float(angles.max()),
            "mean_normal_deg": None if angles is None else float(angles.mean()),
        }
        texels = (drawn.work.passes - 1) * one.scene.settings.shadow_map**2
        plan, usual = one.plan, self.usual.plan
        timing = self.timed(lambda: render(plan, change=one.change), lambda: render(usual))
        return Measurement(
            one.value,
            one.dial,
            rms,
            Unit.LEVELS,
            timing,
            drawn.work.multiplications + texels,
            is_reference=one.scene == self.usual.scene and one.change is as_it_is,
            more=more,
        )


def tasks(timed: Timed, resolution: Resolution) -> list[Task]:
    """List the measurements: every setting of every dial."""
    comparison = Comparison(timed, resolution)
    return [partial(comparison.row, one) for one in dials(resolution)]
