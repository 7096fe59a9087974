"""The View and Lens groups: where the camera is and how it projects, each option once."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated

from typer import Option

from nmatrix.cli.shared_options import (
    ConventionOption,
    HandedOption,
    OptionGroup,
    refuse_together,
)
from nmatrix.cli.sources import Sources
from nmatrix.enums import API_PRESETS, Api, ClipY, Convention, DepthRange
from nmatrix.linear.projection import ClipSpace, Window, check_aspect
from nmatrix.reading.numbers import number_or_infinity
from nmatrix.scene.camera import FirstPerson, View
from nmatrix.scene.lens import Lens
from nmatrix.scene.setup import Setup

VIEW, LENS = "View", "Lens"


@dataclass(frozen=True)
class ViewOptions(OptionGroup):
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

    def override(self, setup: Setup, sources: Sources) -> Setup:
        """Put the typed options in place of the setup's own view; a target replaces angles.

        Raises
        ------
        IllegalValueError
            For options that exclude each other.
        """
        aimed, angled = self.given("target", "up"), self.given("elevation", "angle", "roll")
        base = setup.view
        if self.view_matrix is not None:
            parts = self.given("eye") | aimed | angled
            refuse_together("--view-matrix", parts, "the matrix is the whole answer")
            view = View(
                matrix=sources.affine(self.view_matrix),
                handed=self.handed or base.handed,
                convention=self.convention or Convention.STANDARD,
            )
            return replace(setup, view=view)
        if angled:
            refuse_together(next(iter(angled)), aimed, "both say where to look")
        changed = self.numbers(eye=3, target=3, up=3) | self.typed("handed", "convention")
        if aimed or angled or self.eye is not None:
            changed["matrix"] = None
        if aimed:
            changed["angles"] = None
        elif angled:
            typed = self.numbers(elevation=1, angle=1, roll=1)
            changed["angles"] = replace(base.angles or FirstPerson(), **typed)
        return replace(setup, view=replace(base, **changed))


@dataclass(frozen=True)
class LensOptions(OptionGroup):
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

    def override(self, setup: Setup, sources: Sources) -> Setup:
        """Put the typed options in place of the setup's own lens; its hand is the view's too."""
        handed = self.handed
        if handed is None and self.api is not None:
            handed = API_PRESETS[self.api][1]
        view = setup.view if handed is None else replace(setup.view, handed=handed)
        return replace(setup, view=view, lens=self._over(setup.lens, sources))

    def _over(self, base: Lens, sources: Sources) -> Lens:
        clip = self._clip_space(base.clip)
        shape = self.given("fov", "aspect")
        if self.projection_matrix is not None:
            others = shape | self.given("near", "far", "ortho", "frustum")
            refuse_together("--projection-matrix", others, "the matrix is the whole answer")
            return Lens(matrix=sources.projection(self.projection_matrix), clip=clip)
        if self.ortho is not None:
            refuse_together("--ortho", shape | self.given("frustum"), "both shape the view")
        if self.frustum is not None:
            refuse_together("--frustum", shape, "both shape the view")
        changed = self.numbers(fov=1, aspect=1, near=1)
        if self.far is not None:
            changed["far"] = number_or_infinity(self.far, "--far")
        boxes = self.numbers(ortho=4, frustum=4)
        if shape or boxes:
            changed |= {"ortho": None, "frustum": None, "matrix": None}
        changed |= {name: Window(*sides) for name, sides in boxes.items()}
        if self.aspect is not None:
            check_aspect(changed["aspect"])
        if self.fov is not None:
            changed["fov_degrees"] = changed.pop("fov")
        return replace(base, clip=clip, **changed)

    def _clip_space(self, base: ClipSpace) -> ClipSpace:
        depth, handed, clip_y = (
            (base.depth, base.handed, base.clip_y) if self.api is None else API_PRESETS[self.api]
        )
        return ClipSpace(self.depth or depth, self.handed or handed, self.clip_y or clip_y)
