"""Every wrong answer that a known mistake, or two of them, give to a question."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations, product

from nmatrix.errors import NoAnswerError
from nmatrix.lessons.check.computation import NO_ANSWER, MisreadScenes, Way
from nmatrix.lessons.check.mistake import MistakeId
from nmatrix.lessons.check.mistakes import MISTAKES
from nmatrix.lessons.check.question import Question
from nmatrix.linear.rational import RationalMatrix


@dataclass(frozen=True, eq=False)
class WrongAnswer:
    """What one mistake, or two of them, give; exact numbers are made only when they are read."""

    mistakes: tuple[MistakeId, ...]
    way: Way

    @cached_property
    def value(self) -> RationalMatrix | None:
        """The answer; None where the mistaken scene has none."""
        return self.way.value

    @cached_property
    def floats(self) -> list[float] | None:
        """The answer in floats, row by row; empty if there is none, None if floats do not tell."""
        try:
            found = self.way.floats()
        except NoAnswerError:
            return []
        except NO_ANSWER:
            return None
        return [entry for row in found or () for entry in row]  # type: ignore[misc]  # floats inside


class WrongAnswers:
    """The wrong answers to one question, made when they are first asked for."""

    def __init__(self, question: Question) -> None:
        self._question = question
        self._scenes = MisreadScenes(question)
        self._by_mistake: dict[MistakeId, tuple[WrongAnswer, ...]] = {}

    def of(self, mistake: MistakeId) -> tuple[WrongAnswer, ...]:
        """Make one mistake in every way that it can happen here."""
        if mistake not in self._by_mistake:
            self._by_mistake[mistake] = tuple(
                WrongAnswer((mistake,), way)
                for made in MISTAKES[mistake].made_in(self._question)
                for way in made.ways(self._scenes)
            )
        return self._by_mistake[mistake]

    def of_singles(self) -> Iterator[WrongAnswer]:
        """Make every mistake that can happen here, in the order of the table."""
        for mistake in MistakeId:
            yield from self.of(mistake)

    def of_pairs(self) -> Iterator[WrongAnswer]:
        """Make every two mistakes that can happen at once."""
        made = {mistake: MISTAKES[mistake].made_in(self._question) for mistake in MistakeId}
        for first, second in combinations(MistakeId, 2):
            for one, other in product(made[first], made[second]):
                both = one + other
                if both is not None:
                    for way in both.ways(self._scenes):
                        yield WrongAnswer((first, second), way)
