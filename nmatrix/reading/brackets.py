"""Rows of numbers in brackets, as Python, NumPy and MATLAB write them; or in bare lines.

The scan is one loop over tokens, so that ten thousand brackets cost no more than ten.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field

from nmatrix.enums import Layout
from nmatrix.errors import IllegalValueError, quoted
from nmatrix.reading.literal import Notation, Tokens, unreadable

DEEPEST = 2
PAIRS = {"[": "]", "(": ")"}
MOST = 64  # numbers; a matrix has 16, a slip of the hand a few more

ARRAY = re.compile(
    r"^[ \t]*(?:(?P<name>[A-Za-z_][A-Za-z0-9_]{0,200})[ \t]*=[ \t]*)?"
    r"(?:np\.|numpy\.)?(?:array|matrix)\([ \t\n]*(?=[\[(])",
    re.MULTILINE,
)
_STATED = re.compile(r"^#.*layout: (row-major|column-major)", re.MULTILINE)
_TOKEN = re.compile(r"[\[(]|[\])]|[,;]|[^\s\[\](),;]+")
_ROW_BREAK = re.compile(r"[;\n]")
_SEPARATOR = re.compile(r"\s*,\s*|\s+")
_BLANK = re.compile(r"[^\s,]\s+[^\s,]")
_TIGHT_COMMA = re.compile(r"(?<![0-9])[0-9]*,[0-9]+")


def list_notation(text: str, source: str) -> Notation:
    r"""Read one bracketed list with nothing after it.

    `[1, 2, 3]` is one row; `[[1, 2], [3, 4]]` and `[1 2; 3 4]` are two.

    Raises
    ------
    IllegalValueError
        If the brackets do not match, nest too deeply, or hold too much; or if text follows them.

    Examples
    --------
    >>> list_notation("[[1. 0.]\n [0. 2.]]", "x").quantities
    {'': [['1.', '0.'], ['0.', '2.']]}
    """
    rows, end = _bracketed(text, source)
    rest = text[end:].strip()
    if rest:
        raise unreadable(source, f"{quoted(rest)} follows the closing bracket")
    return Notation({"": rows})


def numpy_notation(text: str, source: str) -> Notation:
    """Read the arrays of a Python text by name; an array without one has the name "".

    Raises
    ------
    IllegalValueError
        If the brackets of an array do not match.

    Examples
    --------
    >>> numpy_notation("a = np.array([[1., 2.]])", "x").quantities
    {'a': [['1.', '2.']]}
    """
    quantities: dict[str, Tokens] = {}
    for found in ARRAY.finditer(text):
        quantities[found["name"] or ""] = _bracketed(text, source, found.end())[0]
    stated = _STATED.search(text)
    return Notation(quantities, Layout(stated[1]) if stated else None)


def bare_notation(text: str, source: str) -> Notation:
    """Read a text without brackets: lines or semicolons end a row.

    Raises
    ------
    IllegalValueError
        If there are more numbers than any matrix has, or a comma may be a decimal point.

    Examples
    --------
    >>> bare_notation("1 0; 0, 2", "x").quantities
    {'': [['1', '0'], ['0', '2']]}
    """
    lines = [line.strip() for line in _ROW_BREAK.split(text, maxsplit=MOST) if line.strip()]
    for line in lines:
        _refuse_decimal_comma(line, source)
    rows = [_SEPARATOR.split(line, maxsplit=MOST) for line in lines]
    if sum(len(row) for row in rows) > MOST:
        raise unreadable(source, f"it holds more than {MOST} numbers")
    return Notation({"": rows})


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


def _bracketed(text: str, source: str, start: int = 0) -> tuple[list[list[str]], int]:
    """Return the rows of the bracketed list that opens at `start`, and where it ends."""
    scan = _Scan(source)
    for token in _TOKEN.finditer(text, start):
        scan.take(token[0])
        if not scan.opened:
            return [row for row in scan.rows if row], token.end()
    raise unreadable(source, "its brackets are not closed")


@dataclass
class _Scan:
    """Where the scan stands: the rows so far, the open brackets, whether an entry is due."""

    source: str
    rows: list[list[str]] = field(default_factory=lambda: [[]])
    opened: list[str] = field(default_factory=list)
    count: int = 0
    entry_due: bool = True

    def take(self, mark: str) -> None:
        if mark in "[(":
            self._open(mark)
        elif mark in "])":
            self._close(mark)
        elif mark == ";":
            self.rows.append([])
        elif mark == ",":
            self._comma()
        else:
            self._number(mark)

    def _open(self, mark: str) -> None:
        self.opened.append(PAIRS[mark])
        self.rows.append([])
        self.entry_due = True
        if len(self.opened) > DEEPEST:
            raise unreadable(self.source, f"its brackets nest deeper than {DEEPEST}")

    def _close(self, mark: str) -> None:
        if not self.opened or self.opened.pop() != mark:
            raise unreadable(self.source, f"{mark} closes what it did not open")
        self.rows.append([])
        self.entry_due = False

    def _comma(self) -> None:
        if self.entry_due:
            raise unreadable(self.source, "a number is missing before a comma")
        self.entry_due = True

    def _number(self, mark: str) -> None:
        self.rows[-1].append(mark)
        self.entry_due = False
        self.count += 1
        if self.count > MOST:
            raise unreadable(self.source, f"it holds more than {MOST} numbers")
