"""Five spaces: one picture, and above it things where the matrices of the spaces put them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from nmatrix.canvas.marks import Polygon, Raster, Stroke, Text
from nmatrix.canvas.slide import Slide
from nmatrix.enums import Space
from nmatrix.raster.loaded_scene import LoadedScene, loaded
from nmatrix.raster.proofs.frames import PictureFrame
from nmatrix.raster.proofs.proof import Proof, ProofSettings
from nmatrix.raster.proofs.spaces import (
    STANDING,
    STANDPOINTS,
    _lamp,
    _power_of_ten,
    _Surroundings,
    _through,
)
from nmatrix.raster.shading.space import as_array
from nmatrix.scene.camera import View
from nmatrix.scene.light import SceneLight
from nmatrix.scene.scene import Scene, Settings
from nmatrix.scene.words import LightKind
from nmatrix.scene.world import World

SMALL = ProofSettings("letter", picture=Settings(size=(320, 180), samples=1))
MAPS = (STANDING, World(scale=(-1, 2, 1)), World(rotate_degrees=(10, 200, 3), translate=(4, 0, 0)))


def proof(**settings: object) -> Proof:
    return PictureFrame("spaces", replace(SMALL, **settings)).draw()  # type: ignore[arg-type]


def slide(found: Proof) -> Slide:
    assert isinstance(found.picture, Slide)
    return found.picture


def scene(world: World) -> tuple[Scene, LoadedScene]:
    """Return the scene of the proof before a camera, and loaded."""
    one = SMALL.object(world, SMALL.geometry())
    body = loaded(SMALL.scene(one)).bodies[0]
    view = View(eye=(3, 1, 4), target=(0.5, 0.5, 0))
    found = replace(SMALL.scene(one, lights=(_lamp(body),)), view=view, has_camera=True)
    return found, loaded(found)


def test_five_spaces_differ_by_rounding_alone() -> None:
    found = proof()
    assert set(found.numbers["differences"]) == {one.space.value for one in STANDPOINTS}
    assert max(found.numbers["differences"].values()) <= 1e-12
    assert found.max_level_difference == 0
    assert len(slide(found).same) == 4
    assert slide(found).title.startswith("Five")


def test_every_space_but_a_callers_own_has_its_place() -> None:
    assert {one.space for one in STANDPOINTS} == set(Space) - {Space.CUSTOM}


@pytest.mark.parametrize("world", MAPS)
@pytest.mark.parametrize("standpoint", STANDPOINTS, ids=lambda one: one.space.value)
def test_things_are_where_the_matrix_of_the_space_puts_them(standpoint, world: World) -> None:
    _, ready = scene(world)
    around = _Surroundings(SMALL, ready, standpoint)
    S = as_array(around.exact)
    origin = _through(S, around.axes[:, :1].T)[0]
    assert origin == pytest.approx([0, 0, 0], abs=1e-9)
    axes = S[:3, :3] @ around.axes[:, 1:]
    assert axes == pytest.approx(axes[0, 0] * np.eye(3), abs=1e-9)
    eye, lamp = (_through(S, one[None])[0] for one in (around.eye, around.lamp))
    if standpoint.space is Space.CAMERA:
        assert eye == pytest.approx([0, 0, 0], abs=1e-9)
    if standpoint.space is Space.LIGHT:
        assert lamp == pytest.approx([0, 0, 0], abs=1e-9)
    if standpoint.space is Space.OBJECT:
        body = _through(S, around.body.positions_world)
        assert body == pytest.approx(around.body.mesh.positions, abs=1e-9)


@pytest.mark.parametrize("standpoint", STANDPOINTS, ids=lambda one: one.space.value)
def test_a_stage_holds_all_that_stands_in_its_space(standpoint) -> None:
    plain, ready = scene(STANDING)
    found = SMALL.slide("")
    panel = found.panel(found.body(100).columns(5, 16)[0])
    around = _Surroundings(SMALL, ready, standpoint)
    stage = around.draw(found, panel, plain)
    for one in (around.eye, around.lamp, *around.floor, *around.body.positions_world[::9]):
        place = stage.place(one)
        assert place is not None
        assert panel.stage.holds(place)


def test_a_point_of_the_world_is_drawn_where_it_is_in_the_space() -> None:
    """The camera of a stage is that of an observer in the space, after the space's matrix."""
    plain, ready = scene(STANDING)
    found = SMALL.slide("")
    panel = found.panel(found.body(100).columns(5, 16)[0])
    around = _Surroundings(SMALL, ready, STANDPOINTS[0])
    stage = around.draw(found, panel, plain)
    seen = _through(as_array(around.exact), around.floor)
    middle = (seen[0] + seen[2]) / 2
    back = np.linalg.inv(as_array(around.exact)) @ [*middle, 1]
    a, b = np.array(stage.place(back[:3])), np.array(stage.place(around.floor[[0, 2]].mean(axis=0)))
    assert a == pytest.approx(b)


@pytest.mark.parametrize("scale", [(1, 0, 1), (1, 0, 0), (0, 0, 0)])
def test_spaces_that_a_flat_body_does_not_have_say_so(scale: tuple) -> None:
    found = proof(world=World(scale=scale))
    assert slide(found).title.startswith("Three")
    assert set(found.numbers["differences"]) == {"world", "camera", "light"}
    assert max(found.numbers["differences"].values()) <= 1e-12
    texts = [one.text for one in slide(found).canvas.marks if isinstance(one, Text)]
    assert "no M^{−1}" in texts


def test_a_lamp_at_its_own_target_has_no_space() -> None:
    lamp = SceneLight("bulb", LightKind.POINT, position=(0, 0, 0))
    found = proof(lights=(lamp,))
    assert slide(found).title.startswith("Four")
    assert "light" not in found.numbers["differences"]


def test_a_sun_is_called_one() -> None:
    sun = SceneLight("sun", LightKind.DIRECTIONAL, direction=(-1, -1, -1))
    told = " ".join(one.caption for one in slide(proof(lights=(sun,))).panels)
    assert "lamp" not in told
    assert "sun" in told


def test_the_dots_of_the_static_stage_are_vertices() -> None:
    plain, ready = scene(STANDING)
    found = SMALL.slide("")
    panel = found.panel(found.body(100).columns(5, 16)[0])
    static = next(one for one in STANDPOINTS if one.space is Space.STATIC)
    around = _Surroundings(SMALL, ready, static)
    stage = around.draw(found, panel, plain)
    vertices = stage.window(around.body.positions_world)[:, :2]
    palette = found.palette
    dots = [
        np.mean(one.loops[0], axis=0)
        for one in found.canvas.marks
        if isinstance(one, Polygon) and (one.fill, one.edge) == (palette.dim, palette.bright)
    ]
    assert len(dots) > 20
    for dot in dots:
        assert np.abs(vertices - dot).sum(axis=1).min() < 1e-6


def test_nothing_but_the_body_moves_from_frame_to_frame() -> None:
    frame = PictureFrame("spaces", SMALL)
    first, second = (frame.turned(angle).draw() for angle in (0, 25))
    marks = [
        [one for one in slide(found).canvas.marks if isinstance(one, Text)]
        for found in (first, second)
    ]
    world = slide(first).panels[1].stage
    letters = [
        {(one.text, one.place) for one in some if world.holds(one.place) and one.text in "xyz"}
        for some in marks
    ]
    assert letters[0] & letters[1], "the axes of the world stay"
    rasters = [
        [one.box for one in slide(found).canvas.marks if isinstance(one, Raster)]
        for found in (first, second)
    ]
    assert rasters[0] == rasters[1]


@pytest.mark.parametrize(
    ("number", "text"), [(0.0, "0"), (2.4e-15, "2 · 10^{−15}"), (9.6e-16, "1 · 10^{−15}")]
)
def test_a_small_number_is_written_with_its_power_of_ten(number: float, text: str) -> None:
    assert _power_of_ten(number) == text


@pytest.mark.parametrize("world", [STANDING, World(scale=(1, 9, 1), shear=(2, 0, 0))])
def test_pictures_that_are_said_to_be_the_same_have_the_same_outlines(world: World) -> None:
    found = proof(world=world)
    lines = []
    for panel in slide(found).panels[5:]:
        box = panel.stage
        strokes = [one for one in slide(found).canvas.marks if isinstance(one, Stroke)]
        strokes = [one for one in strokes if one.width < 2]  # of outlines, not of = between them
        inside = [one.points for one in strokes if box.holds(one.points[0])]
        lines.append([np.array(one) - (box.x, box.y) for one in inside])
    assert len(lines[0]) > 1
    for other in lines[1:]:
        assert [one.shape for one in other] == [one.shape for one in lines[0]]
        assert all(np.abs(a - b).max() < 1e-6 for a, b in zip(lines[0], other, strict=True))
