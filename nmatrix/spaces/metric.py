"""The metric of a space that is not rigid: what lengths and angles really are there.

B is the 3×3 block of `space_from_world`. Vectors are measured by B⁻ᵀB⁻¹ (in object space AᵀA),
covectors by BBᵀ. It is applied by its factors, |v| = |B⁻¹v| and |n| = |Bᵀn|; formed, it would
square the condition number.
"""

from __future__ import annotations

from nmatrix.enums import Space
from nmatrix.linear import rational
from nmatrix.linear.rational import RationalMatrix
from nmatrix.spaces.exact_maps import ExactMaps


def vector_world_from_space(maps: ExactMaps, space: Space) -> RationalMatrix:
    """Return B⁻¹, which takes vectors of the space back to world lengths and angles."""
    if space is Space.OBJECT:
        maps.space_from_world(space)
        return rational.linear_part(maps.world_from_object.exact)
    return rational.inverse(rational.linear_part(maps.space_from_world(space).exact))


def normal_world_from_space(maps: ExactMaps, space: Space) -> RationalMatrix:
    """Return Bᵀ, which takes normals of the space back to world lengths and angles."""
    return rational.transpose(rational.linear_part(maps.space_from_world(space).exact))


def metric(maps: ExactMaps, space: Space) -> RationalMatrix | None:
    """Return B⁻ᵀB⁻¹ for teaching, or None where the space is rigid and the metric is 1.

    Examples
    --------
    >>> from nmatrix.spaces.examples import tall_object
    >>> rational.to_floats(metric(tall_object(), Space.OBJECT))
    ((1.0, 0.0, 0.0), (0.0, 4.0, 0.0), (0.0, 0.0, 1.0))
    """
    if maps.is_rigid(space):
        return None
    back = vector_world_from_space(maps, space)
    return rational.product(rational.transpose(back), back)
