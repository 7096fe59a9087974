"""A world by an axis and an angle, on every way in, against Rodrigues' formula in decimals."""

from __future__ import annotations

from decimal import Decimal, localcontext
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nmatrix.errors import IllegalValueError, NoAnswerError
from nmatrix.linear.angle import Angle
from nmatrix.linear.rational import linear_part, to_floats
from nmatrix.scene.given import world_of
from nmatrix.scene.open import scene_of
from nmatrix.scene.world import World

AXES = st.tuples(*[st.integers(-20, 20)] * 3).filter(any)


def rodrigues(axis: tuple[int, ...], degrees: int) -> np.ndarray:
    """Build the rotation by the definition, in fifty digits of decimals."""
    with localcontext() as context:
        context.prec = 50
        length = sum(Decimal(x) ** 2 for x in axis).sqrt()
        a = [Decimal(x) / length for x in axis]
        angle = Angle.degrees(degrees)
        s, c = (Decimal(x.numerator) / Decimal(x.denominator) for x in (angle.sine, angle.cosine))
        K = [[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]]
        return np.array(
            [
                [float((i == j) * c + (1 - c) * a[i] * a[j] + s * K[i][j]) for j in range(3)]
                for i in range(3)
            ]
        )


@given(AXES, st.integers(-720, 720))
def test_it_is_the_rotation_about_that_axis(axis: tuple[int, ...], degrees: int) -> None:
    world = World(axis_angle=(*axis, degrees))
    found = np.array(to_floats(linear_part(world.world_from_object)))
    assert np.abs(found - rodrigues(axis, degrees)).max() <= 2**-53


@given(AXES, st.integers(-720, 720))
def test_its_parts_are_as_given(axis: tuple[int, ...], degrees: int) -> None:
    parts = World(axis_angle=(*axis, degrees)).parts
    assert parts is not None
    assert parts.angle_deg == degrees
    assert np.allclose(parts.axis, np.array(axis) / np.linalg.norm(axis), rtol=0, atol=1e-15)


def test_a_third_of_a_turn_about_the_diagonal_permutes_the_axes_exactly() -> None:
    found = World(axis_angle=(1, 1, 1, 120)).world_from_object
    assert linear_part(found) == ((0, 0, 1), (1, 0, 0), (0, 1, 0))


@pytest.mark.parametrize("beside", ["rotate", "quaternion", "order"])
def test_two_ways_to_turn_contradict_each_other(beside: str) -> None:
    others = {"rotate": (1, 2, 3), "quaternion": (0, 0, 0, 1), "order": "ZYX"}
    with pytest.raises(IllegalValueError, match=f"axis_angle with {beside}|with axis_angle"):
        world_of({"axis_angle": (0, 0, 1, 20), beside: others[beside]})


def test_an_axis_of_length_zero_is_refused(tmp_path: Path) -> None:
    with pytest.raises(NoAnswerError, match="it has no direction"):
        World(axis_angle=(0, 0, 0, 30)).world_from_object  # noqa: B018  # computed when asked
    path = tmp_path / "a.toml"
    path.write_text('[[object]]\nshape = "box"\naxis_angle = [0, 0, 0, 30]\n')
    with pytest.raises(IllegalValueError, match="its axis has no direction"):
        scene_of(path)


def test_it_replaces_a_scenes_own_turn_and_is_replaced_by_one(tmp_path: Path) -> None:
    path = tmp_path / "a.toml"
    path.write_text('[[object]]\nshape = "box"\naxis_angle = [0, 0, 1, 90]\n')
    place = scene_of(path).objects[0].place
    assert place is not None
    assert place.world_from_object[1][0] == 1
    assert world_of({"rotate": (0, 0, 0)}, place).world_from_object[0][0] == 1
    assert (
        world_of({"axis_angle": (0, 0, 1, 180)}, World(quaternion=(0, 0, 1, 1))).parts is not None
    )
