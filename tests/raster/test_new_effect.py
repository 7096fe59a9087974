"""An effect that is added: whatever its record leaves unsaid, the plan stays right."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, replace
from enum import StrEnum

import numpy as np
import pytest
from small_scenes import LAMBERT, SUN, single

from nmatrix.enums import Effect, Shading
from nmatrix.raster.loaded_scene import loaded
from nmatrix.raster.planning.effects import RECIPES
from nmatrix.raster.planning.glsl import program_of
from nmatrix.raster.planning.plan import Plan, everything, planned
from nmatrix.raster.planning.recipe import BUDGET, STEADY, Influence, Recipe, called_for
from nmatrix.raster.render import render
from nmatrix.raster.shading.lighting import Lighting, Lit
from nmatrix.scene.geometry import ShapeGeometry
from nmatrix.scene.light import SceneLight
from nmatrix.scene.scene import Scene
from nmatrix.scene.words import LightKind, Shape, Sides
from nmatrix.scene.world import World
from nmatrix.shaders.glsl import Glsl

WALL = ShapeGeometry(Shape.PLANE)
SHEARED = World(shear=(1e-4, 0, 0))
COARSE, FINE = (ShapeGeometry(Shape.SPHERE, size) for size in ((16, 32), (120, 240)))
AFAR = SceneLight("afar", LightKind.DIRECTIONAL, direction=(0, 1, 0))
SCENES = {
    "coarse": single(shape=COARSE),
    "fine": single(shape=FINE),
    "sheared": single(SHEARED, shape=FINE),
    "in sRGB": single(SHEARED, shape=FINE, gamma=True),
    "light at vertices": single(SHEARED, shape=FINE, shading=Shading.GOURAUD),
    "light for each triangle": single(SHEARED, shape=FINE, shading=Shading.FLAT),
    "small, light at vertices": single(
        World(scale=(0.01, 0.01, 0.01)), shape=FINE, shading=Shading.GOURAUD
    ),
    "without a lamp": single(SHEARED, shape=FINE, lights=()),
    "lit from behind": single(
        World(rotate_degrees=(20, 0, 0)),
        replace(LAMBERT, sides=Sides.FRONT),
        (SUN, AFAR),
        WALL,
    ),
}


class Added(StrEnum):
    """Effects that the package does not have."""

    RIM = "rim"
    STRIPES = "stripes"
    GLOW_THROUGH = "glow-through"


def rim(lighting: Lighting, normals: np.ndarray) -> np.ndarray:
    """Add blue where normals point to the right; its slope is 1/2, by angle and by length."""
    return np.array([[0.0], [0.0], [0.5]])[: len(lighting.ambient)] * normals[0]


def stripes(lighting: Lighting, normals: np.ndarray) -> np.ndarray:
    """Add light in stripes across the normals."""
    return 0.3 * (np.floor(normals[:1] * 40) % 2)


def glow_through(lighting: Lighting, normals: np.ndarray) -> np.ndarray:
    """Add light of lamps behind the surface."""
    found = np.zeros((1, normals.shape[1]))
    for one in lighting.lights:
        assert one.to_light is not None
        found += 0.4 * np.maximum(-(normals * one.to_light).sum(axis=0), 0.0)
    return found


LIGHT = {Added.RIM: rim, Added.STRIPES: stripes, Added.GLOW_THROUGH: glow_through}
SLOPES = Influence(per_radian=0.5, per_length=0.5, most=1.0, gain=1.0, jumps=False)
RIM = replace(SLOPES, per_unit=0.0, strength=STEADY.strength, lights_backs=False)

HOW = ("follows_lights", "because")  # columns that claim nothing

Add = Callable[..., None]


@pytest.fixture
def add(monkeypatch: pytest.MonkeyPatch) -> Add:
    """Add an effect to the table and to what surfaces compute."""

    def with_record(effect: Added, **columns: object) -> None:
        recipe = Recipe("added by a test", lambda _: called_for("a test asks for it"), **columns)  # type: ignore[arg-type]
        monkeypatch.setitem(RECIPES, effect, recipe)  # type: ignore[misc]
        right = Lighting.light

        def light(self: Lighting, normals: np.ndarray, positions: np.ndarray | None) -> Lit:
            matte, gloss = right(self, normals, positions)
            if effect in self.effects:
                matte = matte + LIGHT[effect](self, normals)
            return Lit(matte, gloss)

        monkeypatch.setattr(Lighting, "light", light)

    return with_record


def plan_and_error(scene: Scene) -> tuple[Plan, float, float]:
    """Return the plan, the most that it moves a channel by, and the most that it says."""
    ready = loaded(scene)
    plan = planned(ready)
    moved = np.abs(render(plan).rgb - render(everything(ready)).rgb).max()
    return plan, float(moved), max(body.bound for body in plan.bodies)


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("effect", Added)
def test_a_record_that_says_nothing_is_planned_safely(effect: Added, name: str, add: Add) -> None:
    add(effect)
    plan, moved, bound = plan_and_error(SCENES[name])
    assert effect in plan.effects
    assert moved <= bound + 1e-12
    assert bound <= BUDGET


@pytest.mark.parametrize("name", SCENES)
def test_a_record_that_says_its_slopes_is_planned_within_them(name: str, add: Add) -> None:
    add(Added.RIM, influence=RIM)
    _, moved, bound = plan_and_error(SCENES[name])
    assert moved <= bound + 1e-12
    assert bound <= BUDGET


def test_what_a_record_says_saves_work(add: Add) -> None:
    add(Added.RIM)
    assert Effect.RENORMALISE in planned(loaded(SCENES["fine"])).effects
    add(Added.RIM, influence=RIM)
    assert Effect.RENORMALISE not in planned(loaded(SCENES["fine"])).effects


def computed(influence: Influence, add: Add) -> list[frozenset[str]]:
    """Return the effects and lights that the plan of each scene keeps under one more effect."""
    add(Added.RIM, influence=influence)
    plans = [planned(loaded(scene)) for scene in SCENES.values()]
    return [
        plan.effects.union(light.light.name for body in plan.bodies for light in body.lights)
        for plan in plans
    ]


@pytest.mark.parametrize("column", [one.name for one in fields(Influence) if one.name not in HOW])
def test_each_column_that_is_left_unsaid_costs_a_shortcut(column: str, add: Add) -> None:
    told = replace(RIM, brings_colour=False)
    unsaid = replace(told, **{column: getattr(Influence(), column)})
    fewer, more = computed(told, add), computed(unsaid, add)
    assert any(b - a for a, b in zip(fewer, more, strict=True))


@pytest.mark.parametrize(
    ("effect", "name"),
    [
        (Added.RIM, "coarse"),
        (Added.STRIPES, "sheared"),
        (Added.GLOW_THROUGH, "lit from behind"),
    ],
)
def test_a_record_that_says_too_little_would_be_seen(effect: Added, name: str, add: Add) -> None:
    add(effect, influence=STEADY)
    _, moved, bound = plan_and_error(SCENES[name])
    assert moved > bound + 1e-12


def test_its_lines_and_its_work_come_from_its_record(add: Add) -> None:
    ready = loaded(SCENES["coarse"])
    before = render(everything(ready)).work
    line = "color += vec3(0.0, 0.0, 0.5) * n.x;"
    add(Added.RIM, per_sample=3, glsl=Glsl(color=(line,)))
    plan = everything(ready)
    after = render(plan).work
    assert after.multiplications - before.multiplications == 3 * after.shaded_samples
    assert line in program_of(plan, plan.bodies[0]).fragment_shader
