"""Depth steps: exact for the near and far given, at distances that are rounded once."""

from __future__ import annotations

from fractions import Fraction
from math import inf
from sys import float_info

import mpmath
import pytest

from nmatrix.enums import DepthRange
from nmatrix.linear.depthstep import orthographic_steps, perspective_steps
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
    slope = Fraction(2) if depth is DepthRange.REVERSED else Fraction(1, 2)
    assert end.float32 == Fraction(1, 2**24) / slope
    assert end.unorm24 == Fraction(1, 2**24 - 1) / slope


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
    assert last.float32 == Fraction(2) ** -149 * Fraction(last.distance) ** 2 / (
        Fraction(1e308) * Fraction(1e-300) / (Fraction(1e308) - Fraction(1e-300))
    )
