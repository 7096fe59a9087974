"""A picture of the rasterizer on a canvas, and the marks of the world that are drawn over it.

Points of the world are put where the picture has them, by the same matrix. What lies on a surface
and is behind another one is left out; what stands for an idea (arrows, lamps, the eye) never is.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.canvas import glyphs
from nmatrix.canvas.glyphs import Ink
from nmatrix.canvas.marks import Box, Canvas, Point, Stroke
from nmatrix.enums import DepthRange
from nmatrix.linear.projection import Window
from nmatrix.linear.rational import to_floats
from nmatrix.raster.drawn_scene import DrawnScene
from nmatrix.raster.loaded_scene import Body, LoadedScene
from nmatrix.raster.overlay.mesh_lines import creases, seen, silhouettes, visible_pieces
from nmatrix.raster.overlay.tacks import SILHOUETTE, Tack
from nmatrix.raster.shading.normals import unit
from nmatrix.raster.triangles.picture import DepthMap
from nmatrix.report import Number
from nmatrix.scene.camera import View
from nmatrix.scene.lens import Lens

Array = NDArray[Any]

OUTLINE = 1.6  # units
PAD = 34.0
DISC, ARROW = 0.09, 0.27  # of the radius of the body
CORNER = 44.0  # of a sun, from the sides of its stage
EDGE_DASHES, DASHES = 4.0, (12.0, 8.0)  # the edge of the light
AXIS, LEAST_AXIS, LETTER = 4.2, 12.0, 22.0  # of an axis: its width, its least length, its letter
DOTS, STEPS = (5.0, 5.0), 64  # of the line to the ground
RIM, EDGE_ON = 2.6, 5.0  # the edge of a tack's disc, and of one that is a tangent from here
ZERO_DISC, ZERO = 0.17, 22  # the disc of a normal that is zero, and the size of its 0
LOST = 4.0  # the outline of what is not there
ARROW_STEPS = 121  # at which an arrow of the world is looked for
MOST_EDGED = 200_000  # triangles: the edges of more are finer than pixels


@dataclass(frozen=True, eq=False)
class Stage:
    """A drawn scene in a box of a canvas; `outlined` holds the lines of its outline."""

    canvas: Canvas
    box: Box
    drawn: DrawnScene
    outlined: list[Stroke] = field(default_factory=list, init=False)

    @property
    def loaded(self) -> LoadedScene:
        """Return the scene that is drawn."""
        return self.drawn.loaded

    @cached_property
    def clip_from_world(self) -> Array:
        """Return P · V as floats."""
        return np.array(to_floats(self.loaded.clip_from_world))

    def window(self, points: Array) -> Array:
        """Return the units x and y, and the depth, (n, 3) of points (n, 3) of the world.

        Depth is 0 near and 1 far. The numbers of a point that is not in front of the eye are NaN.
        """
        clip = (
            np.asarray(points, float) @ self.clip_from_world[:, :3].T + self.clip_from_world[:, 3]
        )
        w = clip[:, 3:]
        ndc = np.divide(clip[:, :3], w, out=np.full((len(clip), 3), np.nan), where=w > 0)
        space, box = self.loaded.clip, self.box
        depth = ndc[:, 2]
        if space.depth is DepthRange.MINUS_ONE_TO_ONE:
            depth = (depth + 1) / 2
        elif space.depth is DepthRange.REVERSED:
            depth = 1 - depth
        x = box.x + (ndc[:, 0] + 1) / 2 * box.width
        y = box.y + (1 - space.y_sign * ndc[:, 1]) / 2 * box.height
        return np.stack([x, y, depth], axis=1)

    def place(self, point: Sequence[Number] | Array) -> Point | None:
        """Return where a point of the world is on the canvas; None if the eye cannot see there."""
        x, y, _ = self.window(np.array([point], float))[0]
        return (float(x), float(y)) if np.isfinite(x) else None

    def direction(self, direction: Sequence[Number] | Array) -> Point:
        """Return a direction of the world as the eye sees it, on the canvas, up to its length."""
        camera = np.array(to_floats(self.loaded.camera_from_world.exact))[:3, :3]
        x, y, _ = camera @ np.asarray(direction, float)
        return float(x), -float(y)

    @property
    def depth(self) -> DepthMap:
        """Return the depth of the surfaces that are seen, and what they cover."""
        found = self.drawn.rendered.depth
        assert found is not None  # a stage is drawn with it
        return found

    @cached_property
    def eye(self) -> Array:
        """Return where the eye is in the world."""
        return np.array([float(one) for one in self.loaded.eye])

    @property
    def across(self) -> Array:
        """Return the direction of the world that goes to the right in the picture."""
        return np.array(to_floats(self.loaded.camera_from_world.exact))[0, :3]

    def sees(self, points: Array) -> Array:
        """Return a mask of the points (n, 3) of the world that no surface hides."""
        window = self.window(points)
        found: Array = np.asarray(np.isfinite(window).all(axis=1))
        found[found] = seen(self.pixels(window[found]), self.depth.farthest)
        return found

    def covers(self, points: Array) -> Array:
        """Return a mask of the points (n, 3) of the world behind or before which a surface is."""
        x, y, _ = np.nan_to_num(self.pixels(self.window(points)), nan=-1.0).T
        height, width = self.depth.farthest.shape
        inside = (x >= 0) & (x < width) & (y >= 0) & (y < height)
        column, row = x.astype(int).clip(0, width - 1), y.astype(int).clip(0, height - 1)
        return np.asarray(inside & np.isfinite(self.depth.farthest[row, column]))

    def pixels(self, window: Array) -> Array:
        """Return points of the canvas in pixels of the picture."""
        k = self.canvas.scale
        return np.asarray((window - [self.box.x, self.box.y, 0]) * [k, k, 1])

    def from_pixels(self, points: Array) -> Array:
        """Return pixels x and y (…, 2) of the picture on the canvas."""
        return np.asarray(points / self.canvas.scale + [self.box.x, self.box.y])

    def outline(self, *, sharp: bool = True) -> None:
        """Draw the outline of all that is covered in ink, and the visible edges inside it."""
        before = len(self.canvas.marks)
        for points in self._rims():
            self.canvas.stroke(points, OUTLINE * 1.2, self.canvas.palette.ink)
        for body in self.loaded.bodies if sharp else ():
            if len(body.mesh.triangles) > MOST_EDGED:
                continue
            points = body.positions_world
            chains = [points[chain] for chain in creases(body.mesh)]
            for chain in (*chains, *silhouettes(body.mesh, points, self.eye)):
                self.surface_line(chain, OUTLINE, self.canvas.palette.ink)
        drawn = self.canvas.marks[before:]
        self.outlined.extend(one for one in drawn if isinstance(one, Stroke))

    def outline_like(self, other: Stage) -> None:
        """Draw the outline of a stage of the same size that shows the same surfaces.

        Where they differ in a pixel, or the other has none yet, it gets an outline of its own.
        """
        if not other.outlined or not np.array_equal(self.depth.coverage, other.depth.coverage):
            self.outline()
            return
        by = np.array([self.box.x - other.box.x, self.box.y - other.box.y])
        for one in other.outlined:
            self.canvas.stroke(np.array(one.points) + by, one.width, one.colour)

    def lost_outline(self) -> None:
        """Draw the outline of what would be covered, dashed, where it could not be drawn."""
        for points in self._rims():
            glyphs.line(self.canvas, points, Ink.WRONG, LOST)

    def cut_out(self, fill: str) -> None:
        """Fill all that is covered with one colour, edged in ink: what is drawn becomes a plan."""
        rims = [line for line in self._rims() if len(line) > 2]
        if rims:
            ink = self.canvas.palette.ink
            self.canvas.polygon(*rims, fill=fill, edge=ink, width=1.4 * OUTLINE)

    def surface_line(
        self,
        points: Array,
        width: float,
        colour: str,
        *,
        dash: tuple[float, float] | None = None,
        halo: str | None = None,
    ) -> None:
        """Draw a line of the world; what lies behind a surface is left out."""
        window = self.window(points)
        if not np.isfinite(window).all():
            return
        for piece in visible_pieces(self.pixels(window), self.depth.farthest):
            line = self.from_pixels(piece[:, :2])
            if halo is not None:
                self.canvas.stroke(line, width + 2.4, halo)
            self.canvas.stroke(line, width, colour, dash=dash)

    def arrow(self, a: Array, b: Array, ink: Ink, shaft: float = glyphs.SHAFT) -> None:
        """Draw an arrow of the world; what lies behind a surface is left out, its head too."""
        line = a + np.linspace(0, 1, ARROW_STEPS)[:, None] * (b - a)
        window, shown = self.window(line)[:, :2], self.sees(line)
        runs = np.split(np.arange(len(line)), np.flatnonzero(np.diff(shown)) + 1)
        for run in runs:
            if not shown[run[0]] or len(run) < 2:
                continue
            (x, y), (u, v) = window[run[0]], window[run[-1]]
            if run[-1] == len(line) - 1:
                glyphs.arrow(self.canvas, (x, y), (u, v), ink, shaft)
            else:
                glyphs.line(self.canvas, ((x, y), (u, v)), ink, shaft)

    @property
    def is_empty(self) -> bool:
        """True if nothing of the scene is seen."""
        return not self.drawn.rendered.work.fragments

    def light_edge(self, lines: Sequence[Array]) -> bool:
        """Draw lines (k, 3) on bodies along which the light ends; tell whether any is seen."""
        before = len(self.canvas.marks)
        palette = self.canvas.palette
        for points in lines:
            self.surface_line(points, EDGE_DASHES, palette.bright, dash=DASHES, halo=palette.dim)
        return len(self.canvas.marks) > before

    def lights(self) -> None:
        """Draw every light: one at infinity in the corner that it comes from, others in place.

        One whose place is not in the picture is drawn as it shines from there on the bodies.
        """
        for placed in self.loaded.lights:
            if placed.position is not None:
                position = [float(one) for one in placed.position]
                if self._holds(self.place(position)):
                    self.lamp(position)
                elif self.loaded.bodies:
                    middle = np.mean([one.centre for one in self.loaded.bodies], axis=0)
                    self.sun((middle - position).tolist())
            elif placed.direction is not None:
                self.sun([float(one) for one in placed.direction])

    def sun(self, direction: Sequence[Number], *, lost: bool = False) -> None:
        """Draw a light at infinity in the corner it comes from, its arrows as they are seen.

        One that is lost is drawn nearer to the middle, so that it covers no other.
        """
        x, y = self._corner_of_sun(direction)
        if lost:
            y += 2 * CORNER if y < self.box.middle[1] else -2 * CORNER
        glyphs.sun(self.canvas, (x, y), self.direction(direction), lost=lost)

    def _corner_of_sun(self, direction: Sequence[Number]) -> Point:
        towards = self.direction(direction)
        x = self.box.x + CORNER if towards[0] > 0 else self.box.right - CORNER
        y = self.box.bottom - CORNER if towards[1] < 0 else self.box.y + CORNER
        return x, y

    def free_corners(self, pad: float) -> list[Point]:
        """Return the corners so far inside the stage in which no sun stands, for words."""
        inner = self.box.inset(CORNER)
        taken = [
            self._corner_of_sun([float(one) for one in placed.direction])
            for placed in self.loaded.lights
            if placed.position is None and placed.direction is not None
        ]
        pairs = zip(inner.corners, self.box.inset(pad).corners, strict=True)
        return [corner for suns, corner in pairs if suns not in taken]

    def lamp(self, point: Sequence[Number], *, lost: bool = False, radius: float = 15.0) -> None:
        """Draw a lamp at its place; one that the picture does not reach is left out."""
        place = self.place(point)
        if place is not None and self.box.holds(place):
            glyphs.lamp(self.canvas, place, radius=radius, lost=lost)

    def axes(self, frame: Array) -> None:
        """Draw the axes of a frame with their letters; what lies behind a surface is left out.

        `frame` (3, 4) has the origin and the three axes as columns, in the world and as long as
        they are drawn.
        """
        origin, ink = frame[:, 0], self.canvas.palette.ink
        tips = frame[:, 1:].T + origin
        start = self.place(origin)
        for tip, letter in zip(tips, "xyz", strict=True):
            self.surface_line(np.stack([origin, tip]), AXIS, ink)
            end = self.place(tip)
            if start is None or end is None:
                continue
            long = float(np.hypot(end[0] - start[0], end[1] - start[1]))
            if long < LEAST_AXIS:  # it points at the eye, or away
                continue
            u = (end[0] - start[0]) / long, (end[1] - start[1]) / long
            if not self.sees(tip[None])[0]:
                continue
            back = end[0] - 14 * u[0], end[1] - 14 * u[1]
            glyphs.arrow(self.canvas, back, end, Ink.PLAIN, AXIS)
            place = end[0] + 16 * u[0], end[1] + 16 * u[1] + 7
            halo = self.canvas.palette.stage
            self.canvas.text(place, letter, LETTER, ink, bold=True, align=0.5, halo=halo)
        if start is not None and self.sees(origin[None])[0]:
            glyphs.disc(self.canvas, start, 6.0, ink)

    def sight(self, eye: Array, target: Array) -> None:
        """Draw an eye of the world with the line of its sight, up to the first surface."""
        ink = self.canvas.palette.eye
        self.surface_line(np.stack([eye, target]), 3.2, ink, dash=(9.0, 6.0))
        a, b = self.place(eye), self.place(target)
        if a is not None and b is not None and self.box.holds(a):
            glyphs.eye(self.canvas, a, (b[0] - a[0], b[1] - a[1]))

    def above_ground(self, point: Sequence[Number], ground: float) -> None:
        """Draw a dotted line from a point straight down to the ground, at a height y."""
        x, y, z = map(float, point)
        heights = np.linspace(y, ground, STEPS)
        line = np.stack([np.full(STEPS, x), heights, np.full(STEPS, z)], axis=1)
        for piece in self._on_stage(line):
            self.canvas.stroke(piece, 2.4, self.canvas.palette.ink, dash=DOTS)
        foot = self.place((x, ground, z))
        if foot is not None and self.box.holds(foot):
            glyphs.disc(self.canvas, foot, 5.0, self.canvas.palette.ink)

    def path(self, points: Array, ink: Ink, width: float = 4.0) -> None:
        """Draw a dashed way through the world, as far as it is on the stage.

        Nothing hides it: it stands for an idea.
        """
        dash = glyphs.DASH_ON * width, glyphs.DASH_OFF * width
        colour = ink.colour(self.canvas.palette)
        for piece in self._on_stage(points):
            self.canvas.stroke(piece, width, colour, dash=dash, halo=glyphs.HALO)

    def _on_stage(self, points: Array) -> list[Array]:
        """Return the pieces (k, 2) of a line of the world that are in front and on the stage."""
        window = self.window(points)[:, :2]
        inside = np.array([self.box.holds((x, y)) for x, y in window.tolist()])
        runs = np.split(window, np.flatnonzero(inside[1:] != inside[:-1]) + 1)
        return [run for run in runs if len(run) > 1 and self.box.holds(tuple(run[0]))]

    def tacks(self, tacks: Sequence[Tack], ink: Ink, radius: float) -> None:
        """Draw normals as tacks, the far ones first; `radius` is that of the body.

        One that is zero is a disc without an arrow, with a 0 on it.
        """
        shown = [one for one in tacks if self._holds(self.place(one.place))]
        far_first = sorted(shown, key=lambda one: -float(np.linalg.norm(one.place - self.eye)))
        for one in far_first:
            if not one.arrow.any():
                self._nothing(one, radius)
                continue
            self.disc(one.place, one.normal, DISC * radius)
            self.vector(one.place, ARROW * radius * one.arrow, ink)

    def vector(self, place: Array, vector: Array, ink: Ink) -> None:
        """Draw a vector of the world as an arrow, whole, if its tip is on the stage."""
        a, b = self.place(place), self.place(place + vector)
        if a is not None and b is not None and self._holds(b):
            glyphs.arrow(self.canvas, a, b, ink)

    def _holds(self, place: Point | None) -> bool:
        """Tell whether a mark may stand at a place: beside the stage there may be others."""
        box, canvas = self.box, self.canvas
        is_alone = (box.width, box.height) == (canvas.width, canvas.height)
        return place is not None and (is_alone or box.holds(place))

    def _nothing(self, tack: Tack, radius: float) -> None:
        self.disc(tack.place, tack.normal, ZERO_DISC * radius)
        place = self.place(tack.place)
        if place is not None:
            palette, at = self.canvas.palette, (place[0], place[1] + 0.36 * ZERO)
            halo = palette.bright
            self.canvas.text(at, "0", ZERO, palette.dim, bold=True, align=0.5, halo=halo)

    def disc(self, place: Array, normal: Array, radius: float) -> None:
        """Draw a white disc in the plane across a normal."""
        rim = self.window(rings_around(place[None], normal[None], radius)[0])
        if all(self._holds((x, y)) for x, y, _ in rim):
            palette, towards = self.canvas.palette, unit(self.eye - place)
            is_edge_on = abs(float(normal @ towards)) < SILHOUETTE * 2
            edge, width = (palette.ink, EDGE_ON) if is_edge_on else (palette.dim, RIM)
            if is_edge_on:  # ink may be as light as the surface or as the stage: paper parts them
                around = EDGE_ON + 2 * glyphs.HALO
                self.canvas.stroke(rim[[*range(len(rim)), 0], :2], around, palette.paper)
            self.canvas.polygon(rim[:, :2], fill="#FFFFFF", edge=edge, width=width)

    def _rims(self) -> list[Array]:
        """Return the lines on the canvas that part what is covered from what is not."""
        from contourpy import contour_generator

        padded = np.pad(self.depth.coverage, 1)
        if not padded.any():
            return []
        lines = contour_generator(z=padded).lines(0.5)
        origin = np.array([self.box.x, self.box.y])
        return [origin + (np.asarray(line) - 0.5) / self.canvas.scale for line in lines]


def rings_around(places: Array, normals: Array, radius: float, steps: int = 40) -> Array:
    """Return points (n, steps, 3) on circles around places (n, 3), across unit normals (n, 3)."""
    u = unit(np.cross(normals, np.eye(3)[np.abs(normals).argmin(axis=1)]))[:, None]
    turns = np.linspace(0, 2 * np.pi, steps, endpoint=False)[:, None]
    v = np.cross(normals[:, None], u)
    return np.asarray(places[:, None] + radius * (np.cos(turns) * u + np.sin(turns) * v))


def radius_of(body: Body) -> float:
    """Return the radius of a moved body, 1 for a point."""
    return float(body.radius) or 1.0


def filling(
    view: View, points: Array, box: Box, inner: Box | None = None, around: float = 0.0
) -> Lens:
    """Return the lens of a box with which points (n, 3) of the world fill a part of it.

    The part is all but a pad on each side, unless `inner` says another.
    Around each point is room of so many units of the world, for arrows. It is a view through a
    window that need not lie opposite the eye: shifted and scaled, never bent.
    """
    camera = np.array(to_floats(view.placed().camera_from_world))
    x, y, z = (np.asarray(points, float) @ camera[:3, :3].T + camera[:3, 3]).T
    far, near = float(-z.min()), float(-z.max())
    near = max(near, far * 1e-3)
    tangents = np.stack([x, y]) / np.maximum(-z, near)
    room = around / np.maximum(-z, near)
    low, high = (tangents - room).min(axis=1), (tangents + room).max(axis=1)
    sides = np.array([box.width, box.height])
    inner = inner or box.inset(min(PAD, 3 / 8 * min(box.width, box.height)))
    filled = np.array([inner.width, inner.height])
    per_unit = float(((high - low) / filled).max()) or 1.0 / float(filled.max())
    aside = np.subtract(box.middle, inner.middle) * (1, -1)  # tangents go up, units down
    middle, half = (low + high) / 2 + aside * per_unit, sides / 2 * per_unit
    near = near / 2
    left, bottom = (middle - half) * near
    right, top = (middle + half) * near
    window = Window(float(left), float(right), float(bottom), float(top))
    return Lens(aspect=box.width / box.height, near=near, far=far * 2, frustum=window)


def through(lens: Lens, box: Box) -> Lens:
    """Return a caller's lens at the aspect of a box."""
    return replace(lens, aspect=box.width / box.height)
