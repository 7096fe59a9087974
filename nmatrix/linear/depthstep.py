"""How small a gap in depth a depth buffer can tell, at distances from near to far.

z is the distance along the view direction, d(z) the window depth; the step is the spacing of
stored depths at d over the slope |d′(z)|.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import frexp, inf, ldexp

from nmatrix.enums import DepthRange
from nmatrix.linear.rational import Rows

DISTANCES = 7
BEYOND_NEAR = 1e6  # how far the table goes when far is infinite
UNORM24 = 1 / (2**24 - 1)


@dataclass(frozen=True)
class DepthStep:
    """The smallest gap that two buffer formats tell at one distance, in scene units."""

    distance: float
    float32: float
    unorm24: float


def depth_steps(
    clip_from_camera: Rows, near: float, far: float, depth: DepthRange
) -> tuple[DepthStep, ...]:
    """Return the table for seven distances in geometric steps from near to far.

    A parallel view has arithmetic steps, since its near may be zero or negative.

    Examples
    --------
    >>> from nmatrix.linear.angle import Angle
    >>> from nmatrix.linear.projection import ClipSpace, perspective
    >>> clip = perspective(Angle.degrees(30), 1, 1, inf, ClipSpace(DepthRange.REVERSED))
    >>> steps = depth_steps(clip, 1.0, inf, DepthRange.REVERSED)
    >>> max(step.float32 / step.distance for step in steps) < 2.4e-7
    True
    """
    last = near * BEYOND_NEAR if far == inf else far
    is_perspective = clip_from_camera[3][3] == 0
    return tuple(
        _step(clip_from_camera, distance, depth)
        for distance in _distances(near, last, geometric=is_perspective)
    )


def _distances(near: float, far: float, *, geometric: bool) -> list[float]:
    inner = range(1, DISTANCES - 1)
    parts = [i / (DISTANCES - 1) for i in inner]
    if geometric:
        middle = [near ** (1 - t) * far**t for t in parts]
    else:
        middle = [near + (far - near) * t for t in parts]
    return [near, *middle, far]


def _step(clip_from_camera: Rows, distance: float, depth: DepthRange) -> DepthStep:
    z_row, w_row = clip_from_camera[2], clip_from_camera[3]
    g = w_row[2] if w_row[3] == 0 else (1.0 if z_row[2] > 0 else -1.0)
    if w_row[3] == 0:
        ndc = (z_row[2] * g) + z_row[3] / distance
        slope = abs(z_row[3]) / distance / distance
    else:
        ndc = z_row[2] * g * distance + z_row[3]
        slope = abs(z_row[2])
    spacing = _float32_spacing(ndc)
    if depth is DepthRange.MINUS_ONE_TO_ONE:
        # Halving and adding ½ leaves the coarser of the two roundings.
        spacing = max(spacing / 2, _float32_spacing((ndc + 1) / 2))
        slope /= 2
    if slope == 0:
        return DepthStep(distance, inf, inf)
    return DepthStep(distance, spacing / slope, UNORM24 / slope)


def _float32_spacing(value: float) -> float:
    """Return the gap between the float32 numbers around a value."""
    exponent = frexp(min(abs(value), 1.0))[1] if value else -125
    return ldexp(1.0, max(exponent - 24, -149))
