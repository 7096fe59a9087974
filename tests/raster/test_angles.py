"""Angle errors of whole scenes: over every body, and over what is seen of it."""

from __future__ import annotations

from dataclasses import replace

import pytest

from nmatrix.enums import NormalRule
from nmatrix.raster.proofs.plain import picture
from nmatrix.raster.proofs.proof import Proof
from nmatrix.scene.camera import View
from nmatrix.scene.geometry import ShapeGeometry
from nmatrix.scene.material import DEFAULT_MATERIAL
from nmatrix.scene.scene import Scene, SceneObject, Settings
from nmatrix.scene.words import Shape
from nmatrix.scene.world import World

ROUND = World(translate=(-1.5, 0, 0))
TALL = World(translate=(1.5, 0, 0), scale=(0.5, 1, 0.5))
FLAT = World(translate=(0, 2, 0), scale=(0.7, 0.1, 0.7))
WALL = World(translate=(0, 0, 2), rotate_degrees=(90, 0, 0), scale=(3, 3, 3))
SPHERE = ShapeGeometry(Shape.SPHERE, (24, 48))


def sphere(name: str, world: World) -> SceneObject:
    return SceneObject(name, SPHERE, world.world_from_object)


def measured(*objects: SceneObject, **settings: object) -> Proof:
    view = View(eye=(0, 0, 8))
    drawn = Settings(size=(96, 96), samples=1)
    return picture(Scene(objects, view=view, settings=replace(drawn, **settings)), "scene")


@pytest.mark.parametrize("rule", [NormalRule.EXACT, NormalRule.NONE, NormalRule.NOT_INVERTED])
def test_the_worst_is_that_of_the_worst_body_and_the_mean_is_over_all(rule: NormalRule) -> None:
    objects = [sphere("round", ROUND), sphere("tall", TALL), sphere("flat", FLAT)]
    alone = [measured(one, normals=rule) for one in objects]
    together = measured(*objects, normals=rule)
    assert together.max_angle_error_deg == max(one.max_angle_error_deg for one in alone)
    fragments = [one.work.shaded_samples for one in alone]  # they do not hide each other
    total = sum(n * one.mean_angle_error_deg for n, one in zip(fragments, alone, strict=True))
    assert together.mean_angle_error_deg == pytest.approx(total / sum(fragments))


@pytest.mark.parametrize("rule", [NormalRule.EXACT, NormalRule.NONE])
def test_a_sentence_names_the_body_that_is_worst(rule: NormalRule) -> None:
    bodies = {"round": ROUND, "tall": TALL, "flat": FLAT}  # stretched by 1, 2 and 7
    for names in (
        ("round", "tall", "flat"),
        ("flat", "round"),
        ("tall", "round"),
        ("tall", "flat"),
    ):
        found = measured(*(sphere(one, bodies[one]) for one in names), normals=rule)
        worst = max(names, key=("round", "tall", "flat").index)
        assert found.verdict.endswith(f"° off, on {worst}.")
    assert " on " not in measured(sphere("flat", FLAT), normals=rule).verdict


def test_what_is_hidden_does_not_count_and_what_is_behind_glass_does() -> None:
    glass = replace(DEFAULT_MATERIAL, opacity=0.5)
    plane = ShapeGeometry(Shape.PLANE)
    wall, pane = (
        SceneObject("wall", plane, WALL.world_from_object, material)
        for material in (DEFAULT_MATERIAL, glass)
    )
    tall = sphere("tall", World(scale=(0.5, 1, 0.5)))
    assert measured(wall, tall).max_angle_error_deg < 1e-9
    assert measured(pane, tall).max_angle_error_deg > 30


def test_a_room_is_measured_from_inside() -> None:
    room = sphere("room", World(scale=(10, 20, 10)))
    found = measured(room)
    assert found.work.fragments == 96 * 96
    assert found.max_angle_error_deg > 30
