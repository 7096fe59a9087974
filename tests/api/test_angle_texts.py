"""An angle is the same text in a shell, in a scene file and in Python."""

from __future__ import annotations

import json
from math import radians
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
import pytest

import nmatrix as package
from nmatrix.errors import IllegalValueError
from nmatrix.scene.toml import records
from nmatrix.scene.toml.schema import schema
from nmatrix.scene.toml.table import SceneTable

# What is typed, and the degrees that it is, by hand.
TEXTS = {"30deg": 30, "pi/6rad": 30, "0.125turn": 45, "-3pi/4rad": -135, "1/3turn": 120, "90°": 90}
KINDS = [
    one
    for one in vars(records).values()
    if isinstance(one, type)
    and issubclass(one, records.Record)
    and one not in (records.Record, records.SceneRecord)
]
ANGLES = [
    (kind, field)
    for kind in KINDS
    for field in msgspec.structs.fields(kind)
    if '"format":"angle"' in msgspec.json.encode(msgspec.json.schema(field.type)).decode()
]


def asked(world: dict[str, Any]) -> list[list[float]]:
    return package.Setup(world=world).world().data["world_from_object"]


@pytest.mark.parametrize("text", TEXTS)
def test_a_setup_takes_the_texts_of_the_command_line(nmatrix, text: str) -> None:
    shell = nmatrix(f"world --rotate {text} 0 20 -f json").data["world_from_object"]
    assert asked({"rotate": [text, 0, "20"]}) == shell == asked({"rotate": (TEXTS[text], 0, 20)})
    assert asked({"axis_angle": [1, 2, 2, text]}) == asked({"axis_angle": [1, 2, 2, TEXTS[text]]})


# Every name of a setup that is an angle, in degrees and as texts.
NAMES = {
    "view": ({"elevation": 30, "angle": -45, "roll": 90},
             {"elevation": "pi/6rad", "angle": "-0.125turn", "roll": "90deg"}),
    "lens": ({"fov": 60}, {"fov": "pi/3rad"}),
    "across": ({"fov_x": 90}, {"fov_x": "0.25turn"}),
    "sides": ({"angles": (-45, 30, -36, 20)}, {"angles": ("-pi/4rad", "30deg", "-0.1turn", 20)}),
    "light": ({"light_angles": (30, -135)}, {"light_angles": ("30deg", "-3pi/4rad")}),
}  # fmt: skip


@pytest.mark.parametrize("name", NAMES)
def test_every_angle_of_a_setup_may_be_a_text(name: str) -> None:
    part = {"across": "lens", "sides": "lens"}.get(name, name)
    numbers, texts = (package.Setup(**{part: given}) for given in NAMES[name])
    assert numbers == texts


@pytest.mark.parametrize("text", TEXTS)
def test_builders_take_a_text_that_says_its_unit(text: str) -> None:
    exact = package.Angle.degrees(TEXTS[text])
    assert (package.rotation([text, 0.0, exact]) == package.rotation([exact, 0.0, exact])).all()
    assert (package.axis_angle((0, 1, 0), text) == package.axis_angle((0, 1, 0), exact)).all()
    several = package.rotation(np.array([[text, "0deg", "0deg"], ["0rad", text, "0rad"]]))
    assert several.shape == (2, 4, 4)
    assert (several[1] == package.rotation([0.0, exact, 0.0])).all()
    assert package.rotation([0.0, 0.0, radians(TEXTS[text])]) == pytest.approx(
        package.rotation([0.0, 0.0, text]), abs=1e-15
    )


def test_radians_in_a_text_are_those_that_were_typed() -> None:
    found = package.perspective("1.25rad", 1, 0.1)
    assert found[1, 1] == pytest.approx(1 / np.tan(0.625), rel=4e-16)
    assert package.perspective("pi/2rad", 1, 0.1)[1, 1] == 1.0


REFUSED = {
    "rotation": (lambda: package.rotation(["30", 0, 0]), "its unit; write 30deg or 30rad"),
    "first": (lambda: package.first_person((0, 0, 5), "x", 0.0), "it is not a number"),
    "pi": (lambda: package.axis_angle((0, 0, 1), "pi/6"), "write pi/6rad"),
    "setup": (lambda: package.Setup(world={"rotate": (0, "pi/6", 0)}), "rotate[1] ('pi/6')"),
    "fov": (lambda: package.Setup(lens={"fov": "wide"}), "fov ('wide')"),
    "sides": (lambda: package.Setup(lens={"angles": (-40, 40, "x", 40)}), "angles[2] ('x')"),
    "whole": (lambda: package.Setup(lens={"fov": "1turn"}).projection(), "fov"),
}  # fmt: skip


@pytest.mark.parametrize("case", REFUSED)
def test_another_text_is_refused_with_what_to_write(case: str) -> None:
    call, words = REFUSED[case]
    with pytest.raises(IllegalValueError) as found:
        call()
    assert words in str(found.value)


def test_every_key_of_a_scene_that_is_in_degrees_is_an_angle() -> None:
    in_degrees = {
        (kind, field.name)
        for kind in KINDS
        for field in msgspec.structs.fields(kind)
        if "degrees" in field.type.__metadata__[-1].description
    }
    angles = {(kind, field.name) for kind, field in ANGLES}
    assert in_degrees <= angles
    assert len(angles) >= 11


@pytest.mark.parametrize(("kind", "field"), ANGLES)
def test_a_scene_takes_the_texts_for_every_angle(kind: type, field: Any) -> None:
    count = next((n for n in (4, 3, 2) if _takes(kind, field.name, [1.0] * n)), 0)
    last = ["20deg"] if field.name == "axis_angle" else ["pi/9rad"] * max(count, 1)
    texts: Any = [1.0] * (count - len(last)) + last
    degrees = [1.0] * (count - len(last)) + [20.0] * len(last)
    read = SceneTable(Path("a.toml"), raw={field.name: texts if count else last[0]}).checked(kind)
    assert getattr(read, field.name) == (tuple(degrees) if count else 20.0)
    wrong: Any = [*texts[:-1], "pi/9"] if count else "pi/9"
    with pytest.raises(IllegalValueError, match=r"a\.toml.*write pi/9rad"):
        SceneTable(Path("a.toml"), raw={field.name: wrong}).checked(kind)


def _takes(kind: type, key: str, value: Any) -> bool:
    try:
        SceneTable(Path("a.toml"), raw={key: value}).checked(kind)  # type: ignore[type-var]
    except IllegalValueError:
        return False
    return True


def test_editors_are_told_that_an_angle_may_be_a_text() -> None:
    rotate = json.loads(schema())["$defs"]["ObjectRecord"]["properties"]["rotate"]
    assert [one["type"] for one in rotate["prefixItems"]] == [["number", "string"]] * 3
    axis = json.loads(schema())["$defs"]["ObjectRecord"]["properties"]["axis_angle"]
    assert [one["type"] for one in axis["prefixItems"]] == ["number"] * 3 + [["number", "string"]]


def test_a_scene_and_the_shell_agree(nmatrix, tmp_path) -> None:
    scene = tmp_path / "s.toml"
    scene.write_text(
        '[[object]]\nshape = "sphere"\nrotate = ["pi/6rad", "-0.125turn", 20]\n'
        '[camera]\nfov = "pi/3rad"\nelevation = "10deg"\nangle = "-pi/9rad"\n',
        encoding="utf-8",
    )
    given = f"--scene '{scene}' -f json"
    world = nmatrix(f"world {given}").data["world_from_object"]
    assert world == nmatrix("world --rotate 30 -45 20 -f json").data["world_from_object"]
    view = nmatrix(f"view {given}").data["camera_from_world"]
    assert view == nmatrix("view --elevation 10 --angle -20 -f json").data["camera_from_world"]
    assert nmatrix(f"projection {given}").data["fov_y_deg"] == 60


def test_what_is_not_an_angle_takes_no_text() -> None:
    for key, value in {"axis_angle": ["1deg", 0, 0, 90], "translate": ["1deg", 0, 0]}.items():
        with pytest.raises(IllegalValueError, match="expected float, got str"):
            SceneTable(Path("a.toml"), raw={key: value}).checked(records.ObjectRecord)
