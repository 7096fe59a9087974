"""The calculator's numbers: fractions, roots, intervals around other irrationals, rounded floats.

All have the operators of a fraction, so the formulas of `linear.rational` serve them all. Fractions
and sums of roots (`Surd`) are exact. What is computed from an interval is an interval, so it is
known how much is known; and wherever it matters whether a number is 0, `is_zero` is asked, which
says yes, no, or that nobody knows.
"""

from __future__ import annotations

import math
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction
from math import copysign, inf, isfinite, isnan, isqrt, nan

from nmatrix.calculator.arithmetic.symbolic import Symbolic
from nmatrix.errors import IllegalValueError, NoAnswerError, quantity
from nmatrix.linear.angle import DEGREES, PI, Angle, arctangent
from nmatrix.linear.rounding import DECIMALS_PER_BIT, nearest, short_text
from nmatrix.surds import BITS as ROOT_BITS
from nmatrix.surds import SINES, Surd, TooManyRootsError, sine
from nmatrix.surds import root as exact_root

SERIES = Fraction(1, 2**130)  # the relative error of a sine or an arctangent
GUARD_BITS = 16  # of an end behind the first bit that is not known
SLOWEST = 57  # degrees in which a sine changes by less than one: 180/π is more

# A sine whose square is one of these belongs to so many degrees: sin² θ = (1 − cos 2θ)/2.
DEGREES_BY_SQUARE = {
    (1 + sign * known) / 2: (90 + sign * turned) / 2
    for turned, known in SINES.items()
    for sign in (1, -1)
}

Exact = int | Fraction | Surd
PI_ENDS = (PI - Fraction(1, 10**60), PI + Fraction(1, 10**60))


class Ordered:
    """Numbers that compare where what is known of their difference decides it.

    Raises
    ------
    NoAnswerError
        From a comparison that it leaves open.
    """

    def __lt__(self, other: Exact | Number) -> bool:
        return is_negative(self - other)  # type: ignore[operator]  # each kind subtracts

    def __gt__(self, other: Exact | Number) -> bool:
        return is_negative(-(self - other))  # type: ignore[operator]  # each kind subtracts

    def __le__(self, other: Exact | Number) -> bool:
        return not self > other

    def __ge__(self, other: Exact | Number) -> bool:
        return not self < other

    def __float__(self) -> float:
        return float64(self).value  # type: ignore[arg-type]  # it is one of the numbers


@dataclass(frozen=True, eq=False)
class Interval(Ordered):
    """A number between two bounds, `low` < `high`, and no more is known of it.

    Examples
    --------
    >>> third = Interval(Fraction(33, 100), Fraction(34, 100))
    >>> (1 / third).low < 3 < (1 / third).high, third * 0
    (True, Fraction(0, 1))
    """

    low: Fraction
    high: Fraction

    def __neg__(self) -> Interval:
        return Interval(-self.high, -self.low)

    def __abs__(self) -> Fraction | Interval:
        if self.low < 0 < self.high:
            return enclosed(Fraction(0), self.farthest)
        return -self if self.high <= 0 else self

    def __add__(self, other: Exact | Interval) -> Fraction | Interval:
        low, high = bounds(other)
        return enclosed(self.low + low, self.high + high)

    def __sub__(self, other: Exact | Interval) -> Fraction | Interval:
        return self + -other

    def __rsub__(self, other: Exact) -> Fraction | Interval:
        return -self + other

    def __mul__(self, other: Exact | Interval) -> Fraction | Interval:
        products = [one * end for one in bounds(self) for end in bounds(other)]
        return enclosed(min(products), max(products))

    def __truediv__(self, other: Exact | Interval) -> Fraction | Interval:
        return self * (1 / (Fraction(other) if isinstance(other, int) else other))

    def __rtruediv__(self, other: Exact) -> Exact | Interval:
        is_zero(self)  # which refuses a divisor that may be 0
        return enclosed(1 / self.high, 1 / self.low) * other

    __radd__ = __add__
    __rmul__ = __mul__

    @property
    def farthest(self) -> Fraction:
        """The larger of the two bounds, without its sign."""
        return max(-self.low, self.high)

    @property
    def digits(self) -> int:
        """How many digits are known; 0 where it may be 0."""
        units = round((self.low + self.high) / 2 / self._unit)
        return len(str(abs(units))) if units else 0

    @property
    def shown(self) -> Fraction:
        """The number to the digits that are known, right to one unit of the last.

        Examples
        --------
        >>> float(Interval(Fraction(31415, 10000), Fraction(31417, 10000)).shown)
        3.142
        """
        return round((self.low + self.high) / 2 / self._unit) * self._unit

    @property
    def _unit(self) -> Fraction:
        """The power of ten that is not below the width."""
        width = self.high - self.low
        exponent = math.floor(DECIMALS_PER_BIT * _magnitude(width)) - 1
        while Fraction(10) ** exponent < width:
            exponent += 1
        return Fraction(10) ** exponent


@dataclass(frozen=True, eq=False)
class Float64(Ordered):
    """A float64: every operation is rounded, and what overflows is infinite, as in a program.

    Of a multiple of π it remembers the `times`, since as an angle that is in radians.

    Raises
    ------
    NoAnswerError
        For what is no number, as infinity minus infinity.

    Examples
    --------
    >>> (Float64(0.1) + Float64(0.2)).value, (Float64(1e308) * 10).value
    (0.30000000000000004, inf)
    """

    value: float
    times: Fraction | None = None

    def __post_init__(self) -> None:
        if isnan(self.value):
            raise NoAnswerError(
                "not a number in float64",
                "something overflowed to infinity, and this has no value there",
                f"leave {quantity('float')} out",
            )

    def __neg__(self) -> Float64:
        return Float64(-self.value, None if self.times is None else -self.times)

    def __abs__(self) -> Float64:
        return -self if self.value < 0 else self

    def __add__(self, other: Exact | Float64) -> Float64:
        y = float64(other)
        total = self.value + y.value
        if self.times is None or y.times is None:
            return Float64(total)
        return Float64(total, self.times + y.times)

    def __sub__(self, other: Exact | Float64) -> Float64:
        return self + -float64(other)

    def __rsub__(self, other: Exact) -> Float64:
        return float64(other) - self

    def __mul__(self, other: Exact | Float64) -> Float64:
        y = float64(other)
        product = self.value * y.value
        if self.times is None or not y.is_plain:
            return Float64(
                product, y.times * Fraction(self.value) if y.times and self.is_plain else None
            )
        return Float64(product, self.times * Fraction(y.value))

    def __truediv__(self, other: Exact | Float64) -> Float64:
        y = float64(other)
        quotient = self.value / y.value
        if self.times is None or not y.is_plain:
            return Float64(quotient)
        return Float64(quotient, self.times / Fraction(y.value))

    @property
    def is_plain(self) -> bool:
        """Whether it is finite and no multiple of π: another one times it is a multiple again."""
        return self.times is None and isfinite(self.value)

    def __rtruediv__(self, other: Exact) -> Float64:
        return float64(other) / self

    def __eq__(self, other: object) -> bool:
        return self.value == (other.value if isinstance(other, Float64) else other)

    def __hash__(self) -> int:
        return hash(self.value)

    __radd__ = __add__
    __rmul__ = __mul__


@dataclass(frozen=True, eq=False)
class PiMultiple(Ordered):
    """A fraction times π: as an angle it is in radians, and exact.

    Examples
    --------
    >>> half = PiMultiple(Fraction(1, 2))
    >>> (half + half / 3).times, half / half, (half * half).digits
    (Fraction(2, 3), Fraction(1, 1), 60)
    """

    times: Fraction

    @property
    def between(self) -> Interval:
        """Its bounds."""
        ends = [end * self.times for end in PI_ENDS]
        return Interval(min(ends), max(ends))

    def __neg__(self) -> PiMultiple:
        return PiMultiple(-self.times)

    def __abs__(self) -> PiMultiple:
        return PiMultiple(abs(self.times))

    def __add__(self, other: Exact | Interval | PiMultiple) -> Exact | Interval | PiMultiple:
        if isinstance(other, Symbolic):
            return NotImplemented
        if not isinstance(other, PiMultiple):
            return self if other == 0 else self.between + other
        total = self.times + other.times
        return PiMultiple(total) if total else Fraction(0)

    def __sub__(self, other: Exact | Interval | PiMultiple) -> Exact | Interval | PiMultiple:
        return self + -other

    def __rsub__(self, other: Exact | Interval) -> Exact | Interval | PiMultiple:
        return -self + other

    def __mul__(self, other: Exact | Interval | PiMultiple) -> Exact | Interval | PiMultiple:
        if isinstance(other, Symbolic):
            return NotImplemented
        if isinstance(other, int | Fraction):
            return PiMultiple(self.times * other) if other else Fraction(0)
        return self.between * (other.between if isinstance(other, PiMultiple) else other)

    def __truediv__(self, other: Exact | Interval | PiMultiple) -> Exact | Interval | PiMultiple:
        if isinstance(other, Symbolic):
            return NotImplemented
        if isinstance(other, PiMultiple):
            return self.times / other.times
        if isinstance(other, int | Fraction):
            return PiMultiple(self.times / other)
        return self.between / other

    def __rtruediv__(self, other: Exact | Interval) -> Exact | Interval:
        return 1 / self.between * other

    __radd__ = __add__
    __rmul__ = __mul__


Number = Fraction | Surd | Interval | PiMultiple | Float64 | Symbolic


def is_zero(x: Exact | Number) -> bool:
    """Decide if a number is 0.

    Raises
    ------
    NoAnswerError
        Where what is known of it leaves both possible.

    Examples
    --------
    >>> is_zero(root(Fraction(2)) - 1), is_zero(Float64(0.0))
    (False, True)
    """
    if not isinstance(x, Interval):
        return x == 0  # a multiple of π is never 0
    if x.low <= 0 <= x.high:
        raise NoAnswerError(
            "a number in which roots or sines cancel",
            f"it is within {short_text(x.farthest, 2)} of 0, more is not known, "
            "and here it matters whether it is 0",
            "use rational entries",
        )
    return False


def is_negative(x: Exact | Number) -> bool:
    """Decide if a number is below 0.

    Raises
    ------
    NoAnswerError
        Where what is known of it leaves both possible.
    """
    if is_zero(x):
        return False
    if isinstance(x, Symbolic):
        return x.is_negative
    return x.value < 0 if isinstance(x, Float64) else bounds(x)[1] <= 0


def may_be_positive(x: Exact | Number) -> bool:
    """Tell whether what is known of a number leaves it above 0, or 0."""
    return x.value >= 0 if isinstance(x, Float64) else bounds(x)[1] >= 0


def size(x: Exact | Number) -> Fraction | float:
    """Measure how far from 0 a number may be."""
    if isinstance(x, Symbolic):
        return Fraction(bool(x))  # any letter may be a pivot
    if isinstance(x, Float64):
        return abs(x.value)
    low, high = bounds(x)
    return max(-low, high)


def bits_of(x: Number) -> int:
    """Count the bits of the longest integer that a number is written with."""
    if isinstance(x, Float64):
        return 64
    if isinstance(x, Surd):
        return max(max(d.bit_length(), bits_of(q)) for d, q in x.terms)
    if isinstance(x, PiMultiple):
        return bits_of(x.times)
    if isinstance(x, Symbolic):
        return 1  # its length is bounded where it is simplified
    return max(n.bit_length() for end in bounds(x) for n in end.as_integer_ratio())


def shown(x: Number) -> Fraction | Surd | float:
    """Take what may be printed of a number.

    Raises
    ------
    NoAnswerError
        If not one digit of it is known.
    """
    if isinstance(x, PiMultiple):
        x = x.between
    if isinstance(x, Interval):
        if not x.digits:
            raise NoAnswerError(
                "a number in which roots or sines cancel",
                f"it is within {short_text(x.farthest, 2)} of 0, and no digit of it is known",
                "use rational entries, or angles whose sines are roots",
            )
        return x.shown
    if isinstance(x, Symbolic):
        raise x.unknown
    return x.value if isinstance(x, Float64) else x


def enclosure(x: Number) -> Number:
    """Put a sum of roots between its bounds; other numbers stay."""
    return enclosed(*x.near()) if isinstance(x, Surd) else x


def float64(x: Exact | Number) -> Float64:
    """Round a number to the nearest float64, to infinity beyond the largest."""
    if isinstance(x, Float64):
        return x
    low, high = bounds(x)
    middle = (low + high) / 2
    times = x.times if isinstance(x, PiMultiple) else None
    try:
        return Float64(nearest(middle), times)
    except IllegalValueError:
        return Float64(copysign(inf, middle))


def enclosed(low: Fraction, high: Fraction) -> Fraction | Interval:
    """Make an interval, its ends rounded outwards to the bits that matter, or one exact number."""
    if low == high:
        return low
    grid = Fraction(2) ** (GUARD_BITS - _magnitude(high - low))
    return Interval(math.floor(low * grid) / grid, math.ceil(high * grid) / grid)


def root(square: Exact | Number) -> Number:
    """Take a square root: exact where it is a sum of roots, else known to 280 bits.

    Of an interval only the part from 0 upwards can be a square.

    Examples
    --------
    >>> print(root(Fraction(9, 4)), root(Fraction(3, 4)), root(Float64(2.0)).value)
    3/2 √3/2 1.4142135623730951
    >>> print(root(2 + exact_root(3)))
    (√2 + √6)/2
    """
    if isinstance(square, Float64):
        return Float64(math.sqrt(square.value))
    if isinstance(square, Symbolic):
        return square.root()
    with suppress(TooManyRootsError):
        if isinstance(square, Fraction):
            return exact_root(square)
        if isinstance(square, Surd) and (found := _unnested(square)) is not None:
            return found
    low, high = bounds(square)
    return enclosed(_root_ends(max(low, Fraction(0)))[0], _root_ends(high)[1])


def _unnested(square: Surd) -> Fraction | Surd | None:
    """Write √(a + q√d) as √((a + c)/2) ± √((a − c)/2), where c = √(a² − q²d) is rational."""
    if len(square.terms) > 2 or (square.terms[0][0] != 1):
        return None
    (_, a), (d, q) = square.terms
    rest = a * a - q * q * d
    c = exact_root(rest) if rest >= 0 else None
    if not isinstance(c, Fraction) or a < c:
        return None
    larger, smaller = exact_root((a + c) / 2), exact_root((a - c) / 2)
    return larger + smaller if q > 0 else larger - smaller


def angle(degrees: Exact | Number) -> Angle:
    """Make the angle of so many degrees, of a multiple of π in radians.

    Its sine and cosine are of the same kind of number.

    Examples
    --------
    >>> print(angle(Fraction(30)).cosine, angle(Fraction(75)).sine, angle(Fraction(1)).sine.digits)
    √3/2 (√2 + √6)/4 39
    """
    if isinstance(degrees, Float64):
        turned = degrees.value if degrees.times is None else nearest(degrees.times * 180)
        exact = Angle.degrees(turned if isfinite(turned) else Float64(nan).value)
        return Angle(float64(exact.sine), float64(exact.cosine))  # type: ignore[arg-type]
    if isinstance(degrees, Symbolic):
        return Angle(*degrees.sine_and_cosine())  # type: ignore[arg-type]
    if isinstance(degrees, PiMultiple):
        degrees = in_degrees(degrees)
    return Angle(_sine(degrees), _sine(degrees + 90))  # type: ignore[arg-type]


def in_degrees(turned: Number) -> Number:
    """Tell an angle in degrees: a multiple of π is in radians, all else in degrees already."""
    times = times_pi(turned)
    if times is None:
        return turned
    return float64(times * 180) if isinstance(turned, Float64) else times * 180


def times_pi(x: Number) -> Fraction | None:
    """Tell which multiple of π a number is, if it is one."""
    return x.times if isinstance(x, PiMultiple | Float64) else None


def degrees_of(sine: Exact | Number, cosine: Exact | Number) -> Number:
    """Measure an angle in degrees, over −180 to 180, by its sine and cosine times any one factor.

    Raises
    ------
    NoAnswerError
        For two zeros, and where what is known leaves open if they are, or on which side of the
        half turn they lie.

    Examples
    --------
    >>> print(degrees_of(Fraction(0), Fraction(-7)), degrees_of(exact_root(3), Fraction(-1)))
    180 120
    >>> degrees_of(Float64(1.0), Float64(1.0)).value
    45.0
    """
    if isinstance(sine, Float64) or isinstance(cosine, Float64):
        return Float64(math.degrees(math.atan2(float64(sine).value, float64(cosine).value)))
    sharp = exact_degrees(sine * sine, cosine * cosine)
    if sharp is not None:
        turned = 180 - sharp if cosine < 0 else sharp
        return -turned if sine < 0 else turned
    (low, high), (left, right) = bounds(sine), bounds(cosine)
    if low <= 0 <= high and left <= 0 <= right and is_zero(sine) and is_zero(cosine):
        raise NoAnswerError("the angle of 0 and 0", "they point nowhere", "use other numbers")
    if low < 0 <= high and left <= 0:
        is_zero(sine)  # which refuses what may be a half turn to either side
    # Over a box of sines and cosines the angle is greatest and least at corners.
    corners = [end for y in (low, high) for x in (left, right) for end in _degrees_ends(y, x)]
    return enclosed(min(corners), max(corners))


def exact_degrees(sine_square: Exact | Number, cosine_square: Exact | Number) -> Fraction | None:
    """Tell an angle up to 90° by its squared sine and cosine, times any one factor.

    None where one of them is no sum of roots, or the angle no rational number of degrees: no other
    such angles have squares that are sums of roots.

    Examples
    --------
    >>> print(exact_degrees(Fraction(1), Fraction(3)), exact_degrees(Fraction(1), Fraction(2)))
    30 None
    """
    if not isinstance(sine_square, Fraction | Surd) or not isinstance(
        cosine_square, Fraction | Surd
    ):
        return None
    total = sine_square + cosine_square
    return DEGREES_BY_SQUARE.get(sine_square / total) if total else None


def bounds(x: Exact | Number) -> tuple[Fraction, Fraction]:
    """Tell between which two fractions a number lies; they are equal where it is one itself.

    Examples
    --------
    >>> bounds(Fraction(1, 2)) == (Fraction(1, 2), Fraction(1, 2))
    True
    """
    if isinstance(x, PiMultiple):
        x = x.between
    if isinstance(x, Interval):
        return x.low, x.high
    if isinstance(x, Surd):
        return x.near()
    if isinstance(x, Symbolic):
        raise x.unknown
    exact = Fraction(x.value if isinstance(x, Float64) else x)
    return exact, exact


def _magnitude(x: Fraction) -> int:
    """Count the bits before the point, or minus the zeros behind it."""
    return x.numerator.bit_length() - x.denominator.bit_length()


def _root_ends(square: Fraction) -> tuple[Fraction, Fraction]:
    product = (square.numerator * square.denominator) << (2 * ROOT_BITS)
    whole, bottom = isqrt(product), square.denominator << ROOT_BITS
    return Fraction(whole, bottom), Fraction(whole + (whole * whole != product), bottom)


def _sine(degrees: Exact | Interval) -> Exact | Interval:
    if not isinstance(degrees, Fraction):
        low, high = bounds(degrees)
        least, most = bounds(_sine((low + high) / 2))
        change = (high - low) / 2 / SLOWEST
        return enclosed(least - change, most + change)
    known = sine(degrees)
    if known is not None:
        return known
    found = Angle.degrees(degrees).sine
    error = abs(found) * SERIES
    return enclosed(found - error, found + error)


def _degrees_ends(sine: Fraction, cosine: Fraction) -> tuple[Fraction, Fraction]:
    if sine < 0:
        low, high = _degrees_ends(-sine, cosine)
        return -high, -low
    if not cosine:
        return Fraction(90), Fraction(90)
    sharp = arctangent(sine / abs(cosine)) * DEGREES
    low, high = sharp * (1 - SERIES), sharp * (1 + SERIES)
    return (low, high) if cosine > 0 else (180 - high, 180 - low)
