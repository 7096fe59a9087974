"""Interpret a matrix that was read as an affine map, a linear one, a projection or a vector.

Column vectors: the translation of an affine 4×4 stands in its last column, its last row is
0 0 0 1.
"""

from __future__ import annotations

from nmatrix.errors import IllegalValueError, quantity
from nmatrix.linear.rational import affine_matrix, is_affine, linear_part, transpose
from nmatrix.reading.literal import MatrixLiteral, unreadable


def as_affine(matrix: MatrixLiteral) -> MatrixLiteral:
    """Return an affine 4×4; nine numbers are its linear part.

    Raises
    ------
    IllegalValueError
        If it is neither 3×3 nor 4×4, or its last row is not 0 0 0 1.

    Examples
    --------
    >>> from nmatrix.reading.matrix import matrix_literal
    >>> as_affine(matrix_literal("2 0 0; 0 2 0; 0 0 2")).rows[0]
    (2.0, 0.0, 0.0, 0.0)
    """
    if matrix.shape == (3, 3):
        return MatrixLiteral(affine_matrix(matrix.rows_exact), matrix.source)
    _require_shape(matrix, "9 or 16 numbers", ((4, 4),))
    if not is_affine(matrix.rows_exact):
        raise _not_affine(matrix)
    return matrix


def as_linear(matrix: MatrixLiteral) -> MatrixLiteral:
    """Return a 3×3: nine numbers as they are, or the linear part of an affine 4×4.

    Raises
    ------
    IllegalValueError
        As `as_affine`.

    Examples
    --------
    >>> from nmatrix.reading.matrix import matrix_literal
    >>> as_linear(matrix_literal("1 0 0 9; 0 2 0 9; 0 0 1 9; 0 0 0 1")).rows[1]
    (0.0, 2.0, 0.0)
    """
    if matrix.shape == (3, 3):
        return matrix
    return MatrixLiteral(linear_part(as_affine(matrix).rows_exact), matrix.source)


def as_projection(matrix: MatrixLiteral) -> MatrixLiteral:
    """Return a 4×4 of any sixteen numbers.

    Raises
    ------
    IllegalValueError
        If it is not 4×4.
    """
    _require_shape(matrix, "16 numbers", ((4, 4),))
    return matrix


def as_vector(matrix: MatrixLiteral) -> tuple[float, ...]:
    """Return three or four numbers in one row or one column.

    Raises
    ------
    IllegalValueError
        If it is of another size.

    Examples
    --------
    >>> from nmatrix.reading.matrix import matrix_literal
    >>> as_vector(matrix_literal("1, 2, 3"))
    (1.0, 2.0, 3.0)
    """
    _require_shape(matrix, "3 or 4 numbers", ((1, 3), (1, 4), (3, 1), (4, 1)))
    return tuple(entry for row in matrix.rows for entry in row)


def _require_shape(matrix: MatrixLiteral, takes: str, shapes: tuple[tuple[int, int], ...]) -> None:
    if matrix.shape not in shapes:
        height, width = matrix.shape
        raise unreadable(matrix.source, f"it has {height} × {width} entries", f"give {takes}")


def _not_affine(matrix: MatrixLiteral) -> IllegalValueError:
    if is_affine(transpose(matrix.rows_exact)):
        why = f"this looks column-major or row-vector: {quantity('input_layout')} column-major"
        return unreadable(matrix.source, why, "")
    last = " ".join(f"{entry:g}" for entry in matrix.rows[3])
    why = f"its last row is {last}, that of an affine matrix is 0 0 0 1"
    return unreadable(matrix.source, why, f"give a projection as {quantity('projection_matrix')}")
