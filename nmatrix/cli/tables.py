"""A table that a command is given: a file, or standard input."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from nmatrix.reading.files import LARGEST, decoded
from nmatrix.reading.records import Record, records, records_of

STDIN = "standard input"


def table(name: str, needed: Sequence[str]) -> list[Record]:
    """Return the rows of a file, or of standard input for `-`.

    Raises
    ------
    IllegalValueError
        If there is no such file, it is not text, or its header lacks a column.
    """
    if name != "-":
        return records(name, needed)
    return list(records_of(decoded(sys.stdin.buffer.read(LARGEST), STDIN), needed, STDIN))
