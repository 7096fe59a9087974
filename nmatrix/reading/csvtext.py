"""Matrices in nmatrix's own CSV, `key,row,column,value`: each entry names its place."""

from __future__ import annotations

import csv
import re
from functools import partial
from io import StringIO

from nmatrix.enums import Layout
from nmatrix.reading.literal import Notation, unreadable

HEADER = re.compile(r"\Akey,row,column,value\s*(\n|$)")
LARGEST = 16  # rows or columns that are filled in
_PLACE = re.compile(r"[0-9]{1,2}")

Places = dict[tuple[int, int], str]

_unreadable = partial(unreadable, next_step="write it with -f csv")


def csv_notation(text: str, source: str) -> Notation:
    r"""Read the matrices and vectors of a CSV report; their places fix the layout.

    Raises
    ------
    IllegalValueError
        If a line has more or fewer than four fields, or a matrix has a gap.

    Examples
    --------
    >>> csv_notation("key,row,column,value\na,1,0,2\na,0,0,1\n", "x").quantities
    {'a': [['1'], ['2']]}
    """
    found: dict[str, Places] = {}
    try:
        for record in list(csv.reader(StringIO(text), strict=True))[1:]:
            _keep(record, found, source)
    except csv.Error as error:
        raise _unreadable(source, f"not CSV: {error}") from None
    quantities = {key: _rows(places, key, source) for key, places in found.items()}
    return Notation(quantities, Layout.ROW_MAJOR, exact=True)


def _keep(record: list[str], found: dict[str, Places], source: str) -> None:
    if not record:
        return
    if len(record) != 4:
        raise _unreadable(source, f"a line has {len(record)} fields")
    key, row, column, value = record
    if _PLACE.fullmatch(row) and (not column or _PLACE.fullmatch(column)):
        # A vector has no column: it is written along one row.
        place = (int(row), int(column)) if column else (0, int(row))
        found.setdefault(key, {})[place] = value


def _rows(places: Places, key: str, source: str) -> list[list[str]]:
    height = 1 + max(row for row, _ in places)
    across = 1 + max(column for _, column in places)
    if len(places) != height * across:
        raise _unreadable(source, f"{key} lacks {height * across - len(places)} of its entries")
    return [[places[row, column] for column in range(across)] for row in range(height)]
