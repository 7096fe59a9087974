"""JavaScript constants: arrays of rows, or the flat column-major arrays that WebGL reads."""

from __future__ import annotations

from functools import partial

from nmatrix.enums import Format, Layout
from nmatrix.output.assignments import Assigned, Language, flat, matrix, number, program, vector
from nmatrix.output.numbers import arranged, is_matrix, is_number, is_vector
from nmatrix.output.write import OutputOptions
from nmatrix.report import Report

_LAYOUTS = {
    Layout.ROW_MAJOR: "layout: row-major, each matrix is an array of its rows",
    Layout.COLUMN_MAJOR: "layout: column-major, flat, ready for gl.uniformMatrix4fv",
}


def write(report: Report, options: OutputOptions) -> str:
    """Write a constant for every number, vector and matrix under its key.

    Raises
    ------
    IllegalValueError
        If the report has no numbers.

    Examples
    --------
    >>> print(write(Report("calc", {"value": (1.0, 2.0)}, ()), OutputOptions()).splitlines()[-1])
    const value = [1.0, 2.0];
    """
    constant = partial(_constant, options.layout)
    return program(report, Language(Format.JS, "//", f"{_LAYOUTS[options.layout]}.", constant))


def _constant(layout: Layout, name: str, value: Assigned) -> str:
    if is_matrix(value):
        rows = arranged(value, layout)
        written = flat(rows) if layout is Layout.COLUMN_MAJOR else matrix(rows)
    elif is_vector(value):
        written = vector(value)
    elif is_number(value):
        written = number(value)
    else:
        written = "true" if value else "false"
    return f"const {name} = {written};"
