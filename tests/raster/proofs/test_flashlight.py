"""The flashlight: carried it lights what is looked at, left behind not; and its plan is true."""

from __future__ import annotations

from dataclasses import replace
from math import degrees

import numpy as np
import pytest

from nmatrix.canvas.glyphs import Verdict
from nmatrix.canvas.marks import Box, Polygon, Raster
from nmatrix.canvas.slide import Slide
from nmatrix.canvas.theme import PALETTES
from nmatrix.enums import Theme
from nmatrix.raster.loaded_scene import loaded
from nmatrix.raster.proofs.flashlight import CONE, WALK, Walk, _beam, _inside, _night, _walked
from nmatrix.raster.proofs.frames import PictureFrame
from nmatrix.raster.proofs.proof import Proof, ProofSettings
from nmatrix.raster.shading.space import as_array
from nmatrix.scene.camera import View
from nmatrix.scene.meshes.mesh import Mesh
from nmatrix.scene.scene import Settings
from nmatrix.scene.world import World

SMALL = ProofSettings("vase", picture=Settings(size=(320, 180), samples=1))
STAGE = Box(0, 0, 400, 300)


def proof(**settings: object) -> Proof:
    return PictureFrame("flashlight", replace(SMALL, **settings)).draw()  # type: ignore[arg-type]


def slide(found: Proof) -> Slide:
    assert isinstance(found.picture, Slide)
    return found.picture


def pictures(found: Proof) -> list[np.ndarray]:
    """Return the night pictures: left behind from both places, then carried."""
    laid = {one.box: one.pixels for one in slide(found).canvas.marks if isinstance(one, Raster)}
    return [laid[one.stage].astype(int) for one in slide(found).panels if one.stage in laid]


def walk(settings: ProofSettings = SMALL, turn: float = WALK) -> Walk:
    scene = _night(settings, STAGE)
    return Walk.between([loaded(_walked(scene, one)) for one in (0, turn)], turn)


def test_what_is_looked_at_stays_lit_by_the_light_that_is_carried() -> None:
    found = proof()
    assert found.numbers["middle_change_eye"] <= 1
    assert found.numbers["middle_change_world"] > 100
    left, left_2, carried, carried_2 = pictures(found)
    assert (left == carried).all(), "from the first place there is no difference yet"
    middle = tuple(side // 2 for side in left.shape[:2])
    assert left_2[middle].max() < 60
    assert carried_2[middle].max() > 200
    assert [one.verdict for one in slide(found).panels if one.verdict is None] == [None, None]
    assert {Verdict.WRONG, Verdict.RIGHT} < {one.verdict for one in slide(found).panels}


def test_the_numbers_do_not_change_with_the_size_of_the_slide() -> None:
    sizes = (320, 180), (500, 300)
    first, second = (proof(picture=Settings(size=one, samples=1)).numbers for one in sizes)
    assert first == second


def test_the_way_on_the_plan_leads_from_the_first_place_to_the_second() -> None:
    one = walk()
    way = one.way(one.turn)
    assert way[0] == pytest.approx(one.places[0])
    assert way[-1] == pytest.approx(one.places[1])
    away = way - one.middle
    assert np.ptp(np.hypot(away[:, 0], away[:, 2])) < 1e-9


def test_the_beam_on_the_plan_holds_the_cone_and_no_more() -> None:
    eye = (0.5, 2.5, 5.0)
    one = walk(replace(SMALL, view=View(eye=eye, target=(0, 0, 0))))
    place, look = one.places[0], one.looks[0]
    u = np.cross(look, [0, 1, 0])
    u /= np.linalg.norm(u)
    v = np.cross(u, look)
    turns = np.linspace(0, 2 * np.pi, 720)[:, None]
    wide = np.tan(np.radians(CONE[1]))
    rays = look + wide * (np.cos(turns) * u + np.sin(turns) * v)
    heading = np.arctan2(rays[:, 2], rays[:, 0]) - np.arctan2(look[2], look[0])
    spread = np.abs((degrees(1) * heading + 180) % 360 - 180).max()
    rim = _beam(one, 0)[1:] - place
    drawn = np.degrees(np.arctan2(rim[:, 2], rim[:, 0]) - np.arctan2(look[2], look[0]))
    assert np.abs((drawn + 180) % 360 - 180).max() == pytest.approx(spread, abs=0.01)


def test_a_beam_is_shortened_at_the_sides_of_its_stage() -> None:
    fan = np.array([[200.0, 150.0], [900.0, 100.0], [900.0, 250.0]])
    for x, y in _inside(STAGE, fan):
        assert STAGE.inset(-1e-9).holds((x, y))
    assert _inside(STAGE, fan / 10 + 30) == pytest.approx(fan / 10 + 30)


@pytest.mark.parametrize("theme", Theme)
def test_the_plan_has_a_floor_two_or_one_beams_and_bodies(theme: Theme) -> None:
    found = slide(proof(theme=theme))
    beams = [
        one
        for one in found.canvas.marks
        if isinstance(one, Polygon) and one.opacity < 1 and one.fill == PALETTES[theme].light
    ]
    assert len(beams) == 3
    assert all(one.edge is not None for one in beams), "in print light is as white as paper"


def test_the_scene_is_as_large_as_its_body() -> None:
    mesh = Mesh(
        np.array([[0.0, 0, 0], [50, 0, 0], [0, 80, 0]]),
        np.tile([0.0, 0, 1], (3, 1)),
        np.array([[0, 1, 2]]),
    )
    scene = _night(replace(SMALL, mesh=mesh), STAGE)
    floor, body = loaded(scene).bodies[-1], loaded(scene).bodies[0]
    assert floor.radius > body.radius
    assert floor.box[1][1] < body.box[0][1], "the body stands on it"
    look = -as_array(loaded(scene).camera_from_world.exact)[2, :3]
    eye = np.array([float(one) for one in loaded(scene).eye])
    to_body = body.centre - eye
    assert look @ to_body / np.linalg.norm(to_body) == pytest.approx(1)


@pytest.mark.parametrize(
    "settings",
    [
        {"world": World(scale=0)},
        {"world": World(scale=(1, 0, 1))},
        {"view": View(eye=(0, 0, 5), target=(0, 0, 9))},
        {"view": View(eye=(0, 9, 0), target=(0, 0, 0))},
    ],
)
def test_anything_is_drawn(settings: dict) -> None:
    found = proof(**settings)
    marks = [one for one in slide(found).canvas.marks if isinstance(one, Polygon)]
    points = np.concatenate([np.array(loop) for one in marks for loop in one.loops])
    assert np.isfinite(points).all()
    assert found.numbers["middle_change_eye"] <= found.numbers["middle_change_world"] + 1


def test_frames_go_on_with_the_walk() -> None:
    frame = PictureFrame("flashlight", SMALL)
    first, on = frame.turned(0).draw(), frame.turned(100).draw()
    assert "118°" in _footer(first)
    assert "218°" in _footer(on)
    kept = pictures(first)[0], pictures(on)[0]
    assert (kept[0] == kept[1]).all(), "the first place stays"
    assert (pictures(first)[3] != pictures(on)[3]).any()


def _footer(found: Proof) -> str:
    texts = [one.text for one in slide(found).canvas.marks if hasattr(one, "text")]
    return next(one for one in texts if one.startswith("Walk"))
