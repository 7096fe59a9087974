"""Mistakes with angles: their unit, their order, their sign, the convention they belong to.

Each takes a scene and yields the scenes that the mistake makes of it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import permutations, product
from math import degrees

from nmatrix.enums import Convention
from nmatrix.linear import rational as exact
from nmatrix.linear.affine import AXES, rotation_about
from nmatrix.linear.angle import Angle
from nmatrix.linear.rational import affine_matrix, apply, rational_matrix
from nmatrix.report import Number, Vector
from nmatrix.scene.camera import FirstPerson, View
from nmatrix.scene.setup import Setup
from nmatrix.scene.world import World


def degrees_as_radians(setup: Setup) -> Iterator[Setup]:
    """Take angles for radians, group by group and at once."""
    world, view, light = _radians_world(setup.world), _radians_view(setup.view), setup.light
    if light.angles_degrees is not None:
        alpha, beta = light.angles_degrees
        light = replace(light, angles_degrees=(degrees(alpha), degrees(beta)))
        yield replace(setup, light=light)
    yield replace(setup, world=world)
    yield replace(setup, view=view)
    yield replace(setup, world=world, view=view, light=light)


def rotation_order(setup: Setup) -> Iterator[Setup]:
    """Multiply rotations in every other order."""
    world = _standard(setup.world)
    if world is not None:
        for order in permutations(AXES):
            yield replace(setup, world=replace(world, order="".join(order)))
    if setup.view.angles is not None:
        for view in _reordered_views(setup.view, setup.view.angles):
            yield replace(setup, view=view)


def rotation_sign(setup: Setup) -> Iterator[Setup]:
    """Turn some of the angles the other way."""
    world, angles = setup.world, setup.view.angles
    if world.matrix is None and world.quaternion is not None:
        x, y, z, w = world.quaternion
        yield replace(setup, world=replace(world, quaternion=(-x, -y, -z, w)))
    elif world.matrix is None:
        for turned in _signs(world.rotate_degrees):
            yield replace(setup, world=replace(world, rotate_degrees=turned))
    if angles is not None:
        for turned in _signs((angles.elevation, angles.angle, angles.roll)):
            yield replace(setup, view=replace(setup.view, angles=FirstPerson(*map(float, turned))))


def polimi_angles_swapped(setup: Setup) -> Iterator[Setup]:
    """Take angles by another convention than the one asked for."""
    world, view = setup.world, setup.view
    if world.matrix is None and world.quaternion is None:
        for convention in Convention:
            yield replace(setup, world=replace(world, convention=convention, order="XYZ"))
    if view.angles is not None:
        up, sideways, roll = view.angles.elevation, view.angles.angle, view.angles.roll
        for convention in Convention:
            for angles in (view.angles, FirstPerson(sideways, up, roll)):
                yield replace(setup, view=replace(view, convention=convention, angles=angles))


def _radians_world(world: World) -> World:
    if world.matrix is not None:
        return world
    return replace(world, rotate_degrees=_radians(world.rotate_degrees))


def _radians_view(view: View) -> View:
    if view.angles is None:
        return view
    angles = (view.angles.elevation, view.angles.angle, view.angles.roll)
    return replace(view, angles=FirstPerson(*map(float, _radians(angles))))


def _radians(values: Vector) -> Vector:
    """Convert radians to degrees."""
    return tuple(degrees(float(value)) for value in values)


def _signs(values: Vector) -> Iterator[Vector]:
    """Choose signs in every way but the given one; a zero has no sign."""
    choices = [(value, -value) if value else (value,) for value in values]
    yield from list(product(*choices))[1:]


def _standard(world: World) -> World | None:
    """Describe a world in the standard convention, if three angles describe it."""
    if world.matrix is not None or world.quaternion is not None:
        return None
    x, y, z = world.rotate_degrees
    turned: dict[Convention, tuple[Number, ...]] = {
        Convention.STANDARD: (x, y, z),
        Convention.POLIMI: (y, -x, -z),
        Convention.POLIMI_ASSIGNMENTS: (y, x, z),
    }
    return replace(world, rotate_degrees=turned[world.convention], convention=Convention.STANDARD)


def _reordered_views(view: View, angles: FirstPerson) -> Iterator[View]:
    sideways = Angle.degrees(angles.angle)
    turns = {
        "Z": -Angle.degrees(angles.roll),
        "X": -Angle.degrees(angles.elevation),
        "Y": sideways if view.convention is Convention.POLIMI else -sideways,
    }
    about = {axis: rotation_about(axis, turn) for axis, turn in turns.items()}
    eye = rational_matrix((view.eye,))[0]
    for order in permutations("ZXY"):
        turned = exact.product(*(about[axis] for axis in order))
        moved = apply(turned, eye)
        yield View(matrix=affine_matrix(turned, tuple(-x for x in moved)))
