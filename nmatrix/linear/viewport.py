"""The last map of the pipeline: from normalised device coordinates to pixels, and back.

x counts from the left, y from where the interface's window begins. Pixels begin at whole numbers,
so the middle of the first one is at (0.5, 0.5).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from nmatrix.enums import DepthRange
from nmatrix.errors import IllegalValueError, quantity
from nmatrix.linear.projection import ClipSpace
from nmatrix.linear.rational import ONE, ZERO, RationalMatrix, RationalVector, apply, inverse
from nmatrix.linear.values import vector

HALF = Fraction(1, 2)
WINDOW_DEPTH: Mapping[DepthRange, tuple[Fraction, Fraction]] = {  # of NDC z: slope and offset
    DepthRange.MINUS_ONE_TO_ONE: (HALF, HALF),
    DepthRange.ZERO_TO_ONE: (ONE, ZERO),
    DepthRange.REVERSED: (ONE, ZERO),
}


@dataclass(frozen=True)
class Viewport:
    """The window in pixels."""

    width: float
    height: float

    def __post_init__(self) -> None:
        if not all(side > 0 and float(side).is_integer() for side in (self.width, self.height)):
            raise IllegalValueError(
                f"{quantity('viewport')} ({float(self.width):g} {float(self.height):g})",
                "both sides are whole pixels, 1 or more",
                "try 512 512",
            )

    @property
    def aspect(self) -> Fraction:
        """Width over height."""
        return Fraction(self.width) / Fraction(self.height)

    def pixel(self, window: RationalVector, clip: ClipSpace) -> RationalVector:
        """Count y of a place in the window from the top, whatever the interface does; and back.

        Examples
        --------
        >>> print(*Viewport(640, 480).pixel((Fraction(10), Fraction(470)), ClipSpace()))
        10 10
        """
        x, y = window[:2]
        return x, y if clip.window_y_sign < 0 else Fraction(self.height) - y

    def ndc(self, pixel: RationalVector, clip: ClipSpace) -> RationalVector:
        """Return x and y in NDC of a pixel that is counted from the top.

        Examples
        --------
        >>> print(*Viewport(640, 480).ndc((Fraction(320), Fraction(0)), ClipSpace()))
        0 1
        """
        ndc_from_window = inverse(window_from_ndc(self.width, self.height, clip))
        return apply(ndc_from_window, (*self.pixel(pixel, clip), ZERO, ONE))[:2]


def read_viewport(given: object, name: str) -> Viewport:
    """Read a window's width and height, in whole pixels."""
    if isinstance(given, Viewport):
        return given
    return Viewport(*map(float, vector(given, name, size=2)))


def window_from_ndc(width: float, height: float, clip: ClipSpace) -> RationalMatrix:
    """Build the map to the window: x and y in pixels, z the window depth from 0 to 1.

    Examples
    --------
    >>> from nmatrix.linear.projection import clip_space
    >>> for row in window_from_ndc(640, 480, clip_space("direct3d", "clip"))[:3]:
    ...     print(*row)
    320 0 0 320
    0 -240 0 240
    0 0 1 0
    """
    half_width, half_height = Fraction(width) / 2, Fraction(height) / 2
    flip = clip.window_y_sign * clip.y_sign
    slope, offset = WINDOW_DEPTH[clip.depth]
    return (
        (half_width, ZERO, ZERO, half_width),
        (ZERO, flip * half_height, ZERO, half_height),
        (ZERO, ZERO, slope, offset),
        (ZERO, ZERO, ZERO, ONE),
    )


def ndc_depth(depth: Fraction, within: DepthRange) -> Fraction:
    """Return z in NDC of a window depth.

    Examples
    --------
    >>> print(ndc_depth(Fraction(1, 2), DepthRange.MINUS_ONE_TO_ONE))
    0
    """
    slope, offset = WINDOW_DEPTH[within]
    return (depth - offset) / slope
