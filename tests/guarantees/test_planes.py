"""A plane's own point is inside: near, far and the sides lie where they were put."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from math import inf, nextafter
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from nmatrix.answers.trace import trace
from nmatrix.api import setup as api_setup
from nmatrix.enums import Api, ClipY, DepthRange, Handedness
from nmatrix.linear.projection import NDC_DEPTH, ClipSpace, Window
from nmatrix.linear.viewport import Viewport
from nmatrix.output.jsontext import write
from nmatrix.output.write import OutputOptions
from nmatrix.scene.camera import View
from nmatrix.scene.lens import Lens
from nmatrix.scene.setup import Setup

RANGES = [
    (0.1, 100.0), (1.0, 10.0), (0.5, 50.0), (1.0, 1000.0), (2.0, 7.0),
    (0.3, 0.7), (1e-3, 1e5), (3.7, 3.8), (1 / 3, 1e7), (1e-30, 1e30),
]  # fmt: skip
BOXES = [(-0.1, 0.3, -0.7, 1.1), (-1 / 3, 2 / 3, -0.1, 0.1), (3.0, 7.0, -9.0, 1e-3)]


def traced(lens: Lens, point: Sequence[Any]) -> dict[str, Any]:
    """Trace a point of camera space, the camera looking along −z or +z of the world."""
    ahead = lens.clip.forward_z
    view = View((0, 0, 0), (0, 0, ahead), handed=lens.clip.handed)
    x = -1 if lens.clip.handed is Handedness.LEFT and ahead < 0 else 1
    report = trace(Setup(view=view, lens=lens), (x * point[0], *point[1:]), None, Viewport(64, 48))
    found: dict[str, Any] = json.loads(write(report, OutputOptions()))
    return found


@pytest.mark.parametrize("depth", list(DepthRange))
@pytest.mark.parametrize(("near", "far"), RANGES)
@pytest.mark.parametrize("place", ["near", "far"])
def test_a_point_on_the_near_or_far_plane_is_inside(
    depth: DepthRange, near: float, far: float, place: str
) -> None:
    for handed in Handedness:
        clip = ClipSpace(depth, handed)
        for box in (None, Window(-1, 1, -1, 1)):
            lens = Lens(near=near, far=far, ortho=box, clip=clip)
            distance, outwards = (near, 0.0) if place == "near" else (far, inf)
            found = traced(lens, (0, 0, clip.forward_z * distance))
            assert found["inside"], (handed, box)
            assert found["ndc"][2] == NDC_DEPTH[depth][place == "far"]
            assert found["window"][2] == float((place == "far") != (depth is DepthRange.REVERSED))
            beyond = nextafter(distance, outwards)
            assert traced(lens, (0, 0, clip.forward_z * beyond))["outside_planes"] == [place]


@pytest.mark.parametrize("box", BOXES)
@pytest.mark.parametrize("clip_y", list(ClipY))
@pytest.mark.parametrize(("near", "far"), RANGES[:6])
def test_a_point_on_a_side_is_inside(
    box: tuple[float, ...], clip_y: ClipY, near: float, far: float
) -> None:
    window, clip = Window(*box), ClipSpace(clip_y=clip_y)
    left, right, bottom, top = box
    middle = ((left + right) / 2, (bottom + top) / 2)
    for shape in ({"ortho": window}, {"frustum": window}):
        lens = Lens(near=near, far=far, clip=clip, **shape)
        for name, x, y, out in (
            ("left", left, middle[1], (-inf, None)),
            ("right", right, middle[1], (inf, None)),
            ("bottom", middle[0], bottom, (None, -inf)),
            ("top", middle[0], top, (None, inf)),
        ):
            found = traced(lens, (x, y, -near))
            assert found["inside"], (shape, name)
            axis = 0 if out[0] is not None else 1
            assert abs(found["ndc"][axis]) == 1
            moved = [x, y]
            moved[axis] = nextafter(moved[axis], out[axis])
            assert traced(lens, (*moved, -near))["outside_planes"] == [name]


@pytest.mark.parametrize("aspect", [1.0, 16 / 9, 4 / 3, 2.35])
@pytest.mark.parametrize("distance", [0.1, 0.7, 3.0, 99.9])
def test_a_point_on_a_side_of_a_right_angle_is_inside(aspect: float, distance: float) -> None:
    lens = Lens(fov_degrees=90, aspect=aspect)
    d = Fraction(distance)
    right = Fraction(aspect) * d
    for x, y in ((right, 0), (-right, 0), (0, d), (0, -d), (right, -d)):
        found = traced(lens, (x, y, -d))
        assert found["inside"], (x, y)
        assert max(map(abs, found["ndc"][:2])) == 1
    assert traced(lens, (right * (1 + Fraction(1, 2**80)), 0, -d))["outside_planes"] == ["right"]


@given(
    st.sampled_from(RANGES),
    st.sampled_from(list(DepthRange)),
    st.sampled_from(list(Api)),
    st.sampled_from(["near", "far"]),
    st.integers(-3, 3),
)
def test_numbers_and_verdict_agree_around_every_plane(
    planes: tuple[float, float], depth: DepthRange, api: Api, place: str, ulps: int
) -> None:
    lens = Lens(90, 16 / 9, *planes, clip=api)
    lens = replace(lens, clip=replace(lens.clip, depth=depth))
    distance = planes[place == "far"]
    for _ in range(abs(ulps)):
        distance = nextafter(distance, inf if ulps > 0 else 0.0)
    found = traced(lens, (0.3 * distance, -0.2 * distance, lens.clip.forward_z * distance))
    low = min(NDC_DEPTH[depth])
    agrees = low <= found["ndc"][2] <= 1 and 0 <= found["window"][2] <= 1
    assert not found["inside"] or agrees
    assert found["inside"] == (planes[0] <= distance <= planes[1])
    if not found["inside"] and agrees:
        assert "What reads 1 in NDC" in found["remarks"][0]


@pytest.mark.parametrize("api", list(Api))
def test_window_y_is_counted_as_the_interface_does_and_pixels_from_the_top(api: Api) -> None:
    lens = Lens(90, 64 / 48, clip=api)
    found = traced(lens, (0, 0.5, lens.clip.forward_z))
    assert found["pixel"] == [32, 12]  # half of the way up: a quarter from the top
    assert found["window"][:2] == ([32, 36] if api is Api.OPENGL else [32, 12])


@pytest.mark.parametrize("api", list(Api))
def test_python_and_scene_files_count_window_y_as_the_command_line_does(
    nmatrix, tmp_path: Path, api: Api
) -> None:
    place = "--point 0.5 0.25 1 --viewport 640 480"
    found = nmatrix(f"trace {place} --api {api} -f json").data
    in_python = api_setup.Setup(lens={"api": api, "aspect": 640 / 480})
    report = in_python.trace((0.5, 0.25, 1), viewport=(640, 480))
    assert (report.data["window"], report.data["pixel"]) == (found["window"], found["pixel"])
    file = tmp_path / "scene.toml"
    file.write_text(f'[[object]]\nname = "ball"\nshape = "sphere"\n[camera]\napi = "{api}"\n')
    in_scene = nmatrix(f"trace {place} --scene {file} -f json").data
    assert (in_scene["window"], in_scene["pixel"]) == (found["window"], found["pixel"])


@pytest.mark.parametrize(
    ("clip", "y"),
    [
        (ClipSpace(), 36),
        (ClipSpace(depth=DepthRange.ZERO_TO_ONE), 36),
        (ClipSpace(handed=Handedness.LEFT), 36),
        (ClipSpace(clip_y=ClipY.DOWN), 12),
    ],
)
def test_without_an_interface_y_in_clip_space_decides(clip: ClipSpace, y: int) -> None:
    found = traced(Lens(90, 64 / 48, clip=clip), (0, 0.5, clip.forward_z))
    assert (found["window"][1], found["pixel"]) == (y, [32, 12])
