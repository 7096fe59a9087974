"""Matrices that Python callers give: any array-like of numbers, or text in any notation."""

from __future__ import annotations

from fractions import Fraction

from nmatrix.linear.rational import RationalMatrix
from nmatrix.linear.values import listed, number, plain_value, refused
from nmatrix.reading.literal import MatrixLiteral, as_affine, as_projection
from nmatrix.reading.matrix import matrix_literal

SIZES = (1, 2, 3, 4)


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
    return as_affine(read_matrix(values, name)).rows_exact


def read_projection(values: object, name: str) -> RationalMatrix:
    """Return a 4×4 of any sixteen numbers."""
    return as_projection(read_matrix(values, name)).rows_exact


def read_matrix(values: object, name: str) -> MatrixLiteral:
    """Return a matrix of at most 4×4 entries, or a vector as one row.

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
    rows = [plain_value(row, name) for row in listed(values, name, (*SIZES, 9, 16))]
    if not any(isinstance(row, list | tuple) for row in rows):
        rows = [rows]
    if len(rows) not in SIZES:
        raise refused(values, name, f"it has {len(rows)} rows", "give 1 to 4")
    width = len(listed(rows[0], name, SIZES))
    entries = tuple(_row(row, i, width, name) for i, row in enumerate(rows))
    return MatrixLiteral(entries, name, ((None,) * width,) * len(rows))


def _row(row: object, i: int, width: int, name: str) -> tuple[Fraction, ...]:
    entries = listed(row, f"{name}[{i}]", (width,))
    return tuple(Fraction(number(one, f"{name}[{i}, {j}]")) for j, one in enumerate(entries))
