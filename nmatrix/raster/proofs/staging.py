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
from nmatrix.enums import NormalRule
from nmatrix.raster.drawn_scene import DrawnScene, drawn_scene
from nmatrix.raster.image import levels
from nmatrix.raster.loaded_scene import Body, LoadedScene, loaded
from nmatrix.raster.overlay.stage import (
    ARROW,
    DISC,
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
from nmatrix.raster.proofs.angles import AngleMap, Scale, normals_by
from nmatrix.raster.proofs.proof import ProofSettings
from nmatrix.raster.shading.normals import unit
from nmatrix.report import Vector
from nmatrix.scene.camera import View
from nmatrix.scene.lens import Lens
from nmatrix.scene.scene import Scene

Array = NDArray[Any]

FIXED = 24  # tacks all over a body that turns
RIM_POINTS = 12


@dataclass(frozen=True)
class Pose:
    """From where a proof looks: an eye about a body of this radius at the origin.

    About a body that is larger, or elsewhere, the eye stands as much farther off, on the same side.
    """

    eye: Vector
    radius: float
    up: Vector = (0, 1, 0)

    def camera(
        self, settings: ProofSettings, scenes: Sequence[LoadedScene], box: Box
    ) -> tuple[View, Lens]:
        """Return the camera that was asked for, or the one in which the bodies fill a box."""
        if settings.view is not None:
            return settings.view, through(settings.lens, box)
        points = np.concatenate([b.positions_world for one in scenes for b in one.bodies])
        if settings.is_moving:  # nothing may jump: room for every turn about the origin
            points = _ball(float(np.sqrt((points * points).sum(axis=1).max())) or 1.0)
        low, high = points.min(axis=0), points.max(axis=0)
        centre = (low + high) / 2
        reach = float(np.sqrt(((points - centre) ** 2).sum(axis=1).max())) or 1.0
        eye = centre + np.array(self.eye, float) * reach / self.radius
        view = View(eye=tuple(eye.tolist()), target=tuple(centre.tolist()), up=self.up)
        return view, filling(view, points, box, ARROW * reach)


def _ball(radius: float) -> Array:
    turns, heights = np.meshgrid(np.linspace(0, 2 * np.pi, 24), np.linspace(-1, 1, 13))
    around = np.sqrt(1 - heights * heights)
    return radius * np.stack([around * np.cos(turns), heights, around * np.sin(turns)], -1).reshape(
        -1, 3
    )


def staged(
    slide: Slide, settings: ProofSettings, pose: Pose, parts: Sequence[tuple[Panel, Scene]]
) -> list[Stage]:
    """Draw scenes on the stages of their panels, all seen by one camera."""
    box = parts[0][0].stage
    view, lens = pose.camera(settings, [loaded(scene) for _, scene in parts], box)
    return [draw_on(slide, panel, replace(scene, view=view, lens=lens)) for panel, scene in parts]


def draw_on(slide: Slide, panel: Panel, scene: Scene) -> Stage:
    """Draw a scene, whose camera has the shape of the panel's stage, on it."""
    paper = slide.palette.stage
    drawn = drawn_scene(
        replace(scene, has_camera=True),
        keeps_depth=True,
        size=slide.canvas.pixels_of(panel.stage),
        background=tuple(int(paper[i : i + 2], 16) / 255 for i in (1, 3, 5)),
    )
    return put(slide, panel, drawn)


def put(slide: Slide, panel: Panel, drawn: DrawnScene) -> Stage:
    """Lay a picture that was drawn for a stage on it."""
    slide.canvas.image(panel.stage, drawn.levels)
    if not drawn.rendered.work.fragments:
        slide.no_answer(panel, "out of sight")
    return Stage(slide.canvas, panel.stage, drawn)


def put_heat(slide: Slide, panel: Panel, drawn: DrawnScene, found: AngleMap, scale: Scale) -> Stage:
    """Lay a map of angles on a stage, with its bar; what has no normal has the stage's colour."""
    paper = np.array(drawn.loaded.settings.background)
    part = found.compared[:, :, None]
    colours = scale.colours(found.pixel_deg, slide.palette.heat)
    slide.canvas.image(panel.stage, levels(part * colours + (1 - part) * paper))
    stage = panel.stage
    bar = Box(stage.x + 24, stage.bottom - 44, stage.width - 48, 18)
    ramp_bar(slide.canvas, bar, ("0°", f"{scale.largest_deg:.3g}°"))
    return Stage(slide.canvas, stage, drawn)


def tacks(
    stage: Stage, body: Body, rule: NormalRule, settings: ProofSettings | None = None
) -> list[Tack]:
    """Return the tacks of a body where a stage shows it best: true normals, and those of a rule.

    In the frames of an animation the places stay on the body, and those that are seen are drawn.
    A normal that the rule makes zero has no arrow.
    """
    mesh, points = body.mesh, body.positions_world
    true, ruled = (unit(normals_by(stage.loaded, body, one).T) for one in (NormalRule.EXACT, rule))
    found = spread_over(mesh, points)
    if settings is not None and settings.is_moving:
        found = found.some(farthest_apart(found.of(mesh, points), FIXED, 0.0))
        found = found.some(np.flatnonzero(stage.sees(found.of(mesh, points))))
    else:
        found = found.some(_shown_best(stage, body, found, true))
    place, normal, arrow = (found.of(mesh, one) for one in (points, true, ruled))
    return [Tack(*one) for one in zip(place, unit(normal), unit(arrow), strict=True)]


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
