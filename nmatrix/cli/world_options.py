"""The World and Light groups: the object and what lights it, each option declared once."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from itertools import chain, permutations
from typing import Annotated, Any

from typer import Option

from nmatrix.cli.shared_options import (
    ConventionOption,
    OptionGroup,
    ReadNumbers,
    among,
    option_name,
)
from nmatrix.cli.sources import Sources
from nmatrix.reading.numbers import fractions, number_words, numbers, spread
from nmatrix.scene.given import light_of, world_of
from nmatrix.scene.setup import Setup
from nmatrix.scene.world import World

in_world = partial(Option, rich_help_panel="World")
in_light = partial(Option, rich_help_panel="Light")

OrderOption = Annotated[
    str | None,
    in_world(
        metavar="ORDER",
        help="A permutation of XYZ (intrinsic) or xyz (extrinsic).",
        autocompletion=among([*map("".join, chain(*map(permutations, ("XYZ", "xyz"))))]),
    ),
]


@dataclass(frozen=True)
class WorldOptions(OptionGroup):
    """Where the object stands."""

    translate: Annotated[str | None, in_world(metavar="X Y Z", help="Move.")] = None
    rotate: Annotated[
        str | None, in_world(metavar="X Y Z", help="Turn about x, y, z, in degrees.")
    ] = None
    quaternion: Annotated[
        str | None, in_world(metavar="X Y Z W", help="Turn by a quaternion instead.")
    ] = None
    axis_angle: Annotated[
        str | None,
        in_world(metavar="X Y Z ANGLE", help="Turn about one axis instead."),
    ] = None
    scale: Annotated[str | None, in_world(metavar="S|X Y Z", help="Stretch.")] = None
    shear: Annotated[
        str | None, in_world(metavar="XY XZ YZ", help="Shear x along y, x along z, y along z.")
    ] = None
    order: OrderOption = None
    convention: ConventionOption = None
    world_matrix: Annotated[
        str | None, in_world(metavar="MATRIX", help="The whole matrix instead.")
    ] = None

    def override(self, setup: Setup, sources: Sources) -> Setup:
        """Put the typed options in place of the setup's own world."""
        return replace(setup, world=self.over(setup.world, sources))

    def over(self, base: World, sources: Sources, read: ReadNumbers = numbers) -> World:
        """Override the parts of a world.

        `read` makes each number the nearest float64, or with `fractions` keeps it as typed.

        Examples
        --------
        >>> base = World(translate=(1, 0, 0), scale=(2, 2, 2))
        >>> found = WorldOptions(scale="1 2 1").over(base, Sources())
        >>> found.translate, found.scale
        ((1, 0, 0), (1.0, 2.0, 1.0))
        """
        sized = self if self.scale is None else replace(self, scale=spread(self.scale, 3))
        given = sized.numbers(read, translate=3, quaternion=4, scale=3, shear=3)
        given |= self.degrees(sources, read, rotate=3)
        given |= self.axis_and_angle(sources, read)
        given |= self.typed("order", "convention")
        if self.world_matrix is not None:
            matrix = sources.affine(self.world_matrix, exact=read is fractions)
            given["world_matrix"] = matrix
        return world_of(given, base)

    def axis_and_angle(self, sources: Sources, read: ReadNumbers) -> dict[str, Any]:
        """Read the axis and the angle that were typed; the angle alone has a unit."""
        if self.axis_angle is None:
            return {}
        name, words = "axis_angle", number_words(self.axis_angle)
        if len(words) != 4:
            return self.numbers(read, axis_angle=4)  # which refuses them
        turned = type(self)(axis_angle=words[3]).degrees(sources, read, axis_angle=1)
        return {name: (*read(" ".join(words[:3]), 3, option_name(name)), turned[name])}


@dataclass(frozen=True)
class LightOptions(OptionGroup):
    """The light."""

    light_direction: Annotated[
        str | None, in_light(metavar="X Y Z", help="Where light travels (-1 -1 -1).")
    ] = None
    light_angles: Annotated[
        str | None, in_light(metavar="ALPHA BETA", help="The same by two angles.")
    ] = None
    light_position: Annotated[str | None, in_light(metavar="X Y Z", help="Where a lamp is.")] = None

    def override(self, setup: Setup, sources: Sources) -> Setup:
        """Put the typed options in place of the setup's own light."""
        given = self.numbers(light_direction=3, light_position=3)
        given |= self.degrees(sources, light_angles=2)
        return replace(setup, light=light_of(given, setup.light))
