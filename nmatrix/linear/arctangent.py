"""Angles from exact tangents: series on integers, right to a relative 2⁻¹³⁰ before any rounding.

t is a tangent between 0 and 1; everything else is reduced to one, and the rest is a multiple of
a quarter turn.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import isqrt

from nmatrix.linear.angle import PI

BITS = 160  # 130 to keep, the others for what the halvings and the series cut off
HALVINGS = 8  # atan t = 2⁸ · atan of something below 2⁻⁸: ten terms of the series are left


def arctangent(tangent: Fraction) -> Fraction:
    """Return arctan of a number ≥ 0 in radians, however tiny or huge it is.

    Examples
    --------
    >>> float(arctangent(Fraction(1))) * 4
    3.141592653589793
    """
    if tangent <= 1:
        return _of_square(tangent * tangent)
    return PI / 2 - _of_square(1 / tangent**2)


def angle_between(a: Sequence[int], b: Sequence[int]) -> Fraction:
    """Return the angle between two non-zero integer vectors of three in radians.

    tan = |a×b| / a·b, and |a×b|² = a² b² − (a·b)² is an integer.

    Examples
    --------
    >>> float(angle_between([1, 0, 0], [1, 10**9, 0]))
    1.5707963257948967
    """
    cosine = _dot(a, b)
    square = cosine * cosine
    sine_square = _dot(a, a) * _dot(b, b) - square
    if sine_square <= square:
        sharp = _of_square(Fraction(sine_square, square))
    else:
        sharp = PI / 2 - _of_square(Fraction(square, sine_square))
    return sharp if cosine >= 0 else PI - sharp


def _of_square(square: Fraction) -> Fraction:
    """Return arctan t for t² between 0 and 1."""
    if square == 0:
        return Fraction(0)
    # A tiny tangent takes more bits, so that its relative accuracy stays.
    bits = BITS + (square.denominator.bit_length() - square.numerator.bit_length()) // 2
    one = 1 << bits
    t = isqrt((square.numerator << (2 * bits)) // square.denominator)
    for _ in range(HALVINGS):
        t = (t << bits) // (one + isqrt((one << bits) + t * t))
    total, term, n = 0, t, 1
    squared = t * t >> bits
    while term:
        total += term // n if n % 4 == 1 else -(term // n)
        term = term * squared >> bits
        n += 2
    return Fraction(total << HALVINGS, one)


def _dot(a: Sequence[int], b: Sequence[int]) -> int:
    return sum(x * y for x, y in zip(a, b, strict=True))
