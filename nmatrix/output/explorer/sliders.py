"""Where the explorer's sliders stand: from a setup to their names and numbers, and back.

A slider has one letter and an axis: s scale (without its sign), m mirrored (0 or 1), r degrees of
a turn, t translation, l the light's direction, p its place; h with two axes is a shear.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace

from nmatrix.enums import NormalRule, Space
from nmatrix.errors import NoAnswerError, quantity
from nmatrix.linear.decompose import parts
from nmatrix.report import Number
from nmatrix.scene.setup import Light, Setup
from nmatrix.scene.world import World

AXES, SHEARS = "xyz", ("xy", "xz", "yz")
DOWNWARDS = (0, -1, 0)  # where the sliders stand for a light without a direction
FROM_ABOVE = (3.6, 1.5, 9.2)  # the page comes as near as the body lets it
LONG_LENS = 30.0  # degrees; a short one bends a ball near the rim
FROM_THE_RIGHT = Light((-0.85, -0.55, -0.65))  # both a lit and a dark side are seen
LARGEST = 1e6  # what a slider's number may be up to
STRETCHED = World(scale=(1, 2, 1))  # without a stretch every rule is right, and nothing is seen

Sliders = dict[str, float | str]


def first_look(setup: Setup, given: Iterable[str] = ()) -> Setup:
    """Put the parts that were not given where there is something to see.

    Examples
    --------
    >>> first_look(Setup(), given=("light",)).world.scale
    (1, 2, 1)
    """
    usual = {
        "world": STRETCHED,
        "view": replace(setup.view, eye=FROM_ABOVE),
        "lens": replace(setup.lens, fov_degrees=LONG_LENS),
        "light": FROM_THE_RIGHT,
    }
    kept = set(given)
    return replace(setup, **{name: part for name, part in usual.items() if name not in kept})  # type: ignore[arg-type]  # each name has its part


def start(setup: Setup) -> Sliders:
    """Place the sliders for a setup.

    Raises
    ------
    NoAnswerError
        If the world matrix is singular and not given by its parts: sliders cannot show it.

    Examples
    --------
    >>> found = start(Setup(World(scale=(-1, 2, 1))))
    >>> found["sx"], found["mx"], found["sy"], found["ty"]
    (1.0, 1, 2.0, 0.0)
    """
    direction = floats(setup.maps.light.direction or DOWNWARDS)
    lamp = floats(setup.maps.light.position or (0, 0, 0))
    found: Sliders = {"rule": NormalRule.NONE.value, "space": Space.WORLD.value}
    found |= sliders_of(setup.world)
    for axis, d, p in zip(AXES, direction, lamp, strict=True):
        found |= {f"l{axis}": d, f"p{axis}": p}
    return found


def sliders_of(world: World) -> Sliders:
    """Place the sliders of an object's place in the world.

    Raises
    ------
    NoAnswerError
        If its matrix is singular and not given by its parts.
    """
    plain = World(world.translate, world.rotate_degrees, None, world.scale, world.shear)
    taken = plain if world == plain else parts(world.world_from_object)
    if taken is None:
        raise NoAnswerError(
            "world matrix (determinant 0)",
            "sliders cannot show a singular matrix that is not given by its parts",
            f"give {quantity('scale')} with a 0 in it",
        )
    turned = taken.rotate_degrees if isinstance(taken, World) else taken.rotate
    place = floats(row[3] for row in world.exact[:3])
    found: Sliders = dict(zip((f"h{pair}" for pair in SHEARS), floats(taken.shear), strict=True))
    for axis, s, r, t in zip(AXES, floats(taken.scale), floats(turned), place, strict=True):
        found |= {f"s{axis}": abs(s), f"m{axis}": int(s < 0), f"r{axis}": r, f"t{axis}": t}
    return found


def world_of(sliders: Mapping[str, float | str]) -> World:
    """Build the world in which the sliders stand.

    Examples
    --------
    >>> turned = World(rotate_degrees=(0, 30, 0), scale=(1, -2, 1))
    >>> world_of(sliders_of(turned)) == turned
    True
    """
    at = {key: float(value) for key, value in sliders.items() if key not in ("rule", "space")}
    return World(
        translate=tuple(at[f"t{axis}"] for axis in AXES),
        rotate_degrees=tuple(at[f"r{axis}"] for axis in AXES),
        scale=tuple(-at[f"s{axis}"] if at[f"m{axis}"] else at[f"s{axis}"] for axis in AXES),
        shear=tuple(at[f"h{pair}"] for pair in SHEARS),
    )


def light_of(sliders: Mapping[str, float | str], light: Light) -> Light:
    """Move a light to where the sliders stand; it keeps to what it has, direction or place."""
    placed = light.placed()
    at = {letter: tuple(float(sliders[f"{letter}{a}"]) for a in AXES) for letter in "lp"}
    return Light(
        at["l"] if placed.direction is not None else None,
        None,
        at["p"] if placed.position is not None else None,
    )


def floats(values: Iterable[Number]) -> tuple[float, ...]:
    """Round numbers to floats."""
    return tuple(map(float, values))
