r"""Rows of numbers without brackets: lines or semicolons, blanks, tabs or commas.

Consoles put frames around them, bars at both ends or a heading; a frame is taken off first.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from nmatrix.errors import IllegalValueError, counted
from nmatrix.reading.brackets import MOST, plain_number
from nmatrix.reading.contents import SQUARES, Contents, Tokens, cut_off, unreadable

# SymPy, nalgebra and Julia draw brackets, cglm bars; R and Julia have a heading.
_FRAME = re.compile(
    r"\A(?:Matrix \(float[234]x[234]\):|[234]×[234] [^\n:]{1,120}:)|[|│┃┌┐└┘⎡⎤⎢⎥⎣⎦⎛⎞⎜⎟⎝⎠]"
    r"|\[[ ]*[0-9]?,[0-9]?\]"
)
_ELEMENT = re.compile(
    r"<\w+\b[^<>]*?(?:\bvalue\s*=\s*\"(?P<value>[^\"<>]+)\"[^<>]*/?>|>(?P<inside>[^<>]+)</\w+\s*>)"
)
_SEPARATOR = re.compile(r"\s*,\s*|\s+")
_PARTED = re.compile(r"[\s;]+")
_BLANK = re.compile(r"[^\s,]\s+[^\s,]")
_TIGHT_COMMA = re.compile(r"(?<![0-9])[0-9]*,[0-9]+")
_COMMA_NUMBER = re.compile(r"[+\-−]?[0-9]+(?:,[0-9]+)?(?:[eE][+\-−]?[0-9]+)?")


def bare_rows(text: str, source: str) -> Contents:
    r"""Read a text without brackets: lines or semicolons end a row.

    Where line ends part the rows and blanks, tabs or semicolons the entries, a comma is a decimal
    point.

    Raises
    ------
    IllegalValueError
        If there are more numbers than any matrix has, or a comma may be a decimal point.

    Examples
    --------
    >>> bare_rows("1 0; 0, 2", "x").quantities, bare_rows("1,5;0\n0;2,5", "x").quantities
    ({'': [['1', '0'], ['0', '2']]}, {'': [['1.5', '0'], ['0', '2.5']]})
    """
    lines = [line.removesuffix(",") for line in map(str.strip, text.split("\n", MOST)) if line]
    rows = _with_decimal_commas(lines) or _with_points(lines, source)
    if sum(len(row) for row in rows) > MOST:
        raise unreadable(source, f"it holds more than {MOST} numbers")
    widths = [len(row) for row in rows]
    if len(rows) > 1 and len(set(widths[:-1])) == 1 and widths[-1] < widths[0] <= len(rows) + 1:
        raise cut_off(
            source, f"in row {len(rows)}, after {widths[-1]} of {counted(widths[0], 'number')}"
        )
    return Contents({"": [[plain_number(one) for one in row] for row in rows]})


def streamed_rows(text: str, source: str) -> Contents:
    """Read numbers that C++ streams into a square matrix, one after another or line by line.

    Examples
    --------
    >>> streamed_rows("m << 1,0,0, 0,1,0, 0,0,1;", "x").quantities[""][1]
    ['0', '1', '0']
    """
    found = bare_rows(text.partition("<<")[2].rstrip("; \n"), source).quantities[""]
    numbers = [one for row in found for one in row]
    side = SQUARES.get(len(numbers))
    if side is None:
        return Contents({"": found})
    return Contents({"": [numbers[at : at + side] for at in range(0, len(numbers), side)]})


def framed_rows(text: str, source: str) -> Contents:
    r"""Read rows in a frame.

    Examples
    --------
    >>> framed_rows("| 1 0 |\n| 0 2 |", "x").quantities
    {'': [['1', '0'], ['0', '2']]}
    """
    return bare_rows(_FRAME.sub(" ", text), source)


def element_rows(text: str, source: str) -> Contents:
    """Read the numbers of an element of XML, between its tags or in its attribute `value`.

    Examples
    --------
    >>> element_rows('<matrix sid="t">1 0 0 0 2 0 0 0 3</matrix>', "x").quantities
    {'': [['1', '0', '0'], ['0', '2', '0'], ['0', '0', '3']]}
    """
    found = _ELEMENT.match(text)
    if found is None:
        raise cut_off(source, "before its closing tag or quote")
    numbers = (found["value"] or found["inside"]).split(None, MOST)
    side = SQUARES.get(len(numbers), len(numbers)) or 1
    return Contents({"": [numbers[at : at + side] for at in range(0, len(numbers), side)]})


def _with_decimal_commas(lines: Sequence[str]) -> Tokens:
    """Part the entries of lines in which every number has at most one comma, and some one has it.

    The result is empty where the lines are not like that.
    """
    rows = [_PARTED.split(line.strip(";"), maxsplit=MOST) for line in lines]
    words = [word for row in rows for word in row]
    if len(rows) < 2 or min(map(len, rows)) < 2 or not any("," in word for word in words):
        return []
    if not all(_COMMA_NUMBER.fullmatch(word) for word in words):
        return []
    return [[word.replace(",", ".") for word in row] for row in rows]


def _with_points(lines: Sequence[str], source: str) -> Tokens:
    """Part rows at line ends and semicolons, or at line ends where semicolons part entries."""
    pieces = [[*filter(None, map(str.strip, line.split(";", MOST)))] for line in lines]
    rows = [piece for line in pieces for piece in line]
    if len(lines) > 1 and max(map(len, pieces)) > 1 and not any(map(_SEPARATOR.search, rows)):
        return pieces
    for row in rows:
        _refuse_decimal_comma(row, source)
    return [_SEPARATOR.split(row, maxsplit=MOST) for row in rows]


def _refuse_decimal_comma(line: str, source: str) -> None:
    """Refuse a line whose numbers are set apart by blanks and that has commas inside as well."""
    tight = _TIGHT_COMMA.search(line)
    if tight is not None and _BLANK.search(line) is not None:
        point = tight[0].replace(",", ".")
        raise IllegalValueError(
            f"matrix ({source})",
            f"{tight[0]} may be one number or two",
            f"write {point}, or commas between all numbers",
        )
