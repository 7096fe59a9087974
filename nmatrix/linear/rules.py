"""Every rule that people use for normals, the right one first: one table for all that compare.

A is the 3×3 block, C its cofactor matrix, n a normal in object space.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from nmatrix.enums import NormalMethod, NormalRule, NormalStatus
from nmatrix.linear.exact import LinearMap, Normal
from nmatrix.linear.rational import (
    RationalMatrix,
    affine,
    apply,
    inverse,
    linear,
    rational,
    scaled,
    to_floats,
    transpose,
)
from nmatrix.linear.rounding import integers, unit


@dataclass(frozen=True)
class Rule:
    """One way to make the matrix that normals are multiplied by."""

    method: NormalMethod
    title: str


RULES: tuple[Rule, ...] = (
    Rule(NormalMethod.EXACT, "N = A⁻ᵀ, the inverse transpose, correctly rounded"),
    Rule(NormalMethod.INVERSE, "np.linalg.inv(A).T, in float64"),
    Rule(NormalMethod.COFACTOR, "C, the cofactors without the sign of det"),
    Rule(NormalMethod.NONE, "A itself"),
)


def normal_rule(method: NormalMethod, linear_map: LinearMap) -> RationalMatrix | None:
    """Return the matrix of a rule, exactly, or None where the rule has no answer.

    Examples
    --------
    >>> mirror = LinearMap.of([[-1, 0, 0], [0, 1, 0], [0, 0, 1]])
    >>> [[int(normal_rule(rule, mirror)[i][i]) for i in range(3)]
    ...  for rule in (NormalMethod.EXACT, NormalMethod.COFACTOR)]
    [[-1, 1, 1], [1, -1, -1]]
    """
    if method is NormalMethod.EXACT:
        return linear_map.inverse_transpose if linear_map.integer_determinant else None
    if method is NormalMethod.COFACTOR:
        return linear_map.cofactor_matrix
    A = _entries(linear_map)
    return A if method is NormalMethod.NONE else _float64_inverse_transpose(A)


def carried_by(
    matrix: RationalMatrix | None, linear_map: LinearMap, normal_object: Sequence[float | Fraction]
) -> Normal:
    """Return what a rule's matrix makes of a normal, at length one.

    How far off A itself is does not depend on the rule: it is measured against the right normal.
    """
    n = [Fraction(component) for component in normal_object]
    carried = [] if matrix is None else integers(apply(matrix, n))[0]
    if not any(carried):
        reason = "this rule has no answer here" if matrix is None else "this rule gives length 0"
        return Normal(None, NormalStatus.UNDEFINED, reason, None)
    without = linear_map.normal(n).angle_without_deg
    return Normal(unit(carried), NormalStatus.OK, "", without)


@dataclass(frozen=True)
class Carrier:
    """How a rule carries a mesh's normals: n' = K·(n, w), over the length of its components.

    Of n' three components are the normal. `components` is 3, or 4 where the fourth one is part
    of the length by mistake.
    """

    matrix: RationalMatrix
    w: int = 0
    components: int = 3


def carrier(rule: NormalRule, world_from_object: RationalMatrix) -> Carrier | None:
    """Return how a rule carries normals through an affine map, or None where it has no answer.

    The right rule is sign(det A)·C, which also serves where no inverse is left.

    Examples
    --------
    >>> from nmatrix.linear.affine import translation_matrix
    >>> found = carrier(NormalRule.TRANSLATED, translation_matrix((5, 0, 0)))
    >>> [int(found.matrix[0][3]), found.w]
    [5, 1]
    """
    A = linear(world_from_object)
    linear_map = LinearMap.of(A)
    sign = Fraction(-1 if linear_map.integer_determinant < 0 else 1)
    found: RationalMatrix | None
    if rule is NormalRule.TRANSLATED:
        return Carrier(world_from_object, w=1)
    if rule in (NormalRule.NOT_TRANSPOSED, NormalRule.FOUR_COMPONENT):
        return _by_inverse(rule, world_from_object) if linear_map.integer_determinant else None
    if rule is NormalRule.EXACT:
        found = scaled(linear_map.cofactor_matrix, sign)
    elif rule is NormalRule.NOT_INVERTED:
        found = transpose(A)
    else:
        found = normal_rule(NormalMethod(rule.value), linear_map)
    return None if found is None else Carrier(affine(found))


def _by_inverse(rule: NormalRule, world_from_object: RationalMatrix) -> Carrier:
    inverted = inverse(world_from_object)
    if rule is NormalRule.NOT_TRANSPOSED:
        return Carrier(affine(linear(inverted)))
    return Carrier(transpose(inverted), components=4)


def _entries(linear_map: LinearMap) -> RationalMatrix:
    return tuple(
        tuple(Fraction(entry, linear_map.denominator) for entry in row)
        for row in linear_map.entries
    )


def _float64_inverse_transpose(A: RationalMatrix) -> RationalMatrix | None:
    import numpy as np

    with np.errstate(all="ignore"):
        try:
            found = np.linalg.inv(np.array(to_floats(A))).T
        except np.linalg.LinAlgError:
            return None
    return rational(found.tolist()) if np.isfinite(found).all() else None
