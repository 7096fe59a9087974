"""A table that a command is given: a file, or standard input."""

from __future__ import annotations

from collections.abc import Sequence

from nmatrix.cli.stdin import NAME as STDIN
from nmatrix.cli.stdin import standard_input
from nmatrix.reading.files import decoded
from nmatrix.reading.records import Record, records, records_of


def table(name: str, needed: Sequence[str]) -> list[Record]:
    """Return the rows of a file, or of standard input for `-`.

    Raises
    ------
    IllegalValueError
        If there is no such file, it is too long, it is not text, or its header lacks a column.
    """
    if name != "-":
        return records(name, needed)
    return list(records_of(decoded(standard_input("cut it down"), STDIN), needed, STDIN))
