"""The answer: the keys of the contract, fractions where they are exact, steps to redo."""

from __future__ import annotations

import pytest

from nmatrix.calculator.answer import KEYS, report
from nmatrix.calculator.arithmetic.meanings import SCENE
from nmatrix.calculator.arithmetic.values import Arithmetic, Value, as_strings
from nmatrix.calculator.evaluate import calculate
from nmatrix.linear.rational import rational_matrix

NAMES = {"A": Value(rational_matrix([[2, 1], [1, 1]]))}


def data(expression, *, with_steps=False, arithmetic=Arithmetic.EXACT):
    return report(calculate(expression, NAMES, arithmetic), with_steps=with_steps).data


@pytest.mark.parametrize(
    ("expression", "kind", "strings"),
    [
        ("1/3", "scalar", "1/3"),
        ("[1, 1/2]", "vector", ["1", "1/2"]),
        ("A / 2", "matrix", [["1", "1/2"], ["1/2", "1/2"]]),
        ("length([1, 1])", "scalar", "√2"),
        (
            "linear(rotate_z(30))",
            "matrix",
            [
                ["√3/2", "-1/2", "0"],
                ["1/2", "√3/2", "0"],
                ["0", "0", "1"],
            ],
        ),
        ("det([a 1; 1 a]) / 2", "scalar", "a**2/2 - 1/2"),
        ("sqrt(2) * sqrt(8) == 4", "scalar", None),
        ("pi", "scalar", None),
        ("length([1, 1]) * sin(20)", "scalar", None),
    ],
)
def test_kind_and_exact_follow_the_value(expression, kind, strings):
    found = data(expression)
    assert tuple(found) == KEYS
    assert found["expression"] == expression
    assert found["kind"] == kind
    assert found["exact"] == strings
    assert found["steps"] is None


def test_float_arithmetic_has_no_exact_value():
    assert data("1/3", arithmetic=Arithmetic.FLOAT)["exact"] is None


def test_every_step_is_a_calculation_of_its_own_and_the_last_one_is_the_answer():
    expression = "det(A) * inverse(A) @ (A.T + identity(2)) - [[1, 0], [0, length([3, 4])]]"
    found = calculate(expression, NAMES)
    assert [step.expression for step in found.steps] == [
        "det(A)",
        "inverse(A)",
        "det(A) * inverse(A)",
        "A.T",
        "identity(2)",
        "A.T + identity(2)",
        "det(A) * inverse(A) @ (A.T + identity(2))",
        "length([3, 4])",
        expression,
    ]
    for step in found.steps:
        assert step.value.entries == calculate(step.expression, NAMES).value.entries
        assert step.rule
    assert found.steps[-1].value == found.value
    steps = data("det(A) + 1", with_steps=True)["steps"]
    assert [step.formula.parts for step in steps][-1] == ("det(A) + 1 = 2",)


def test_a_lone_name_has_no_steps_yet_they_were_asked_for():
    assert data("A", with_steps=True)["steps"] == ()
    assert data("A")["steps"] is None


def test_the_remark_says_when_a_value_is_not_exact():
    def remarks(expression, arithmetic=Arithmetic.EXACT):
        return report(calculate(expression, NAMES, arithmetic), with_steps=False).remarks

    assert remarks("det(A)") == ()
    assert remarks("length([1, 1])") == ()  # √2 is exact
    assert remarks("sin(20)") == ("A number in it is not exact: 39 digits are known.",)
    assert "float64" in remarks("det(A)", Arithmetic.FLOAT)[0]


def test_the_largest_fraction_that_is_kept_can_be_written_down():
    """Python writes integers of up to 4300 digits; a longer one would end in a traceback."""
    value = calculate("*".join(["1e308"] * 4), {}).value
    assert len(as_strings(value.entries)) == 1233


def test_a_thing_tells_its_space_and_a_map_both_of_its_ends():
    names = {"M": Value(rational_matrix([[2, 0, 0], [0, 1, 0], [0, 0, 1]]), SCENE["M"])}

    def told(expression):
        found = report(calculate(expression, names), with_steps=False)
        value = found.blocks[1]
        return value.title or value.key, *(
            found.data[key] for key in ("kind", "to", "from", "space")
        )

    moved = "M @ direction([3, 4, 0], object)"
    assert told(moved) == ("world direction", "direction", None, None, "world")
    assert told("M") == ("world ← object", "matrix", "world", "object", None)
    assert told("normal_matrix(M)")[0] == "world ← object, for normals"
    assert told("untyped(M)") == ("value", "matrix", None, None, None)
    assert told("[1, 2]") == ("value", "vector", None, None, None)
