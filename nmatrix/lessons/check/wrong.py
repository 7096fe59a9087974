"""Every wrong answer that a known mistake, or two of them, give to a question."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

from nmatrix.lessons.check.answer import floats_or_none
from nmatrix.lessons.check.computation import MisreadScenes
from nmatrix.lessons.check.mistakes import MISTAKES, MistakeId
from nmatrix.lessons.check.question import Question
from nmatrix.linear.rational import RationalMatrix, Rows


@dataclass(frozen=True)
class WrongAnswer:
    """What one mistake, or two of them, give."""

    mistakes: tuple[MistakeId, ...]
    value: RationalMatrix

    @cached_property
    def floats(self) -> Rows | None:
        """The value in float64, for a first look; None where it is beyond."""
        return floats_or_none(self.value)


def single_mistakes(question: Question) -> Iterator[WrongAnswer]:
    """Make every mistake that can happen here, in the order of the table."""
    scenes = MisreadScenes(question)
    for mistake in MistakeId:
        made = MISTAKES[mistake].made_in(question)
        if made is not None:
            for value in made.answers(scenes):
                yield WrongAnswer((mistake,), value)


def pairs(question: Question) -> Iterator[WrongAnswer]:
    """Make every two mistakes that can happen at once."""
    scenes = MisreadScenes(question)
    made = {mistake: MISTAKES[mistake].made_in(question) for mistake in MistakeId}
    for first, second in combinations(MistakeId, 2):
        one, other = made[first], made[second]
        both = None if one is None or other is None else one + other
        if both is not None:
            for value in both.answers(scenes):
                yield WrongAnswer((first, second), value)
