"""Words as hands type them: one scale, units, brackets, letters of axes, bare numbers."""

from __future__ import annotations

import json
import shlex

import pytest

from nmatrix.cli.catalogue import COMMANDS


def answer(nmatrix, line: str) -> dict:
    code, out, err = nmatrix(f"{line} -f json")
    assert (code, err) == (0, ""), err
    return json.loads(out)


ALIKE = [
    ("world --scale 2", "world --scale 2 2 2"),
    ("world --scale=2", "world --scale 2 2 2"),
    ("world --scale 1/3 --translate 1 2 3", "world --scale 1/3 1/3 1/3 --translate 1 2 3"),
    ('world --scale "(1, 2, 1)"', "world --scale 1 2 1"),
    ('world --rotate "[0, 90deg, 0]"', "world --rotate 0 90 0"),
    ("world --rotate -pi/2rad 0 -3pi/4rad", "world --rotate -90 0 -135"),
    ("world --rotate 0 0.25turn 0", "world --rotate 0 90 0"),
    ("view --eye 1 2 3 --elevation -pi/6rad --angle 45deg --roll 0.5turn",
     "view --eye 1 2 3 --elevation -30 --angle 45 --roll 180"),
    ("projection --fov pi/3rad --aspect 16:9", "projection --fov 60 --aspect 16/9"),
    ("light --light-angles -pi/3rad -120deg", "light --light-angles -60 -120"),
    ("normal 1 0 0 0 2 0 0 0 -1", 'normal "1 0 0; 0 2 0; 0 0 -1"'),
    ("normal 1 0 0 5 0 2 0 6 0 0 3 7 0 0 0 1", 'normal "1 0 0 5; 0 2 0 6; 0 0 3 7; 0 0 0 1"'),
    ("identify 1 0 0 0 2 0 0 0 1", 'identify "1 0 0; 0 2 0; 0 0 1"'),
    ("check normal 1 0 0 0 .5 0 0 0 1 --scale 1 2 1",
     'check normal "1 0 0; 0 .5 0; 0 0 1" --scale 1 2 1'),
    ("light object --scale 2", "light object --scale 2 2 2"),
    ("light --scale 2 object", "light object --scale 2 2 2"),
]  # fmt: skip


@pytest.mark.parametrize(("line", "same"), ALIKE)
def test_two_ways_to_type_one_thing_have_one_answer(nmatrix, line: str, same: str) -> None:
    assert answer(nmatrix, line) == answer(nmatrix, same)


def test_one_scale_leaves_the_expression_behind_it_alone(nmatrix) -> None:
    assert answer(nmatrix, 'calc --scale 3 "det(M)"')["value"] == 27


REFUSED = [
    ("world --scale 1 2", "--scale takes 1 or 3 numbers, got 2 at the end"),
    ("world --rotate y 45", "write --rotate 0 45 0"),
    ("world --rotate y 45 --scale 2", "write --rotate 0 45 0"),
    ("view --up z", "write --up 0 0 1"),
    ("world --translate 1,5 2,5 3", "write --translate 1.5 2.5 3"),
    ("world --translate -1,5 2 3 --json", "write --translate -1.5 2 3"),
    ("trace --point 0 0 1 --normal 1,5 0 0,25", "write --normal 1.5 0 0.25"),
    ("world --quaternion 0 1 0 1 --order ZYX", "--world-matrix MATRIX with an order tells"),
    ("world --rotate 0 pi/2 0", "write pi/2rad"),
    ("projection --aspect 16:0", "its height is 0"),
    ("projection --aspect a:b", "it is not a number"),
    ("trace 0 0 6", "write nmatrix trace --point 0 0 6"),
    ("trace 0 0 6 0 1 0", "write nmatrix trace --point 0 0 6 --normal 0 1 0"),
    ("projection 60 1.77 .1 100",
     "write nmatrix projection --fov 60 --aspect 1.77 --near .1 --far 100"),
    ("view 3 3 3 0 0 0", "write nmatrix view --eye 3 3 3 --target 0 0 0"),
    ("view 3 3", "put what belongs together in quotes"),
    ("eye 1 2 3", "write nmatrix eye --eye 1 2 3"),
    ("light -1 -1 -1", "write nmatrix light --light-direction -1 -1 -1"),
    ("normal 1 0 0 0 2 0 0 0", "normal takes MATRIX"),
]  # fmt: skip


@pytest.mark.parametrize(("line", "words"), REFUSED)
def test_a_refusal_shows_what_to_type(nmatrix, line: str, words: str) -> None:
    code, out, err = nmatrix(line)
    assert (code, out) == (2, "")
    assert words in err
    assert err.count("\n") == 1
    shown = err.rstrip("\n").partition("write nmatrix ")[2]
    if shown:
        assert answer(nmatrix, shown)["command"] == shlex.split(shown)[0]


@pytest.mark.parametrize("name", [one for one in COMMANDS if one in ("world", "view", "projection",
                                  "normal", "light", "eye", "space", "trace", "calc")])  # fmt: skip
def test_radians_are_remarked_in_text_and_json(nmatrix, name: str) -> None:
    option = {"view": "--elevation 1.5707", "projection": "--fov 1.0472"}.get(
        name, "--rotate 0 1.5708 0"
    )
    line = f"{name} {option}" + (' "M"' if name == "calc" else "")
    assert any("looks like radians" in one for one in answer(nmatrix, line)["remarks"])
    assert "looks like radians" in " ".join(nmatrix(line)[1].split())


def test_the_calculator_remarks_radians_too(nmatrix) -> None:
    told = "rotate_y takes degrees, but -0.7854 looks like -pi/4 radians, -45 degrees."
    assert told in answer(nmatrix, 'calc "rotate_y(-0.7854)"')["remarks"]
    assert answer(nmatrix, 'calc "rotate_y(0.5) @ rotate_x(3)"')["remarks"] == [
        "A number in it is not exact: 38 digits are known."
    ]


def test_a_paste_is_named_in_the_remarks_and_read_by_its_own_layout(nmatrix) -> None:
    pasted = '{"elements":[0,1,0,0,-2,0,0,0,0,0,1,0,0,0,0,1]}'
    found = answer(nmatrix, f"normal '{pasted}' --normal 1 1 0")
    assert found["normal_matrix"] == [[0, -0.5, 0], [1, 0, 0], [0, 0, 1]]
    assert any("Read as three.js, column by column" in one for one in found["remarks"])
    other = answer(nmatrix, f"normal '{pasted}' --normal 1 1 0 --input-layout row-major")
    assert other["normal_matrix"] == [[0, 1, 0], [-0.5, 0, 0], [0, 0, 1]]
    assert not any("Read as" in one for one in other["remarks"])
