"""Small matrices of exact fractions: nothing is rounded here, so every identity holds exactly.

A, B are matrices as tuples of rows; v is a vector; C is the cofactor matrix.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from math import lcm
from operator import mul
from typing import TypeVar

from nmatrix.errors import IllegalValueError, NoAnswerError
from nmatrix.linear.rounding import integers, nearest

RationalVector = tuple[Fraction, ...]
RationalMatrix = tuple[RationalVector, ...]
Rows = tuple[tuple[float, ...], ...]

Entry = TypeVar("Entry")
Real = TypeVar("Real", float, Fraction)

ZERO = Fraction(0)
ONE = Fraction(1)
AFFINE_ROW = (ZERO, ZERO, ZERO, ONE)
FLOAT_AFFINE_ROW: RationalVector = (0.0, 0.0, 0.0, 1.0)  # type: ignore[assignment]  # floats inside
SINGLE, DOUBLE = 24, 53  # bits of a float32 and of a float64


class RoundedMatrix(tuple[RationalVector, ...]):
    """Rows of fractions that know how far each entry may lie from what was rounded.

    `half_units` are half the last unit of each entry, 0 where it is exact; `shared_half_units` are
    those if all entries were written in one precision by a program that computes in floats of so
    many `bits`.
    """

    half_units: RationalMatrix
    shared_half_units: RationalMatrix
    bits: int

    @classmethod
    def of(
        cls,
        rows: RationalMatrix,
        half_units: RationalMatrix,
        shared_half_units: RationalMatrix | None = None,
        bits: int = DOUBLE,
    ) -> RoundedMatrix:
        """Return the rows together with their half units."""
        found = cls(rows)
        found.half_units = half_units
        found.shared_half_units = half_units if shared_half_units is None else shared_half_units
        found.bits = bits
        return found


def rational_matrix(rows: Iterable[Iterable[float | Fraction]]) -> RationalMatrix:
    """Take every entry exactly; a float is a fraction whose denominator is a power of two.

    Examples
    --------
    >>> rational_matrix([[0.5]])
    ((Fraction(1, 2),),)
    """
    return tuple(rational_vector(row) for row in rows)


def rational_vector(values: Iterable[float | Fraction]) -> RationalVector:
    """Take every component exactly."""
    return tuple(Fraction(value) for value in values)


def exactly(value: float | Fraction) -> Fraction:
    """Take a float or an int as a fraction; whatever has a fraction's operators stays."""
    return Fraction(value) if isinstance(value, int | float) else value


def to_floats(A: RationalMatrix) -> Rows:
    """Round every entry once, to the nearest float64."""
    return tuple(tuple(nearest(entry) for entry in row) for row in A)


def to_floats_near_one(A: RationalMatrix) -> Rows:
    """Divide by the power of two next to the largest entry, and round every entry once.

    Nothing overflows, and directions stay.

    Examples
    --------
    >>> to_floats_near_one(((Fraction(2) ** 2000, Fraction(2) ** 1999),))
    ((1.0, 0.5),)
    """
    tops, bottom = integers(entry for row in A for entry in row)
    largest = Fraction(max(map(abs, tops)), bottom)
    exponent = largest.numerator.bit_length() - largest.denominator.bit_length()
    bottom <<= max(exponent, 0)
    found = [(top << max(-exponent, 0)) / bottom for top in tops]
    return tuple(tuple(found[i : i + len(A[0])]) for i in range(0, len(found), len(A[0])))


def rounded_for_display(A: RationalMatrix) -> RationalMatrix:
    """Round every entry once to the nearest float64, but keep one that is beyond all of them.

    A product of legal numbers may lie there: it is then shown as it is, and what is derived from
    the matrix is derived from it.

    Examples
    --------
    >>> rounded_for_display(((Fraction(1, 3), Fraction(10) ** 309),))[0][1] == 10**309
    True
    """
    rows = tuple(tuple(_shown(entry) for entry in row) for row in A)
    if isinstance(A, RoundedMatrix):
        return RoundedMatrix.of(rows, A.half_units, A.shared_half_units, A.bits)
    return rows


def _shown(entry: Fraction) -> Fraction:
    try:
        return Fraction(nearest(entry))
    except IllegalValueError:
        return entry


def identity(n: int) -> RationalMatrix:
    """Build the n×n identity."""
    return tuple(tuple(ONE if i == j else ZERO for j in range(n)) for i in range(n))


def diagonal(values: Sequence[Fraction]) -> RationalMatrix:
    """Build the square matrix with these values on its diagonal."""
    n = len(values)
    return tuple(tuple(values[i] if i == j else ZERO for j in range(n)) for i in range(n))


def transpose(A: Sequence[Sequence[Entry]]) -> tuple[tuple[Entry, ...], ...]:
    """Exchange rows and columns, of fractions or of any other entries."""
    return tuple(zip(*A, strict=True))


def dot(a: Sequence[Fraction], b: Sequence[Fraction]) -> Fraction:
    """Compute a · b."""
    pairs = [(x, y) for x, y in zip(a, b, strict=True) if x and y]
    if len(pairs) < 2:  # most rows of most matrices here are nearly empty
        return pairs[0][0] * pairs[0][1] if pairs else ZERO
    try:
        terms = [(x.numerator * y.numerator, x.denominator * y.denominator) for x, y in pairs]
    except AttributeError:  # no fractions but the polynomials of a proof
        return sum((x * y for x, y in pairs), ZERO)
    # One denominator, reduced once: a third of the time of reducing every product and sum.
    common = lcm(*(bottom for _, bottom in terms))
    return Fraction(sum(top * (common // bottom) for top, bottom in terms), common)


def cross(a: Sequence[Real], b: Sequence[Real]) -> tuple[Real, ...]:
    """Compute a × b, of fractions or of floats."""
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def apply(A: RationalMatrix, v: Sequence[Fraction]) -> RationalVector:
    """Compute A v, exactly; of floats, in floats."""
    if isinstance(A[0][0], float):
        return _times(A, v)
    return tuple(dot(row, v) for row in A)


def _times(rows: RationalMatrix, v: Sequence[Fraction]) -> RationalVector:
    """Multiply rows of floats by a vector; written out, as there are thousands of them."""
    if len(v) == 3:
        x, y, z = v
        return tuple([a * x + b * y + c * z for a, b, c in rows])
    if len(v) == 4:
        x, y, z, w = v
        return tuple([a * x + b * y + c * z + d * w for a, b, c, d in rows])
    return tuple(sum(map(mul, row, v), ZERO) for row in rows)


def product(A: RationalMatrix, *others: RationalMatrix) -> RationalMatrix:
    """Multiply the matrices, from left to right.

    Examples
    --------
    >>> to_floats(product(diagonal((Fraction(2), Fraction(3))), rational_matrix([[0, 1], [1, 0]])))
    ((0.0, 2.0), (3.0, 0.0))
    """
    for B in others:
        A = _product(A, B)
    return A


def _product(A: RationalMatrix, B: RationalMatrix) -> RationalMatrix:
    n, m = len(B), len(B[0])
    if isinstance(A[0][0], float):
        columns = transpose(B)
        return tuple([_times(columns, row) for row in A])
    try:
        a, bottom = integers(entry for row in A for entry in row)
        b, factor = integers(entry for row in B for entry in row)
    except AttributeError:  # no fractions but the polynomials of a proof
        columns = transpose(B)
        return tuple(tuple(dot(row, column) for column in columns) for row in A)
    # One denominator for all: a half of the time of bringing every sum to its own.
    common, columns_b = bottom * factor, [b[j::m] for j in range(m)]
    return tuple(
        tuple(Fraction(sum(map(mul, a[i : i + n], column)), common) for column in columns_b)
        for i in range(0, len(a), n)
    )


def minor(A: RationalMatrix, row: int, column: int) -> RationalMatrix:
    """Leave out one row and one column."""
    return tuple(r[:column] + r[column + 1 :] for i, r in enumerate(A) if i != row)


def determinant(A: RationalMatrix) -> Fraction:
    """Compute det A by expansion along the first row (the sizes here are at most four).

    Examples
    --------
    >>> determinant(rational_matrix([[1, 2], [3, 4]]))
    Fraction(-2, 1)
    """
    if len(A) == 1:
        return A[0][0]
    if len(A) == 2:
        return A[0][0] * A[1][1] - A[0][1] * A[1][0]
    if len(A) == 3:
        return sum(map(mul, A[0], cross(A[1], A[2])), ZERO)
    terms = ((-1) ** j * A[0][j] * determinant(minor(A, 0, j)) for j in range(len(A)) if A[0][j])
    return sum(terms, ZERO)


def cofactor_matrix(A: RationalMatrix) -> RationalMatrix:
    """Return the cofactor matrix C = det(A) A⁻ᵀ, which exists for singular A too.

    Examples
    --------
    >>> to_floats(cofactor_matrix(diagonal((Fraction(1), Fraction(2), Fraction(0)))))
    ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 2.0))
    """
    n = len(A)
    if n == 1:
        return ((ONE,),)
    if n == 3:
        a, b, c = A
        return cross(b, c), cross(c, a), cross(a, b)
    return tuple(
        tuple((-1) ** (i + j) * determinant(minor(A, i, j)) for j in range(n)) for i in range(n)
    )


def adjugate(A: RationalMatrix) -> RationalMatrix:
    """Return the transposed cofactor matrix, det(A) A⁻¹."""
    return transpose(cofactor_matrix(A))


def scaled(A: RationalMatrix, factor: Fraction) -> RationalMatrix:
    """Multiply every entry by the factor."""
    return tuple(tuple(entry * factor for entry in row) for row in A)


def inverse(A: RationalMatrix) -> RationalMatrix:
    """Invert a matrix exactly: the adjugate over the determinant.

    Raises
    ------
    NoAnswerError
        If det A is exactly zero.

    Examples
    --------
    >>> to_floats(inverse(diagonal((Fraction(4), Fraction(-2)))))
    ((0.25, 0.0), (0.0, -0.5))
    """
    if is_affine(A):
        return _affine_inverse(A)
    det = determinant(A)
    if det == 0:
        raise NoAnswerError(
            "a singular matrix (determinant 0)",
            "it flattens space, so nothing undoes it",
            "ask for the cofactor matrix, which always exists",
        )
    return scaled(adjugate(A), 1 / det)


def is_affine(A: Sequence[Sequence[object]]) -> bool:
    """Recognise an affine 4×4 matrix by its last row, 0 0 0 1."""
    if len(A) != 4:
        return False
    return tuple(A[3]) == (FLOAT_AFFINE_ROW if isinstance(A[3][0], float) else AFFINE_ROW)


def _affine_inverse(A: RationalMatrix) -> RationalMatrix:
    block = inverse(linear_part(A))
    return affine_matrix(block, tuple(-entry for entry in apply(block, translation(A))))


def inverse_transpose(A: RationalMatrix) -> RationalMatrix:
    """Invert and transpose a matrix exactly: of a 3×3 block, the matrix that transforms normals."""
    return transpose(inverse(A))


def linear_part(A: RationalMatrix) -> RationalMatrix:
    """Take the 3×3 block that turns, scales and shears."""
    return tuple(row[:3] for row in A[:3])


def translation(A: RationalMatrix) -> RationalVector:
    """Take the first three entries of the fourth column."""
    return tuple(row[3] for row in A[:3])


def affine_matrix(
    block: RationalMatrix, offset: Sequence[Fraction] = (ZERO, ZERO, ZERO)
) -> RationalMatrix:
    """Build the 4×4 matrix with this 3×3 block and this translation."""
    rows = tuple((*row, t) for row, t in zip(block, offset, strict=True))
    return (*rows, FLOAT_AFFINE_ROW if isinstance(block[0][0], float) else AFFINE_ROW)


def numbers_like(A: RationalMatrix, values: Iterable[float | Fraction]) -> RationalVector:
    """Take numbers exactly, or as floats for a matrix that holds floats.

    Functions of this module take both: exact numbers for an answer, floats for a first look.
    """
    return numbers_in_floats(values) if isinstance(A[0][0], float) else rational_vector(values)


def numbers_in_floats(values: Iterable[float | Fraction]) -> RationalVector:
    """Take numbers as floats, a unit of their last place off, where exact ones are expected."""
    # Far faster than float(), which asks a fraction for two whole numbers and divides these.
    floats = [one if isinstance(one, float) else one.numerator / one.denominator for one in values]
    return tuple(floats)  # type: ignore[arg-type]  # floats inside


def solve(A: RationalMatrix, b: RationalVector) -> RationalVector:
    """Solve A x = b of any size, by elimination without rounding.

    Raises
    ------
    NoAnswerError
        If A is singular.

    Examples
    --------
    >>> solve(rational_matrix([[0, 2], [1, 1]]), rational_vector((4, 5)))
    (Fraction(3, 1), Fraction(2, 1))
    """
    n = len(A)
    rows, found = _eliminated([(*row, entry) for row, entry in zip(A, b, strict=True)], n)
    if found < n:
        raise NoAnswerError("a singular system", "no one vector solves it", "check its rows")
    x: list[Fraction] = []
    for i in reversed(range(n)):
        known = dot(rows[i][i + 1 : n], x[::-1])
        x.append((rows[i][n] - known) / rows[i][i])
    return tuple(reversed(x))


def rank(A: RationalMatrix) -> int:
    """Count the independent rows, by elimination without rounding.

    Examples
    --------
    >>> rank(rational_matrix([[1, 2, 3], [2, 4, 6], [0, 0, 1]]))
    2
    """
    return _eliminated(A, len(A[0]))[1]


def _eliminated(A: Sequence[RationalVector], columns: int) -> tuple[list[list[Fraction]], int]:
    """Bring the first columns to echelon form; return the rows and how many have a pivot."""
    rows = [list(row) for row in A]
    found = 0
    for column in range(columns):
        pivot = next((i for i in range(found, len(rows)) if rows[i][column]), None)
        if pivot is None:
            continue
        rows[found], rows[pivot] = rows[pivot], rows[found]
        head = rows[found]
        for i in range(found + 1, len(rows)):
            factor = rows[i][column] / head[column]
            rows[i] = [a - factor * b for a, b in zip(rows[i], head, strict=True)]
        found += 1
    return rows, found
