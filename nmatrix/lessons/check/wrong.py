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
from nmatrix.linear.rational import RationalMatrix, Rows

SMALLEST = (
    1e-3  # of an answer's largest entry: smaller ones may be what floats left of a difference
)


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
    def floats(self) -> Rows | None:
        """The answer in floats; empty where there is none, None where they do not tell."""
        try:
            found = self.way.floats()
        except NoAnswerError:
            return ()
        except NO_ANSWER:
            return None
        if found is None:
            return ()
        largest = max(abs(entry) for row in found for entry in row)
        return found if largest > SMALLEST else None  # type: ignore[return-value]  # floats inside


def single_mistakes(question: Question) -> Iterator[WrongAnswer]:
    """Make every mistake that can happen here, in the order of the table."""
    scenes = MisreadScenes(question)
    for mistake in MistakeId:
        for made in MISTAKES[mistake].made_in(question):
            for way in made.ways(scenes):
                yield WrongAnswer((mistake,), way)


def pairs(question: Question) -> Iterator[WrongAnswer]:
    """Make every two mistakes that can happen at once."""
    scenes = MisreadScenes(question)
    made = {mistake: MISTAKES[mistake].made_in(question) for mistake in MistakeId}
    for first, second in combinations(MistakeId, 2):
        for one, other in product(made[first], made[second]):
            both = one + other
            if both is not None:
                for way in both.ways(scenes):
                    yield WrongAnswer((first, second), way)
