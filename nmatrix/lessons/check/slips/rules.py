"""Mistakes with the rule itself: what is done to a normal or a light once the matrix is there."""

from __future__ import annotations

from nmatrix.enums import NormalRule
from nmatrix.lessons.check.mistakes import MistakeId
from nmatrix.lessons.check.question import LightPart, Question, Setting, light_vector
from nmatrix.linear.rational import (
    ONE,
    ZERO,
    RationalMatrix,
    apply,
    determinant,
    inverse_transpose,
    linear_part,
    rational_vector,
)
from nmatrix.linear.rounding import integers, over_root
from nmatrix.linear.rules import NormalTransform, normal_transform
from nmatrix.report import Vector

NORMAL_RULES = {
    MistakeId.NOT_TRANSPOSED: NormalRule.NOT_TRANSPOSED,
    MistakeId.NOT_INVERTED: NormalRule.NOT_INVERTED,
    MistakeId.USED_WORLD_MATRIX: NormalRule.NONE,
    MistakeId.COFACTOR_SIGN: NormalRule.COFACTOR,
    MistakeId.TRANSLATED: NormalRule.TRANSLATED,
    MistakeId.FOUR_COMPONENT_NORMALISE: NormalRule.FOUR_COMPONENT,
}
_OF_VECTORS = (NormalRule.TRANSLATED, NormalRule.FOUR_COMPONENT)  # not seen in a 3×3 matrix


def by_normal_rule(mistake: MistakeId, question: Question, by: Setting) -> RationalMatrix | None:
    """Return what a wrong rule makes of a normal, or its 3×3 matrix."""
    rule = NORMAL_RULES[mistake]
    if question.normal is None and rule in _OF_VECTORS:
        return None
    if rule is NormalRule.FOUR_COMPONENT and not question.unit:
        return None  # the length is all that is wrong with it
    if rule is NormalRule.COFACTOR and determinant(linear_part(by.space_from_object)) > 0:
        return None  # without a mirror the sign is right
    found = normal_transform(rule, by.space_from_object)
    if found is None:
        return None
    if question.normal is None:
        return linear_part(found.matrix)
    return _carried(found, question.normal)


def course_light_rule(question: Question, by: Setting) -> RationalMatrix | None:
    """Return the light direction by the inverse transpose of S."""
    B = linear_part(by.space_from_world)
    if not _is_light_direction(question) or determinant(B) == 0:
        return None
    return ((*apply(inverse_transpose(B), light_vector(question)[:3]), ZERO),)


def direction_as_point(question: Question, by: Setting) -> RationalMatrix | None:
    """Return the light direction moved with w = 1."""
    if not _is_light_direction(question):
        return None
    return (apply(by.space_from_world, (*light_vector(question)[:3], ONE)),)


def _is_light_direction(question: Question) -> bool:
    return question.light is LightPart.DIRECTION


def _carried(found: NormalTransform, normal: Vector) -> RationalMatrix:
    moved = found.applied_to(rational_vector(normal))
    if found.components == 3:
        return (moved,)
    numbers, _ = integers(moved)
    square = sum(number * number for number in numbers)
    return (rational_vector(over_root(number, square) for number in numbers),)
