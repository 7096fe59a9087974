"""The functions are exact: SymPy's rationals, the definitions, and numbers checked by hand."""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction
from math import acos, degrees, isclose

import mpmath
import pytest

from nmatrix.calculator import evaluate
from nmatrix.calculator.arithmetic import numbers
from nmatrix.calculator.arithmetic.numbers import shown
from nmatrix.calculator.arithmetic.values import Arithmetic, Value
from nmatrix.calculator.evaluate import calculate
from nmatrix.calculator.functions import FUNCTIONS
from nmatrix.errors import IllegalValueError, NoAnswerError


def exact(expression, **names):
    """Return the entries of an exact value."""
    found = calculate(expression, names).value
    assert found.exact
    return found.entries


def floats(expression, **names):
    """Return the entries of a value as floats, in a flat list."""
    return [float(shown(x)) for x in calculate(expression, names).value.numbers]


def random_matrix(chance, size):
    return Value(
        tuple(
            tuple(Fraction(chance.randint(-9, 9), chance.randint(1, 9)) for _ in range(size))
            for _ in range(size)
        )
    )


def in_sympy(value):
    from sympy import Matrix, Rational

    return Matrix([[Rational(x.numerator, x.denominator) for x in row] for row in value.matrix])


def from_sympy(matrix):
    rows = matrix.tolist()
    return tuple(tuple(Fraction(int(x.p), int(x.q)) for x in row) for row in rows)


ORACLES = {
    "inverse(A)": lambda a, _: a.inv(),
    "A.T": lambda a, _: a.T,
    "transpose(A)": lambda a, _: a.T,
    "inverse_transpose(A)": lambda a, _: a.inv().T,
    "cofactor(A)": lambda a, _: a.cofactor_matrix(),
    "adjugate(A)": lambda a, _: a.adjugate(),
    "A @ B": lambda a, b: a * b,
    "A + B": lambda a, b: a + b,
    "A - B": lambda a, b: a - b,
    "-A": lambda a, _: -a,
    "A * 2 / 3": lambda a, _: a * 2 / 3,
    "[[det(A), trace(A)]]": lambda a, _: type(a)([[a.det(), a.trace()]]),
    "[[rank(A - B), rank(A)]]": lambda a, b: type(a)([[(a - b).rank(), a.rank()]]),
}


@pytest.mark.parametrize("expression", ORACLES)
@pytest.mark.parametrize("size", [2, 3, 4])
def test_matrices_agree_with_sympy_to_the_last_fraction(expression, size):
    chance = random.Random(size)
    for _ in range(3):
        A, B = random_matrix(chance, size), random_matrix(chance, size)
        wanted = from_sympy(ORACLES[expression](in_sympy(A), in_sympy(B)))
        assert exact(expression, A=A, B=B) == wanted


def test_the_oracle_notices_a_wrong_rule(monkeypatch):
    wrong = replace(FUNCTIONS["cofactor"], compute=FUNCTIONS["adjugate"].compute)
    monkeypatch.setitem(evaluate.FUNCTIONS, "cofactor", wrong)
    with pytest.raises(AssertionError):
        test_matrices_agree_with_sympy_to_the_last_fraction("cofactor(A)", 3)


def test_a_carried_normal_stays_perpendicular_to_the_carried_surface():
    M = random_matrix(random.Random(3), 3)
    right = "dot(M @ [1, -1, 0], inverse_transpose(M) @ [1, 1, 0])"
    assert exact(right, M=M) == 0
    assert exact("dot(M @ [1, -1, 0], M @ [1, 1, 0])", M=M) != 0


@pytest.mark.parametrize(
    ("expression", "wanted"),
    [
        ("1/3 + 1/6", Fraction(1, 2)),
        ("0.1 + 0.2 - 0.3", 0),
        ("2 - 3 * 4 / 8", Fraction(1, 2)),
        ("-(2 - 5)", 3),
        ("dot([1, 2, 3], [4, 5, 6])", 32),
        ("cross([1, 2, 3], [4, 5, 6])", (-3, 6, -3)),
        ("point([1, 2, 3])", (1, 2, 3, 1)),
        ("vector([1, 2, 3])", (1, 2, 3, 0)),
        ("translate(5, 6, 7) @ point([1, 2, 3])", (6, 8, 10, 1)),
        ("translate([5, 6, 7]) @ vector([1, 2, 3])", (1, 2, 3, 0)),
        ("translation(translate(5, 6, 7))", (5, 6, 7)),
        ("linear(scale(2, 3, 4))", ((2, 0, 0), (0, 3, 0), (0, 0, 4))),
        ("linear(shear(2, 3, 4))", ((1, 2, 3), (0, 1, 4), (0, 0, 1))),
        ("linear(rotate_x(90)) @ [0, 1, 0]", (0, 0, 1)),
        ("linear(rotate_y(90)) @ [0, 0, 1]", (1, 0, 0)),
        ("linear(rotate_z(90)) @ [1, 0, 0]", (0, 1, 0)),
        ("linear(rotate_z(-630)) @ [1, 0, 0]", (0, 1, 0)),
        ("identity(2)", ((1, 0), (0, 1))),
        ("length([3, 4, 12])", 13),
        ("length([1/3, 2/3, 2/3])", 1),
        ("normalize([3, 0, -4])", (Fraction(3, 5), 0, Fraction(-4, 5))),
        ("normalize(vector([0, 0, 1e-300]))", (0, 0, 1, 0)),
        ("[1e308, 1] * 1e308 / 1e308", (10**308, 1)),
    ],
)
def test_values_that_can_be_checked_by_hand(expression, wanted):
    assert exact(expression) == wanted


@pytest.mark.parametrize("turn", [0, 30, 45, 60, 90, 120, 135, 150, 180])
def test_the_angles_with_a_rational_cosine_squared_are_exact(turn):
    direction = {0: "1,0,0", 45: "1,1,0", 90: "0,1,0", 135: "-1,1,0", 180: "-7,0,0"}
    cubic = {60: "[1,1,0], [1,0,1]", 120: "[1,1,0], [-1,0,1]"}
    slanted = {30: "[1,1,0], [2,1,1]", 150: "[1,1,0], [-2,-1,-1]"}
    pair = {**cubic, **slanted}.get(turn) or f"[1,0,0], [{direction[turn]}]"
    assert exact(f"angle({pair})") == turn


def test_other_angles_are_those_of_the_definition_and_not_exact():
    found = calculate("angle([1, 2, 3], [3, -1, 4])", {}).value
    assert not found.exact
    assert isclose(float(found.shown), degrees(acos(13 / (14 * 26) ** 0.5)), rel_tol=1e-14)


@pytest.mark.parametrize(
    ("expression", "wanted"),
    [
        ("length([1, 1])", "√2"),
        ("normalize([1, 1, 1])", "[√3/3, √3/3, √3/3]"),
        ("linear(rotate_z(30))", "[√3/2 -1/2 0; 1/2 √3/2 0; 0 0 1]"),
        ("inverse(linear(rotate_x(45)))", "[1 0 0; 0 √2/2 √2/2; 0 -√2/2 √2/2]"),
        ("point(normalize([1, 1, 1]))", "[√3/3, √3/3, √3/3, 1]"),
        ("angle([1, 0, 0], normalize([1, 1, 0]))", "45"),
        ("sin(pi/3)", "√3/2"),
    ],
)
def test_roots_of_rationals_are_exact(expression, wanted):
    assert calculate(expression, {}).value.exact
    assert calculate(f"{expression} == {wanted}", {}).value.entries is True


@pytest.mark.parametrize(
    "expression",
    [
        "rotate_z(20)",
        "2 * sin(1)",
        "inverse(rotate_x(44))",
        "[cos(33), 1]",
        "sqrt(1 + √2)",
        "acos(1/3)",
        "pi",
        "normalize([sin(20), 1])",
        "perspective(50, 1, 1, 2)",
    ],
)
def test_what_is_known_to_some_digits_only_is_never_called_exact(expression):
    assert not calculate(expression, {}).value.exact


def test_irrational_values_round_to_the_nearest_float_however_long_the_chain():
    assert floats("length([1, 1])") == [2**0.5]
    assert floats("normalize(" * 40 + "[1, 2, 2e-9]" + ")" * 40) == floats(
        "normalize([1, 2, 2e-9])"
    )
    assert floats("rotate_z(30) @ rotate_z(60)") == floats("rotate_z(90)")


def test_long_chains_do_not_grow(monkeypatch):
    """Without ends that are rounded outwards every normalisation multiplies their length."""
    chain = "normalize(" * 12 + "[sin(20), 2, 4]" + ")" * 12
    assert max(map(numbers.bits_of, calculate(chain, {}).value.numbers)) <= 320
    monkeypatch.setattr(numbers, "enclosed", numbers.Interval)
    with pytest.raises(IllegalValueError, match="bits"):
        calculate(chain, {})


@pytest.mark.parametrize(
    "expression",
    [
        "inverse([[1, 2], [2, 4]])",
        "inverse_transpose(scale(1, 0, 1))",
        "normalize([0, 0, 0])",
        "angle([0, 0, 0], [1, 0, 0])",
        "1 / (0.1 + 0.2 - 0.3)",
        "identity(3) / 0",
    ],
)
def test_what_has_no_answer_says_so(expression):
    with pytest.raises(NoAnswerError):
        calculate(expression, {})


def test_the_cofactor_matrix_exists_where_the_inverse_does_not():
    assert exact("cofactor([[1, 2], [2, 4]])") == ((4, -2), (-2, 1))


def test_normalising_four_components_is_the_mistake_that_it_is():
    with pytest.raises(IllegalValueError, match="w is not 0"):
        calculate("normalize(point([1, 2, 3]))", {})


def test_a_missing_w_is_named():
    with pytest.raises(IllegalValueError, match=r"point\(v\) or vector\(v\)"):
        calculate("translate(1, 2, 3) @ [1, 2, 3]", {})


def test_float_rounds_after_every_operation_as_a_float_program_does():
    for expression, wanted in (
        ("0.1 + 0.2", 0.1 + 0.2),
        ("0.1 + 0.2 - 0.3", 0.1 + 0.2 - 0.3),
        ("1 / 3 * 3 - 1", 1 / 3 * 3 - 1),
        ("1e16 + 1 - 1e16", 1e16 + 1 - 1e16),
        ("1e-200 * 1e-200 * 1e200", 1e-200 * 1e-200 * 1e200),
    ):
        found = calculate(expression, {}, Arithmetic.FLOAT).value.scalar
        assert found.value == wanted, expression
    assert exact("1e16 + 1 - 1e16") == 1


def test_an_angle_is_the_nearest_float() -> None:
    chance = random.Random(5)
    for _ in range(200):
        a, b = ([chance.randint(-9, 9) for _ in range(3)] for _ in range(2))
        if not any(a) or not any(b):
            continue
        with mpmath.workdps(60):
            dot = sum(x * y for x, y in zip(a, b, strict=True))
            square = sum(x * x for x in a) * sum(x * x for x in b) - dot * dot
            right = float(mpmath.degrees(mpmath.atan2(mpmath.sqrt(square), dot)))
        assert float(calculate(f"angle({a}, {b})", {}).value.shown) == right
