"""Depth steps: exact for the near and far given, at distances that are rounded once.

The oracle stores depths as a buffer does, by exact arithmetic, and looks for surfaces itself.
"""

from __future__ import annotations

from fractions import Fraction
from math import inf
from random import Random
from sys import float_info

import mpmath
import numpy as np
import pytest

from nmatrix.enums import DepthRange, Projected
from nmatrix.errors import NoAnswerError
from nmatrix.linear.depthstep import DepthAxis, orthographic_steps, perspective_steps
from nmatrix.linear.rounding import nth_root

ONE_TO_MILLION = [1.0, 10.0, 100.0, 1000.0, 10000.0, 100000.0, 1000000.0]


@pytest.mark.parametrize("far", [1e6, inf])
def test_geometric_distances_carry_no_noise(far: float) -> None:
    steps = perspective_steps(1.0, far, DepthRange.ZERO_TO_ONE)
    assert [step.distance for step in steps] == ONE_TO_MILLION


@pytest.mark.parametrize(("near", "far"), [(0.1, 100.0), (5e-324, 1e308), (3.7, 3.8), (1e-5, 7.0)])
def test_geometric_distances_are_the_nearest_floats(near: float, far: float) -> None:
    found = [step.distance for step in perspective_steps(near, far, DepthRange.REVERSED)]
    with mpmath.workdps(60):
        ratio = mpmath.mpf(far) / mpmath.mpf(near)
        assert found == [float(near * ratio ** (mpmath.mpf(i) / 6)) for i in range(7)]


def test_roots_of_exact_powers_and_halfway_cases_are_right() -> None:
    assert nth_root(Fraction(3) ** 60, 6) == 3.0**10
    tie = Fraction(2**53 + 1)
    assert nth_root(tie**6, 6) == 2.0**53  # half to even
    assert nth_root(tie**6 + 1, 6) == 2.0**53 + 2


@pytest.mark.parametrize("depth", list(DepthRange))
def test_a_depth_of_one_has_the_spacing_below_it(depth: DepthRange) -> None:
    steps = perspective_steps(1.0, 2.0, depth)
    end = steps[0] if depth is DepthRange.REVERSED else steps[-1]
    z = Fraction(end.distance)
    for gap, step in (
        (end.float32, Fraction(1, 2**24)),
        (end.unorm24, Fraction(1, 2**24 - 1)),
    ):
        assert gap == z - 1 / (1 / z + step * Fraction(1, 2))


def float32(value: Fraction) -> Fraction:
    """Round to the nearest float32, half to even."""
    if not value:
        return value
    exponent = value.numerator.bit_length() - value.denominator.bit_length()
    exponent -= Fraction(2) ** exponent > value
    unit = Fraction(2) ** max(exponent - 23, -149)
    return round(value / unit) * unit


def stored(axis: DepthAxis, z: Fraction, buffer: str) -> Fraction:
    """Store the depth of a distance in a buffer, as the nearest number that it can hold."""
    depth = axis.depth_at(z)
    if buffer == "unorm24":
        return Fraction(round(depth * (2**24 - 1)), 2**24 - 1)
    if axis.depth is DepthRange.MINUS_ONE_TO_ONE:
        unit = Fraction(1, 2**25 if depth <= Fraction(1, 2) else 2**24)
        return round(depth / unit) * unit
    return float32(depth)


BARELY = Fraction(1, 2**60)
PLANES = [(0.1, 100.0), (0.001, 1e5), (1.0, inf), (0.5, 10.0), (3.7, 3.8), (1e-3, 1e9), (2.0, 1e3)]


@pytest.mark.parametrize("projected", list(Projected))
@pytest.mark.parametrize("depth", list(DepthRange))
@pytest.mark.parametrize(("near", "far"), PLANES)
@pytest.mark.parametrize("buffer", ["float32", "unorm24"])
def test_surfaces_farther_apart_than_the_gap_are_told_and_no_smaller_gap_is_sure(
    projected: Projected, depth: DepthRange, near: float, far: float, buffer: str
) -> None:
    if projected is Projected.PARALLEL and far == inf:
        return
    axis, draw = DepthAxis(near, far, depth, projected), Random(f"{near} {far} {depth}")
    last = Fraction(far) if far < inf else 10**7 * Fraction(near)
    compared = 0
    for _ in range(60):
        share = Fraction(draw.random())
        z = Fraction(near) + (last - Fraction(near)) * share ** draw.choice((1, 4, 12))
        gap = getattr(axis.step_at(z), buffer)
        nearer = z - gap * (1 + BARELY)
        if nearer > near:
            assert stored(axis, nearer, buffer) != stored(axis, z, buffer)
        # As far behind as is stored alike: there a gap a little smaller tells nothing.
        step = abs(axis.depth_at(z) - axis.depth_at(z - gap))
        away = -1 if depth is DepthRange.REVERSED else 1
        held = stored(axis, z, buffer)
        behind = axis.distance_at(held + away * step * Fraction(49, 100))
        front = axis.distance_at(held - away * step * Fraction(49, 100))
        if behind is None or front is None or not near < front < behind < last:
            continue
        same = getattr(axis.step_at(behind), buffer)
        if same == pytest.approx(gap, rel=1e-3):  # where the spacing does not change
            assert behind - front < same
            assert stored(axis, behind, buffer) == stored(axis, front, buffer) == held
            compared += 1
    assert compared


@pytest.mark.parametrize("depth", list(DepthRange))
@pytest.mark.parametrize(("near", "far"), PLANES)
def test_the_surface_at_the_gap_has_the_next_stored_depth(
    depth: DepthRange, near: float, far: float
) -> None:
    axis = DepthAxis(near, far, depth, Projected.PERSPECTIVE)
    for value in (0.75, 0.5, 0.625, 0.3125, 2.0**-9, 0.9999999403953552):
        z = axis.distance_at(Fraction(value))
        if z is None or (depth is DepthRange.MINUS_ONE_TO_ONE and value < 0.25):
            continue
        gap = axis.step_at(z).float32
        next_depth = np.nextafter(np.float32(value), np.float32(depth is DepthRange.REVERSED))
        if depth is DepthRange.MINUS_ONE_TO_ONE and value < 0.5:
            next_depth = value - 2.0**-25  # as coarse as near −1
        assert axis.depth_at(z - gap) == Fraction(float(next_depth))


@pytest.mark.parametrize("bits", [1, 2, 7])
def test_a_reversed_depth_rounded_to_a_power_of_two_has_the_coarser_step_in_front(
    bits: int,
) -> None:
    axis = DepthAxis(1.0, inf, DepthRange.REVERSED, Projected.PERSPECTIVE)
    power = Fraction(1, 2**bits)
    z = axis.distance_at(power * (1 - Fraction(1, 2**26)))
    gap = axis.step_at(z).float32
    assert float32(axis.depth_at(z)) == power
    assert float32(axis.depth_at(z - gap)) != power
    assert float32(axis.depth_at(z - gap / 2)) == power


def test_a_float32_depth_of_zero_at_near_has_none_in_front() -> None:
    for tabulate in (perspective_steps, orthographic_steps):
        steps = tabulate(0.5, 10.0, DepthRange.ZERO_TO_ONE)
        assert steps[0].float32 is None
        assert all(step.float32 > 0 for step in steps[1:])


def test_the_far_field_of_a_small_near_is_told_as_far_as_it_is() -> None:
    last = perspective_steps(0.001, 1e5, DepthRange.ZERO_TO_ONE)[-1]
    assert 85_600 < last.float32 < 85_700
    assert 5620 < perspective_steps(0.1, 1e5, DepthRange.ZERO_TO_ONE)[-1].float32 < 5630


@pytest.mark.parametrize("projected", list(Projected))
@pytest.mark.parametrize("depth", list(DepthRange))
def test_depths_and_distances_lead_back_to_each_other(
    projected: Projected, depth: DepthRange
) -> None:
    axis = DepthAxis(0.1, 100.0, depth, projected)
    assert axis.depth_at(Fraction(0.1)) == (depth is DepthRange.REVERSED)
    assert axis.depth_at(Fraction(100)) == (depth is not DepthRange.REVERSED)
    for distance in (Fraction(0.1), Fraction(3), Fraction(250)):
        assert axis.distance_at(axis.depth_at(distance)) == distance


def test_what_lies_at_infinity_has_no_distance_and_the_eye_no_depth() -> None:
    axis = DepthAxis(0.1, inf, DepthRange.REVERSED, Projected.PERSPECTIVE)
    assert axis.distance_at(Fraction(0)) is None
    with pytest.raises(NoAnswerError, match="in front of the eye"):
        axis.depth_at(Fraction(0))


def test_a_parallel_view_of_any_width_has_finite_distances() -> None:
    steps = orthographic_steps(-1e308, 1e308, DepthRange.ZERO_TO_ONE)
    assert steps[3].distance == 0.0
    assert [step.distance for step in steps] == sorted(step.distance for step in steps)
    assert steps[-1].float32 == Fraction(1e308) / 2**23
    assert all(float(step.unorm24) < inf for step in steps)


def test_a_huge_near_with_an_infinite_far_ends_at_the_largest_float() -> None:
    steps = perspective_steps(1e305, inf, DepthRange.REVERSED)
    assert steps[-1].distance == float_info.max
    assert all(float(step.float32) < inf for step in steps)


def test_a_depth_too_small_for_a_float_has_the_finest_spacing() -> None:
    last = perspective_steps(1e-300, 1e308, DepthRange.REVERSED)[-2]
    z, n, f = map(Fraction, (last.distance, 1e-300, 1e308))
    assert last.float32 == z - 1 / (1 / z + Fraction(1, 2**149) * (f - n) / (f * n))
