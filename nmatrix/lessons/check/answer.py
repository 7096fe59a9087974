"""A student's answer: the exact numbers as they were typed, and how many digits were given."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

from nmatrix.enums import Layout
from nmatrix.errors import IllegalValueError, counted
from nmatrix.lessons.check.question import Question, Subject
from nmatrix.lessons.check.tolerance import FEWEST, RELATIVE
from nmatrix.linear.rational import (
    ONE,
    ZERO,
    RationalMatrix,
    affine_matrix,
    linear_part,
    to_floats,
)
from nmatrix.reading.literal import MatrixLiteral
from nmatrix.reading.matrix import matrix_literal

ROUGH = 1e-6  # of the largest entry: floats are far better


@dataclass(frozen=True)
class Answer:
    """Numbers in the shape of the question.

    `rows` is a matrix, or a vector of three or four numbers as one row; `last_places` are one unit
    of the last decimal of each, 0 of a whole number or a fraction, which is exact.
    """

    rows: RationalMatrix
    last_places: RationalMatrix
    remarks: tuple[str, ...] = ()

    @cached_property
    def floats(self) -> tuple[float, ...] | None:
        """The numbers in float64, row by row, for a first look; None where one is beyond."""
        try:
            return tuple(entry for row in to_floats(self.rows) for entry in row)
        except IllegalValueError:
            return None

    def reach(self, tolerance: Fraction | None) -> float:
        """Bound how far a value may be off that a first look does not rule out, at its length.

        What is alike is nearly as large as the answer itself.
        """
        if tolerance is not None:
            return 1.01 * float(tolerance) + ROUGH * self._largest
        return self._usual_reach

    @cached_property
    def _largest(self) -> float:
        return max(map(abs, self.floats or (0.0,)))

    @cached_property
    def _usual_reach(self) -> float:
        """Allow for the coarsest last place that counts when a mistake is looked for."""
        places = (place for row in self.last_places for place in row)
        coarsest = float(max(min(place or FEWEST, FEWEST) for place in places))
        return 0.51 * coarsest + (1.01 * float(RELATIVE) + ROUGH) * self._largest


def read_answer(text: str, question: Question, layout: Layout | None = None) -> Answer:
    """Read an answer in any notation that matrices have.

    Raises
    ------
    IllegalValueError
        If it is no matrix or vector, or has another number of entries than what is asked for.

    Examples
    --------
    >>> from nmatrix.scene.setup import Setup
    >>> [int(x) for x in read_answer("0, 0, -5", Question(Subject.EYE, Setup())).rows[0]]
    [0, 0, -5]
    """
    return shaped(matrix_literal(text, layout), question)


def shaped(literal: MatrixLiteral, question: Question) -> Answer:
    """Bring numbers into the shape of a question: a matrix, or one row of three or four."""
    rows, places, size = literal.rows_exact, literal.last_places, literal.shape
    if question.is_vector:
        flat = tuple(entry for row in rows for entry in row)
        if len(flat) in (3, 4) and 1 in size:
            return Answer((flat,), (tuple(place for row in places for place in row),))
        raise _refusal(size, "3 or 4 numbers", "1 0 0")
    if question.subject is Subject.NORMAL:
        if size == (3, 3):
            return Answer(rows, places)
        if size == (4, 4):
            block = tuple(row[:3] for row in places[:3])
            remark = "Of the 16 numbers the 3×3 block was compared."
            return Answer(linear_part(rows), block, (remark,))
        raise _refusal(size, "9 or 16 numbers", "1 0 0; 0 1 0; 0 0 1")
    if size == (4, 4):
        return Answer(rows, places)
    if size == (3, 3) and question.subject is not Subject.PROJECTION:
        grown = (*((*row, ZERO) for row in places), (ZERO,) * 4)
        return Answer(affine_matrix(rows), grown, ("Nine numbers: a matrix without translation.",))
    wanted = "16 numbers" if question.subject is Subject.PROJECTION else "9 or 16 numbers"
    raise _refusal(size, wanted, "1 0 0 0; 0 1 0 0; 0 0 1 0; 0 0 0 1")


def with_w_one(row: tuple[Fraction, ...]) -> tuple[Fraction, ...]:
    """Divide a point of four numbers by its w, unless that is 0."""
    w = row[3]
    return row if w in (0, ONE) else tuple(entry / w for entry in row)


def _refusal(size: tuple[int, int], wanted: str, example: str) -> IllegalValueError:
    got = f"{size[0]} rows of {size[1]}" if size[0] > 1 else counted(size[1], "number")
    return IllegalValueError(
        f"answer ({got})", f"it is to have {wanted}", f'write it like "{example}"'
    )
