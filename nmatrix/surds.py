"""Sums of square roots as exact numbers: √3/2, (√6 − √2)/4.

A surd is q₁√d₁ + q₂√d₂ + …, each q a fraction and each d a whole number without a square factor.
Such roots are independent over the fractions, so two surds are equal only if they are written the
same, and one is 0 only if nothing is left of it: what is decided here is decided exactly.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from math import gcd, isfinite, isqrt, lcm
from typing import TypeGuard

BITS = 280  # of a root, where a number between two bounds is asked for
MOST_TERMS = 16  # of a sum: four roots that are independent
MOST_BITS = 4096  # of a denominator before a root
TRIED = 10_000  # divisors; two factors beyond them leave a number of at least TRIED²
LONGEST = 12  # characters of a number that a person still reads as one
# A float is looked for among fractions with such denominators, and among the roots of such
# fractions up to a size: there are so few of them that no other float is one by chance.
OF_FRACTIONS, OF_SQUARES, LARGEST_ROOT = 1000, 10_000, 100
CLOSE = Fraction(1, 2**50)  # how far the square of a float may be from that of the root it is of

Rational = int | Fraction


class TooManyRootsError(ArithmeticError):
    """A sum of more or longer terms than are kept, or a root whose square factors are not known."""


@dataclass(frozen=True)
class Surd:
    """A sum of square roots times fractions that is no fraction itself.

    `terms` pairs each number under a root with what stands before the root, the smallest first;
    what has no root stands under 1. It has the operators of a fraction, and what comes out
    rational is a `Fraction`.

    Raises
    ------
    TooManyRootsError
        From an operation whose result would be a longer sum.

    Examples
    --------
    >>> half_root = root(Fraction(3, 4))
    >>> print(half_root, half_root * half_root, 1 / (half_root + 1))
    √3/2 3/4 4 − 2√3
    """

    terms: tuple[tuple[int, Fraction], ...]

    def __neg__(self) -> Surd:
        return Surd(tuple((d, -q) for d, q in self.terms))

    def __add__(self, other: Rational | Surd) -> Fraction | Surd:
        terms = _terms(other)
        return NotImplemented if terms is None else _sum((*self.terms, *terms))

    def __sub__(self, other: Rational | Surd) -> Fraction | Surd:
        return NotImplemented if _terms(other) is None else self + -other

    def __rsub__(self, other: Rational) -> Fraction | Surd:
        return -self + other

    def __mul__(self, other: Rational | Surd) -> Fraction | Surd:
        terms = _terms(other)
        if terms is None:
            return NotImplemented
        products = []
        for d, q in self.terms:
            for e, r in terms:
                shared = gcd(d, e)  # √(g d)·√(g e) = g √(d e)
                products.append((d // shared * (e // shared), q * r * shared))
        return _sum(products)

    def __truediv__(self, other: Rational | Surd) -> Fraction | Surd:
        if isinstance(other, Surd):
            return self * other._reciprocal()
        return NotImplemented if _terms(other) is None else self * (1 / Fraction(other))

    def __rtruediv__(self, other: Rational) -> Fraction | Surd:
        return self._reciprocal() * other

    __radd__ = __add__
    __rmul__ = __mul__

    def _reciprocal(self) -> Surd | Fraction:
        """Make the denominator rational: 1/(u + v√p) = (u − v√p)/(u² − p v²), root by root."""
        p = self._a_factor()
        conjugate = _sum([(d, -q if d % p == 0 else q) for d, q in self.terms])
        return conjugate / (self * conjugate)

    def _a_factor(self) -> int:
        """Find a number that divides some of the numbers under the roots and is prime to others."""
        smallest = next(d for d, _ in self.terms if d > 1)
        for d, _ in self.terms:
            shared = gcd(smallest, d)
            if shared > 1:
                smallest = shared
        return smallest

    def __abs__(self) -> Surd:
        return -self if self < 0 else self

    def __lt__(self, other: Rational | Surd) -> bool:
        if _terms(other) is None:
            return NotImplemented
        difference = self - other
        return difference < 0 if isinstance(difference, Fraction) else difference._sign() < 0

    def __gt__(self, other: Rational | Surd) -> bool:
        if _terms(other) is None:
            return NotImplemented
        return other != self and not self < other

    def __le__(self, other: Rational | Surd) -> bool:
        return not self > other

    def __ge__(self, other: Rational | Surd) -> bool:
        return not self < other

    def _sign(self) -> int:
        bits = BITS
        while True:  # it is not 0, so enough bits tell
            low, high = self.between(bits)
            if low > 0 or high < 0:
                return 1 if low > 0 else -1
            bits *= 2

    def between(self, bits: int = BITS) -> tuple[Fraction, Fraction]:
        """Bound it from below and above, each root to so many bits behind the point.

        Examples
        --------
        >>> low, high = root(Fraction(2)).between(4)
        >>> print(low, high)
        11/8 23/16
        """
        low = high = Fraction(0)
        for d, q in self.terms:
            whole = isqrt(d << (2 * bits))
            ends = [Fraction(end, 1 << bits) * q for end in (whole, whole + (d > 1))]
            low, high = low + min(ends), high + max(ends)
        return low, high

    def near(self) -> tuple[Fraction, Fraction]:
        """Bound it to `BITS` bits of itself, however much its terms cancel.

        Examples
        --------
        >>> low, high = (99 - 70 * root(2)).near()
        >>> 0 < high - low < low / 10**80
        True
        """
        bits = BITS
        while True:
            low, high = self.between(bits)
            if low * high > 0 and (high - low) * 2**BITS <= min(abs(low), abs(high)):
                return low, high
            bits *= 2

    def __float__(self) -> float:
        low, high = self.near()
        return float((low + high) / 2)

    def __str__(self) -> str:
        """Write it over one denominator, as one does by hand.

        Examples
        --------
        >>> print((root(6) - root(2)) / 4, root(Fraction(8, 9)), 1 - root(5))
        (√6 − √2)/4 2√2/3 1 − √5
        """
        tops, bottom = self.over_one_denominator
        written = "".join(_written(d, top, is_first=not i) for i, (d, top) in enumerate(tops))
        if bottom == 1:
            return written
        if all(top < 0 for _, top in tops):  # −(√2 + √6)/4
            return f"−{-self}"
        return f"{written}/{bottom}" if len(tops) == 1 else f"({written})/{bottom}"

    @property
    def over_one_denominator(self) -> tuple[list[tuple[int, int]], int]:
        """Its roots, each with the whole number before it, and what divides their sum.

        Examples
        --------
        >>> ((root(6) - root(2)) / 4).over_one_denominator
        ([(6, 1), (2, -1)], 4)
        """
        bottom = lcm(*(q.denominator for _, q in self.terms))
        tops = [(d, int(q * bottom)) for d, q in self.terms]
        return sorted(tops, key=lambda term: term[1] < 0), bottom  # no sum begins with a minus


def root(square: Rational) -> Fraction | Surd:
    """Take the square root of a number ≥ 0, exactly.

    Raises
    ------
    TooManyRootsError
        If the number is so large that nobody knows its square factors.

    Examples
    --------
    >>> print(root(Fraction(9, 4)), root(Fraction(1, 2)), root(Fraction(12)))
    3/2 √2/2 2√3
    """
    value = Fraction(square)
    outside, inside = _square_factor(value.numerator * value.denominator)
    return _sum([(inside, Fraction(outside, value.denominator))])


def sine(degrees: Rational) -> Fraction | Surd | None:
    """Find the sine of an angle if it is a sum of roots of fractions; None if it is none.

    Of a rational number of degrees it is one for multiples of 15° and odd multiples of 18°, and
    for no others.

    Examples
    --------
    >>> print(sine(-60), sine(Fraction(75)), sine(20))
    −√3/2 (√2 + √6)/4 None
    """
    turned = Fraction(degrees) % 360
    sharp = min(turned % 180, 180 - turned % 180)
    found = SINES.get(sharp)
    return -found if found is not None and turned > 180 else found


def is_short(value: object) -> TypeGuard[Fraction | Surd]:
    """Tell whether a number is exact and short enough to be read as one.

    Examples
    --------
    >>> is_short(Fraction(1234, 5678)), is_short(Fraction(10**9, 7**9)), is_short(0.5)
    (True, False, False)
    """
    if not isinstance(value, (Fraction, Surd)):
        return False
    parts = [q for _, q in value.terms] if isinstance(value, Surd) else [value]
    most = 10**LONGEST  # what is longer may have more digits than Python writes
    return (
        all(max(abs(q.numerator), q.denominator) < most for q in parts)
        and all(d < most for d, _ in _terms(value) or ())
        and len(str(value)) <= LONGEST
    )


def short_number(value: float | Fraction | Surd) -> Fraction | Surd | None:
    """Find the short exact number that a value is; None where there is none.

    A float64 is taken for p/q or (p/q)√d only if it is the float64 nearest to that number, with q
    at most 1000, or, for a root, up to 100 in size and with a square whose denominator is at most
    10 000. Of random floats between 1/100 and 100 less than one in ten million is one.

    Examples
    --------
    >>> print(short_number(1 / 3), short_number(3**0.5 / 2), short_number(0.1), short_number(2.0))
    1/3 √3/2 1/10 2
    >>> print(short_number(0.333333), short_number(0.30000000000000004), short_number(0.866025))
    None None None
    """
    if isinstance(value, float):
        return _nearest_short(value) if isfinite(value) else None
    exact = Fraction(value) if isinstance(value, int) else value
    return exact if is_short(exact) else None


def _nearest_short(value: float) -> Fraction | Surd | None:
    exact = Fraction(value)
    ratio = exact.limit_denominator(OF_FRACTIONS)
    if float(ratio) == value:
        return ratio if is_short(ratio) else None
    square = exact * exact
    near = square.limit_denominator(OF_SQUARES)
    if abs(exact) > LARGEST_ROOT or not near or abs(near - square) > CLOSE * square:
        return None
    found = root(near) if value > 0 else -root(near)
    return found if is_short(found) and float(found) == value else None


def _terms(value: object) -> tuple[tuple[int, Fraction], ...] | None:
    if isinstance(value, Surd):
        return value.terms
    return ((1, Fraction(value)),) if isinstance(value, (int, Fraction)) else None


def _sum(terms: Iterable[tuple[int, Fraction]]) -> Fraction | Surd:
    total: dict[int, Fraction] = {}
    for d, q in terms:
        total[d] = total.get(d, Fraction(0)) + q
    left = tuple(sorted((d, q) for d, q in total.items() if q))
    if len(left) > MOST_TERMS:
        raise TooManyRootsError(f"a sum of {len(left)} roots")
    if any(q.denominator.bit_length() > MOST_BITS for _, q in left):
        raise TooManyRootsError(f"a sum of roots over more than {MOST_BITS} bits")
    if not left:
        return Fraction(0)
    return left[0][1] if len(left) == 1 and left[0][0] == 1 else Surd(left)


def _square_factor(n: int) -> tuple[int, int]:
    """Write n as k² d, where d has no square factor: 12 = 2² · 3."""
    if n == 0:
        return 0, 1
    outside, inside, left = 1, 1, n
    whole = isqrt(n)
    if whole * whole == n:
        return whole, 1
    divisor = 2
    while divisor <= TRIED and divisor * divisor <= left:
        while left % (divisor * divisor) == 0:
            left //= divisor * divisor
            outside *= divisor
        if left % divisor == 0:
            left //= divisor
            inside *= divisor
        divisor += 1 if divisor == 2 else 2
    whole = isqrt(left)
    if whole * whole == left:
        return outside * whole, inside
    if left > TRIED**3:  # with three factors, two of them may be the same
        raise TooManyRootsError(f"the square factors of a number of {left.bit_length()} bits")
    return outside, inside * left


def _written(under: int, before: int, *, is_first: bool) -> str:
    sign = ("−" if before < 0 else "") if is_first else (" − " if before < 0 else " + ")
    factor = "" if abs(before) == 1 and under > 1 else str(abs(before))
    return f"{sign}{factor}{f'√{under}' if under > 1 else ''}"


SINES: dict[Fraction, Fraction | Surd] = {
    Fraction(0): Fraction(0),
    Fraction(15): (root(6) - root(2)) / 4,
    Fraction(18): (root(5) - 1) / 4,
    Fraction(30): Fraction(1, 2),
    Fraction(45): root(2) / 2,
    Fraction(54): (root(5) + 1) / 4,
    Fraction(60): root(3) / 2,
    Fraction(75): (root(6) + root(2)) / 4,
    Fraction(90): Fraction(1),
}
