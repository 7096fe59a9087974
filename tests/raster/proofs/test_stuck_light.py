"""The stuck light: the lamp rides along on the turntable, and nothing else does."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from nmatrix.canvas.glyphs import Verdict
from nmatrix.canvas.marks import Raster
from nmatrix.canvas.slide import Slide
from nmatrix.linear.affine import rotation_about_axis
from nmatrix.linear.angle import Angle
from nmatrix.linear.rational import affine_matrix, to_floats
from nmatrix.raster.loaded_scene import loaded
from nmatrix.raster.proofs.frames import PictureFrame
from nmatrix.raster.proofs.letter import letter_r
from nmatrix.raster.proofs.proof import Proof, ProofSettings, turned_light
from nmatrix.raster.proofs.stuck_light import AXIS, TURNS, Turntable, _degrees, _rotation
from nmatrix.scene.light import SceneLight
from nmatrix.scene.scene import Settings
from nmatrix.scene.words import LightKind
from nmatrix.scene.world import World

SMALL = ProofSettings("letter", picture=Settings(size=(320, 180), samples=1))


def proof(**settings: object) -> Proof:
    return PictureFrame("stuck-light", replace(SMALL, **settings)).draw()  # type: ignore[arg-type]


def slide(found: Proof) -> Slide:
    assert isinstance(found.picture, Slide)
    return found.picture


def rasters(found: Proof) -> list[np.ndarray]:
    """Return the pictures of the six stages, row by row."""
    laid = {one.box: one.pixels for one in slide(found).canvas.marks if isinstance(one, Raster)}
    return [laid[panel.stage] for panel in slide(found).panels]


def test_in_model_space_alone_each_vertex_keeps_its_shade() -> None:
    found = proof().numbers
    assert found["vertex_change_model_space"] < 1e-12
    assert found["vertex_change_eye_space"] > 0.5


def test_before_it_turns_both_rows_are_one_picture_and_then_never() -> None:
    stuck, right = np.split(np.array(rasters(proof()), int), 2)
    apart = [np.abs(a - b).max() for a, b in zip(stuck, right, strict=True)]
    assert apart[0] == 0
    assert min(apart[1:]) > 100, "lit in one row and dark in the other"
    (same,) = slide(proof()).same
    assert [one.verdict for one in same] == [None, None]


@pytest.mark.parametrize("turn", [0.0, 30.0, 90.0, 200.0, 359.0])
def test_the_turn_is_read_from_the_rotation(turn: float) -> None:
    assert _degrees(_rotation(turn)) == pytest.approx(turn, abs=1e-9)


def test_the_lamp_rides_as_the_body_turns() -> None:
    """A vertex under the lamp stays under it."""
    light = SceneLight("lamp", LightKind.POINT, position=(0.3, 2, 0.4))
    for turn in TURNS:
        gone = np.array(turned_light(light, _rotation(turn)).position, float)
        moved = np.array(to_floats(_rotation(turn)))[:3, :3] @ [0.3, -1, 0.4]
        assert gone[[0, 2]] == pytest.approx(moved[[0, 2]])


def test_the_table_holds_all_that_turns_and_the_lamp_stands_outside() -> None:
    mesh = letter_r()
    for size in (1.0, 50.0):
        table = Turntable.under(size * mesh.positions)
        away = size * np.hypot(mesh.positions[:, 0], mesh.positions[:, 2])
        assert table.radius > away.max()
        assert table.mesh.positions[:, 1].max() < table.ground
        x, _, z = table.lamp.position
        assert np.hypot(float(x), float(z)) > table.reach


@pytest.mark.parametrize(
    "light",
    [
        SceneLight("bulb", LightKind.POINT, position=(0, 4, 0)),
        SceneLight("sun", LightKind.DIRECTIONAL, direction=(0, -1, 0)),
    ],
)
def test_a_light_on_the_axis_proves_nothing_and_the_title_says_so(light: SceneLight) -> None:
    found = proof(lights=(light,))
    assert "proves nothing" in slide(found).title
    assert len(slide(found).same) == 3


def test_several_lights_leave_the_first_alone() -> None:
    sun = SceneLight("sun", LightKind.DIRECTIONAL, direction=(-1, -1, -1))
    bulb = SceneLight("bulb", LightKind.POINT, position=(3, 3, 3))
    assert (proof(lights=(sun, bulb)).image == proof(lights=(sun,)).image).all()


def test_frames_turn_the_table_and_nothing_jumps() -> None:
    frame = PictureFrame("stuck-light", SMALL)
    first, second, last = (frame.turned(angle).draw() for angle in (0, 20, 360))
    assert (first.image == last.image).all()
    assert "0°: before" in slide(first).panels[0].heading
    assert slide(second).panels[0].heading.endswith("20°")
    boxes = [[panel.stage for panel in slide(one).panels] for one in (first, second)]
    assert boxes[0] == boxes[1]


def test_a_frame_is_the_still_picture_of_a_body_that_has_turned() -> None:
    turned = affine_matrix(rotation_about_axis(AXIS, Angle.degrees(60)))
    frame = rasters(PictureFrame("stuck-light", SMALL).turned(60).draw())
    still = rasters(proof(world=World().under(turned)))
    body = loaded(SMALL.scene(SMALL.object(World()))).bodies[0]
    assert body.linear_map.rank == 3
    apart = (np.abs(frame[3].astype(int) - still[3]).max(axis=2) > 2).mean()
    assert apart < 0.01, "the tick on the table alone is elsewhere"


def test_the_wrong_row_comes_first() -> None:
    verdicts = [one.verdict for one in slide(proof()).panels]
    assert verdicts == [None, Verdict.WRONG, Verdict.WRONG, None, Verdict.RIGHT, Verdict.RIGHT]
