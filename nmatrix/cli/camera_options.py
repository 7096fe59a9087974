"""The View and Lens groups: where the camera is and how it projects, each option once."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated

from typer import Option

from nmatrix.cli.shared_options import ConventionOption, HandedOption, OptionGroup
from nmatrix.cli.sources import Sources
from nmatrix.enums import Api, ClipY, DepthRange
from nmatrix.reading.numbers import number_or_infinity
from nmatrix.scene.given import hand_of, lens_of, view_of
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
        """Put the typed options in place of the setup's own view."""
        given = self.numbers(eye=3, target=3, up=3, elevation=1, angle=1, roll=1)
        given |= self.typed("handed", "convention")
        if self.view_matrix is not None:
            given["view_matrix"] = sources.affine(self.view_matrix)
        return replace(setup, view=view_of(given, setup.view))


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
        given = self.numbers(fov=1, aspect=1, near=1, ortho=4, frustum=4)
        given |= self.typed("depth", "handed", "clip_y", "api")
        if self.far is not None:
            given["far"] = number_or_infinity(self.far, "--far")
        if self.projection_matrix is not None:
            given["projection_matrix"] = sources.projection(self.projection_matrix)
        hand = hand_of(given)
        view = setup.view if hand is None else replace(setup.view, handed=hand)
        return replace(setup, view=view, lens=lens_of(given, setup.lens))
