"""What to say of an answer whose mistake has no name: a step not made, numbers left out."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from nmatrix.enums import Space
from nmatrix.lessons.check.likeness import Likeness
from nmatrix.lessons.check.question import (
    Question,
    Subject,
    light_vector,
    right_matrices,
    traced,
)
from nmatrix.lessons.check.tolerance import RELATIVE
from nmatrix.linear.rational import (
    ONE,
    ZERO,
    RationalMatrix,
    RationalVector,
    apply,
    rational_vector,
    translation,
    transpose,
)

NOT_MOVED = "These are the numbers in {space} space: nothing was moved."
HALF_UNDONE = "The translation was subtracted; what is left is to undo the 3×3 block."
LEFT_OUT = "The rest is right; {part} left out: 0 stands where a number belongs."
NOT_YET = "These are the numbers in {frame}: the way goes on from there."
DIVIDE = "Divided by the fourth number, w, these are right: w is 1 when that is done."


@dataclass(frozen=True, eq=False)
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
    if question.subject is Subject.TRACE:
        yield from _on_the_way(question)
    elif question.is_vector:
        yield from _of_vectors(question)


def undivided(question: Question, found: Likeness) -> str | None:
    """Recognise a traced vertex whose w is not 1 and divides its x, y and z to the right ones."""
    if question.subject is not Subject.TRACE or len(found.given[0]) < 4 or not found.given[0][3]:
        return None
    *place, w = found.given[0]
    allowance = RELATIVE * max(ONE, *map(abs, found.wanted[0]))
    near = all(abs(x / w - y) <= allowance for x, y in zip(place, found.wanted[0], strict=False))
    return DIVIDE if near else None


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
    """Take the largest part that the wrong zeros are all of: a row, a column."""
    if question.is_vector:
        return _listed(["xyzw"[j] for _, j in found.wrong])
    given, turned = found.given, transpose(found.given)
    rows, columns = ({place[axis] for place in found.wrong} for axis in (0, 1))
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


def _on_the_way(question: Question) -> Iterator[Hint]:
    """List the vertex in each frame before the last one that is asked for."""
    at = right_matrices(question)
    world = apply(at.world_from_object, (*rational_vector(question.point), ONE))
    camera = apply(at.camera_from_world, world)
    yield Hint((world,), NOT_YET.format(frame="world space"))
    yield Hint((camera,), NOT_YET.format(frame="camera space"))
    if question.window is not None:
        ndc = traced(replace(question, window=None), at)
        yield Hint((ndc,), NOT_YET.format(frame="normalised device coordinates"))
