"""Where matrices and tables come from: an argument, a file, or standard input."""

from __future__ import annotations

import re
import sys
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from nmatrix.enums import Layout
from nmatrix.errors import IllegalValueError
from nmatrix.linear.rational import RationalMatrix
from nmatrix.reading.files import LARGEST, decoded, existing_file
from nmatrix.reading.literal import MatrixLiteral, as_affine, as_projection
from nmatrix.reading.source import matrix_source

if TYPE_CHECKING:
    from nmatrix.reading.records import Records

STDIN = "standard input"

# What only a text report has: ruled lines, brackets of several lines, rows with a label.
_FOR_PEOPLE = re.compile(
    r"^(?=[─ -]*[─-]{3})[─ -]+$|[⎡⎢⎣]|^ +[xyzw] [\[|(/\\]|^--full adds ", re.MULTILINE
)


@dataclass
class Sources:
    """What is read for one command line.

    It remembers whether a matrix came from a file, what is to be said about how it was read, and
    before all else, `about`, what the answer is of.
    """

    layout: Layout | None = None
    any_from_file: bool = False
    remarks: list[str] = field(default_factory=list)
    about: list[str] = field(default_factory=list)
    _stdin_used: bool = field(default=False, init=False)
    _from_stdin: str = field(default="", init=False)

    def affine(self, text: str, *, exact: bool = False) -> RationalMatrix:
        """Read an affine 4×4; nine numbers are its linear part.

        With `exact` the numbers are kept as they were typed, else each is the nearest float64.
        """
        found = as_affine(self.literal(text))
        return found.as_typed if exact else found.as_floats

    def projection(self, text: str) -> RationalMatrix:
        """Read any 4×4."""
        return as_projection(self.literal(text)).as_floats

    def literal(self, text: str) -> MatrixLiteral:
        """Read a matrix of any size, as it was typed."""
        if existing_file(text.rpartition("#")[0] or text) or existing_file(text):
            self.any_from_file = True
        try:
            found = matrix_source(text, self._stdin, self.layout)
        except IllegalValueError:
            if _FOR_PEOPLE.search(self._from_stdin):
                raise IllegalValueError(
                    "matrix (stdin)",
                    "it is a report for people to read",
                    "add -f json to the command before the pipe",
                ) from None
            raise
        self.remark(*found.remarks)
        return found

    def remark(self, *sentences: str) -> None:
        """Keep what is to be said about the way something was read, once."""
        self.remarks += [one for one in sentences if one not in self.remarks]

    def standard_input(self, next_step: str) -> bytes:
        """Read all of standard input, once; `next_step` is what to do where it is too long.

        Raises
        ------
        IllegalValueError
            If it was read before, is closed, or is longer than any file that is read.
        """
        if self._stdin_used:
            raise IllegalValueError(
                "- (standard input)", "it can be read only once", "put one of them in a file"
            )
        self._stdin_used = True
        return _standard_input(next_step)

    def _stdin(self) -> str:
        content = self.standard_input("pass one matrix")
        if not content.strip():
            raise IllegalValueError(
                STDIN, "it is empty", "pipe a matrix in, or write it as an argument"
            )
        self._from_stdin = decoded(content, STDIN)
        return self._from_stdin


def table(name: str, needed: Sequence[str]) -> Records:
    """Read the rows of a file, or of standard input for `-`.

    Raises
    ------
    IllegalValueError
        If there is no such file, it is too long, it is not text, or its header lacks a column.
    """
    from nmatrix.reading.records import records, records_in

    if name != "-":
        return records(name, needed)
    return records_in(_standard_input("cut it down"), needed, STDIN)


def _standard_input(next_step: str) -> bytes:
    """Read all of standard input; `next_step` is what to do where it is too long.

    Raises
    ------
    IllegalValueError
        If it is longer than any file that is read.
    """
    if sys.stdin is None:
        raise IllegalValueError(STDIN, "it is closed", "pipe something in, or name a file")
    content = sys.stdin.buffer.read(LARGEST + 1)
    if len(content) > LARGEST:
        raise IllegalValueError(STDIN, f"it is longer than {LARGEST} bytes", next_step)
    return content
