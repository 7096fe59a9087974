"""The smallest gap in depth that a depth buffer can tell, at distances from near to far.

z is the distance along the view direction, d(z) the window depth: a + c/z in a perspective view,
a·z + c in a parallel one. The step is the spacing of stored depths at d over the slope |d′(z)|.
All of it is exact for the near and far that were given; only the distances are rounded, once.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import frexp, inf
from sys import float_info

from nmatrix.enums import DepthRange
from nmatrix.linear.projection import orthographic_depth, perspective_depth
from nmatrix.linear.rounding import nearest, nth_root

DISTANCES = 7
INTERVALS = DISTANCES - 1
BEYOND_NEAR = 10**6  # how far the table goes when far is infinite
UNORM24 = Fraction(1, 2**24 - 1)
LARGEST = Fraction(float_info.max)


@dataclass(frozen=True)
class DepthStep:
    """The smallest gap that two buffer formats tell at one distance, in scene units, exactly."""

    distance: float
    float32: Fraction
    unorm24: Fraction


def perspective_steps(near: float, far: float, depth: DepthRange) -> tuple[DepthStep, ...]:
    """Tabulate a perspective view at seven distances, in geometric steps from near to far.

    Where far is infinite it ends at 10⁶ near, or at the largest float.

    Examples
    --------
    >>> steps = perspective_steps(1.0, inf, DepthRange.REVERSED)
    >>> [step.distance for step in steps]
    [1.0, 10.0, 100.0, 1000.0, 10000.0, 100000.0, 1000000.0]
    >>> max(float(step.float32) / step.distance for step in steps) < 2.4e-7
    True
    """
    a, c = perspective_depth(near, far, depth)
    first = Fraction(near)
    last = min(BEYOND_NEAR * first, LARGEST) if far == inf else Fraction(far)
    distances = (nth_root(first ** (INTERVALS - i) * last**i, INTERVALS) for i in range(DISTANCES))
    return tuple(
        _step(distance, a + c / z, abs(c) / z**2, depth)
        for distance, z in ((distance, Fraction(distance)) for distance in distances)
    )


def orthographic_steps(near: float, far: float, depth: DepthRange) -> tuple[DepthStep, ...]:
    """Tabulate a parallel view in arithmetic steps, since near may be zero or negative.

    Examples
    --------
    >>> [step.distance for step in orthographic_steps(-1.0, 2.0, DepthRange.ZERO_TO_ONE)]
    [-1.0, -0.5, 0.0, 0.5, 1.0, 1.5, 2.0]
    """
    a, c = orthographic_depth(near, far, depth)
    first, whole = Fraction(near), Fraction(far) - Fraction(near)
    distances = (nearest(first + whole * i / INTERVALS) for i in range(DISTANCES))
    return tuple(
        _step(distance, a * Fraction(distance) + c, abs(a), depth) for distance in distances
    )


def _step(distance: float, ndc: Fraction, slope: Fraction, depth: DepthRange) -> DepthStep:
    spacing = _float32_spacing(ndc)
    if depth is DepthRange.MINUS_ONE_TO_ONE:
        # Halving and adding ½ leaves the coarser of the two roundings.
        spacing = max(spacing / 2, _float32_spacing((ndc + 1) / 2))
        slope /= 2
    return DepthStep(distance, spacing / slope, UNORM24 / slope)


def _float32_spacing(depth: Fraction) -> Fraction:
    """Return the gap between the float32 numbers around a depth; below, where it is ±1.

    No depth passes 1, so the gap above it, which is twice as wide, is never used.
    """
    rounded = float(depth)
    exponent = min(frexp(rounded)[1], 0) if rounded else -125
    return Fraction(2) ** max(exponent - 24, -149)
