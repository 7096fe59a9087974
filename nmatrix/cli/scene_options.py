"""From option groups to a scene: one function for every mix of groups that commands take."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Annotated

from typer import Argument, Option

from nmatrix.cli.camera_options import LensOptions, ViewOptions
from nmatrix.cli.everywhere import Everywhere
from nmatrix.cli.scene_group import SceneOptions
from nmatrix.cli.sources import Sources
from nmatrix.cli.world_options import LightOptions, WorldOptions
from nmatrix.enums import Space
from nmatrix.errors import IllegalValueError
from nmatrix.linear.rational import RationalMatrix
from nmatrix.reading.numbers import number
from nmatrix.scene.camera import View
from nmatrix.scene.setup import Light, Setup
from nmatrix.spaces.shading_spaces import SYNONYMS

if TYPE_CHECKING:
    from nmatrix.scene.scene import Scene
    from nmatrix.scene.world import World

SPACE = "Space"
_NAMES = (*(space.value for space in Space), *SYNONYMS)


_ANY_SPACE = f"{', '.join(list(Space)[:-1])} or {list(Space)[-1]}."


def _complete_space(incomplete: str) -> list[str]:
    return [name for name in _NAMES if name.startswith(incomplete)]


SpaceArgument = Annotated[
    str | None,
    Argument(
        metavar="SPACE",
        help=_ANY_SPACE,
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
            help=_ANY_SPACE,
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
    if lowered in SYNONYMS:
        return SYNONYMS[lowered]
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
    scene: SceneOptions = field(default_factory=SceneOptions)

    @property
    def is_given(self) -> bool:
        """Return whether any option of any group was given."""
        return self != Groups()

    def setup(self, everywhere: Everywhere, aspect: float | None = None) -> Setup:
        """Return what the command line describes; `aspect` is that of a picture, if it has one."""
        sources = Sources(everywhere.input_layout)
        return self.setup_from(sources, aspect)

    def setup_from(self, sources: Sources, aspect: float | None = None) -> Setup:
        """Return the same, reading matrices from these sources."""
        if self.scene.scene is not None:
            return self._setup_of_scene(self.scene.scene, sources, aspect)
        return Setup(
            world=self.world.build(sources),
            view=self._handed(self.view.build(sources)),
            lens=self.lens.build(sources, aspect or 1.0),
            light=self.light.build(),
            space_matrix=self.space.matrix(sources),
            tolerance=self.tolerance.value(sources),
        )

    def _setup_of_scene(self, scene: Scene, sources: Sources, aspect: float | None) -> Setup:
        from nmatrix.cli.overlay import lens_over, light_over, view_over, world_over

        chosen = self.scene.chosen_object
        assert chosen is not None  # a scene has an object
        if scene.path is not None and scene.path.suffix.lower() != ".toml":
            sources.any_from_file = True  # such files hold float32
        world = world_over(chosen, self.world, self.world.build(sources))
        view = self._handed(view_over(scene.view, self.view, self.view.build(sources)))
        free = aspect is not None and not scene.has_aspect
        lens = replace(scene.lens, aspect=aspect) if free and aspect else scene.lens
        light = self.scene.light_source(view, world) or Light()
        space_matrix = self.space.matrix(sources)
        return Setup(
            world=world,
            view=view,
            lens=lens_over(lens, self.lens, self.lens.build(sources)),
            light=light_over(light, self.light.build()),
            space_matrix=scene.settings.space_matrix if space_matrix is None else space_matrix,
            tolerance=self.tolerance.value(sources),
        )

    def typed_world(self, sources: Sources, setup: Setup) -> World:
        """Return the world with every number as it was typed, where it was typed in parts."""
        typed = self.world.build_exact(sources)
        chosen = self.scene.chosen_object
        if chosen is None or self.world.world_matrix is not None:
            return typed
        if chosen.world_from_parent is not None or chosen.place is None:
            return setup.world
        from nmatrix.cli.overlay import as_typed, world_over

        return world_over(replace(chosen, place=as_typed(chosen.place)), self.world, typed)

    def usual_space(self, default: Space) -> Space:
        """Return the scene's shading space, or the default without a scene."""
        return default if self.scene.scene is None else self.scene.scene.settings.space

    def _handed(self, view: View) -> View:
        handed = self.lens.effective_handed
        return view if handed is None else replace(view, handed=handed)
