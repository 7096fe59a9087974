"""One exercise: what the student reads, how an answer is judged, and the key, kept apart."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction
from typing import Protocol

from nmatrix.errors import IllegalValueError
from nmatrix.lessons.check.answer import Answer, read_answer
from nmatrix.lessons.check.judge import RIGHT, Judge, Judgement, Outcome
from nmatrix.lessons.check.mistakes import MistakeId
from nmatrix.lessons.check.question import Question
from nmatrix.report import Block


class Kind(StrEnum):
    """The kinds, in the order in which a sheet takes turns."""

    WORLD = "world matrix"
    NORMAL = "normal matrix"
    WHICH_SPACE = "which space"
    LIGHT = "light in camera space"
    EYE = "eye in object space"
    SHORTCUT = "is the short cut legal?"
    TRACE = "trace a vertex"
    MISTAKE = "find the mistake"
    MIRROR_SINGULAR = "mirrored and flattened"
    CONCEPT = "concept"


class Grader(Protocol):
    """What tells right from wrong."""

    def judge(self, text: str) -> Judgement:
        """Return the judgement of a typed answer."""
        ...

    def answer(self, text: str) -> Answer:
        """Return the answer as it was understood."""
        ...


@dataclass(frozen=True)
class Planned:
    """A wrong answer that is expected, as it might be typed."""

    mistake: MistakeId
    text: str


@dataclass(frozen=True)
class Exercise:
    """One exercise of one sheet.

    `cells` are the rows and columns to leave blank for the answer; `key` is the worked solution
    and `right` the right answer as one might type it.
    """

    number: int
    kind: Kind
    task: tuple[Block, ...]
    cells: tuple[int, int]
    key: tuple[Block, ...]
    right: str
    grader: Grader
    planned: tuple[Planned, ...] = ()

    @property
    def title(self) -> str:
        """Return its heading."""
        return f"{self.number}. {self.kind.value[:1].upper()}{self.kind.value[1:]}"

    def judge(self, text: str) -> Judgement:
        """Return the judgement of a typed answer.

        Raises
        ------
        IllegalValueError
            If the text is no answer to this exercise.
        """
        return self.grader.judge(text)


@dataclass(frozen=True)
class Computed:
    """An answer of numbers, judged against the scene."""

    question: Question

    def answer(self, text: str) -> Answer:
        """Return the numbers."""
        return read_answer(text, self.question)

    def judge(self, text: str) -> Judgement:
        """Return the judgement of numbers."""
        return Judge(self.question).judge(self.answer(text))


@dataclass(frozen=True)
class Listed(Computed):
    """Numbers with a list of wrong answers of their own."""

    by: Judge

    def judge(self, text: str) -> Judgement:
        """Return the judgement of numbers."""
        return self.by.judge(self.answer(text))


LETTERS = "abcdefgh"


@dataclass(frozen=True)
class Option:
    """One choice: what it says, why it is right or wrong, and the mistake that it names, if any."""

    text: str
    because: str
    mistake: MistakeId | None = None


@dataclass(frozen=True)
class Choice:
    """Several options, one of them right; answered by its letter, its words or its mistake."""

    options: tuple[Option, ...]
    right: int

    @property
    def letter(self) -> str:
        """Return the letter of the right one."""
        return LETTERS[self.right]

    def answer(self, text: str) -> Answer:
        """Return the place of the option that was chosen, counted from 1."""
        return Answer(((Fraction(self._chosen(text) + 1),),), ((None,),))

    def judge(self, text: str) -> Judgement:
        """Return the judgement of a choice."""
        chosen = self._chosen(text)
        right = ((Fraction(self.right + 1),),)
        if chosen == self.right:
            because = self.options[chosen].because
            return Judgement(Outcome.CORRECT, right, Fraction(0), explanation=f"{RIGHT} {because}")
        return Judgement(
            Outcome.UNKNOWN,
            right,
            Fraction(1),
            ((0, 0),),
            explanation=f"Not {LETTERS[chosen]}. {self.options[chosen].because}",
        )

    def _chosen(self, text: str) -> int:
        typed = " ".join(text.strip().lower().strip("()").rstrip(".):").split())
        for i, option in enumerate(self.options):
            names = {LETTERS[i], option.text.lower().rstrip(".")}
            if option.mistake is not None:
                names.add(option.mistake.value)
            if typed in names:
                return i
        letters = ", ".join(LETTERS[: len(self.options)])
        raise IllegalValueError(
            f"answer ({text.strip()[:30]})", "it is none of the choices", f"answer {letters}"
        )


def listed(options: Sequence[Option]) -> str:
    """Return options as lines with their letters."""
    return "\n".join(f"{LETTERS[i]}) {option.text}" for i, option in enumerate(options))
