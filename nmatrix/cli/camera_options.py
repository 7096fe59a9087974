"""The View and Lens groups: where the camera is and how it projects, each option once."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from typer import Option

from nmatrix.cli.alternatives import refuse_together
from nmatrix.cli.shared_options import (
    LENS,
    VIEW,
    ConventionOption,
    HandedOption,
    given,
    scalar,
    vector,
    window,
)
from nmatrix.cli.sources import Sources
from nmatrix.enums import API_PRESETS, Api, ClipY, Convention, DepthRange, Handedness
from nmatrix.linear.projection import ClipSpace, check_aspect
from nmatrix.reading.numbers import number_or_infinity, numbers
from nmatrix.scene.camera import FirstPerson, View
from nmatrix.scene.lens import Lens


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
        aimed = given({"--target": self.target, "--up": self.up})
        angled = given({"--elevation": self.elevation, "--angle": self.angle, "--roll": self.roll})
        handed = self.handed or Handedness.RIGHT
        convention = self.convention or Convention.STANDARD
        if self.view_matrix is not None:
            parts = given({"--eye": self.eye}) | aimed | angled
            refuse_together("--view-matrix", parts, "the matrix is the whole answer")
            matrix = sources.affine(self.view_matrix)
            return View(matrix=matrix, handed=handed, convention=convention)
        if angled:
            refuse_together(next(iter(angled)), aimed, "both say where to look")
        return View(
            eye=vector(numbers, self.eye, "--eye", (0, 0, 5)),
            target=vector(numbers, self.target, "--target", (0, 0, 0)),
            up=vector(numbers, self.up, "--up", (0, 1, 0)),
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
            scalar(self.elevation, "--elevation", 0.0),
            scalar(self.angle, "--angle", 0.0),
            scalar(self.roll, "--roll", 0.0),
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
    def is_given(self) -> bool:
        """Return whether any option said how the camera projects."""
        return any(
            value is not None
            for value in (
                self.fov,
                self.aspect,
                self.near,
                self.far,
                self.ortho,
                self.frustum,
                self.depth,
                self.clip_y,
                self.api,
                self.projection_matrix,
            )
        )

    @property
    def effective_handed(self) -> Handedness | None:
        """Return the hand that was asked for, by itself or by the interface."""
        if self.handed is not None or self.api is None:
            return self.handed
        return API_PRESETS[self.api][1]

    def build(self, sources: Sources, aspect: float = 1.0) -> Lens:
        """Return the lens; `aspect` is that of the picture, if there is one."""
        clip = self._clip_space()
        shape = given({"--fov": self.fov, "--aspect": self.aspect})
        if self.projection_matrix is not None:
            others = shape | given(
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
                "--ortho", shape | given({"--frustum": self.frustum}), "both shape the view"
            )
        if self.frustum is not None:
            refuse_together("--frustum", shape, "both shape the view")
        lens = Lens(
            fov_degrees=scalar(self.fov, "--fov", 60.0),
            aspect=scalar(self.aspect, "--aspect", aspect),
            near=scalar(self.near, "--near", 0.1),
            far=100.0 if self.far is None else number_or_infinity(self.far, "--far"),
            ortho=window(self.ortho, "--ortho"),
            frustum=window(self.frustum, "--frustum"),
            clip=clip,
        )
        check_aspect(lens.aspect)
        return lens

    def _clip_space(self) -> ClipSpace:
        depth, handed, clip_y = API_PRESETS[self.api or Api.OPENGL]
        return ClipSpace(self.depth or depth, self.handed or handed, self.clip_y or clip_y)
