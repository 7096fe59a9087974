"""Whatever is written in a machine format is read again bit for bit."""

from __future__ import annotations

import struct
from math import isfinite

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nmatrix.enums import Format, Layout
from nmatrix.errors import IllegalValueError
from nmatrix.output.options import Charset, OutputOptions
from nmatrix.output.write import write
from nmatrix.reading.matrix import matrix_literal
from nmatrix.reading.numbers import fraction, number
from nmatrix.report import Quantity, Report

bits = st.binary(min_size=8, max_size=8).map(lambda raw: struct.unpack("<d", raw)[0])
floats = st.one_of(bits.filter(isfinite), st.integers(-9, 9).map(float))
matrices = st.lists(st.lists(floats, min_size=4, max_size=4), min_size=4, max_size=4)


def report(rows: list[list[float]]) -> Report:
    matrix = tuple(map(tuple, rows))
    return Report("test", {"value": matrix}, (Quantity("value", matrix),))


@pytest.mark.parametrize("format_", [Format.JSON, Format.CSV, Format.NUMPY, Format.GLSL])
@pytest.mark.parametrize("layout", Layout)
@given(rows=matrices)
@settings(max_examples=40, deadline=None)
def test_machine_formats(format_: Format, layout: Layout, rows: list[list[float]]) -> None:
    if format_ is Format.NUMPY and layout is Layout.COLUMN_MAJOR:
        return  # plain code says its layout in a comment only; the reader is told by an option
    text = write(report(rows), OutputOptions(format_, layout=layout))
    assert [list(row) for row in matrix_literal(text).rows] == [[x + 0.0 for x in r] for r in rows]


@given(rows=matrices)
@settings(max_examples=60, deadline=None)
def test_text_fits_the_page_in_either_charset(rows: list[list[float]]) -> None:
    for charset in Charset:
        text = write(report(rows), OutputOptions(charset=charset))
        assert max(map(len, text.splitlines())) <= 80
        if charset is Charset.ASCII:
            assert text.isascii()


@given(floats)
@settings(max_examples=200, deadline=None)
def test_numbers_are_the_nearest_float(x: float) -> None:
    assert number(repr(x)) == x
    assert fraction(repr(x)).numerator / fraction(repr(x)).denominator == x


@pytest.mark.parametrize(
    "text",
    [
        "nan",
        "inf",
        "1e999",
        "1e-400",
        "1_0",
        "0x1",
        "１",
        "1/0",
        "",
        "1e20000000",
        "9" * 10**6,
        "--1",
    ],
)
def test_what_is_no_number_is_refused_at_once(text: str) -> None:
    with pytest.raises(IllegalValueError) as caught:
        number(text)
    assert len(str(caught.value)) < 400


@pytest.mark.parametrize(
    "text",
    [
        "1 0 0; 0 2 0; 0 0 1",
        "[[1,0,0],[0,2,0],[0,0,1]]",
        "[[1. 0. 0.]\n [0. 2. 0.]\n [0. 0. 1.]]",
        "array([[1., 0., 0.],\n       [0., 2., 0.],\n       [0., 0., 1.]])",
        "1 0 0 0 2 0 0 0 1",
        "1,0,0,0,2,0,0,0,1",
        "mat3(1.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 1.0)",
        "mat3(vec3(1, 0, 0), vec3(0, 2, 0), vec3(0, 0, 1))",
        r"\begin{bmatrix} 1 & 0 & 0 \\ 0 & 2 & 0 \\ 0 & 0 & 1 \end{bmatrix}",
    ],
)
def test_every_notation_of_the_same_matrix(text: str) -> None:
    assert matrix_literal(text).rows == ((1.0, 0.0, 0.0), (0.0, 2.0, 0.0), (0.0, 0.0, 1.0))


def test_glsl_is_column_major() -> None:
    assert matrix_literal("mat3(1,2,3, 4,5,6, 7,8,9)").rows[0] == (1.0, 4.0, 7.0)


@pytest.mark.parametrize(
    "text", ["(" * 10**5, "[" * 10**5, "\x00", "1 2 x", "a" * 10**6, "[[1,2],[3]]"]
)
def test_hostile_matrices_are_refused_in_one_line(text: str) -> None:
    with pytest.raises(IllegalValueError) as caught:
        matrix_literal(text)
    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) < 400
