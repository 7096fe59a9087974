"""Python statements that build the report's numbers as NumPy arrays."""

from __future__ import annotations

from functools import partial

from nmatrix.enums import Format, Layout
from nmatrix.output.assignments import Assigned, Language, matrix, number, program, vector
from nmatrix.output.numbers import arranged, is_matrix, is_number, is_vector
from nmatrix.output.write import OutputOptions
from nmatrix.report import Report


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
    about, statement = f"layout: {options.layout}", partial(_statement, options.layout)
    numpy = Language(Format.NUMPY, "#", about, statement, ("import numpy as np", ""))
    return program(report, numpy)


def _statement(layout: Layout, name: str, value: Assigned) -> str:
    if is_matrix(value):
        written = f"np.array({matrix(arranged(value, layout))})"
    elif is_vector(value):
        written = f"np.array({vector(value)})"
    else:
        written = number(value) if is_number(value) else str(value)
    return f"{name} = {written}"
