"""What to say of an answer whose mistake has no name: a step left out, two steps exchanged."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from nmatrix.enums import Space
from nmatrix.lessons.check.question import Question, Subject, light_vector, setting
from nmatrix.linear.rational import (
    ONE,
    ZERO,
    RationalMatrix,
    RationalVector,
    affine_matrix,
    diagonal,
    linear_part,
    product,
    rational_vector,
    translation,
)

NOT_MOVED = "These are the numbers in {space} space: nothing was moved."
HALF_UNDONE = "The translation was subtracted; what is left is to undo the 3×3 block."
NO_TRANSLATION = "The 3×3 block is right, and the translation is missing."
SCALED_LAST = "You scaled after turning, T · S · R; in M = T · R · S the scale comes first."


@dataclass(frozen=True)
class Hint:
    """Numbers that an answer may be, and what they show."""

    value: RationalMatrix
    sentence: str


def hints(question: Question) -> Iterator[Hint]:
    """Give what an answer may be that no mistake with a name explains.

    Examples
    --------
    >>> from nmatrix.scene.camera import View
    >>> from nmatrix.scene.setup import Setup
    >>> eye = Question(Subject.EYE, Setup(view=View(eye=(0, 0, 5))), Space.OBJECT)
    >>> next(hints(eye)).sentence
    'These are the numbers in world space: nothing was moved.'
    """
    if question.is_vector:
        yield from _of_vectors(question)
    elif question.subject is Subject.WORLD:
        yield from _of_worlds(question)
    elif question.subject is Subject.VIEW:
        yield Hint(affine_matrix(linear_part(setting(question).camera_from_world)), NO_TRANSLATION)


def _of_vectors(question: Question) -> Iterator[Hint]:
    before, space = _not_moved(question)
    if question.space is not space:
        yield Hint((before,), NOT_MOVED.format(space=space))
    if question.space is Space.OBJECT and before[3] == ONE:
        away = translation(setting(question).world_from_object)
        moved = (x - t for x, t in zip(before[:3], away, strict=True))
        yield Hint(((*moved, ONE),), HALF_UNDONE)


def _not_moved(question: Question) -> tuple[RationalVector, Space]:
    """Return what is to be moved, with its w, and the space that it comes in."""
    if question.subject is Subject.EYE:
        return (*rational_vector(question.setup.camera.eye), ONE), Space.WORLD
    if question.subject is Subject.LIGHT:
        return light_vector(question), Space.WORLD
    assert question.normal is not None
    return (*rational_vector(question.normal), ZERO), Space.OBJECT


def _of_worlds(question: Question) -> Iterator[Hint]:
    world = question.setup.world
    yield Hint(affine_matrix(linear_part(world.world_from_object)), NO_TRANSLATION)
    if world.matrix is None and not any(world.shear):
        turned = linear_part(replace(world, scale=(1, 1, 1)).world_from_object)
        scaled = product(diagonal(rational_vector(world.scale)), turned)
        yield Hint(affine_matrix(scaled, translation(world.world_from_object)), SCALED_LAST)
