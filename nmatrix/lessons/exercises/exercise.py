"""One exercise: what the student reads, how an answer is judged, and the key, kept apart."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction
from typing import Protocol

from nmatrix.errors import IllegalValueError, counted
from nmatrix.lessons.check.answer import Answer, read_answer
from nmatrix.lessons.check.judge import RIGHT, Judge, Judgement, Outcome
from nmatrix.lessons.check.mistake import MistakeId
from nmatrix.lessons.check.question import Question
from nmatrix.report import Block, Text


class ExerciseKind(StrEnum):
    """The kinds, in the order in which a sheet takes turns through them."""

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

    @classmethod
    def of(cls, number: int) -> ExerciseKind:
        """Tell the kind of an exercise from its number.

        Examples
        --------
        >>> ExerciseKind.of(12)
        <ExerciseKind.NORMAL: 'normal matrix'>
        """
        kinds = tuple(cls)
        return kinds[(number - 1) % len(kinds)]


class Grader(Protocol):
    """What tells right from wrong."""

    def judge(self, text: str) -> Judgement:
        """Judge a typed answer."""
        ...


@dataclass(frozen=True)
class ExpectedMistake:
    """A wrong answer that is expected, as it might be typed."""

    mistake: MistakeId
    text: str


@dataclass(frozen=True)
class Exercise:
    """One exercise of one sheet.

    `task` is what is asked and `form` how to write the answer on paper; `cells` are the rows and
    columns to leave blank for it. `key` is the worked solution and `right` the right answer as
    one might type it.
    """

    number: int
    task: tuple[Block, ...]
    form: str
    cells: tuple[int, int]
    key: tuple[Block, ...]
    right: str
    grader: Grader
    planned: tuple[ExpectedMistake, ...] = ()

    @property
    def kind(self) -> ExerciseKind:
        """What kind of exercise it is, by its number."""
        return ExerciseKind.of(self.number)

    @property
    def title(self) -> str:
        """The heading."""
        return f"{self.number}. {self.kind.value[:1].upper()}{self.kind.value[1:]}"

    @property
    def asked(self) -> tuple[Block, ...]:
        """All that stands on paper: the task, the choices if there are some, the form."""
        choices = self.grader.lines if isinstance(self.grader, Choice) else ()
        return (*self.task, *choices, Text(self.form))

    def judge(self, text: str) -> Judgement:
        """Judge a typed answer.

        Raises
        ------
        IllegalValueError
            If the text is no answer to this exercise.
        """
        if not isinstance(self.grader, Choice) and not any(c.isdigit() for c in text):
            rows, columns = self.cells
            size = (
                f"{counted(rows, 'row')} of {columns} numbers"
                if columns > 1
                else counted(rows, "number")
            )
            raise IllegalValueError(
                f"answer ({text.strip()[:30]})",
                f"exercise {self.number} takes {size}",
                'write them like "1 0 -2", rows apart by semicolons',
            )
        return self.grader.judge(text)


@dataclass(frozen=True)
class Computed:
    """An answer of numbers, judged against the scene."""

    by: Judge

    @property
    def question(self) -> Question:
        """The quantity that is asked for."""
        return self.by.question

    def answer(self, text: str) -> Answer:
        """Read the numbers."""
        return read_answer(text, self.question)

    def judge(self, text: str) -> Judgement:
        """Judge numbers."""
        return self.by.judge(self.answer(text))


LETTERS = "abcdefgh"


@dataclass(frozen=True)
class Option:
    """One choice: what it says, why it is right or wrong, and the mistake that it names, if any.

    `aliases` are other words for it.
    """

    text: str
    because: str
    mistake: MistakeId | None = None
    aliases: tuple[str, ...] = ()

    @property
    def names(self) -> set[str]:
        """Its names, in small letters."""
        names = {self.text.lower().rstrip("."), *self.aliases}
        if self.mistake is not None:
            names |= {self.mistake.value, self.mistake.value.replace("-", " ")}
        return names


@dataclass(frozen=True)
class Choice:
    """Several options, one of them right; answered by its letter, its words or its mistake."""

    options: tuple[Option, ...]
    right: int

    @property
    def letter(self) -> str:
        """The letter of the right one."""
        return LETTERS[self.right]

    @property
    def lines(self) -> tuple[Text, ...]:
        """The options as they stand on paper."""
        return tuple(Text(f"{LETTERS[i]}) {one.text}") for i, one in enumerate(self.options))

    def judge(self, text: str) -> Judgement:
        """Judge a choice."""
        chosen = self._chosen(text)
        right = ((Fraction(self.right + 1),),)
        if chosen == self.right:
            because = self.options[chosen].because
            return Judgement(Outcome.CORRECT, right, Fraction(0), explanation=f"{RIGHT} {because}")
        is_there = chosen < len(self.options)
        because = self.options[chosen].because if is_there else f"The choices are {self._letters}."
        told = f"Not {LETTERS[chosen]}. {because}"
        return Judgement(Outcome.UNKNOWN, right, Fraction(1), ((0, 0),), explanation=told)

    @property
    def _letters(self) -> str:
        return ", ".join(LETTERS[: len(self.options)])

    def _chosen(self, text: str) -> int:
        """Find the one option that is meant: by letter, by name, by its beginning.

        A letter after the last one is an answer too, and a wrong one.

        Raises
        ------
        IllegalValueError
            If no option is meant, or several.
        """
        typed = " ".join(text.strip().lower().split()).rstrip(".")
        letter = typed.strip("(").partition(")")[0].rstrip(".:")
        by_name = [i for i, one in enumerate(self.options) if typed in one.names]
        begun = [i for i, one in enumerate(self.options) if _begins(one, typed)]
        if len(letter) == 1 and letter in LETTERS:
            return LETTERS.index(letter)
        for found in (by_name, begun):
            if len(found) == 1:
                return found[0]
        raise IllegalValueError(
            f"answer ({text.strip()[:30]})",
            "it is none of the choices",
            f"answer {self._letters}",
        )


def _begins(option: Option, typed: str) -> bool:
    """Compare the beginning of an option with these whole words."""
    words, first = typed.rstrip(",:").split(), option.text.lower().split()
    return bool(words) and [word.rstrip(",:") for word in first[: len(words)]] == words
