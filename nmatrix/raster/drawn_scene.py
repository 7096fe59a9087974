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
from nmatrix.raster.render import Change, Rendered, render
from nmatrix.scene.scene import Scene

Array = NDArray[Any]


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
    return drawn_plan(plan_for(loaded(changed)), keeps_depth=keeps_depth)


def drawn_plan(plan: Plan, *, keeps_depth: bool = False) -> DrawnScene:
    """Draw the scene of a plan."""
    return DrawnScene(plan, render(plan, keeps_depth=keeps_depth))


def level_difference(a: DrawnScene, b: DrawnScene) -> int:
    """Return the largest difference of two pictures, in 8-bit levels."""
    return int(np.abs(a.levels.astype(int) - b.levels).max())
