"""Window depth along the view direction: depths of distances, and the gaps that a buffer tells.

z is the distance along the view direction, D(z) the window depth from 0 to 1: slope/z + offset in
a perspective view, slope·z + offset in a parallel one. A buffer stores the nearest depth that it
can hold, so a surface at z is sure to differ from one in front of it once their depths are a whole
step apart: the gap is z − z′ where D(z′) is one step nearer. All of it is exact for the near and
far that were given; only the distances of the table are rounded, once.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import inf
from sys import float_info

from nmatrix.enums import DepthRange, Projected
from nmatrix.errors import NoAnswerError
from nmatrix.linear.projection import orthographic_depth, perspective_depth
from nmatrix.linear.rounding import nearest, nth_root
from nmatrix.linear.viewport import WINDOW_DEPTH

DISTANCES = 7
INTERVALS = DISTANCES - 1
BEYOND_NEAR = 10**6  # how far the table goes when far is infinite
UNORM24 = Fraction(1, 2**24 - 1)
LARGEST = Fraction(float_info.max)
MANTISSA = 23  # bits of a float32 behind its leading one
SUBNORMAL = Fraction(1, 2**149)  # the finest step between float32 numbers


@dataclass(frozen=True)
class DepthStep:
    """The gaps that two buffer formats are sure to tell at one distance, in scene units, exactly.

    `float32` is None where the stored depth is 0 at near: no float32 lies in front of it.
    """

    distance: float
    float32: Fraction | None
    unorm24: Fraction


@dataclass(frozen=True)
class DepthAxis:
    """How window depth runs from near to far, in a perspective or in a parallel view.

    Examples
    --------
    >>> axis = DepthAxis(1.0, inf, DepthRange.REVERSED, Projected.PERSPECTIVE)
    >>> print(axis.depth_at(Fraction(4)), axis.distance_at(Fraction(1, 4)))
    1/4 4
    """

    near: float
    far: float
    depth: DepthRange
    projected: Projected

    @cached_property
    def coefficients(self) -> tuple[Fraction, Fraction]:
        """Slope and offset of window depth, over 1/z in perspective and over z in a parallel view.

        Raises
        ------
        IllegalValueError, NoAnswerError
            For a near and far that make no projection.
        """
        scale, shift = WINDOW_DEPTH[self.depth]
        if self.projected is Projected.PERSPECTIVE:
            offset, slope = perspective_depth(self.near, self.far, self.depth)
        else:
            slope, offset = orthographic_depth(self.near, self.far, self.depth)
        return scale * slope, scale * offset + shift

    def depth_at(self, distance: Fraction) -> Fraction:
        """Compute the window depth of a distance, below 0 or above 1 where it is clipped.

        Raises
        ------
        NoAnswerError
            In a perspective view, at the eye and behind it.
        """
        slope, offset = self.coefficients
        if self.projected is Projected.PARALLEL:
            return slope * distance + offset
        if distance <= 0:
            raise NoAnswerError(
                f"distance ({float(distance):g})",
                "in a perspective view depth begins in front of the eye",
                "give a distance above 0",
            )
        return slope / distance + offset

    def distance_at(self, depth: Fraction) -> Fraction | None:
        """Compute the distance of a window depth; None where it lies at infinity."""
        slope, offset = self.coefficients
        if self.projected is Projected.PARALLEL:
            return (depth - offset) / slope
        return None if depth == offset else slope / (depth - offset)

    def step_at(self, distance: float) -> DepthStep:
        """Compute the gaps in front of a distance between near and far."""
        z = Fraction(distance)
        spacing = _float32_spacing(self.depth_at(z), self.depth)
        float32 = None if spacing is None else self._gap(z, spacing)
        return DepthStep(distance, float32, self._gap(z, UNORM24))

    def _gap(self, z: Fraction, step: Fraction) -> Fraction:
        """Compute how far in front of z depth is nearer by a step: z − 1/(1/z + step/|slope|)."""
        size = abs(self.coefficients[0])
        if self.projected is Projected.PARALLEL:
            return step / size
        return step * z**2 / (size + step * z)


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
    axis = DepthAxis(near, far, depth, Projected.PERSPECTIVE)
    first = Fraction(near)
    last = min(BEYOND_NEAR * first, LARGEST) if far == inf else Fraction(far)
    distances = (nth_root(first ** (INTERVALS - i) * last**i, INTERVALS) for i in range(DISTANCES))
    return tuple(map(axis.step_at, distances))


def orthographic_steps(near: float, far: float, depth: DepthRange) -> tuple[DepthStep, ...]:
    """Tabulate a parallel view in arithmetic steps, since near may be zero or negative.

    Examples
    --------
    >>> [step.distance for step in orthographic_steps(-1.0, 2.0, DepthRange.ZERO_TO_ONE)]
    [-1.0, -0.5, 0.0, 0.5, 1.0, 1.5, 2.0]
    """
    axis = DepthAxis(near, far, depth, Projected.PARALLEL)
    first, whole = Fraction(near), Fraction(far) - Fraction(near)
    distances = (nearest(first + whole * i / INTERVALS) for i in range(DISTANCES))
    return tuple(map(axis.step_at, distances))


def _float32_spacing(depth: Fraction, within: DepthRange) -> Fraction | None:
    """Find the step from a window depth to the next that a float32 buffer holds nearer the eye.

    From −1 to 1 what is stored is (z + 1)/2 of a float32 z. Near −1 z itself is coarse, above 0 the
    sum is: multiples of 2⁻²⁵ remain up to ½, of 2⁻²⁴ beyond. From 0 to 1 the numbers below a depth
    are stored. Reversed it is those above: there a depth that is stored as a power of two has
    already the coarser numbers in front, except 1, which nothing passes.
    """
    if within is DepthRange.MINUS_ONE_TO_ONE:
        return Fraction(1, 2**24) if depth > Fraction(1, 2) else Fraction(1, 2**25)
    if depth <= 0:
        return SUBNORMAL if within is DepthRange.REVERSED else None
    power = _power_of_two(depth)
    if within is DepthRange.ZERO_TO_ONE:
        return max((power / 2 if depth == power else power) / (1 << MANTISSA), SUBNORMAL)
    spacing = power / (1 << MANTISSA)
    if depth + spacing / 2 >= 2 * power:
        spacing *= 2
    return min(max(spacing, SUBNORMAL), Fraction(1, 2 << MANTISSA))


def _power_of_two(value: Fraction) -> Fraction:
    """Find the largest power of two that is not above a positive value."""
    exponent = value.numerator.bit_length() - value.denominator.bit_length()
    found = Fraction(1 << exponent) if exponent >= 0 else Fraction(1, 1 << -exponent)
    return found if found <= value else found / 2
