"""Axes, ways, lamps over the ground and plans: where they are drawn, and what hides them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from nmatrix.canvas.glyphs import Ink
from nmatrix.canvas.marks import Polygon, Stroke, Text
from nmatrix.enums import Theme
from nmatrix.raster.overlay.stage import Stage
from nmatrix.raster.proofs.proof import ProofSettings
from nmatrix.raster.proofs.staging import draw_on
from nmatrix.scene.camera import View
from nmatrix.scene.geometry import ShapeGeometry
from nmatrix.scene.lens import Lens
from nmatrix.scene.light import SceneLight
from nmatrix.scene.scene import Settings
from nmatrix.scene.words import LightKind, Shape
from nmatrix.scene.world import World

SUN = SceneLight("sun", LightKind.DIRECTIONAL, direction=(-1, -1, -1))


def stage(eye: tuple = (2, 3, 9), light: SceneLight = SUN, theme: Theme = Theme.LIGHT) -> Stage:
    """Return a stage with a ball of radius 1 at the origin."""
    settings = ProofSettings("ball", picture=Settings(size=(320, 180), samples=1), theme=theme)
    slide = settings.slide("")
    panel = slide.panel(slide.body(100))
    one = settings.object(World(), ShapeGeometry(Shape.SPHERE))
    lens = Lens(fov_degrees=40, aspect=panel.stage.width / panel.stage.height, near=1, far=30)
    scene = replace(settings.scene(one, lights=(light,)), view=View(eye=eye), lens=lens)
    found = draw_on(slide, panel, scene)
    slide.canvas.marks.clear()
    return found


def letters(found: Stage) -> set[str]:
    return {one.text for one in found.canvas.marks if isinstance(one, Text)}


def test_axes_carry_their_letters_beyond_their_tips() -> None:
    found = stage()
    found.axes(np.concatenate([np.zeros((3, 1)), 2.5 * np.eye(3)], axis=1))
    assert letters(found) == {"x", "y", "z"}
    middle = np.array(found.place((0, 0, 0)))
    for one in found.canvas.marks:
        if not isinstance(one, Text):
            continue
        tip = np.array(found.place(2.5 * np.eye(3)["xyz".index(one.text)]))
        at = np.array(one.box.middle)
        assert np.linalg.norm(at - tip) < 30
        assert np.linalg.norm(at - middle) > np.linalg.norm(tip - middle)


def test_an_axis_inside_a_body_is_not_drawn() -> None:
    found = stage()
    found.axes(np.concatenate([np.zeros((3, 1)), 0.5 * np.eye(3)], axis=1))
    assert not found.canvas.marks


def test_a_lamp_stands_over_its_place_on_the_ground() -> None:
    found = stage()
    found.above_ground((2, 1.5, 1), -1.0)
    line, dot = found.canvas.marks
    assert isinstance(line, Stroke)
    assert isinstance(dot, Polygon)
    assert line.points[0] == pytest.approx(found.place((2, 1.5, 1)))
    assert np.mean(dot.loops[0], axis=0) == pytest.approx(found.place((2, -1, 1)))


def test_a_way_leaves_out_what_is_behind_the_eye_and_nothing_else() -> None:
    found = stage(eye=(0, 0, 9))
    found.path(np.array([[0.5, 0, z] for z in range(-3, 20)]), Ink.WRONG)
    points = np.concatenate([one.points for one in found.canvas.marks if isinstance(one, Stroke)])
    assert np.isfinite(points).all()
    assert len(points) >= 12


def test_a_plan_is_the_outline_of_what_is_covered() -> None:
    found = stage()
    found.cut_out("#123456")
    (mark,) = found.canvas.marks
    assert isinstance(mark, Polygon)
    assert mark.fill == "#123456"
    rim = np.array(mark.loops[0])
    middle = np.array(found.place((0, 0, 0)))
    away = np.hypot(*(rim - middle).T)
    assert away.min() > 0.85 * away.max(), "a ball is seen as a disc, nearly"


@pytest.mark.parametrize("direction", [(-1, -1, -1), (1, -1, -1), (1, 1, -1), (0, 0, 1)])
def test_words_find_the_corners_without_a_sun_and_a_lost_sun_covers_no_other(
    direction: tuple,
) -> None:
    found = stage(light=replace(SUN, direction=direction))
    free = found.free_corners(10)
    assert len(free) == 3
    found.lights()
    sun = np.mean(found.canvas.marks[0].loops[0], axis=0)
    assert all(np.hypot(*(np.array(one) - sun)) > 100 for one in free)
    found.sun(direction, lost=True)
    lost = next(one for one in found.canvas.marks if getattr(one, "width", 0) == 4.0)
    assert np.hypot(*(np.mean(lost.loops[0], axis=0) - sun)) > 60
    assert found.box.holds(tuple(np.mean(lost.loops[0], axis=0)))


def test_the_edge_of_the_light_is_seen_on_the_side_of_the_eye_alone() -> None:
    turns = np.linspace(0, 2 * np.pi, 200)
    circle = np.stack([np.cos(turns), np.sin(turns), 0 * turns], axis=1)
    found = stage(eye=(0, 0, 9))
    out = np.array([0, 0, 0.8])
    front, back = circle * 0.6 + out, circle * 0.6 - out
    assert found.light_edge([front])
    assert not found.light_edge([back])


@pytest.mark.parametrize("theme", Theme)
def test_dashes_on_bodies_are_bright_on_dim_in_every_theme(theme: Theme) -> None:
    found = stage(theme=theme)
    palette = found.canvas.palette
    assert {palette.bright, palette.dim} == {palette.paper, palette.ink}
    assert int(palette.bright[1:], 16) > int(palette.dim[1:], 16)
