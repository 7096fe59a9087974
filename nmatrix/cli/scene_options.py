"""The Scene and Space groups, and how the groups of a command make one setup.

A scene file stands for all the other groups; an option beside it replaces its own key, another
way to give a value (two angles for a target, a matrix for its parts) replaces the old way.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property, partial
from typing import TYPE_CHECKING, Annotated, ClassVar

from typer import Argument, Option

from nmatrix.cli.camera_options import LensOptions, ViewOptions
from nmatrix.cli.shared_options import OUTSIDE, CommonOptions, among
from nmatrix.cli.sources import Sources
from nmatrix.cli.world_options import LightOptions, WorldOptions
from nmatrix.enums import Space
from nmatrix.errors import IllegalValueError
from nmatrix.linear.classify import BUILT, FROM_FILE
from nmatrix.linear.viewport import Viewport
from nmatrix.reading.numbers import fractions, number
from nmatrix.samples import file_or_sample, samples
from nmatrix.scene.lens import Lens
from nmatrix.scene.setup import Setup
from nmatrix.scene.world import World
from nmatrix.spaces.shading_spaces import SYNONYMS, space_named

if TYPE_CHECKING:
    from nmatrix.report import Number
    from nmatrix.scene.chosen import Placed
    from nmatrix.scene.scene import Scene

in_scene = partial(Option, rich_help_panel="Scene")
in_space = partial(Option, rich_help_panel="Space")
_NAMES = (*(space.value for space in Space), *SYNONYMS)
_ANY_SPACE = f"{', '.join(list(Space)[:-1])} or {list(Space)[-1]}."


SpaceArgument = Annotated[
    str | None,
    Argument(
        metavar="SPACE",
        help=_ANY_SPACE,
        autocompletion=among(_NAMES),
        show_default=False,
    ),
]


@dataclass(frozen=True)
class SpaceOptions:
    """Which space to shade in."""

    space: Annotated[
        str | None,
        in_space("--space", metavar="SPACE", autocompletion=among(_NAMES), help=_ANY_SPACE),
    ] = None
    space_matrix: Annotated[
        str | None, in_space(metavar="MATRIX", help="Space from world, for custom.")
    ] = None

    def chosen(self, positional: str | None = None) -> Space | None:
        """Choose the space that was typed, by name or as the matrix of custom space."""
        if positional is not None and self.space is not None:
            raise IllegalValueError(
                f"{positional[:20]} with --space {self.space[:20]}",
                "both name the space",
                "keep one of them",
            )
        name = self.space if positional is None else positional
        if name is None:
            return None if self.space_matrix is None else Space.CUSTOM
        found = space_named(name)
        if self.space_matrix is not None and found is not Space.CUSTOM:
            raise IllegalValueError(
                f"--space-matrix with space {found}",
                "only custom space takes a matrix",
                "use --space custom",
            )
        return found

    def override(self, setup: Setup, sources: Sources) -> Setup:
        """Put the typed matrix of custom space in place of the setup's own."""
        if self.space_matrix is None:
            return setup
        return replace(setup, space_matrix=sources.affine(self.space_matrix))


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

    def value(self, usual: float) -> float:
        """Read the tolerance that was typed, if any."""
        if self.tolerance is None:
            return usual
        found = number(self.tolerance, "--tolerance")
        if not 0 <= found < 1:
            raise IllegalValueError(
                f"--tolerance ({self.tolerance[:20]})", "it lies in [0, 1)", "try 1e-9"
            )
        return found


USUAL_TOLERANCE = ToleranceOption()


@dataclass(frozen=True)
class SceneOptions:
    """Which scene, and what in it; matrices do not need the materials of a mesh."""

    has_materials: ClassVar[bool] = False

    scene_file: Annotated[
        str | None,
        in_scene(
            "--scene",
            metavar="FILE",
            autocompletion=among(samples, ".toml", ".obj"),
            help="Take what no option says from a .toml, .gltf or .glb scene.",
        ),
    ] = None
    object_name: Annotated[
        str | None,
        in_scene(
            "--object", metavar="NAME", help="Which object or node, by name or path (the first)."
        ),
    ] = None
    light_name: Annotated[
        str | None, in_scene("--light", metavar="NAME", help="Which light (the first).")
    ] = None
    allow_outside: Annotated[bool, in_scene("--allow-outside", help=OUTSIDE)] = False

    @cached_property
    def scene(self) -> Scene | None:
        """The scene of the file, if one was named; the readers are imported only then."""
        if self.scene_file is None:
            for option, name in (("--object", self.object_name), ("--light", self.light_name)):
                if name is not None:
                    raise IllegalValueError(
                        f"{option} ({name[:40]})", "it is a name in a scene", "add --scene FILE"
                    )
            return None
        from nmatrix.scene.open import scene_of

        path = file_or_sample(self.scene_file)
        return scene_of(path, allow_outside=self.allow_outside, has_materials=self.has_materials)

    @cached_property
    def chosen(self) -> Placed | None:
        """The object or node that was named, or the first."""
        if self.scene is None:
            return None
        from nmatrix.scene.chosen import chosen_node

        return chosen_node(self.scene, self.object_name)

    def setup(self, sources: Sources, aspect: float | None) -> Setup:
        """Take the object, the camera and the lens of the scene, or without one the usual setup.

        `aspect` is that of the picture, where it has one; a scene's own wins.
        """
        if self.scene is None or self.chosen is None:
            return Setup() if aspect is None else Setup(lens=Lens(aspect=aspect))
        if self.scene.path is not None and self.scene.path.suffix.lower() != ".toml":
            sources.any_from_file = True  # such files hold float32
        from nmatrix.scene.chosen import setup_before

        return setup_before(self.scene, self.chosen, aspect)

    def window(self, lens: Lens) -> Viewport:
        """Choose the window: the lens's own, else the scene's picture."""
        if lens.viewport is not None:
            return lens.viewport
        return Viewport(*((512, 512) if self.scene is None else self.scene.settings.size))

    def told(self, *, is_changed: bool) -> Iterator[str]:
        """Name the node that an answer is of, if there is a scene."""
        if self.scene is None or self.chosen is None:
            return iter(())
        from nmatrix.scene.chosen import told_of

        is_named = self.object_name is not None
        return told_of(self.scene, self.chosen, is_named=is_named, is_changed=is_changed)

    def in_the_scene(self, setup: Setup, *, under_parent: bool) -> Setup:
        """Put the object under its parent, and the scene's light in its place."""
        one = self.chosen
        if self.scene is None or one is None:
            return setup
        from nmatrix.scene.chosen import chosen_light, in_the_scene

        free = one if under_parent else replace(one, world_from_parent=None)
        return in_the_scene(setup, self.scene, free, chosen_light(self.scene, self.light_name))


@dataclass(frozen=True)
class DrawnScene(SceneOptions):
    """A scene that is drawn, with its materials."""

    has_materials: ClassVar[bool] = True


@dataclass(frozen=True)
class OptionGroups:
    """The groups that make a setup; what a command does not take has its defaults."""

    world: WorldOptions = field(default_factory=WorldOptions)
    view: ViewOptions = field(default_factory=ViewOptions)
    lens: LensOptions = field(default_factory=LensOptions)
    light: LightOptions = field(default_factory=LightOptions)
    space: SpaceOptions = field(default_factory=SpaceOptions)
    scene: SceneOptions = field(default_factory=SceneOptions)

    @property
    def is_given(self) -> bool:
        """Whether any option of any group was typed."""
        return self != OptionGroups()

    def setup(
        self,
        common: CommonOptions,
        *,
        aspect: float | None = None,
        tolerance: ToleranceOption = USUAL_TOLERANCE,
        is_of_node: bool = True,
    ) -> Setup:
        """Build what the command line describes; `aspect` is that of a picture, if it has one.

        An answer that `is_of_node` names the node of the scene.
        """
        if aspect is None and self.lens.window is not None and self.scene.scene is not None:
            aspect = float(self.lens.window.aspect)  # without a scene it is the lens's own
        setup = self.scene.setup(common.sources, aspect)
        for group in (self.world, self.view, self.lens):
            setup = group.override(setup, common.sources)
        setup = self.scene.in_the_scene(setup, under_parent=self.world.world_matrix is None)
        if is_of_node and self.world.world_matrix is None:
            changed = bool(self.world.given)
            common.sources.about += self.scene.told(is_changed=changed)
        for later in (self.light, self.space):
            setup = later.override(setup, common.sources)
        usual = FROM_FILE if common.sources.any_from_file else BUILT  # files often hold float32
        return replace(setup, tolerance=tolerance.value(usual))

    def typed_world(self, common: CommonOptions, setup: Setup) -> World:
        """Build the world of every number as it was typed, where it was typed in parts."""
        chosen = self.scene.chosen
        if chosen is None or self.world.world_matrix is not None:
            return self.world.over(World(), common.sources, fractions)
        if chosen.world_from_parent is not None or chosen.place is None:
            return setup.world
        return self.world.over(_as_typed(chosen.place), common.sources, fractions)

    def shading_space(self, positional: str | None = None) -> Space:
        """Choose the space that was typed, else the scene's, else world space."""
        usual = Space.WORLD if self.scene.scene is None else self.scene.scene.settings.space
        return self.space.chosen(positional) or usual


def _as_typed(place: World) -> World:
    """Write every number of a place as a person does: 0.1 is a tenth."""
    return replace(
        place,
        translate=tuple(map(_decimal, place.translate)),
        rotate_degrees=tuple(map(_decimal, place.rotate_degrees)),
        quaternion=None if place.quaternion is None else tuple(map(_decimal, place.quaternion)),
        axis_angle=None if place.axis_angle is None else tuple(map(_decimal, place.axis_angle)),
        scale=tuple(map(_decimal, place.scale)),
        shear=tuple(map(_decimal, place.shear)),
    )


def _decimal(value: Number) -> Fraction:
    return Fraction(str(value))
