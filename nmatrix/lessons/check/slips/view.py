"""Mistakes with the view: the other hand, the pose in its place, its axes, its last column.

V is `camera_from_world`, R its 3×3 block; V = R · T(−eye).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from nmatrix.enums import Handedness, Space
from nmatrix.lessons.check.computation import Place
from nmatrix.lessons.check.question import Matrices, Question, Subject, eye_of
from nmatrix.lessons.check.slips.lens import OTHER_HAND
from nmatrix.linear.rational import (
    RationalMatrix,
    RationalVector,
    affine_matrix,
    apply,
    identity,
    inverse,
    linear_part,
    numbers_like,
    rational_vector,
    translation,
    transpose,
)
from nmatrix.scene.camera import View

Y, Z = 1, 2  # rows


def look_at_of_the_other_hand(view: View) -> Iterator[View]:
    """Aim a camera that looks along the other z: left and right are exchanged too."""
    if view.is_aimed:
        yield replace(view, handed=OTHER_HAND[view.handed])


def mirrored(question: Question, right: Matrices) -> Matrices | None:
    """Turn the sign of the third row alone, which leaves a mirror."""
    return seen_by(question, right, with_negated(right.camera_from_world, Z))


def of_opencv(question: Question, right: Matrices) -> Matrices | None:
    """Take a camera whose y points down and whose z points ahead."""
    is_ahead = question.setup.view.handed is Handedness.LEFT
    rows = (Y,) if is_ahead else (Y, Z)
    return seen_by(question, right, with_negated(right.camera_from_world, *rows))


def not_inverted(question: Question, right: Matrices) -> Matrices | None:
    """Put the pose of the camera, or of the light, where its view belongs."""
    if question.space is Space.LIGHT and question.subject is not Subject.TRACE:
        return replace(right, space_from_world=inverse(right.space_from_world))
    return seen_by(question, right, inverse(right.camera_from_world))


def not_moved(question: Question, right: Matrices) -> Matrices | None:
    """Leave out the translation."""
    return seen_by(question, right, affine_matrix(linear_part(right.camera_from_world)))


def not_turned(question: Question, right: Matrices) -> Matrices | None:
    """Leave out the rotation."""
    V = right.camera_from_world
    moved = tuple(-x for x in numbers_like(V, eye_of(question.setup.view)))
    unturned = tuple(numbers_like(V, row) for row in identity(3))
    return seen_by(question, right, affine_matrix(unturned, moved))


def rotation_transposed(question: Question, right: Matrices) -> Matrices | None:
    """Write the camera's axes into columns."""
    V = right.camera_from_world
    return seen_by(question, right, affine_matrix(transpose(linear_part(V)), translation(V)))


def translation_turned(question: Question, right: Matrices) -> Matrices | None:
    """Turn the sign of the last column."""
    V = right.camera_from_world
    return _moved_by(question, right, tuple(-x for x in translation(V)))


def _unturned(sign: int) -> Place:
    """Write the eye into the last column as it is."""
    return lambda question, right: _moved_by(
        question, right, tuple(sign * x for x in eye_of(question.setup.view))
    )


def _target(sign: int) -> Place:
    """Write the target into the last column."""

    def place(question: Question, right: Matrices) -> Matrices | None:
        if not question.setup.view.is_aimed:
            return None
        target = rational_vector(question.setup.view.target)
        return _moved_by(question, right, tuple(sign * x for x in target))

    return place


def _turned_by_transpose(sign: int) -> Place:
    """Turn the eye by Rᵀ in place of −R."""

    def place(question: Question, right: Matrices) -> Matrices | None:
        R = linear_part(right.camera_from_world)
        moved = apply(transpose(R), eye_of(question.setup.view))
        return _moved_by(question, right, tuple(sign * x for x in moved))

    return place


OTHER_TRANSLATIONS = (
    _unturned(-1),
    _unturned(1),
    _target(-1),
    _target(1),
    _turned_by_transpose(1),
    _turned_by_transpose(-1),
)


def with_negated(A: RationalMatrix, *rows: int) -> RationalMatrix:
    """Turn the signs of some rows."""
    return tuple(tuple(-x for x in row) if i in rows else row for i, row in enumerate(A))


def seen_by(question: Question, right: Matrices, V: RationalMatrix) -> Matrices | None:
    """Put another view matrix in its place; None where no camera has a part in the answer."""
    if question.subject in (Subject.VIEW, Subject.TRACE):
        return replace(right, camera_from_world=V)
    if question.space is not Space.CAMERA:
        return None
    return replace(right, camera_from_world=V, space_from_world=V)


def _moved_by(question: Question, right: Matrices, moved: RationalVector) -> Matrices | None:
    block = linear_part(right.camera_from_world)
    return seen_by(question, right, affine_matrix(block, numbers_like(block, moved)))
