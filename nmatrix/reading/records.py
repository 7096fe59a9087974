"""Tables that people keep in spreadsheets: CSV with a header, each row with its line number."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from io import StringIO

from nmatrix.errors import IllegalValueError
from nmatrix.reading.files import decoded, existing_file, file_bytes
from nmatrix.reading.quote import quoted

SEPARATORS = ",;\t"
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
    """Return the rows of a file; empty lines are skipped, column names match in any case.

    The separator is the comma, semicolon or tab that the header uses most.

    Raises
    ------
    IllegalValueError
        If there is no such file, it is not text, or its header lacks a column.
    """
    path = existing_file(name)
    if path is None:
        raise IllegalValueError(f"file ({quoted(name)})", "there is no such file", "check the path")
    return list(records_of(decoded(file_bytes(path), str(path)), needed, str(path)))


def records_of(text: str, needed: Sequence[str], source: str) -> Iterator[Record]:
    r"""Give the rows of a text.

    Examples
    --------
    >>> [one.cells["student"] for one in records_of("Student\nAda\n\n\"Lovelace, A.\"\n",
    ...  ["student"], "x")]
    ['Ada', 'Lovelace, A.']
    """
    head, _, _ = text.partition("\n")
    separator = max(SEPARATORS, key=head.count)
    rows = csv.reader(StringIO(text.removeprefix("\ufeff")), delimiter=separator, strict=True)
    header: list[str] | None = None
    while True:
        began = rows.line_num + 1
        try:
            row = next(rows, None)
        except csv.Error as error:
            raise IllegalValueError(
                f"file ({quoted(source)}), line {began}", _told(error), "mend the quotes"
            ) from None
        if row is None:
            break
        cells = [cell.strip() for cell in row]
        if not any(cells):
            continue
        if header is None:
            header = _header(cells, needed, source)
        else:
            yield _record(rows.line_num, header, cells)
    if header is None:
        raise IllegalValueError(
            f"file ({quoted(source)})", "it is empty", f"give it the header {','.join(needed)}"
        )


def _told(error: csv.Error) -> str:
    return "a quote is never closed" if "unexpected end" in str(error) else str(error)


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


def _record(line: int, header: list[str], cells: list[str]) -> Record:
    fault = ""
    if len(cells) > len(header):
        fault = f"{len(cells)} cells under {len(header)} columns: quote a cell that holds a comma"
    filled = cells + [""] * (len(header) - len(cells))
    return Record(line, dict(zip(header, filled, strict=False)), fault)
