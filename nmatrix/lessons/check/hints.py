"""What to say of an answer whose mistake has no name: a step left out, two steps exchanged."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from nmatrix.enums import Space
from nmatrix.lessons.check.likeness import Likeness
from nmatrix.lessons.check.question import Question, Subject, light_vector, right_matrices
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
    transpose,
)

NOT_MOVED = "These are the numbers in {space} space: nothing was moved."
HALF_UNDONE = "The translation was subtracted; what is left is to undo the 3×3 block."
LEFT_OUT = "The rest is right; {part} left out: 0 stands where a number belongs."
SCALED_LAST = "You scaled after turning, T · S · R; in M = T · R · S the scale comes first."


@dataclass(frozen=True)
class Hint:
    """Numbers that an answer may be, and what they show."""

    value: RationalMatrix
    sentence: str


def hints(question: Question) -> Iterator[Hint]:
    """List numbers that no mistake with a name explains.

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


def left_out(question: Question, found: Likeness) -> str | None:
    """Name what is 0 in an answer and should not be, if nothing else is wrong.

    Examples
    --------
    >>> from nmatrix.lessons.check.answer import read_answer
    >>> from nmatrix.lessons.check.likeness import likeness
    >>> from nmatrix.scene.camera import View
    >>> from nmatrix.scene.setup import Setup
    >>> eye = Question(Subject.EYE, Setup(view=View(eye=(3, 2, 5))))
    >>> left_out(eye, likeness(read_answer("3 0 5", eye), ((3, 2, 5, 1),), eye))
    'The rest is right; y is left out: 0 stands where a number belongs.'
    """
    of_zeros = not any(found.given[i][j] for i, j in found.wrong)
    if not of_zeros or not any(map(any, found.given)):
        return None
    return LEFT_OUT.format(part=_part(question, found))


def _part(question: Question, found: Likeness) -> str:
    """Take the largest part that the wrong zeros are all of: the translation, a row, a column."""
    if question.is_vector:
        return _listed(["xyzw"[j] for _, j in found.wrong])
    given, turned = found.given, transpose(found.given)
    rows, columns = ({place[axis] for place in found.wrong} for axis in (0, 1))
    is_affine = question.subject is not Subject.PROJECTION
    if is_affine and columns == {3} and 3 not in rows and not any(turned[3][:3]):
        return "the translation is"
    for name, lines, at in (("row", given, rows), ("column", turned, columns)):
        if len(at) == 1 and not any(lines[min(at)]):
            return f"{name} {min(at) + 1} is"
    return _listed([f"row {i + 1} column {j + 1}" for i, j in found.wrong])


def _listed(names: Sequence[str]) -> str:
    *first, last = names
    return f"{', '.join(first)} and {last} are" if first else f"{last} is"


def _of_vectors(question: Question) -> Iterator[Hint]:
    before, space = _not_moved(question)
    if question.space is not space:
        yield Hint((before,), NOT_MOVED.format(space=space))
    if question.space is Space.OBJECT and before[3] == ONE:
        away = translation(right_matrices(question).world_from_object)
        moved = (x - t for x, t in zip(before[:3], away, strict=True))
        yield Hint(((*moved, ONE),), HALF_UNDONE)


def _not_moved(question: Question) -> tuple[RationalVector, Space]:
    """Take what is to be moved, with its w, and the space that it comes in."""
    if question.subject is Subject.EYE:
        return (*rational_vector(question.setup.camera.eye), ONE), Space.WORLD
    if question.subject is Subject.LIGHT:
        return light_vector(question), Space.WORLD
    assert question.normal is not None
    return (*rational_vector(question.normal), ZERO), Space.OBJECT


def _of_worlds(question: Question) -> Iterator[Hint]:
    world = question.setup.world
    if world.matrix is None and not any(world.shear):
        turned = linear_part(replace(world, scale=(1, 1, 1)).world_from_object)
        scaled = product(diagonal(rational_vector(world.scale)), turned)
        yield Hint(affine_matrix(scaled, translation(world.world_from_object)), SCALED_LAST)
