"""The option groups of the contract, each declared once; a group builds its part of the scene."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated

from typer import Option

from nmatrix.cli.alternatives import refuse_together
from nmatrix.cli.sources import Sources
from nmatrix.enums import API_PRESETS, Api, ClipY, Convention, DepthRange, Handedness
from nmatrix.errors import IllegalValueError
from nmatrix.linear.projection import ClipSpace, Window, check_aspect
from nmatrix.reading.numbers import fractions, number, number_or_infinity, numbers
from nmatrix.report import Vector
from nmatrix.scene.camera import FirstPerson, View
from nmatrix.scene.lens import Lens
from nmatrix.scene.scene import LightSource
from nmatrix.scene.world import World

WORLD, VIEW, LENS, LIGHT = "World", "View", "Lens", "Light"

ReadNumbers = Callable[[str, int, str], Vector]

ConventionOption = Annotated[
    Convention | None,
    Option(
        "--convention", help="How angles make a matrix (default: standard).", rich_help_panel=WORLD
    ),
]
HandedOption = Annotated[
    Handedness | None,
    Option(
        "--handed",
        help="The camera looks down −z (right, the default) or +z (left).",
        rich_help_panel=VIEW,
    ),
]


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
        return World(
            translate=_vector(read, self.translate, "--translate", (0, 0, 0)),
            rotate_degrees=_vector(read, self.rotate, "--rotate", (0, 0, 0)),
            quaternion=None
            if self.quaternion is None
            else read(self.quaternion, 4, "--quaternion"),
            scale=_vector(read, self.scale, "--scale", (1, 1, 1)),
            shear=_vector(read, self.shear, "--shear", (0, 0, 0)),
            order="XYZ" if self.order is None else self.order,
            convention=convention,
        )


@dataclass(frozen=True)
class ViewOptions:
    """Where the camera stands and looks."""

    eye: Annotated[
        str | None,
        Option(metavar="X Y Z", help="The camera's place (0 0 5).", rich_help_panel=VIEW),
    ] = None
    target: Annotated[
        str | None, Option(metavar="X Y Z", help="What it looks at (0 0 0).", rich_help_panel=VIEW)
    ] = None
    up: Annotated[
        str | None, Option(metavar="X Y Z", help="What is up (0 1 0).", rich_help_panel=VIEW)
    ] = None
    elevation: Annotated[
        str | None,
        Option(
            metavar="DEG", help="Look up by so much, instead of a target.", rich_help_panel=VIEW
        ),
    ] = None
    angle: Annotated[
        str | None, Option(metavar="DEG", help="Look sideways by so much.", rich_help_panel=VIEW)
    ] = None
    roll: Annotated[
        str | None, Option(metavar="DEG", help="Turn about the view axis.", rich_help_panel=VIEW)
    ] = None
    view_matrix: Annotated[
        str | None,
        Option(metavar="MATRIX", help="The whole matrix instead.", rich_help_panel=VIEW),
    ] = None
    handed: HandedOption = None
    convention: ConventionOption = None

    def build(self, sources: Sources) -> View:
        """Return the view that was described."""
        aimed = _given({"--target": self.target, "--up": self.up})
        angled = _given({"--elevation": self.elevation, "--angle": self.angle, "--roll": self.roll})
        handed = self.handed or Handedness.RIGHT
        convention = self.convention or Convention.STANDARD
        if self.view_matrix is not None:
            parts = _given({"--eye": self.eye}) | aimed | angled
            refuse_together("--view-matrix", parts, "the matrix is the whole answer")
            matrix = sources.affine(self.view_matrix)
            return View(matrix=matrix, handed=handed, convention=convention)
        if angled:
            refuse_together(next(iter(angled)), aimed, "both say where to look")
        return View(
            eye=_vector(numbers, self.eye, "--eye", (0, 0, 5)),
            target=_vector(numbers, self.target, "--target", (0, 0, 0)),
            up=_vector(numbers, self.up, "--up", (0, 1, 0)),
            angles=self._angles() if angled else None,
            handed=handed,
            convention=convention,
        )

    @property
    def is_given(self) -> bool:
        """Return whether any option said where the camera is."""
        return any(
            value is not None
            for value in (
                self.eye,
                self.target,
                self.up,
                self.elevation,
                self.angle,
                self.roll,
                self.view_matrix,
            )
        )

    def _angles(self) -> FirstPerson:
        return FirstPerson(
            _scalar(self.elevation, "--elevation", 0.0),
            _scalar(self.angle, "--angle", 0.0),
            _scalar(self.roll, "--roll", 0.0),
        )


@dataclass(frozen=True)
class LensOptions:
    """How the camera projects."""

    fov: Annotated[
        str | None,
        Option(metavar="DEG", help="Vertical field of view (60).", rich_help_panel=LENS),
    ] = None
    aspect: Annotated[
        str | None, Option(metavar="R", help="Width over height (1).", rich_help_panel=LENS)
    ] = None
    near: Annotated[
        str | None, Option(metavar="N", help="Near distance (0.1).", rich_help_panel=LENS)
    ] = None
    far: Annotated[
        str | None, Option(metavar="F", help="Far distance, or inf (100).", rich_help_panel=LENS)
    ] = None
    ortho: Annotated[
        str | None,
        Option(metavar="L R B T", help="A parallel view of this box.", rich_help_panel=LENS),
    ] = None
    frustum: Annotated[
        str | None,
        Option(metavar="L R B T", help="A view through this near rectangle.", rich_help_panel=LENS),
    ] = None
    depth: Annotated[
        DepthRange | None,
        Option(help="Depth at near and far (minus-one-to-one).", rich_help_panel=LENS),
    ] = None
    handed: HandedOption = None
    clip_y: Annotated[
        ClipY | None, Option(help="Direction of y in clip space (up).", rich_help_panel=LENS)
    ] = None
    api: Annotated[
        Api | None, Option(help="Depth, hand and clip-y of an interface.", rich_help_panel=LENS)
    ] = None
    projection_matrix: Annotated[
        str | None,
        Option(metavar="MATRIX", help="The whole matrix instead.", rich_help_panel=LENS),
    ] = None

    @property
    def effective_handed(self) -> Handedness | None:
        """Return the hand that was asked for, by itself or by the interface."""
        if self.handed is not None or self.api is None:
            return self.handed
        return API_PRESETS[self.api][1]

    def build(self, sources: Sources, aspect: float = 1.0) -> Lens:
        """Return the lens; `aspect` is that of the picture, if there is one."""
        clip = self._clip_space()
        shape = _given({"--fov": self.fov, "--aspect": self.aspect})
        if self.projection_matrix is not None:
            others = shape | _given(
                {
                    "--near": self.near,
                    "--far": self.far,
                    "--ortho": self.ortho,
                    "--frustum": self.frustum,
                }
            )
            refuse_together("--projection-matrix", others, "the matrix is the whole answer")
            matrix = sources.projection(self.projection_matrix)
            return Lens(matrix=matrix, clip=clip)
        if self.ortho is not None:
            refuse_together(
                "--ortho", shape | _given({"--frustum": self.frustum}), "both shape the view"
            )
        if self.frustum is not None:
            refuse_together("--frustum", shape, "both shape the view")
        lens = Lens(
            fov_degrees=_scalar(self.fov, "--fov", 60.0),
            aspect=_scalar(self.aspect, "--aspect", aspect),
            near=_scalar(self.near, "--near", 0.1),
            far=100.0 if self.far is None else number_or_infinity(self.far, "--far"),
            ortho=_window(self.ortho, "--ortho"),
            frustum=_window(self.frustum, "--frustum"),
            clip=clip,
        )
        check_aspect(lens.aspect)
        return lens

    def _clip_space(self) -> ClipSpace:
        depth, handed, clip_y = API_PRESETS[self.api or Api.OPENGL]
        return ClipSpace(self.depth or depth, self.handed or handed, self.clip_y or clip_y)


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

    def build(self) -> LightSource:
        """Return the light that was described."""
        if self.light_direction is not None and self.light_angles is not None:
            raise IllegalValueError(
                "--light-direction with --light-angles", "both are the direction", "keep one"
            )
        angles = None
        if self.light_angles is not None:
            alpha, beta = numbers(self.light_angles, 2, "--light-angles")
            angles = (alpha, beta)
        return LightSource(
            direction=None
            if self.light_direction is None
            else numbers(self.light_direction, 3, "--light-direction"),
            angles_degrees=angles,
            position=None
            if self.light_position is None
            else numbers(self.light_position, 3, "--light-position"),
        )


def _given(named: dict[str, str | None]) -> dict[str, str]:
    return {name: value for name, value in named.items() if value is not None}


def _vector(read: ReadNumbers, text: str | None, name: str, default: Vector) -> Vector:
    return default if text is None else read(text, 3, name)


def _scalar(text: str | None, name: str, default: float) -> float:
    return default if text is None else number(text, name)


def _window(text: str | None, name: str) -> Window | None:
    return None if text is None else Window(*numbers(text, 4, name))
