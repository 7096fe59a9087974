"""The judgement of one answer: right, a mistake with a name, or unknown.

First the right answer, then the answer of every single mistake, then of every pair. A pair counts
only where no other pair gives the same numbers. What agrees with every digit that was typed comes
before what is only close: where an angle is tiny, the right answer is close to the wrong ones.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from fractions import Fraction
from functools import cached_property
from itertools import takewhile

from nmatrix.lessons.check.answer import Answer
from nmatrix.lessons.check.hints import Hint, hints, left_out, undivided
from nmatrix.lessons.check.likeness import (
    Likeness,
    Place,
    is_alike,
    likeness,
    likeness_to_known,
    may_be_alike,
)
from nmatrix.lessons.check.mistake import MistakeId
from nmatrix.lessons.check.mistakes import MISTAKES
from nmatrix.lessons.check.question import Question, Subject, right_answer
from nmatrix.lessons.check.wrong import WrongAnswer, WrongAnswers
from nmatrix.linear.exact import LinearMap
from nmatrix.linear.rational import RationalMatrix, linear_part, scaled

RIGHT = "This is right."
UP_TO_LENGTH = "Right up to length: a positive factor changes no direction."
NO_MISTAKE = "No known mistake, nor two of them, gives these numbers."
TOO_FEW_DIGITS = (
    "Nearly right: a whole number or a zero stands where there is a number with more digits; give "
    "them, behind a point."
)
SEVERAL = "Several pairs of mistakes give these numbers:"
TWO_SIDED = (
    "The map flattens space to a plane, whose two sides are alike: both directions are right."
)

Names = dict[tuple[MistakeId, ...], None]  # in the order of the table


class Outcome(StrEnum):
    """What an answer turned out to be."""

    CORRECT = "correct"
    MISTAKE = "mistake"
    UNKNOWN = "unknown"


@dataclass(frozen=True)
class Judgement:
    """What is to be said about one answer.

    `right` and `wrong_entries` are in the shape of the answer; `also` are the mistakes that give
    the same numbers here.
    """

    verdict: Outcome
    right: RationalMatrix
    max_difference: Fraction
    wrong_entries: tuple[Place, ...] = ()
    mistakes: tuple[MistakeId, ...] = ()
    also: tuple[str, ...] = ()
    explanation: str = RIGHT
    remarks: tuple[str, ...] = ()

    @property
    def mistake(self) -> str | None:
        """The id, or two joined by a plus sign."""
        return "+".join(self.mistakes) or None


@dataclass(frozen=True)
class Judge:
    """Judges answers to one question; what is common to all of them is computed once."""

    question: Question

    @cached_property
    def right(self) -> RationalMatrix:
        """The right answer."""
        return right_answer(self.question)

    @cached_property
    def wrong(self) -> WrongAnswers:
        """The wrong answers of one mistake and of two."""
        return WrongAnswers(self.question)

    @cached_property
    def singles(self) -> tuple[WrongAnswer, ...]:
        """The wrong answers of single mistakes that differ from the right one."""
        return tuple(self._distinct(self.wrong.of_singles()))

    @cached_property
    def doubles(self) -> tuple[WrongAnswer, ...]:
        """The wrong answers of two mistakes, but not what a single one gives as well."""
        return tuple(one for one in self._distinct(self._pairs) if not self._is_single(one))

    def wrong_by(self, mistake: MistakeId) -> tuple[RationalMatrix, ...]:
        """List the different wrong answers of one mistake; none where it does not show here."""
        made = self._distinct(self.wrong.of(mistake))
        return tuple(one.value for one in made if one.value is not None)

    def is_given_before(self, mistake: MistakeId, answer: Answer) -> bool:
        """Decide if a mistake before this one in the table gives every digit of an answer."""
        return any(
            found.to_the_digit
            for earlier in takewhile(lambda one: one is not mistake, MistakeId)
            for _, found in self._alike(answer, self.wrong.of(earlier))
        )

    @cached_property
    def _single_mistakes(self) -> tuple[WrongAnswer, ...]:
        return tuple(self.wrong.of_singles())

    @cached_property
    def _pairs(self) -> tuple[WrongAnswer, ...]:
        return tuple(self.wrong.of_pairs())

    @cached_property
    def hints(self) -> tuple[Hint, ...]:
        """Numbers that an answer may be although no mistake with a name gives them."""
        return tuple(hints(self.question))

    def judge(self, answer: Answer) -> Judgement:
        """Judge an answer.

        Examples
        --------
        >>> from nmatrix.lessons.check.answer import read_answer
        >>> from nmatrix.scene.setup import Setup
        >>> from nmatrix.scene.world import World
        >>> asked = Question(Subject.NORMAL, Setup(World(scale=(1, 2, 1))))
        >>> Judge(asked).judge(read_answer("1 0 0; 0 2 0; 0 0 1", asked)).mistake
        'not-inverted'
        """
        found = likeness(answer, self.right, self.question)
        if found.alike and not self._is_rather_a_mistake(answer, found):
            return self._correct(answer, found)
        if self._is_other_side(answer):
            return Judgement(Outcome.CORRECT, self.right, found.difference, remarks=(TWO_SIDED,))
        names = self._single(answer, found)
        if names:
            return self._mistaken(answer, found, names)
        names = self._named(answer, found, self._pairs)
        if self._is_one_pair(names):
            return self._mistaken(answer, found, names)
        if found.lacks_only_digits:
            return self._unknown(answer, found, TOO_FEW_DIGITS)
        several = f"{SEVERAL} {', '.join(map('+'.join, names))}." if names else NO_MISTAKE
        hint = self._hint(answer) or undivided(self.question, found)
        hint = hint or left_out(self.question, found)
        return self._unknown(answer, found, hint or several)

    def _is_rather_a_mistake(self, answer: Answer, found: Likeness) -> bool:
        """Prefer a mistake that gives every digit of an answer which is only close to right."""
        if found.to_the_digit or self.question.tolerance is not None:
            return False
        return any(alike.to_the_digit for _, alike in self._alike(answer, self._single_mistakes))

    def _correct(self, answer: Answer, found: Likeness) -> Judgement:
        remarks = answer.remarks if found.factor == 1 else (*answer.remarks, UP_TO_LENGTH)
        return Judgement(Outcome.CORRECT, self.right, found.difference, remarks=remarks)

    def _is_other_side(self, answer: Answer) -> bool:
        question = self.question
        if question.subject is not Subject.NORMAL or question.normal is None:
            return False
        S = question.setup.maps.space_from_object(question.space).exact
        if LinearMap.of(linear_part(S)).integer_determinant:
            return False
        return is_alike(answer, scaled(self.right, Fraction(-1)), question)

    def _single(self, answer: Answer, found: Likeness) -> Names:
        names = self._named(answer, found, self._single_mistakes)
        if not names and self._only_length(answer):
            return {(MistakeId.MISSING_NORMALISE,): None}
        return names

    def _mistaken(self, answer: Answer, found: Likeness, names: Names) -> Judgement:
        first, *others = names
        return Judgement(
            Outcome.MISTAKE,
            scaled(self.right, found.factor),
            found.difference,
            found.wrong or found.unrounded,
            first,
            tuple(map("+".join, others)),
            self._explanation(answer, first, others),
            answer.remarks,
        )

    def _explanation(
        self, answer: Answer, first: tuple[MistakeId, ...], others: Sequence[tuple[MistakeId, ...]]
    ) -> str:
        """Tell what was done, the rules broken, and what else would have given this."""
        sentences = [MISTAKES[one].explanation for one in first]
        alike = [" ".join(MISTAKES[one].did for one in other) for other in others]
        hint = self._hint(answer)
        if hint is not None:
            alike.append(hint)
        return " ".join([*sentences, *(f"Or, with the same numbers here: {did}" for did in alike)])

    def _named(self, answer: Answer, right: Likeness, wrong: tuple[WrongAnswer, ...]) -> Names:
        """Name the mistakes whose numbers these are: to every digit, or else nearly."""
        alike = list(self._alike(answer, wrong))
        to_the_digit = {one.mistakes: None for one, found in alike if found.to_the_digit}
        clear = {one.mistakes: None for one, found in alike if found.is_clear_of(right)}
        return to_the_digit or clear

    def _alike(
        self, answer: Answer, wrong: tuple[WrongAnswer, ...]
    ) -> Iterator[tuple[WrongAnswer, Likeness]]:
        """List the wrong answers that these numbers may be; most are ruled out in floats."""
        for one in wrong:
            if not may_be_alike(answer, one.floats, self.question) or one.value is None:
                continue
            found = likeness_to_known(answer, one.value, self.question)
            if found is None or not found.alike_as_a_mistake:
                continue
            if self._is_wrong(one) and (len(one.mistakes) == 1 or not self._is_single(one)):
                yield one, found

    def _is_wrong(self, one: WrongAnswer) -> bool:
        """Tell what a mistake gives from what is right by chance."""
        return one.value is not None and self._shape(one.value) != self._right_shape

    @cached_property
    def _right_shape(self) -> RationalMatrix:
        return self._shape(self.right)

    def _is_single(self, pair: WrongAnswer) -> bool:
        """Decide if a single mistake gives the numbers of a pair."""
        return pair.value is not None and self._shape(pair.value) in self._single_shapes

    @cached_property
    def _single_shapes(self) -> dict[RationalMatrix, set[MistakeId]]:
        """The mistakes by the numbers that they give."""
        found: dict[RationalMatrix, set[MistakeId]] = {}
        for one in self._single_mistakes:
            if one.value is not None:
                found.setdefault(self._shape(one.value), set()).update(one.mistakes)
        return found

    def _is_one_pair(self, names: Names) -> bool:
        """Decide if pairs are one: beside a mistake that all have, what gives the same numbers."""
        if len(names) < 2:
            return bool(names)
        shared = set.intersection(*map(set, names))
        if not shared:
            return False
        others = {one for pair in names for one in pair} - shared
        return any(others <= alike for alike in self._single_shapes.values())

    def _only_length(self, answer: Answer) -> bool:
        """Recognise a vector of which only the length is wrong, where length one was asked for."""
        free = replace(self.question, unit=False)
        return self.question.unit and is_alike(answer, self.right, free)

    def _unknown(self, answer: Answer, found: Likeness, sentence: str) -> Judgement:
        return Judgement(
            Outcome.UNKNOWN,
            scaled(self.right, found.factor),
            found.difference,
            found.wrong,
            explanation=sentence,
            remarks=answer.remarks,
        )

    def _hint(self, answer: Answer) -> str | None:
        alike = (one for one in self.hints if is_alike(answer, one.value, self.question))
        return next((one.sentence for one in alike), None)

    def _distinct(self, wrong: Iterable[WrongAnswer]) -> Iterator[WrongAnswer]:
        """Leave out what is right by chance, and values that the same mistake gave before."""
        seen: set[tuple[tuple[MistakeId, ...], RationalMatrix]] = set()
        for one in wrong:
            if one.value is None or not self._is_wrong(one):
                continue
            shape = (one.mistakes, self._shape(one.value))
            if shape not in seen:
                seen.add(shape)
                yield one

    def _shape(self, value: RationalMatrix) -> RationalMatrix:
        """Bring a value into a form that is the same for all values that count as the same."""
        if not self.question.any_length:
            return value
        largest = max(abs(entry) for row in value for entry in row)
        return scaled(value, 1 / largest) if largest else value
