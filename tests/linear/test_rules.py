"""The table of rules for normals: every rule is in it, and is wrong where it is said to be."""

from __future__ import annotations

from fractions import Fraction

import pytest

from nmatrix.enums import NORMAL_METHODS, NormalRule
from nmatrix.linear.affine import compose
from nmatrix.linear.exact import LinearMap
from nmatrix.linear.rational import cross, identity, linear_part, rational_vector
from nmatrix.linear.rules import RULES, normal_transform

N = rational_vector((1, 2, 3))
TRANSLATE = (5, 0, 0)


def is_right(rule: NormalRule, **parts: tuple[float, ...]) -> bool:
    """Compare a rule's direction with the exact one, without a tolerance."""
    M = compose(identity(3), **parts)
    found = normal_transform(rule, M)
    assert found is not None
    direction = found.applied_to(N)[: found.components]
    if any(direction[3:]):
        return False
    true = rational_vector(LinearMap.of(linear_part(M)).normal(N).direction or (0, 0, 0))
    size = sum(x * x for x in direction)
    same_side = sum(a * b for a, b in zip(direction, true, strict=False)) > 0
    return same_side and all(x * x < size * Fraction(1, 10**30) for x in cross(direction, true))


@pytest.mark.parametrize("rule", NormalRule)
def test_every_rule_is_right_for_a_uniform_scale_that_moves_nothing(rule: NormalRule) -> None:
    assert RULES[rule].title
    assert is_right(rule, scale=(2, 2, 2))


@pytest.mark.parametrize("rule", NormalRule)
def test_a_stretch_a_mirror_and_a_translation_tell_the_right_rule_from_all_others(
    rule: NormalRule,
) -> None:
    everywhere = (
        is_right(rule, scale=(1, 4, 1), shear=(1, 0, 0))
        and is_right(rule, scale=(-1, 1, 1))
        and is_right(rule, scale=(2, 2, 2), translate=TRANSLATE)
    )
    assert everywhere is (rule in (NormalRule.EXACT, NormalRule.INVERSE))


@pytest.mark.parametrize("rule", NORMAL_METHODS)
def test_a_method_is_a_three_by_three_matrix(rule: NormalRule) -> None:
    found = normal_transform(rule, compose(identity(3), scale=(1, 2, 1), translate=TRANSLATE))
    assert found is not None
    assert (found.w, found.components, *found.matrix[3]) == (0, 3, 0, 0, 0, 1)
    assert not any(row[3] for row in found.matrix[:3])


@pytest.mark.parametrize("rule", NormalRule)
def test_what_needs_an_inverse_has_no_answer_for_a_flattened_map(rule: NormalRule) -> None:
    needs_inverse = (NormalRule.INVERSE, NormalRule.NOT_TRANSPOSED, NormalRule.FOUR_COMPONENT)
    found = normal_transform(rule, compose(identity(3), scale=(1, 0, 1)))
    assert (found is None) is (rule in needs_inverse)
