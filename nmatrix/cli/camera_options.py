"""The View and Lens groups: where the camera is and how it projects, each option once."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from typing import Annotated

from typer import Option

from nmatrix.cli.shared_options import ConventionOption, HandedOption, OptionGroup
from nmatrix.cli.sources import Sources
from nmatrix.enums import Api, CameraAxes, ClipY, DepthRange
from nmatrix.linear.viewport import Viewport
from nmatrix.reading.numbers import number_or_infinity, ratio
from nmatrix.scene.given import hand_of, lens_of, view_of
from nmatrix.scene.setup import Setup

in_view = partial(Option, rich_help_panel="View")
in_lens = partial(Option, rich_help_panel="Lens")


@dataclass(frozen=True)
class ViewOptions(OptionGroup):
    """Where the camera stands and looks."""

    eye: Annotated[str | None, in_view(metavar="X Y Z", help="The camera's place (0 0 5).")] = None
    target: Annotated[str | None, in_view(metavar="X Y Z", help="What it looks at (0 0 0).")] = None
    up: Annotated[str | None, in_view(metavar="X Y Z", help="What is up (0 1 0).")] = None
    elevation: Annotated[
        str | None, in_view(metavar="ANGLE", help="Look up by so much, instead of a target.")
    ] = None
    angle: Annotated[str | None, in_view(metavar="ANGLE", help="Look sideways by so much.")] = None
    roll: Annotated[str | None, in_view(metavar="ANGLE", help="Turn about the view axis.")] = None
    view_matrix: Annotated[
        str | None, in_view(metavar="MATRIX", help="The whole matrix instead.")
    ] = None
    extrinsics: Annotated[
        str | None,
        in_view(metavar="MATRIX", help="[R t] from the world to an OpenCV or COLMAP camera."),
    ] = None
    pose: Annotated[
        str | None, in_view(metavar="MATRIX", help="World from camera, as in NeRF.")
    ] = None
    pose_axes: Annotated[
        CameraAxes | None, in_view(help="The camera axes of that pose (opengl).")
    ] = None
    handed: HandedOption = None
    convention: ConventionOption = None

    def override(self, setup: Setup, sources: Sources) -> Setup:
        """Put the typed options in place of the setup's own view."""
        given = self.numbers(eye=3, target=3, up=3)
        given |= self.degrees(sources, elevation=1, angle=1, roll=1)
        given |= self.typed("handed", "convention", "pose_axes")
        for name, text in self.typed("view_matrix", "extrinsics", "pose").items():
            given[name] = sources.affine(text)
        return replace(setup, view=view_of(given, setup.view))


@dataclass(frozen=True)
class LensOptions(OptionGroup):
    """How the camera projects."""

    fov: Annotated[str | None, in_lens(metavar="ANGLE", help="Vertical field of view (60).")] = None
    fov_x: Annotated[
        str | None, in_lens(metavar="ANGLE", help="Horizontal field of view instead.")
    ] = None
    focal: Annotated[
        str | None, in_lens(metavar="MM", help="Focal length instead, before a --sensor.")
    ] = None
    sensor: Annotated[str | None, in_lens(metavar="W H", help="Its size, in mm.")] = None
    intrinsics: Annotated[
        str | None,
        in_lens(metavar="FX FY CX CY", help="Pixels of a --viewport, from its upper left corner."),
    ] = None
    angles: Annotated[
        str | None,
        in_lens(metavar="LEFT RIGHT DOWN UP", help="Four angles from the axis, left, down < 0."),
    ] = None
    viewport: Annotated[
        str | None, in_lens(metavar="W H", help="The window or image in pixels.")
    ] = None
    aspect: Annotated[
        str | None, in_lens(metavar="R", help="Width over height (the picture's, or 1).")
    ] = None
    near: Annotated[str | None, in_lens(metavar="N", help="Near distance (0.1).")] = None
    far: Annotated[str | None, in_lens(metavar="F", help="Far distance, or inf (100).")] = None
    ortho: Annotated[
        str | None, in_lens(metavar="L R B T", help="A parallel view of this box.")
    ] = None
    frustum: Annotated[
        str | None, in_lens(metavar="L R B T", help="A view through this near rectangle.")
    ] = None
    depth: Annotated[
        DepthRange | None, in_lens(help="Depth at near and far (minus-one-to-one).")
    ] = None
    handed: HandedOption = None
    clip_y: Annotated[ClipY | None, in_lens(help="Direction of y in clip space (up).")] = None
    api: Annotated[Api | None, in_lens(help="Depth, hand and clip-y of an interface.")] = None
    projection_matrix: Annotated[
        str | None, in_lens(metavar="MATRIX", help="The whole matrix instead.")
    ] = None

    @property
    def window(self) -> Viewport | None:
        """The viewport that was typed."""
        found = self.numbers(viewport=2)
        return Viewport(*found["viewport"]) if found else None

    def override(self, setup: Setup, sources: Sources) -> Setup:
        """Put the typed options in place of the setup's own lens; its hand is the view's too."""
        given = self.numbers(focal=1, near=1, sensor=2, viewport=2)
        given |= self.numbers(intrinsics=4, ortho=4, frustum=4)
        given |= self.degrees(sources, fov=1, fov_x=1, angles=4)
        if self.aspect is not None:
            given["aspect"] = ratio(self.aspect, "--aspect")
        given |= self.typed("depth", "handed", "clip_y", "api")
        if self.far is not None:
            given["far"] = number_or_infinity(self.far, "--far")
        if self.projection_matrix is not None:
            given["projection_matrix"] = sources.projection(self.projection_matrix)
        hand = hand_of(given)
        view = setup.view if hand is None else replace(setup.view, handed=hand)
        return replace(setup, view=view, lens=lens_of(given, setup.lens))
