"""Axis systems against what the programs themselves document, and rotations against SciPy's way."""

from __future__ import annotations

from fractions import Fraction
from itertools import permutations, product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nmatrix.answers.axes import axes
from nmatrix.enums import AxisName
from nmatrix.errors import IllegalValueError
from nmatrix.linear.affine import compose, rotation_by, rotation_from_quaternion
from nmatrix.linear.axes import AxisChange, axis_system
from nmatrix.linear.rational import apply, determinant, linear_part
from nmatrix.linear.rational import product as multiplied

NAMES = st.sampled_from(list(AxisName))
OWN = [
    " ".join(f"{sign}{letter}" for sign, letter in zip(signs, letters, strict=True))
    for letters in permutations("xyz")
    for signs in product("+-", repeat=3)
]
SYSTEMS = st.one_of(NAMES, st.sampled_from(OWN))

# What (1, 2, 3) becomes, as the programs say.
DOCUMENTED = [
    ("blender", "opengl", (1, 3, -2)),  # glTF export: (x, z, −y)
    ("blender", "usd-z-up", (1, 2, 3)),
    ("opengl", "unity", (1, 2, -3)),  # z is negated
    ("-x +y +z", "unity", (-1, 2, 3)),  # glTF importers of Unity negate x
    ("blender", "unity", (1, 3, 2)),
    ("opengl", "opencv", (1, -2, -3)),  # NeRF and COLMAP: y and z are negated
    ("ros", "opencv", (-2, -3, 1)),  # body to optical frame, REP 103
    ("unity", "unreal", (300, 100, 200)),  # forward, right, up; metres to centimetres
    ("unreal", "unity", (Fraction(1, 50), Fraction(3, 100), Fraction(1, 100))),
    ("opengl", "unreal", (-300, 100, 200)),
    ("ros", "unity", (-2, 3, 1)),  # Unity Robotics: (−y, z, x)
]


@pytest.mark.parametrize(("source", "target", "expected"), DOCUMENTED)
def test_points_go_where_the_programs_put_them(
    source: str, target: str, expected: tuple[float, ...]
) -> None:
    change = AxisChange(axis_system(source), axis_system(target))
    assert apply(change.to_from, tuple(map(Fraction, (1, 2, 3, 1))))[:3] == expected


@given(SYSTEMS, SYSTEMS, SYSTEMS)
def test_two_changes_make_one(a: str, b: str, c: str) -> None:
    first, second, third = map(axis_system, (a, b, c))
    there = multiplied(AxisChange(second, third).to_from, AxisChange(first, second).to_from)
    assert there == AxisChange(first, third).to_from


@given(SYSTEMS, SYSTEMS)
def test_right_up_and_forward_stay_what_they_are(a: str, b: str) -> None:
    change = AxisChange(axis_system(a), axis_system(b))
    assert multiplied(change.rotation, change.source.basis) == change.target.basis
    assert change.mirrors is (change.source.is_left_handed != change.target.is_left_handed)
    assert abs(determinant(linear_part(change.to_from))) == change.unit_scale**3


@given(SYSTEMS, SYSTEMS, st.tuples(*[st.integers(-9, 9)] * 4).filter(any))
def test_a_rotation_goes_by_its_axis_and_backwards_in_a_mirror(
    a: str, b: str, quaternion: tuple[int, ...]
) -> None:
    """The rule of the remark: x y z go as a point does, each sign changed in a mirror."""
    change = AxisChange(axis_system(a), axis_system(b))
    *axis, w = map(Fraction, quaternion)
    sign = -1 if change.mirrors else 1
    turned = (*(sign * one for one in apply(change.rotation, axis)), w)
    M = compose(rotation_from_quaternion(quaternion), translate=(1, 2, 3))
    found = change.of_matrix(M)
    assert linear_part(found) == rotation_from_quaternion(turned)


@pytest.mark.parametrize("order", ["XYZ", "zyx", "ZXY", "yxz"])
@given(st.tuples(*[st.floats(-180, 180)] * 3))
def test_angles_out_build_the_matrix_in_their_order(order: str, angles: tuple[float, ...]) -> None:
    M = compose(rotation_by(angles, order))
    told = axes("opengl", "blender", M, order).data
    built = rotation_by(told["parts"]["rotate"], order)  # type: ignore[index, call-overload]
    found = linear_part(told["matrix"])  # type: ignore[arg-type]
    assert np.abs(np.array(built, float) - np.array(found, float)).max() < 1e-12


TURNS = st.tuples(*[st.integers(-90, 90)] * 3)


@given(TURNS)
def test_unreals_angles_are_the_order_that_the_page_names(angles: tuple[int, ...]) -> None:
    """Against the rows of Unreal's rotation matrix, which are its axes."""
    roll, pitch, yaw = angles
    (sr, sp, sy), (cr, cp, cy) = np.sin(np.radians(angles)), np.cos(np.radians(angles))
    rows = [
        [cp * cy, cp * sy, sp],
        [sr * sp * cy - cr * sy, sr * sp * sy + cr * cy, -sr * cp],
        [-(cr * sp * cy + sr * sy), cy * sr - cr * sp * sy, cr * cp],
    ]
    ours = rotation_by((-roll, -pitch, yaw), "ZYX")
    assert np.abs(np.array(ours, float) - np.transpose(rows)).max() < 1e-14


@given(TURNS)
def test_unitys_angles_are_the_order_that_the_page_names(angles: tuple[int, ...]) -> None:
    """Turned about z first, then x, then y, each about the fixed axis."""
    x, y, z = angles
    about_z, about_x, about_y = (rotation_by(one) for one in ((0, 0, z), (x, 0, 0), (0, y, 0)))
    expected = np.array(about_y, float) @ np.array(about_x, float) @ np.array(about_z, float)
    assert np.abs(np.array(rotation_by((x, y, z), "YXZ"), float) - expected).max() < 1e-14


def test_a_pose_of_unity_is_the_one_that_unreal_shows() -> None:
    """Against a pose that both editors showed: its place in both units, and both triples."""
    R = rotation_by((47.486, 359.987, 281.519), "YXZ")
    M = compose(R, translate=(-26.318, -12.544, 67.172))
    told = axes("unity", "unreal", M, "ZYX").data["parts"]
    roll, pitch, yaw = (float(angle) for angle in told["rotate"])  # type: ignore[index, call-overload]
    assert (-roll, -pitch, yaw) == pytest.approx((78.481, -47.486, -0.013), abs=1e-9)
    place = [float(one) for one in told["translate"]]  # type: ignore[index, call-overload]
    assert place == pytest.approx([6717.2, -2631.8, -1254.4])


@pytest.mark.parametrize("name", AxisName)
def test_every_name_is_a_system(name: AxisName) -> None:
    assert abs(determinant(axis_system(name.upper()).basis)) == 1


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("unrael", "did you mean unreal"),
        ("+x +x +y", "z is missing"),
        ("x y", "the axes that point right, up and forward"),
        ("", 'try "'),
        ("+x +y +w", "it is opengl"),
    ],
)
def test_what_is_no_system_is_refused(text: str, words: str) -> None:
    with pytest.raises(IllegalValueError, match=words.replace("+", r"\+")):
        axis_system(text)


def test_unity_is_told_what_its_importers_do() -> None:
    remarks = axes("gltf", "unity").remarks
    assert any("flip x" in one for one in remarks)
    assert not any("flip x" in one for one in axes("blender", "unity").remarks)


def test_a_singular_matrix_has_no_parts() -> None:
    flat = compose(rotation_from_quaternion((0, 0, 0, 1)), scale=(1, 0, 1))
    assert axes("opengl", "unreal", flat).data["parts"] is None
