"""Fractions and roots in every notation of a matrix, as the numbers that they are."""

from __future__ import annotations

from decimal import Decimal, localcontext
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from nmatrix.errors import IllegalValueError
from nmatrix.reading.matrix import matrix_literal
from nmatrix.reading.notations import value_at
from nmatrix.reading.roots import exact_number, in_one_word
from nmatrix.surds import Surd, root

HALF, HALF_ROOT = Fraction(1, 2), root(3) / 2
TURN = ((HALF_ROOT, -HALF), (HALF, HALF_ROOT))
FIFTEEN = (root(6) - root(2)) / 4  # sin 15°

TURNS = {
    "rows": "√3/2 -1/2; 1/2 √3/2",
    "words": "sqrt(3)/2 -1/2\nsqrt(1)/2 sqrt(3)/2",
    "lists": "[[√3/2, -1/2], [1/2, √3/2]]",
    "MATLAB": "[sqrt(3)/2 -1/2; 1/2 sqrt(3)/2]",
    "tuples": "((√3/2, −1/2), (1/2, √3/2))",
    "parentheses": "√(3)/2 -1/2; 1/2 (√3)/2",
    "under one root": "√(3/4) -√(1/4); √(1/4) √(3/4)",
    "SymPy": "Matrix([[sqrt(3)/2, -1/2], [1/2, sqrt(3)/2]])",
    "NumPy": "np.array([[np.sqrt(3)/2, -1/2], [1/2, np.sqrt(3)/2]])",
    "JavaScript": "const m = [[Math.sqrt(3)/2, -1/2], [1/2, Math.sqrt(3)/2]];",
    "GLSL": "mat2(sqrt(3.0)/2.0, 0.5, -0.5, sqrt(3.0)/2.0)",
    "braces": "{{√3/2, -1/2}, {1/2, √3/2}}",
    "a frame": "⎡√3/2  -1/2⎤\n⎣1/2   √3/2⎦",
    "a drawing": "R\n  ⎡ √3/2  -1/2 ⎤\n  ⎣  1/2  √3/2 ⎦",
    "LaTeX": r"\begin{bmatrix} \frac{\sqrt{3}}{2} & -\frac{1}{2} \\ \frac12 & "
    r"\tfrac{\sqrt3}2 \end{bmatrix}",
    "papers": r"$R = \begin{pmatrix} \dfrac{1}{2}\sqrt{3} & -\tfrac12 \\ \tfrac{1}{2} & "
    r"\frac{\sqrt 3}{2} \end{pmatrix}$",
    "LaTeX in a shell": r"\begin{bmatrix} \frac{\sqrt{3}}{2} & -\frac12 \ \frac12 & "
    r"\frac{\sqrt{3}}{2} \end{bmatrix}",
    "LaTeX with room": "\\begin{bmatrix} \\frac{\\sqrt{3}}{2} & -\\frac12 \\\\[4pt]\n\\frac12 & "
    "\\frac{\\sqrt{3}}{2} \\\\\n\\end{bmatrix}",
    "Typst": "mat(sqrt(3)/2, -1/2; frac(1, 2), frac(sqrt(3), 2))",
    "MathML": "<mtable><mtr><mtd><mfrac><msqrt><mn>3</mn></msqrt><mn>2</mn></mfrac></mtd>"
    "<mtd><mo>−</mo><mfrac><mn>1</mn><mn>2</mn></mfrac></mtd></mtr>"
    "<mtr><mtd>1/2</mtd><mtd><mfrac><msqrt><mn>3</mn></msqrt><mn>2</mn></mfrac></mtd></mtr></mtable>",
}  # fmt: skip


@pytest.mark.parametrize("name", TURNS)
def test_a_turn_by_thirty_degrees_is_itself_in_every_notation(name: str) -> None:
    found = matrix_literal(TURNS[name])
    assert found.rows_typed == TURN
    assert found.rows == ((3**0.5 / 2, -0.5), (0.5, 3**0.5 / 2))
    assert not any(map(any, found.half_units))


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("(√6-√2)/4", FIFTEEN),
        ("(√6 − √2)/4", FIFTEEN),
        ("(sqrt(6) - sqrt(2))/4", FIFTEEN),
        ("-sqrt(2)/4 + sqrt(6)/4", FIFTEEN),
        ("1/4*(√6-√2)", FIFTEEN),
        ("2√3/3", 2 / root(3)),
        ("2*sqrt(3)/3", 2 / root(3)),
        ("2sqrt(3)/3", 2 / root(3)),
        ("2sqrt(3)", 2 * root(3)),
        ("2·√3/3", 2 / root(3)),
        ("1/√2", root(2) / 2),
        ("1/(1+√2)", root(2) - 1),
        ("√2√8", Fraction(4)),
        ("√0.25", HALF),
        ("-√2", -root(2)),
    ],
)
def test_sums_and_products_are_one_number(text: str, value: Fraction | Surd) -> None:
    assert exact_number(text, "x") == value
    for matrix in (f"[[{text}, 0], [0, 1]]", f"{text}, 0; 0, 1", f"{{{{{text}, 0}}, {{0, 1}}}}"):
        assert matrix_literal(matrix).rows_typed == ((value, 0), (0, 1))


@given(
    st.lists(
        st.tuples(
            st.sampled_from("+-"), st.integers(1, 99), st.integers(2, 99), st.integers(1, 99)
        ),
        min_size=1,
        max_size=3,
    )
)
def test_random_sums_are_what_decimals_of_a_hundred_digits_say(
    terms: list[tuple[str, int, int, int]],
) -> None:
    text = "".join(f"{sign}{top}√{under}/{bottom}" for sign, top, under, bottom in terms)
    with localcontext() as context:
        context.prec = 100
        expected = sum(
            (1 if sign == "+" else -1) * Decimal(under).sqrt() * top / bottom
            for sign, top, under, bottom in terms
        )
        assert abs(expected) < Decimal("1e-40") or float(exact_number(text, "x")) == float(expected)


REFUSED = {
    "1/2√3": "may stand below the line",
    "1/√2√3": "may stand below the line",
    "√": "a number is missing at its end",
    "√-1": "a number is missing before -",
    "√(0-1)": "of negative numbers",
    "√√2": "roots of roots",
    "√2/0": "divided by 0",
    "1/(√4-2)": "divided by 0",
    "√2)": r"\) is one too many",
    "(√2": "a parenthesis is not closed",
    "√2 3": "not a number",
    "√x": "not a number",
    "√1e3": "not a number",
    "√2^2": "not a number",
    "sqrt[2]": "not a number",
    f"√{'1' * 16}": "not a number",
    "√2" + "+√2" * 40: "not a number",
    "√(999999999999989·999999999999947)": "too many or of too large numbers",
    "(" * 9 + "√2" + ")" * 9: "nest deeper",
}


@pytest.mark.parametrize("text", REFUSED)
def test_a_refusal_says_why_and_what_to_write(text: str) -> None:
    with pytest.raises(IllegalValueError, match=REFUSED[text]) as caught:
        exact_number(text, "x")
    assert str(caught.value).endswith("write it like √3/2 or sqrt(3)/2")
    assert "⟮" not in str(caught.value)


def test_what_is_shown_of_a_cell_has_the_parentheses_that_people_type() -> None:
    with pytest.raises(IllegalValueError, match=r"\('1 \+ \(1\)/\(2\)'\): it is not a number"):
        matrix_literal(r"\begin{bmatrix} 1 + \frac12 & 1 \end{bmatrix}")


def test_without_a_root_nothing_is_computed() -> None:
    for text in ("1+1", "2*3", "(1/2)", "1/2/3"):
        with pytest.raises(IllegalValueError, match="not a number"):
            exact_number(text, "x")


@pytest.mark.parametrize("text", ["1 - 2 3", "a sqrt of b (c) / d", "float s = sqrt(a - b);"])
def test_a_text_without_roots_of_numbers_is_left_as_it_is(text: str) -> None:
    assert in_one_word(text) == text


def test_a_literal_inside_of_an_expression_keeps_its_fractions_and_roots() -> None:
    for text in (TURNS["SymPy"], TURNS["LaTeX"]):
        found = value_at(f"det({text}) + 1", 4, "x")
        assert found is not None
        rows, end = found
        assert tuple(tuple(exact_number(one, "x") for one in row) for row in rows) == TURN
        assert f"det({text}) + 1"[end:] == ") + 1"


@pytest.mark.parametrize(
    ("text", "shape"),
    [
        ("; ".join(["1 2 3 4 5 6 7 8"] * 4), (4, 8)),
        ("; ".join(["1 2 3 4 5 6 7 8"] * 8), (8, 8)),
        ("1 2 3 4 5 6 7 8", (1, 8)),
        ("1; 2; 3; 4; 5", (5, 1)),
    ],
)
def test_the_corners_of_a_box_fit(text: str, shape: tuple[int, int]) -> None:
    assert matrix_literal(text).shape == shape
    assert matrix_literal(text).rows_typed[0][0] == 1


@pytest.mark.parametrize("text", ["; ".join(["1 2"] * 9), "1 2 3 4 5 6 7 8 9 10; " * 2])
def test_nine_rows_or_columns_are_too_many(text: str) -> None:
    with pytest.raises(IllegalValueError, match="use at most 8×8"):
        matrix_literal(text)
