"""Proofs about lights: how a direction reaches object space, and what a light is fixed to."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import NormalRule, Space
from nmatrix.linear.rational import linear_part
from nmatrix.raster.image import Panel, compose
from nmatrix.raster.proofs.proof import (
    TORUS,
    DrawnScene,
    Proof,
    ProofSettings,
    drawn_scene,
    level_difference,
)
from nmatrix.raster.render import surface_of
from nmatrix.raster.shading.lighting import ShadingLight
from nmatrix.raster.shading.space import Measure, as_array, column, length, quotient
from nmatrix.raster.shading.surface import Surface
from nmatrix.scene.camera import View
from nmatrix.scene.light import EYE, SceneLight
from nmatrix.scene.scene import Scene
from nmatrix.scene.words import LightKind
from nmatrix.scene.world import World

Array = NDArray[Any]

SQUEEZED = World(scale=(1, 0.25, 1))
# Light along (0.3, 0.9, 0.2), as the worked numbers of docs/course.md have it.
FROM_ABOVE = SceneLight("sun", LightKind.DIRECTIONAL, direction=(-0.3, -0.9, -0.2))
UPRIGHT = World(rotate_degrees=(40, 0, 0))
WALK = 120  # degrees
SPUN = World(rotate_degrees=(40, 120, 0))  # about its own axis: the outline is the same


def object_rule(settings: ProofSettings) -> Proof:
    """Draw object-space lighting with Mᵀl, with M⁻¹l, and exactly; count where they part."""
    lit = replace(settings, lights=(FROM_ABOVE,))
    scene = lit.scene(settings.placed(SQUEEZED), space=Space.OBJECT)
    exact = drawn_scene(scene)
    naive = drawn_scene(scene, space=Space.WORLD, normals=NormalRule.NONE)
    transposed, inverted = _by_wrong_lights(exact)
    dark, dark_naive, dark_transposed, dark_inverted = (
        _unlit(one) for one in (exact, naive, transposed, inverted)
    )
    parted = {
        "terminator_transposed_pixels": int((dark_transposed != dark).sum()),
        "terminator_inverted_pixels": int((dark_inverted != dark).sum()),
        "terminator_transposed_against_naive_pixels": int((dark_transposed != dark_naive).sum()),
    }
    off = [level_difference(one, exact) for one in (transposed, inverted)]
    panels = (
        Panel(transposed.levels, "Mᵀ l", f"the terminator of A n; up to {off[0]} levels off"),
        Panel(inverted.levels, "M⁻¹ l", f"the right terminator; up to {off[1]} levels off"),
        Panel(exact.levels, "Exact: M⁻¹ l and the metric", "what world space shows"),
    )
    return Proof.of(
        settings.subject,
        compose("A light direction in object space is a vector, measured by the metric", panels),
        f"Mᵀl is up to {off[0]} levels off and moves the terminator; M⁻¹l keeps it, and is up to "
        f"{off[1]} levels off in shade.",
        [exact],
        numbers={**parted, "levels_transposed": off[0], "levels_inverted": off[1]},
        max_level_difference=max(off),
    )


def wrong_lights(to_light_world: Array, M: Array) -> tuple[Array, Array]:
    """Return the unit vectors (3, 1) to the light in object space by Mᵀl and by M⁻¹l.

    Examples
    --------
    >>> M = np.diag([1, 0.25, 1])
    >>> l = np.array([[0.3], [0.9], [0.2]])
    >>> n = np.array([1, 1, 0]) / np.sqrt(2)
    >>> [round(float((n @ light)[0]), 4) for light in wrong_lights(l, M)]
    [0.8735, 0.7622]
    """
    transposed, inverted = M.T @ to_light_world, np.linalg.solve(M, to_light_world)
    return quotient(transposed, length(transposed)), quotient(inverted, length(inverted))


def _by_wrong_lights(exact: DrawnScene) -> list[DrawnScene]:
    """Draw the body in object space by each of the wrong lights, without the metric."""
    (body,), (light,) = exact.loaded.bodies, exact.loaded.lights
    assert light.direction is not None  # the proof's own light
    M = as_array(linear_part(body.world_from_object.exact))

    def under(to_light: Array, surface: Surface) -> Surface:
        light = ShadingLight(np.array([[1.0]]), to_light=to_light)
        lighting = replace(surface.lighting, lights=(light,), measure=Measure())
        return replace(surface, space=replace(surface.space, uses_metric=False), lighting=lighting)

    return [
        exact.redrawn(partial(under, to_light))
        for to_light in wrong_lights(-column(light.direction), M)
    ]


def _unlit(drawn: DrawnScene) -> Array:
    """Return the pixels that get ambient light alone."""
    ambient = drawn.loaded.bodies[0].material.ambient[0]
    return np.asarray(np.abs(drawn.rendered.image[:, :, 0] - ambient) < 1e-12)


def stuck_light(settings: ProofSettings) -> Proof:
    """Turn a torus under a light in model space, and under one in eye space."""
    (light,) = settings.lights[:1]
    stuck = replace(settings, lights=(replace(light, fixed_to=settings.subject),))
    geometry = settings.geometry(TORUS)
    before = drawn_scene(settings.still.scene(UPRIGHT, geometry))
    turned = settings.placed(SPUN)
    sticks = drawn_scene(stuck.scene(turned, geometry))
    stays = drawn_scene(settings.scene(turned, geometry))
    carried = _shade(drawn_scene(stuck.still.scene(UPRIGHT, geometry)))
    sticking = float(np.abs(carried - _shade(sticks)).max())
    staying = float(np.abs(_shade(before) - _shade(stays)).max())
    panels = (
        Panel(before.levels, "The torus, lit", "before it turns"),
        Panel(sticks.levels, "Turned, light in model space", "the shade turns with it: it sticks"),
        Panel(stays.levels, "Turned, light in eye space", "the shade stays with the light"),
    )
    return Proof.of(
        settings.subject,
        compose("A light that turns with the object was never moved to its space", panels),
        f"In model space each vertex keeps its shade (it changes by {sticking:.0e}); in eye space "
        f"it changes by up to {staying * 255:.0f} levels.",
        [before, sticks, stays],
        numbers={"vertex_change_model_space": sticking, "vertex_change_eye_space": staying},
        max_level_difference=level_difference(sticks, stays),
    )


def _shade(found: DrawnScene) -> Array:
    """Return the light at every vertex."""
    surface = surface_of(found.plan, found.plan.bodies[0], {}, 1)
    matte, _ = surface.lighting.light(surface.vertex_normals, surface.space.positions())
    return matte


def flashlight(settings: ProofSettings) -> Proof:
    """Walk around an object with a light in the world, and with one fixed to the eye."""
    torch = SceneLight("torch", LightKind.DIRECTIONAL, direction=(0, 0, -1), fixed_to=EYE)
    fixed = replace(torch, fixed_to="world")
    world, walked = settings.placed(World()), (WALK + settings.picture.turn_degrees) % 360
    drawn = [
        drawn_scene(_seen_from(replace(settings.still, lights=(light,)).scene(world), angle))
        for light in (fixed, torch)
        for angle in (0, walked)
    ]
    middle = [_middle(one) for one in drawn]
    around = f"walked {walked:.4g}° around"
    panels = [
        Panel(drawn[0].levels, "Fixed to the world", "from the front"),
        Panel(drawn[1].levels, "Fixed to the world", f"{around}: {_told(drawn[1])}"),
        Panel(drawn[2].levels, "Fixed to the eye", "from the front"),
        Panel(drawn[3].levels, "Fixed to the eye", f"{around}: {_told(drawn[3])}"),
    ]
    changed = [abs(middle[0] - middle[1]), abs(middle[2] - middle[3])]
    return Proof.of(
        settings.subject,
        compose("A flashlight is a light whose place is given in camera space", panels, columns=4),
        f"Walking around, the middle changes by {changed[0]} levels under the light in the world, "
        f"by {changed[1]} under the flashlight.",
        drawn,
        numbers={"middle_change_world": changed[0], "middle_change_eye": changed[1]},
        max_level_difference=max(changed),
    )


def _seen_from(scene: Scene, degrees: float) -> Scene:
    turn = np.radians(degrees)
    eye = (3.2 * float(np.sin(turn)), 0.0, 3.2 * float(np.cos(turn)))
    lens = replace(scene.lens, near=0.5, far=10.0, fov_degrees=45.0)
    return replace(scene, view=View(eye=eye), lens=lens, has_camera=True)


def _told(found: DrawnScene) -> str:
    height, width = found.levels.shape[:2]
    return "the dark side" if _unlit(found)[height // 2, width // 2] else "lit"


def _middle(found: DrawnScene) -> int:
    height, width = found.levels.shape[:2]
    return int(found.levels[height // 2, width // 2, 0])
