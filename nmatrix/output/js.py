"""JavaScript constants: arrays of rows, or the flat column-major arrays that WebGL reads."""

from __future__ import annotations

from nmatrix.enums import Format, Layout
from nmatrix.output.assignments import (
    Assignment,
    assignments,
    comment,
    flat,
    matrix,
    require_numbers,
    vector,
)
from nmatrix.output.numbers import round_trip_text
from nmatrix.output.options import OutputOptions
from nmatrix.output.quantities import arranged, is_matrix, is_number, is_vector
from nmatrix.report import Report
from nmatrix.version import __version__

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
    require_numbers(report, Format.JS)
    lines = [f"// nmatrix {report.command} {__version__}; {_LAYOUTS[options.layout]}."]
    lines += [_constant(each, options.layout) for each in assignments(report.data)]
    lines += [f"// {comment(remark)}" for remark in report.remarks]
    return "\n".join(lines) + "\n"


def _constant(each: Assignment, layout: Layout) -> str:
    value = each.value
    if value is None:
        return f"// {comment(each.note)}"
    if is_matrix(value):
        rows = arranged(value, layout)
        written = flat(rows) if layout is Layout.COLUMN_MAJOR else matrix(rows)
    elif is_vector(value):
        written = vector(value)
    elif isinstance(value, bool):
        written = "true" if value else "false"
    else:
        written = (round_trip_text(value) if is_number(value) else None) or "null"
    return f"const {each.name} = {written};"
