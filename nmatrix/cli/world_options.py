"""The World and Light groups: the object and what lights it, each option declared once."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from typer import Option

from nmatrix.cli.alternatives import refuse_together
from nmatrix.cli.shared_options import LIGHT, WORLD, ConventionOption, ReadNumbers, vector
from nmatrix.cli.sources import Sources
from nmatrix.enums import Convention
from nmatrix.errors import IllegalValueError
from nmatrix.reading.numbers import fractions, numbers
from nmatrix.scene.setup import Light
from nmatrix.scene.world import World


@dataclass(frozen=True)
class WorldOptions:
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

    @property
    def parts_given(self) -> dict[str, str | Convention]:
        """Return the options that describe the matrix by its parts, as far as they were given."""
        named = {
            "--translate": self.translate,
            "--rotate": self.rotate,
            "--quaternion": self.quaternion,
            "--scale": self.scale,
            "--shear": self.shear,
            "--order": self.order,
        }
        return {name: value for name, value in named.items() if value is not None}

    @property
    def is_given(self) -> bool:
        """Return whether any World option was given."""
        return bool(self.parts_given) or self.world_matrix is not None

    def build(self, sources: Sources) -> World:
        """Return the world with every number as the nearest float64."""
        return self._built(sources, numbers)

    def build_exact(self, sources: Sources) -> World:
        """Return the world with every number as it was typed."""
        return self._built(sources, fractions)

    def _built(self, sources: Sources, read: ReadNumbers) -> World:
        convention = self.convention or Convention.STANDARD
        if self.world_matrix is not None:
            refuse_together("--world-matrix", self.parts_given, "the matrix is the whole answer")
            exact = read is fractions
            return World(
                convention=convention,
                matrix=sources.affine(self.world_matrix, exact=exact),
            )
        if self.quaternion is not None and self.rotate is not None:
            refuse_together("--quaternion", {"--rotate": self.rotate}, "both are the rotation")
        if self.quaternion is not None and self.order is not None:
            refuse_together(
                "--quaternion", {"--order": self.order}, "an order is for angles, it has none"
            )
        if convention is not Convention.STANDARD and self.order is not None:
            refuse_together(
                f"--convention {convention}", {"--order": self.order}, "the course fixes the order"
            )
        return World(
            translate=vector(read, self.translate, "--translate", (0, 0, 0)),
            rotate_degrees=vector(read, self.rotate, "--rotate", (0, 0, 0)),
            quaternion=None
            if self.quaternion is None
            else read(self.quaternion, 4, "--quaternion"),
            scale=vector(read, self.scale, "--scale", (1, 1, 1)),
            shear=vector(read, self.shear, "--shear", (0, 0, 0)),
            order="XYZ" if self.order is None else self.order,
            convention=convention,
        )


@dataclass(frozen=True)
class LightOptions:
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

    @property
    def is_given(self) -> bool:
        """Return whether any option described the light."""
        given = (self.light_direction, self.light_angles, self.light_position)
        return any(value is not None for value in given)

    def build(self) -> Light:
        """Return the light that was described."""
        if self.light_direction is not None and self.light_angles is not None:
            raise IllegalValueError(
                "--light-direction with --light-angles", "both are the direction", "keep one"
            )
        angles = None
        if self.light_angles is not None:
            alpha, beta = numbers(self.light_angles, 2, "--light-angles")
            angles = (alpha, beta)
        return Light(
            direction=None
            if self.light_direction is None
            else numbers(self.light_direction, 3, "--light-direction"),
            angles_degrees=angles,
            position=None
            if self.light_position is None
            else numbers(self.light_position, 3, "--light-position"),
        )
