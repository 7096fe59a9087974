"""Mistakes with the parts of a world matrix: one left out, two exchanged, a quaternion misread."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import fields
from fractions import Fraction

from nmatrix.linear.affine import rotation_from_quaternion, shear_matrix
from nmatrix.linear.angle import Angle
from nmatrix.linear.rational import (
    ZERO,
    RationalMatrix,
    affine_matrix,
    diagonal,
    linear_part,
    numbers_like,
    product,
    rational_vector,
    scaled,
)
from nmatrix.linear.values import with_fields
from nmatrix.report import Number
from nmatrix.scene.world import World

NOWHERE, AS_IT_IS, UPRIGHT = (0, 0, 0), (1, 1, 1), (0, 0, 0)


class ScaledAfterTurning(World):
    """An object whose parts are multiplied T · S · R · H."""

    def exact_by(self, turn: Callable[[Number], Angle]) -> RationalMatrix:
        """Build M of angles as `turn` makes them."""
        turned = linear_part(World.exact_by(with_fields(self, scale=AS_IT_IS), turn))
        stretch = numbers_like(turned, self.scale)
        block = tuple(tuple(f * x for x in row) for f, row in zip(stretch, turned, strict=True))
        return affine_matrix(block, numbers_like(turned, self.translate))


def scaled_after_turning(world: World) -> Iterator[World]:
    """Multiply S · R in place of R · S."""
    if world.matrix is None:
        yield ScaledAfterTurning(**{one.name: getattr(world, one.name) for one in fields(World)})


def not_moved(world: World) -> Iterator[World]:
    """Leave out the translation."""
    if world.matrix is None:
        yield with_fields(world, translate=NOWHERE)
    else:
        yield with_fields(world, matrix=affine_matrix(linear_part(world.matrix)))


def not_turned(world: World) -> Iterator[World]:
    """Leave out the rotation."""
    if world.matrix is None:
        yield with_fields(world, rotate_degrees=UPRIGHT, quaternion=None, axis_angle=None)


def not_scaled(world: World) -> Iterator[World]:
    """Leave out the scale, or take one of its factors for all three axes."""
    if world.matrix is None:
        for factor in dict.fromkeys((1, *world.scale)):
            yield with_fields(world, scale=(factor,) * 3)


def only_turned(world: World) -> Iterator[World]:
    """Leave out the scale, and with it the shear or not."""
    if world.matrix is None:
        yield with_fields(world, scale=AS_IT_IS)
        yield with_fields(world, scale=AS_IT_IS, shear=UPRIGHT)


def quaternion_in_another_order(world: World) -> Iterator[World]:
    """Take the first number of a quaternion for its w, or its w for the first number."""
    if world.matrix is None and world.quaternion is not None:
        x, y, z, w = world.quaternion
        yield with_fields(world, quaternion=(y, z, w, x))
        yield with_fields(world, quaternion=(w, x, y, z))


def quaternion_of_any_length(world: World) -> Iterator[World]:
    """Use a quaternion in the formulas of one of length 1.

    The formula with w² + x² − y² − z² scales by the squared length, the one with 1 − 2(y² + z²)
    also bends.
    """
    if world.matrix is not None or world.quaternion is None:
        return
    square = sum((Fraction(x) ** 2 for x in world.quaternion), ZERO)
    turned = scaled(rotation_from_quaternion(world.quaternion), square)
    stretched = product(
        diagonal(rational_vector(world.scale)), shear_matrix(rational_vector(world.shear))
    )
    yield _of(world, product(turned, stretched))
    bent = tuple(
        tuple(entry + (1 - square) * (i == j) for j, entry in enumerate(row))
        for i, row in enumerate(turned)
    )
    yield _of(world, product(bent, stretched))


def _of(world: World, block: RationalMatrix) -> World:
    moved = rational_vector(world.translate)
    return World(matrix=affine_matrix(block, moved), order=world.order, convention=world.convention)
