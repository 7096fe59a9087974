"""Other libraries' values on the same inputs: ours agree, function by function, source by source.

Float64 sources agree within 2e-14 of the largest entry, float32 ones within 2e-7. Records whose
function ends in `_edge` show what others do where there is no answer: not to be agreed with.
"""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable
from fractions import Fraction
from math import inf
from pathlib import Path
from typing import Any

import pytest

from nmatrix.enums import ClipY, Convention, DepthRange, Frame, Handedness, Space
from nmatrix.linear import rational
from nmatrix.linear.affine import compose, rotation_from_quaternion
from nmatrix.linear.angle import Angle, direction_from_angles
from nmatrix.linear.decompose import parts
from nmatrix.linear.exact import LinearMap
from nmatrix.linear.projection import ClipSpace, Window, frustum, orthographic, perspective
from nmatrix.linear.rational import to_floats
from nmatrix.linear.view import look_at
from nmatrix.linear.viewport import Viewport
from nmatrix.scene.camera import FirstPerson, View
from nmatrix.scene.setup import Setup
from nmatrix.scene.world import World
from nmatrix.spaces.exact_maps import ExactMaps, WorldLight
from nmatrix.spaces.light_and_eye import eye_in, light_in
from nmatrix.spaces.pixel_ray import pixel_ray
from nmatrix.spaces.trace import trace
from nmatrix.spaces.transform import Transform

FLOAT64, FLOAT32 = 2e-14, 2e-7
DEPTHS = {
    "NO": DepthRange.MINUS_ONE_TO_ONE,
    "ZO": DepthRange.ZERO_TO_ONE,
    "reversed": DepthRange.REVERSED,
}
I4 = rational.identity(4)


def flat(value: Any) -> list[float]:
    if isinstance(value, (list, tuple)):
        return [number for part in value for number in flat(part)]
    return [float(value)]


def clip_space(variant: str) -> ClipSpace:
    words = variant.split("_")
    handed = Handedness.LEFT if words[0] == "LH" else Handedness.RIGHT
    depth = DEPTHS["reversed" if "reversed" in words else words[1]]
    return ClipSpace(depth, handed, ClipY.UP)


def convention(record: dict[str, Any]) -> str:
    if record.get("variant") in ("v04", "assign", "A07"):
        return str(record["variant"])
    source = record["source"]
    return "v04" if "v0.4" in source else "A07" if "A07" in source else "assign"


def course_world(record: dict[str, Any], scale: list[float]) -> World:
    a = record["args"]
    named: dict[str, Any] = {
        "v04": {"convention": Convention.POLIMI},
        "assign": {"convention": Convention.POLIMI_ASSIGNMENTS},
        "A07": {"order": "YXZ"},
    }[convention(record)]
    return World(
        translate=(a["tx"], a["ty"], a["tz"]),
        rotate_degrees=(a["rx"], a["ry"], a["rz"]),
        scale=tuple(scale),
        **named,
    )


def make_world(record: dict[str, Any]) -> Any:
    return to_floats(course_world(record, [record["args"]["s"]] * 3).world_from_object)


def make_world_nu(record: dict[str, Any]) -> Any:
    a = record["args"]
    return to_floats(course_world(record, [a["sx"], a["sy"], a["sz"]]).world_from_object)


def make_view(record: dict[str, Any]) -> Any:
    a = record["args"]
    name = Convention.POLIMI if convention(record) == "v04" else Convention.POLIMI_ASSIGNMENTS
    angles = FirstPerson(a["elev"], a["ang"], a.get("roll", 0.0))
    view = View(eye=(a["cx"], a["cy"], a["cz"]), angles=angles, convention=name)
    return to_floats(view.placed().camera_from_world)


def make_parallel(record: dict[str, Any]) -> Any:
    a = record["args"]
    h = float(Fraction(a["w"]) / Fraction(a["a"]))
    return orthographic(Window(-a["w"], a["w"], -h, h), a["n"], a["f"])


def make_perspective(record: dict[str, Any]) -> Any:
    a, variant = record["args"], record.get("variant") or "RH_NO"
    far = inf if "infinite" in variant else a["far"]
    half = Angle.degrees(Fraction(a["fovy_deg"]) / 2)
    return perspective(half, a["aspect"], a["near"], far, clip_space(variant))


def make_box(build: Callable[..., Any]) -> Callable[[dict[str, Any]], Any]:
    def made(record: dict[str, Any]) -> Any:
        a = record["args"]
        window = Window(a["left"], a["right"], a["bottom"], a["top"])
        return build(window, a["near"], a["far"], clip_space(record["variant"]))

    return made


def make_look_at(record: dict[str, Any]) -> Any:
    a = record["args"]
    handed = Handedness.LEFT if record["variant"] == "LH" else Handedness.RIGHT
    return look_at(a["eye"], a["target"], a["up"], handed).camera_from_world


def trs_euler(record: dict[str, Any]) -> Any:
    a = record["args"]
    world = World(tuple(a["t"]), tuple(a["euler_deg"]), scale=tuple(a["s"]), order=a["order"])
    return to_floats(world.world_from_object)


def trs_quat(record: dict[str, Any]) -> Any:
    a = record["args"]
    return to_floats(compose(rotation_from_quaternion(a["q_xyzw"]), a["s"], translate=a["t"]))


def maps(W: Any = None, V: Any = None, P: Any = None, **light: Any) -> ExactMaps:
    camera = I4 if V is None else rational.rational_matrix(V)
    return ExactMaps(
        Transform(Frame.WORLD, Frame.OBJECT, I4 if W is None else rational.rational_matrix(W)),
        Transform(Frame.CAMERA, Frame.WORLD, camera),
        I4 if P is None else rational.rational_matrix(P),
        rational.translation(rational.inverse(camera)),
        WorldLight(light.get("direction"), light.get("position")),
    )


def light_direction(space: Space) -> Callable[[dict[str, Any]], Any]:
    def seen(record: dict[str, Any]) -> Any:
        a, variant = record["args"], record.get("variant") or ""
        d = rational.rational_vector(a["d_world"])
        found = light_in(maps(a.get("W"), a.get("V"), direction=d), space)
        if variant == "W_transpose":
            return found.direction_course_rule
        if "unnormalised" in variant:
            return found.direction_unnormalised
        return found.direction

    return seen


def light_position(space: Space) -> Callable[[dict[str, Any]], Any]:
    def seen(record: dict[str, Any]) -> Any:
        a = record["args"]
        p = rational.rational_vector(a["p_world"])
        return light_in(maps(a.get("W"), a.get("V"), position=p), space).position

    return seen


def eye(space: Space) -> Callable[[dict[str, Any]], Any]:
    def seen(record: dict[str, Any]) -> Any:
        a = record["args"]
        return eye_in(maps(a.get("W"), a["V"]), space).eye

    return seen


def project(record: dict[str, Any]) -> Any:
    a = record["args"]
    P = perspective(Angle.degrees(Fraction(a["fovy_deg"]) / 2), a["aspect"], a["near"], a["far"])
    w, h = a["viewport"][2:]
    found = trace(maps(a["MV"], None, P), a["p"], None, ClipSpace(), Viewport(w, h))
    return {key: getattr(found, key) for key in record["result"]}


def scene(record: dict[str, Any]) -> Any:
    a = record["args"]
    name = Convention.POLIMI if convention(record) == "v04" else Convention.POLIMI_ASSIGNMENTS
    tx, ty, tz, rx, ry, rz, s = a["world"]
    cx, cy, cz, elevation, angle = a["view"]
    fov, aspect, near, far = a["persp"]
    world = World((tx, ty, tz), (rx, ry, rz), scale=(s, s, s), convention=name)
    view = View((cx, cy, cz), angles=FirstPerson(elevation, angle), convention=name)
    W, V = world.world_from_object, view.placed().camera_from_world
    P = rational.rational_matrix(perspective(Angle.degrees(Fraction(fov) / 2), aspect, near, far))
    d = rational.rational_vector(direction_from_angles(*map(Angle.degrees, a["light_dir_deg"])))
    p = rational.rational_vector(a["light_pos"])
    exact = maps(W, V, P, direction=d, position=p)
    WV = rational.product(V, W)
    return {
        "W": W,
        "V": V,
        "P": P,
        "WV": WV,
        "WVP": rational.product(P, WV),
        "light_dir_world": d,
        "spaces": {space.value: in_space(exact, space) for space in THREE_SPACES},
    }


THREE_SPACES = (Space.WORLD, Space.CAMERA, Space.OBJECT)


def in_space(maps: ExactMaps, space: Space) -> dict[str, Any]:
    seen = light_in(maps, space)
    moved = maps.space_from_object(space)
    found = {
        "vertex_matrix": moved.exact,
        "normal_matrix": moved.linear_map.inverse_transpose,
        "light_dir": seen.direction,
        "light_pos": seen.position,
        "eye_pos": eye_in(maps, space).eye,
    }
    if space is Space.OBJECT:
        del found["light_dir"]
        found["light_dir_course_WT_normalised"] = seen.direction_course_rule
        found["light_dir_Winv_normalised"] = seen.direction
    return found


def recomposed(record: dict[str, Any]) -> Any:
    found = parts(rational.rational_matrix(record["args"]["M"]))
    assert found is not None
    R = rotation_from_quaternion(found.quaternion)
    return to_floats(compose(R, found.scale, found.shear, found.translate))


FUNCTIONS: dict[str, Callable[[dict[str, Any]], Any]] = {
    "course.MakeWorld": make_world,
    "course.MakeWorldNu": make_world_nu,
    "course.MakeView": make_view,
    "course.MakeViewWithRoll": make_view,
    "course.MakeParallel": make_parallel,
    "perspective": make_perspective,
    "ortho": make_box(orthographic),
    "frustum": make_box(frustum),
    "look_at": make_look_at,
    "trs_euler": trs_euler,
    "trs_quat": trs_quat,
    "normal_matrix": lambda r: (
        LinearMap.of([row[:3] for row in r["args"]["M"][:3]]).inverse_transpose
    ),
    "normal_transform": lambda r: (
        LinearMap.of([row[:3] for row in r["args"]["M"][:3]]).normal(r["args"]["n"]).direction
    ),
    "invert4": lambda r: rational.inverse(rational.rational_matrix(r["args"]["M"])),
    "light_dir_from_angles": lambda r: direction_from_angles(
        Angle.degrees(r["args"]["alpha_deg"]), Angle.degrees(r["args"]["beta_deg"])
    ),
    "light_dir_to_camera": light_direction(Space.CAMERA),
    "light_dir_to_object": light_direction(Space.OBJECT),
    "light_pos_to_camera": light_position(Space.CAMERA),
    "light_pos_to_object": light_position(Space.OBJECT),
    "eye_pos_object": eye(Space.OBJECT),
    "eye_pos_world": eye(Space.WORLD),
    "project": project,
    "scene": scene,
}


def difference(ours: Any, theirs: Any) -> float:
    if isinstance(theirs, dict):
        assert set(ours) == set(theirs)
        return max(difference(ours[key], theirs[key]) for key in theirs)
    a, b = flat(ours), flat(theirs)
    assert len(a) == len(b)
    return max(abs(x - y) for x, y in zip(a, b, strict=True)) / max(1e-300, *map(abs, b))


def records(data: Path) -> list[dict[str, Any]]:
    return [
        record
        for record in json.loads((data / "golden.json").read_text())
        if record["function"] in FUNCTIONS
        and isinstance(record["result"], (list, dict))
        and "exception" not in record["result"]
    ]


def test_every_record_agrees(data: Path) -> None:
    wrong, counted = [], Counter()
    for record in records(data):
        limit = FLOAT32 if "float32" in record["precision"] else FLOAT64
        result = record["result"]
        ours = FUNCTIONS[record["function"]](record)
        worst = difference(ours, result)
        counted[record["source"].split()[0]] += 1
        if not worst <= limit:
            wrong.append(
                (
                    worst,
                    record["id"],
                    record["source"],
                    record["function"],
                    record.get("variant"),
                    record.get("note"),
                )
            )
    wrong.sort(key=lambda row: -row[0])
    assert not wrong, f"{len(wrong)} of {sum(counted.values())}: {wrong[:40]}"
    assert counted["mpmath"] > 900


def test_the_windows_of_others_lead_back_to_their_points(data: Path) -> None:
    seen = 0
    for record in records(data):
        if record["function"] != "project" or "float32" in record["precision"]:
            continue
        a, window = record["args"], record["result"].get("window")
        if window is None or not 0 <= window[2] <= 1:
            continue
        width, height = a["viewport"][2:]
        half = Angle.degrees(Fraction(a["fovy_deg"]) / 2)
        placed = maps(a["MV"], None, perspective(half, a["aspect"], a["near"], a["far"]))
        x, y, depth = map(Fraction, window)
        found = pixel_ray(placed, (x, height - y), depth, ClipSpace(), Viewport(width, height))
        assert found.point_object is not None
        # Depth near 1 is stored coarsely: a step of it is a step of some z² / near.
        assert difference(found.point_object, a["p"]) <= 1e-10
        seen += 1
    assert seen > 50


def test_decompositions_recompose(data: Path) -> None:
    seen = 0
    for record in json.loads((data / "golden.json").read_text()):
        if record["function"] == "decompose":
            assert difference(recomposed(record), record["args"]["M"]) <= FLOAT64
            seen += 1
    assert seen > 50


def test_a_wrong_rotation_sign_is_noticed(data: Path) -> None:
    record = next(
        one
        for one in records(data)
        if one["function"] == "course.MakeView"
        and convention(one) == "v04"
        and one["args"]["ang"] not in (0, 180, -180)
    )
    mirrored = {**record, "args": {**record["args"], "ang": -record["args"]["ang"]}}
    assert difference(make_view(mirrored), record["result"]) > 1e-3


@pytest.mark.parametrize("value", ["nan", "inf"])
def test_difference_is_not_blind_to(value: str) -> None:
    assert not difference([float(value)], [1.0]) <= FLOAT64


def test_scene_defaults_are_the_contract() -> None:
    assert to_floats(Setup().maps.camera_from_world.exact)[2] == (0.0, 0.0, 1.0, -5.0)
