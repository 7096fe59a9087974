"""One object and one light of a scene, and the setup that they make with its camera."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from shlex import quote

from nmatrix.errors import IllegalValueError, counted, did_you_mean, printable, quantity, shortlist
from nmatrix.linear.rational import ONE, ZERO, RationalMatrix, apply, inverse, rational_vector
from nmatrix.linear.values import text
from nmatrix.scene.light import EYE, WORLD, SceneLight
from nmatrix.scene.scene import Scene, SceneNode, SceneObject
from nmatrix.scene.setup import Light, Setup
from nmatrix.scene.words import Mover
from nmatrix.scene.world import World

Placed = SceneObject | SceneNode
MOST_NAMED = 5  # nodes that a refusal names


def setup_of(scene: Scene, object_name: str | None = None, light_name: str | None = None) -> Setup:
    """Take an object and a light of a scene, by name or the first, with its camera.

    Raises
    ------
    IllegalValueError
        For a name that the scene does not have.
    """
    one, light = chosen_node(scene, object_name), chosen_light(scene, light_name)
    return in_the_scene(setup_before(scene, one), scene, one, light)


def setup_before(scene: Scene, one: Placed, aspect: float | None = None) -> Setup:
    """Take an object as it stands under its parent, and the camera: both may still be changed.

    `aspect` is that of the picture, where it has one; a scene's own wins.
    """
    lens = scene.lens if aspect is None else scene.lens_for(aspect)
    return Setup(
        World(matrix=one.world_from_object) if one.place is None else one.place,
        scene.view,
        lens,
        space_matrix=scene.settings.space_matrix,
    )


def in_the_scene(setup: Setup, scene: Scene, one: Placed, light: SceneLight | None) -> Setup:
    """Put the object under its parent, and the scene's light in its place."""
    if one.world_from_parent is not None:
        under = setup.world.under(one.world_from_parent)
        setup = replace(setup, world=replace(under, matrix=under.world_from_object))
    return setup if light is None else replace(setup, light=_in_world(setup, scene, one, light))


def chosen_node(scene: Scene, name: str | None) -> Placed:
    """Find the object or the node that a name or a path means, or take the first that is drawn.

    Raises
    ------
    IllegalValueError
        If there is none, or there are several.
    """
    if name is None:
        if not scene.objects and not scene.nodes:
            raise IllegalValueError(f"{scene.path}", "it has no nodes", "export it again")
        return scene.objects[0] if scene.objects else scene.nodes[0]
    name = text(name, "object")
    named = next((one for one in scene.objects if one.name == name), None)
    meant = scene.hierarchy.meant(name)
    if len(meant) == 1:  # joints and instances place a node's triangles elsewhere
        node = scene.nodes[meant[0]]
        is_there = named is not None and named.world_from_object == node.world_from_object
        return named if named is not None and is_there else node
    if named is not None:
        return named
    addresses = scene.hierarchy.addresses
    if meant:
        raise IllegalValueError(
            f"{quantity('object')} ({printable(name)})",
            f"it means {len(meant)} nodes of {scene.path}",
            f"take one of {shortlist([_typed(addresses[i]) for i in meant], MOST_NAMED)}",
        )
    names = dict.fromkeys((*(one.name for one in scene.objects), *addresses))
    raise _unknown(scene, "object", name, list(names))


def told_of(scene: Scene, one: Placed, *, is_named: bool, is_changed: bool) -> Iterator[str]:
    """Name the node that an answer is of, and what carries it or its mesh beside its matrix.

    `is_named` tells that a person named it, `is_changed` that its place was given beside it.
    """
    index = _index(scene, one)
    path = one.name if index is None else scene.hierarchy.called(index)
    told = f"Of node {path if path.isprintable() else repr(path)}"
    if is_changed:
        told += ", with what was given in place of its own"
    drawn = {id(other) if other.node is None else other.node for other in scene.objects}
    others = len(drawn or scene.nodes) - 1
    if not is_named and others:
        told += f", the first of {others + 1}: {quantity('object')} names another"
    yield f"{told}."
    for mover in () if index is None else scene.nodes[index].movers:
        yield _OF_MOVERS[mover]


_OF_MOVERS = {
    Mover.JOINTS: "Skinned: joints carry its mesh, not its own matrix; inspect judges them.",
    Mover.INSTANCES: "Instanced: this is its own matrix; inspect judges that of each instance.",
    Mover.ANIMATION: "Animated, it or a node above: this is at rest; inspect judges scales' keys.",
}


def _index(scene: Scene, one: Placed) -> int | None:
    if isinstance(one, SceneObject) and one.node is not None:
        return one.node
    if isinstance(one, SceneObject):
        meant = scene.hierarchy.meant(one.name)
        return meant[0] if len(meant) == 1 else None
    return next((i for i, node in enumerate(scene.nodes) if node is one), None)


def drawn_alone(scene: Scene, name: str) -> Scene:
    """Leave one node in a scene, with what hangs below it; lights and camera stay as they are.

    The name of one piece or one instance of a node leaves that alone. A remark counts the rest.

    Raises
    ------
    IllegalValueError
        For a name that the scene does not have, or of a node without triangles.

    Examples
    --------
    >>> from nmatrix.samples import file_or_sample
    >>> from nmatrix.scene.open import scene_of
    >>> alone = drawn_alone(scene_of(file_or_sample("sample")), "forearm")
    >>> [one.name for one in alone.objects]
    ['forearm', 'hand']
    """
    one = chosen_node(scene, name)
    kept = [other for other in scene.objects if other is one]
    if (meant := scene.hierarchy.meant(name)) and len(meant) == 1:
        below = scene.hierarchy.below(meant[0])
        kept = [other for other in scene.objects if other.node in below]
    if not kept:
        raise IllegalValueError(
            f"{quantity('object')} ({printable(name)})",
            "neither it nor what hangs below it has triangles",
            "name a node that has a mesh",
        )
    rest = len(scene.objects) - len(kept)
    told = f"{printable(name)} is drawn alone, without {counted(rest, 'other object')} of the file."
    return replace(
        scene,
        objects=tuple(kept),
        lights=tuple(_free(light, scene) for light in scene.lights),
        remarks=(*scene.remarks, told) if rest else scene.remarks,
    )


def _free(light: SceneLight, scene: Scene) -> SceneLight:
    """Fix a light to the world where the object that carries it has put it."""
    if light.fixed_to in (WORLD, EYE):
        return light
    homes = {other.name: other.world_from_object for other in scene.objects}
    there = _carried(Light(light.direction, position=light.position), homes[light.fixed_to])
    return replace(
        light,
        direction=there.direction or light.direction,
        position=there.position or light.position,
        fixed_to=WORLD,
    )


def chosen_light(scene: Scene, name: str | None) -> SceneLight | None:
    """Find the light of a name, or take the first that comes from somewhere, if there is one."""
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


def _in_world(setup: Setup, scene: Scene, one: Placed, light: SceneLight) -> Light:
    """Bring a light into world space from what it is fixed to: the eye, this object, another."""
    found = Light(
        light.direction if light.has_direction else None,
        position=light.position if light.has_position else None,
    )
    if light.fixed_to == WORLD:
        return found
    if light.fixed_to == EYE:
        return _carried(found, inverse(setup.camera.camera_from_world))
    homes = {other.name: other.world_from_object for other in scene.objects}
    homes[one.name] = setup.world.world_from_object  # it may have been moved
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
    known = shortlist(map(_typed, names)) or "none"
    return IllegalValueError(
        f"{quantity(what)} ({name[:40]})",
        f"{scene.path} has no {what} of this name",
        f"{did_you_mean(name, names, '', _typed)} there are {known}".strip(),
    )


def _typed(name: str) -> str:
    """Write a name as a shell takes it: # begins a comment there, and blanks part words."""
    return quote(name) if name == printable(name) else printable(name)
