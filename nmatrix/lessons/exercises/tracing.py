"""The exercise of one vertex on its way to normalised device coordinates."""

from __future__ import annotations

from fractions import Fraction

from nmatrix.lessons.check.judge import Judge
from nmatrix.lessons.check.mistake import MistakeId
from nmatrix.lessons.check.question import Question, Subject
from nmatrix.lessons.exercises.exercise import Computed, Exercise, ExpectedMistake
from nmatrix.lessons.exercises.matrices import SHORT_MOVES, THREE
from nmatrix.lessons.exercises.scheme import Draws
from nmatrix.lessons.notation import column, formula, in_parentheses, typed, written
from nmatrix.linear.rational import ONE, RationalVector
from nmatrix.report import Block, Text
from nmatrix.scene.camera import View
from nmatrix.scene.lens import Lens
from nmatrix.scene.setup import Setup
from nmatrix.scene.world import World
from nmatrix.working.products import product
from nmatrix.working.vectors import project
from nmatrix.working.working import formulas

PLANNED = (MistakeId.ASPECT_INVERTED, MistakeId.HORIZONTAL_FOV)


def trace(draws: Draws) -> Exercise | None:
    """Ask for the normalised device coordinates of a vertex."""
    scale, further = Fraction(draws.choice((1, 2))), draws.randbelow(4)
    point = tuple(draws.choice(SHORT_MOVES) for _ in range(3))
    move = tuple(draws.choice(SHORT_MOVES) for _ in range(2))
    world = World(translate=(*move, 0), scale=(scale, scale, scale))
    lens = Lens(90.0, 2.0, 1.0, float(draws.choice((9, 17))))
    setup = Setup(world, View(eye=(0, 0, 5 + further)), lens)
    judge = Judge(Question(Subject.TRACE, setup, point=point))
    right = judge.right[0]
    if any(abs(x) > 1 for x in right[:3]):
        return None  # the vertex should be seen
    wrong = {one: made[0][0] for one in PLANNED if (made := judge.wrong_by(one))}
    if len(set(wrong.values())) < len(PLANNED):
        return None
    return Exercise(
        draws.number,
        (_task(setup, point),),
        THREE,
        (3, 1),
        _key(setup, point, right),
        typed((right[:3],)),
        Computed(judge),
        tuple(ExpectedMistake(one, typed((value[:3],))) for one, value in wrong.items()),
    )


def _task(setup: Setup, point: RationalVector) -> Text:
    world, lens = setup.world, setup.lens
    return Text(
        f"An object is scaled by {written(Fraction(world.scale[0]))} and moved by "
        f"{in_parentheses(world.translate)}. "
        f"The camera stands at (0, 0, {setup.view.eye[2]}), looks at the origin, and y is up; "
        f"a vertical field of view of 90°, width over height 2, near 1, far {lens.far:g}, "
        "depth from −1 to 1. Where is the vertex "
        f"{in_parentheses(point)} in normalised device coordinates?"
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
