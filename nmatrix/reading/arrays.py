"""Matrices that Python callers give: any array-like of numbers, or text in any notation."""

from __future__ import annotations

from fractions import Fraction
from typing import TypeGuard

from nmatrix.errors import IllegalValueError, counted, quantity
from nmatrix.linear.rational import RationalMatrix, is_affine, transpose
from nmatrix.linear.values import listed, number, plain_value, refused
from nmatrix.reading.contents import SQUARES
from nmatrix.reading.digits import digits_of
from nmatrix.reading.literal import (
    MatrixLiteral,
    as_affine,
    as_projection,
)
from nmatrix.reading.matrix import matrix_literal
from nmatrix.report import LARGEST_MATRIX

SIZES = tuple(range(1, LARGEST_MATRIX + 1))


def read_affine(values: object, name: str) -> RationalMatrix:
    """Return an affine 4×4; nine numbers are its linear part.

    Raises
    ------
    IllegalValueError
        For another shape, another last row than 0 0 0 1, or entries that are no numbers.

    Examples
    --------
    >>> read_affine([[2, 0, 0], [0, 2, 0], [0, 0, 2]], "world_matrix")[0]
    (Fraction(2, 1), Fraction(0, 1), Fraction(0, 1), Fraction(0, 1))
    """
    if is_exact(values) and is_affine(values):
        return values
    found = read_matrix(values, name)
    if not isinstance(values, str) and found.shape == (4, 4):
        rows = found.rows_exact
        if not is_affine(rows) and is_affine(transpose(rows)):
            why = "its last column is 0 0 0 1 and its last row is not: it is for row vectors"
            raise IllegalValueError(f"{quantity(name)}, a matrix", why, "transpose it")
    return as_affine(found).as_typed


def read_projection(values: object, name: str) -> RationalMatrix:
    """Return a 4×4 of any sixteen numbers, unless only their transpose is a projection."""
    if is_exact(values) and len(values) == len(values[0]) == 4:
        return values
    return as_projection(read_matrix(values, name)).as_typed


def is_exact(values: object) -> TypeGuard[RationalMatrix]:
    """Recognise rows of fractions, all of one length: there is nothing to read in them.

    Examples
    --------
    >>> is_exact(((Fraction(1), Fraction(2)),)), is_exact(((1.0, 2.0),))
    (True, False)
    """
    return (
        isinstance(values, tuple)
        and bool(values)
        and all(isinstance(row, tuple) and len(row) == len(values[0]) for row in values)
        and all(isinstance(one, Fraction) for row in values for one in row)
    )


def read_matrix(values: object, name: str) -> MatrixLiteral:
    """Return a matrix of at most 8×8 entries, or a vector as one row.

    Text is read in every notation that the command line knows.

    Examples
    --------
    >>> read_matrix([1, 2, 3], "answer").rows, read_matrix("1 2; 3 4", "answer").rows
    (((1.0, 2.0, 3.0),), ((1.0, 2.0), (3.0, 4.0)))
    """
    if isinstance(values, str):
        return matrix_literal(values, source=name)
    if isinstance(values, MatrixLiteral):
        return values
    rows = _rows(values, name)
    entries = tuple(
        tuple(Fraction(number(one, f"{name}[{i}, {j}]")) for j, one in enumerate(row))
        for i, row in enumerate(rows)
    )
    # An array's numbers as their own type writes them: 0.333 claims three decimals in float32, too.
    written = _rows(values.astype(str), name) if hasattr(values, "astype") else rows
    digits = tuple(
        tuple(None if isinstance(one, Fraction) else digits_of(str(one)) for one in row)
        for row in written
    )
    return MatrixLiteral(entries, name, digits)


def _rows(values: object, name: str) -> list[list[object]]:
    """Return rows of equal lengths; nine or sixteen numbers are a square."""
    rows = [plain_value(row, name) for row in listed(values, name, (*SIZES, *SQUARES))]
    if not any(isinstance(row, list | tuple) for row in rows):
        side = SQUARES.get(len(rows), len(rows))
        rows = [rows[start : start + side] for start in range(0, len(rows), side)]
    if len(rows) not in SIZES:
        raise refused(values, name, f"it has {counted(len(rows), 'row')}", f"give 1 to {SIZES[-1]}")
    width = len(listed(rows[0], name, SIZES))
    return [listed(row, f"{name}[{i}]", (width,)) for i, row in enumerate(rows)]
