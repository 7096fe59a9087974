"""Parts: those that were given, or those that a matrix can be taken apart into."""

from __future__ import annotations

import json
import shlex
from fractions import Fraction
from itertools import permutations, product
from math import ulp
from random import Random

import mpmath
import pytest

import nmatrix as package
from nmatrix.enums import Convention
from nmatrix.errors import IllegalValueError
from nmatrix.linear.rational import RationalMatrix, to_floats
from nmatrix.scene.given import world_of
from nmatrix.scene.world import World

CAPITALS = tuple(map("".join, permutations("XYZ")))
HOWS = [(order, Convention.STANDARD) for order in (*CAPITALS, *map(str.lower, CAPITALS))] + [
    ("XYZ", convention) for convention in Convention if convention is not Convention.STANDARD
]
ROUND = (0, 30, 45, 90, -90, 180, 12.5, 270, 1e-9, 89.9999999999999, -90.0000000000001)


def ulps(A: RationalMatrix, B: RationalMatrix) -> float:
    """Compare two world matrices, in units of the last place of the largest entry of a block."""
    unit = ulp(float(max(abs(entry) for row in A for entry in row[:3])))
    pairs = zip((x for row in A for x in row), (x for row in B for x in row), strict=True)
    return max(abs(x - y) for x, y in pairs) / Fraction(unit)


def taken_apart(world: World) -> World:
    """Give the matrix of a world alone, to be told as that world is."""
    matrix = world.world_from_object
    return World(matrix=matrix, order=world.order, convention=world.convention)


@pytest.mark.parametrize(("order", "convention"), HOWS)
def test_parts_fed_back_give_the_matrix(order: str, convention: Convention) -> None:
    drawn = Random(order + convention)
    locks = 0
    for i in range(40):
        turns = [drawn.choice(ROUND) if i % 2 else drawn.uniform(-180, 180) for _ in range(3)]
        scale = [drawn.choice((-1, 1)) * drawn.uniform(0.1, 3) for _ in range(3)]
        shear = [drawn.uniform(-1, 1) if i % 4 else 0 for _ in range(3)]
        how = {"order": order, "convention": convention}
        world = taken_apart(World((1, 2, 3), turns, scale=scale, shear=shear, **how))
        M, found = world.world_from_object, world.parts
        assert found is not None
        assert (found.order, found.convention) == (order, convention)
        rest = {"translate": found.translate, "scale": found.scale, "shear": found.shear}
        again = World(rotate_degrees=found.rotate, **rest, **how).world_from_object
        assert ulps(M, again) <= 4
        others = (
            World(rotate_degrees=found.other_angles, **rest, **how),
            World(quaternion=found.quaternion, **rest),
            World(quaternion=[-x for x in found.quaternion], **rest),
        )
        assert found.other_angles != found.rotate
        assert all(ulps(M, other.world_from_object) <= 8 for other in others)
        locks += found.gimbal_lock
    assert 0 < locks < 40


@pytest.mark.parametrize(("order", "convention"), HOWS)
def test_parts_that_were_given_are_the_options(order: str, convention: Convention) -> None:
    world = World((1, 2, 3), (10, 90.1, -200), None, (-2, -3, 0), (0.1, 0, 7), order, convention)
    found = world.parts
    assert found is not None
    assert found.rotate == tuple(map(Fraction, (10, 90.1, -200)))
    assert (found.scale, found.shear) == ((-2, -3, 0), (Fraction(0.1), 0, 7))
    assert (found.translate, found.order, found.convention) == ((1, 2, 3), order, convention)
    assert found.given
    assert found.unique
    assert not found.gimbal_lock


def test_a_quaternion_that_was_given_stays_and_its_angles_are_derived() -> None:
    found = World(quaternion=(1, 1, 1, 1), order="XYZ").parts
    assert found is not None
    assert (found.quaternion, found.rotate, found.angle_deg) == ((1, 1, 1, 1), (90, 90, 0), 120)
    assert found.gimbal_lock
    assert found.axis == pytest.approx([3**-0.5] * 3, abs=1e-16)


def test_quaternion_axis_and_angle_are_correctly_rounded() -> None:
    for turns in product((10, 30.5, -170), (20, 90, -45), (0, 1e-30, 181)):
        found = World(rotate_degrees=turns).parts
        assert found is not None
        with mpmath.workdps(60):
            q = [mpmath.mpf(x) for x in (0, 0, 0, 1)]
            for axis, turn in enumerate(turns):
                half = mpmath.radians(mpmath.mpf(turn)) / 2
                other = [mpmath.mpf(0)] * 3 + [mpmath.cos(half)]
                other[axis] = mpmath.sin(half)
                q = hamilton(q, other)
            q = [-x for x in q] if q[3] < 0 else q
            length = mpmath.sqrt(sum(x * x for x in q[:3]))
            # What cancels to less than 1e-50 is 0.
            right = [0.0 if abs(x) < mpmath.mpf("1e-50") else float(x) for x in q]
            assert list(found.quaternion) == right, turns
            assert found.angle_deg == float(mpmath.degrees(2 * mpmath.atan2(length, q[3])))
            axis = [0.0 if abs(x) < mpmath.mpf("1e-50") else float(x / length) for x in q[:3]]
            assert list(found.axis or ()) == axis


def hamilton(p: list, q: list) -> list:
    (a, b, c, d), (x, y, z, w) = p, q
    return [
        d * x + a * w + b * z - c * y,
        d * y - a * z + b * w + c * x,
        d * z + a * y - b * x + c * w,
        d * w - a * x - b * y - c * z,
    ]


@pytest.mark.parametrize("turns", list(product((0, 10, 90), (30, -75), (0, 45, 120.5))))
@pytest.mark.parametrize("scale", [(1, 1, 1), (1, 2, 3), (0.1, 0.1, 7)])
def test_the_matrix_of_round_numbers_is_told_in_round_numbers(turns: tuple, scale: tuple) -> None:
    found = taken_apart(World(rotate_degrees=turns, scale=scale)).parts
    assert found is not None
    assert (found.rotate, found.shear) == (tuple(map(float, turns)), (0, 0, 0))
    assert [float(one) for one in found.scale] == list(scale)
    assert found.quaternion == World(rotate_degrees=turns).parts.quaternion


def test_parts_of_a_plain_mirror_keep_its_axis() -> None:
    found = taken_apart(World(scale=(1, -2, 1))).parts
    assert found is not None
    assert (found.scale, found.rotate, found.axis) == ((1, -2, 1), (0, 0, 0), None)


def test_a_singular_matrix_has_parts_only_where_it_was_built_of_them() -> None:
    flat = World(scale=(1, 0, 1))
    assert flat.parts is not None
    assert taken_apart(flat).parts is None
    under = World(rotate_degrees=(1, 2, 3), order="ZYX").under(flat.world_from_object)
    assert (under.order, under.parts) == ("ZYX", None)


def test_a_hierarchy_is_told_in_the_order_of_its_object_but_was_not_given() -> None:
    own = World(rotate_degrees=(10, 20, 30), order="zxy")
    found = own.under(World(translate=(1, 2, 3)).world_from_object).parts
    assert found is not None
    assert (found.given, found.unique, found.order) == (False, False, "zxy")
    assert (found.rotate, found.translate) == ((10, 20, 30), (1, 2, 3))


@pytest.mark.parametrize(
    "how", [{"order": "ZYX"}, {"order": "yzx"}, {"convention": Convention.POLIMI}]
)
def test_python_and_the_shell_tell_a_matrix_alike(nmatrix, how: dict) -> None:
    matrix = to_floats(World((1, 2, 3), (10, 20, 30), scale=(1, -2, 3)).world_from_object)
    typed = "; ".join(" ".join(map(repr, row)) for row in matrix)
    options = " ".join(f"--{name} {value}" for name, value in how.items())
    shell = nmatrix(f"world --world-matrix {shlex.quote(typed)} {options} -f json")
    assert shell.code == 0, shell.err
    python = package.Setup(world={"world_matrix": matrix, **how}).world()
    assert json.loads(shell.out)["parts"] == python.data["parts"]
    assert "one choice of several" in " ".join(shell.data["remarks"])
    again = " ".join(
        f"--{name} {' '.join(map(repr, shell.data['parts'][name]))}"
        for name in ("translate", "rotate", "scale", "shear")
    )
    assert nmatrix(f"world {again} {options} -f json").data["world_from_object"] == [
        pytest.approx(row, abs=1e-15) for row in matrix
    ]


def test_an_order_over_a_scenes_matrix_tells_its_parts() -> None:
    base = World(matrix=World(rotate_degrees=(10, 20, 30)).world_from_object)
    assert world_of({"order": "ZYX"}, base).parts.order == "ZYX"
    assert world_of({"order": "ZYX"}, base).matrix == base.matrix
    assert world_of({"scale": (1, 2, 1)}, base).matrix is None
    with pytest.raises(IllegalValueError, match="the course fixes the order"):
        world_of({"world_matrix": base.matrix, "order": "ZYX", "convention": "polimi"})


def test_gimbal_lock_is_told_with_angles_that_turn_alike(nmatrix) -> None:
    found = nmatrix("world --rotate 30 90 45 -f json").data
    assert found["parts"]["gimbal_lock"]
    assert found["parts"]["rotate"] == [30, 90, 45]
    (remark,) = found["remarks"]
    assert "only their sum or difference counts: rotate 75 90 0 turns alike" in remark
    close = nmatrix("world --rotate 30 89.99999999999999 45 -f json").data
    assert not close["parts"]["gimbal_lock"]


def test_the_table_of_parts_names_order_and_convention(nmatrix) -> None:
    assert "rotate zyx (deg)" in nmatrix("world --rotate 10 20 30 --order zyx --full").out
    assert "rotate polimi (deg)" in nmatrix("world --rotate 1 2 3 --convention polimi --full").out
    assert "Parts, as given" in nmatrix("world --scale -1 -1 -1 --full").out
    assert (
        "Parts, one choice of several"
        in nmatrix('world --world-matrix "0 1 0;1 0 0;0 0 1" --full').out
    )
