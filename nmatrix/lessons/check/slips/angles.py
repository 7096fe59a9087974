"""Mistakes with angles: their unit, their order, their sign, the convention they belong to.

Each takes one part of a scene and lists what the mistake makes of it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import permutations, product
from math import degrees, isinf, radians

from nmatrix.enums import Convention
from nmatrix.linear import rational as exact
from nmatrix.linear.affine import AXES, rotation_about
from nmatrix.linear.angle import Angle
from nmatrix.linear.rational import (
    RationalMatrix,
    affine_matrix,
    apply,
    numbers_like,
)
from nmatrix.linear.values import with_fields
from nmatrix.report import Number, Vector
from nmatrix.scene.camera import FirstPerson, View
from nmatrix.scene.setup import Light
from nmatrix.scene.world import World

UNITS = (degrees, radians)  # degrees taken for radians, and radians for degrees


def world_in_another_unit(world: World) -> Iterator[World]:
    """Take the angles of an object for radians, or convert them once too often."""
    if world.matrix is None:
        for convert in UNITS:
            yield with_fields(world, rotate_degrees=_converted(world.rotate_degrees, convert))


def view_in_another_unit(view: View) -> Iterator[View]:
    """Take the angles of a camera for radians, or convert them once too often."""
    if view.angles is not None:
        for convert in UNITS:
            yield _looking(view, _converted(_turns(view.angles), convert))


def light_in_another_unit(light: Light) -> Iterator[Light]:
    """Take the angles of a light for radians, or convert them once too often."""
    if light.angles_degrees is not None:
        for convert in UNITS:
            yield with_fields(light, angles_degrees=_converted(light.angles_degrees, convert))


def world_in_another_order(world: World) -> Iterator[World]:
    """Multiply the rotations of an object in every other order."""
    standard = _standard(world)
    if standard is not None:
        for order in permutations(AXES):
            yield with_fields(standard, order="".join(order))


def view_in_another_order(view: View) -> Iterator[View]:
    """Multiply the rotations of a camera in every other order."""
    if view.angles is not None:
        for order in permutations("ZXY"):
            yield ReorderedView(
                view.eye, angles=view.angles, convention=view.convention, sequence="".join(order)
            )


def world_turned_back(world: World) -> Iterator[World]:
    """Turn an object about some of the axes the other way."""
    if world.matrix is not None:
        return
    if world.quaternion is not None:
        x, y, z, w = world.quaternion
        yield with_fields(world, quaternion=(-x, -y, -z, w))
    else:
        for turned in _signs(world.rotate_degrees):
            yield with_fields(world, rotate_degrees=turned)


def view_turned_back(view: View) -> Iterator[View]:
    """Turn a camera by some of its angles the other way."""
    if view.angles is not None:
        for turned in _signs(_turns(view.angles)):
            yield _looking(view, turned)


def world_of_another_convention(world: World) -> Iterator[World]:
    """Take the angles of an object by another convention."""
    if world.matrix is None and world.quaternion is None:
        for convention in Convention:
            yield with_fields(world, convention=convention, order="XYZ")


def view_of_another_convention(view: View) -> Iterator[View]:
    """Take the angles of a camera by another convention, or exchange them."""
    if view.angles is not None:
        up, sideways, roll = _turns(view.angles)
        for convention in Convention:
            for angles in (view.angles, FirstPerson(float(sideways), float(up), float(roll))):
                yield with_fields(view, convention=convention, angles=angles)


@dataclass(frozen=True)
class ReorderedView(View):
    """A camera whose three turns are multiplied in another sequence than Z (roll), X, Y."""

    sequence: str = "ZXY"

    def by_angles(self, turn: Callable[[Number], Angle]) -> RationalMatrix:
        """Build the view matrix of the turns in this sequence."""
        assert self.angles is not None  # or it would not be reordered
        sideways = turn(self.angles.angle)
        turns = {
            "Z": -turn(self.angles.roll),
            "X": -turn(self.angles.elevation),
            "Y": sideways if self.convention is Convention.POLIMI else -sideways,
        }
        turned = exact.product(*(rotation_about(axis, turns[axis]) for axis in self.sequence))
        moved = apply(turned, numbers_like(turned, self.eye))
        return affine_matrix(turned, tuple(-x for x in moved))


def _turns(angles: FirstPerson) -> Vector:
    return angles.elevation, angles.angle, angles.roll


def _looking(view: View, turns: Vector) -> View:
    return with_fields(view, angles=FirstPerson(*map(float, turns)))


def _converted(values: Vector, convert: Callable[[float], float]) -> Vector:
    found = tuple(convert(float(value)) for value in values)
    if any(map(isinf, found)):
        raise OverflowError("an angle beyond float64")
    return found


def _signs(values: Vector) -> Iterator[Vector]:
    """Choose signs in every way but the given one; a zero has no sign."""
    choices = [(value, -value) if value else (value,) for value in values]
    yield from list(product(*choices))[1:]


def _standard(world: World) -> World | None:
    """Describe a world in the standard convention, if three angles describe it."""
    if world.matrix is not None or world.quaternion is not None or world.axis_angle is not None:
        return None
    x, y, z = world.rotate_degrees
    turned: dict[Convention, tuple[Number, ...]] = {
        Convention.STANDARD: (x, y, z),
        Convention.POLIMI: (y, -x, -z),
        Convention.POLIMI_ASSIGNMENTS: (y, x, z),
    }
    return with_fields(
        world, rotate_degrees=turned[world.convention], convention=Convention.STANDARD
    )
