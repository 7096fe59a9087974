"""A world, a view, a lens and a light from what was given by name, contradictions refused.

The names are those of the command line's options in snake case, so the shell, once it has read its
words as numbers, and Python speak of the same things and are refused in the same sentences. What
was not given has its default; an alternative (two angles for a target, a matrix for its parts) may
not stand beside what it replaces.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any

from nmatrix.enums import API_PRESETS, Api, Convention, chosen
from nmatrix.errors import IllegalValueError, did_you_mean, quantity
from nmatrix.linear.projection import DEFAULT_CLIP_SPACE, ClipSpace, Window
from nmatrix.linear.values import vector
from nmatrix.scene.camera import FirstPerson, View
from nmatrix.scene.lens import Lens
from nmatrix.scene.setup import Light
from nmatrix.scene.world import World

Given = Mapping[str, Any]

WORLD = (
    "translate", "rotate", "quaternion", "scale", "shear", "order", "convention", "world_matrix"
)  # fmt: skip
VIEW = (
    "eye", "target", "up", "elevation", "angle", "roll", "handed", "convention", "view_matrix"
)  # fmt: skip
LENS = (
    "fov", "aspect", "near", "far", "ortho", "frustum", "depth", "handed", "clip_y", "api",
    "projection_matrix",
)  # fmt: skip
LIGHT = ("light_direction", "light_angles", "light_position")

WHOLE = "the matrix is the whole answer"
ANGLES = ("elevation", "angle", "roll")
CLIP = ("api", "depth", "handed", "clip_y")


def world_of(given: Given) -> World:
    """Return the world that these names describe.

    Raises
    ------
    IllegalValueError
        For a name that is unknown, a value that is illegal, or two that contradict each other.

    Examples
    --------
    >>> world_of({"scale": (1, 2, 1)}).world_from_object[1][1]
    Fraction(2, 1)
    >>> world_of({"scale": (1, 2, 1), "world_matrix": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]})
    Traceback (most recent call last):
    nmatrix.errors.IllegalValueError: world_matrix with scale: the matrix is the whole answer; ...
    """
    found = _known(given, WORLD, "world")
    refuse_together("world_matrix", WORLD[:6], found, WHOLE)
    refuse_together("quaternion", ("rotate",), found, "both are the rotation")
    refuse_together("quaternion", ("order",), found, "an order is for angles, it has none")
    convention = chosen(Convention, found.get("convention", Convention.STANDARD), "convention")
    if convention is not Convention.STANDARD and "order" in found:
        named = f"{quantity('convention')} {convention}"
        raise _contradiction(named, ("order",), "the course fixes the order")
    return World(**_fields(found, rotate="rotate_degrees", world_matrix="matrix"))


def view_of(given: Given) -> View:
    """Return the view that these names describe.

    Examples
    --------
    >>> view_of({"eye": (1, 2, 3), "handed": "left"}).eye
    (1, 2, 3)
    """
    found = _known(given, VIEW, "view")
    refuse_together("view_matrix", VIEW[:6], found, WHOLE)
    angles = {name: found.pop(name) for name in ANGLES if name in found}
    if not angles:
        return View(**_fields(found, view_matrix="matrix"))
    refuse_together(
        next(iter(angles)), ("target", "up"), {**found, **angles}, "both say where to look"
    )
    return View(angles=FirstPerson(**angles), **found)


def lens_of(given: Given, aspect: float = 1.0) -> Lens:
    """Return the lens that these names describe; `aspect` is that of the picture, if there is one.

    Examples
    --------
    >>> lens_of({"api": "vulkan"}).clip.depth
    <DepthRange.ZERO_TO_ONE: 'zero-to-one'>
    """
    found = _known(given, LENS, "lens")
    refuse_together("projection_matrix", LENS[:6], found, WHOLE)
    refuse_together("ortho", ("fov", "aspect", "frustum"), found, "both shape the view")
    refuse_together("frustum", ("fov", "aspect"), found, "both shape the view")
    clip = clip_space(found)
    shape = {name: found[name] for name in found if name not in CLIP}
    for name in ("ortho", "frustum"):
        if name in shape:
            shape[name] = Window(*map(float, vector(shape[name], 4, name)))
    return Lens(
        **{"aspect": aspect, **_fields(shape, fov="fov_degrees", projection_matrix="matrix")},
        clip=clip,
    )


def clip_space(given: Given, usual: ClipSpace = DEFAULT_CLIP_SPACE) -> ClipSpace:
    """Return an interface's clip space, or the usual one, under what was given by itself."""
    if "api" in given:
        usual = ClipSpace(*API_PRESETS[chosen(Api, given["api"], "api")])
    return replace(usual, **{name: given[name] for name in CLIP[1:] if name in given})


def light_of(given: Given) -> Light:
    """Return the light that these names describe.

    Examples
    --------
    >>> light_of({"light_position": (2, 2, 8)}).position
    (2, 2, 8)
    """
    found = _known(given, LIGHT, "light")
    refuse_together("light_direction", ("light_angles",), found, "both are the direction")
    fields = {"light_direction": "direction", "light_angles": "angles_degrees"}
    return Light(**_fields(found, **fields, light_position="position"))


def _known(given: Given, names: tuple[str, ...], what: str) -> dict[str, Any]:
    """Return what was given: None stands for nothing, as on the command line."""
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


def refuse_together(name: str, others: Iterable[str], given: Given, because: str) -> None:
    """Refuse a name beside any of the others."""
    beside = [one for one in others if one in given]
    if name in given and beside:
        raise _contradiction(quantity(name), beside, because)


def _contradiction(what: str, beside: Iterable[str], because: str) -> IllegalValueError:
    together = f"{what} with {', '.join(map(quantity, beside))}"
    return IllegalValueError(together, because, "keep one of them")


def _fields(given: Given, **renamed: str) -> dict[str, Any]:
    """Return what was given under the names of the value's fields."""
    return {renamed.get(name, name): value for name, value in given.items()}
