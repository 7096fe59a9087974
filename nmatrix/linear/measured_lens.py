"""Lenses as cameras are measured: an angle across, millimetres, pixels, four angles.

Each is a rectangle at distance 1 from the eye, whatever near is: its four sides are tangents. From
there on it is a perspective view like any other.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

from nmatrix.errors import IllegalValueError, quantity
from nmatrix.linear.angle import Angle, float_turn
from nmatrix.linear.projection import Sides
from nmatrix.linear.rational import RationalVector, exactly
from nmatrix.linear.values import named, number, read_fields, vector
from nmatrix.linear.viewport import Viewport
from nmatrix.report import Number, Vector

Turn = Callable[[Fraction], Angle]  # of degrees
Read = Callable[[Number], Fraction]


@dataclass(frozen=True)
class HorizontalField:
    """A field of view from left to right, in degrees; the height follows from the aspect."""

    degrees: float

    def __post_init__(self) -> None:
        read_fields(self, degrees=named("fov_x", float_turn))
        check_field(self.degrees, "fov_x", "horizontal")

    def half(self, turn: Turn, read: Read) -> Angle:
        """Make the angle from the view axis to the right side."""
        return turn(read(self.degrees) / 2)


@dataclass(frozen=True)
class FilmBack:
    """A focal length before a sensor of so much width and height, all in one unit.

    Only their ratio counts, so millimetres are a habit. In a picture of another aspect the sensor's
    width is what is seen across if that is 1 or more, else its height is what is seen upwards.
    """

    focal: Number
    sensor: Vector

    def __post_init__(self) -> None:
        read_fields(self, focal=number, sensor=lambda given, name: vector(given, name, size=2))
        if not self.focal > 0:
            raise IllegalValueError(
                f"{quantity('focal')} ({float(self.focal):g})",
                "the lens stands before the sensor, at a distance above 0",
                f"try {quantity('focal')} 50",
            )
        if not min(self.sensor) > 0:
            raise IllegalValueError(
                f"{quantity('sensor')} ({' '.join(f'{float(x):g}' for x in self.sensor)})",
                "width and height of the sensor are above 0",
                f"try {quantity('sensor')} 36 24",
            )

    @property
    def aspect(self) -> Fraction:
        """Width over height of the sensor."""
        width, height = self.sensor
        return Fraction(width) / Fraction(height)


@dataclass(frozen=True)
class Intrinsics:
    """Focal lengths and principal point in pixels, counted from the image's upper left corner.

    The middle of the first pixel is (0.5, 0.5), as COLMAP counts; OpenCV calls it (0, 0).
    """

    fx: Number
    fy: Number
    cx: Number
    cy: Number

    def __post_init__(self) -> None:
        read_fields(self, fx=number, fy=number, cx=number, cy=number)
        if not min(self.fx, self.fy) > 0:
            raise IllegalValueError(
                f"{quantity('intrinsics')} (fx {float(self.fx):g}, fy {float(self.fy):g})",
                "focal lengths are above 0",
                f"turn the image by {quantity('clip_y')} or by the pose, not by a sign",
            )


@dataclass(frozen=True)
class SideAngles:
    """The angles from the view axis to the four sides, in degrees, left and down negative."""

    left: float
    right: float
    down: float
    up: float

    def __post_init__(self) -> None:
        read_fields(self, left=float_turn, right=float_turn, down=float_turn, up=float_turn)
        for side in ("left", "right", "down", "up"):
            degrees = getattr(self, side)
            if not -90 < degrees < 90:
                raise IllegalValueError(
                    f"{quantity('angles')} ({side} {degrees:g})",
                    "a side lies less than 90 degrees from the view axis",
                    f"try {quantity('angles')} -45 45 -45 45",
                )


MeasuredLens = HorizontalField | FilmBack | Intrinsics | SideAngles


def check_field(degrees: float, name: str, direction: str) -> None:
    """Refuse a field of view outside (0°, 180°)."""
    if not 0 < degrees < 180:
        raise IllegalValueError(
            f"{quantity(name)} ({degrees:g})",
            f"a {direction} field of view lies between 0 and 180 degrees, both excluded",
            f"try {quantity(name)} 60",
        )


def sides_at_distance_one(
    lens: MeasuredLens,
    aspect: Fraction,
    viewport: Viewport | None,
    turn: Turn = Angle.degrees,
    read: Read = exactly,
) -> Sides:
    """Find left, right, bottom and top of what is seen at distance 1 from the eye.

    Rational numbers stay exact, tangents are as exact as the sines and cosines of `turn`, known to
    130 bits mostly; `read` makes fractions of the numbers. Four angles and intrinsics bring
    their own aspect; intrinsics are pixels of the viewport.

    Raises
    ------
    IllegalValueError
        For intrinsics without a viewport.

    Examples
    --------
    >>> print(*sides_at_distance_one(FilmBack(50, (36, 24)), Fraction(16, 9), None))
    -9/25 9/25 -81/400 81/400
    >>> pixels = Intrinsics(500, 500, 300, 250)
    >>> print(*sides_at_distance_one(pixels, Fraction(1), Viewport(640, 480)))
    -3/5 17/25 -23/50 1/2
    """
    match lens:
        case HorizontalField():
            right = _tangent(lens.half(turn, read))
            return _centred(right, right / aspect)
        case FilmBack():
            width, height = (read(side) / (2 * read(lens.focal)) for side in lens.sensor)
            return (
                _centred(width, width / aspect)
                if aspect >= 1
                else _centred(height * aspect, height)
            )
        case Intrinsics():
            return _sides_in_pixels(lens, viewport, read)
        case SideAngles():
            angles = (lens.left, lens.right, lens.down, lens.up)
            left, right, bottom, top = (_tangent(turn(read(one))) for one in angles)
            return left, right, bottom, top


def intrinsics_of(sides: Sides, viewport: Viewport) -> RationalVector:
    """Find fx, fy, cx, cy of the image in which a lens shows its rectangle at distance 1.

    A lens that mirrors the image has a negative focal length.

    Examples
    --------
    >>> print(*intrinsics_of(tuple(map(Fraction, (-1, 1, -1, 1))), Viewport(640, 480)))
    320 240 320 240
    """
    left, right, bottom, top = sides
    fx = Fraction(viewport.width) / (right - left)
    fy = Fraction(viewport.height) / (top - bottom)
    return fx, fy, -left * fx, top * fy


def _sides_in_pixels(lens: Intrinsics, viewport: Viewport | None, read: Read) -> Sides:
    if viewport is None:
        raise IllegalValueError(
            f"{quantity('intrinsics')}",
            "they are pixels of an image, and its size is not given",
            f"add {quantity('viewport')} WIDTH HEIGHT",
        )
    fx, fy, cx, cy = map(read, (lens.fx, lens.fy, lens.cx, lens.cy))
    width, height = Fraction(viewport.width), Fraction(viewport.height)
    return -cx / fx, (width - cx) / fx, (cy - height) / fy, cy / fy


def _tangent(angle: Angle) -> Fraction:
    return angle.sine / angle.cosine


def _centred(right: Fraction, top: Fraction) -> Sides:
    return -right, right, -top, top
