"""How an answer is computed, and where in that a mistake is made.

There are four stages: the scene is described, matrices are placed, a rule is applied, the result is
written. A mistake changes one stage; two mistakes make a pair where both can happen: at different
stages, or both in the description.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, replace

from nmatrix.enums import Space
from nmatrix.errors import NMatrixError
from nmatrix.lessons.check.question import (
    Matrices,
    Question,
    Subject,
    finished,
    raw_answer,
    right_matrices,
)
from nmatrix.linear.rational import RationalMatrix, transpose
from nmatrix.scene.setup import Setup

Describe = Callable[[Setup], Iterator[Setup]]
Place = Callable[[Question, Matrices], Matrices | None]
Rule = Callable[[Question, Matrices], RationalMatrix | None]

NO_ANSWER = (NMatrixError, ArithmeticError)  # of a mistaken scene, which is then no candidate


@dataclass(frozen=True)
class Computation:
    """The four stages of one computation, with the mistakes that happen in it."""

    describe: tuple[Describe, ...] = ()
    place: Place | None = None
    rule: Rule | None = None
    transposed: bool = False
    any_length: bool = False  # a length that should be 1 stays what it is

    def __add__(self, other: Computation) -> Computation | None:
        """Make both mistakes in one computation; None where they exclude each other."""
        if (self.place and other.place) or (self.rule and other.rule):
            return None
        return Computation(
            self.describe + other.describe,
            self.place or other.place,
            self.rule or other.rule,
            self.transposed or other.transposed,
            self.any_length or other.any_length,
        )

    def answers(self, scenes: MisreadScenes) -> Iterator[RationalMatrix]:
        """Compute the answers, one for each way to misread the scene."""
        for question, at in scenes.of(self.describe):
            try:
                found = self._answer(question, at)
            except NO_ANSWER:  # the mistaken matrices have none of their own
                continue
            if found is not None:
                yield found

    def _answer(self, question: Question, right: Matrices) -> RationalMatrix | None:
        at = self.place(question, right) if self.place else right
        if at is None:
            return None
        raw = self.rule(question, at) if self.rule else raw_answer(question, at)
        if raw is None:
            return None
        if self.transposed:
            return transpose(raw)
        return raw if self.any_length else finished(question, raw)


Slip = Callable[[Question], Computation | None]  # None where the mistake cannot happen


def misread(describe: Describe, when: Callable[[Setup], bool] | None = None) -> Slip:
    """Slip where the scene is described; with `when` only in scenes of which it holds."""
    made = Computation(describe=(describe,))
    return lambda question: made if when is None or when(question.setup) else None


def misplaced(place: Place) -> Slip:
    """Slip where matrices are placed."""
    made = Computation(place=place)
    return lambda _: made


def misruled(rule: Rule, *, any_length: bool = False) -> Slip:
    """Slip where the rule is applied."""
    made = Computation(rule=rule, any_length=any_length)
    return lambda _: made


def written_transposed(_: Question) -> Computation:
    """Slip where the result is written: rows for columns."""
    return Computation(transposed=True)


def written_unnormalised(question: Question) -> Computation | None:
    """Slip where the result is written: a unit vector was asked for."""
    return Computation(any_length=True) if question.unit else None


class MisreadScenes:
    """The misread scenes of one question and their matrices, each computed once."""

    def __init__(self, question: Question) -> None:
        self.question = question
        self._known: dict[tuple[Describe, ...], tuple[tuple[Question, Matrices], ...]] = {}

    def of(self, describe: tuple[Describe, ...]) -> tuple[tuple[Question, Matrices], ...]:
        """Make these mistakes of description; the scenes come with their right matrices."""
        if describe not in self._known:
            self._known[describe] = tuple(self._made(describe))
        return self._known[describe]

    def _made(self, describe: tuple[Describe, ...]) -> Iterator[tuple[Question, Matrices]]:
        seen = set()
        for setup in _readable(_misread(self.question.setup, describe)):
            asked = replace(self.question, setup=setup)
            what_matters = _what_matters(asked)
            if what_matters in seen:
                continue
            seen.add(what_matters)
            try:
                yield asked, right_matrices(asked)
            except NO_ANSWER:  # the mistaken scene has no such space
                continue


def _readable(setups: Iterator[Setup]) -> Iterator[Setup]:
    """Stop at a scene that floats cannot hold, such as the inverse of a tiny aspect."""
    with suppress(*NO_ANSWER):
        yield from setups


def _misread(setup: Setup, describe: tuple[Describe, ...]) -> Iterator[Setup]:
    if not describe:
        yield setup
        return
    for changed in describe[0](setup):
        yield from _misread(changed, describe[1:])


def _what_matters(question: Question) -> tuple[object, ...]:
    """Take the parts of a scene that the answer depends on."""
    setup, subject = question.setup, question.subject
    if subject is Subject.PROJECTION:
        return (setup.lens,)
    sees = subject is Subject.VIEW or question.space is Space.CAMERA
    return (
        setup.world if subject is not Subject.VIEW else None,
        setup.view if sees else None,
        setup.light if subject is Subject.LIGHT or question.space is Space.LIGHT else None,
    )
