"""How alike two answers are: entry by entry, or up to a positive factor where length is free."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import isnan, nan
from operator import mul

from nmatrix.lessons.check.answer import Answer, with_w_one
from nmatrix.lessons.check.question import Question
from nmatrix.lessons.check.tolerance import (
    A_TWENTIETH,
    NOISE,
    EntryDifference,
    Written,
    yardsticks,
)
from nmatrix.linear.rational import ONE, ZERO, RationalMatrix, dot, scaled

BOTTOM = 3  # of a 4×4 matrix
SMALLEST = 1e-6  # of the sum of an answer's squares, and of its w

Place = tuple[int, int]


@dataclass(frozen=True, eq=False)
class Likeness:
    """The numbers of an answer beside those of a value, in one shape.

    `factor` is what the value was multiplied by, 1 unless length is free.
    """

    given: RationalMatrix
    wanted: RationalMatrix
    last_places: RationalMatrix
    question: Question
    factor: Fraction

    @property
    def alike(self) -> bool:
        """Whether every entry is near enough to be right."""
        return not self.wrong

    @property
    def alike_as_a_mistake(self) -> bool:
        """Whether every entry is near enough for a mistake to be named."""
        if self.question.tolerance is not None:
            return self.alike
        return all(off.is_near_a_mistake() for off in self._entries.values())

    @cached_property
    def to_the_digit(self) -> bool:
        """Whether every digit that was typed is the value's, at some length if it is free."""
        return self.common_factor is not None if self.question.any_length else not self.unrounded

    @cached_property
    def common_factor(self) -> Fraction | None:
        """A positive factor of the value that gives every digit that was typed.

        Each entry leaves an interval of factors; there is one if they have a point in common.
        """
        least, most = ZERO, None
        for (i, j), off in self._entries.items():
            given, wanted = self.given[i][j], self.wanted[i][j]
            exact = off.written.is_exact
            half = NOISE * off.yardstick if exact else max(off.place / 2, NOISE * off.yardstick)
            if not wanted:
                if abs(given) > half:
                    return None
                continue
            low, high = sorted(((given - half) / wanted, (given + half) / wanted))
            least, most = max(least, low), high if most is None else min(most, high)
        if most is None or least > most or most <= 0:
            return None
        return (least + most) / 2

    @cached_property
    def difference(self) -> Fraction:
        """The largest difference of two entries."""
        return max(off.difference for off in self._entries.values())

    @cached_property
    def wrong(self) -> tuple[Place, ...]:
        """The entries that are too far off."""
        if self.given == self.wanted:
            return ()
        tolerance = self.question.tolerance
        if tolerance is not None:
            return self._where(lambda off: off.difference > tolerance)
        return self._where(lambda off: not off.is_near())

    @cached_property
    def unrounded(self) -> tuple[Place, ...]:
        """The entries that are not the value's, rounded to the digits that were typed."""
        return self._where(lambda off: not off.is_rounded())

    @property
    def lacks_only_digits(self) -> bool:
        """Whether every wrong entry is a number that was written with too few digits."""
        return all(self._entries[place].lacks_digits() for place in self.wrong)

    def is_clear_of(self, right: Likeness) -> bool:
        """Decide if the numbers lie by far nearer to the value than the value to what is right.

        Among the entries in which the two differ, at most a quarter of the largest difference.
        """
        changed = {
            (i, j): abs(self.wanted[i][j] - right.wanted[i][j])
            for i, j in self._entries
            if self.wanted[i][j] != right.wanted[i][j]
        }
        off = max((self._entries[place].difference for place in changed), default=ZERO)
        return 4 * off <= max(changed.values(), default=ZERO)

    @cached_property
    def _entries(self) -> dict[Place, EntryDifference]:
        rulers = yardsticks(self.wanted, is_vector=self.question.is_vector)
        largest = max(abs(entry) for row in self.wanted for entry in row)
        coarsest = A_TWENTIETH * largest if self.question.any_length else ONE
        rows = zip(self.given, self.wanted, self.last_places, rulers, strict=True)
        found: dict[Place, EntryDifference] = {}
        for i, row in enumerate(rows):
            for j, (given, wanted, place, yardstick) in enumerate(zip(*row, strict=True)):
                off, counted = abs(given - wanted), min(place, coarsest)
                written = _written(given, place, i)
                found[i, j] = EntryDifference(off, counted, yardstick, largest, written)
        return found

    def _where(self, said: Callable[[EntryDifference], bool]) -> tuple[Place, ...]:
        return tuple(place for place, off in self._entries.items() if off.difference and said(off))


def _written(given: Fraction, place: Fraction, row: int) -> Written:
    if given:
        return Written.DECIMAL if place else Written.WHOLE
    return Written.DECIMAL_ZERO if place and row != BOTTOM else Written.BARE_ZERO


def likeness(answer: Answer, value: RationalMatrix, question: Question) -> Likeness:
    """Compare an answer with a value under the question's rules.

    Where length is free, the factor is that of least squares, or the one on which most entries
    agree: a matrix with one wrong entry then shows that one.

    Examples
    --------
    >>> from nmatrix.lessons.check.question import Subject
    >>> from nmatrix.scene.setup import Setup
    >>> free = Question(Subject.NORMAL, Setup(), normal=(0, 0, 1))
    >>> seven = Answer(((ZERO, ZERO, Fraction(7)),), ((ZERO,) * 3,))
    >>> likeness(seven, ((ZERO, ZERO, ONE, ZERO),), free).factor
    Fraction(7, 1)
    """
    given, wanted = _comparable(answer.rows, value, question)
    as_it_is = _at(given, wanted, ONE, answer, question)
    if as_it_is.alike or not question.any_length:
        return as_it_is
    if as_it_is.common_factor is not None:
        rounded = _at(given, wanted, as_it_is.common_factor, answer, question)
        if rounded.alike:
            return rounded
    tried = [_at(given, wanted, factor, answer, question) for factor in _factors(given, wanted)]
    if tried and tried[0].alike:
        return tried[0]
    return min((as_it_is, *tried), key=lambda one: (len(one.wrong), one.difference))


def likeness_to_known(answer: Answer, value: RationalMatrix, question: Question) -> Likeness | None:
    """Compare an answer with a value at one factor; None where only a negative one would do."""
    given, wanted = _comparable(answer.rows, value, question)
    factor = _least_squares(given, wanted) if question.any_length else ONE
    return _at(given, wanted, factor, answer, question) if factor > 0 else None


def is_alike(answer: Answer, value: RationalMatrix, question: Question) -> bool:
    """Compare an answer and a value to the digits given."""
    found = likeness_to_known(answer, value, question)
    return found is not None and found.alike


def may_be_alike(answer: Answer, numbers: Sequence[float] | None, question: Question) -> bool:
    """Rule out the numbers of a value by a cheap comparison in floats; True says nothing yet."""
    given = answer.floats
    if given is None or numbers is None:
        return True
    if question.is_vector:
        numbers = numbers[: len(given)]
    if not numbers:
        return False
    if question.is_point and len(given) > 3:
        if abs(numbers[3]) < SMALLEST:
            return True
        numbers = [y / numbers[3] for y in numbers]
    factor = _float_factor(given, numbers, question)
    if question.any_length and not factor > 0:
        return isnan(factor)
    far = answer.reach(question.tolerance) * max(1.0, abs(factor) if question.is_point else 1.0)
    return not any(abs(x - factor * y) > far for x, y in zip(given, numbers, strict=True))


def _float_factor(given: Sequence[float], numbers: Sequence[float], question: Question) -> float:
    """Take the w of a point, or the factor of least squares; NaN if only noise would have one."""
    if not question.any_length:
        return given[3] or 1.0 if question.is_point and len(given) > 3 else 1.0
    square = sum([y * y for y in numbers])
    return sum(map(mul, given, numbers)) / square if square > SMALLEST else nan


def _comparable(
    given: RationalMatrix, value: RationalMatrix, question: Question
) -> tuple[RationalMatrix, RationalMatrix]:
    if not question.is_vector:
        return given, value
    if len(given[0]) == 3:
        return given, (value[0][:3],)
    if not question.is_point:
        return given, value
    return (with_w_one(given[0]),), (with_w_one(value[0]),)


def _at(
    given: RationalMatrix,
    value: RationalMatrix,
    factor: Fraction,
    answer: Answer,
    question: Question,
) -> Likeness:
    wanted = value if factor == 1 else scaled(value, factor)
    return Likeness(given, wanted, answer.last_places, question, factor)


def _factors(given: RationalMatrix, value: RationalMatrix) -> Iterator[Fraction]:
    """Try positive factors, least squares first."""
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
