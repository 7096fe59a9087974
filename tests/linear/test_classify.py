"""Kinds of maps: the condition and the worst angle against decompositions of many digits."""

from __future__ import annotations

import random
from fractions import Fraction
from math import inf, nextafter

import mpmath
import pytest

from nmatrix.linear.classify import condition, worst_angle_deg
from nmatrix.linear.exact import LinearMap

DIGITS = 1500


def exact(value: Fraction | int) -> mpmath.mpf:
    found = Fraction(value)
    return mpmath.mpf(found.numerator) / found.denominator


def oracle(rows: list[list[float]]) -> tuple[mpmath.mpf, mpmath.mpf]:
    """Return κ and the worst angle in degrees; the eigenvalues are right to 500 digits."""
    A = mpmath.matrix([[exact(Fraction(x)) for x in row] for row in rows])
    eigenvalues = mpmath.eigsy(A.T * A, eigvals_only=True)
    kappa = mpmath.sqrt(max(eigenvalues) / min(eigenvalues))
    return kappa, mpmath.degrees(mpmath.atan((kappa - 1 / kappa) / 2))


def shear(size: float) -> list[list[float]]:
    return [[1.0, size, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]


RANDOM = random.Random(3)
CASES = [
    *(shear(size) for size in (1.0, 1e-9, 1e-16, 1e-39, 1e-45, 1e-300, 1e12)),
    [[1.0, 1e-60, 1e-70], [0.0, 1.0, 1e-60], [0.0, 0.0, 1.0]],
    [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, nextafter(2.0, inf)]],
    [[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]],
    [[1e150, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 1e-150]],
    *([[RANDOM.gauss(0, 1) for _ in range(3)] for _ in range(3)] for _ in range(20)),
]


@pytest.mark.parametrize("rows", CASES)
def test_condition_and_worst_angle_are_right_to_1e_12(rows: list[list[float]]) -> None:
    with mpmath.workdps(DIGITS):
        kappa, degrees = oracle(rows)
        found = Fraction(condition(LinearMap.of(rows)))
        assert abs(exact(found) / kappa - 1) < 1e-25
        assert abs(exact(Fraction(worst_angle_deg(LinearMap.of(rows)))) / degrees - 1) < 3e-16


def test_a_uniform_scale_bends_nothing() -> None:
    assert worst_angle_deg(LinearMap.of([[0, 3, 0], [3, 0, 0], [0, 0, -3]])) == 0.0
