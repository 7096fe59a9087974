"""From option groups to a scene: one function for every mix of groups that commands take."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Annotated

from typer import Argument, Option

from nmatrix.cli.camera_options import LensOptions, ViewOptions
from nmatrix.cli.everywhere import Everywhere
from nmatrix.cli.sources import Sources
from nmatrix.cli.world_options import LightOptions, WorldOptions
from nmatrix.enums import SPACE_SYNONYMS, Space
from nmatrix.errors import IllegalValueError
from nmatrix.linear.rational import RationalMatrix
from nmatrix.reading.numbers import number
from nmatrix.scene.camera import View
from nmatrix.scene.lens import Lens
from nmatrix.scene.shot import LightSource, Shot

SPACE = "Space"
_NAMES = (*(space.value for space in Space), *SPACE_SYNONYMS)


def _complete_space(incomplete: str) -> list[str]:
    return [name for name in _NAMES if name.startswith(incomplete)]


SpaceArgument = Annotated[
    str | None,
    Argument(
        metavar="SPACE",
        help="world, camera, object, static, light or custom.",
        autocompletion=_complete_space,
        show_default=False,
    ),
]


@dataclass(frozen=True)
class SpaceOptions:
    """Which space to shade in."""

    space: Annotated[
        str | None,
        Option(
            "--space",
            metavar="SPACE",
            autocompletion=_complete_space,
            help="world, camera, object, static, light or custom.",
            rich_help_panel=SPACE,
        ),
    ] = None
    space_matrix: Annotated[
        str | None,
        Option(metavar="MATRIX", help="Space from world, for custom.", rich_help_panel=SPACE),
    ] = None

    def chosen(self, positional: str | None, default: Space | None) -> Space | None:
        """Return the space that was asked for, as an argument or as an option."""
        if positional is not None and self.space is not None:
            raise IllegalValueError(
                f"{positional[:20]} with --space {self.space[:20]}",
                "both name the space",
                "keep one of them",
            )
        name = self.space if positional is None else positional
        unnamed = Space.CUSTOM if self.space_matrix is not None else default
        found = unnamed if name is None else space_named(name)
        if self.space_matrix is not None and found is not Space.CUSTOM:
            raise IllegalValueError(
                f"--space-matrix with space {found}",
                "only custom space takes a matrix",
                "use --space custom",
            )
        return found

    def matrix(self, sources: Sources) -> RationalMatrix | None:
        """Return `space_from_world` for custom space."""
        if self.space_matrix is None:
            return None
        return sources.affine(self.space_matrix)


def space_named(name: str) -> Space:
    """Return the space that a name or a synonym means."""
    lowered = name.lower()
    if lowered in SPACE_SYNONYMS:
        return SPACE_SYNONYMS[lowered]
    try:
        return Space(lowered)
    except ValueError:
        raise IllegalValueError(
            f"space ({name[:40]})", f"the spaces are {', '.join(Space)}", "try camera"
        ) from None


@dataclass(frozen=True)
class ToleranceOption:
    """How far the columns of a matrix may be off."""

    tolerance: Annotated[
        str | None,
        Option(
            metavar="T",
            help="Relative tolerance for the kind of map (1e-12, files 1e-6).",
        ),
    ] = None

    def value(self, sources: Sources) -> float:
        """Return the tolerance, by default that of the numbers' origin."""
        if self.tolerance is None:
            return sources.tolerance
        found = number(self.tolerance, "--tolerance")
        if not 0 <= found < 1:
            raise IllegalValueError(
                f"--tolerance ({self.tolerance[:20]})", "it lies in [0, 1)", "try 1e-9"
            )
        return found


@dataclass(frozen=True)
class Groups:
    """The groups that a command took; what it did not take has its defaults."""

    world: WorldOptions = field(default_factory=WorldOptions)
    view: ViewOptions = field(default_factory=ViewOptions)
    lens: LensOptions = field(default_factory=LensOptions)
    light: LightOptions = field(default_factory=LightOptions)
    space: SpaceOptions = field(default_factory=SpaceOptions)
    tolerance: ToleranceOption = field(default_factory=ToleranceOption)

    def shot(self, everywhere: Everywhere, aspect: float = 1.0) -> Shot:
        """Return the scene that the command line describes."""
        sources = Sources(everywhere.input_layout)
        return self.shot_from(sources, aspect)

    def shot_from(self, sources: Sources, aspect: float = 1.0) -> Shot:
        """Return the scene, reading matrices from these sources."""
        lens: Lens = self.lens.build(sources, aspect)
        light: LightSource = self.light.build()
        return Shot(
            world=self.world.build(sources),
            view=self._view(sources),
            lens=lens,
            light=light,
            space_matrix=self.space.matrix(sources),
            tolerance=self.tolerance.value(sources),
        )

    def _view(self, sources: Sources) -> View:
        view = self.view.build(sources)
        handed = self.lens.effective_handed
        return view if handed is None else replace(view, handed=handed)
