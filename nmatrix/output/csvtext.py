"""CSV, `key,row,column,value`: one line for each number, word or truth value of the report.

Rows and columns count from 0 and are always those of the matrix; the layout decides only which
entry comes first.
"""

from __future__ import annotations

import csv
from collections.abc import Iterable, Iterator, Mapping, Sequence
from io import StringIO

from nmatrix.enums import Layout
from nmatrix.output.jsontext import outside_remark
from nmatrix.output.numbers import (
    is_matrix,
    is_number,
    is_vector,
    leaves,
    round_trip_text,
    significant,
)
from nmatrix.output.write import OutputOptions
from nmatrix.report import Report, Value
from nmatrix.version import __version__

Entry = tuple[str, int | str, int | str, Value]
HEADER = ("key", "row", "column", "value")
RUN = ("=", "+", "-", "@", "\t", "\r")  # how a cell begins that a spreadsheet runs


def write(report: Report, options: OutputOptions) -> str:
    """Write the report as comma-separated values with a header.

    Scalars have neither row nor column, vectors a row; absent things have an empty value. An
    answer that is a list of rows is written as that; no text in it is run by a spreadsheet.

    Examples
    --------
    >>> print(write(Report("calc", {"value": (1.0, 2.5)}, ()), OutputOptions()).splitlines()[-1])
    value,1,,2.5
    """
    if report.records is not None:
        return _lines(report.records.columns, ([*map(_inert, row)] for row in report.records.rows))
    outside = [
        outside_remark(key, significant(value, options.digits))
        for key, _, _, value in _entries(report.data, options.layout)
        if is_number(value) and round_trip_text(value) is None
    ]
    whole: dict[str, Value] = {
        "command": report.command,
        "version": __version__,
        "layout": str(options.layout),
        **report.data,
        "remarks": [*report.remarks, *outside],
    }
    return _lines(HEADER, _entries(whole, options.layout))


def _lines(header: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    text = StringIO()
    lines = csv.writer(text, lineterminator="\n")
    lines.writerow(header)
    lines.writerows(map(_cell, row) for row in rows)
    return text.getvalue()


def _entries(data: Mapping[str, Value], layout: Layout) -> Iterator[Entry]:
    for leaf in leaves(data):
        value = leaf.value
        if is_matrix(value):
            places = [(row, column) for row in range(len(value)) for column in range(len(value[0]))]
            if layout is Layout.COLUMN_MAJOR:
                places.sort(key=lambda place: place[::-1])
            yield from ((leaf.key, row, column, value[row][column]) for row, column in places)
        elif is_vector(value):
            yield from ((leaf.key, row, "", entry) for row, entry in enumerate(value))
        else:
            yield leaf.key, "", "", value


def _inert(value: object) -> object:
    """Put an apostrophe before a text that a spreadsheet would take for a formula and run."""
    return f"'{value}" if isinstance(value, str) and value.startswith(RUN) else value


def _cell(value: object) -> str:
    if value is None:
        return ""
    if isinstance(value, bool):
        return "true" if value else "false"
    if is_number(value):
        return round_trip_text(value) or ""
    return str(value)
