"""Mistakes with whole matrices: the wrong one, its inverse, its transpose, its factors exchanged.

M is `world_from_object`, V `camera_from_world`, S `space_from_world`.
"""

from __future__ import annotations

from dataclasses import replace

from nmatrix.enums import Space
from nmatrix.lessons.check.question import Question, Setting, Subject
from nmatrix.linear.rational import (
    RationalMatrix,
    affine_matrix,
    apply,
    determinant,
    inverse,
    linear_part,
    product,
    translation,
    transpose,
)

LIGHTING = (Subject.LIGHT, Subject.EYE)


def used_world_matrix(question: Question, right: Setting) -> Setting | None:
    """Move a light or the eye by M; into object space a symmetric M is the course's own rule."""
    if question.subject not in LIGHTING:
        return None
    A = linear_part(right.world_from_object)
    if question.is_direction and question.space is Space.OBJECT and transpose(A) == A:
        return None
    return replace(right, space_from_world=right.world_from_object)


def used_model_view(question: Question, right: Setting) -> Setting | None:
    """Put V·M where V, M or the identity belongs, and its inverse where M⁻¹ belongs."""
    V, M = right.camera_from_world, right.world_from_object
    if question.subject is Subject.VIEW:
        return replace(right, camera_from_world=product(V, M))
    if question.subject is Subject.NORMAL:
        return replace(right, space_from_world=V) if question.space in _STILL else None
    if question.subject not in LIGHTING or question.space in (Space.LIGHT, Space.CUSTOM):
        return None
    model_view = product(V, M)
    if question.space is Space.OBJECT:
        return _invertible(replace(right, space_from_world=model_view))
    return replace(right, space_from_world=model_view)


def view_not_inverted(question: Question, right: Setting) -> Setting | None:
    """Put the pose of the camera, or of the light, where its view belongs."""
    if question.subject is Subject.VIEW:
        return replace(right, camera_from_world=inverse(right.camera_from_world))
    if question.space in (Space.CAMERA, Space.LIGHT):
        return _invertible(right)
    return None


def transposed_layout(question: Question, right: Setting) -> Setting | None:
    """Multiply a row by the matrix in place of a column; a matrix is transposed by its `Flow`."""
    if question.subject not in LIGHTING:
        return None
    return replace(right, space_from_world=transpose(right.space_from_world))


def scale_before_translate(question: Question, right: Setting) -> Setting | None:
    """Exchange the translation and the rest: A·T for M = T·A, and T·R for V = R·T."""
    if question.subject is Subject.VIEW:
        return replace(right, camera_from_world=_moved_first(right.camera_from_world))
    if question.subject is Subject.WORLD:
        return replace(right, world_from_object=_moved_last(right.world_from_object))
    if question.subject not in LIGHTING:
        return None
    if question.space is Space.CAMERA:
        return replace(right, space_from_world=_moved_first(right.space_from_world))
    if question.space is Space.OBJECT:
        swapped = replace(right, space_from_world=_moved_last(right.world_from_object))
        return _invertible(swapped)
    return None


_STILL = (Space.WORLD, Space.STATIC)


def _moved_last(T_A: RationalMatrix) -> RationalMatrix:
    """Return A·T of the matrix T·A: its translation becomes A t."""
    block = linear_part(T_A)
    return affine_matrix(block, apply(block, translation(T_A)))


def _moved_first(R_T: RationalMatrix) -> RationalMatrix:
    """Return T·R of the matrix R·T: its translation, R t, becomes t."""
    block = linear_part(R_T)
    return affine_matrix(block, apply(inverse(block), translation(R_T)))


def _invertible(setting: Setting) -> Setting | None:
    """Return the setting with S inverted, if it can be."""
    S = setting.space_from_world
    if determinant(linear_part(S)) == 0:
        return None
    return replace(setting, space_from_world=inverse(S))
