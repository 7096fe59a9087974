"""The proof of interpolation: what unequal lengths bend, in closed form, and unequal depths."""

from __future__ import annotations

import numpy as np
import pytest

from nmatrix.canvas.glyphs import Verdict
from nmatrix.canvas.marks import Stroke
from nmatrix.canvas.slide import Slide
from nmatrix.canvas.theme import PALETTES
from nmatrix.enums import Theme
from nmatrix.raster.proofs.frames import PictureFrame
from nmatrix.raster.proofs.interpolation import FAN, Bend, Mix, most_bent
from nmatrix.raster.proofs.proof import Proof, ProofSettings
from nmatrix.raster.shading.normals import angles_deg, unit
from nmatrix.scene.camera import View
from nmatrix.scene.meshes.shapes import box, sphere
from nmatrix.scene.scene import Settings
from nmatrix.scene.world import World

SMALL = Settings(size=(400, 225), samples=1)
BENDS = [Bend(4.0, np.pi / 2), Bend(1.5, 0.3), Bend(30.0, 2.5), Bend(1.0, 1.0)]


def proof(**settings: object) -> Proof:
    chosen = ProofSettings("interpolation", **{"picture": SMALL, **settings})  # type: ignore[arg-type]
    return PictureFrame("interpolation", chosen).draw()


def slide(found: Proof) -> Slide:
    assert isinstance(found.picture, Slide)
    return found.picture


def test_interpolation_bends_directions_and_patterns() -> None:
    found = proof()
    assert 3 < found.max_angle_error_deg < 20
    assert found.numbers["never_level_difference"] > 50
    assert found.numbers["after_level_difference"] > 20
    assert 0.2 < found.numbers["affine_wrong_part"] < 0.8


@pytest.mark.parametrize("bend", BENDS)
def test_the_worst_bend_is_that_of_the_finest_fan(bend: Bend) -> None:
    t = np.linspace(0, 1, 200_001)[:, None]
    a, b = np.array([[1.0, 0, 0]]), np.array([[np.cos(bend.between), np.sin(bend.between), 0]])
    unequal = unit((1 - t) * a + t * bend.ratio * b)
    assert angles_deg(unequal, unit((1 - t) * a + t * b)).max() == pytest.approx(
        bend.worst_deg, abs=1e-4
    )


@pytest.mark.parametrize("bend", BENDS)
def test_a_fan_begins_and_ends_with_the_given_normals(bend: Bend) -> None:
    for mix in Mix:
        fan = np.array(mix.along(bend))
        assert len(fan) == FAN
        first, last = np.linalg.norm(fan[[0, -1]], axis=1)
        assert last == pytest.approx(1)
        assert first == pytest.approx(1 / bend.ratio if mix is Mix.NEVER else 1)
        turned = np.arccos(np.clip(fan[0] @ fan[-1] / first / last, -1, 1))
        assert turned == pytest.approx(bend.between)


def test_the_most_bent_edge_is_found_among_all() -> None:
    mesh = sphere(5, 8)
    moved = mesh.normals / [1, 3, 1]  # A⁻ᵀn under a stretch by 3
    found = most_bent(moved, mesh.triangles)
    edges = np.concatenate([mesh.triangles[:, pair] for pair in ([0, 1], [1, 2], [2, 0])])
    t = np.linspace(0, 1, 501)[:, None, None]
    a, b = moved[edges[:, 0]], moved[edges[:, 1]]
    bent, even = ((1 - t) * one + t * other for one, other in ((a, b), (unit(a), unit(b))))
    worst = angles_deg(unit(bent).reshape(-1, 3), unit(even).reshape(-1, 3)).max()
    assert found.worst_deg == pytest.approx(worst, abs=1e-3)
    assert most_bent(0 * moved, mesh.triangles).worst_deg == 0


def test_equal_lengths_bend_nothing_and_the_panels_say_so() -> None:
    found = proof(world=World(rotate_degrees=(20, 30, 40)), mesh=sphere(5, 8))
    panels = slide(found).panels
    assert found.numbers["after_level_difference"] == 0
    assert [one.verdict for one in panels[2:4]] == [Verdict.RIGHT, Verdict.RIGHT]
    assert "Nothing bends" in panels[3].caption
    assert panels[0].verdict is Verdict.WRONG, "between corners a mix is short"
    assert (panels[3], panels[5]) in slide(found).same


def test_on_even_normals_all_three_are_the_same() -> None:
    found = proof(world=World(), mesh=box())
    assert len(slide(found).same) == 2
    assert {one.verdict for one in slide(found).panels[:6]} == {Verdict.RIGHT}
    assert found.numbers["never_level_difference"] == 0


@pytest.mark.parametrize("scale", [(1, 0, 1), (1, 0, 0), (0, 0, 0), (-1, 3, 1), (2, 2, 2)])
def test_captions_are_true_of_other_maps(scale: tuple) -> None:
    found = proof(world=World(scale=scale))
    told = " ".join(one.caption for one in slide(found).panels)
    rank = sum(map(bool, scale))
    assert ("No normal survives" in told) == (rank < 2)
    assert ("down to 0.5 long" in told) == (scale == (2, 2, 2))


def test_a_verdict_is_of_the_normals_and_not_of_what_happens_to_be_seen() -> None:
    """From so far nothing of the body is seen: all three pictures are the same."""
    found = proof(view=View(eye=(0, 0, 300)))
    panels = slide(found).panels
    assert [one.verdict for one in panels[1:6:2]] == [Verdict.WRONG, Verdict.WRONG, Verdict.RIGHT]
    assert len(slide(found).same) == 2


def test_the_dashed_edge_is_the_one_that_both_triangles_share() -> None:
    found = proof()
    wrong = PALETTES[Theme.LIGHT].wrong
    *_, line = (
        one
        for one in slide(found).canvas.marks
        if isinstance(one, Stroke) and one.colour == wrong and one.dash
    )
    stage = slide(found).panels[6].stage
    assert all(stage.holds(point) for point in line.points)
    assert np.hypot(*np.subtract(*line.points)) > stage.height / 2


def test_the_share_does_not_depend_on_the_size() -> None:
    other = proof(picture=Settings(size=(200, 300), samples=1))
    assert other.numbers["affine_wrong_part"] == proof().numbers["affine_wrong_part"]
