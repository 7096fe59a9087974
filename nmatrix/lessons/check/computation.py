"""How an answer is computed, and where in that a mistake is made.

There are four stages: the scene is described, matrices are placed, a rule is applied, the result is
written. A mistake changes one stage; two mistakes make a pair where both can happen: at different
stages, both in the description, or in different entries of a matrix.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from enum import Enum
from functools import cache, cached_property
from itertools import product, zip_longest
from typing import Any, TypeVar

from nmatrix.errors import NMatrixError
from nmatrix.lessons.check.question import (
    Matrices,
    Question,
    finished,
    float_matrices,
    is_of_usual_size,
    raw_answer,
    right_matrices,
)
from nmatrix.linear.rational import RationalMatrix, transpose
from nmatrix.linear.values import with_fields
from nmatrix.scene.camera import View
from nmatrix.scene.lens import Lens
from nmatrix.scene.setup import Light
from nmatrix.scene.world import World

Place = Callable[[Question, Matrices], Matrices | None]
Parts = Mapping[str, Any]  # of a setup, by their names
Part = TypeVar("Part")
Made = TypeVar("Made")
Rule = Callable[[Question, Matrices], RationalMatrix | None]

NO_ANSWER = (NMatrixError, ArithmeticError)  # of a mistaken scene, which is then no candidate


class Remembered:
    """What functions gave for parts of scenes: two mistakes at once leave most parts as they are.

    A part is known by its identity, which is cheaper to compare than all of its numbers.
    """

    def __init__(self) -> None:
        self._known: dict[tuple[Callable[[Any], Any], int], tuple[object, Any]] = {}

    def __call__(self, function: Callable[[Part], Made], part: Part) -> Made:
        """Call a function with a part, unless that was done before."""
        key = (function, id(part))
        if key not in self._known:
            self._known[key] = (part, function(part))  # the part is kept, and so is its identity
        made: Made = self._known[key][1]
        return made


@dataclass(frozen=True, eq=False)
class Misreading:
    """One way to misread each part of a scene; each function lists what the part becomes.

    Only one part at a time is misread, and where `together` is set all of them at once as well.
    """

    world: Callable[[World], Iterator[World]] | None = None
    view: Callable[[View], Iterator[View]] | None = None
    lens: Callable[[Lens], Iterator[Lens]] | None = None
    light: Callable[[Light], Iterator[Light]] | None = None
    together: bool = False

    def of(self, parts: Parts, remembered: Remembered) -> Iterator[Parts]:
        """Misread those parts of a scene that an answer depends on."""
        changed: dict[str, tuple[Any, ...]] = {}
        for name, part in parts.items():
            misread = getattr(self, name)
            changed[name] = () if misread is None else remembered(_lister(misread), part)
        for name, variants in changed.items():
            for one in variants:
                yield {**parts, name: one}
        if self.together and sum(map(bool, changed.values())) > 1:
            for ones in zip_longest(*changed.values()):
                read = zip(changed, ones, strict=True)
                yield {**parts, **{name: one for name, one in read if one is not None}}


@cache
def _lister(misread: Callable[[Any], Iterator[Any]]) -> Callable[[Any], tuple[Any, ...]]:
    """Make a function that lists what a part becomes, each thing once, if it is no longer the part.

    The list ends at what floats cannot hold, such as the inverse of a tiny aspect.
    """

    def listed(part: object) -> tuple[Any, ...]:
        found: list[Any] = []
        with suppress(*NO_ANSWER):
            for one in misread(part):
                if one != part and one not in found:
                    found.append(one)
        return tuple(found)

    return listed


class Entries(Enum):
    """The entries of a matrix that a mistake changes; of two in one matrix each has its own."""

    ALL = "all"
    BLOCK = "3×3 block"
    TRANSLATION = "translation"
    ROW_Y = "second row"
    ROW_Z = "third row"
    ROW_W = "fourth row"


@dataclass(frozen=True, eq=False)
class Computation:
    """The four stages of one computation, with the mistakes that happen in it.

    `places` and `rules` list for each mistake its variants: a forgotten sign may be this or that.
    """

    misreadings: tuple[Misreading, ...] = ()
    places: tuple[tuple[Entries, tuple[Place, ...]], ...] = ()
    rules: tuple[Rule, ...] = ()
    transposed: bool = False
    any_length: bool = False  # a length that should be 1 stays what it is

    def __add__(self, other: Computation) -> Computation | None:
        """Make both mistakes in one computation; None where they exclude each other."""
        changed = [entries for entries, _ in (*self.places, *other.places)]
        if len(changed) > 1 and (Entries.ALL in changed or len(set(changed)) < len(changed)):
            return None
        if self.rules and other.rules:
            return None
        return Computation(
            self.misreadings + other.misreadings,
            self.places + other.places,
            self.rules or other.rules,
            self.transposed or other.transposed,
            self.any_length or other.any_length,
        )

    def ways(self, scenes: MisreadScenes) -> Iterator[Way]:
        """List the ways to compute so, one for each variant."""
        rules = self.rules or (None,)
        for scene in scenes.of(self.misreadings):
            for places in product(*(variants for _, variants in self.places)):
                for rule in rules:
                    yield Way(scene, places, rule, self.transposed, self.any_length)


@dataclass(frozen=True, eq=False)
class Way:
    """One computation with its mistakes, in exact numbers or in floats for a first look."""

    scene: MisreadScene
    places: tuple[Place, ...]
    rule: Rule | None
    transposed: bool
    any_length: bool

    @cached_property
    def value(self) -> RationalMatrix | None:
        """The answer; None where the mistaken scene or its matrices have none."""
        try:
            return self._answer(self.scene.matrices)
        except NO_ANSWER:
            return None

    def floats(self) -> RationalMatrix | None:
        """Compute the answer in floats; None where the mistake cannot happen.

        Raises
        ------
        ArithmeticError, NMatrixError
            Where floats do not tell.
        """
        return self._answer(self.scene.floats)

    def _answer(self, at: Matrices) -> RationalMatrix | None:
        question = self.scene.question
        for place in self.places:
            placed = place(question, at)
            if placed is None:
                return None
            at = placed
        raw = self.rule(question, at) if self.rule else raw_answer(question, at)
        if raw is None:
            return None
        if self.transposed:
            return transpose(raw)
        return raw if self.any_length else finished(question, raw)


Slip = Callable[[Question], tuple[Computation, ...]]  # none where the mistake cannot happen


def misread(
    world: Callable[[World], Iterator[World]] | None = None,
    view: Callable[[View], Iterator[View]] | None = None,
    lens: Callable[[Lens], Iterator[Lens]] | None = None,
    light: Callable[[Light], Iterator[Light]] | None = None,
    *,
    together: bool = False,
) -> Slip:
    """Slip where the scene is described."""
    made = (Computation(misreadings=(Misreading(world, view, lens, light, together),)),)
    return lambda _: made


def misplaced(*variants: Place, entries: Entries = Entries.ALL) -> Slip:
    """Slip where matrices are placed."""
    made = (Computation(places=((entries, variants),)),)
    return lambda _: made


def misruled(*variants: Rule, any_length: bool = False) -> Slip:
    """Slip where the rule is applied."""
    made = (Computation(rules=variants, any_length=any_length),)
    return lambda _: made


def either(*slips: Slip) -> Slip:
    """Slip in one of several ways."""
    return lambda question: tuple(made for slip in slips for made in slip(question))


def when(holds: Callable[[Question], bool], slip: Slip) -> Slip:
    """Slip only in questions of which this holds."""
    return lambda question: slip(question) if holds(question) else ()


def written_transposed(_: Question) -> tuple[Computation, ...]:
    """Slip where the result is written: rows for columns."""
    return (Computation(transposed=True),)


def written_unnormalised(question: Question) -> tuple[Computation, ...]:
    """Slip where the result is written: a unit vector was asked for."""
    return (Computation(any_length=True),) if question.unit else ()


@dataclass(frozen=True, eq=False)
class MisreadScene:
    """A misread scene, with the matrices that are right in it."""

    asked: Question
    parts: Parts
    has_floats: bool
    remembered: Remembered

    @cached_property
    def question(self) -> Question:
        """What is asked, of the misread scene."""
        return with_fields(self.asked, setup=with_fields(self.asked.setup, **self.parts))

    @cached_property
    def matrices(self) -> Matrices:
        """The matrices, exactly."""
        return right_matrices(self.question)

    @cached_property
    def floats(self) -> Matrices:
        """The matrices in floats.

        Raises
        ------
        ArithmeticError, NMatrixError
            Where floats do not tell.
        """
        if not self.has_floats:
            raise ArithmeticError("a scene that is too large or too flat")
        return float_matrices(self.question, self.remembered)


class MisreadScenes:
    """The misread scenes of one question, each made once."""

    def __init__(self, question: Question) -> None:
        self.question = question
        self._has_floats = is_of_usual_size(question)
        parts = {part: getattr(question.setup, part) for part in question.parts}
        self._remembered = Remembered()
        self._known: dict[tuple[Misreading, ...], tuple[MisreadScene, ...]] = {
            (): (MisreadScene(question, parts, self._has_floats, self._remembered),)
        }

    def of(self, misreadings: tuple[Misreading, ...]) -> tuple[MisreadScene, ...]:
        """Misread the scene in these ways, one after the other."""
        if misreadings not in self._known:
            self._known[misreadings] = tuple(self._made(misreadings))
        return self._known[misreadings]

    def _made(self, misreadings: tuple[Misreading, ...]) -> Iterator[MisreadScene]:
        *before, last = misreadings
        for scene in self.of(tuple(before)):
            for parts in last.of(scene.parts, self._remembered):
                yield MisreadScene(self.question, parts, self._has_floats, self._remembered)
