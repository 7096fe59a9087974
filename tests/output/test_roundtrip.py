"""Whatever nmatrix writes is read again: to the same floats, or to the same fractions and roots."""

from __future__ import annotations

import json
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nmatrix.enums import PARTICULAR_FORMATS, Format, Layout, Numbers
from nmatrix.errors import IllegalValueError
from nmatrix.output import OutputOptions, write
from nmatrix.output import glsl as glsl_writer
from nmatrix.output.write import Charset
from nmatrix.reading.matrix import matrix_literal
from nmatrix.report import LARGEST_MATRIX, Quantity, Report, ShownMatrix
from nmatrix.surds import root

FORMATS = [one for one in Format if one not in PARTICULAR_FORMATS]  # that write numbers
MACHINE = [Format.JSON, Format.CSV, Format.NUMPY, Format.GLSL, Format.JS]
FLOATS = st.floats(allow_nan=False, allow_infinity=False)
SHORT = st.builds(Fraction, st.integers(-999, 999), st.integers(1, 999))
ROOTS = st.builds(
    lambda before, under: float(before) * under**0.5, SHORT, st.sampled_from([2, 3, 5, 6, 7])
)
ENTRIES = st.one_of(FLOATS, SHORT.map(float), ROOTS)
SIDES = st.integers(2, LARGEST_MATRIX)
MATRICES = st.tuples(SIDES, SIDES).flatmap(
    lambda size: st.lists(
        st.lists(ENTRIES, min_size=size[1], max_size=size[1]).map(tuple),
        min_size=size[0],
        max_size=size[0],
    ).map(tuple)
)
HALF_ROOT = root(3) / 2
EXACT = {
    "fractions": ((Fraction(1, 3), Fraction(-22, 7)), (Fraction(0), Fraction(999, 1000))),
    "surds": ((HALF_ROOT, Fraction(-1, 2)), ((root(6) - root(2)) / 4, 1 - root(5))),
    "a turn by 30 degrees": (
        (HALF_ROOT, Fraction(-1, 2), Fraction(0), Fraction(1)),
        (Fraction(1, 2), HALF_ROOT, Fraction(0), -root(Fraction(1, 2))),
        (Fraction(0), Fraction(0), Fraction(1), 2 * root(3) / 3),
        (Fraction(0), Fraction(0), Fraction(0), Fraction(1)),
    ),
    "corners of a box": tuple(
        tuple(Fraction((-1) ** (corner >> row & 1), row + 2) for corner in range(8))
        for row in range(4)
    ),
    "8 by 8": tuple(tuple(root(1 + 8 * r + c) / (1 + r) for c in range(8)) for r in range(8)),
}


def report(matrix: ShownMatrix) -> Report:
    data = {
        "determinant": 2.0,
        "parts": {"translate": (1.0, 2.0, 3.0)},
        "eye": (0.0, 0.0, 5.0),
        "value": matrix,
        "transform": "shear",
        "metric": None,
    }
    remarks = ("mat4 in a remark, and array([1, 2]) too.",)
    blocks = (Quantity("value", matrix, "what came out"), Quantity("eye", (0.0, 0.0, 5.0)))
    return Report("calc", data, blocks, remarks)


def bits(rows: ShownMatrix) -> list[list[str]]:
    return [[(float(entry) + 0.0).hex() for entry in row] for row in rows]


@pytest.mark.parametrize("format_", FORMATS)
@pytest.mark.parametrize("numbers", Numbers)
@given(matrix=MATRICES, layout=st.sampled_from(list(Layout)))
@settings(max_examples=12, deadline=None)
def test_every_format_is_read_again_bit_for_bit(
    format_: Format, numbers: Numbers, matrix: tuple[tuple[float, ...], ...], layout: Layout
) -> None:
    text = write(report(matrix), OutputOptions(format_, layout=layout, digits=17, numbers=numbers))
    assert bits(matrix_literal(text).rows) == bits(matrix)


@pytest.mark.parametrize("format_", FORMATS)
@pytest.mark.parametrize("name", EXACT)
def test_fractions_and_roots_are_read_again_as_what_they_are(format_: Format, name: str) -> None:
    """Formats for people keep the very number, those for programs the nearest float."""
    matrix = EXACT[name]
    for numbers in (Numbers.EXACT, Numbers.BOTH):
        for charset in Charset:
            if name not in ("fractions", "surds", "a turn by 30 degrees"):
                continue  # without names of axes, ASCII brackets may stand around a piece
            options = OutputOptions(format_, numbers=numbers, charset=charset, width=150)
            found = matrix_literal(write(report(matrix), options))
            assert bits(found.rows) == bits(matrix)
            if format_ not in MACHINE:
                assert found.rows_typed == matrix
    found = matrix_literal(write(report(matrix), OutputOptions(format_, numbers=Numbers.EXACT)))
    assert bits(found.rows) == bits(matrix)
    assert format_ in MACHINE or found.rows_typed == matrix


def test_a_drawing_in_ascii_that_may_be_in_pieces_is_refused() -> None:
    matrix = EXACT["corners of a box"]
    text = write(report(matrix), OutputOptions(charset=Charset.ASCII, width=60))
    assert text.count("\n  [ ") == 2 * len(matrix)  # two pieces
    with pytest.raises(IllegalValueError, match="do not tell its rows from its pieces"):
        matrix_literal(text)


@pytest.mark.parametrize("format_", [one for one in FORMATS if one is not Format.TEXT])
@pytest.mark.parametrize("key", ["eye", "parts.translate", "parts_translate"])
def test_a_key_chooses_a_vector(format_: Format, key: str) -> None:
    text = write(report(((1.0, 2.0), (3.0, 4.0))), OutputOptions(format_))
    entries = [entry for row in matrix_literal(text, key=key).rows for entry in row]
    assert entries == ([0.0, 0.0, 5.0] if key == "eye" else [1.0, 2.0, 3.0])


@pytest.mark.parametrize("format_", MACHINE)
def test_a_text_that_states_its_layout_is_believed(format_: Format) -> None:
    matrix = ((1.0, 2.0, 3.0), (4.0, 5.0, 6.0), (7.0, 8.0, 9.0))
    for written in Layout:
        text = write(report(matrix), OutputOptions(format_, layout=written))
        for said in Layout:
            assert matrix_literal(text, said).rows == matrix


def test_column_major_json_is_the_transpose_and_leaves_all_else() -> None:
    matrix = ((1.0, 2.0), (3.0, 4.0))
    found = json.loads(
        write(report(matrix), OutputOptions(Format.JSON, layout=Layout.COLUMN_MAJOR))
    )
    assert found["value"] == [[1.0, 3.0], [2.0, 4.0]]
    assert found["eye"] == [0.0, 0.0, 5.0]
    assert found["layout"] == "column-major"


def test_uniform_values_behind_shaders_are_read_again() -> None:
    matrix = tuple(tuple(float(4 * row + column) for column in range(4)) for row in range(4))
    data = {
        "vertex_shader": "#version 300 es\nvoid main() {\n  mat3 m = mat3(u);\n}\n",
        "fragment_shader": "#version 300 es\nvoid main() {\n  vec3 n = vec3(v);\n}\n",
        "uniforms": {"world_from_object": matrix, "to_light": (0.0, 1.0, 0.0)},
    }
    text = write(Report("space", data, ()), OutputOptions(Format.GLSL))
    assert text.startswith("#version 300 es\n")
    assert text.count(f"\n{glsl_writer.SHADER_BREAK}\n#version 300 es\n") == 1
    assert matrix_literal(text).rows == matrix
    assert matrix_literal(text, key="to_light").rows == ((0.0, 1.0, 0.0),)


def test_the_round_trip_notices_a_writer_that_forgets_to_transpose(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(glsl_writer, "transpose", lambda matrix: matrix)
    text = write(report(((1.0, 2.0), (3.0, 4.0))), OutputOptions(Format.GLSL))
    assert matrix_literal(text).rows == ((1.0, 3.0), (2.0, 4.0))


def test_fractions_are_written_as_the_nearest_float() -> None:
    third = Fraction(1, 3)
    text = write(report(((third, third), (third, 0.5))), OutputOptions(Format.JSON))  # type: ignore[arg-type]
    assert json.loads(text)["value"][0] == [1 / 3, 1 / 3]
