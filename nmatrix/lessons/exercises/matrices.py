"""Exercises whose answer is a matrix or a vector of a scene, judged by the check engine."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

from nmatrix.enums import Space
from nmatrix.lessons.check.judge import Judge
from nmatrix.lessons.check.mistake import MistakeId
from nmatrix.lessons.check.question import LightPart, Question, Subject
from nmatrix.lessons.exercises.exercise import Computed, Exercise, ExpectedMistake
from nmatrix.lessons.exercises.scheme import Draws
from nmatrix.lessons.notation import column, formula, in_parentheses, typed, written
from nmatrix.linear.rational import (
    ONE,
    RationalMatrix,
    linear_part,
    translation,
)
from nmatrix.report import Block, Text
from nmatrix.scene.camera import View
from nmatrix.scene.setup import Light, Setup
from nmatrix.scene.world import World
from nmatrix.working.determinants import cofactors
from nmatrix.working.elimination import solve
from nmatrix.working.inverses import inverse_transpose
from nmatrix.working.products import difference, product
from nmatrix.working.working import formulas
from nmatrix.working.world import world_matrix as working_of

Vector = tuple[Fraction, ...]
Build = Callable[[Draws], Exercise | None]

SCALES = tuple(Fraction(x) for x in ("1/4", "1/2", "1", "2", "4"))
MOVES = tuple(Fraction(x) for x in (-3, -2, -1, 1, 2, 3))
SHORT_MOVES = MOVES[1:5]
QUARTERS = (90, -90)
AXES = "xyz"
THREE = "Three numbers."
CONVENTION = "Column vectors; M = T · R · S; angles by the right-hand rule."


def world_matrix(draws: Draws) -> Exercise | None:
    """Ask for a world matrix made of a translation, a quarter turn and a scale."""
    world, told = _placed(draws)
    question = Question(Subject.WORLD, Setup(world))
    task = (Text(f"An object {told}. Write its world matrix M. {CONVENTION}"),)
    planned = (
        MistakeId.ROTATION_SIGN,
        MistakeId.SCALE_BEFORE_TRANSLATE,
        MistakeId.TRANSPOSED_LAYOUT,
    )
    asked = _Asked(task, "Four rows of four numbers.")
    return _computed(draws, question, asked, planned, formulas(working_of(world)))


def normal_matrix(draws: Draws) -> Exercise | None:
    """Ask for the normal matrix of a scale and a shear."""
    scale = draws.several(SCALES, 3)
    shear = [Fraction(0)] * 3
    shear[draws.randbelow(3)] = draws.choice(SHORT_MOVES)
    world = World(scale=scale, shear=tuple(shear))
    question = Question(Subject.NORMAL, Setup(world))
    A = linear_part(world.world_from_object)
    task = (
        formula("A = ", A),
        Text("is the 3×3 block of a world matrix. By which matrix are its normals multiplied?"),
    )
    form = "Three rows of three numbers; any positive multiple counts."
    planned = (
        MistakeId.NOT_TRANSPOSED,
        MistakeId.NOT_INVERTED,
        MistakeId.USED_WORLD_MATRIX,
    )
    return _computed(draws, question, _Asked(task, form), planned, formulas(inverse_transpose(A)))


def light_in_camera(draws: Draws) -> Exercise | None:
    """Ask for a light's position in camera space, beside an object that must not matter."""
    world, told = _placed(draws)
    axis, side = draws.randbelow(2), draws.choice((-1, 1))
    eye = [Fraction(0)] * 3
    eye[(0, 2)[axis]] = side * Fraction(3 + draws.randbelow(4))
    light = tuple(draws.choice(MOVES) for _ in range(3))
    setup = Setup(world, View(eye=tuple(eye)), light=Light(position=light))
    question = Question(Subject.LIGHT, setup, Space.CAMERA, light=LightPart.POSITION)
    task = (
        Text(
            f"The camera stands at {in_parentheses(eye)}, looks at the origin, and y is up. A "
            f"lamp hangs in the world at {in_parentheses(light)}. An object {told}. "
            "The camera looks down −z. Where is the lamp in camera space?"
        ),
    )
    steps: tuple[Block, ...] = (
        Text("The lamp is fixed in the world, so V alone moves it; M has no part in it."),
        *formulas(product(setup.camera.camera_from_world, (*light, ONE), ("V", "l"))),
    )
    planned = (MistakeId.USED_MODEL_VIEW, MistakeId.VIEW_NOT_INVERTED, MistakeId.USED_WORLD_MATRIX)
    return _computed(draws, question, _Asked(task, THREE), planned, steps)


def eye_in_object(draws: Draws) -> Exercise | None:
    """Ask for the eye in object space."""
    world, told = _placed(draws)
    eye = tuple(draws.choice(MOVES) * 2 for _ in range(3))
    setup = Setup(world, View(eye=eye))
    question = Question(Subject.EYE, setup, Space.OBJECT)
    task = (
        Text(
            f"An object {told}, and the eye is at {in_parentheses(eye)} in the world. Where is "
            f"the eye in object space? {CONVENTION}"
        ),
    )
    M = world.world_from_object
    away = difference(eye, translation(M), ("e", "t"), "d")
    steps: tuple[Block, ...] = (
        Text("Subtract first, then undo the 3×3 block: A x = d, where d = e − t."),
        *formulas(away),
        *formulas(solve(linear_part(M), away.value, ("A", "d", "x"))),
    )
    planned = (MistakeId.USED_WORLD_MATRIX, MistakeId.SCALE_BEFORE_TRANSLATE)
    return _computed(draws, question, _Asked(task, THREE), planned, steps)


def mirrored(draws: Draws) -> Exercise | None:
    """Ask for an outward normal through a turned mirror, or through a flattening."""
    scale = list(draws.several(SCALES[1:4], 3))
    place = draws.randbelow(3)
    is_flat = draws.randbelow(2) == 1
    scale[place] = Fraction(0) if is_flat else -scale[place]
    n = [draws.choice(MOVES) for _ in range(3)]
    world = World(rotate_degrees=_quarter_turn(draws), scale=tuple(scale))
    question = Question(Subject.NORMAL, Setup(world), normal=tuple(n))
    A = linear_part(world.world_from_object)
    task = (
        formula("A = ", A, ", n = ", column([Fraction(x) for x in n])),
        Text(
            "A is the 3×3 block of a world matrix, n the outward normal of a surface. In which "
            "direction does the normal point after the map?"
        ),
    )
    form = "Three numbers; any positive multiple counts, and where A flattens, either sign."
    if is_flat:
        told = "det A = 0: no inverse is left, and C n is the plane's normal. Both signs are right."
        planned: tuple[MistakeId, ...] = ()
    else:
        told = (
            "det A < 0: the outward normal is −C n, a positive multiple of the inverse transpose's."
        )
        planned = (MistakeId.COFACTOR_SIGN, MistakeId.USED_WORLD_MATRIX)
    steps: tuple[Block, ...] = (*formulas(cofactors(A, shown=False)), Text(told))
    return _computed(draws, question, _Asked(task, form), planned, steps)


@dataclass(frozen=True)
class _Asked:
    """What is asked, and how the answer is written on paper."""

    task: tuple[Block, ...]
    form: str


def _placed(draws: Draws) -> tuple[World, str]:
    """Draw a world of three parts, with the sentence that describes it."""
    move = tuple(draws.choice(MOVES) for _ in range(3))
    angles = _quarter_turn(draws)
    scale = draws.several(SCALES, 3)
    turn, axis = next((angle, axis) for angle, axis in zip(angles, AXES, strict=True) if angle)
    told = (
        f"is scaled by {in_parentheses(scale)}, then turned by {written(turn)}° about {axis}, "
        f"then moved by {in_parentheses(move)}"
    )
    return World(translate=move, rotate_degrees=angles, scale=scale), told


def _quarter_turn(draws: Draws) -> Vector:
    """Draw angles about x, y and z in degrees, one of them a quarter turn."""
    axis, turn = draws.randbelow(3), draws.choice(QUARTERS)
    return tuple(Fraction(turn) if i == axis else Fraction(0) for i in range(3))


def _computed(
    draws: Draws,
    question: Question,
    asked: _Asked,
    planned: tuple[MistakeId, ...],
    steps: tuple[Block, ...],
) -> Exercise | None:
    """Make the exercise; None where a planned mistake would not show in these numbers."""
    judge = Judge(question)
    wrong = _shown_mistakes(judge, planned)
    if wrong is None:
        return None
    right = _asked_for(judge, judge.right)
    shown = column(right[0]) if question.is_vector else right
    return Exercise(
        draws.number,
        asked.task,
        asked.form,
        (len(shown), len(shown[0])),
        (*steps, formula("answer = ", shown)),
        typed(right),
        Computed(judge),
        wrong,
    )


def _asked_for(judge: Judge, value: RationalMatrix) -> RationalMatrix:
    """Leave out the w of a vector."""
    return (value[0][:3],) if judge.question.is_vector else value


def _shown_mistakes(
    judge: Judge, planned: tuple[MistakeId, ...]
) -> tuple[ExpectedMistake, ...] | None:
    """Make each planned mistake once; None where one does not show, or two look alike."""
    found: list[ExpectedMistake] = []
    for mistake in planned:
        texts = (typed(_asked_for(judge, value)) for value in judge.wrong_by(mistake))
        read = Computed(judge).answer
        named = next((one for one in texts if not judge.is_given_before(mistake, read(one))), None)
        if named is None or named in (one.text for one in found):
            return None
        found.append(ExpectedMistake(mistake, named))
    return tuple(found)
