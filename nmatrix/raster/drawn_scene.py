"""A scene that was drawn: its plan and its picture together, and how far two pictures differ."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import Effect
from nmatrix.raster.image import levels
from nmatrix.raster.loaded_scene import LoadedScene, loaded
from nmatrix.raster.planning.plan import Plan, plan_for
from nmatrix.raster.render import APART, Change, Rendered, render
from nmatrix.raster.shading.texture import from_srgb
from nmatrix.raster.sight import FAINT
from nmatrix.scene.material import BLACK
from nmatrix.scene.scene import Scene

Array = NDArray[Any]

BRIGHT = {False: 1.0 - APART, True: float(from_srgb(np.array(1.0 - APART)))}  # by gamma


@dataclass(frozen=True, eq=False)
class DrawnScene:
    """A scene that was drawn: its plan, and the picture."""

    plan: Plan
    rendered: Rendered

    @property
    def loaded(self) -> LoadedScene:
        """Return the loaded scene."""
        return self.plan.loaded

    @cached_property
    def levels(self) -> Array:
        """Return the 8-bit image (height, width, 3)."""
        return levels(self.rendered.rgb)

    @property
    def effects(self) -> tuple[str, ...]:
        """Return the names of the effects that were on, in the order of the table."""
        return tuple(one.value for one in Effect if one in self.plan.effects)

    def redrawn(self, change: Change) -> DrawnScene:
        """Draw the scene again with its surfaces changed."""
        has_depth = self.rendered.depth is not None
        return DrawnScene(self.plan, render(self.plan, change=change, keeps_depth=has_depth))


def drawn_scene(
    scene: Scene,
    *,
    keeps_depth: bool = False,
    **settings: Any,  # noqa: ANN401  # fields of Settings
) -> DrawnScene:
    """Draw a scene by its plan; `settings` replace those of the scene."""
    changed = replace(scene, settings=replace(scene.settings, **settings))
    plan = plan_for(loaded(changed))
    if plan.loaded.settings.other_background is None:
        return drawn_plan(plan, keeps_depth=keeps_depth)
    return _before_the_better_background(plan, keeps_depth=keeps_depth)


def _before_the_better_background(plan: Plan, *, keeps_depth: bool) -> DrawnScene:
    """Draw before the background from which less of what is seen is hard to tell.

    What the materials let expect is drawn first, and mostly that is all.
    """
    settings = plan.loaded.settings
    assert settings.other_background is not None  # whoever asks knows
    found = []
    grounds = [settings.background, settings.other_background]
    if _is_bright(plan):
        grounds.reverse()
    for ground in grounds:
        before = replace(plan.loaded, settings=replace(settings, background=ground))
        drawn = drawn_plan(replace(plan, loaded=before), keeps_depth=keeps_depth)
        if drawn.rendered.faint <= FAINT:
            return drawn
        found.append(drawn)
    return min(found, key=lambda one: one.rendered.faint)


def _is_bright(plan: Plan) -> bool:
    """Tell whether most objects send so much light back that they fade before white."""
    bright = 0
    for one in plan.drawn:
        material = one.body.material
        parts = (material.unlit or BLACK, material.ambient, material.diffuse, material.emission)
        light = min(map(sum, zip(*parts, strict=True)))
        is_plain = material.texture is None and not material.vertex_colours
        bright += is_plain and light >= BRIGHT[plan.loaded.settings.gamma]
    return 2 * bright > len(plan.drawn)


def drawn_plan(plan: Plan, *, keeps_depth: bool = False) -> DrawnScene:
    """Draw the scene of a plan."""
    return DrawnScene(plan, render(plan, keeps_depth=keeps_depth))


def level_difference(a: DrawnScene, b: DrawnScene) -> int:
    """Return the largest difference of two pictures, in 8-bit levels."""
    return int(np.abs(a.levels.astype(int) - b.levels).max())
