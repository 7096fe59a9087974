"""Kinds of maps: the condition and the worst angle against decompositions of many digits."""

from __future__ import annotations

import random
import subprocess
import sys
from fractions import Fraction
from math import inf, nextafter

import mpmath
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nmatrix.enums import Kind
from nmatrix.linear.affine import rotation_from_quaternion
from nmatrix.linear.classify import classify, condition, near_worst_angle_deg, worst_angle_deg
from nmatrix.linear.exact import LinearMap
from nmatrix.linear.rational import determinant

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


entries = st.one_of(
    st.floats(-4, 4), st.sampled_from([0.0, 1.0, -1.0, 1 + 1e-7, 1 - 1e-6, 1e-5, 1e3, 1e160])
)
maps = st.lists(st.lists(entries, min_size=3, max_size=3), min_size=3, max_size=3)
diagonals = st.lists(entries, min_size=3, max_size=3).map(
    lambda d: [[d[i] if i == j else 0.0 for j in range(3)] for i in range(3)]
)
tolerances = st.one_of(st.sampled_from([0.0, 1e-12, 1e-6, 0.5]), st.floats(0, 0.9))


@given(st.one_of(maps, diagonals))
@settings(max_examples=300, deadline=None)
def test_the_fast_angle_is_right_to_a_millionth_of_a_degree(rows: list[list[float]]) -> None:
    linear_map = LinearMap.of(rows)
    right = worst_angle_deg(linear_map)
    assert near_worst_angle_deg(linear_map) == pytest.approx(
        90.0 if right is None else right, abs=1e-6
    )


def kind_by_definition(rows: list[list[float]], tau: Fraction) -> Kind:
    """The contract's own words, in fractions: the squares of lengths and cosines of columns."""
    columns = [[Fraction(rows[i][j]) for i in range(3)] for j in range(3)]
    dots = [[sum(x * y for x, y in zip(p, q, strict=True)) for q in columns] for p in columns]
    squares = [dots[i][i] for i in range(3)]
    if determinant(columns) == 0:
        return Kind.SINGULAR
    if any(dots[i][j] ** 2 / squares[i] / squares[j] > tau**2 for i, j in ((0, 1), (0, 2), (1, 2))):
        return Kind.SHEAR
    if max(squares) / min(squares) > (1 + tau) ** 2:
        return Kind.NON_UNIFORM_SCALE
    if max(squares) > (1 + tau) ** 2 or 1 / min(squares) > (1 + tau) ** 2:
        return Kind.SIMILARITY
    still = all(abs(columns[j][i] - (i == j)) <= tau for i in range(3) for j in range(3))
    return Kind.IDENTITY if still else Kind.ROTATION


@given(st.one_of(maps, diagonals), tolerances)
@settings(max_examples=300, deadline=None)
def test_kinds_are_those_of_their_definition(rows: list[list[float]], tolerance: float) -> None:
    found = classify(rows, tolerance)
    assert found.kind is kind_by_definition(rows, Fraction(tolerance))
    assert found.kind_exact == (found.kind is kind_by_definition(rows, Fraction(0)))


@pytest.mark.parametrize("w", range(6, 150, 12))
def test_the_worst_angle_of_a_rotation_is_right_however_little_rounding_bent_it(w: int) -> None:
    """Three eigenvalues that agree to 2w digits: a cubic is its rounding long before its root."""
    for quaternion in ((10.0**w, -3.0, 0.0, 0.0), (10.0**w, 3.0, 1.0, -7.0)):
        exact_rotation = rotation_from_quaternion([Fraction(x) for x in quaternion])
        rows = [[float(x) for x in row] for row in exact_rotation]
        with mpmath.workdps(4 * w + 400):
            _, degrees = oracle(rows)
            found = exact(Fraction(worst_angle_deg(LinearMap.of(rows))))
            assert abs(found - degrees) <= 3e-16 * degrees


def test_a_uniform_scale_bends_nothing() -> None:
    assert worst_angle_deg(LinearMap.of([[0, 3, 0], [3, 0, 0], [0, 0, -3]])) == 0.0


NARROW = """
import decimal, runpy, sys
wide = decimal.Context
decimal.MAX_PREC = decimal.MAX_EMAX = 425_000_000
decimal.MIN_EMIN = -425_000_000

def narrow(*values, **given):
    found = wide(*values, **given)
    limits = decimal.MAX_PREC, decimal.MAX_EMAX, -decimal.MIN_EMIN
    if any(a > b for a, b in zip((found.prec, found.Emax, -found.Emin), limits)):
        raise ValueError("valid values are those of 32 bits")
    return found

decimal.Context = narrow
try:
    runpy.run_module("nmatrix", run_name="__main__", alter_sys=True)
except SystemExit as left:
    sys.exit(left.code)
"""


@pytest.mark.parametrize(
    "line", ["world --scale 1 2 1", "normal 2,0,0,0,1,0,0,0,1", "derive nonuniform --scale 1 2 1"]
)
def test_commands_run_where_decimals_have_the_limits_of_32_bits(line: str) -> None:
    done = subprocess.run(
        [sys.executable, "-c", NARROW, *line.split()], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
