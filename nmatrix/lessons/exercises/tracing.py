"""The exercise of one vertex on its way to normalised device coordinates."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property

from nmatrix.lessons.check.hints import Hint
from nmatrix.lessons.check.judge import Judge, Judgement, Outcome
from nmatrix.lessons.check.mistakes import MISTAKES, MistakeId
from nmatrix.lessons.check.question import Question, Subject
from nmatrix.lessons.check.wrong import WrongAnswer
from nmatrix.lessons.exercises.exercise import Computed, Exercise, ExpectedMistake
from nmatrix.lessons.exercises.matrices import SHORT_MOVES
from nmatrix.lessons.exercises.scheme import Draws
from nmatrix.lessons.notation import column, formula, in_parentheses, typed, written
from nmatrix.linear.rational import ONE, RationalMatrix, RationalVector, apply
from nmatrix.report import Block, Text
from nmatrix.scene.camera import View
from nmatrix.scene.lens import Lens
from nmatrix.scene.setup import Setup
from nmatrix.scene.world import World
from nmatrix.working.products import product
from nmatrix.working.vectors import project
from nmatrix.working.working import formulas

UNDIVIDED = "These are clip coordinates: divide x, y and z by the fourth number, w."
PLANNED = (MistakeId.ASPECT_INVERTED, MistakeId.HORIZONTAL_FOV)


def trace(draws: Draws) -> Exercise | None:
    """Ask for the normalised device coordinates of a vertex."""
    scale, further = Fraction(draws.choice((1, 2))), draws.randbelow(4)
    point = tuple(draws.choice(SHORT_MOVES) for _ in range(3))
    move = tuple(draws.choice(SHORT_MOVES) for _ in range(2))
    world = World(translate=(*move, 0), scale=(scale, scale, scale))
    lens = Lens(90.0, 2.0, 1.0, float(draws.choice((9, 17))))
    setup = Setup(world, View(eye=(0, 0, 5 + further)), lens)
    right = _ndc(setup, point)
    wrong = [
        WrongAnswer((mistake,), (_ndc(one, point),))
        for mistake in PLANNED
        for one in _misread(mistake, setup)
    ]
    if any(abs(x) > 1 for x in right[:3]):
        return None  # the vertex should be seen
    if len({right, *(one.value[0] for one in wrong)}) <= len(wrong):
        return None
    undivided = Hint((_clip(setup, point),), UNDIVIDED)
    judge = _TraceJudge(Question(Subject.EYE, setup), right, tuple(wrong), undivided)
    return Exercise(
        draws.number,
        _task(setup, point),
        (3, 1),
        _key(setup, point, right),
        typed((right[:3],)),
        _Divided(judge),
        tuple(ExpectedMistake(one.mistakes[0], typed((one.value[0][:3],))) for one in wrong),
    )


@dataclass(frozen=True)
class _TraceJudge(Judge):
    """A judge of a traced vertex, which is no answer to a question of `check`."""

    ndc: RationalVector
    mistaken: tuple[WrongAnswer, ...]
    undivided: Hint

    @cached_property
    def right(self) -> RationalMatrix:
        """The vertex in normalised device coordinates, with w = 1."""
        return (self.ndc,)

    @cached_property
    def singles(self) -> tuple[WrongAnswer, ...]:
        """The vertex seen through mistaken lenses."""
        return self.mistaken

    @cached_property
    def doubles(self) -> tuple[WrongAnswer, ...]:
        """No pairs: the numbers are chosen so that each mistake shows by itself."""
        return ()

    @cached_property
    def hints(self) -> tuple[Hint, ...]:
        """The clip coordinates, where the division was forgotten."""
        return (self.undivided,)


@dataclass(frozen=True)
class _Divided(Computed):
    """Numbers that must have been divided by w: of four, the last one is 1."""

    def judge(self, text: str) -> Judgement:
        """Judge numbers."""
        answer = self.answer(text)
        found = self.by.judge(answer)
        w = answer.rows[0][3:] or (ONE,)
        if found.verdict is not Outcome.CORRECT or w == (ONE,):
            return found
        return replace(
            found,
            verdict=Outcome.UNKNOWN,
            max_difference=abs(w[0] - ONE),
            wrong_entries=((0, 3),),
            explanation=UNDIVIDED,
        )


def _clip(setup: Setup, point: RationalVector) -> RationalVector:
    return apply(setup.maps.clip_from_object, (*point, ONE))


def _ndc(setup: Setup, point: RationalVector) -> RationalVector:
    clip = _clip(setup, point)
    return (*(x / clip[3] for x in clip[:3]), ONE)


def _misread(mistake: MistakeId, setup: Setup) -> Iterator[Setup]:
    made = MISTAKES[mistake].made_in(Question(Subject.PROJECTION, setup))
    assert made is not None  # the lens of this exercise has an angle
    for describe in made.describe:
        yield from describe(setup)


def _task(setup: Setup, point: RationalVector) -> tuple[Text, ...]:
    world, lens = setup.world, setup.lens
    return (
        Text(
            f"An object is scaled by {written(Fraction(world.scale[0]))} and moved by "
            f"{in_parentheses(world.translate)}. "
            f"The camera stands at (0, 0, {setup.view.eye[2]}), looks at the origin, and y is up; "
            f"a vertical field of view of 90°, width over height 2, near 1, far {lens.far:g}, "
            "depth from −1 to 1. Where is the vertex "
            f"{in_parentheses(point)} in normalised device coordinates?"
        ),
        Text("Three numbers."),
    )


def _key(setup: Setup, point: RationalVector, right: RationalVector) -> tuple[Block, ...]:
    maps = setup.maps
    world = product(maps.world_from_object.exact, (*point, ONE), ("M", "p"))
    camera = product(maps.camera_from_world.exact, world.value, ("V", "(M p)"))
    return (
        *formulas(world),
        *formulas(camera),
        *formulas(project(maps.clip_from_camera, camera.value, ("P", "(V M p)"))),
        formula("answer = ", column(right[:3])),
    )
