"""Every rule that people use for normals, the right one first: one table for all that compare.

M is an affine 4×4 matrix, A its 3×3 block, C the cofactors of A, n a normal in object space.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

from nmatrix.enums import NormalRule
from nmatrix.errors import IllegalValueError
from nmatrix.linear.exact import LinearMap
from nmatrix.linear.rational import (
    RationalMatrix,
    RationalVector,
    Rows,
    affine_matrix,
    apply,
    cofactor_matrix,
    determinant,
    inverse,
    linear_part,
    rational_matrix,
    to_floats,
    to_floats_near_one,
    transpose,
)


@dataclass(frozen=True)
class NormalTransform:
    """A matrix K for normals: n′ = K·(n, w), divided by the length of its components.

    The first three components of n′ are the normal. `components` is 3, or 4 where the fourth one
    is counted into the length by mistake.
    """

    matrix: RationalMatrix
    w: int = 0
    components: int = 3

    @cached_property
    def floats(self) -> Rows:
        """K in float64; where its size does not matter, it is brought near to one before."""
        if self.components == 4 or self.w:
            return to_floats(self.matrix)
        return to_floats_near_one(self.matrix)

    def applied_to(self, normal: Sequence[Fraction]) -> RationalVector:
        """Multiply one normal, exactly and without normalising: all four components of n′."""
        return apply(self.matrix, (*normal, Fraction(self.w)))


@dataclass(frozen=True)
class Rule:
    """A rule in words, and the transform that it makes of M: None where it has no answer."""

    title: str
    transform: Callable[[RationalMatrix], NormalTransform | None]


def normal_transform(rule: NormalRule, world_from_object: RationalMatrix) -> NormalTransform | None:
    """Build the transform of normals that a rule makes of an affine map; None if it cannot.

    The right rule is sign(det A)·C, a positive multiple of A⁻ᵀ that is left where A has no inverse.

    Examples
    --------
    >>> from nmatrix.linear.affine import translation_matrix
    >>> found = normal_transform(NormalRule.TRANSLATED, translation_matrix((5, 0, 0)))
    >>> [float(x) for x in found.applied_to((0, 1, 0))]
    [5.0, 1.0, 0.0, 1.0]
    """
    return RULES[rule].transform(world_from_object)


def _linear(K: RationalMatrix) -> NormalTransform:
    return NormalTransform(affine_matrix(K))


def _signed_cofactors(M: RationalMatrix) -> NormalTransform:
    linear_map = LinearMap.of(linear_part(M))
    over = linear_map.denominator**2 * (-1 if linear_map.integer_determinant < 0 else 1)
    return _linear(tuple(tuple(Fraction(c, over) for c in row) for row in linear_map.cofactors))


def _float64_inverse_transpose(M: RationalMatrix) -> NormalTransform | None:
    import numpy as np

    try:
        A = to_floats(linear_part(M))
    except IllegalValueError:  # an entry beyond float64
        return None
    with np.errstate(all="ignore"):
        try:
            found = np.linalg.inv(np.array(A)).T
        except np.linalg.LinAlgError:
            return None
    if not np.isfinite(found).all():
        return None
    return _linear(rational_matrix(found.tolist()))


def _not_transposed(M: RationalMatrix) -> NormalTransform | None:
    if determinant(linear_part(M)) == 0:
        return None
    return _linear(inverse(linear_part(M)))


def _four_components(M: RationalMatrix) -> NormalTransform | None:
    if determinant(linear_part(M)) == 0:
        return None
    return NormalTransform(transpose(inverse(M)), components=4)


RULES: Mapping[NormalRule, Rule] = {
    NormalRule.EXACT: Rule("N = A⁻ᵀ, the inverse transpose, correctly rounded", _signed_cofactors),
    NormalRule.INVERSE: Rule("np.linalg.inv(A).T, in float64", _float64_inverse_transpose),
    NormalRule.COFACTOR: Rule(
        "C, the cofactors without the sign of det",
        lambda M: _linear(cofactor_matrix(linear_part(M))),
    ),
    NormalRule.NONE: Rule("A itself", lambda M: _linear(linear_part(M))),
    NormalRule.NOT_TRANSPOSED: Rule("A⁻¹, not transposed", _not_transposed),
    NormalRule.NOT_INVERTED: Rule("Aᵀ, not inverted", lambda M: _linear(transpose(linear_part(M)))),
    NormalRule.TRANSLATED: Rule(
        "M (n, 1), moved as if it were a point", lambda M: NormalTransform(M, w=1)
    ),
    NormalRule.FOUR_COMPONENT: Rule("M⁻ᵀ (n, 0), w counted into its length", _four_components),
}
