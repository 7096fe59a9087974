"""Pixels that are shaded once: within their bound, whatever the lamps, and not where none holds."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from small_scenes import BLINN, BULB, LAMBERT, PHONG, SUN, single

from nmatrix.enums import Effect, Reflection, Shading
from nmatrix.raster.loaded_scene import loaded
from nmatrix.raster.planning import shading_rate as rate_module
from nmatrix.raster.planning.effects import RECIPES
from nmatrix.raster.planning.facts import Facts
from nmatrix.raster.planning.plan import Plan, everything, planned
from nmatrix.raster.planning.seen_body import SeenBody
from nmatrix.raster.render import render
from nmatrix.raster.triangles import picture as picture_module
from nmatrix.scene.geometry import ShapeGeometry
from nmatrix.scene.light import SceneLight
from nmatrix.scene.material import CHECKER, grey
from nmatrix.scene.scene import Fog, Scene
from nmatrix.scene.words import LightKind, Shape
from nmatrix.scene.world import World

SPHERE, TORUS, BOX = (
    ShapeGeometry(Shape.SPHERE, (12, 24)),
    ShapeGeometry(Shape.TORUS, (16, 12)),
    ShapeGeometry(Shape.BOX),
)
LEANING = World(rotate_degrees=(20, 30, 10), scale=(1, 1.3, 0.8))
LAMP = SceneLight("lamp", LightKind.SPOT, position=(1, 2, 3), direction=(-1, -2, -3))
FADING = replace(BULB, attenuation=(0.2, 0.1, 0.05))
BRIGHT = replace(SUN, intensity=3.0)
SOFT = replace(BLINN, shininess=8)
GLOSS = replace(BLINN, shininess=2, specular=grey(0.3), diffuse=grey(0))
ASIDE = SceneLight("aside", LightKind.DIRECTIONAL, direction=(-1, 0, 0.6))
SCENES = {
    "matt": {"shape": SPHERE},
    "matt, leaning": {"world": LEANING, "shape": TORUS},
    "a bulb": {"world": LEANING, "shape": TORUS, "lights": (BULB,)},
    "fading": {"shape": SPHERE, "lights": (FADING,)},
    "a spot": {"world": LEANING, "shape": SPHERE, "lights": (LAMP,)},
    "shiny": {"material": SOFT, "shape": SPHERE, "lights": (SUN, BULB)},
    "mirrored": {"material": replace(SOFT, reflection=Reflection.PHONG), "shape": SPHERE},
    "a highlight that ends": {
        "material": GLOSS,
        "shape": SPHERE,
        "lights": (ASIDE,),
        "size": (400, 400),
    },
    "too bright": {"shape": SPHERE, "lights": (BRIGHT,)},
    "gamma": {"world": LEANING, "shape": TORUS, "gamma": True},
    "fog": {"world": LEANING, "shape": BOX, "fog": Fog((0.5, 0.5, 0.5), 1.0, 9.0)},
    "box": {"world": LEANING, "shape": BOX},
    "outlined": {"material": replace(LAMBERT, outline=0.2), "shape": SPHERE},
    "flat": {"material": PHONG, "world": LEANING, "shape": TORUS, "shading": Shading.FLAT},
}


def scene(name: str, samples: int = 4) -> Scene:
    return single(**{"size": (192, 192), "samples": samples, **SCENES[name]})


@cache
def plans(name: str, samples: int = 4) -> tuple[Plan, Plan]:
    """Plan a scene with everything on, and the same with nothing else left out."""
    ready = loaded(scene(name, samples))
    full, some = everything(ready), planned(ready)
    bodies = [
        replace(
            one,
            effects=one.effects - {Effect.SAMPLE_SHADING},
            rate=other.rate,
        )
        for one, other in zip(full.bodies, some.bodies, strict=True)
    ]
    return replace(full, bodies=tuple(bodies)), full


def moved(once: Plan, full: Plan) -> float:
    return float(np.abs(render(once).rgb - render(full).rgb).max())


@pytest.mark.parametrize("samples", [4, 16])
@pytest.mark.parametrize("name", SCENES)
def test_shading_once_moves_no_channel_by_more_than_its_limit(name: str, samples: int) -> None:
    once, full = plans(name, samples)
    assert moved(once, full) <= once.bodies[0].rate.limit + 1e-12


@pytest.mark.parametrize("name", ["matt", "matt, leaning", "box", "flat"])
def test_where_the_bound_holds_fewer_samples_are_shaded(name: str) -> None:
    once, full = plans(name)
    assert render(once).work.shaded_samples < 0.8 * render(full).work.shaded_samples


def test_no_stripe_changes_a_bit(monkeypatch: pytest.MonkeyPatch) -> None:
    once, _ = plans("matt")
    whole = render(once).image
    monkeypatch.setattr(picture_module, "STRIPE_SAMPLES", 1000)
    monkeypatch.setattr(picture_module, "MOST_SHADED", 77)
    assert (render(once).image == whole).all()


CALLED_FOR = {
    "a texture": {"material": replace(LAMBERT, texture=CHECKER)},
    "bands": {"material": replace(LAMBERT, reflection=Reflection.TOON)},
    "a shadow": {"lights": (replace(SUN, shadows=True),)},
    "glass": {"material": replace(LAMBERT, opacity=0.5)},
    "a sharp cone": {"lights": (replace(LAMP, cone_degrees=(20, 20)),)},
    "a range that ends on it": {"lights": (replace(BULB, range=3.5),)},
    "a wide highlight": {"material": replace(BLINN, shininess=1.5)},
    "light at vertices": {"shading": Shading.GOURAUD},
}


@pytest.mark.parametrize("name", CALLED_FOR)
def test_what_may_have_an_edge_is_shaded_at_every_sample(name: str) -> None:
    (body,) = planned(loaded(single(**CALLED_FOR[name], shape=SPHERE, samples=4))).bodies
    assert Effect.SAMPLE_SHADING in body.effects
    assert body.rate is None


MUTANTS = {
    "no curvature": (20, "_curvature", lambda a, b: 0.0 * a.turn),
    "no kinks": (80, "_keep_their_side", lambda normal, light: normal.turn >= 0),
    "no limit": (20, "LIMIT", 1e9),
}


@pytest.mark.parametrize("name", MUTANTS)
def test_the_bound_notices(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    for constant, value in (("FEWEST", 0), ("ENOUGH", 0.0)):
        monkeypatch.setattr(rate_module, constant, value)
    size, *mutant = MUTANTS[name]
    monkeypatch.setattr(rate_module, *mutant)
    ready = loaded(single(shape=ShapeGeometry(Shape.SPHERE, (8, 12)), size=(size, size), samples=4))
    full = everything(ready)
    (body,) = full.bodies
    facts = Facts(SeenBody(ready, body.body), body.lights, RECIPES)
    rate = rate_module.shading_rate(facts)
    assert isinstance(rate, rate_module.ShadingRate)
    effects = body.effects - {Effect.SAMPLE_SHADING}
    once = replace(full, bodies=(replace(body, effects=effects, rate=rate),))
    assert moved(once, full) > 0.25 / 255
