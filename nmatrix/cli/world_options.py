"""The World and Light groups: the object and what lights it, each option declared once."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated

from typer import Option

from nmatrix.cli.shared_options import (
    ConventionOption,
    OptionGroup,
    ReadNumbers,
    refuse_together,
)
from nmatrix.cli.sources import Sources
from nmatrix.enums import Convention
from nmatrix.reading.numbers import fractions, numbers
from nmatrix.scene.setup import Light, Setup
from nmatrix.scene.world import World

WORLD, LIGHT = "World", "Light"
PARTS = ("translate", "rotate", "quaternion", "scale", "shear", "order")


@dataclass(frozen=True)
class WorldOptions(OptionGroup):
    """Where the object stands."""

    translate: Annotated[
        str | None, Option(metavar="X Y Z", help="Move.", rich_help_panel=WORLD)
    ] = None
    rotate: Annotated[
        str | None,
        Option(metavar="X Y Z", help="Turn about x, y, z, in degrees.", rich_help_panel=WORLD),
    ] = None
    quaternion: Annotated[
        str | None,
        Option(metavar="X Y Z W", help="Turn by a quaternion instead.", rich_help_panel=WORLD),
    ] = None
    scale: Annotated[
        str | None, Option(metavar="X Y Z", help="Stretch.", rich_help_panel=WORLD)
    ] = None
    shear: Annotated[
        str | None,
        Option(
            metavar="XY XZ YZ", help="Shear x along y, x along z, y along z.", rich_help_panel=WORLD
        ),
    ] = None
    order: Annotated[
        str | None,
        Option(
            metavar="ORDER",
            help="A permutation of XYZ (intrinsic) or xyz (extrinsic).",
            rich_help_panel=WORLD,
        ),
    ] = None
    convention: ConventionOption = None
    world_matrix: Annotated[
        str | None,
        Option(metavar="MATRIX", help="The whole matrix instead.", rich_help_panel=WORLD),
    ] = None

    def override(self, setup: Setup, sources: Sources) -> Setup:
        """Put the typed options in place of the setup's own world."""
        return replace(setup, world=self.over(setup.world, sources))

    def over(self, base: World, sources: Sources, read: ReadNumbers = numbers) -> World:
        """Override the parts of a world; parts replace a whole matrix, a quaternion angles.

        `read` makes each number the nearest float64, or with `fractions` keeps it as typed.

        Raises
        ------
        IllegalValueError
            For options that exclude each other, or an order beside the base's quaternion.

        Examples
        --------
        >>> base = World(translate=(1, 0, 0), scale=(2, 2, 2))
        >>> found = WorldOptions(scale="1 2 1").over(base, Sources())
        >>> found.translate, found.scale
        ((1, 0, 0), (1.0, 2.0, 1.0))
        """
        self._refuse_contradictions()
        if self.world_matrix is not None:
            matrix = sources.affine(self.world_matrix, exact=read is fractions)
            return World(convention=self.convention or Convention.STANDARD, matrix=matrix)
        if base.matrix is not None:
            if not self.is_given:
                return base
            base = World()
        changed = self.numbers(read, translate=3, rotate=3, quaternion=4, scale=3, shear=3)
        changed |= self.typed("order", "convention")
        if self.rotate is not None:
            changed |= {"rotate_degrees": changed.pop("rotate"), "quaternion": None}
        elif self.quaternion is not None:
            angles = {"rotate_degrees": (0, 0, 0), "convention": Convention.STANDARD}
            changed = angles | changed | {"order": "XYZ"}
        elif base.quaternion is not None:
            others = {} if self.order is None else {"the scene's quaternion": base}
            refuse_together("--order", others, "an order is for angles")
        return replace(base, **changed)

    def _refuse_contradictions(self) -> None:
        if self.world_matrix is not None:
            refuse_together("--world-matrix", self.given(*PARTS), "the matrix is the whole answer")
        if self.quaternion is not None:
            refuse_together("--quaternion", self.given("rotate"), "both are the rotation")
            because = "an order is for angles, it has none"
            refuse_together("--quaternion", self.given("order"), because)
        if self.convention not in (None, Convention.STANDARD):
            course = f"--convention {self.convention}"
            refuse_together(course, self.given("order"), "the course fixes the order")


@dataclass(frozen=True)
class LightOptions(OptionGroup):
    """The light."""

    light_direction: Annotated[
        str | None,
        Option(metavar="X Y Z", help="Where light travels (-1 -1 -1).", rich_help_panel=LIGHT),
    ] = None
    light_angles: Annotated[
        str | None,
        Option(metavar="ALPHA BETA", help="The same by two angles.", rich_help_panel=LIGHT),
    ] = None
    light_position: Annotated[
        str | None, Option(metavar="X Y Z", help="Where a lamp is.", rich_help_panel=LIGHT)
    ] = None

    def override(self, setup: Setup, _: Sources) -> Setup:
        """Put the typed options in place of the setup's own light."""
        if self.light_direction is not None:
            by_angles = self.given("light_angles")
            refuse_together("--light-direction", by_angles, "both are the direction")
        read = self.numbers(light_direction=3, light_angles=2, light_position=3)
        direction, angles = read.get("light_direction"), read.get("light_angles")
        if direction is None and angles is None:
            direction, angles = setup.light.direction, setup.light.angles_degrees
        position = read.get("light_position", setup.light.position)
        return replace(setup, light=Light(direction, angles, position))
