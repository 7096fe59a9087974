"""What proofs say in one sentence is so: of the whole shape or of what is seen, of your own map."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from nmatrix.canvas.marks import Polygon, Stroke, Text
from nmatrix.canvas.slide import Slide
from nmatrix.enums import NormalRule, Theme
from nmatrix.raster.proofs.frames import PictureFrame
from nmatrix.raster.proofs.plain import picture
from nmatrix.raster.proofs.proof import Proof, ProofSettings
from nmatrix.scene.light import SceneLight
from nmatrix.scene.meshes.mesh import Mesh
from nmatrix.scene.scene import Settings
from nmatrix.scene.words import LightKind
from nmatrix.scene.world import World

SMALL = Settings(size=(320, 180), samples=1)
FROM_BEHIND = (SceneLight("sun", LightKind.DIRECTIONAL, direction=(0.2, 0.1, 1)),)
GROUND = Mesh(
    np.array([[-1.0, 0, -1], [-1, 0, 1], [1, 0, 1], [1, 0, -1]]),
    np.tile([0.0, 1, 0], (4, 1)),
    np.array([[0, 1, 2], [0, 2, 3]]),
)
FLAT = World(scale=(1, 0, 1))


def proof(name: str, **settings: object) -> Proof:
    return PictureFrame(name, ProofSettings(name, picture=SMALL, **settings)).draw()  # type: ignore[arg-type]


def words(found: Proof) -> list[str]:
    assert isinstance(found.picture, Slide)
    return [one.text for one in found.picture.canvas.marks if isinstance(one, Text)]


@pytest.mark.parametrize("name", ["normals", "translation", "object-rule"])
def test_a_number_over_the_whole_shape_says_so(name: str) -> None:
    assert "unseen" in proof(name).verdict


def test_where_the_light_is_behind_no_share_of_nothing_is_marked() -> None:
    written = words(proof("object-rule", lights=FROM_BEHIND))
    assert not {"0 %", "-0 %"} & set(written)


@pytest.mark.parametrize(
    ("world", "said"),
    [(None, "in a stretch"), (World(), "under your map"), (World(scale=(0, 1, 0)), "no normal")],
)
def test_bias_calls_a_stretch_only_what_is_one(world: World | None, said: str) -> None:
    verdict = proof("bias", world=world).verdict
    assert said in verdict
    assert ("in a stretch" in verdict) == (world is None)


@pytest.mark.parametrize("name", ["normals", "bias"])
def test_a_shape_flattened_along_its_normals_keeps_them_by_the_cofactors(name: str) -> None:
    """The cofactors of diag(1, 0, 1) are diag(0, 1, 0): they leave (0, 1, 0) as it is."""
    found = proof(name, mesh=GROUND, world=FLAT)
    told = f"{found.verdict} {' '.join(words(found))}"
    assert "No normal survives" not in told
    assert "no plane" not in told


@pytest.mark.parametrize("rule", [one for one in NormalRule if one is not NormalRule.EXACT])
def test_a_rule_is_never_praised_or_blamed_for_another(rule: NormalRule) -> None:
    settings = ProofSettings("egg", picture=SMALL)
    for world in (World(scale=(1, 2, 1)), World(scale=(1, 0, 1))):
        scene = settings.scene(settings.object(world))
        chosen = replace(scene.settings, normals=rule)
        found = picture(replace(scene, settings=chosen), "egg")
        assert "A itself" not in found.verdict
        assert f"“{rule}”" in found.verdict


def test_on_a_dark_slide_a_disc_seen_edge_on_is_parted_from_a_light_surface() -> None:
    """Its edge is in ink, as light there as the surface: dark paper goes around it."""
    found = proof("normals", theme=Theme.DARK)
    assert isinstance(found.picture, Slide)
    marks, palette = found.picture.canvas.marks, found.picture.palette
    edge_on = [
        i
        for i, one in enumerate(marks)
        if isinstance(one, Polygon) and one.fill == "#FFFFFF" and one.edge == palette.ink
    ]
    assert edge_on
    for i in edge_on:
        around, disc = marks[i - 1], marks[i]
        assert isinstance(around, Stroke)
        assert isinstance(disc, Polygon)
        assert (around.colour, around.points[:-1]) == (palette.dim, disc.loops[0])
        assert around.width > disc.width


def test_normals_that_a_map_took_away_are_not_said_to_bend() -> None:
    assert "No normal survives" in proof("interpolation", world=World(scale=(0, 1, 0))).verdict
    assert "bend by up to" in proof("interpolation", world=FLAT).verdict
