"""Angles from exact tangents, against series of many digits."""

from __future__ import annotations

import random
from fractions import Fraction

import mpmath

from nmatrix.linear.angle import arctangent, exact_angle_between
from nmatrix.linear.rounding import nearest


def exact(value: Fraction | int) -> mpmath.mpf:
    found = Fraction(value)
    return mpmath.mpf(found.numerator) / found.denominator


def test_arctangents_and_angles_are_right_to_the_last_bit_kept() -> None:
    numbers = random.Random(4)
    with mpmath.workdps(400):
        for _ in range(300):
            t = Fraction(2) ** numbers.randint(-900, 900) * Fraction(numbers.random() + 0.5)
            assert abs(exact(arctangent(t)) / mpmath.atan(exact(t)) - 1) < mpmath.mpf(2) ** -130
        for _ in range(300):
            a, b = ([numbers.randint(-99, 99) or 1 for _ in range(3)] for _ in range(2))
            c = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
            sine = mpmath.sqrt(sum(x * x for x in c))
            angle = mpmath.atan2(sine, sum(x * y for x, y in zip(a, b, strict=True)))
            found = exact_angle_between(a, b)
            assert abs(exact(found) - angle) <= mpmath.mpf(2) ** -130 * angle
            assert nearest(found) == float(angle)
