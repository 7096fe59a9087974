"""How alike two answers are: entry by entry, or up to a positive factor where length is free."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from math import isnan

from nmatrix.lessons.check.answer import Answer, with_w_one
from nmatrix.lessons.check.question import Question
from nmatrix.linear.rational import ONE, ZERO, RationalMatrix, Rows, dot, scaled

RELATIVE = Fraction(5, 10_000)  # of the largest entry: three good digits
COARSEST = Fraction(1, 10)  # of the largest entry: so that zeros are never right by rounding

Place = tuple[int, int]


@dataclass(frozen=True)
class Likeness:
    """An answer beside a value: the largest difference, and the entries that are too far off.

    `factor` is what the value was multiplied by, 1 unless length is free.
    """

    difference: Fraction
    wrong: tuple[Place, ...]
    factor: Fraction

    @property
    def alike(self) -> bool:
        """Return whether every entry is within the tolerance."""
        return not self.wrong


def likeness(answer: Answer, value: RationalMatrix, question: Question) -> Likeness:
    """Compare an answer with a value under the question's rules.

    Where length is free, the factor is that of least squares, or the one on which most entries
    agree: a matrix with one wrong entry then shows that one.

    Examples
    --------
    >>> from nmatrix.lessons.check.question import Subject
    >>> from nmatrix.scene.shot import Shot
    >>> free = Question(Subject.NORMAL, Shot(), normal=(0, 0, 1))
    >>> seven = Answer(((ZERO, ZERO, Fraction(7)),), ((0, 0, 0),))
    >>> likeness(seven, ((ZERO, ZERO, ONE, ZERO),), free).factor
    Fraction(7, 1)
    """
    given, wanted = _comparable(answer.rows, value, question)
    best = _at(given, wanted, ONE, answer, question)
    if best.alike or not question.any_length:
        return best
    first = True
    for factor in _factors(given, wanted):
        found = _at(given, wanted, factor, answer, question)
        if first and found.alike:
            return found
        first = False
        best = min(best, found, key=lambda one: (len(one.wrong), one.difference))
    return best


def is_alike(answer: Answer, value: RationalMatrix, question: Question) -> bool:
    """Return whether an answer and a value are the same to the digits given."""
    given, wanted = _comparable(answer.rows, value, question)
    if not question.any_length:
        return _at(given, wanted, ONE, answer, question).alike
    factor = _least_squares(given, wanted)
    return factor > 0 and _at(given, wanted, factor, answer, question).alike


def may_be_alike(answer: Answer, value: Rows | None, question: Question) -> bool:
    """Return False only if an answer and a value are surely different, at the price of floats."""
    given = answer.floats
    if given is None or value is None or len(given[0]) != len(value[0]):
        return True
    a = [entry for row in given for entry in row]
    v = [entry for row in value for entry in row]
    factor = 1.0
    if question.any_length:
        square = sum(y * y for y in v)
        factor = sum(x * y for x, y in zip(a, v, strict=True)) / square if square else 0.0
        if not factor > 0:
            return isnan(factor)  # an overflow says nothing
    limit = answer.coarsest if question.tolerance is None else float(question.tolerance)
    largest = max(map(abs, v)) * factor
    far = 1.01 * max(limit, float(RELATIVE) * largest) + 1e-9 * largest
    return not any(abs(x - factor * y) > far for x, y in zip(a, v, strict=True))


def _comparable(
    given: RationalMatrix, value: RationalMatrix, question: Question
) -> tuple[RationalMatrix, RationalMatrix]:
    if not question.is_vector:
        return given, value
    if len(given[0]) == 3:
        return given, (value[0][:3],)
    if question.is_direction:
        return given, value
    return (with_w_one(given[0]),), (with_w_one(value[0]),)


def _at(
    given: RationalMatrix,
    value: RationalMatrix,
    factor: Fraction,
    answer: Answer,
    question: Question,
) -> Likeness:
    wanted = scaled(value, factor)
    largest = max(abs(entry) for row in wanted for entry in row)
    differences = {
        (i, j): abs(entry - right)
        for i, (row, wanted_row) in enumerate(zip(given, wanted, strict=True))
        for j, (entry, right) in enumerate(zip(row, wanted_row, strict=True))
    }
    wrong = tuple(
        (i, j)
        for (i, j), difference in differences.items()
        if difference > _limit(answer.last_places[i][j], largest, question)
    )
    return Likeness(max(differences.values()), wrong, factor)


def _limit(last_place: Fraction, largest: Fraction, question: Question) -> Fraction:
    """Return how far one entry may be off."""
    if question.tolerance is not None:
        return question.tolerance
    if not largest:
        return last_place
    return max(min(last_place, COARSEST * largest), RELATIVE * largest)


def _factors(given: RationalMatrix, value: RationalMatrix) -> Iterator[Fraction]:
    """Give the positive factors worth trying, least squares first."""
    squares = _least_squares(given, value)
    if squares > 0:
        yield squares
    ratios = {
        entry / wanted
        for row, wanted_row in zip(given, value, strict=True)
        for entry, wanted in zip(row, wanted_row, strict=True)
        if entry and wanted
    }
    yield from sorted(ratio for ratio in ratios if ratio > 0)


def _least_squares(given: RationalMatrix, value: RationalMatrix) -> Fraction:
    flat = [entry for row in value for entry in row]
    square = dot(flat, flat)
    return dot([entry for row in given for entry in row], flat) / square if square else ZERO
