"""Tables that people keep in spreadsheets: CSV with a header, each row with its line number."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from io import StringIO
from itertools import islice

from nmatrix.errors import IllegalValueError, counted, quoted
from nmatrix.reading.files import decoded, existing_file, file_bytes, is_folder

NAMES = {",": "comma", ";": "semicolon", "\t": "tab"}
SEPARATORS = tuple(NAMES)
LONGEST_NAME = 60  # characters of the header that a message shows


@dataclass(frozen=True)
class Record:
    """One row: the line on which it ends, and its cells by column name, stripped.

    `fault` says what is wrong with the row itself, such as a cell too many.
    """

    line: int
    cells: Mapping[str, str]
    fault: str = ""


def records(name: str, needed: Sequence[str]) -> list[Record]:
    """Read the rows of a file; empty lines are skipped, column names match in any case.

    The separator is the comma, semicolon or tab that the header uses most.

    Raises
    ------
    IllegalValueError
        If there is no such file, it is not text, or its header lacks a column.
    """
    path = existing_file(name)
    if path is None:
        why = "it is a folder" if is_folder(name) else "there is no such file"
        raise IllegalValueError(f"file ({quoted(name)})", why, "check the path")
    return list(records_of(decoded(file_bytes(path), str(path)), needed, str(path)))


def records_of(text: str, needed: Sequence[str], source: str) -> Iterator[Record]:
    r"""Read the rows of a text, one after the other.

    Examples
    --------
    >>> [one.cells["student"] for one in records_of("Student\nAda\n\n\"Lovelace, A.\"\n",
    ...  ["student"], "x")]
    ['Ada', 'Lovelace, A.']
    """
    head, _, _ = text.partition("\n")
    separator = max(SEPARATORS, key=head.count)
    header: list[str] | None = None
    for line, cells, fault in _rows(text.removeprefix("\ufeff"), separator):
        if header is None:
            if fault:
                raise IllegalValueError(f"header of {quoted(source)}", fault, "mend the quotes")
            header = _header(cells, needed, source)
        elif fault:
            yield Record(line, _filled(header, cells), fault)
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


def _header(cells: list[str], needed: Sequence[str], source: str) -> list[str]:
    header = [cell.lower() for cell in cells]
    for column in needed:
        if header.count(column) != 1:
            shown = ", ".join(cells)[:LONGEST_NAME]
            many = "two of them" if column in header else "none"
            raise IllegalValueError(
                f"header of {quoted(source)} ({shown})",
                f"it needs one column {column} and has {many}",
                f"make the first line {','.join(needed)}",
            )
    return header


def _record(line: int, header: list[str], cells: list[str], separator: str) -> Record:
    fault = ""
    if len(cells) > len(header):
        remedy = f"quote a cell that holds a {NAMES[separator]}"
        fault = f"{len(cells)} cells under {counted(len(header), 'column')}: {remedy}"
    return Record(line, _filled(header, cells), fault)


def _filled(header: list[str], cells: list[str]) -> dict[str, str]:
    return dict(zip(header, cells + [""] * (len(header) - len(cells)), strict=False))
