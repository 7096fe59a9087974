"""Proofs about what happens between vertices: where light is evaluated, how normals get there."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import Effect, NormalRule, Reflection, Shading
from nmatrix.linear.affine import translation_matrix
from nmatrix.raster.image import Panel, compose
from nmatrix.raster.proofs.angles import angle_map
from nmatrix.raster.proofs.proof import (
    Proof,
    ProofSettings,
    drawn_scene,
    level_difference,
)
from nmatrix.raster.render import surface_of
from nmatrix.raster.shading.surface import Surface
from nmatrix.scene.camera import View
from nmatrix.scene.geometry import ShapeGeometry
from nmatrix.scene.material import CHECKER, Material
from nmatrix.scene.scene import Scene, SceneObject
from nmatrix.scene.words import Shape
from nmatrix.scene.world import World

Array = NDArray[Any]

COARSE = ShapeGeometry(Shape.SPHERE, (6, 12))
TALL = World(scale=(1, 2.5, 1))
FLOOR = World(scale=(3, 1, 6))
FLOOR_AT = (0, -1, -3)


def shading(settings: ProofSettings) -> Proof:
    """Draw flat, Gouraud and Phong shading, two highlights, and toon bands."""
    scene = settings.scene(
        settings.placed(World()), settings.geometry(ShapeGeometry(Shape.TORUS, (12, 24)))
    )
    flat, gouraud, phong, mirrored, half, toon = drawn = [
        drawn_scene(_as_material(scene, reflection), shading=shading)
        for shading, reflection in (
            (Shading.FLAT, Reflection.PHONG),
            (Shading.GOURAUD, Reflection.PHONG),
            (Shading.PHONG, Reflection.PHONG),
            (Shading.PHONG, Reflection.PHONG),
            (Shading.PHONG, Reflection.BLINN_PHONG),
            (Shading.PHONG, Reflection.TOON),
        )
    ]
    panels = (
        Panel(flat.levels, "Flat shading", "light once for each triangle"),
        Panel(gouraud.levels, "Gouraud shading", "light at vertices, interpolated"),
        Panel(phong.levels, "Phong shading", "normals interpolated, light at fragments"),
        Panel(mirrored.levels, "Phong reflection", "the mirrored light and the eye"),
        Panel(half.levels, "Blinn-Phong reflection", "normal and half vector"),
        Panel(toon.levels, "Toon", "the cosine in bands, and an outline"),
    )
    apart = {
        "flat_against_phong": level_difference(flat, phong),
        "gouraud_against_phong": level_difference(gouraud, phong),
        "phong_against_blinn_phong": level_difference(mirrored, half),
        "toon_levels": len(np.unique(toon.levels)),
    }
    found = Proof.of(
        settings.subject,
        compose("Phong shading is where, Phong reflection is how", panels),
        f"Gouraud shading is up to {apart['gouraud_against_phong']} levels from Phong shading: it "
        "misses highlights between vertices.",
        drawn,
        numbers=apart,
        max_level_difference=apart["flat_against_phong"],
    )
    return replace(found, effects=mirrored.effects)


def _as_material(scene: Scene, reflection: Reflection) -> Scene:
    (one,) = scene.objects
    outline = 0.3 if reflection is Reflection.TOON else 0.0
    material = replace(one.material, reflection=reflection, outline=outline)
    return replace(scene, objects=(replace(one, material=material),))


def interpolation(settings: ProofSettings) -> Proof:
    """Draw normals normalised never, after and before interpolation; and affine interpolation."""
    scene = settings.scene(settings.placed(TALL), settings.geometry(COARSE))
    right = drawn_scene(scene)
    never, after, both = (
        right.redrawn(partial(_normalised, before=before, after=then))
        for before, then in ((False, False), (False, True), (True, True))
    )
    surface = surface_of(right.plan, right.plan.bodies[0], {}, 1)
    bent = angle_map(
        right.plan,
        *([_normalised(surface, before=b, after=True).vertex_normals] for b in (False, True)),
    )
    floor = drawn_scene(_checkered(settings))
    affine = floor.redrawn(_affine)
    swum = float((np.abs(affine.levels.astype(int) - floor.levels).max(axis=2) > 8).mean())
    bend = f"bent by up to {bent.worst_deg or 0:.1f}°"
    panels = (
        Panel(never.levels, "Never normalised", "short normals: too dark between vertices"),
        Panel(after.levels, "After interpolation only", bend),
        Panel(both.levels, "Before and after", "right"),
        Panel(affine.levels, "Affine interpolation", f"{swum:.0%} of the pixels are wrong"),
        Panel(floor.levels, "Perspective-correct", "each corner weighed by 1/w"),
    )
    return Proof.of(
        settings.subject,
        compose("Unequal lengths bend a direction; unequal depths bend a pattern", panels),
        f"Normals of unequal length are {bend}; affine interpolation moves the pattern in "
        f"{swum:.0%} of the pixels.",
        [floor, right],
        numbers={
            "never_level_difference": level_difference(never, both),
            "after_level_difference": level_difference(after, both),
            "affine_wrong_part": swum,
        },
        max_level_difference=level_difference(never, both),
        **bent.errors,
    )


def _normalised(surface: Surface, *, before: bool, after: bool) -> Surface:
    on = surface.effects | {Effect.RENORMALISE} if after else surface.effects - {Effect.RENORMALISE}
    rule = NormalRule.EXACT if before else NormalRule.INVERSE
    style = replace(surface.style, unit_vertices=before, rule=rule)
    return replace(surface, style=style, effects=on)


def _affine(surface: Surface) -> Surface:
    return replace(surface, effects=surface.effects - {Effect.PERSPECTIVE})


def _checkered(settings: ProofSettings) -> Scene:
    """Return a floor of two large triangles that runs away from the eye."""
    material = Material("checker", texture=CHECKER)
    geometry = ShapeGeometry(Shape.PLANE)
    place = settings.in_turn(FLOOR).under(translation_matrix(FLOOR_AT))
    floor = SceneObject("floor", geometry, place.world_from_object, material)
    scene = settings.with_objects(floor)
    lens = replace(scene.lens, near=0.1, far=50.0, fov_degrees=60.0)
    return replace(
        scene, view=View(eye=(0.8, 0.4, 4.5), target=(0, -1, 0.5)), lens=lens, has_camera=True
    )
