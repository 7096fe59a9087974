"""Matrices that name their places: nmatrix's CSV, Unity's fields, Unreal's planes, YAML's rows."""

from __future__ import annotations

import csv
import re
from functools import partial
from io import StringIO
from itertools import islice

from nmatrix.enums import Layout
from nmatrix.errors import counted
from nmatrix.reading.brackets import PAIRS, plain_number
from nmatrix.reading.contents import Contents, cut_off, unreadable

HEADER = re.compile(r"\Akey,row,column,value\s*(\n|$)")
_PLACE = re.compile(r"[0-9]{1,2}")
# Of two digits the first counts rows, the second columns; a number alone counts the entries.
_FIELD = re.compile(
    r"(?<![\w.])[\"']?(?:(?P<letter>[A-Za-z])(?P<row>[0-4])(?P<column>[0-4])|(?P<index>[0-9]{1,2}))"
    r"[\"']?\s?[:=]\s?(?P<value>[^\s,;{}()\[\]]+)"
)
_PLANE = re.compile(r"[XYZW]\"?\s?[=:][^\[\](){}]*")
_PLANE_ENTRY = re.compile(r"\b(?P<name>[XYZW])\"?\s?[=:]\s?(?P<value>[^\s,\"]+)")
_LETTER = "XYZW".index
YAML_TAG = "!!opencv-matrix"  # its numbers come some lines later
YAML = re.compile(
    r"\A[\w:!\s-]{0,80}?\brows:\s*(?P<rows>[1-4])[\s,]+cols:\s*(?P<cols>[1-4])[\s,]+"
    r"(?:dt:\s*\w+[\s,]+)?data:\s*\[(?P<data>[^\[\]]*)(?P<end>\]?)"
)
LARGEST = 4  # rows of a matrix
MOST = 64  # fields; System.Numerics and DOMMatrix have others beside their sixteen

Places = dict[tuple[int, int], str]

_unreadable = partial(unreadable, next_step="write it with -f csv")


def csv_report(text: str, source: str) -> Contents:
    r"""Read the matrices and vectors of a CSV report; their places fix the layout.

    Raises
    ------
    IllegalValueError
        If a line has more or fewer than four fields, or a matrix has a gap.

    Examples
    --------
    >>> csv_report("key,row,column,value\na,1,0,2\na,0,0,1\n", "x").quantities
    {'a': [['1'], ['2']]}
    """
    found: dict[str, Places] = {}
    try:
        for record in list(csv.reader(StringIO(text), strict=True))[1:]:
            _keep(record, found, source)
    except csv.Error as error:
        raise _unreadable(source, f"not CSV: {error}") from None
    quantities = {}
    for key, places in found.items():
        if lacking := _gaps(places):
            raise _unreadable(source, f"{key} lacks {lacking} of its entries")
        quantities[key] = _rows(places)
    return Contents(quantities, Layout.ROW_MAJOR, exact=True)


def fields(text: str, source: str) -> Contents:
    """Read the fields of one matrix, as JSON, YAML and consoles write them.

    Raises
    ------
    IllegalValueError
        If some are lacking, or one is there twice.

    Examples
    --------
    >>> fields('{"e00": 1, "e01": 2, "e10": 3, "e11": 4}', "x").quantities
    {'': [['1', '2'], ['3', '4']]}
    """
    places: Places = {}
    for count, one in enumerate(_FIELD.finditer(text)):
        index = one["index"]
        place = (0, int(index)) if index else (int(one["row"]), int(one["column"]))
        if place in places or count >= MOST:
            raise unreadable(source, "it holds several matrices", "give one of them")
        places[place] = plain_number(one["value"].strip("\"'"))
    if not places:
        raise cut_off(source, "before its first number")
    if min(min(place) for place in places):  # .NET and CSS count from 1
        places = {(row - 1, column - 1): value for (row, column), value in places.items()}
    lacking = _gaps(places)
    unclosed = [end for start, end in PAIRS.items() if text.count(start) > text.count(end)]
    if lacking or unclosed:
        missing = f"{lacking} are missing" if lacking else f"{unclosed[0]} is missing"
        raise cut_off(source, f"after {counted(len(places), 'number')}: {missing}")
    return Contents({"": _rows(places)})


def planes(text: str, source: str) -> Contents:
    """Read rows whose numbers are called X, Y, Z and W, in any order.

    Raises
    ------
    IllegalValueError
        If a row lacks one of the names that another has.

    Examples
    --------
    >>> planes("[X=1 Y=2] [Y=4 X=3]", "x").quantities
    {'': [['1', '2'], ['3', '4']]}
    """
    found = [
        {one["name"]: one["value"] for one in islice(_PLANE_ENTRY.finditer(plane[0]), MOST)}
        for plane in islice(_PLANE.finditer(text), LARGEST + 1)
    ]
    if not all(row.keys() == found[0].keys() for row in found) or text[-1] not in "])}":
        raise cut_off(source, f"in row {len(found)}")
    return Contents(
        {"": [[plain_number(row[name]) for name in sorted(row, key=_LETTER)] for row in found]}
    )


def yaml_matrix(text: str, source: str) -> Contents:
    """Read a matrix that says how many rows and columns its list of numbers has.

    Examples
    --------
    >>> yaml_matrix("rows: 2, cols: 1, data: [3, 4]", "x").quantities
    {'': [['3'], ['4']]}
    """
    told = YAML.search(text)
    assert told is not None  # it is the sign of the notation
    numbers = told["data"].replace(",", " ").split(None, MOST)
    height, width = int(told["rows"]), int(told["cols"])
    if not told["end"] or len(numbers) != height * width:
        raise cut_off(source, f"after {counted(len(numbers), 'number')} of {height * width}")
    return Contents({"": [numbers[at : at + width] for at in range(0, len(numbers), width)]})


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


def _gaps(places: Places) -> int:
    height, width = _extent(places)
    return height * width - len(places)


def _rows(places: Places) -> list[list[str]]:
    height, width = _extent(places)
    return [[places[row, column] for column in range(width)] for row in range(height)]


def _extent(places: Places) -> tuple[int, int]:
    return 1 + max(row for row, _ in places), 1 + max(column for _, column in places)
