"""Options over a scene: each replaces its own key, an alternative the whole alternative.

The groups have refused what contradicts itself on the command line; here only what was typed is
laid over what the scene says.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any

from nmatrix.cli.alternatives import refuse_together
from nmatrix.cli.camera_options import LensOptions, ViewOptions
from nmatrix.cli.world_options import WorldOptions
from nmatrix.enums import API_PRESETS, Convention
from nmatrix.linear.projection import ClipSpace
from nmatrix.report import Number
from nmatrix.scene.camera import FirstPerson, View
from nmatrix.scene.lens import Lens
from nmatrix.scene.scene import SceneObject
from nmatrix.scene.setup import Light
from nmatrix.scene.world import World


def world_over(one: SceneObject, options: WorldOptions, typed: World) -> World:
    """Return the object's place in the world, with what was typed in place of its own.

    Examples
    --------
    >>> from nmatrix.scene.words import Shape
    >>> from nmatrix.scene.geometry import ShapeGeometry
    >>> place = World(translate=(1, 0, 0), scale=(2, 2, 2))
    >>> one = SceneObject("a", ShapeGeometry(Shape.BOX), place.world_from_object, place=place)
    >>> typed = WorldOptions(scale="1 2 1")
    >>> found = world_over(one, typed, World(scale=(1, 2, 1)))
    >>> found.translate, found.scale
    ((1, 0, 0), (1, 2, 1))
    """
    if options.world_matrix is not None:
        return typed
    own = World(matrix=one.world_from_object) if one.place is None else one.place
    if options.is_given or options.convention is not None:
        own = _place_over(own, options, typed)
    if one.world_from_parent is None:
        return own
    under = own.under(one.world_from_parent)
    return replace(under, matrix=under.world_from_object)


def _place_over(own: World, options: WorldOptions, typed: World) -> World:
    if own.matrix is not None:
        return typed if options.is_given else own
    changed: dict[str, Any] = {
        name: getattr(typed, name)
        for name in ("translate", "scale", "shear", "order", "convention")
        if getattr(options, name) is not None
    }
    if options.rotate is not None:
        changed |= {"rotate_degrees": typed.rotate_degrees, "quaternion": None}
    elif options.quaternion is not None:
        turned = {"quaternion": typed.quaternion, "rotate_degrees": (0, 0, 0), "order": "XYZ"}
        changed |= {"convention": Convention.STANDARD} | changed | turned
    elif own.quaternion is not None and options.order is not None:
        refuse_together("--order", {"the scene's quaternion": own}, "an order is for angles")
    return replace(own, **changed)


def as_typed(place: World) -> World:
    """Return a place with every number as a person writes it: 0.1 is a tenth."""
    return replace(
        place,
        translate=tuple(map(_decimal, place.translate)),
        rotate_degrees=tuple(map(_decimal, place.rotate_degrees)),
        quaternion=None if place.quaternion is None else tuple(map(_decimal, place.quaternion)),
        scale=tuple(map(_decimal, place.scale)),
        shear=tuple(map(_decimal, place.shear)),
    )


def _decimal(value: Number) -> Fraction:
    return Fraction(str(value))


def view_over(scene: View, options: ViewOptions, typed: View) -> View:
    """Return the scene's view with what was typed in place of its own."""
    if options.view_matrix is not None:
        return typed if options.handed is not None else replace(typed, handed=scene.handed)
    changed: dict[str, Any] = {
        name: getattr(typed, name)
        for name in ("eye", "target", "up", "handed", "convention")
        if getattr(options, name) is not None
    }
    if options.target is not None or options.up is not None:
        changed |= {"angles": None, "matrix": None}
    elif typed.angles is not None:
        changed |= {"angles": _angles_over(scene, options, typed.angles), "matrix": None}
    elif options.eye is not None:
        changed |= {"matrix": None}
    return replace(scene, **changed)


def _angles_over(scene: View, options: ViewOptions, typed: FirstPerson) -> FirstPerson:
    given = {
        name: getattr(typed, name)
        for name in ("elevation", "angle", "roll")
        if getattr(options, name) is not None
    }
    return replace(scene.angles or FirstPerson(), **given)


def lens_over(scene: Lens, options: LensOptions, typed: Lens) -> Lens:
    """Return the scene's lens with what was typed in place of its own."""
    clip = _clip_over(scene.clip, options)
    if options.projection_matrix is not None:
        return replace(typed, clip=clip)
    changed: dict[str, Any] = {
        name: getattr(typed, name)
        for name in ("aspect", "near", "far")
        if getattr(options, name) is not None
    }
    if options.fov is not None:
        changed["fov_degrees"] = typed.fov_degrees
    if options.fov is not None or options.aspect is not None:
        changed |= {"ortho": None, "frustum": None, "matrix": None}
    elif options.ortho is not None or options.frustum is not None:
        changed |= {"ortho": typed.ortho, "frustum": typed.frustum, "matrix": None}
    return replace(scene, clip=clip, **changed)


def _clip_over(scene: ClipSpace, options: LensOptions) -> ClipSpace:
    depth, handed, clip_y = (
        (scene.depth, scene.handed, scene.clip_y)
        if options.api is None
        else API_PRESETS[options.api]
    )
    return ClipSpace(options.depth or depth, options.handed or handed, options.clip_y or clip_y)


def light_over(scene: Light, typed: Light) -> Light:
    """Return the scene's light with what was typed in place of its own."""
    has_direction = typed.direction is not None or typed.angles_degrees is not None
    direction = typed if has_direction else scene
    return Light(
        direction.direction,
        direction.angles_degrees,
        scene.position if typed.position is None else typed.position,
    )
