"""From scenes to the stages of a slide: one camera for all of them, the same marks on each."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.canvas.glyphs import ramp_bar
from nmatrix.canvas.marks import Box
from nmatrix.canvas.slide import Panel, Slide
from nmatrix.canvas.theme import channels
from nmatrix.enums import NormalRule
from nmatrix.raster.drawn_scene import DrawnScene, drawn_scene
from nmatrix.raster.image import levels
from nmatrix.raster.loaded_scene import Body, LoadedScene, loaded
from nmatrix.raster.overlay.stage import (
    ARROW,
    DISC,
    PAD,
    Stage,
    filling,
    radius_of,
    rings_around,
    through,
)
from nmatrix.raster.overlay.tacks import (
    APART,
    FACING,
    INNER_APART,
    INSIDE,
    ON_SILHOUETTE,
    SILHOUETTE,
    Places,
    Tack,
    farthest_apart,
    spread_over,
)
from nmatrix.raster.proofs.angles import AngleMap, Scale, ramp
from nmatrix.raster.proofs.proof import ProofSettings
from nmatrix.raster.shading.normals import normals_by, unit
from nmatrix.raster.shading.space import length
from nmatrix.report import Vector
from nmatrix.scene.camera import View
from nmatrix.scene.lens import Lens
from nmatrix.scene.material import Colour
from nmatrix.scene.scene import Scene

Array = NDArray[Any]

NO_SURFACE = ("a point", "a line", "no normal", "no normal")  # what is left, by the rank of A
STRIPE, STRIPES = 6.5, 14.0  # of the inside of a surface: its width, and from one to the next
DIMMEST = 0.6  # part of its colour that a stripe keeps where no light falls
FIXED = 24  # tacks all over a body that turns
RIM_POINTS = 12


@dataclass(frozen=True)
class Pose:
    """From where a proof looks: an eye about a body of this radius at the origin.

    About a body that is larger, or elsewhere, the eye stands as much farther off, on the same side.
    `room` is what stays free around the bodies, for arrows, a part of their radius; `free` the
    units at the left, top, right and bottom of a stage that other marks need.
    """

    eye: Vector
    radius: float
    up: Vector = (0, 1, 0)
    room: float = ARROW
    free: tuple[float, float, float, float] = (PAD, PAD, PAD, PAD)

    def camera(
        self,
        settings: ProofSettings,
        scenes: Sequence[LoadedScene],
        box: Box,
        beside: Sequence[Array] = (),
    ) -> tuple[View, Lens]:
        """Return the camera that was asked for, or the one in which the bodies fill a box.

        Other points (n, 3) of the world, `beside` the bodies, are kept in it too.
        """
        if settings.view is not None:
            return settings.view, through(settings.lens, box)
        points = np.concatenate(
            [*(b.positions_world for one in scenes for b in one.bodies), *beside]
        )
        if settings.is_moving:  # nothing may jump: room for every turn about the origin
            points = ball(float(np.sqrt((points * points).sum(axis=1).max())) or 1.0)
        return self.about(points, box)

    def about(self, points: Array, box: Box) -> tuple[View, Lens]:
        """Return the camera in which points (n, 3) of the world fill a box."""
        low, high = points.min(axis=0), points.max(axis=0)
        centre = (low + high) / 2
        reach = float(np.sqrt(((points - centre) ** 2).sum(axis=1).max())) or 1.0
        eye = centre + np.array(self.eye, float) * reach / self.radius
        view = View(eye=tuple(eye.tolist()), target=tuple(centre.tolist()), up=self.up)
        return view, filling(view, points, box, self._inside(box), self.room * reach)

    def _inside(self, box: Box) -> Box:
        """Return the part of a stage that bodies fill: a quarter of each side at the least."""
        left, top, right, bottom = self.free
        across = min(1.0, 0.75 * box.width / (left + right))
        down = min(1.0, 0.75 * box.height / (top + bottom))
        return Box(
            box.x + across * left,
            box.y + down * top,
            box.width - across * (left + right),
            box.height - down * (top + bottom),
        )


def ball(radius: float) -> Array:
    """Return points (n, 3) all over a ball about the origin."""
    turns, heights = np.meshgrid(np.linspace(0, 2 * np.pi, 24), np.linspace(-1, 1, 13))
    around = np.sqrt(1 - heights * heights)
    return radius * np.stack([around * np.cos(turns), heights, around * np.sin(turns)], -1).reshape(
        -1, 3
    )


def staged(
    slide: Slide,
    settings: ProofSettings,
    pose: Pose,
    parts: Sequence[tuple[Panel, Scene]],
    beside: Sequence[Array] = (),
) -> list[Stage]:
    """Draw scenes on the stages of their panels, all seen by one camera.

    Points (n, 3) of the world `beside` the bodies are kept in sight too.
    """
    box = parts[0][0].stage
    view, lens = pose.camera(settings, [loaded(scene) for _, scene in parts], box, beside)
    return [draw_on(slide, panel, replace(scene, view=view, lens=lens)) for panel, scene in parts]


def draw_on(slide: Slide, panel: Panel, scene: Scene, background: Colour | None = None) -> Stage:
    """Draw a scene, whose camera has the shape of the panel's stage, on it, or before the night."""
    return put(slide, panel, drawn_for(slide, panel.stage, scene, background))


def drawn_for(
    slide: Slide, stage: Box, scene: Scene, background: Colour | None = None
) -> DrawnScene:
    """Draw a scene before the colour of stages, in the pixels of one."""
    return drawn_scene(
        replace(scene, has_camera=True),
        keeps_depth=True,
        size=slide.canvas.pixels_of(stage),
        background=background or channels(slide.palette.stage),
    )


def put(slide: Slide, panel: Panel, drawn: DrawnScene) -> Stage:
    """Lay a picture that was drawn for a stage on it."""
    slide.canvas.image(panel.stage, drawn.levels)
    if not drawn.rendered.work.fragments:
        slide.no_answer(panel, _why_nothing(drawn))
    return Stage(slide.canvas, panel.stage, drawn)


def _why_nothing(drawn: DrawnScene) -> str:
    """Say why nothing is drawn: no surface is left of the bodies, or none is in sight."""
    bodies = drawn.loaded.bodies
    if any(normals_by(drawn.loaded, one, NormalRule.EXACT).any() for one in bodies):
        return "nothing in sight"
    return NO_SURFACE[max((one.linear_map.rank for one in bodies), default=0)]


def put_inside(slide: Slide, panel: Panel, drawn: DrawnScene) -> None:
    """Lay a picture on a stage in which all that is seen is the inside of a surface: hatched."""
    palette, depth = slide.palette, drawn.rendered.depth
    assert depth is not None  # a stage is drawn with it
    light = drawn.rendered.rgb.mean(axis=2)
    shade = DIMMEST + (1 - DIMMEST) * light / (float(light.max()) or 1.0)
    y, x = (np.indices(light.shape) + 0.5) / slide.canvas.scale
    across = np.abs((x + y) / np.sqrt(2) % STRIPES - STRIPES / 2)
    striped = ((STRIPE / 2 - across) * slide.canvas.scale + 0.5).clip(0, 1)[:, :, None]
    wrong, inside = (np.array(channels(one)) for one in (palette.wrong, palette.inside))
    colours = (striped * wrong + (1 - striped) * inside) * shade[:, :, None]
    part = depth.coverage[:, :, None]
    paper = np.array(drawn.loaded.settings.background)
    slide.canvas.image(panel.stage, levels(part * colours + (1 - part) * paper))


def put_heat(slide: Slide, panel: Panel, drawn: DrawnScene, found: AngleMap, scale: Scale) -> Stage:
    """Lay a map of angles on a stage, with its bar; what has no normal has the stage's colour."""
    parts = found.pixel_deg / scale.largest_deg
    stage = put_map(slide, panel, drawn, parts, found.compared)
    ramp_bar(slide.canvas, bar_of(panel), ("0°", f"{scale.largest_deg:.3g}°"))
    return stage


def put_map(slide: Slide, panel: Panel, drawn: DrawnScene, parts: Array, known: Array) -> Stage:
    """Lay a map of parts of 1 (height, width) on a stage; `known` is the part that each pixel has.

    The rest of it has the stage's colour. Edges of `drawn` can be drawn over it.
    """
    paper = np.array(drawn.loaded.settings.background)
    share = known[:, :, None]
    colours = ramp(parts, slide.palette.heat)
    slide.canvas.image(panel.stage, levels(share * colours + (1 - share) * paper))
    return Stage(slide.canvas, panel.stage, drawn)


def bar_of(panel: Panel) -> Box:
    """Return the box of the bar that explains a map, at the foot of its stage."""
    stage = panel.stage
    return Box(stage.x + 24, stage.bottom - 44, stage.width - 48, 18)


def tacks(
    stage: Stage, body: Body, rule: NormalRule, settings: ProofSettings | None = None
) -> list[Tack]:
    """Return the tacks of a body where a stage shows it best: true normals, and those of a rule.

    In the frames of an animation the places stay on the body, and those that are seen are drawn.
    An arrow is as long as the rule makes normals: one that it makes zero is none.
    """
    mesh, points = body.mesh, body.positions_world
    true, ruled = (normals_by(stage.loaded, body, one).T for one in (NormalRule.EXACT, rule))
    found = spread_over(mesh, points)
    found = found.some(np.flatnonzero(found.of(mesh, true).any(axis=1)))
    if settings is not None and settings.is_moving:
        found = found.some(farthest_apart(found.of(mesh, points), FIXED, 0.0))
        found = found.some(np.flatnonzero(stage.sees(found.of(mesh, points))))
    else:
        found = found.some(_shown_best(stage, body, found, true))
    long = length(ruled.T)[:, None]
    place, normal, arrow, size = (found.of(mesh, one) for one in (points, true, ruled, long))
    return [Tack(*one) for one in zip(place, unit(normal), size * unit(arrow), strict=True)]


def _shown_best(stage: Stage, body: Body, found: Places, true: Array) -> Array:
    """Choose places on the silhouette and inside it, apart from each other in the picture."""
    place, normal = found.of(body.mesh, body.positions_world), unit(found.of(body.mesh, true))
    cosine = (normal * unit(stage.eye - place)).sum(axis=1)
    seen = stage.sees(place)
    window = stage.window(place)[:, :2]
    reach = radius_of(body)
    centre = stage.window(body.centre[None] + np.array([[0.0, 0, 0], stage.across * reach]))
    unit_length = float(np.abs(np.diff(centre[:, :2], axis=0)).max())
    rim = np.flatnonzero(seen & (np.abs(cosine) < SILHOUETTE))
    rim = rim[np.argsort(window[rim, 1], kind="stable")]  # from the top
    rim = rim[farthest_apart(window[rim], ON_SILHOUETTE, APART * unit_length)]
    inside = np.flatnonzero(seen & (cosine > FACING[0]) & (cosine < FACING[1]))
    if not len(inside) and not len(rim):
        inside = np.flatnonzero(seen & (cosine > SILHOUETTE))
    rings = rings_around(place[inside], normal[inside], 1.3 * DISC * reach, RIM_POINTS)
    on_body = stage.covers(rings.reshape(-1, 3)).reshape(-1, RIM_POINTS)
    inside = inside[on_body.all(axis=1)]  # discs that hang over no edge of the body
    inside = inside[np.argsort(np.abs(cosine[inside] - sum(FACING) / 2), kind="stable")]
    apart = INNER_APART * unit_length
    inside = inside[farthest_apart(window[inside], INSIDE, apart, window[rim])]
    return np.concatenate([rim, inside])
