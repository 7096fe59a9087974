"""Every proof image by its claim: an angle, a difference, a count."""

from __future__ import annotations

import io
from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest
from PIL import Image

from nmatrix.canvas.marks import Raster
from nmatrix.canvas.slide import Slide
from nmatrix.canvas.theme import HEAT_STOPS
from nmatrix.enums import NormalRule, PixelFormat
from nmatrix.errors import NoAnswerError
from nmatrix.linear.classify import classify
from nmatrix.raster.drawn_scene import drawn_scene
from nmatrix.raster.image import levels
from nmatrix.raster.loaded_scene import loaded
from nmatrix.raster.proofs import angles
from nmatrix.raster.proofs.angles import Scale
from nmatrix.raster.proofs.catalogue import PROOFS, catalogued
from nmatrix.raster.proofs.frames import PictureFrame, turns
from nmatrix.raster.proofs.proof import Proof, ProofSettings
from nmatrix.raster.shading.normals import normals_by
from nmatrix.scene.meshes.mesh import Mesh
from nmatrix.scene.meshes.shapes import sphere, torus
from nmatrix.scene.scene import Settings
from nmatrix.scene.world import World

SMALL = Settings(size=(96, 96), samples=4)


def proof(name: str, **settings: object) -> Proof:
    chosen = ProofSettings(name, **{"picture": SMALL, **settings})  # type: ignore[arg-type]
    return PictureFrame(name, chosen).draw()


def rasters(found: Proof) -> list[np.ndarray]:
    """Return what the rasterizer drew, without the marks over it."""
    assert isinstance(found.picture, Slide)
    return [one.pixels for one in found.picture.canvas.marks if isinstance(one, Raster)]


@pytest.mark.parametrize("name", [one.name for one in PROOFS])
def test_every_proof_draws_a_picture_with_its_numbers(name: str) -> None:
    found = proof(name)
    assert found.image.dtype == np.uint8
    assert np.ptp(found.image) > 100
    assert found.verdict.endswith(".")
    assert found.work.multiplications > 0
    image = Image.open(io.BytesIO(found.file(PixelFormat.PNG)))
    assert image.text["Description"] == found.verdict
    assert not any("milliseconds" in key for key in image.text)


@pytest.mark.parametrize("name", [one.name for one in PROOFS])
def test_the_same_proof_is_the_same_bytes(name: str) -> None:
    assert proof(name).file(PixelFormat.PNG) == proof(name).file(PixelFormat.PNG)


@pytest.mark.parametrize("scale", [(1, 2, 1), (1, 0.25, 1), (3, 1, 1)])
def test_normals_come_close_to_the_bound_and_never_pass_it(scale: tuple) -> None:
    world = World(scale=scale)
    found = proof("normals", world=world).max_angle_error_deg
    bound = classify(world.world_from_object).worst_angle_deg
    assert bound * 0.98 < found <= bound * (1 + 1e-3)


def test_bias_is_invisible_under_a_rotation_and_plain_under_a_scale() -> None:
    found = proof("bias")
    assert found.numbers["rotation_level_difference"] == 0
    assert found.numbers["scale_level_difference"] > 50


def test_mirror_without_the_sign_is_upside_down() -> None:
    found = proof("mirror")
    assert found.max_angle_error_deg == pytest.approx(180)
    assert found.numbers["winding_level_difference"] > 100


def test_a_mirror_by_the_right_rule_hides_nothing() -> None:
    found = proof("normals", world=World(scale=(-1, 1, 1)))
    assert found.max_angle_error_deg < 1e-9


def test_a_four_component_normalise_leaves_a_third_of_the_length() -> None:
    found = proof("translation")
    assert found.numbers["shortest_normal"] == pytest.approx(1 / np.hypot(1, 2.6), rel=1e-3)
    assert found.max_angle_error_deg > 90


def test_flattened_normals_come_from_the_cofactors() -> None:
    found = proof("flatten")
    assert found.numbers["rank"] == 2
    assert found.max_level_difference > 50


def test_the_claims_would_fail_with_the_wrong_rule(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        angles, "normals_by", lambda ready, body, rule: normals_by(ready, body, NormalRule.NONE)
    )
    assert proof("normals").max_angle_error_deg == 0
    assert proof("mirror").max_angle_error_deg == 0


def test_the_order_of_triangles_does_not_matter() -> None:
    mesh = torus(16, 32)
    shuffled = np.random.default_rng(1).permutation(len(mesh.triangles))
    other = Mesh(mesh.positions, mesh.normals, mesh.triangles[shuffled])
    world = World(scale=(1, 2, 1), rotate_degrees=(40, 10, 0))
    first, second = (rasters(proof("normals", mesh=one, world=world)) for one in (mesh, other))
    assert len(first) == len(second) > 1
    for a, b in zip(first, second, strict=True):
        assert (a == b).all()


def test_a_flattened_sphere_is_one_plane_that_faces_the_eye() -> None:
    settings = ProofSettings("flat", sphere(16, 32), picture=SMALL)
    scene = settings.scene(settings.object(World(scale=(1, 0, 1))))
    ready = loaded(scene)
    normals = normals_by(ready, ready.bodies[0], NormalRule.EXACT)
    assert len(np.unique(normals + 0.0, axis=1).T) == 1
    found = proof("normals", mesh=sphere(16, 32), world=World(scale=(1, 0, 1)))
    assert found.max_angle_error_deg == pytest.approx(90)


def test_both_sides_of_a_flattened_sphere_look_alike() -> None:
    settings = ProofSettings("flat", sphere(16, 32), picture=replace(SMALL, size=(240, 240)))
    flat = settings.object(World(scale=(1, 0, 1), rotate_degrees=(30, 0, 0)))
    image = drawn_scene(settings.scene(flat)).levels
    rows, columns = np.nonzero((image != image[0, 0]).any(axis=2))
    middle = int(np.median(columns))
    line = image[int(np.median(rows)), middle - 10 : middle + 10]
    assert np.ptp(line[:, 0].astype(int)) <= 8, "a checkerboard of both sides"


@pytest.mark.parametrize("scale", [(1, 0, 0), (0, 0, 0)])
def test_a_line_or_a_point_has_no_normal_to_compare(scale: tuple) -> None:
    assert proof("normals", world=World(scale=scale)).max_angle_error_deg is None


def test_a_difference_that_is_rounding_alone_is_drawn_in_one_colour() -> None:
    worst = proof("normals", world=World(rotate_degrees=(20, 30, 40))).max_angle_error_deg
    angles = np.array([0.0, worst])
    none, some = levels(Scale.reaching(worst).colours(angles, HEAT_STOPS))
    assert (none == some).all()
    none, some = Scale(worst).colours(
        angles, HEAT_STOPS
    )  # what stretching to the full range would do
    assert (none != some).any()


@pytest.mark.parametrize(
    "scale", [(1e200, 1e-200, 1), (1e-170, 1, 1), (1e-90, 1e-90, 1e-90), (1e90, 1e-250, 1)]
)
def test_extreme_scales_are_drawn_or_refused_in_one_line(scale: tuple) -> None:
    try:
        found = proof("normals", world=World(scale=scale))
    except NoAnswerError as error:
        assert max(scale) > 1e100
        assert "1e+100" in str(error)
    else:
        assert found.image.dtype == np.uint8


# What each proof still shows in every frame.
CLAIMS = {
    "normals": lambda found: 36 < found.max_angle_error_deg < 36.9,
    "bias": lambda found: (
        found.numbers["rotation_level_difference"] == 0
        and found.numbers["scale_level_difference"] > 50
    ),
    "spaces": lambda found: max(found.numbers["differences"].values()) <= 1e-12,
    "object-rule": lambda found: (
        found.numbers["terminator_inverted_pixels"] <= 4
        and min(found.numbers["levels_transposed"], found.numbers["levels_inverted"]) > 50
    ),
    "mirror": lambda found: found.max_angle_error_deg > 179.9,
    "stuck-light": lambda found: (
        found.numbers["vertex_change_model_space"] < 1e-12
        and found.numbers["vertex_change_eye_space"] > 0.5
        and found.max_level_difference > 90
    ),
    "flashlight": lambda found: found.numbers["middle_change_eye"] <= 1,
    "shading": lambda found: found.numbers["phong_against_blinn_phong"] > 10,
    "interpolation": lambda found: found.numbers["affine_wrong_part"] > 0.05,
    "translation": lambda found: found.max_angle_error_deg > 60,
    "flatten": lambda found: found.max_level_difference > 30,
    "depth": lambda found: (
        found.numbers["wrong_float32_reversed"] == 0 < found.numbers["wrong_float32_standard"]
    ),
    "accuracy": lambda found: found.numbers["worst_deg_float32"] > 0.1,
    "effects": lambda found: found.numbers["difference"] <= 1e-12,
}


@pytest.mark.parametrize("name", [one.name for one in PROOFS])
def test_each_frame_of_a_proof_shows_again_what_it_is_about(name: str) -> None:
    frame = PictureFrame(name, ProofSettings(name, picture=SMALL))
    found = [frame.turned(angle).draw() for angle in (*turns(4), 360.0)]
    assert all(map(CLAIMS[name], found))
    assert (found[0].image == found[-1].image).all()
    for one, other in combinations(found[:-1], 2):
        assert (one.image != other.image).any(axis=2).mean() > 0.002
    for one in found:
        shades = (one.image > 60) & (one.image < 230)  # neither black, nor paper
        assert shades.any(axis=2).mean() > 0.03


def test_of_a_flattened_object_the_light_turns() -> None:
    frame = PictureFrame("flatten", ProofSettings("flatten", picture=SMALL))
    one, other = (frame.turned(angle).draw().image for angle in (0, 120))
    columns = (one != other).any(axis=(0, 2))
    panel = one.shape[1] // 3
    assert not columns[: 2 * panel].any(), "ambient light alone does not turn"
    assert columns[2 * panel :].any()


def test_every_proof_has_its_function() -> None:
    for one in PROOFS:
        assert callable(one.load())
    assert catalogued("nothing") is None
