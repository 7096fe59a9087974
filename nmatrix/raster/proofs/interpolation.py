"""The proof of what must happen before, while and after values are mixed inside a triangle."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum
from itertools import pairwise
from math import asin, cos, degrees, hypot, sin, sqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.canvas.glyphs import HALO, Ink, Verdict, arrow, disc, line
from nmatrix.canvas.marks import Box, Canvas, Point
from nmatrix.canvas.slide import GUTTER, NARROW_HEADING, Slide
from nmatrix.enums import Effect, NormalRule, Reflection, Theme
from nmatrix.linear.affine import translation_matrix
from nmatrix.raster.drawn_scene import DrawnScene, drawn_scene, level_difference
from nmatrix.raster.image import levels
from nmatrix.raster.loaded_scene import loaded
from nmatrix.raster.overlay.stage import Stage
from nmatrix.raster.proofs.angles import INVISIBLE_DEG, AngleMap, angle_map
from nmatrix.raster.proofs.proof import Proof, ProofSettings
from nmatrix.raster.proofs.staging import Pose, drawn_for, put, staged
from nmatrix.raster.render import surface_of
from nmatrix.raster.shading.normals import normals_by
from nmatrix.raster.shading.surface import Surface
from nmatrix.scene.geometry import ShapeGeometry
from nmatrix.scene.light import SceneLight
from nmatrix.scene.material import CHECKER, Material, grey
from nmatrix.scene.scene import Scene, SceneObject
from nmatrix.scene.words import LightKind, Shape
from nmatrix.scene.world import World

Array = NDArray[Any]

COARSE = ShapeGeometry(Shape.SPHERE, (5, 8))
TALL = World(scale=(1, 3, 1))
FROM_THE_RIGHT = SceneLight("sun", LightKind.DIRECTIONAL, direction=(-0.6, -0.75, -0.5))
BESIDE = Pose((1.6, 1.2, 9.2), radius=3, room=0.0, free=(20,) * 4)
PARTS = ("ambient", "diffuse")
RIM = 3  # pixels from the outline, where there is no step but an end
STEPS = 9  # of the shade, whose edges show what a smooth one hides
FLOOR = World(scale=(3, 1, 6))
FLOOR_AT = (0, -1, -3)
ALONG_THE_FLOOR = Pose((-2.0, 2.6, 9.2), radius=6.7, up=(0.12, 1, 0), room=0.0, free=(14,) * 4)
COUNTED = Box(0, 0, 480, 270)  # pixels: shares are counted at one size
SEEN = 8  # levels
LENGTH_SEEN = 0.005
CREAM = (0.95, 0.85, 0.70)
LEFT_SHARE, FAN_HIGH, BELOW, APART = 0.628, 206.0, 126.0, 12.0
FAN, LONGEST, FAN_WIDE, FAN_PAD = 7, 118.0, 156.0, 8.0  # normals along an edge; units
ROWS_APART, EDGE_WIDE = 66.0, 6.0


class Mix(Enum):
    """When normals are brought to length one: whether before, and whether after they are mixed."""

    NEVER = (False, False)
    AFTER = (False, True)
    BOTH = (True, True)

    @property
    def heading(self) -> str:
        """Return the words over its panel."""
        words = {Mix.NEVER: "never normalised", Mix.AFTER: "only afterwards"}
        return words.get(self, "before and after")

    def applied(self, surface: Surface) -> Surface:
        """Return a surface with normals that are mixed so.

        Without the first, they have the lengths that A⁻ᵀ, or for a flat body C, leaves them.
        """
        before, after = self.value
        effects = surface.effects - {Effect.RENORMALISE}
        is_flat = surface.space.body.linear_map.rank < 3
        rule = NormalRule.EXACT if before or is_flat else NormalRule.INVERSE
        return replace(
            surface,
            style=replace(surface.style, unit_vertices=before, rule=rule),
            effects=effects | {Effect.RENORMALISE} if after else effects,
        )

    def along(self, bend: Bend) -> list[Point]:
        """Return the normals along an edge from its shorter to its longer one, as the mix has them.

        They are x to the right and y up; the longest given one has length 1.
        """
        before, after = self.value
        half = bend.between / 2
        first = 1.0 if before else 1 / bend.ratio
        found = []
        for i in range(FAN):
            t = i / (FAN - 1)
            x, y = ((t - (1 - t) * first) * sin(half), ((1 - t) * first + t) * cos(half))
            size = hypot(x, y) if after else 1.0
            found.append((x / size, y / size) if size else (0.0, 0.0))
        return found


@dataclass(frozen=True)
class Bend:
    """The edge of a mesh along which mixing normals of unequal length bends them most.

    `ratio` is the longer length over the shorter, `between` the angle of the two in radians.
    """

    ratio: float
    between: float

    @property
    def worst_deg(self) -> float:
        """Return how far off they are at the worst, in degrees.

        A mix α : β of unit vectors an angle θ apart lies at atan2(β sin θ, α + β cos θ). If the
        second is k times as long, it is off most where α : β = √k : 1: from as far on one side of
        the middle to as far on the other.

        Examples
        --------
        >>> round(Bend(ratio=4.0, between=np.pi / 2).worst_deg, 6)
        36.869898
        """
        return degrees(float(_bend(np.array(self.ratio), np.array(self.between))))


def _bend(ratio: Array, between: Array) -> Array:
    """Return the largest angle by which mixing bends, of arrays of edges."""
    k = np.sqrt(ratio)
    return np.asarray(2 * np.arctan2(k * np.sin(between), 1 + k * np.cos(between)) - between)


def most_bent(normals: Array, triangles: Array) -> Bend:
    """Find the edge of triangles (F, 3) whose normals (V, 3), of any length, bend most."""
    lengths = np.sqrt((normals * normals).sum(axis=1))
    a, b = (triangles[:, list(corners)].ravel() for corners in ((0, 1, 2), (1, 2, 0)))
    kept = (lengths[a] > 0) & (lengths[b] > 0)
    if not kept.any():
        return Bend(1.0, 0.0)
    a, b = a[kept], b[kept]
    ratio = np.maximum(lengths[a], lengths[b]) / np.minimum(lengths[a], lengths[b])
    across = np.cross(normals[a], normals[b])
    between = np.arctan2(
        np.sqrt((across * across).sum(axis=1)), (normals[a] * normals[b]).sum(axis=1)
    )
    worst = int(np.argmax(_bend(ratio, between)))
    return Bend(float(ratio[worst]), float(between[worst]))


def interpolation(settings: ProofSettings) -> Proof:
    """Draw normals made unit never, after, before and after a mix; a floor weighed two ways."""
    slide = settings.slide("Unequal lengths bend normals; unequal depths bend patterns")
    body = slide.body(BELOW)
    left = replace(body, width=LEFT_SHARE * body.width)
    apart = left.width + 2 * GUTTER
    line = ((left.right + GUTTER, body.y - 46), (left.right + GUTTER, slide.frame.bottom - 36))
    slide.canvas.stroke(line, 2.0, slide.palette.rule)
    bodies = _bodies(slide, settings, left)
    floors = _floors(slide, settings, Box(body.x + apart, body.y, body.width - apart, body.height))
    moved, bend = _moved_part(settings), bodies.bend.worst_deg
    never, after, both = bodies.drawn
    bent = f"Along an edge normals of unequal length bend by up to {bend:.1f}°"
    if not any(normals_by(both.loaded, one, NormalRule.EXACT).any() for one in both.loaded.bodies):
        bent = "No normal survives this map"
    return Proof.of(
        settings.subject,
        slide,
        f"{bent}; weights of the screen move the pattern in {moved:.0%} of the floor.",
        [*floors, never, after, both],
        numbers={
            "never_level_difference": level_difference(never, both),
            "after_level_difference": level_difference(after, both),
            "affine_wrong_part": moved,
        },
        max_level_difference=level_difference(never, both),
        **bodies.bent.errors,
    )


@dataclass(frozen=True, eq=False)
class Bodies:
    """One body drawn by each mix of its normals; how unequal lengths bend them.

    `widest` is the largest angle between two that are mixed, in radians.
    """

    drawn: tuple[DrawnScene, ...]
    lengths: Array
    widest: float
    bend: Bend
    bent: AngleMap

    def verdict(self, mix: Mix) -> Verdict | None:
        """Judge a mix by its normals, whether the picture shows it or not; None without any."""
        if not self.lengths.any():
            return None
        is_right = {
            Mix.NEVER: self.are_unit and self.widest < LENGTH_SEEN,
            Mix.AFTER: self.bend.worst_deg < INVISIBLE_DEG,
            Mix.BOTH: True,
        }[mix]
        return Verdict.RIGHT if is_right else Verdict.WRONG

    @property
    def are_unit(self) -> bool:
        """True if every normal has length one as it is."""
        return bool(np.abs(self.lengths - 1).max() < LENGTH_SEEN)

    def told(self, mix: Mix) -> str:
        """Tell what a mix does here."""
        if not self.lengths.any():
            return "No normal survives this map."
        if mix is Mix.NEVER:
            return f"{self._told_of_lengths} (Shade in steps, to show its form.)"
        if mix is Mix.BOTH:
            return "Unit length at the corners, and again at every pixel."
        if self.verdict(mix) is Verdict.RIGHT:
            return "Nothing bends here: what is mixed is equally long, or parallel."
        off = f"up to {self.bend.worst_deg:.2g}° off"
        return f"The longer normal pulls: {off}. Thin lines: as it should be."

    @property
    def _told_of_lengths(self) -> str:
        shortest, longest = float(self.lengths.min()), float(self.lengths.max())
        if longest > 1 + LENGTH_SEEN:
            return f"Normals up to {longest:.2g} long shine."
        if shortest < 1 - LENGTH_SEEN:
            return f"Normals down to {shortest:.2g} long are dark."
        if self.verdict(Mix.NEVER) is Verdict.RIGHT:
            return "Every mix has length one."
        return "A mix is short, and dark."


def _bodies(slide: Slide, settings: ProofSettings, box: Box) -> Bodies:
    """Draw one body three times, and above each how normals are mixed along its worst edge."""
    columns = [_parted(slide, column) for column in box.columns(3, GUTTER)]
    found = _mixed(slide, settings, columns[0][1])
    panels = []
    for mix, drawn, (above, below) in zip(Mix, found.drawn, columns, strict=True):
        verdict = found.verdict(mix)
        fan = slide.panel(above, mix.heading, verdict, size=NARROW_HEADING)
        if verdict is not None:
            _fan(slide.canvas, fan.stage, found.bend, mix, is_right=verdict is Verdict.RIGHT)
        panels.append(slide.panel(below, "", verdict, found.told(mix)))
        stage = put(slide, panels[-1], drawn)
        stage.outline(sharp=False)
        if mix is Mix.AFTER and verdict is Verdict.WRONG:
            _step_edges(stage, found.drawn[-1])
        stage.lights()
    for (one, a), (other, b) in pairwise(zip(panels, found.drawn, strict=True)):
        if not level_difference(a, b):
            slide.compare(one, other, same=True)
    return found


def _parted(slide: Slide, column: Box) -> tuple[Box, Box]:
    """Part a column into the stage of a fan and, below it, that of a body."""
    top = FAN_HIGH + APART
    below = Box(column.x, column.y + top, column.width, column.height - top)
    return replace(column, height=FAN_HIGH), slide.canvas.on_pixels(below)


def _mixed(slide: Slide, settings: ProofSettings, stage: Box) -> Bodies:
    """Draw a body for a stage by each mix, and find how far unequal lengths bend its normals."""
    one = settings.object(
        settings.placed(TALL),
        settings.geometry(COARSE),
        reflection=Reflection.TOON,
        toon_steps=STEPS,
    )
    scene = settings.scene(one, lights=(FROM_THE_RIGHT,))
    view, lens = BESIDE.camera(settings, [loaded(scene)], stage)
    right = drawn_for(slide, stage, replace(scene, view=view, lens=lens))
    surface = surface_of(right.plan, right.plan.bodies[0], {}, 1)
    unequal, equal = (mix.applied(surface).vertex_normals for mix in (Mix.AFTER, Mix.BOTH))
    return Bodies(
        tuple(right.redrawn(mix.applied) for mix in Mix),
        np.sqrt((unequal * unequal).sum(axis=0)),
        _widest(equal.T, surface.space.body.mesh.triangles),
        most_bent(unequal.T, surface.space.body.mesh.triangles),
        angle_map(right.plan, [unequal], [equal]),
    )


def _widest(normals: Array, triangles: Array) -> float:
    """Return the largest angle between unit normals (V, 3) at corners of one triangle."""
    pairs = (normals[triangles[:, i]] - normals[triangles[:, i - 1]] for i in range(3))
    farthest = max(float((one * one).sum(axis=1).max()) for one in pairs)
    return 2 * asin(min(sqrt(farthest) / 2, 1.0))


def _fan(canvas: Canvas, box: Box, bend: Bend, mix: Mix, *, is_right: bool) -> None:
    """Draw the normals along an edge; where they are bent, thin lines show the right ones."""
    palette, (middle, _), y = canvas.palette, box.middle, box.bottom - 34
    start = middle - FAN_WIDE / 2
    feet = [(start + i * FAN_WIDE / (FAN - 1), y) for i in range(FAN)]
    canvas.stroke((feet[0], feet[-1]), 4.0, palette.ink)
    aside = (box.width - FAN_WIDE) / 2 - FAN_PAD
    longest = min(LONGEST, aside / max(sin(bend.between / 2), 1e-9))
    for foot, (x, up) in zip(feet, Mix.BOTH.along(bend), strict=True):
        if mix is Mix.AFTER and not is_right:
            tip = (foot[0] + longest * x, foot[1] - longest * up)
            canvas.stroke((foot, tip), 2.4, palette.right)
    for i, (foot, (x, up)) in enumerate(zip(feet, mix.along(bend), strict=True)):
        tip = (foot[0] + longest * x, foot[1] - longest * up)
        arrow(canvas, foot, tip, Ink.RIGHT if is_right else Ink.WRONG)
        disc(canvas, foot, 7.0 if i in (0, FAN - 1) else 4.0, palette.ink)


def _step_edges(stage: Stage, drawn: DrawnScene) -> None:
    """Draw the edges between the steps of shade that another picture of the same body has."""
    from contourpy import contour_generator

    covered = np.pad(stage.depth.coverage == 1, RIM)
    inside = np.min([np.roll(covered, s, axis) for s in (RIM, -RIM) for axis in (0, 1)], axis=0)
    shade = np.ma.masked_array(drawn.rendered.rgb[:, :, 0], ~inside[RIM:-RIM, RIM:-RIM])
    (dark, *_), (lit, *_) = (getattr(drawn.loaded.bodies[0].material, one) for one in PARTS)
    origin, per_pixel = (stage.box.x, stage.box.y), 1 / stage.canvas.scale
    lines = contour_generator(z=shade)
    for step in range(2, STEPS, 2):
        for points in lines.lines(dark + lit * (step + 0.5) / STEPS):
            places = origin + (np.asarray(points) + 0.5) * per_pixel
            stage.canvas.stroke(places, 2.4, stage.canvas.palette.right)


def _floors(slide: Slide, settings: ProofSettings, box: Box) -> list[DrawnScene]:
    """Draw a floor of two triangles, weighed by areas on the screen and as perspective asks."""
    upper, lower = box.rows(2, ROWS_APART)
    told = "A floor of two triangles; dashed: the edge that they share."
    wrong = slide.panel(upper, "weighed on the screen", Verdict.WRONG, size=NARROW_HEADING)
    right = slide.panel(
        lower, "weighed by 1/*w*, *w* the depth", Verdict.RIGHT, told, size=NARROW_HEADING
    )
    own = _of_floors(settings)
    (true,) = staged(slide, own, ALONG_THE_FLOOR, [(right, _floor(own))])
    affine = put(slide, wrong, true.drawn.redrawn(_affine))
    (body,) = true.loaded.bodies
    shared = np.intersect1d(*body.mesh.triangles)
    for stage in (affine, true):
        stage.outline(sharp=False)
    places = (affine.place(point) for point in body.positions_world[shared])
    ends = [one for one in places if one is not None]
    if len(ends) == 2:
        slide.canvas.stroke(ends, EDGE_WIDE + 2 * HALO, slide.palette.paper)
        line(slide.canvas, ends, Ink.WRONG, EDGE_WIDE)
    return [affine.drawn, true.drawn]


def _of_floors(settings: ProofSettings) -> ProofSettings:
    """Return the settings of the floor: its own view, however the body is seen or turns."""
    return replace(settings.still, view=None)


def _floor(settings: ProofSettings) -> Scene:
    """Return a floor of two large triangles that runs away from the eye, and never turns."""
    colour = grey(0.85) if settings.theme is Theme.PRINT else CREAM
    material = Material("checker", ambient=colour, diffuse=grey(0.0), texture=CHECKER)
    place = FLOOR.under(translation_matrix(FLOOR_AT)).world_from_object
    return settings.scene(SceneObject("floor", ShapeGeometry(Shape.PLANE), place, material))


def _moved_part(settings: ProofSettings) -> float:
    """Count the part of a floor that the wrong weights colour wrong, in a picture of one size."""
    own = _of_floors(replace(settings, theme=Theme.LIGHT))
    scene = _floor(own)
    view, lens = ALONG_THE_FLOOR.camera(own, [loaded(scene)], COUNTED)
    size = (int(COUNTED.width), int(COUNTED.height))
    right = drawn_scene(replace(scene, view=view, lens=lens, has_camera=True), size=size, samples=1)
    blank = levels(np.array(right.loaded.settings.background))
    apart = np.abs(right.redrawn(_affine).levels.astype(int) - right.levels).max(axis=2) > SEEN
    return float(apart.sum() / (right.levels != blank).any(axis=2).sum())


def _affine(surface: Surface) -> Surface:
    return replace(surface, effects=surface.effects - {Effect.PERSPECTIVE, Effect.EXACT_WEIGHTS})
