"""Functions by row operations: reduced rows, rank, solutions, what vanishes, and L times U.

One elimination serves them all. Of exact numbers the first row with a number in the column is the
pivot, as on paper; of others it is the row with the largest, which loses the fewest digits.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from nmatrix.calculator.functions.function import (
    ArgumentError,
    Function,
    NoAnswerForArgumentError,
    Parameter,
    matrix,
    require_square,
    word,
)
from nmatrix.calculator.numbers import is_zero, size
from nmatrix.calculator.values import Value, ValueKind
from nmatrix.errors import counted
from nmatrix.linear import rational
from nmatrix.linear.rational import ONE, ZERO, RationalMatrix, RationalVector
from nmatrix.surds import Surd


@dataclass(frozen=True)
class Echelon:
    """Rows in echelon form, the columns of their pivots, and how they came about.

    `factors` are those with which rows were subtracted, one row each, and `order` tells which of
    the given rows stands where.
    """

    rows: RationalMatrix
    pivots: tuple[int, ...]
    factors: RationalMatrix
    order: tuple[int, ...]

    @property
    def is_exchanged(self) -> bool:
        """Whether rows changed places."""
        return self.order != tuple(range(len(self.order)))


def is_exact(A: Sequence[Sequence[object]]) -> bool:
    """Tell whether every entry is a fraction or a sum of roots."""
    return all(isinstance(entry, Fraction | Surd) for row in A for entry in row)


def echelon(A: RationalMatrix, columns: int | None = None) -> Echelon:
    """Eliminate below the pivots of the first columns, or of all.

    Raises
    ------
    NoAnswerError
        Where nobody knows whether a pivot is 0.

    Examples
    --------
    >>> for row in echelon(rational.rational_matrix([[2, 4], [1, 5]])).rows:
    ...     print(*row)
    2 4
    0 3
    """
    rows, height = [list(row) for row in A], len(A)
    factors = [[ZERO] * height for _ in range(height)]
    order, pivots, exact = list(range(height)), list[int](), is_exact(A)
    for column in range(len(A[0]) if columns is None else columns):
        done = len(pivots)
        pivot = _pivot(rows, done, column, exact=exact)
        if pivot is None:
            continue
        for swapped in (rows, factors):
            swapped[done], swapped[pivot] = swapped[pivot], swapped[done]
        order[done], order[pivot] = order[pivot], order[done]
        head = rows[done]
        for i in range(done + 1, height):
            factor = rows[i][column] / head[column]
            factors[i][done] = factor
            rows[i] = [a - factor * b for a, b in zip(rows[i], head, strict=True)]
            rows[i][column] = ZERO
        pivots.append(column)
    return Echelon(tuple(map(tuple, rows)), tuple(pivots), tuple(map(tuple, factors)), tuple(order))


def _pivot(rows: list[list[Fraction]], start: int, column: int, *, exact: bool) -> int | None:
    below = range(start, len(rows))
    if exact:
        return next((i for i in below if rows[i][column] != 0), None)
    found = max(below, key=lambda i: size(rows[i][column]), default=None)
    return None if found is None or is_zero(rows[found][column]) else found


def reduced(A: RationalMatrix, columns: int | None = None) -> tuple[RationalMatrix, Sequence[int]]:
    """Bring rows to reduced echelon form: pivots are 1, and nothing else stands in their columns.

    Examples
    --------
    >>> rows, pivots = reduced(rational.rational_matrix([[2, 4, 2], [1, 5, 4]]))
    >>> print(*rows[0], pivots)
    1 0 -1 (0, 1)
    """
    found = echelon(A, columns)
    rows = [list(row) for row in found.rows]
    for place, column in reversed(list(enumerate(found.pivots))):
        head = rows[place]
        rows[place] = [ZERO] * column + [ONE] + [x / head[column] for x in head[column + 1 :]]
        for i in range(place):
            factor = rows[i][column]
            rows[i] = [a - factor * b for a, b in zip(rows[i], rows[place], strict=True)]
            rows[i][column] = ZERO
    return tuple(map(tuple, rows)), found.pivots


def _rank(A: Value) -> Value:
    return Value(Fraction(len(echelon(A.matrix).pivots)))


def _solve(A: Value, b: Value) -> Value:
    sides = b.matrix if b.kind is ValueKind.MATRIX else tuple((entry,) for entry in b.vector)
    if len(sides) != len(A.matrix):
        what, height = f"{A.shape} and {b.shape}", len(A.matrix)
        why = f"the right side has one number for each of the {height} rows"
        raise ArgumentError(b, what, why, "match them")
    width = len(A.matrix[0])
    joined = tuple((*row, *side) for row, side in zip(A.matrix, sides, strict=True))
    rows, pivots = reduced(joined, width)
    if any(not is_zero(entry) for row in rows[len(pivots) :] for entry in row[width:]):
        raise NoAnswerForArgumentError(
            b,
            "a system without a solution",
            "a row says that 0 is another number",
            "see rref of A with b beside it",
        )
    if len(pivots) < width:
        free = counted(width - len(pivots), "unknown is", "unknowns are")
        raise NoAnswerForArgumentError(
            A,
            "a system with many solutions",
            f"{free} free, since the rank is {len(pivots)} of {width}",
            "null_space(A) tells what may be added to one",
        )
    found = tuple(row[width:] for row in rows[:width])
    return Value(found if b.kind is ValueKind.MATRIX else tuple(row[0] for row in found))


def _null_space(A: Value) -> Value:
    rows, pivots = reduced(A.matrix)
    width = len(A.matrix[0])
    basis = [_vanishing(rows, pivots, free) for free in range(width) if free not in pivots]
    if not basis:
        raise NoAnswerForArgumentError(
            A,
            "the null space of a matrix with independent columns",
            "only the zero vector is sent to 0",
            "use a matrix whose columns depend on each other",
        )
    return Value(basis[0] if len(basis) == 1 else rational.transpose(basis))


def _vanishing(rows: RationalMatrix, pivots: Sequence[int], free: int) -> RationalVector:
    """Solve A x = 0 with 1 for a free unknown and 0 for the other ones."""
    found = [ONE if i == free else ZERO for i in range(len(rows[0]))]
    for place, column in enumerate(pivots):
        found[column] = -rows[place][free]
    return tuple(found)


def _lu(A: Value, part: str | None) -> Value:
    require_square(A)
    found = echelon(A.matrix)
    n = len(A.matrix)
    lower = tuple(tuple(ONE if i == j else found.factors[i][j] for j in range(n)) for i in range(n))
    parts = {
        "L": lower,
        "U": found.rows,
        "P": tuple(tuple(ONE if j == i else ZERO for j in range(n)) for i in found.order),
    }
    if part:
        return Value(parts[part])
    return Value(tuple((*left, *right) for left, right in zip(lower, found.rows, strict=True)))


def _lu_remarks(A: Value, part: str | None) -> list[str]:
    if part == "P" or not echelon(A.matrix).is_exchanged:
        return []
    return ['Rows changed places, so P A = L U: lu(A, "P") is P.']


FUNCTIONS: dict[str, Function] = {
    "rank": Function(
        (matrix(),),
        "the number of independent rows",
        "rows left after elimination",
        "rank(A) = number of pivots",
        "rank([1 2; 2 4])",
        "1",
        _rank,
    ),
    "rref": Function(
        (matrix(),),
        "the reduced row echelon form",
        "row operations, until every pivot is a 1 alone in its column",
        "[A | b] → [I | x]",
        "rref([2 1 5; 1 1 3])",
        "[1 0 2; 0 1 1]",
        lambda A: Value(reduced(A.matrix)[0]),
    ),
    "solve": Function(
        (matrix(), Parameter("b", (ValueKind.VECTOR, ValueKind.MATRIX))),
        "the one vector, or matrix, that A takes to b",
        "elimination of A with b beside it",
        "A x = b",
        "solve([2 1; 1 1], [5, 3])",
        "[2, 1]",
        _solve,
    ),
    "null_space": Function(
        (matrix(),),
        "what A sends to 0: one vector, or the columns of a matrix that span it",
        "one vector for each column without a pivot",
        "A x = 0",
        "null_space([1 2; 2 4])",
        "[-2, 1]",
        _null_space,
    ),
    "lu": Function(
        (matrix(), word("part", "L", "U", "P")),
        "L and U side by side, or the one that is asked for: L has ones on its diagonal and the "
        "factors of elimination below, U is what elimination leaves",
        "elimination undone: L puts back what was subtracted",
        "P A = L U",
        "lu([4 2; 2 3])",
        "[1 0 4 2; 1/2 1 0 2]",
        _lu,
        remarks=_lu_remarks,
    ),
}
