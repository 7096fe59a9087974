"""The depth proof: two floors, one just under the other, in three buffers, both ways round."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import hypot, log10
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.canvas.glyphs import DIAGRAM_SHAFT, Ink, Verdict, arrow, disc, line
from nmatrix.canvas.marks import Box, Canvas, Point
from nmatrix.canvas.slide import CAPTION, GUTTER, HEADING, NARROW_HEADING, Panel, Slide
from nmatrix.canvas.text import LEADING
from nmatrix.canvas.theme import Palette, channels
from nmatrix.enums import DepthRange
from nmatrix.raster.drawn_scene import drawn_scene, level_difference
from nmatrix.raster.image import png
from nmatrix.raster.overlay.stage import Stage
from nmatrix.raster.proofs.proof import Proof, ProofSettings
from nmatrix.raster.proofs.staging import draw_on
from nmatrix.scene.camera import View
from nmatrix.scene.geometry import ShapeGeometry
from nmatrix.scene.lens import Lens
from nmatrix.scene.material import WHITE, EmbeddedImage, Material, Texture, grey
from nmatrix.scene.scene import Scene, SceneObject
from nmatrix.scene.words import DepthBuffer, Shape
from nmatrix.scene.world import World

Array = NDArray[Any]
Key = tuple[DepthRange, DepthBuffer]

HEIGHT, GAP, NEAR, FAR = 30.0, 0.05, 0.01, 3000.0  # metres
ROLL_DEG, FOV_DEG = 16.0, 50.0
AHEAD = (0.0, -15.0, -60.0)  # where the eye looks
SIDE, SQUARES = 5000.0, 40.0  # metres: half the floor's side, and two of its squares
DIM = 0.83  # of every other square: so soft that far away they do not glitter
BUFFERS = {
    DepthBuffer.UNORM16: "16 bits",
    DepthBuffer.UNORM24: "24 bits",
    DepthBuffer.FLOAT32: "32-bit float",
}
SHOWN = (DepthBuffer.UNORM24, DepthBuffer.FLOAT32)  # with 16 bits nearly all is wrong
RANGES = {DepthRange.ZERO_TO_ONE: "standard", DepthRange.REVERSED: "reversed"}
COUNTED = (480, 320)  # pixels: shares are counted at one size
UPPER = Material("upper", ambient=WHITE, diffuse=grey(0.0))
LOWER = Material("lower", ambient=grey(0.0), diffuse=grey(0.0))

PICTURES, ROWS_APART, BELOW = 0.57, 62.0, 92.0  # of the width; units
AXIS_WIDE, AXIS_HIGH = 128.0, 76.0  # units for the numbers of the plot
DISTANCES = {10: "10 m", 100: "100 m", 1000: "1 km"}
LENGTHS = {1: "1 m", 1e-1: "10 cm", 1e-2: "1 cm", 1e-3: "1 mm", 1e-4: "0.1 mm", 1e-5: "10 µm"}
LEAST, MOST = 2e-6, 10.0  # metres: the ends of the plot


def standard_step(distance: Array) -> Array:
    """Return the metres between two stored depths of 24 bits, or of floats that run to 1.

    Depth is f(z − n) / z(f − n), so it grows by fn / (f − n) z² a metre. Beyond 2n it is above ½,
    where floats are as far apart as 24 bits are: 2⁻²⁴.

    Examples
    --------
    >>> f"{standard_step(np.array(100.0)):.3f}"  # 2⁻²⁴ · 100² / 0.01
    '0.060'
    """
    return np.asarray(2.0**-24 * distance**2 * (FAR - NEAR) / (FAR * NEAR))


def reversed_step(distance: Array) -> Array:
    """Return the most metres between two stored depths of floats that run from 1 to 0.

    Depth is n(f − z) / z(f − n), and floats are apart by 2⁻²³ of it at the most.

    Examples
    --------
    >>> f"{reversed_step(np.array(1500.0)) * 1e6:.1f} µm"  # 2⁻²³ · 1500 / 2
    '89.4 µm'
    """
    return np.asarray(2.0**-23 * distance * (1 - distance / FAR))


def gap(distance: Array) -> Array:
    """Return the metres along the sight between the floors: z / h for each metre of height.

    Examples
    --------
    >>> float(gap(np.array(600.0)))
    1.0
    """
    return np.asarray(distance * GAP / HEIGHT)


CROSSING = GAP / HEIGHT / float(standard_step(np.array(1.0)))  # where a step is as wide as the gap


def depth(settings: ProofSettings) -> Proof:
    """Draw two floors 5 cm apart, 3 km long, and count where the lower one shows through."""
    wrong = _counted(settings)
    slide = settings.slide("Float depth pays off only when it runs backwards: near = 1, far = 0")
    body = slide.body(BELOW)
    left = replace(body, width=PICTURES * body.width)
    fights = [
        _fight(slide, settings, place, (order, buffer), wrong[order, buffer])
        for row, order in zip(left.rows(2, ROWS_APART), RANGES, strict=True)
        for place, buffer in zip(row.columns(len(SHOWN), GUTTER), SHOWN, strict=True)
    ]
    (first, one), *others = fights
    for panel, other in others[:-1]:
        if not level_difference(one.drawn, other.drawn):
            slide.compare(first, panel, same=True)
    x = left.right + AXIS_WIDE
    _plot(slide, Box(x, body.y, body.right - x, body.height - AXIS_HIGH))
    slide.footer(
        f"The lower floor is {100 * GAP:g} cm below. From {CROSSING:.0f} m on a step of depth can "
        "be wider than the gap, and chance decides."
    )
    standard, reverse = (wrong[order, DepthBuffer.FLOAT32] for order in RANGES)
    return Proof.of(
        settings.subject,
        slide,
        f"In float32 {standard:.1%} of the floor is wrong with standard depth, {reverse:.1%} with "
        "reversed depth: its steps are finest where perspective needs them.",
        [stage.drawn for _, stage in fights],
        numbers={
            f"wrong_{buffer.name.lower()}_{RANGES[order]}": share
            for (order, buffer), share in wrong.items()
        },
    )


def _counted(settings: ProofSettings) -> dict[Key, float]:
    """Count the part of the upper floor that the lower one hides, in each buffer, both ways."""
    whole = _is_white(_floors(settings, (DepthRange.ZERO_TO_ONE, DepthBuffer.FULL), UPPER))
    return {
        key: float((whole & ~_is_white(_floors(settings, key, UPPER, LOWER))).sum() / whole.sum())
        for key in ((order, buffer) for order in RANGES for buffer in BUFFERS)
    }


def _is_white(scene: Scene) -> Array:
    lens = replace(scene.lens, aspect=COUNTED[0] / COUNTED[1])
    drawn = drawn_scene(replace(scene, lens=lens), size=COUNTED, samples=1)
    return np.asarray(drawn.levels[:, :, 0] == 255)


def _fight(
    slide: Slide, settings: ProofSettings, place: Box, key: Key, wrong: float
) -> tuple[Panel, Stage]:
    """Draw the floors in one buffer, and how much of the upper one is wrong."""
    order, buffer = key
    verdict = Verdict.WRONG if wrong else Verdict.RIGHT
    words = f"{RANGES[order]}, {BUFFERS[buffer]}"
    panel = slide.panel(place, words, verdict, size=NARROW_HEADING)
    palette, box = slide.palette, panel.stage
    scene = _floors(settings, key, *_shown(palette))
    lens = replace(scene.lens, aspect=box.width / box.height)
    stage = draw_on(slide, panel, replace(scene, lens=lens))
    _line_at_crossing(stage)
    told = f"{100 * wrong:.2g} % wrong" if wrong else "none wrong"
    corner = box.right - 16, box.bottom - 18
    slide.canvas.text(corner, told, HEADING, bold=True, align=1.0, halo=palette.paper)
    return panel, stage


def _shown(palette: Palette) -> tuple[Material, Material]:
    """Return the materials of the upper and the lower floor as they are shown."""
    dim = round(DIM * 255)
    squares = np.full((64, 64, 3), 255, np.uint8)
    squares[:32, :32] = squares[32:, 32:] = dim
    repeats = 2 * SIDE / SQUARES
    texture = Texture(EmbeddedImage("squares", png(squares, {})), scale=(repeats, repeats))
    upper, lower = channels(palette.body), channels(palette.wrong)
    return replace(UPPER, ambient=upper, texture=texture), replace(LOWER, ambient=lower)


def _floors(settings: ProofSettings, key: Key, *materials: Material) -> Scene:
    """Return floors of some materials, each one gap under the one before, seen by a rolled eye."""
    order, buffer = key
    objects = [
        SceneObject(
            material.name,
            ShapeGeometry(Shape.PLANE),
            World(translate=(0, -GAP * i, 0), scale=(SIDE, 1, SIDE)).world_from_object,
            material,
        )
        for i, material in enumerate(materials)
    ]
    # The lower floor is named first, so that equal depths do not hide behind the order.
    scene = settings.still.scene(*reversed(objects))
    clip = replace(settings.lens.clip, depth=order)
    lens = Lens(fov_degrees=FOV_DEG, near=NEAR, far=FAR, clip=clip)
    roll = np.radians(ROLL_DEG + settings.picture.turn_degrees)
    up = (float(np.sin(roll)), float(np.cos(roll)), 0.0)
    x, y, z = AHEAD
    view = View(eye=(0, HEIGHT, 0), target=(x, HEIGHT + y, z), up=up)
    return replace(
        scene,
        view=view,
        lens=lens,
        has_camera=True,
        settings=replace(scene.settings, depth=buffer),
    )


def _line_at_crossing(stage: Stage) -> None:
    """Draw the line on the floor where a standard step is as wide as the gap, with its distance."""
    _, y, z = AHEAD
    away = (CROSSING * hypot(y, z) + HEIGHT * y) / -z  # along the ground
    aside = np.linspace(-1, 1, 401) * 2 * CROSSING
    ground = np.stack([aside, 0 * aside, np.full_like(aside, -away)], axis=1)
    palette, inside = stage.canvas.palette, stage.box.inset(1.0)
    seen = [(x, y) for x, y, _ in stage.window(ground) if inside.holds((x, y))]
    if len(seen) < 2:
        return
    stage.canvas.stroke(seen, 2.4, palette.ink, dash=(9, 6))
    x, y = min(seen)
    below = (x + 16, y + 34)
    stage.canvas.text(below, f"{CROSSING:.0f} m", CAPTION, bold=True, halo=palette.paper)


@dataclass(frozen=True)
class LogLog:
    """A plot with logarithmic axes in a box: distances to the right, lengths upwards."""

    box: Box
    distances: tuple[float, float]
    lengths: tuple[float, float]

    def at(self, distance: float, length: float) -> Point:
        """Return the place of a point.

        Examples
        --------
        >>> LogLog(Box(0, 0, 100, 60), (1, 100), (1, 1000)).at(10, 100)
        (50.0, 20.0)
        """
        across, up = (
            log10(value / low) / log10(high / low)
            for value, (low, high) in ((distance, self.distances), (length, self.lengths))
        )
        return self.box.x + across * self.box.width, self.box.bottom - up * self.box.height

    def curve(self, function: Callable[[Array], Array]) -> list[Point]:
        """Return the points of a function where they are inside."""
        low, high = self.lengths
        distances = np.geomspace(*self.distances, 600)
        lengths = function(distances)
        return [
            self.at(float(z), float(y))
            for z, y in zip(distances, lengths, strict=True)
            if low <= y <= high
        ]


def _plot(slide: Slide, box: Box) -> None:
    """Draw a step of depth against the distance, and the gap that it must not exceed."""
    panel = slide.panel(box, "The size of one step of depth", size=NARROW_HEADING)
    canvas, palette = slide.canvas, slide.palette
    plot = LogLog(panel.stage, (10.0, FAR), (LEAST, MOST))
    _grid(canvas, plot)
    canvas.stroke(plot.curve(gap), 3.4, palette.ink)
    line(canvas, plot.curve(standard_step), Ink.WRONG, DIAGRAM_SHAFT)
    line(canvas, plot.curve(reversed_step), Ink.RIGHT, DIAGRAM_SHAFT)
    widest, finest = (step(np.array(CROSSING)) for step in (standard_step, reversed_step))
    times = float(f"{widest / finest:.2g}")
    crossing = plot.at(CROSSING, float(widest))
    foot = crossing[0], panel.stage.bottom
    canvas.stroke((crossing, foot), 2.4, palette.ink, dash=(9, 6))
    canvas.text((foot[0], foot[1] + 32), f"{CROSSING:.0f} m", CAPTION, bold=True, align=0.5)
    arrow(canvas, crossing, plot.at(CROSSING, float(finest)), Ink.PLAIN)
    disc(canvas, crossing, 9.0, palette.paper, palette.ink)
    for place, words, colour in (
        ((14.0, 2.0), "24 bits, and\nstandard float", palette.wrong),
        ((14.0, 0.22), "the floors' gap", palette.ink),
        ((14.0, 3e-5), "reversed float", palette.right),
        ((1.12 * CROSSING, 4e-3), f"{times:,.0f} times\nfiner", palette.ink),
    ):
        x, y = plot.at(*place)
        for i, one in enumerate(words.split("\n")):
            line_at = x, y + LEADING * CAPTION * i
            canvas.text(line_at, one, CAPTION, colour, bold=True, halo=palette.stage)


def _grid(canvas: Canvas, plot: LogLog) -> None:
    """Draw the lines of powers of ten with their numbers, and what goes to the right."""
    palette, box = canvas.palette, plot.box
    colour = palette.rule if palette.stage == palette.paper else palette.paper
    for distance, words in DISTANCES.items():
        x, _ = plot.at(distance, LEAST)
        canvas.stroke(((x, box.y), (x, box.bottom)), 2.0, colour)
        align = 0.5 if distance > plot.distances[0] else 0.0
        canvas.text((x, box.bottom + 32), words, CAPTION, palette.soft, align=align)
    for length, words in LENGTHS.items():
        _, y = plot.at(plot.distances[0], length)
        canvas.stroke(((box.x, y), (box.right, y)), 2.0, colour)
        canvas.text((box.x - 14, y + 8), words, CAPTION, palette.soft, align=1.0)
    below = box.middle[0], box.bottom + 68
    canvas.text(below, "distance ahead of the eye", CAPTION, palette.soft, align=0.5)
