"""Object space as a slide: its lights at their angle, the edge of the light, shares of shade."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from nmatrix.canvas.glyphs import Verdict
from nmatrix.canvas.marks import Text
from nmatrix.canvas.slide import Slide
from nmatrix.enums import NormalRule
from nmatrix.errors import NoAnswerError
from nmatrix.raster.loaded_scene import LoadedScene, loaded
from nmatrix.raster.overlay.mesh_lines import isoline
from nmatrix.raster.proofs.angles import normals_by
from nmatrix.raster.proofs.frames import PictureFrame
from nmatrix.raster.proofs.object_rule import CarriedLight, _scene
from nmatrix.raster.proofs.proof import Proof, ProofSettings
from nmatrix.scene.light import SceneLight
from nmatrix.scene.meshes.mesh import Mesh
from nmatrix.scene.scene import Settings
from nmatrix.scene.words import LightKind
from nmatrix.scene.world import World

SMALL = ProofSettings("egg", picture=Settings(size=(320, 180), samples=1))
TRIANGLE = Mesh(
    np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]),
    np.tile([0.0, 0, 1], (3, 1)),
    np.array([[0, 1, 2]]),
)
SKEW = World(scale=(1, 2, 0.7), shear=(0.5, 0, 0.2), rotate_degrees=(10, 20, 30))


def proof(**settings: object) -> Proof:
    return PictureFrame("object-rule", replace(SMALL, **settings)).draw()  # type: ignore[arg-type]


def carried(**settings: object) -> CarriedLight:
    return CarriedLight(loaded(_scene(replace(SMALL, **settings))))  # type: ignore[arg-type]


def slide(found: Proof) -> Slide:
    assert isinstance(found.picture, Slide)
    return found.picture


def verdicts(found: Proof) -> list[Verdict | None]:
    return [one.verdict for one in slide(found).panels]


def test_one_rule_moves_the_edge_of_the_light_and_the_other_keeps_it() -> None:
    found = proof().numbers
    # Normals of another length between vertices bend a little: a pixel here and there.
    assert found["terminator_inverted_pixels"] <= 4
    assert found["terminator_transposed_against_naive_pixels"] <= 4
    assert found["terminator_transposed_pixels"] > 150
    assert min(found["levels_transposed"], found["levels_inverted"]) > 50


def test_the_numbers_do_not_change_with_the_size_of_the_slide() -> None:
    numbers = [
        proof(picture=Settings(size=one, samples=1)).numbers for one in ((320, 180), (640, 360))
    ]
    assert numbers[0] == numbers[1]


def test_the_edge_of_the_light_is_where_true_normals_are_across_it() -> None:
    one = carried(world=SKEW)
    points, triangles = one.body.positions_world, one.body.mesh.triangles
    lines = isoline(points, triangles, one.cosines)
    assert lines
    normals = normals_by(one.scene, one.body, NormalRule.EXACT)
    crossed = (one.cosines[triangles] > 0).any(axis=1) & (one.cosines[triangles] < 0).any(axis=1)
    near = points[triangles[crossed]].reshape(-1, 3)
    for place in np.concatenate(lines)[::7]:
        nearest = ((near - place) ** 2).sum(axis=1).min()
        assert nearest < 0.02
    assert np.abs((normals.T @ one.to_light_world)[:, 0] - one.cosines).max() < 1e-12


def test_a_share_is_the_shade_of_the_wrong_rule_less_that_of_the_world() -> None:
    one = carried(world=SKEW)
    normals = one.body.mesh.normals
    M = np.array(one.body.world_from_object.exact, float)[:3, :3]
    true = normals @ np.linalg.inv(M)
    true /= np.linalg.norm(true, axis=1)[:, None]
    light = one.to_light_world[:, 0]
    wrong = np.linalg.inv(M) @ light
    wrong /= np.linalg.norm(wrong)
    expected = np.maximum(normals @ wrong, 0) - np.maximum(true @ light, 0)
    assert one.too_bright[1] == pytest.approx(expected, abs=1e-12)
    assert one.edge_moves


def test_the_angle_on_the_slide_is_that_of_the_two_lights() -> None:
    one = carried()
    a, b = (light[:, 0] for light in one.wrong)
    assert one.between_deg == pytest.approx(np.degrees(np.arccos(a @ b)))
    texts = [mark.text for mark in slide(proof()).canvas.marks if isinstance(mark, Text)]
    assert f"{one.between_deg:.0f}°" in texts


@pytest.mark.parametrize(
    "world",
    [World(), World(rotate_degrees=(20, 30, 40)), World(scale=3), World(scale=(-1, 1, 1))],
)
def test_a_map_that_bends_nothing_makes_no_rule_wrong(world: World) -> None:
    found = proof(world=world)
    assert Verdict.WRONG not in verdicts(found)
    assert len(slide(found).same) == 2
    assert "evenly" in slide(found).title


def test_a_light_along_an_axis_of_the_stretch_keeps_its_direction_and_not_its_shade() -> None:
    above = SceneLight("sun", LightKind.DIRECTIONAL, direction=(0, -1, 0))
    found = proof(lights=(above,))
    assert verdicts(found)[1:] == [Verdict.WRONG, Verdict.WRONG, Verdict.RIGHT]
    assert len(slide(found).same) == 1, "both wrong panels are one picture"
    assert "one direction" in found.verdict


def test_captions_speak_of_an_edge_only_where_one_is() -> None:
    found = proof(mesh=TRIANGLE)
    told = " ".join(one.caption for one in slide(found).panels)
    assert "dashed" not in told
    assert "wrong place" not in told
    assert "-" not in found.verdict


def test_a_lamp_lights_as_it_does_the_middle_of_the_body() -> None:
    lamp = SceneLight("bulb", LightKind.POINT, position=(3, 4, 0))
    one: LoadedScene = carried(lights=(lamp,)).scene
    assert one.lights[0].position is None
    assert CarriedLight(one).to_light_world[:, 0] == pytest.approx([0.6, 0.8, 0], abs=1e-12)


@pytest.mark.parametrize("scale", [(1, 0, 1), (1, 0, 0), (0, 0, 0)])
def test_a_flattened_body_has_no_object_space(scale: tuple) -> None:
    with pytest.raises(NoAnswerError, match="M⁻¹"):
        proof(world=World(scale=scale))
