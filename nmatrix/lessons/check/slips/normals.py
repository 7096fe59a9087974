"""Mistakes with the rule itself: what is done to a normal or a light once the matrix is there."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from math import hypot

from nmatrix.enums import NormalRule
from nmatrix.lessons.check.computation import Rule
from nmatrix.lessons.check.question import (
    LightPart,
    Matrices,
    Question,
    light_vector,
)
from nmatrix.linear.rational import (
    ONE,
    ZERO,
    RationalMatrix,
    RationalVector,
    apply,
    determinant,
    inverse_transpose,
    linear_part,
    rational_vector,
    translation,
)
from nmatrix.linear.rounding import integers, over_root, unit
from nmatrix.scene.setup import Light

_OF_VECTORS = (NormalRule.TRANSLATED, NormalRule.FOUR_COMPONENT)  # not seen in a 3×3 matrix


def normal_by(rule: NormalRule) -> Rule:
    """Move a normal by another rule than the right one, or take the 3×3 block of that rule."""
    return partial(_normal_by, rule, lambda n: n)


def unit_normal_by(rule: NormalRule) -> Rule:
    """Move a normal of length 1 by another rule than the right one."""
    return partial(_normal_by, rule, _unit)


def _normal_by(
    rule: NormalRule,
    prepared: Callable[[RationalVector], RationalVector],
    question: Question,
    by: Matrices,
) -> RationalMatrix | None:
    from nmatrix.linear.rules import normal_transform  # of which only normals ask

    if not _can_break(rule, question, by):
        return None
    found = normal_transform(rule, by.space_from_object)
    if found is None or question.normal is None:
        return None if found is None else linear_part(found.matrix)
    moved = found.applied_to(prepared(rational_vector(question.normal)))
    return (moved if found.components == 3 else _of_length_one(moved),)


def _can_break(rule: NormalRule, question: Question, by: Matrices) -> bool:
    if question.normal is None and rule in _OF_VECTORS:
        return False
    if rule is NormalRule.FOUR_COMPONENT:
        return question.unit  # or else the length is all that is wrong with it
    if rule is NormalRule.COFACTOR:  # without a mirror the sign is right
        return determinant(linear_part(by.space_from_object)) < 0
    return True


def moved_normal(question: Question, by: Matrices) -> RationalMatrix | None:
    """Add the translation to A⁻ᵀ n."""
    return _moved_normal(question, by, of_length_one=False)


def moved_unit_normal(question: Question, by: Matrices) -> RationalMatrix | None:
    """Add the translation to A⁻ᵀ n of a normal n of length 1."""
    return _moved_normal(question, by, of_length_one=True)


def _moved_normal(
    question: Question, by: Matrices, *, of_length_one: bool
) -> RationalMatrix | None:
    if question.normal is None:
        return None
    n = rational_vector(question.normal)
    S_M = by.space_from_object
    moved = apply(inverse_transpose(linear_part(S_M)), _unit(n) if of_length_one else n)
    offset = translation(S_M)
    return ((*(x + t for x, t in zip(moved, offset, strict=True)), ZERO),)


def course_light_rule(question: Question, by: Matrices) -> RationalMatrix | None:
    """Move the light direction by the inverse transpose of S."""
    B = linear_part(by.space_from_world)
    if not is_light_direction(question):
        return None
    return ((*apply(inverse_transpose(B), light_vector(question)[:3]), ZERO),)


def direction_as_point(question: Question, by: Matrices) -> RationalMatrix | None:
    """Move the light direction with w = 1."""
    if not is_light_direction(question):
        return None
    return (apply(by.space_from_world, (*light_vector(question)[:3], ONE)),)


def towards_the_lamp(light: Light) -> Iterator[Light]:
    """Take the direction to the lamp for that in which the light travels."""
    direction = light.placed().direction
    if direction is not None:
        yield Light(tuple(-x for x in direction), position=light.position)


def is_light_direction(question: Question) -> bool:
    """Recognise a question about a light's direction."""
    return question.light is LightPart.DIRECTION


def _unit(n: RationalVector) -> RationalVector:
    return rational_vector(unit(integers(n)[0]))


def _of_length_one(v: RationalVector) -> RationalVector:
    """Divide all the components by their length."""
    if isinstance(v[0], float):
        return tuple(x / hypot(*v) for x in v)
    numbers, _ = integers(v)
    square = sum(number * number for number in numbers)
    return rational_vector(over_root(number, square) for number in numbers)
