"""The steps of the calculator: a working for each operation, which arrives at the value."""

from __future__ import annotations

import json
import random
from fractions import Fraction

import pytest

from nmatrix.calculator.answer import report
from nmatrix.calculator.arithmetic.operators import BINARY
from nmatrix.calculator.arithmetic.values import Arithmetic, Value, ValueKind
from nmatrix.calculator.evaluate import calculate
from nmatrix.calculator.functions import FUNCTIONS
from nmatrix.calculator.workings import WORKINGS
from nmatrix.enums import Format, InverseBy
from nmatrix.errors import IllegalValueError
from nmatrix.linear.rational import rational_matrix
from nmatrix.output.write import OutputOptions, write
from nmatrix.report import Step

A = Value(rational_matrix([[2, 1, 0], [1, 3, 1], [0, 1, 4]]))
B = Value(rational_matrix([[1, 0, 2], [0, 1, 1], [1, 1, 0]]))
NAMES = {"A": A, "B": B}
OF_OPERATORS = {
    "^": "A^3",
    "@": "A @ B",
    "·": "[1 2 3] · [4 5 6]",
    "×": "[1 2 3] × [4 5 6]",
    "+": "A + B",
    "-": "[1 2] - [3 4]",
    "*": "1/2 * A",
}


def steps(line: str, by: InverseBy | None = None) -> list[Step]:
    found = report(calculate(line, NAMES), with_steps=True, inverse_by=by).data["steps"]
    assert isinstance(found, tuple)
    return list(found)


@pytest.mark.parametrize("name", WORKINGS)
def test_every_working_is_shown_and_every_line_of_it_is_proved(name: str) -> None:
    line = OF_OPERATORS[name] if name in OF_OPERATORS else FUNCTIONS[name].example
    found = steps(line)
    assert all(step.verified for step in found)
    assert len(found) > 1 or name in ("*", "·", "dot", "length")


def test_every_function_and_operator_has_at_least_its_line() -> None:
    assert set(OF_OPERATORS) <= {*BINARY, "^"}
    for name, function in FUNCTIONS.items():
        found = steps(function.example)
        assert found, name
        assert all(step.because for step in found)


@pytest.mark.parametrize("by", InverseBy)
def test_an_inverse_is_worked_out_as_it_is_asked_for(by: InverseBy) -> None:
    M = "[2 1 0 3; 0 1 0 4; 1 0 1 5; 0 0 0 1]"
    lines = {way: [one.formula.parts for one in steps(f"inverse({M})", way)] for way in InverseBy}
    assert all(lines[by] != lines[other] for other in InverseBy if other is not by)
    last = steps(f"inverse({M})", by)[-1]
    assert "check" in last.because


def test_a_method_that_is_not_for_the_matrix_is_refused() -> None:
    with pytest.raises(IllegalValueError):
        steps("inverse(A)", InverseBy.BLOCKS)


def test_names_and_their_powers_are_those_that_were_typed() -> None:
    heads = {
        "A @ B": "A · B",
        "A.T @ B": "Aᵀ · B",
        "inverse(A) @ B": "A⁻¹ · B",
        "A^-1 @ B": "A⁻¹ · B",
        "[1 0 0; 0 1 0; 0 0 1] @ B": "A · B",
        "A @ [1 2 3]": "A · v",
    }
    for line, head in heads.items():
        assert any(str(one.formula.parts[0]).startswith(head) for one in steps(line)), line


def test_numbers_say_what_was_done_with_them_and_not_the_same_twice() -> None:
    assert [one.formula.parts[0] for one in steps("1/3 + 1/6")] == ["1/3 + 1/6 = 1/2"]
    assert [one.because for one in steps("2 * 3 - 4")] == ["multiplied", "subtracted"]


def test_letters_numbers_between_bounds_and_floats_have_steps_too() -> None:
    assert "a·d − b·c" in str(steps("det([a b; c d])")[-1].formula.parts)
    assert all(step.verified for step in steps("inverse(rotate_z(t))"))
    assert all(step.verified for step in steps("rotate_z(20) @ [1, 0, 0, 1]"))
    rounded = calculate("A @ B", NAMES, Arithmetic.FLOAT)
    (only,) = report(rounded, with_steps=True).data["steps"]  # type: ignore[misc]  # one step
    assert not only.verified  # type: ignore[union-attr]  # it is a step


def test_random_chains_of_operations_arrive_at_their_values() -> None:
    """The last line of a working is compared with the value when it is made: none is dropped."""
    chance = random.Random(11)
    for _ in range(40):
        rows = "; ".join(
            " ".join(str(Fraction(chance.randint(-9, 9), chance.randint(1, 4))) for _ in "abc")
            for _ in "abc"
        )
        names = {"A": calculate(f"[{rows}]", {}).value, "B": B}
        for line in ("A @ B", "A + B", "det(A)", "A.T", "rref(A)", "rank(A)", "cofactor(A)"):
            found = report(calculate(line, names), with_steps=True).data["steps"]
            assert len(found) > 1, (line, rows)  # type: ignore[arg-type]  # one line is no working


def test_json_has_the_shape_of_a_derivation() -> None:
    found = report(calculate("det(A)", NAMES), with_steps=True)
    told = json.loads(write(found, OutputOptions(format=Format.JSON)))["steps"]
    assert all(set(one) == {"text", "latex", "because", "verified"} for one in told)
    assert report(calculate("det(A)", NAMES), with_steps=False).data["steps"] is None


@pytest.mark.parametrize(
    ("line", "has_lines"),
    [
        ('perspective(60, 1, 1, "inf")', True),
        ("perspective(near=1, far=2, fov=60, aspect=1)", True),
        ("world(translate=[10^400, 0, 0])", False),
        ("look_at([a, 0, 0], [0, 0, 0])", False),
    ],
)
def test_what_no_working_can_take_is_one_line(line: str, has_lines: bool) -> None:
    assert (len(steps(line)) > 2) is has_lines


TYPED = (
    "[1 2; 3 4] / 2", "[[1, 2], [3, 4]] / 2", "A[0, 0] / 2", "A[0] / 2", "A.T @ A / 2", "A^-T / 2",
    "A^-1 @ A^2", "-A + B", "[1 2 3].x / 2", "[1 2 3].xyz · [1 2 3] / 2", "√2 * sqrt(3) / 2",
    "(1 + 2) / (3 + 4) / 5", "60° / 2", "pi / 3", "1 / 2 == 2 / 4", "1 / 3 ≈ 0.333333333333333333",
    'lu(A, "L") / 2',
)  # fmt: skip


@pytest.mark.parametrize("format_", [Format.LATEX, Format.MATHML, Format.TYPST, Format.MARKDOWN])
def test_what_was_typed_is_set_in_every_notation(format_: Format) -> None:
    examples = [one.example for one in FUNCTIONS.values()]
    of_numbers = [one for one in examples if calculate(one, NAMES).value.kind is ValueKind.SCALAR]
    assert of_numbers
    for line in (*TYPED, *examples, *(f"{one} / 2" for one in of_numbers)):
        found = report(calculate(line, NAMES), with_steps=True)
        assert write(found, OutputOptions(format_))
