"""Letters: what is computed with them holds for every value that they may have."""

from __future__ import annotations

import random
import re
import subprocess
import sys
from fractions import Fraction

import pytest
from counted import at_most

from nmatrix.calculator.arithmetic.symbolic import Symbolic
from nmatrix.calculator.arithmetic.values import Arithmetic, Value, as_strings
from nmatrix.calculator.evaluate import calculate
from nmatrix.calculator.language.faults import CalculatorError, NoValueError
from nmatrix.errors import NMatrixError

LINES = (
    "det([a b; c d])",
    "inverse([a b; c d])",
    "inverse([a b 0; c d 1; 0 1 e])",
    "[a b; c d] @ [x, y]",
    "[a b c] × [d e f]",
    "dot([a b c], [d e f])",
    "(a + b)^3 / (a - b)",
    "1/(1/(1/(a + b) + c) + d)",
    "inverse_transpose(scale(a, b, c)) @ [1, 2, 3, 0]",
    "translate(a, b, c) @ scale(d, e, f) @ [x, y, z, 1]",
    "adjugate([a b; c d]) @ [a b; c d]",
    "cofactor([a b c; d e f; x y z])",
    "[a b; c d]^-2",
    "trace([a b; c d]^2) - det([a b; c d])",
    "rank([a b; 2*a 2*b])",
    "(√2*a + b)^2",
)


@pytest.mark.parametrize("line", LINES)
def test_letters_given_values_afterwards_tell_what_values_tell(line: str) -> None:
    chance = random.Random(line)
    found = calculate(line, {})
    texts = as_strings(found.value.entries)
    for _ in range(3):
        values = {name: Value(Fraction(chance.randint(1, 60), 7)) for name in "abcdefxyz"}
        try:
            wanted = calculate(line, values).value.entries
        except NoValueError:
            continue
        rows = str(texts).replace("'", "")
        assert calculate(rows, values).value.entries == wanted


def test_turns_by_letters_go_together_and_undo_each_other() -> None:
    lines = {
        "inverse(rotate_z(t)) == rotate_z(-t)": True,
        "rotate_z(s) @ rotate_z(t) == rotate_z(s + t)": True,
        "rotate_x(s) @ rotate_z(t) == rotate_z(t) @ rotate_x(s)": False,
        "inverse(rotate_x(a) @ rotate_y(b)) == (rotate_x(a) @ rotate_y(b)).T": True,
        "det(rotate_x(a) @ rotate_y(b) @ scale(2, 3, 4)) == 24": True,
        "rotate_z(t + 90) @ [1, 0, 0, 0] == rotate_z(t) @ [0, 1, 0, 0]": True,
        "sin(t)^2 + cos(t)^2 == 1": True,
    }
    assert {line: calculate(line, {}).value.entries for line in lines} == lines


@pytest.mark.parametrize(
    ("line", "letters", "conditions"),
    [
        ("inverse([a b; c d])", "a, b, c, d have no values and stay letters.", "a·d − b·c ≠ 0"),
        ("normalize([x 0 0])", "x has no value and stays a letter.", None),
        ("1/a + 1/(b*(b + 1))", "a, b have no values and stay letters.", "b + 1 ≠ 0"),
        ("(a^2 - 1)/(a - 1)", "a has no value and stays a letter.", None),
    ],
)
def test_a_remark_names_the_letters_and_what_must_not_be_0(
    line: str, letters: str, conditions: str | None
) -> None:
    first, *rest = calculate(line, {}).remarks
    assert first == letters
    assert conditions is None or re.search(re.escape(conditions), " ".join(rest))


@pytest.mark.parametrize(
    ("line", "position"),
    [("Q + 1", 0), ("a + ab", 4), ("2*_a", 2), ("a1234", 0), ("a_1", 0)],
)
def test_what_is_no_single_small_letter_needs_a_value(line: str, position: int) -> None:
    with pytest.raises(CalculatorError) as refused:
        calculate(line, {})
    assert refused.value.position == position


@pytest.mark.parametrize(
    "line", ["angle([a 0 0], [0 b 0])", "a ≈ b", "sin(1)*a", "[1 2 3][a]", "2^a", "sqrt(-a^2)"]
)
def test_what_needs_a_size_is_refused(line: str) -> None:
    with pytest.raises((CalculatorError, NoValueError)):
        calculate(line, {})
    with pytest.raises(CalculatorError):
        calculate("a + 1", {}, Arithmetic.FLOAT)


@pytest.mark.parametrize(
    "line", ["(a + b)^9999", "(a + b + c + d)^8 * (a + b)^8", "det([a b; c d]^64)", "[a b; c d]^50"]
)
def test_what_grows_too_long_is_refused_early(line: str) -> None:
    with at_most(20_000_000), pytest.raises(NMatrixError) as refused:
        calculate(line, {})
    assert "letters" in str(refused.value)


def test_every_operator_meets_every_exact_number() -> None:
    a = Symbolic.letter("a")
    numbers = [calculate(text, {}).value.scalar for text in ("3", "2/3", "√2", "pi", "√2 + √3")]
    for x in (*numbers, 5):
        assert a + x - a == x + a - a == x
        assert x - (x - a) == (a - x) + x == a
        assert a * x / a == (x * a) / a == x
        assert 1 / (a / x) == x / a


def test_sympy_is_loaded_for_letters_alone() -> None:
    script = (
        "import sys; from nmatrix.calculator.evaluate import calculate; "
        "calculate('inverse(rotate_z(30)) @ [1, 2, 3, 1]', {}); "
        "assert 'sympy' not in sys.modules; calculate('a', {}); assert 'sympy' in sys.modules"
    )
    subprocess.run([sys.executable, "-c", script], check=True)


@pytest.mark.parametrize(
    ("text", "value", "zeros"),
    [
        ("y / y", 1, ["y"]),
        ("y * y^-1", 1, ["y"]),
        ("(y^2 - 1) / (y - 1)", None, ["y − 1"]),
        ("(y^2 - 1) * (y - 1)^-1", None, ["y − 1"]),
        ("det(inverse([x 0; 0 y])) * det([x 0; 0 y])", 1, ["x", "y"]),
        ("trace(inverse([x 0; 0 y]) @ [x 0; 0 y])", 2, ["x", "y"]),
        ("1 / (x / y)", None, ["x", "y"]),
        ("(x - x) + 3", 3, []),
    ],
)
def test_what_must_not_be_zero_is_told_even_where_it_cancels(text, value, zeros):
    found = calculate(text, {})
    if value is not None:
        assert found.value.scalar == value
    told = [one for one in found.remarks if one.startswith("It holds where")]
    assert len(told) == bool(zeros)
    assert all(f"{zero} ≠ 0" in told[0] for zero in zeros)
    assert sum(one.count("≠") for one in told) == len(zeros)
