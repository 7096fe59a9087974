"""One matrix in every notation of the contract, its layouts, and what is refused."""

from __future__ import annotations

import json
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from counted import at_most
from hypothesis import given, settings
from hypothesis import strategies as st

from nmatrix.enums import Layout
from nmatrix.errors import IllegalValueError, NMatrixError
from nmatrix.reading import equations
from nmatrix.reading.literal import as_affine, as_projection
from nmatrix.reading.matrix import FIRST_OF, matrix_literal

M = ((1.0, 2.0, 3.0), (4.0, -5.5, 6.0), (7.0, 8.0, 1e-7))

SPELLINGS = {
    "semicolons": "1 2 3; 4 -5.5 6; 7 8 1e-7",
    "commas": "1,2,3; 4,-5.5,6; 7,8,1e-7;",
    "lines": "1 2 3\n4 -5.5 6\r\n7 8 1e-7\n",
    "lists": "[[1,2,3],[4,-5.5,6],[7,8,1e-7]]",
    "tuples": "((1, 2, 3), (4, -5.5, 6), (7, 8, 1e-7))",
    "matlab": "[1 2 3; 4 -5.5 6; 7 8 1e-7]",
    "flat": "1 2 3 4 -5.5 6 7 8 1e-7",
    "flat list": "[1,2,3,4,-5.5,6,7,8,1e-7]",
    "one number a line": "1\n2\n3\n4\n-5.5\n6\n7\n8\n1e-7\n",
    "numpy str": str(np.array(M)),
    "numpy repr": repr(np.array(M)),
    "numpy dtype": "array([[1, 2, 3], [4, -5.5, 6], [7, 8, 1e-7]], dtype=float32)",
    "numpy matrix": "np.matrix([[1, 2, 3], [4, -5.5, 6], [7, 8, 1e-7]])",
    "glsl": "mat3(1, 4, 7, 2, -5.5, 8, 3, 6, 1e-7)",
    "glsl columns": "mat3(vec3(1, 4, 7), vec3(2., -5.5, 8.), vec3(3.0f, 6, 1e-7))",
    "glsl statement": "const mat3 m = mat3(1, 4, 7, 2, -5.5, 8, 3, 6, 1e-7);",
    "glsl size": "mat3x3(1, 4, 7, 2, -5.5, 8, 3, 6, 1e-7)",
    "json": '{"a": 1, "normal_matrix": [[1,2,3],[4,-5.5,6],[7,8,1e-7]]}',
    "json column-major": '{"layout": "column-major", "value": [[1,4,7],[2,-5.5,8],[3,6,1e-7]]}',
    "latex": r"$\begin{pmatrix} 1&2&3 \\ 4&-5.5&6 \\ 7&8&1 \times 10^{-7} \end{pmatrix}$",
    "minus sign": "1 2 3; 4 −5.5 6; 7 8 1e−7",
    "byte order mark": "\ufeff1 2 3; 4 -5.5 6; 7 8 1e-7",
}


@pytest.mark.parametrize("name", SPELLINGS)
def test_spellings(name: str) -> None:
    assert matrix_literal(SPELLINGS[name]).rows == M


@pytest.mark.parametrize("name", [name for name in SPELLINGS if "glsl" in name or "json c" in name])
def test_a_notation_with_its_own_layout_keeps_it(name: str) -> None:
    assert matrix_literal(SPELLINGS[name], Layout.COLUMN_MAJOR).rows == M


@pytest.mark.parametrize("name", ["semicolons", "flat", "lists", "numpy repr", "json"])
def test_column_major_is_the_transpose(name: str) -> None:
    found = matrix_literal(SPELLINGS[name], Layout.COLUMN_MAJOR).rows
    assert found == tuple(zip(*M, strict=True))


@given(st.lists(st.floats(allow_nan=False, allow_infinity=False), min_size=16, max_size=16))
@settings(deadline=None)
def test_numpy_prints_read_back(entries: list[float]) -> None:
    array = np.array(entries).reshape(4, 4)
    with np.printoptions(precision=17, floatmode="unique", linewidth=75):
        printed = (str(array), repr(array))
    for text in printed:
        assert np.array_equal(np.array(matrix_literal(text).rows), array)


def test_fractions_stay_exact_beside_their_floats() -> None:
    found = matrix_literal("1/3 0; 0.1 1")
    assert found.rows_exact[0][0] == Fraction(1, 3)
    assert found.rows_exact[1][0] == Fraction(1, 10)
    assert found.rows[1][0] == 0.1


def test_diagonals_and_splats() -> None:
    assert matrix_literal("mat2(2.0)").rows == ((2.0, 0.0), (0.0, 2.0))
    assert matrix_literal("mat2(vec2(1.0), vec2(2.0))").rows == ((1.0, 2.0), (1.0, 2.0))
    assert matrix_literal("mat2x3(1, 2, 3, 4, 5, 6)").rows == ((1, 4), (2, 5), (3, 6))


def test_the_first_usual_name_wins_in_the_order_of_the_contract() -> None:
    names = list(FIRST_OF)
    while names:
        data = {name: [[i, 0], [0, 1]] for i, name in reversed(list(enumerate(names)))}
        assert matrix_literal(json.dumps(data)).rows[0][0] == 0
        names.pop(0)


def test_keys_reach_into_lists_and_objects() -> None:
    text = '{"spaces": [{"space_from_world": [[1,0],[0,2]]}], "value": [[3,0],[0,3]]}'
    assert matrix_literal(text, key="spaces.0.space_from_world").rows[1][1] == 2
    assert matrix_literal(text, key="spaces_0_space_from_world").rows[1][1] == 2


def test_lists_of_matrices_have_keys_too() -> None:
    text = '{"frames": [[[1,0],[0,2]], [[3,0],[0,4]]]}'
    assert matrix_literal(text, key="frames.1").rows[1][1] == 4


def test_an_unknown_key_is_answered_with_the_known_ones() -> None:
    with pytest.raises(IllegalValueError, match=r"key \('b'\).*choose one of a"):
        matrix_literal('{"a": [[1,0],[0,1]]}', key="b")
    with pytest.raises(IllegalValueError, match="name one of a, b after a #"):
        matrix_literal('{"a": [[1,0],[0,1]], "b": [[1,0],[0,1]]}')


REFUSED = [
    "[[1,2],[3]]", "1 2; 3", "[[1,,2]]", "[,1]", "[[1,2", "[1,2]]", "[1] 2", "[[[1]]]", "()", "[]",
    "{", "{}", '{"a": 1}', '{"value": [[1,"2"],[3,4]]}', '{"value": [[NaN, 1],[1, 1]]}',
    '{"value": [[1, null],[1, 1]]}', '{"layout": "diagonal", "value": [[1,0],[0,1]]}',
    "nan 0; 0 1", "1e400 0; 0 1", "1 2\x003", "a b", "1+1 0; 0 1", "__import__('os') 1",
    "mat3(1,2)", "mat3(sin(1.0))", "mat3(mat3(1))", "mat3(", "mat3(1) mat3(2)", "mat2((1),(2))",
    "array([[1, 2], [3, 4])", "array([1, 2", "1 2 3 4 5 6 7 8 9; 1 2 3 4 5 6 7 8 9",
    "1_0 0; 0 1", "٣ 0; 0 1",
    r"\begin{bmatrix} 1 & 2", r"\begin{bmatrix} \end{bmatrix}", r"\begin{bmatrix} x \end{bmatrix}",
    "<mtable><mtr><mtd><mroot><mn>2</mn><mn>3</mn></mroot></mtd></mtr></mtable>",
    "<mtable><mtr><mtd><msub><mn>2</mn><mn>3</mn></msub></mtd></mtr></mtable>",
    "<mtable><mtr><mtd><msup><mn>2</mn><mn>3</mn></msup></mtd></mtr></mtable>",
    "mat(root(3, 2), 1; 0, 1)", "mat(1, 2", "mat(x, 1)",
    r"\begin{bmatrix} \sqrt[3]{2} \end{bmatrix}",
    r"\begin{bmatrix} \frac{1}{2}^2 \end{bmatrix}", "a\n  ⎡ 1  2 ⎤\n  ⎢ 3  4 ⎥", "  ⎡ x ⎤\n  ⎣ 1 ⎦",
    "key,row,column,value\n", "key,row,column,value\na,0,0\n", "key,row,column,value\na,1,1,2\n",
    "key,row,column,value\na,0,0,\n", "key,row,column,value\n\"a", "\ud800 1",
]  # fmt: skip


@pytest.mark.parametrize("text", REFUSED)
def test_refusals_take_one_line(text: str) -> None:
    with pytest.raises(IllegalValueError) as caught:
        matrix_literal(text)
    message = str(caught.value)
    assert "\n" not in message
    assert message.encode()
    assert len(message) < 300


HOSTILE = {
    "brackets": "[" * 10**5,
    "parentheses": "(" * 10**5,
    "json brackets": '{"a":' + "[" * 10**5,
    "json objects": '{"a":' * 10**5,
    "many numbers": "1 " * 500_000,
    "one number": "1" * 10**6 + " ",
    "commas": "," * 10**6,
    "semicolons": ";" * 10**6,
    "latex opens": r"\begin{bmatrix}" * 60_000,
    "latex opens, one end": r"\begin{bmatrix}" * 60_000 + r"\end{bmatrix}",
    "latex blanks": r"\begin{bmatrix}" + " " * 10**6 + r"x\end{bmatrix}",
    "mathml opens": "<mtable>" * 60_000,
    "mathml cells": "<mtable>" + "<mtd><mfrac>" * 3000 + "</mtable>",
    "mathml blanks": "<mtable>" + " " * 10**6 + "</mtable>",
    "typst opens": "$ mat(" * 60_000,
    "typst commas": "$ mat(" + "frac(1, " * 4000 + ")" * 4001,
    "typst dollars": "$ " * 400_000 + "mat(x)",
    "javascript": "const a = " + "[" * 10**5,
    "drawn rows": "a\n" + "  ⎡ 1 ⎤\n" * 60_000,
    "drawn headings": "a\n" * 400_000 + "  [ 1 ]",
    "roots": "√(" * 10**5,
    "roots of roots": "√" * 10**6 + "2 0; 0 1",
    "glsl": "mat4(" * 10**5,
    "glsl blanks": "mat4" + " " * 10**6,
    "numpy": "array([" * 10**5,
    "numpy blanks": "array(" + " " * 10**6,
    "one word": "a1" * 500_000 + " x",
    "csv": "key,row,column,value\n" + "a,1,1,1\n" * 10**5,
    "nul": "\x00" * 10**6,
    "five million": " 1" * 2_500_000,
}


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_texts_are_refused_in_few_calls_however_long_they_are(name: str) -> None:
    text = HOSTILE[name]
    rows = text.count("a,1,1,1\n")  # only CSV is read to its end, with five calls for a row
    with pytest.raises(IllegalValueError) as caught, at_most(400 + 5 * rows):
        matrix_literal(text)
    assert len(str(caught.value)) < 300


@given(st.text(max_size=80))
@settings(max_examples=300)
def test_any_text_is_a_matrix_or_an_error_of_ours(text: str) -> None:
    try:
        matrix_literal(text)
    except NMatrixError as refusal:
        assert "\n" not in str(refusal)


PIECES = st.sampled_from(
    ["[", "]", "(", ")", ",", ";", " ", "\n", "1", "-2.5", "1/3", "mat3", "vec3", "array", "=", "{",
     "}", '"value"', ":", r"\begin{bmatrix}", r"\end{bmatrix}", "&", r"\\", "key,row,column,value",
     "a,0,0,1", "nan", "// ", "const mat2 a = mat2(", "√", "sqrt(", "·", "/", r"\frac{", r"\sqrt",
     "mat(", "frac(", "$ ", "<mtable>", "<mtr>", "<mtd>", "<mfrac>", "</mfrac>", "</mtable>",
     "const a = [", "⎡ ", " ⎤", "⎣ ", " ⎦", "\n  [ ", " ]", "  x  y\n", "≈"]
)  # fmt: skip


@given(st.lists(PIECES, max_size=30).map("".join))
@settings(max_examples=500, deadline=None)
def test_shuffled_notation_is_a_matrix_or_an_error_of_ours(text: str) -> None:
    try:
        found = matrix_literal(text)
    except NMatrixError as refusal:
        assert "\n" not in str(refusal)
    else:
        assert all(np.isfinite(entry) for row in found.rows for entry in row)
        assert len({len(row) for row in found.rows}) == 1


def test_a_long_search_would_be_noticed() -> None:
    calls: list[str] = []
    counted = replace(equations.LATEX, rows=lambda body: calls.append(body) or [["1"]])
    counted.read(r"\begin{bmatrix}" * 100 + r"\end{bmatrix}", "x")
    assert len(calls) == 1


def test_nine_numbers_are_the_linear_part_of_an_affine_matrix() -> None:
    affine = as_affine(matrix_literal("1 2 3; 4 5 6; 7 8 9")).rows
    assert affine == ((1, 2, 3, 0), (4, 5, 6, 0), (7, 8, 9, 0), (0, 0, 0, 1))


COLUMNS = "1 0 0 0; 0 1 0 0; 0 0 1 0; 5 6 7 1"


def test_a_transposed_affine_matrix_is_recognised_with_the_remedy() -> None:
    hint = r"this looks column-major or row-vector: input_layout column-major"
    with pytest.raises(IllegalValueError, match=hint):
        as_affine(matrix_literal(COLUMNS))
    assert as_affine(matrix_literal(COLUMNS, Layout.COLUMN_MAJOR)).rows[0] == (1, 0, 0, 5)


@pytest.mark.parametrize(
    "text", ["1 0 0 0; 0 1 0 0; 0 0 1 0; 5 6 7 2", "1 2; 3 4", "1 0 0; 0 1 0", "1 2 3", "mat4(2.0)"]
)
def test_not_affine(text: str) -> None:
    with pytest.raises(IllegalValueError):
        as_affine(matrix_literal(text))


def test_a_projection_is_any_sixteen_numbers() -> None:
    assert as_projection(matrix_literal("mat4(2.0)")).rows[3] == (0, 0, 0, 2)
    with pytest.raises(IllegalValueError, match="3 × 3"):
        as_projection(matrix_literal("mat3(2.0)"))


@pytest.mark.parametrize(
    "text", ["1 2 3", "1,2,3", "[1,2,3]", "1;2;3", "vec3(1,2,3)", "[[1],[2],[3]]"]
)
def test_vectors(text: str) -> None:
    for layout in Layout:
        found = matrix_literal(text, layout).rows
        assert [entry for row in found for entry in row] == [1.0, 2.0, 3.0]


def test_a_vector_keeps_its_shape_in_either_layout() -> None:
    assert matrix_literal("1 2 3", Layout.COLUMN_MAJOR).shape == (1, 3)
    assert matrix_literal("1; 2; 3", Layout.COLUMN_MAJOR).shape == (3, 1)


@pytest.mark.parametrize("text", ["-16 -1,75 3", "1,5 2,5 3,5", "1,2 3,4"])
def test_a_decimal_comma_is_not_taken_for_two_numbers(text: str) -> None:
    with pytest.raises(IllegalValueError, match="may be one number or two"):
        matrix_literal(text)


@pytest.mark.parametrize("text", ["1,2,3", "1, 2, 3", "1 ,2 , 3", "1,2, 3", "[1,2,3]"])
def test_commas_between_all_numbers_separate_them(text: str) -> None:
    assert matrix_literal(text).rows == ((1.0, 2.0, 3.0),)
