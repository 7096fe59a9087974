"""Numbers that are known to lie between two others, exactly, and the roundest number there.

People choose 0.1, 60 and 16/9, not 0.09999997: of all numbers that a measurement allows, the one
with the fewest digits is the best guess at what was typed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from fractions import Fraction
from math import ceil, floor, inf

from nmatrix.linear.rounding import spacing

Bound = Fraction | float  # a float only where it is infinite

# Beside the digits that it has, how unusual a number is: 1 is more common than 5 and 2, and these
# than the others.
USUAL = {1: 0.0, 5: 0.2, 2: 0.3}
UNUSUAL = 0.5
NO_NUMBER = 12.0  # the cost of what no short number fits
LONGEST = 20  # digits of a number that somebody may have typed


@dataclass(frozen=True)
class Interval:
    """All numbers from `low` to `high`, both included; `high` may be infinite."""

    low: Fraction
    high: Bound

    @classmethod
    def around(cls, value: Fraction, reach: Fraction) -> Interval:
        """Return all numbers that lie at most so far from a value."""
        return cls(value - reach, value + reach)

    def __contains__(self, value: Bound | int) -> bool:
        return self.low <= value <= self.high

    def __mul__(self, other: Interval | Fraction | int) -> Interval:
        """Multiply by a number, or by another interval; both are finite."""
        factors = other.ends if isinstance(other, Interval) else (Fraction(other),)
        return hull(p * q for p in self.ends for q in factors)

    @property
    def ends(self) -> tuple[Fraction, Fraction]:
        """Both ends of a finite interval."""
        return self.low, Fraction(self.high)

    @property
    def sign(self) -> int:
        """Return 1 or −1 where all numbers have that sign, else 0."""
        return int(self.low > 0) - int(self.high < 0)

    def meets(self, other: Interval | None) -> Interval | None:
        """Intersect two intervals; None stands for all numbers."""
        if other is None:
            return self
        low, high = max(self.low, other.low), min(self.high, other.high)
        return Interval(low, high) if low <= high else None

    def image(self, of: Callable[[Fraction], Fraction]) -> Interval:
        """Return the image under a monotone function of finite numbers."""
        return hull(map(of, self.ends))

    def nearest_to(self, value: Bound) -> Fraction:
        """Return the number inside that is nearest to a value, which is read as a float64."""
        if isinstance(value, Fraction):
            step = spacing(value)
            value = round(value / step) * step if value else value
        return Fraction(max(self.low, min(self.high, value)))

    def roundest(self) -> Bound:
        """Return the number with the fewest digits, nearest to the middle among equals.

        A decimal counts as the float64 that it is read as. Where infinity is allowed it is the
        answer: no digit is simpler than none. What has no short decimal, such as exactly 1/3, is
        the middle itself.

        Examples
        --------
        >>> str(Interval(Fraction("0.0996"), Fraction("0.1004")).roundest())
        '1/10'
        >>> str(Interval(Fraction("59.99"), Fraction("60.3")).roundest())
        '60'
        """
        if isinstance(self.high, float):
            return inf
        if 0 in self:
            return Fraction(0)
        if self.high < 0:
            return -Interval(-self.high, -self.low).roundest()
        middle = (self.low + self.high) / 2
        rounding = spacing(middle) / 2
        step = _power_of_ten_above(self.high)
        for _ in range(LONGEST):
            first, last = ceil((self.low - rounding) / step), floor((self.high + rounding) / step)
            if first <= last:
                return min(max(round(middle / step), first), last) * step
            step /= 10
        return middle


def hull(values: Iterable[Fraction]) -> Interval:
    """Return the smallest interval that holds all of the values."""
    listed = list(values)
    return Interval(min(listed), max(listed))


def quotient(top: Interval, bottom: Interval) -> Interval | None:
    """Divide; None where the divisor may be 0, so that any number may come of it."""
    return hull(p / q for p in top.ends for q in bottom.ends) if bottom.sign else None


def simplest_fraction(within: Interval) -> Fraction:
    """Return the fraction of the smallest denominator between two positive numbers.

    It is found on the Stern–Brocot tree, by the continued fractions of both.

    Examples
    --------
    >>> simplest_fraction(Interval(Fraction("1.7777"), Fraction("1.7778")))
    Fraction(16, 9)
    """
    low, high = within.low, Fraction(within.high)
    whole = -(-low.numerator // low.denominator)
    if whole <= high:
        return Fraction(whole)
    below = whole - 1
    return below + 1 / simplest_fraction(Interval(1 / (high - below), 1 / (low - below)))


def digit_cost(value: Bound) -> float:
    """Count the digits of a number, a little fewer for those that people like.

    Examples
    --------
    >>> [digit_cost(Fraction(x)) for x in ("0", "0.1", "60", "0.375")]
    [0.0, 1.0, 1.5, 3.5]
    """
    if not isinstance(value, Fraction) or not value:
        return 0.0
    mantissa, digits = abs(value) / _power_of_ten_above(abs(value)), 0
    while mantissa.denominator != 1 and digits < NO_NUMBER:
        mantissa, digits = mantissa * 10, digits + 1
    if mantissa.denominator != 1:
        return NO_NUMBER
    text = str(mantissa.numerator)
    return len(text) + USUAL.get(mantissa.numerator, UNUSUAL)


def ratio_cost(value: Bound) -> float:
    """Count the digits of a ratio, as a decimal or as p/q.

    Examples
    --------
    >>> ratio_cost(Fraction(16, 9)), ratio_cost(Fraction("1.5")), ratio_cost(Fraction(1))
    (3.5, 2.5, 0.0)
    """
    if value == 1:
        return 0.0
    if not isinstance(value, Fraction):
        return digit_cost(value)
    as_fraction = len(str(value.numerator)) + len(str(value.denominator)) + UNUSUAL
    return min(digit_cost(value), as_fraction)


def roundest_ratio(within: Interval) -> Fraction:
    """Return the ratio that people would write, as a decimal or as p/q, between positive bounds.

    Examples
    --------
    >>> roundest_ratio(Interval(Fraction("1.77777"), Fraction("1.77779")))
    Fraction(16, 9)
    """
    found = (Fraction(within.roundest()), simplest_fraction(within))
    return min(found, key=ratio_cost)


def _power_of_ten_above(value: Fraction) -> Fraction:
    digits = len(str(value.numerator)) - len(str(value.denominator))
    return Fraction(10) ** (digits + 1)
