"""A student's answer: the exact numbers as they were typed, and how far they claim to go."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from nmatrix.enums import Layout
from nmatrix.errors import IllegalValueError
from nmatrix.lessons.check.question import Question, Subject
from nmatrix.linear.rational import ONE, RationalMatrix, affine, linear
from nmatrix.reading.literal import ExactRows
from nmatrix.reading.matrix import matrix_literal

FEWEST_DECIMALS = 2  # an answer of whole numbers claims two decimals


@dataclass(frozen=True)
class Answer:
    """Numbers in the shape of the question.

    `rows` is a matrix, or a vector of three or four numbers as one row.
    """

    rows: RationalMatrix
    remarks: tuple[str, ...] = ()

    @property
    def last_place(self) -> Fraction:
        """Return one unit of the last place given; fractions are exact and give no place.

        Examples
        --------
        >>> Answer(((Fraction("0.7071"), Fraction(1, 3), Fraction(0)),)).last_place
        Fraction(1, 10000)
        """
        places = [decimals(entry) for row in self.rows for entry in row]
        given = [place for place in places if place is not None]
        if not given:
            return Fraction(0)
        return Fraction(1, 10 ** max(FEWEST_DECIMALS, *given))


def decimals(value: Fraction) -> int | None:
    """Return how many decimals a number needs, or None where no number of them is enough.

    Examples
    --------
    >>> decimals(Fraction("1.25")), decimals(Fraction(3)), decimals(Fraction(1, 3))
    (2, 0, None)
    """
    rest, twos, fives = value.denominator, 0, 0
    while rest % 2 == 0:
        rest, twos = rest // 2, twos + 1
    while rest % 5 == 0:
        rest, fives = rest // 5, fives + 1
    return max(twos, fives) if rest == 1 else None


def read_answer(text: str, question: Question) -> Answer:
    """Return the answer that a text spells, in any notation that matrices have.

    Raises
    ------
    IllegalValueError
        If it is no matrix or vector, or has another number of entries than what is asked for.

    Examples
    --------
    >>> from nmatrix.scene.shot import Shot
    >>> [int(x) for x in read_answer("0, 0, -5", Question(Subject.EYE, Shot())).rows[0]]
    [0, 0, -5]
    """
    return shaped(matrix_literal(text, Layout.ROW_MAJOR).rows_exact, question)


def shaped(rows: ExactRows, question: Question) -> Answer:
    """Return numbers in the shape of a question: a matrix, or one row of three or four."""
    if question.is_vector:
        flat = tuple(entry for row in rows for entry in row)
        if len(flat) in (3, 4) and 1 in (len(rows), len(rows[0])):
            return Answer((flat,))
        raise _refusal(rows, question, "3 or 4 numbers", "1 0 0")
    size = (len(rows), len(rows[0]))
    if question.subject is Subject.NORMAL:
        if size == (3, 3):
            return Answer(rows)
        if size == (4, 4):
            return Answer(linear(rows), ("Of the 16 numbers the 3×3 block was compared.",))
        raise _refusal(rows, question, "9 or 16 numbers", "1 0 0; 0 1 0; 0 0 1")
    if size == (4, 4):
        return Answer(rows)
    if size == (3, 3) and question.subject is not Subject.PROJECTION:
        return Answer(affine(rows), ("Nine numbers were taken as a matrix without translation.",))
    wanted = "16 numbers" if question.subject is Subject.PROJECTION else "9 or 16 numbers"
    raise _refusal(rows, question, wanted, "1 0 0 0; 0 1 0 0; 0 0 1 0; 0 0 0 1")


def with_w_one(row: tuple[Fraction, ...]) -> tuple[Fraction, ...]:
    """Return a point of four numbers divided by its w, unless that is 0."""
    w = row[3]
    return row if w in (0, ONE) else tuple(entry / w for entry in row)


def _refusal(rows: ExactRows, question: Question, wanted: str, example: str) -> IllegalValueError:
    got = f"{len(rows)} rows of {len(rows[0])}" if len(rows) > 1 else f"{len(rows[0])} numbers"
    return IllegalValueError(
        f"answer ({got})", f"{question.subject} takes {wanted}", f'write it like "{example}"'
    )
