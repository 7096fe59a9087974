"""What programs rely on: valid JSON, CSV, Python, JavaScript; null for what no float holds."""

from __future__ import annotations

import ast
import csv
import json
import re
import shutil
import subprocess
from fractions import Fraction
from io import StringIO

import numpy as np
import pytest

from nmatrix.enums import PARTICULAR_FORMATS, Format, Layout
from nmatrix.errors import IllegalValueError
from nmatrix.output import Charset, OutputOptions, write
from nmatrix.output.assignments import identifier
from nmatrix.report import Quantity, Report
from nmatrix.version import __version__

HUGE = Fraction(10) ** 600
DATA = {
    "world_from_object": ((1, 0.5), (-0.0, Fraction(1, 3))),
    "determinant": HUGE,
    "kind": 'say "no", twice\nplease',
    "mirrored": True,
    "spaces": [{"eye": (0.0, 1.0, 2.0), "space": "world"}, {"eye": None, "space": "object"}],
    "pros": [],
    "parts": {},
}
REPORT = Report("world", DATA, (), ("A remark.",))

PEOPLE = {Format.TEXT, Format.LATEX, Format.MARKDOWN, Format.MATHML, Format.TYPST}
OF_NUMBERS = [one for one in Format if one not in PARTICULAR_FORMATS]
PROGRAMS = [one for one in OF_NUMBERS if one not in PEOPLE | {Format.JSON, Format.CSV}]


@pytest.mark.parametrize("format_", OF_NUMBERS)
def test_every_format_writes_every_number_under_its_key(format_: Format) -> None:
    matrix = ((1.5, -2.25, 3.125), (4.0625, 5.75, -6.5), (7.375, 8.875, 9.625))
    data = {"normal_matrix": matrix, "rank": 3, "determinant": 1234.5, "mirrored": True}
    blocks = tuple(Quantity(key, one, key) for key, one in data.items() if key != "mirrored")
    written = write(Report("world", data, blocks), OutputOptions(format_)).replace("\u2212", "-")
    for number in (*(x for row in matrix for x in row), 3, 1234.5):
        assert f"{abs(number):g}" in written
    assert re.search(r"normal.{0,2}matrix", written)


def strict(text: str) -> dict:
    def refuse(constant: str) -> None:
        raise AssertionError(constant)

    return json.loads(text, parse_constant=refuse)


def test_json_holds_the_frame_and_the_data_in_order() -> None:
    found = strict(write(REPORT, OutputOptions(Format.JSON)))
    assert list(found) == ["command", "version", "layout", *DATA, "remarks"]
    assert (found["command"], found["version"]) == ("world", __version__)
    assert found["world_from_object"] == [[1, 0.5], [0.0, 1 / 3]]
    assert found["kind"] == DATA["kind"]
    assert found["spaces"] == [
        {"eye": [0.0, 1.0, 2.0], "space": "world"},
        {"eye": None, "space": "object"},
    ]


def test_json_keeps_a_matrix_row_on_a_line() -> None:
    assert "    [1, 0.5],\n" in write(REPORT, OutputOptions(Format.JSON))


@pytest.mark.parametrize("value", [HUGE, float("nan"), float("inf"), -(10**400)])
def test_json_outside_float64_is_null_with_a_remark_that_names_the_key(value: float) -> None:
    report = Report("x", {"spaces": [{"eye": (1.0, value)}]}, ())
    found = strict(write(report, OutputOptions(Format.JSON)))
    assert found["spaces"] == [{"eye": [1.0, None]}]
    assert found["remarks"][0].startswith("spaces.0.eye.1 is ")


def test_json_has_no_minus_zero() -> None:
    assert "-0" not in write(Report("x", {"a": [-0.0], "b": -0.0}, ()), OutputOptions(Format.JSON))


def test_json_survives_half_characters_and_ascii_terminals() -> None:
    report = Report("x", {"name": "caf\u00e9 \udce9"}, ())
    utf8 = write(report, OutputOptions(Format.JSON))
    assert strict(utf8.encode().decode())["name"] == "caf\u00e9 \udce9"
    assert write(report, OutputOptions(Format.JSON, charset=Charset.ASCII)).isascii()


def test_csv_names_every_place() -> None:
    rows = list(csv.reader(StringIO(write(REPORT, OutputOptions(Format.CSV)))))
    assert rows[0] == ["key", "row", "column", "value"]
    assert {len(row) for row in rows} == {4}
    table = {tuple(row[:3]): row[3] for row in rows[1:]}
    assert len(table) == len(rows) - 1
    assert table["world_from_object", "1", "1"] == repr(1 / 3)
    assert table["spaces.0.eye", "2", ""] == "2.0"
    assert table["kind", "", ""] == DATA["kind"]
    assert table["mirrored", "", ""] == "true"
    assert table["determinant", "", ""] == ""
    assert any("determinant is 1e+600" in value for value in table.values())


def test_csv_layout_changes_the_order_alone() -> None:
    by_row = write(REPORT, OutputOptions(Format.CSV)).splitlines()
    by_column = write(REPORT, OutputOptions(Format.CSV, layout=Layout.COLUMN_MAJOR)).splitlines()
    assert by_row != by_column
    assert sorted(by_row[4:]) == sorted(by_column[4:])


@pytest.mark.parametrize("layout", list(Layout))
def test_numpy_text_runs(layout: Layout) -> None:
    text = write(REPORT, OutputOptions(Format.NUMPY, layout=layout))
    names: dict[str, object] = {}
    exec(compile(ast.parse(text), "report", "exec"), names)
    expected = np.array([[1, 0.5], [0.0, 1 / 3]])
    expected = expected.T if layout is Layout.COLUMN_MAJOR else expected
    assert np.array_equal(names["world_from_object"], expected)  # type: ignore[arg-type]
    assert names["mirrored"] is True
    assert "determinant" not in names


@pytest.mark.skipif(shutil.which("node") is None, reason="Node.js is not here")
def test_js_text_runs() -> None:
    text = write(REPORT, OutputOptions(Format.JS, layout=Layout.COLUMN_MAJOR))
    script = f"{text}\nconsole.log(JSON.stringify([world_from_object, spaces_0_eye]));"
    done = subprocess.run(["node", "-e", script], capture_output=True, text=True, check=True)
    assert json.loads(done.stdout) == [[1, 0, 0.5, 1 / 3], [0, 1, 2]]


def test_js_says_its_layout() -> None:
    rows = write(REPORT, OutputOptions(Format.JS))
    flat = write(REPORT, OutputOptions(Format.JS, layout=Layout.COLUMN_MAJOR))
    assert "row-major" in rows.splitlines()[0]
    assert "column-major" in flat.splitlines()[0]
    assert "[1, 0.5]" in rows
    assert "  1, 0.0,\n  0.5, " in flat


def test_glsl_fills_columns_first_and_says_so() -> None:
    text = write(REPORT, OutputOptions(Format.GLSL))
    assert "column-major" in text.splitlines()[0]
    assert f"const mat2 world_from_object = mat2(1.0, 0.0, 0.5, {1 / 3!r});" in text
    assert "const vec3 spaces_0_eye = vec3(0.0, 1.0, 2.0);" in text
    assert "// determinant holds 1e+600" in text


def test_glsl_marks_what_float32_cannot_hold() -> None:
    text = write(Report("x", {"a": 1e300, "b": 1.0}, ()), OutputOptions(Format.GLSL))
    assert "float a = 1e+300;  // outside the range of float32" in text
    assert "float b = 1.0;\n" in text


@pytest.mark.parametrize("format_", PROGRAMS)
def test_programs_need_numbers(format_: Format) -> None:
    with pytest.raises(IllegalValueError, match=r"no numbers.*use text, csv, json"):
        write(Report("derive", {"cases": ["rule"], "none": None}, ()), OutputOptions(format_))


# Words that a compiler of one of the languages refuses as a name, by its specification.
TAKEN = (
    "lambda None True async await yield let static eval arguments float int bool mat4 mat2x3 dmat3"
    " vec3 ivec2 bvec4 uvec3 dvec4 sampler2D isamplerCube image2D struct const in discard flat"
    " precision highp template this goto half fixed union null undefined_ void main"
).split()


@pytest.mark.parametrize("key", ["a.b", "9", "window", "mat-é", "...", "gl_Position", "λ", *TAKEN])
def test_identifiers_are_identifiers(key: str) -> None:
    name = identifier(key)
    assert name.isidentifier()
    assert name.isascii()
    assert not name.startswith("gl_")
    assert name not in TAKEN or name.endswith("_")
    ast.parse(f"{name} = 1")


@pytest.mark.parametrize("format_", PROGRAMS)
def test_remarks_cannot_leave_their_comment(format_: Format) -> None:
    report = Report("x", {"a": 1.0}, (), ("one\nimport os\u2028two",))
    lines = write(report, OutputOptions(format_)).splitlines()
    assert lines[-1].startswith(("# ", "// "))
    assert lines[-1].endswith("one import os two")
