"""Every wrong answer that a known mistake, or two of them, give to a question.

An answer is computed in four stages: the scene is described, matrices are placed, a rule is
applied, the result is written. A mistake changes one stage; two mistakes make a pair where both
can happen: at different stages, or both in the description.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import combinations

from nmatrix.enums import Space
from nmatrix.errors import NMatrixError
from nmatrix.lessons.check.mistakes import MistakeId
from nmatrix.lessons.check.question import (
    Question,
    Setting,
    Subject,
    finished,
    raw_answer,
    setting,
)
from nmatrix.lessons.check.slips import angles, camera, lens, places, rules
from nmatrix.linear.rational import RationalMatrix, Rows, to_floats, transpose
from nmatrix.scene.setup import Setup

Describe = Callable[[Setup], Iterator[Setup]]
Place = Callable[[Question, Setting], Setting | None]
Rule = Callable[[Question, Setting], RationalMatrix | None]

OF_THE_SCENE: dict[MistakeId, Describe] = {
    MistakeId.DEGREES_AS_RADIANS: angles.degrees_as_radians,
    MistakeId.ROTATION_ORDER: angles.rotation_order,
    MistakeId.ROTATION_SIGN: angles.rotation_sign,
    MistakeId.POLIMI_ANGLES_SWAPPED: angles.polimi_angles_swapped,
    MistakeId.WRONG_HANDEDNESS: camera.wrong_handedness,
}
OF_THE_LENS: dict[MistakeId, Describe] = {
    MistakeId.DEGREES_AS_RADIANS: lens.degrees_as_radians,
    MistakeId.WRONG_HANDEDNESS: lens.wrong_handedness,
    MistakeId.DEPTH_RANGE: lens.depth_range,
    MistakeId.ASPECT_INVERTED: lens.aspect_inverted,
    MistakeId.HORIZONTAL_FOV: lens.horizontal_fov,
    MistakeId.NEAR_FAR_SWAPPED: lens.near_far_swapped,
}
NEEDS_AN_ANGLE = {
    MistakeId.DEGREES_AS_RADIANS,
    MistakeId.ASPECT_INVERTED,
    MistakeId.HORIZONTAL_FOV,
}
PLACES: dict[MistakeId, Place] = {
    MistakeId.USED_WORLD_MATRIX: places.used_world_matrix,
    MistakeId.TRANSPOSED_LAYOUT: places.transposed_layout,
    MistakeId.USED_MODEL_VIEW: places.used_model_view,
    MistakeId.SCALE_BEFORE_TRANSLATE: places.scale_before_translate,
    MistakeId.VIEW_NOT_INVERTED: places.view_not_inverted,
}
RULES: dict[Subject, dict[MistakeId, Rule]] = {
    **{subject: {} for subject in Subject},
    Subject.NORMAL: {
        mistake: partial(rules.by_normal_rule, mistake) for mistake in rules.NORMAL_RULES
    },
    Subject.LIGHT: {
        MistakeId.COURSE_LIGHT_RULE: rules.course_light_rule,
        MistakeId.DIRECTION_AS_POINT: rules.direction_as_point,
    },
}
NO_ANSWER = (NMatrixError, ArithmeticError)  # of a mistaken scene, which is then no candidate
MATRICES = (Subject.WORLD, Subject.VIEW, Subject.PROJECTION)


@dataclass(frozen=True)
class WrongAnswer:
    """What one mistake, or two of them, give."""

    mistakes: tuple[MistakeId, ...]
    value: RationalMatrix

    @cached_property
    def floats(self) -> Rows | None:
        """Return the value in float64, for a first look; None where it is beyond."""
        try:
            return to_floats(self.value)
        except NMatrixError:
            return None


@dataclass(frozen=True)
class Flow:
    """The four stages of one computation, with the mistakes that happen in it."""

    describe: tuple[Describe, ...] = ()
    place: tuple[Place, ...] = ()
    rule: tuple[Rule, ...] = ()
    transposed: bool = False
    any_length: bool = False  # a length that should be 1 stays what it is

    def __add__(self, other: Flow) -> Flow | None:
        """Return both mistakes in one computation, or None where they exclude each other."""
        if (self.place and other.place) or (self.rule and other.rule):
            return None
        return Flow(
            self.describe + other.describe,
            self.place + other.place,
            self.rule + other.rule,
            self.transposed or other.transposed,
            self.any_length or other.any_length,
        )

    def answers(self, drafts: Drafts) -> Iterator[RationalMatrix]:
        """Give what this computation answers; a scene may be misread in several ways."""
        for question, at in drafts.of(self.describe):
            try:
                found = self._answer(question, at)
            except NO_ANSWER:  # the mistaken matrices have none of their own
                continue
            if found is not None:
                yield found

    def _answer(self, question: Question, at: Setting | None) -> RationalMatrix | None:
        for place in self.place:
            at = None if at is None else place(question, at)
        if at is None:
            return None
        raw = self.rule[0](question, at) if self.rule else raw_answer(question, at)
        if raw is None:
            return None
        if self.transposed:
            return transpose(raw)
        return raw if self.any_length else finished(question, raw)


class Drafts:
    """The misread scenes of one question and their matrices, each computed once."""

    def __init__(self, question: Question) -> None:
        self.question = question
        self._known: dict[tuple[Describe, ...], tuple[tuple[Question, Setting], ...]] = {}

    def of(self, describe: tuple[Describe, ...]) -> tuple[tuple[Question, Setting], ...]:
        """Return the scenes that these mistakes make, with their right matrices."""
        if describe not in self._known:
            self._known[describe] = tuple(self._made(describe))
        return self._known[describe]

    def _made(self, describe: tuple[Describe, ...]) -> Iterator[tuple[Question, Setting]]:
        seen = set()
        for setup in _readable(_misread(self.question.setup, describe)):
            asked = replace(self.question, setup=setup)
            what_matters = _what_matters(asked)
            if what_matters in seen:
                continue
            seen.add(what_matters)
            try:
                yield asked, setting(asked)
            except NO_ANSWER:  # the mistaken scene has no such space
                continue


def _readable(setups: Iterator[Setup]) -> Iterator[Setup]:
    """Give scenes up to one that floats cannot hold, such as the inverse of a tiny aspect."""
    with suppress(*NO_ANSWER):
        yield from setups


def _misread(setup: Setup, describe: tuple[Describe, ...]) -> Iterator[Setup]:
    if not describe:
        yield setup
        return
    for changed in describe[0](setup):
        yield from _misread(changed, describe[1:])


def _what_matters(question: Question) -> tuple[object, ...]:
    """Return the parts of a scene that the answer depends on."""
    setup, subject = question.setup, question.subject
    if subject is Subject.PROJECTION:
        return (setup.lens,)
    sees = subject is Subject.VIEW or question.space is Space.CAMERA
    return (
        setup.world if subject is not Subject.VIEW else None,
        setup.view if sees else None,
        setup.light if subject is Subject.LIGHT or question.space is Space.LIGHT else None,
    )


def flow(mistake: MistakeId, question: Question) -> Flow | None:
    """Return the computation of a question with one mistake, or None where it cannot happen."""
    subject = question.subject
    if mistake is MistakeId.MISSING_NORMALISE:
        return Flow(any_length=True) if question.unit else None
    if mistake is MistakeId.TRANSPOSED_LAYOUT and subject in MATRICES:
        return Flow(transposed=True)
    if subject is Subject.PROJECTION:
        return _projection_flow(mistake, question)
    if mistake in OF_THE_SCENE:
        return Flow(describe=(OF_THE_SCENE[mistake],))
    if mistake in RULES[subject]:
        keeps_length = mistake is MistakeId.FOUR_COMPONENT_NORMALISE
        return Flow(rule=(RULES[subject][mistake],), any_length=keeps_length)
    return Flow(place=(PLACES[mistake],)) if mistake in PLACES else None


def _projection_flow(mistake: MistakeId, question: Question) -> Flow | None:
    if mistake not in OF_THE_LENS or question.setup.lens.matrix is not None:
        return None
    if mistake in NEEDS_AN_ANGLE and not lens.by_angle(question.setup.lens):
        return None
    if mistake is MistakeId.NEAR_FAR_SWAPPED and question.setup.lens.frustum is not None:
        return Flow(describe=(lens.near_far_swapped_in_frustum,))
    return Flow(describe=(OF_THE_LENS[mistake],))


def single_mistakes(question: Question) -> Iterator[WrongAnswer]:
    """Give what every mistake that can happen here makes of the question, in table order."""
    drafts = Drafts(question)
    for mistake in MistakeId:
        found = flow(mistake, question)
        if found is not None:
            for value in found.answers(drafts):
                yield WrongAnswer((mistake,), value)


def pairs(question: Question) -> Iterator[WrongAnswer]:
    """Give what two mistakes at once make of the question."""
    drafts = Drafts(question)
    flows = {mistake: flow(mistake, question) for mistake in MistakeId}
    for first, second in combinations(MistakeId, 2):
        one, other = flows[first], flows[second]
        both = None if one is None or other is None else one + other
        if both is not None:
            for value in both.answers(drafts):
                yield WrongAnswer((first, second), value)
