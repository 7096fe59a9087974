"""A matrix out of rows of number texts: its exact entries, its floats, and its digits."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property

from nmatrix.enums import Layout
from nmatrix.errors import IllegalValueError, counted, quantity
from nmatrix.linear.projection import is_lens
from nmatrix.linear.rational import (
    AFFINE_ROW,
    ZERO,
    RationalMatrix,
    RoundedMatrix,
    Rows,
    is_affine,
    rational_matrix,
    to_floats,
    transpose,
)
from nmatrix.reading.contents import OF_A_QUATERNION, SQUARES, Tokens, unreadable
from nmatrix.reading.digits import TypedDigits, bits_of, digits_of, half_units, shared_half_units
from nmatrix.reading.roots import Exact, exact_number
from nmatrix.report import LARGEST_MATRIX
from nmatrix.surds import Surd

TypedRows = tuple[tuple[Exact, ...], ...]
BARE_POINT = re.compile(r"(?<=[0-9])\.(?![0-9])")  # NumPy prints 1. where others print 1.0


@dataclass(frozen=True)
class MatrixLiteral:
    """A matrix of at most 8×8 entries and where it came from.

    `rows_typed` keeps the typed fractions and roots, `rows_exact` only the fractions: a root there
    is the float nearest to it; `rows` are the floats nearest to all; `digits` are those that were
    typed; `exact` numbers are known as they are, however many digits they have;
    `layout` is how its text was read, and the remarks say so where that is not plain to see.
    """

    rows_typed: TypedRows
    source: str
    digits: TypedDigits
    exact: bool = False
    layout: Layout = Layout.ROW_MAJOR
    remarks: tuple[str, ...] = ()

    @cached_property
    def rows_exact(self) -> RationalMatrix:
        """The entries as fractions, a root as the nearest float64."""
        return tuple(
            tuple(Fraction(float(one)) if isinstance(one, Surd) else one for one in row)
            for row in self.rows_typed
        )

    @cached_property
    def rows(self) -> Rows:
        """Return the entries as float64, each correctly rounded."""
        return to_floats(self.rows_exact)

    @property
    def shape(self) -> tuple[int, int]:
        """Return the number of rows and columns."""
        return len(self.rows_exact), len(self.rows_exact[0])

    @property
    def last_places(self) -> RationalMatrix:
        """One unit of the last decimal of each entry, 0 of a whole number or a fraction."""
        return tuple(
            tuple(ZERO if one is None or not one.has_point else one.last_place for one in row)
            for row in self.digits
        )

    @property
    def half_units(self) -> RationalMatrix:
        """Half the last unit of each entry: how far what was rounded may lie from it."""
        return half_units(self.rows_exact, self.digits, exact=self.exact)

    @property
    def shared_half_units(self) -> RationalMatrix:
        """Half units if all entries were written in one precision."""
        return shared_half_units(self.rows_exact, self.digits, exact=self.exact)

    @property
    def as_floats(self) -> RationalMatrix:
        """The nearest floats, as exact numbers that know their half units if any was rounded."""
        return self._knowing(rational_matrix(self.rows))

    @property
    def as_typed(self) -> RationalMatrix:
        """The entries as fractions, which know their half units if any was rounded."""
        return self._knowing(self.rows_exact)

    def _knowing(self, rows: RationalMatrix) -> RationalMatrix:
        known = self.half_units
        if not any(map(any, known)):
            return rows
        bits = bits_of(self.rows_exact, self.digits)
        return RoundedMatrix.of(rows, known, self.shared_half_units, bits)


def literal_from_tokens(
    tokens: Tokens, layout: Layout, source: str, *, exact: bool = False
) -> MatrixLiteral:
    """Read rows of number texts as a matrix.

    Nine or sixteen numbers in one row or column are a square matrix. In column-major layout each
    group of numbers is a column; vectors are what they are in either layout.

    Raises
    ------
    IllegalValueError
        If the rows differ in length, are too many, or hold something that is not a number.

    Examples
    --------
    >>> literal_from_tokens([["1", "2"], ["3", "4"]], Layout.COLUMN_MAJOR, "x").rows
    ((1.0, 3.0), (2.0, 4.0))
    """
    known = {
        text: _entry(text, (r, c), source)
        for r, row in enumerate(tokens)
        for c, text in enumerate(row)
    }
    shaped = shaped_rows(tokens, layout, source)
    rows = tuple(tuple(known[text] for text in row) for row in shaped)
    digits = tuple(tuple(map(digits_of, row)) for row in shaped)
    return MatrixLiteral(rows, source, digits, exact, layout)


def shaped_rows(tokens: Tokens, layout: Layout, source: str) -> Tokens:
    """Lay out the rows of a matrix: flat ones squared, columns turned into rows.

    Examples
    --------
    >>> shaped_rows(["123456789"], Layout.COLUMN_MAJOR, "x")
    [('1', '4', '7'), ('2', '5', '8'), ('3', '6', '9')]
    """
    squared = _squared(tokens, source)
    if layout is Layout.COLUMN_MAJOR and min(len(squared), len(squared[0])) > 1:
        return [*zip(*squared, strict=True)]
    return squared


def as_affine(matrix: MatrixLiteral) -> MatrixLiteral:
    """Take a matrix for an affine 4×4 with the last row 0 0 0 1, which may be left out.

    Nine numbers are its linear part.

    Raises
    ------
    IllegalValueError
        If it is neither 3×3, 3×4 nor 4×4, or its last row is not 0 0 0 1.

    Examples
    --------
    >>> from nmatrix.reading.matrix import matrix_literal
    >>> as_affine(matrix_literal("2 0 0; 0 2 0; 0 0 2")).rows[0]
    (2.0, 0.0, 0.0, 0.0)
    """
    if matrix.shape == (3, 3):
        digits = (*((*row, None) for row in matrix.digits), (None,) * 4)
        rows = tuple((*row, Fraction(0)) for row in matrix.rows_typed)
        return replace(matrix, rows_typed=(*rows, AFFINE_ROW), digits=digits)
    if matrix.shape == (3, 4):
        rows = (*matrix.rows_typed, AFFINE_ROW)
        return replace(matrix, rows_typed=rows, digits=(*matrix.digits, (None,) * 4))
    _require_4x4(matrix, "9 or 16 numbers")
    if not is_affine(matrix.rows_exact):
        raise _not_affine(matrix)
    return matrix


def as_projection(matrix: MatrixLiteral) -> MatrixLiteral:
    """Take a matrix for a projection: any sixteen numbers, unless only their transpose is one.

    Raises
    ------
    IllegalValueError
        If it is not 4×4, or a projection for row vectors or stored by columns.
    """
    _require_4x4(matrix, "16 numbers")
    rows = matrix.rows_exact
    if not is_lens(rows) and is_lens(transpose(rows)):
        raise _looks_transposed(matrix)
    return matrix


def _squared(tokens: Tokens, source: str) -> Tokens:
    count = len(tokens[0]) if tokens else 0
    if not count:
        raise unreadable(source, "it holds no numbers")
    for place, row in enumerate(tokens):
        if len(row) != count:
            lengths = f"row 1 has length {count}, row {place + 1} has length {len(row)}"
            raise unreadable(source, lengths, "make all rows equally long")
    if 1 in (count, len(tokens)) and count * len(tokens) in SQUARES:
        flat = [text for row in tokens for text in row]
        side = SQUARES[len(flat)]
        return [flat[start : start + side] for start in range(0, len(flat), side)]
    if max(count, len(tokens)) > LARGEST_MATRIX:
        raise _misshapen(count, len(tokens), source)
    return tokens


def _misshapen(count: int, height: int, source: str) -> IllegalValueError:
    if 1 not in (count, height):
        most = f"use at most {LARGEST_MATRIX}×{LARGEST_MATRIX}"
        return unreadable(source, f"it has {height} rows of {count} numbers", most)
    return _miscounted(count * height, source)


def _miscounted(total: int, source: str) -> IllegalValueError:
    why = f"it holds {counted(total, 'number')}, a matrix has 9 or 16"
    next_step = "give them all" if total < max(SQUARES) else "leave out what is not an entry"
    return unreadable(source, why, next_step)


def _entry(text: str, place: tuple[int, int], source: str) -> Exact:
    name = f"row {place[0] + 1}, column {place[1] + 1} of {source}"
    return exact_number(BARE_POINT.sub("", text), name)


def _require_4x4(matrix: MatrixLiteral, takes: str) -> None:
    if matrix.shape != (4, 4):
        height, width = matrix.shape
        if 1 in matrix.shape and height * width != 4:
            raise _miscounted(height * width, matrix.source)
        next_step = f"give {takes}: {OF_A_QUATERNION}" if height * width == 4 else f"give {takes}"
        raise unreadable(matrix.source, f"it has {height} × {width} entries", next_step)


def _not_affine(matrix: MatrixLiteral) -> IllegalValueError:
    if is_affine(transpose(matrix.rows_exact)):
        return _looks_transposed(matrix)
    last = " ".join(f"{entry:g}" for entry in matrix.rows[3])
    why = f"its last row is {last}, that of an affine matrix is 0 0 0 1"
    return unreadable(matrix.source, why, "nmatrix identify tells what it is")


def _looks_transposed(matrix: MatrixLiteral) -> IllegalValueError:
    if matrix.layout is Layout.COLUMN_MAJOR:
        why = f"this looks row-major: {quantity('input_layout')} row-major"
    else:
        why = f"this looks column-major or row-vector: {quantity('input_layout')} column-major"
    return unreadable(matrix.source, why, "")
