"""Python statements that build the report's numbers as NumPy arrays."""

from __future__ import annotations

from nmatrix.enums import Format, Layout
from nmatrix.output.assignments import (
    Assignment,
    assignments,
    comment,
    matrix,
    require_numbers,
    vector,
)
from nmatrix.output.numbers import round_trip_text
from nmatrix.output.options import OutputOptions
from nmatrix.output.quantities import arranged, is_matrix, is_number, is_vector
from nmatrix.report import Report
from nmatrix.version import __version__


def write(report: Report, options: OutputOptions) -> str:
    """Write an assignment for every number, vector and matrix under its key.

    Raises
    ------
    IllegalValueError
        If the report has no numbers.

    Examples
    --------
    >>> print(write(Report("calc", {"value": (1.0, 2.0)}, ()), OutputOptions()).splitlines()[-1])
    value = np.array([1.0, 2.0])
    """
    require_numbers(report, Format.NUMPY)
    lines = [
        f"# nmatrix {report.command} {__version__}; layout: {options.layout}",
        "import numpy as np",
        "",
    ]
    lines += [_statement(each, options.layout) for each in assignments(report.data)]
    lines += [f"# {comment(remark)}" for remark in report.remarks]
    return "\n".join(lines) + "\n"


def _statement(each: Assignment, layout: Layout) -> str:
    value = each.value
    if value is None:
        return f"# {comment(each.note)}"
    if is_matrix(value):
        written = f"np.array({matrix(arranged(value, layout))})"
    elif is_vector(value):
        written = f"np.array({vector(value)})"
    elif isinstance(value, bool):
        written = str(value)
    else:
        written = (round_trip_text(value) if is_number(value) else None) or "None"
    return f"{each.name} = {written}"
