"""Whatever nmatrix writes for programs is read again to the same floats, bit for bit."""

from __future__ import annotations

import json
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nmatrix.enums import Format, Layout
from nmatrix.output import OutputOptions, write
from nmatrix.output import glsl as glsl_writer
from nmatrix.reading.matrix import matrix_literal
from nmatrix.report import Quantity, Report

FLOATS = st.floats(allow_nan=False, allow_infinity=False)
SIZES = st.sampled_from([2, 3, 4])
SQUARE = SIZES.flatmap(
    lambda size: st.lists(
        st.lists(FLOATS, min_size=size, max_size=size).map(tuple), min_size=size, max_size=size
    ).map(tuple)
)
MACHINE = [Format.JSON, Format.CSV, Format.NUMPY, Format.GLSL]
ALL = [*MACHINE, Format.LATEX]


def report(matrix: tuple[tuple[float, ...], ...]) -> Report:
    data = {
        "determinant": 2.0,
        "parts": {"translate": (1.0, 2.0, 3.0)},
        "eye": (0.0, 0.0, 5.0),
        "value": matrix,
        "transform": "shear",
        "metric": None,
    }
    remarks = ("mat4 in a remark, and array([1, 2]) too.",)
    return Report("calc", data, (Quantity("value", matrix),), remarks)


def bits(rows: tuple[tuple[float, ...], ...]) -> list[list[str]]:
    return [[(entry + 0.0).hex() for entry in row] for row in rows]


@pytest.mark.parametrize("format_", MACHINE)
@pytest.mark.parametrize("layout", list(Layout))
@given(matrix=SQUARE)
@settings(max_examples=60, deadline=None)
def test_same_bits(format_: Format, layout: Layout, matrix: tuple[tuple[float, ...], ...]) -> None:
    text = write(report(matrix), OutputOptions(format_, layout=layout))
    assert bits(matrix_literal(text).rows) == bits(matrix)


@given(matrix=SQUARE)
@settings(max_examples=60, deadline=None)
def test_latex_to_its_digits(matrix: tuple[tuple[float, ...], ...]) -> None:
    text = write(report(matrix), OutputOptions(Format.LATEX, digits=17))
    assert bits(matrix_literal(text).rows) == bits(matrix)


@pytest.mark.parametrize("format_", ALL)
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
