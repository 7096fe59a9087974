"""Depths and distances of `projection`, options of any number of values, and what is said."""

from __future__ import annotations

import re

import pytest

from nmatrix.enums import DepthRange


def test_distances_and_stored_depths_are_told_both_ways(nmatrix) -> None:
    found = nmatrix(
        "projection --at 1 10,100 --near 1 --far 100 --depth-value 0 -f json --depth zero-to-one"
    )
    assert found.data["depths"] == [
        {"distance": 1.0, "depth": 0.0},
        {"distance": 10.0, "depth": 10 / 11},
        {"distance": 100.0, "depth": 1.0},
        {"distance": 1.0, "depth": 0.0},
    ]
    assert nmatrix("projection -f json").data["depths"] is None


@pytest.mark.parametrize("lens", ["--far inf", "", "--ortho -1 1 -1 1"])
@pytest.mark.parametrize("depth", list(DepthRange))
def test_the_line_of_a_shader_turns_a_stored_depth_into_its_distance(
    nmatrix, lens: str, depth: DepthRange
) -> None:
    line = f"projection --near 0.5 {lens} --depth {depth}"
    value, known = 0.375, nmatrix(f"{line} --depth-value 0.375 -f json").data["depths"][0]
    shader = nmatrix(f"{line} -f glsl").out.splitlines()[-1]
    expression = re.fullmatch(r"float distance_of\(float depth\) \{ return (.*); \}", shader)
    assert expression is not None
    assert eval(expression[1], {"depth": value}) == pytest.approx(known["distance"], rel=1e-12)


def test_depth_at_infinity_has_no_distance_and_what_is_clipped_is_said(nmatrix) -> None:
    found = nmatrix("projection --far inf --depth-value 1 --at 0.05 -f json").data
    assert [one["distance"] for one in found["depths"]] == [0.05, None]
    assert any("reached at no distance" in one for one in found["remarks"])
    assert any("clipped, never stored" in one for one in found["remarks"])


@pytest.mark.parametrize(
    ("line", "code", "words"),
    [
        ("projection --at", 2, "--at takes a value, got none at the end"),
        ("projection --at --fov 60", 2, "--at takes a value, got none before --fov"),
        ("projection --at 1 x", 2, "--at ('x'): it is not a number"),
        ("projection --at 0", 3, "depth begins in front of the eye"),
        ("projection --at -1", 3, "depth begins in front of the eye"),
        ("projection --depth-value 1.5", 2, "--depth-value (1.5): a buffer stores depths"),
        ("projection --at 1 --at 2", 2, "--at: it is given twice"),
    ],
)
def test_what_has_no_depth_is_refused(nmatrix, line: str, code: int, words: str) -> None:
    found = nmatrix(line)
    assert found.code == code
    assert words in found.err


def test_the_far_end_is_told_as_it_is_and_a_float32_near_zero_by_a_sentence(nmatrix) -> None:
    found = nmatrix("projection --near 0.001 --far 100000 -f json").data
    assert 85_000 < found["depth_step"][-1]["unorm24"] < 86_000
    assert any("closer than 8.56e+04 fight" in one for one in found["remarks"])
    forward = nmatrix("projection --near 0.5 --far 10 --api vulkan -f json").data
    assert forward["depth_step"][0]["float32"] is None
    assert any("finer than float32 vertices" in one for one in forward["remarks"])


@pytest.mark.parametrize(
    "line",
    [
        "view --eye 1.7e308 1.7e308 1 --up 1 1 0",
        "view --eye 1.7e308 1.7e308 1.7e308 --elevation 45 --angle 45",
        "projection --fov 1e-320",
        "projection --near 1e308 --far inf",
        "projection --ortho 0 1e-320 0 1 --near 0 --far 1",
        "trace --fov 1e-320 --point 1 1 1",
        "trace --point 1.7e308 1 1 --scale 10 1 1",
        "light camera --light-position 1.7e308 0 0 --eye 1.7e308 1.7e308 1.7e308 --up 1 1 0",
        "space camera --eye 1.7e308 1.7e308 1.7e308 --up 1 1 0",
        "normal --scale 1e300 1 1 --shear 1e300 0 0 --normal 1 1 1",
        "world --scale 1e300 1 1 --shear 1e300 0 0",
    ],
)
def test_what_is_beyond_float64_is_null_with_a_remark_in_every_command(nmatrix, line: str) -> None:
    found = nmatrix(f"{line} -f json")
    assert found.code == 0, found.err
    assert "null" in found.out
    assert any("outside the range of float64" in one for one in found.data["remarks"])
    assert re.search(r"\de\+3[01]\d|\de\+[3-6]\d\d", nmatrix(line).out)


def test_an_eye_beyond_float64_has_no_answer_by_a_float64_program(nmatrix) -> None:
    found = nmatrix("eye object --scale 1e300 1 1 --shear 1e300 0 0 -f json")
    assert (found.code, found.data["eye_by_inverse_mv"]) == (0, None)
