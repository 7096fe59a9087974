"""Mistakes with whole matrices: the wrong one, its inverse, its transpose, its factors exchanged.

M is `world_from_object`, V `camera_from_world`, S `space_from_world`.
"""

from __future__ import annotations

from dataclasses import replace

from nmatrix.enums import Space
from nmatrix.lessons.check.question import Matrices, Question, Subject
from nmatrix.lessons.check.slips.view import seen_by
from nmatrix.linear.rational import (
    RationalMatrix,
    affine_matrix,
    apply,
    inverse,
    linear_part,
    product,
    translation,
    transpose,
)

_STILL = (Space.WORLD, Space.STATIC)


def used_world_matrix(question: Question, right: Matrices) -> Matrices | None:
    """Move a light or the eye by M; into object space a symmetric M is the course's own rule."""
    A = linear_part(right.world_from_object)
    if question.is_direction and question.space is Space.OBJECT and transpose(A) == A:
        return None
    return replace(right, space_from_world=right.world_from_object)


def used_model_view(question: Question, right: Matrices) -> Matrices | None:
    """Put V·M where V, M or the identity belongs, and its inverse where M⁻¹ belongs."""
    V, M = right.camera_from_world, right.world_from_object
    if question.subject is Subject.VIEW:
        return replace(right, camera_from_world=product(V, M))
    if question.subject is Subject.NORMAL:
        return replace(right, space_from_world=V) if question.space in _STILL else None
    if question.space in (Space.LIGHT, Space.CUSTOM):
        return None
    both = product(V, M)
    is_of_object = question.space is Space.OBJECT
    return replace(right, space_from_world=inverse(both) if is_of_object else both)


def world_inverted(_: Question, right: Matrices) -> Matrices:
    """Give the way from the world to the object."""
    return replace(right, world_from_object=inverse(right.world_from_object))


def transposed_layout(_: Question, right: Matrices) -> Matrices:
    """Multiply a row by the matrix in place of a column."""
    return replace(right, space_from_world=transpose(right.space_from_world))


def scale_before_translate(question: Question, right: Matrices) -> Matrices | None:
    """Exchange the translation and the rest: A·T for M = T·A, and T·R for V = R·T."""
    M = _moved_first(right.world_from_object)
    if question.subject in (Subject.WORLD, Subject.TRACE, Subject.AXES):
        return replace(right, world_from_object=M)
    if question.space is Space.CAMERA:
        return seen_by(question, right, _moved_last(right.camera_from_world))
    if question.space is Space.OBJECT:
        return replace(right, space_from_world=inverse(M))
    return None


def _moved_first(T_A: RationalMatrix) -> RationalMatrix:
    """Turn T·A into A·T: its translation becomes A t."""
    block = linear_part(T_A)
    return affine_matrix(block, apply(block, translation(T_A)))


def _moved_last(R_T: RationalMatrix) -> RationalMatrix:
    """Turn R·T into T·R: its translation, R t, becomes t."""
    block = linear_part(R_T)
    return affine_matrix(block, apply(inverse(block), translation(R_T)))
