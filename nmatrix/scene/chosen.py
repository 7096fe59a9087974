"""One object and one light of a scene, and the setup that they make with its camera."""

from __future__ import annotations

from dataclasses import replace

from nmatrix.errors import IllegalValueError, did_you_mean, printable, quantity, shortlist
from nmatrix.linear.rational import ONE, ZERO, RationalMatrix, apply, inverse, rational_vector
from nmatrix.linear.values import text
from nmatrix.scene.camera import View
from nmatrix.scene.light import EYE, WORLD, SceneLight
from nmatrix.scene.scene import Scene, SceneObject
from nmatrix.scene.setup import Light, Setup
from nmatrix.scene.world import World


def setup_of(scene: Scene, object_name: str | None = None, light_name: str | None = None) -> Setup:
    """Return one object under one of the lights: those that are named, else the first.

    Raises
    ------
    IllegalValueError
        For a name that the scene does not have.
    """
    one, light = chosen_object(scene, object_name), chosen_light(scene, light_name)
    return in_the_scene(setup_before(scene, one), scene, one, light)


def setup_before(scene: Scene, one: SceneObject, aspect: float | None = None) -> Setup:
    """Return an object in its parent's frame with the camera: what options may still change.

    `aspect` is that of the picture, where it has one; a scene's own wins.
    """
    free = aspect is not None and not scene.has_aspect
    return Setup(
        World(matrix=one.world_from_object) if one.place is None else one.place,
        scene.view,
        replace(scene.lens, aspect=aspect) if free and aspect else scene.lens,
        space_matrix=scene.settings.space_matrix,
    )


def in_the_scene(setup: Setup, scene: Scene, one: SceneObject, light: SceneLight | None) -> Setup:
    """Put the object under its parent, and the scene's light in its place."""
    world = setup.world
    if one.world_from_parent is not None:
        under = world.under(one.world_from_parent)
        world = replace(under, matrix=under.world_from_object)
    placed = light_in_world(scene, one, light, setup.view, world)
    return replace(setup, world=world, light=placed or setup.light)


def chosen_object(scene: Scene, name: str | None) -> SceneObject:
    """Return the object of a name, or the first."""
    if name is None:
        return scene.objects[0]
    name = text(name, "object")
    for one in scene.objects:
        if one.name == name:
            return one
    raise _unknown(scene, "object", name, [one.name for one in scene.objects])


def chosen_light(scene: Scene, name: str | None) -> SceneLight | None:
    """Return the light of a name, or the first that comes from somewhere, if there is one."""
    placed = [one for one in scene.lights if one.has_position or one.has_direction]
    if name is None:
        return placed[0] if placed else None
    name = text(name, "light")
    for one in placed:
        if one.name == name:
            return one
    if name in [one.name for one in scene.lights]:
        raise IllegalValueError(
            f"{quantity('light')} ({name[:40]})",
            "ambient light has neither a direction nor a position",
            "name another light",
        )
    raise _unknown(scene, "light", name, [one.name for one in placed])


def light_in_world(
    scene: Scene, one: SceneObject, light: SceneLight | None, view: View, world: World
) -> Light | None:
    """Return a light in world space, whatever it is fixed to: the world, the eye, an object.

    `view` and `world` are where the eye and the object `one` are, which options may have moved.
    """
    if light is None:
        return None
    found = Light(
        light.direction if light.has_direction else None,
        position=light.position if light.has_position else None,
    )
    if light.fixed_to == WORLD:
        return found
    if light.fixed_to == EYE:
        return _carried(found, inverse(view.placed().camera_from_world))
    if light.fixed_to == one.name:
        return _carried(found, world.world_from_object)
    homes = {other.name: other.world_from_object for other in scene.objects}
    return _carried(found, homes[light.fixed_to])


def _carried(light: Light, world_from_home: RationalMatrix) -> Light:
    """Return a light moved into world space, exactly."""
    position, direction = light.position, light.direction
    if position is not None:
        position = apply(world_from_home, (*rational_vector(position), ONE))[:3]
    if direction is not None:
        direction = apply(world_from_home, (*rational_vector(direction), ZERO))[:3]
    return replace(light, direction=direction, position=position)


def _unknown(scene: Scene, what: str, name: str, names: list[str]) -> IllegalValueError:
    return IllegalValueError(
        f"{quantity(what)} ({name[:40]})",
        f"{scene.path} has no {what} of this name",
        f"{did_you_mean(name, names, '')} there are {shortlist(map(printable, names))}".strip(),
    )
