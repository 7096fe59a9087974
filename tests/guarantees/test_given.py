"""G24: what is said about a matrix that was given is true of its entries."""

from __future__ import annotations

import json
from itertools import product
from math import inf

import numpy as np
import pytest

from nmatrix.enums import API_PRESETS, Api, ClipY, DepthRange, Handedness
from nmatrix.errors import IllegalValueError
from nmatrix.linear.projection import ClipSpace, Window
from nmatrix.linear.rational import to_floats
from nmatrix.reading.arrays import read_projection
from nmatrix.scene.camera import FirstPerson, View
from nmatrix.scene.lens import Lens

SHAPES = {
    "perspective": {"fov_degrees": 60, "aspect": 16 / 9},
    "frustum": {"frustum": Window(-0.03, 0.05, -0.02, 0.04)},
    "ortho": {"ortho": Window(-4, 3, -2, 1)},
}
PLANES = {"finite": (0.1, 100), "infinite": (0.1, inf)}
FORMS = {"float64": 17, "six digits": 6, "four digits": 4}


def _lens(shape: str, planes: str, clip: ClipSpace) -> Lens:
    near, far = PLANES[planes]
    return Lens(near=near, far=far, clip=clip, **SHAPES[shape])


CASES = [
    (shape, planes, ClipSpace(depth, handed, clip_y))
    for shape, planes in product(SHAPES, PLANES)
    for depth, handed, clip_y in product(DepthRange, Handedness, ClipY)
    if (shape, planes) != ("ortho", "infinite")
]


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize(("shape", "planes", "clip"), CASES, ids=str)
def test_the_sentences_about_a_given_projection_are_true_of_it(
    shape: str, planes: str, clip: ClipSpace, form: str, nmatrix
) -> None:
    lens = _lens(shape, planes, clip)
    P = to_floats(lens.clip_from_camera)
    text = "; ".join(" ".join(f"{x:.{FORMS[form]}g}" for x in row) for row in P)
    data = nmatrix(f"projection --projection-matrix '{text}' -f json").data
    said = nmatrix(f"projection --projection-matrix '{text}'").out.replace("\n", " ")
    # A perspective matrix says its hand by w; a parallel one only together with its depth range.
    if shape != "ortho":
        assert data["handed"] == clip.handed
        assert f"looks down {'−z' if clip.handed == 'right' else '+z'}" in said
        assert f"looks down {'+z' if clip.handed == 'right' else '−z'}" not in said
    assert data["clip_y"] == clip.clip_y
    assert f"y {clip.clip_y} in clip space" in said
    depths = {reading["depth_range"] for reading in data["readings"] if reading["depth_range"]}
    assert clip.depth in depths
    assert data["depth_range"] == (clip.depth if depths == {clip.depth} else None)
    near, far = PLANES[planes]
    (true, *_) = [
        one
        for one in data["readings"]
        if (one["depth_range"], one["handed"]) == (clip.depth, clip.handed)
    ]
    assert true["near"][0] <= near <= true["near"][1]
    assert true["far"][0] <= far <= (true["far"][1] or inf)
    for key, value in (("near", near), ("far", far)):
        if data[key] is not None and form == "float64":
            assert data[key] == pytest.approx(value)


@pytest.mark.parametrize(("shape", "planes", "clip"), CASES[::3], ids=str)
def test_what_is_said_beside_a_matrix_may_not_contradict_it(
    shape: str, planes: str, clip: ClipSpace
) -> None:
    P = _lens(shape, planes, clip).clip_from_camera
    assert Lens(matrix=P, clip=clip).clip == clip
    other_y = ClipY.UP if clip.clip_y is ClipY.DOWN else ClipY.DOWN
    with pytest.raises(
        IllegalValueError, match=f"clip_y {other_y}.*entries say clip_y {clip.clip_y}"
    ):
        Lens(matrix=P, clip=ClipSpace(clip.depth, clip.handed, other_y))


@pytest.mark.parametrize("api", Api)
def test_a_vertex_through_a_given_projection_lands_where_the_options_put_it(
    api: Api, nmatrix
) -> None:
    by_options = nmatrix(f"trace --point 0.3 0.2 0.1 --api {api} --near 1 -f json").data
    P = json.dumps(nmatrix(f"projection --api {api} --near 1 -f json").data["clip_from_camera"])
    given = nmatrix(f"trace --point 0.3 0.2 0.1 --projection-matrix '{P}' -f json").data
    assert given["inside"] is True
    assert given["pixel"] == pytest.approx(by_options["pixel"])
    assert given["ndc"] == pytest.approx(by_options["ndc"])


@pytest.mark.parametrize("api", Api)
@pytest.mark.parametrize("shape", SHAPES)
def test_a_transposed_projection_is_told_wherever_it_is_read(
    api: Api, shape: str, nmatrix, tmp_path
) -> None:
    lens = _lens(shape, "finite", ClipSpace(*API_PRESETS[api]))
    P = np.array(to_floats(lens.clip_from_camera))
    text = json.dumps(P.T.tolist())
    (tmp_path / "P.json").write_text(text)
    for given in (f"'{text}'", tmp_path / "P.json"):
        for command in ("projection", "trace --point 0 0 0", "calc P"):
            found = nmatrix(f"{command} --projection-matrix {given}")
            assert (found.code, "--input-layout column-major" in found.err) == (2, True)
        turned = nmatrix(f"projection --projection-matrix {given} --input-layout column-major")
        assert turned.code == 0
    with pytest.raises(IllegalValueError, match="column-major"):
        read_projection(P.T, "projection_matrix")
    reading = nmatrix(f"identify '{text}' -f json").data["readings"][0]
    assert reading["layout"] == "column-major"


def test_what_may_be_a_projection_is_never_called_none(nmatrix) -> None:
    """A plain scale is likelier a place, and may be a parallel view all the same."""
    line = 'projection --projection-matrix "0.5 0 0 0; 0 1 0 0; 0 0 0.1 0; 0 0 0 1"'
    assert "no projection" not in nmatrix(line).out
    assert nmatrix(f"{line} -f json").data["readings"][0]["kind"] == "orthographic"


@pytest.mark.parametrize("mirror", [False, True])
@pytest.mark.parametrize("scale", [1, 2])
def test_the_sentences_about_a_given_view_are_true_of_it(mirror: bool, scale: int, nmatrix) -> None:
    V = np.array(
        to_floats(View(eye=(1, 2, 3), angles=FirstPerson(20, 30, 40)).placed().camera_from_world)
    )
    V[:3] *= scale
    V[2] *= -1 if mirror else 1
    found = nmatrix(f"view --view-matrix '{json.dumps(V.tolist())}' -f json").data
    said = nmatrix(f"view --view-matrix '{json.dumps(V.tolist())}'").out.replace("\n", " ")
    assert found["mirrored"] is mirror
    assert ("a mirror" in said or "mirrored" in said) is mirror
    assert ("is a rotation" in said) is (scale == 1 and not mirror)
    assert np.allclose(found["eye"], (1, 2, 3))
    assert np.allclose(np.array(found["world_from_camera"]) @ V, np.eye(4), atol=1e-12)
    assert found["handed"] is None
    for axis, row in (("right", 0), ("up", 1)):
        seen = V[:3, :3] @ np.array(found[axis])
        assert np.allclose(seen / np.linalg.norm(seen), np.eye(3)[row], atol=1e-12)
