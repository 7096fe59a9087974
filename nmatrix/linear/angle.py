"""An angle as its sine and cosine, so that a quarter turn gives 0 and 1 and not 6e-17; and back.

The series run on integers with `BITS` bits behind the point and are right to a relative 2⁻¹³⁰:
what is built from them and rounded once is the nearest float64, except for rare near-ties.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from math import cos, isqrt, sin

from nmatrix.errors import IllegalValueError
from nmatrix.linear.rounding import direction, nearest
from nmatrix.linear.values import number, real
from nmatrix.report import Displayed, Quantity, Report

BITS = 160  # the others than `KNOWN_BITS` for what the halvings and the series cut off
KNOWN_BITS = 130  # of a sine
HALVINGS = 4  # arctan t = 2⁴ · arctan of something below 2⁻⁴: twenty terms of the series are left
PI = Fraction(314159265358979323846264338327950288419716939937510582097494459, 10**62)
DEGREES = 180 / PI  # in a radian


@dataclass(frozen=True)
class Angle(Displayed):
    """A turn, by the right-hand rule where it is about an axis."""

    sine: Fraction
    cosine: Fraction

    @classmethod
    def degrees(cls, value: float | Fraction) -> Angle:
        """Make the angle of so many degrees.

        Exact at multiples of 90°, and where the sine or the cosine is ±½; elsewhere right to
        2⁻¹³⁰, however large the angle is: the reduction to ±45° is exact.

        Examples
        --------
        >>> Angle.degrees(450).cosine, Angle.degrees(60).cosine
        (Fraction(0, 1), Fraction(1, 2))
        """
        turned = Fraction(number(value, "value")) % 360
        quarter = round(turned / 90)
        rest = turned - 90 * quarter
        sine, cosine = _sine_and_cosine(abs(rest))
        sine = sine if rest >= 0 else -sine
        return cls(*_after_quarter_turns(sine, cosine, quarter % 4))

    @classmethod
    def radians(cls, value: float) -> Angle:
        """Make the angle of so many radians, to the accuracy of the C library (1 ulp)."""
        size = real(value, "value")
        return cls(Fraction(sin(size)), Fraction(cos(size)))

    def half(self) -> Angle:
        """Halve an angle between 0 and 180°, from tan(θ/2) = sin θ / (1 + cos θ).

        Raises
        ------
        IllegalValueError
            For an angle below 0.
        """
        if self.sine < 0:
            raise IllegalValueError(
                f"half of {self!r}", "it is for angles from 0 to 180°", "halve −a and negate that"
            )
        bits = BITS * 2
        squared = (1 + self.cosine) / 2
        cosine = Fraction(
            isqrt((squared.numerator << (2 * bits)) // squared.denominator), 1 << bits
        )
        if cosine == 0:
            return Angle(Fraction(1), Fraction(0))
        return Angle(self.sine / (2 * cosine), cosine)

    @property
    def in_degrees(self) -> float | Fraction:
        """Return the angle in degrees, from −180 (excluded) to 180.

        The float that `degrees` makes this angle of, if there is one; else a fraction that is
        right to a relative 2⁻¹³⁰.

        Examples
        --------
        >>> Angle.degrees(30).in_degrees, Angle.degrees(-90).in_degrees
        (30.0, -90.0)
        """
        sharp = PI / 2 if self.cosine == 0 else arctangent(abs(self.sine / self.cosine))
        size = (sharp if self.cosine >= 0 else PI - sharp) * DEGREES
        exact = size if self.sine >= 0 else -size
        rounded = exact.numerator / exact.denominator
        return rounded if Angle.degrees(rounded) == self else exact

    def _repr_report_(self) -> Report:
        """Tell the angle in degrees, its sine and its cosine."""
        return Report.of_value(
            Quantity("degrees", self.in_degrees, "angle", "°"),
            Quantity("sine", nearest(self.sine), "sine"),
            Quantity("cosine", nearest(self.cosine), "cosine"),
        )

    def __repr__(self) -> str:
        """Return the call that makes this angle, or the nearest one that a float makes."""
        return f"Angle.degrees({str(float(self.in_degrees)).removesuffix('.0')})"

    def __neg__(self) -> Angle:
        return Angle(-self.sine, self.cosine)


def as_angle(value: Angle | float) -> Angle:
    """Take a plain number for radians."""
    return value if isinstance(value, Angle) else Angle.radians(value)


def direction_from_angles(alpha: Angle, beta: Angle) -> tuple[float, ...]:
    """Build the unit direction (cos α cos β, sin α, cos α sin β), each component rounded once.

    Examples
    --------
    >>> direction_from_angles(Angle.degrees(-60), Angle.degrees(-120))
    (-0.25, -0.8660254037844386, -0.4330127018922193)
    """
    exact = (alpha.cosine * beta.cosine, alpha.sine, alpha.cosine * beta.sine)
    return tuple(map(nearest, exact))


def _after_quarter_turns(sine: Fraction, cosine: Fraction, n: int) -> tuple[Fraction, Fraction]:
    for _ in range(n):
        sine, cosine = cosine, -sine
    return sine, cosine


@lru_cache(maxsize=64)  # the same few angles come again in every matrix of a scene
def _sine_and_cosine(degrees: Fraction) -> tuple[Fraction, Fraction]:
    """Return sine and cosine for 0° to 45°."""
    if degrees == 0:
        return Fraction(0), Fraction(1)
    sine, cosine = _series(degrees)
    if degrees == 30:
        sine = Fraction(1, 2)
    elif degrees == 45:
        sine = cosine
    return sine, cosine


def _series(degrees: Fraction) -> tuple[Fraction, Fraction]:
    # A tiny angle has a tiny sine: more bits, so that its relative accuracy stays.
    bits = BITS + max(0, degrees.denominator.bit_length() - degrees.numerator.bit_length())
    radians = degrees * PI / 180
    t = (radians.numerator << bits) // radians.denominator
    term, total, n = 1 << bits, [0, 0, 0, 0], 0
    while term:
        total[n % 4] += term
        n += 1
        term = (term * t >> bits) // n
    one = 1 << bits
    return Fraction(total[1] - total[3], one), Fraction(total[0] - total[2], one)


def arctangent(tangent: Fraction) -> Fraction:
    """Return arctan of a number ≥ 0 in radians, however tiny or huge it is.

    Examples
    --------
    >>> float(arctangent(Fraction(1))) * 4
    3.141592653589793
    """
    square = tangent * tangent
    total, bits = _acute(square.numerator, square.denominator)
    return Fraction(total, 1 << bits)


def exact_angle_between(a: Sequence[int], b: Sequence[int]) -> Fraction:
    """Measure the angle between two non-zero integer vectors of three, in radians.

    tan = |a×b| / a·b, and |a×b|² = a² b² − (a·b)² is an integer: an angle that is small, or nearly
    half a turn, loses nothing.

    Examples
    --------
    >>> float(exact_angle_between([1, 0, 0], [1, 10**9, 0]))
    1.5707963257948967
    """
    cosine = _dot(a, b)
    total, bits = _acute(_dot(a, a) * _dot(b, b) - cosine * cosine, cosine * cosine)
    return Fraction(total if cosine >= 0 else _pi(bits) - total, 1 << bits)


def angle_between(a: Sequence[float], b: Sequence[float]) -> float:
    """Measure the angle between two vectors in radians, correctly rounded.

    Raises
    ------
    NoAnswerError
        If one of them is the zero vector.

    Examples
    --------
    >>> angle_between((1, 0, 0), (1, 1e-200, 0))
    1e-200
    """
    return nearest(exact_angle_between(direction(a), direction(b)))


def _acute(sine_square: int, cosine_square: int) -> tuple[int, int]:
    """Return the angle up to a quarter turn with this tan², as an integer over 2ᵇⁱᵗˢ, and bits."""
    if sine_square <= cosine_square:
        return _arctangent_of_root(sine_square, cosine_square)
    total, bits = _arctangent_of_root(cosine_square, sine_square)
    return _pi(bits) // 2 - total, bits


def _arctangent_of_root(top: int, bottom: int) -> tuple[int, int]:
    """Return arctan √(top/bottom) for top ≤ bottom, as an integer over 2ᵇⁱᵗˢ, and bits."""
    if top == 0:
        return 0, BITS
    # A tiny tangent takes more bits, so that its relative accuracy stays.
    bits = BITS + (bottom.bit_length() - top.bit_length()) // 2
    one = 1 << bits
    t = isqrt((top << (2 * bits)) // bottom)
    for _ in range(HALVINGS):
        t = (t << bits) // (one + isqrt((one << bits) + t * t))
    total, term, n = 0, t, 1
    squared = t * t >> bits
    while term:
        total += term // n if n % 4 == 1 else -(term // n)
        term = term * squared >> bits
        n += 2
    return total << HALVINGS, bits


def _pi(bits: int) -> int:
    return (PI.numerator << bits) // PI.denominator


def _dot(a: Sequence[int], b: Sequence[int]) -> int:
    return sum(x * y for x, y in zip(a, b, strict=True))
