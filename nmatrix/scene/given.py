"""What was given by name, over what stands already: worlds, views, lenses and lights.

The names are those of the command line's options in snake case, so the shell, once it has read its
words as numbers, and Python speak of the same things and are refused in the same sentences. Each
name replaces its own part of the base (the usual value, or a scene's); another way to give a part
(two angles for a target, a matrix for its parts) replaces the old way.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any

from nmatrix.enums import Convention, DepthRange, Handedness, chosen
from nmatrix.errors import IllegalValueError, did_you_mean, quantity
from nmatrix.linear.measured_lens import Intrinsics, SideAngles
from nmatrix.linear.projection import (
    CLIP_PARTS,
    check_aspect,
    clip_space,
    clip_space_over,
)
from nmatrix.linear.values import WHOLE, contradiction
from nmatrix.scene.camera import AIM, ANGLES, MEASURED, FirstPerson, View
from nmatrix.scene.lens import EXCLUDES, SHAPES, TWO_SHAPES, Lens, measured_lens
from nmatrix.scene.measured_view import Pose, measured_view
from nmatrix.scene.setup import Light
from nmatrix.scene.world import World

Given = Mapping[str, Any]

WHOLE_TURNS = ("quaternion", "axis_angle")  # a rotation without an order
PARTS = ("translate", "rotate", *WHOLE_TURNS, "scale", "shear")
SHAPE = (*SHAPES, "near", "far")
_UNMEASURED = {"fov", "ortho", "frustum"}  # each takes the place of a measured lens
LIGHT = ("light_direction", "light_angles", "light_position")


def world_of(given: Given, base: World | None = None) -> World:
    """Make a world of what was given; what was not is as in the base.

    Raises
    ------
    IllegalValueError
        For a name that is unknown, a value that is illegal, or two that contradict each other.

    Examples
    --------
    >>> world_of({"scale": (1, 2, 1)}, World(translate=(5, 0, 0))).world_from_object[0][3]
    Fraction(5, 1)
    >>> world_of({"scale": (1, 2, 1), "world_matrix": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]})
    Traceback (most recent call last):
    nmatrix.errors.IllegalValueError: world_matrix with scale: the matrix is the whole answer; ...
    """
    found = _known(given, (*PARTS, "order", "convention", "world_matrix"), "world")
    refuse_together("world_matrix", PARTS, found, WHOLE)
    refuse_together("quaternion", ("rotate", "axis_angle"), found, "both are the rotation")
    refuse_together("axis_angle", ("rotate",), found, "both are the rotation")
    for whole in WHOLE_TURNS:
        if whole in found and "order" in found:
            beside = f"{quantity(whole)} with {quantity('order')}"
            in_order = (
                f"{quantity('world_matrix')} MATRIX with an order tells the angles of any turn"
            )
            raise IllegalValueError(beside, "an order is for angles, it has none", in_order)
    convention = chosen(Convention, found.get("convention", Convention.STANDARD), "convention")
    if convention is not Convention.STANDARD and "order" in found:
        course = f"{quantity('convention')} {convention}"
        raise contradiction(course, ["order"], "the course fixes the order")
    if "world_matrix" in found:
        found["matrix"] = found.pop("world_matrix")
        return World(**found)
    base = base or World()
    if base.matrix is not None:
        if not found.keys() & set(PARTS):
            return replace(base, **found)
        base = World()
    if "rotate" in found:
        found |= {"rotate_degrees": found.pop("rotate"), **dict.fromkeys(WHOLE_TURNS)}
    elif found.keys() & set(WHOLE_TURNS):
        angles = {"rotate_degrees": (0, 0, 0), "convention": Convention.STANDARD}
        found = {**dict.fromkeys(WHOLE_TURNS), **angles, **found, "order": "XYZ"}
    elif "order" in found and (base.quaternion or base.axis_angle):
        beside = f"{quantity('order')} with the scene's rotation as a whole"
        raise IllegalValueError(beside, "an order is for angles", "keep one of them")
    return replace(base, **found)


def view_of(given: Given, base: View | None = None) -> View:
    """Make a view of what was given; what was not is as in the base.

    Examples
    --------
    >>> view_of({"eye": (1, 2, 3), "handed": "left"}).eye
    (1, 2, 3)
    """
    parts = ("eye", *AIM, *ANGLES)
    names = (*parts, "handed", "convention", "view_matrix", *MEASURED, "pose_axes")
    found, base = _known(given, names, "view"), base or View()
    refuse_together("view_matrix", (*parts, *MEASURED), found, WHOLE)
    refuse_together("extrinsics", (*parts, "pose", "pose_axes"), found, WHOLE)
    refuse_together("pose", parts, found, WHOLE)
    if "view_matrix" in found:
        kept = {"handed": base.handed} | found
        return View(matrix=kept.pop("view_matrix"), **kept)
    if found.keys() & set(MEASURED):
        measured = {name: found.pop(name) for name in (*MEASURED, "pose_axes") if name in found}
        return View(measured=measured_view(measured, "view"), **found)
    if "pose_axes" in found:
        if not isinstance(base.measured, Pose):
            alone, why = quantity("pose_axes"), "it says how the axes of a pose point"
            raise IllegalValueError(alone, why, f"add {quantity('pose')} MATRIX")
        found["measured"] = replace(base.measured, axes=found.pop("pose_axes"))
    angles = {name: found.pop(name) for name in ANGLES if name in found}
    aimed = [name for name in AIM if name in found]
    if angles and aimed:
        raise contradiction(quantity(next(iter(angles))), aimed, "both say where to look")
    if aimed or angles or "eye" in found:
        found |= {"matrix": None, "measured": None}
    if aimed:
        found["angles"] = None
    elif angles:
        found["angles"] = replace(base.angles or FirstPerson(), **angles)
        base = replace(base, target=View.target, up=View.up)
    return replace(base, **found)


def lens_of(given: Given, base: Lens | None = None) -> Lens:
    """Make a lens of what was given; what was not is as in the base.

    Examples
    --------
    >>> lens_of({"api": "vulkan"}).clip.depth
    <DepthRange.ZERO_TO_ONE: 'zero-to-one'>
    """
    found = _known(given, (*SHAPE, *CLIP_PARTS, "api", "projection_matrix", "viewport"), "lens")
    base = base or Lens()
    refuse_together("projection_matrix", SHAPE, found, WHOLE)
    for way, others in EXCLUDES.items():
        refuse_together(way, others, found, TWO_SHAPES)
    if "projection_matrix" in found:
        return _given_lens({"viewport": base.viewport} | found)
    kept = ("aspect", "near", "far", "ortho", "frustum", "viewport")
    changed = {name: found[name] for name in kept if name in found}
    if "fov" in found:
        changed["fov_degrees"] = found["fov"]
    if found.keys() & set(SHAPES):
        measured = None if found.keys() & _UNMEASURED else base.measured
        if "aspect" in found and isinstance(measured, Intrinsics | SideAngles):
            measured = None  # it had an aspect of its own
        shape = {"ortho": None, "frustum": None, "matrix": None}
        changed = shape | changed | {"measured": measured_lens(found, measured)}
    lens = replace(base, clip=clip_space_over(base.clip, found), **changed)
    if "aspect" in found:
        check_aspect(lens.aspect_ratio)
    return lens


def _given_lens(found: Given) -> Lens:
    """Make a lens of a matrix, of which an interface or parts of its clip space may be said."""
    lens = Lens(matrix=found["projection_matrix"], viewport=found.get("viewport"))
    clip = clip_space_over(lens.clip, found)
    said = CLIP_PARTS if "api" in found else tuple(name for name in CLIP_PARTS if name in found)
    depths = {one.depth for one in lens.readings}
    if "api" in found and "depth" not in found and depths == {DepthRange.REVERSED}:
        clip = replace(clip, depth=DepthRange.REVERSED)  # an interface, used the other way round
    if not said:
        return lens
    try:
        return replace(lens, clip=clip, said=said)
    except IllegalValueError as error:
        if "api" not in found:
            raise
        what, why, next_step = error.parts
        told = f"{quantity('api')} {found['api']}: {what}"
        raise IllegalValueError(told, why, next_step) from None


def hand_of(lens: Given) -> Handedness | None:
    """Find the hand that a lens asks for: it is the view's too.

    It is named, or its interface's, or that of a matrix which says so itself.
    """
    if lens.get("projection_matrix") is not None:
        return _given_lens(lens).clip.handed
    if lens.get("handed") is not None:
        return chosen(Handedness, lens["handed"], "handed")
    return None if lens.get("api") is None else clip_space(lens["api"], "api").handed


def light_of(given: Given, base: Light | None = None) -> Light:
    """Make a light of what was given; what was not is as in the base.

    Examples
    --------
    >>> light_of({"light_position": (2, 2, 8)}).position
    (2, 2, 8)
    """
    found, base = _known(given, LIGHT, "light"), base or Light()
    refuse_together("light_direction", ("light_angles",), found, "both are the direction")
    direction, angles = found.get("light_direction"), found.get("light_angles")
    if direction is None and angles is None:
        direction, angles = base.direction, base.angles_degrees
    return Light(direction, angles, found.get("light_position", base.position))


def refuse_together(name: str, others: Iterable[str], given: Given, because: str) -> None:
    """Refuse a name beside any of the others, if both were given."""
    beside = [one for one in others if one in given]
    if name in given and beside:
        raise contradiction(quantity(name), beside, because)


def _known(given: Given, names: tuple[str, ...], what: str) -> dict[str, Any]:
    """Refuse a name that is unknown, and drop what is None: it was not given."""
    if not isinstance(given, Mapping):
        raise IllegalValueError(
            f"{what} ({type(given).__name__})",
            "it is described by names and values",
            f"give a dict of {', '.join(names)}",
        )
    for name in given:
        if name not in names:
            raise IllegalValueError(
                f"{what} ({str(name)[:40]})",
                "it has no such part",
                did_you_mean(str(name), names, f"the parts are {', '.join(names)}"),
            )
    return {name: value for name, value in given.items() if value is not None}
