"""Where matrices come from: an argument, a file, or standard input, which is read once."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

from nmatrix.cli.stdin import NAME as STDIN
from nmatrix.cli.stdin import standard_input
from nmatrix.enums import Layout
from nmatrix.errors import IllegalValueError
from nmatrix.linear.classify import BUILT, FROM_FILE
from nmatrix.linear.rational import RationalMatrix, rational_matrix
from nmatrix.reading.files import decoded, existing_file
from nmatrix.reading.literal import MatrixLiteral
from nmatrix.reading.shapes import as_affine, as_projection
from nmatrix.reading.source import matrix_source

# What only a text report has: a ruled heading, or a bracket of several lines.
_FOR_PEOPLE = re.compile(r"^(?:─{4,}|-{4,})$|[⎡⎢⎣]", re.MULTILINE)


@dataclass
class Sources:
    """The matrices of one command line; it remembers whether one of them came from a file."""

    layout: Layout = Layout.ROW_MAJOR
    any_from_file: bool = False
    _stdin_used: bool = field(default=False, init=False)
    _from_stdin: str = field(default="", init=False)

    @property
    def tolerance(self) -> float:
        """Return how far columns may be off: files often hold float32."""
        return FROM_FILE if self.any_from_file else BUILT

    def affine(self, text: str, *, exact: bool = False) -> RationalMatrix:
        """Return an affine 4×4; nine numbers are its linear part.

        With `exact` the numbers are kept as they were typed, else each is the nearest float64.
        """
        found = as_affine(self._read(text))
        return found.rows_exact if exact else rational_matrix(found.rows)

    def projection(self, text: str) -> RationalMatrix:
        """Return any 4×4."""
        return rational_matrix(as_projection(self._read(text)).rows)

    def literal(self, text: str) -> MatrixLiteral:
        """Return a matrix of any size, as it was typed."""
        return self._read(text)

    def _read(self, text: str) -> MatrixLiteral:
        if existing_file(text.rpartition("#")[0] or text) or existing_file(text):
            self.any_from_file = True
        try:
            return matrix_source(text, self._stdin, self.layout)
        except IllegalValueError:
            if _FOR_PEOPLE.search(self._from_stdin):
                raise IllegalValueError(
                    "matrix (stdin)",
                    "it is a report for people to read",
                    "add -f json to the command before the pipe",
                ) from None
            raise

    def _stdin(self) -> str:
        if self._stdin_used:
            raise IllegalValueError(
                "- (standard input)", "it can be read only once", "put one matrix in a file"
            )
        self._stdin_used = True
        content = standard_input("pass one matrix")
        if not content.strip():
            raise IllegalValueError(
                STDIN, "it is empty", "pipe a matrix in, or write it as an argument"
            )
        self._from_stdin = decoded(content, STDIN)
        return self._from_stdin
