"""Tables that people keep in spreadsheets: CSV with a header, each row with its line number."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from io import StringIO
from itertools import islice

from nmatrix.errors import IllegalValueError, counted, quoted
from nmatrix.reading.files import decoded, existing_file, file_bytes, is_folder
from nmatrix.reading.headers import places_of, plain
from nmatrix.reading.legacy import ENCODINGS, guessed

NAMES = {",": "comma", ";": "semicolon", "\t": "tab"}
SEPARATORS = tuple(NAMES)
DECLARED = "sep="
WORKBOOKS = (b"PK\x03\x04", b"\xd0\xcf\x11\xe0")  # how .xlsx, .ods and .xls begin
LONGEST_NAME = 60  # characters of the header that a message shows


@dataclass(frozen=True)
class Record:
    """One row: the line on which it ends, and its cells by column name, stripped.

    `fault` says what is wrong with the row itself, such as a cell too many.
    """

    line: int
    cells: Mapping[str, str]
    fault: str = ""


@dataclass(frozen=True)
class Records:
    """The rows of a table, and what is to be said of how it was read."""

    rows: tuple[Record, ...]
    remarks: tuple[str, ...] = ()


def records(name: str, needed: Sequence[str]) -> Records:
    """Read the rows of a file, as spreadsheets save it; empty lines are skipped.

    Columns are known by any of their names, and the separator is the comma, semicolon or tab that
    the header uses most.

    Raises
    ------
    IllegalValueError
        If there is no such file, it is not text, or its header lacks a column.
    """
    path = existing_file(name)
    if path is None:
        why = "it is a folder" if is_folder(name) else "there is no such file"
        raise IllegalValueError(f"file ({quoted(name)})", why, "check the path")
    return records_in(file_bytes(path), needed, str(path))


def records_in(content: bytes, needed: Sequence[str], source: str) -> Records:
    r"""Read the rows of bytes in UTF-8, UTF-16, or what a spreadsheet saves by itself.

    Raises
    ------
    IllegalValueError
        If they are a workbook or in no encoding that is known, or the header lacks a column.

    Examples
    --------
    >>> records_in("Name\nZoë\n".encode("cp1252"), ["student"], "x").rows[0].cells["student"]
    'Zoë'
    """
    if content.startswith(WORKBOOKS):
        why, next_step = "it is a workbook, not a table in text", "save it as CSV UTF-8"
        raise IllegalValueError(f"file ({quoted(source)})", why, next_step)
    remarks: list[str] = []
    try:
        text = decoded(content, source)
    except IllegalValueError:
        found = guessed(content)
        if found is None:
            why = "its encoding is none that is known"
            next_step = "save it as CSV UTF-8"
            raise IllegalValueError(f"text ({source})", why, next_step) from None
        text, encoding = found
        remarks.append(
            f"Read as {ENCODINGS[encoding]} text ({encoding}): if names look wrong, save it as CSV "
            "UTF-8."
        )
    return Records(tuple(records_of(text, needed, source)), tuple(remarks))


def records_of(text: str, needed: Sequence[str], source: str) -> Iterator[Record]:
    r"""Read the rows of a text, one after the other.

    Examples
    --------
    >>> [one.cells["student"] for one in records_of("Student\nAda\n\n\"Lovelace, A.\"\n",
    ...  ["student"], "x")]
    ['Ada', 'Lovelace, A.']
    """
    header: _Header | None = None
    text = text.removeprefix("\ufeff").replace("\r\n", "\n")
    separator = _separator(text)
    for line, cells, fault in _rows(text, separator):
        if cells[0].startswith(DECLARED) and header is None:
            continue  # Excel's own line, which says what parts the cells
        if header is None:
            if fault:
                raise IllegalValueError(f"header of {quoted(source)}", fault, "mend the quotes")
            header = _header(cells, needed, source)
        elif fault:
            yield Record(line, header.named(cells), fault)
        else:
            yield _record(line, header, cells, separator)
    if header is None:
        raise IllegalValueError(
            f"file ({quoted(source)})", "it is empty", f"give it the header {','.join(needed)}"
        )


def _rows(text: str, separator: str) -> Iterator[tuple[int, list[str], str]]:
    """Read every row, with the line that it ends on and the fault of its quotes.

    A row that cannot be read costs only its own line: a quote that is never closed would take all
    that follow with it.
    """
    lines = list(StringIO(text))  # at line feeds alone, as csv does
    passed = 0
    while passed < len(lines):
        rows = csv.reader(islice(lines, passed, None), delimiter=separator, strict=True)
        read = 0
        try:
            for row in rows:
                cells = [cell.strip() for cell in row]
                read = rows.line_num
                if any(cells):
                    yield passed + read, cells, ""
            return
        except csv.Error as error:
            whose = [cell.strip(' "\n') for cell in lines[passed + read].split(separator)]
            passed += read + 1
            yield passed, [cell[:LONGEST_NAME] for cell in whose], _told(error)


def _told(error: csv.Error) -> str:
    if "field limit" in str(error):
        return "a cell is too long"
    return "a quote is never closed, or text follows it"


def _separator(text: str) -> str:
    """Choose what parts the cells: as Excel's own first line says, or what the header uses most."""
    head = next((line for line in text.split("\n") if line.strip(' \t;,"')), "")
    declared = head.strip('"').removeprefix(DECLARED)
    if head.strip('"').startswith(DECLARED) and declared[:1] in SEPARATORS:
        return declared[0]
    return max(SEPARATORS, key=head.count)


@dataclass(frozen=True)
class _Header:
    """Where the needed columns stand, and the names of all."""

    names: tuple[str, ...]
    needed: Mapping[str, tuple[int, ...]]

    def named(self, cells: Sequence[str]) -> dict[str, str]:
        """Give the cells of a row by the names of their columns; a missing one is empty."""
        filled = [*cells, *[""] * (len(self.names) - len(cells))]
        named = dict(zip(self.names, filled, strict=False))
        for column, places in self.needed.items():
            named[column] = " ".join(filled[place] for place in places).strip()
        return named


def _header(cells: list[str], needed: Sequence[str], source: str) -> _Header:
    places = {column: places_of(column, cells) for column in needed}
    for column, found in places.items():
        if not found:
            shown = ", ".join(cells)[:LONGEST_NAME]
            many = "two of them" if [plain(one) for one in cells].count(column) > 1 else "none"
            raise IllegalValueError(
                f"header of {quoted(source)} ({shown})",
                f"it needs one column {column} and has {many}",
                f"make the first line {','.join(needed)}",
            )
    return _Header(tuple(cell.lower() for cell in cells), places)


def _record(line: int, header: _Header, cells: list[str], separator: str) -> Record:
    fault = ""
    if len(cells) > len(header.names):
        remedy = f"quote a cell that holds a {NAMES[separator]}"
        fault = f"{len(cells)} cells under {counted(len(header.names), 'column')}: {remedy}"
    return Record(line, header.named(cells), fault)
