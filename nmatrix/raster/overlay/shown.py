"""Marks over the picture of a scene or a mesh: one's own normals on one's own mesh.

Each mark is where the picture has what it stands for. Lines on surfaces are left out where they are
hidden; what stands for an idea (normals, lamps) is drawn whole.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from math import hypot
from typing import Any, assert_never

import numpy as np
from numpy.typing import NDArray

from nmatrix.canvas import glyphs
from nmatrix.canvas.marks import Box, Canvas, Point
from nmatrix.canvas.slide import HEIGHT
from nmatrix.canvas.theme import PALETTES
from nmatrix.enums import Shown, Theme
from nmatrix.errors import counted, printable, shortlist
from nmatrix.linear.rational import identity, to_floats
from nmatrix.raster.drawn_scene import DrawnScene
from nmatrix.raster.loaded_scene import Body
from nmatrix.raster.overlay.eye_map import eye_map
from nmatrix.raster.overlay.hedgehog import Hedgehog
from nmatrix.raster.overlay.labels import Labels
from nmatrix.raster.overlay.mesh_lines import creases, edges_of, silhouettes
from nmatrix.raster.overlay.segments import in_view, seen_pieces
from nmatrix.raster.overlay.stage import CORNER, MOST_EDGED, Stage
from nmatrix.raster.triangles.convex import EDGES
from nmatrix.scene.fitting import enclosing
from nmatrix.scene.light import PlacedLight

Array = NDArray[Any]

# The first lie under those that follow.
ORDER = (
    Shown.WIREFRAME,
    Shown.BOUNDS,
    Shown.AXES,
    Shown.TANGENTS,
    Shown.NORMALS,
    Shown.EYE,
    Shown.LIGHTS,
)
LEAST_SCALE = 0.3  # pixels of a unit: marks on small pictures stay legible
LINE, BOUND, AXIS, OWN_AXIS = 1.6, 2.6, 4.8, 2.8  # units
AXIS_PAD = 40.0  # of the tip of an axis, from the sides of the picture
HALO = 1.2
LAMP = 15.0
SUNS_APART = 112.0
LEVEL = 1e-9  # light that rises no more than so much of its way comes from the side
EDGE_PAD = 64.0  # of a lamp that is outside the picture, from its sides
POINTER = 44.0
AT_EYE = 1e-9  # nearer to the eye, or to the plane through it, a lamp is there
BEYOND = 1.2  # how far axes reach out of what they belong to
MOST_OWN_AXES, MOST_NAMED = 8, 24  # bodies
FINEST = 5.0  # pixels: shorter edges run together
LINE_PART = 0.1  # of the length of edges: a line is no wider
TRIED = 4000  # edges, to estimate their length


def marked(
    drawn: DrawnScene, shown: Collection[Shown], theme: Theme
) -> tuple[Canvas, tuple[str, ...]]:
    """Lay a picture that was drawn with its depth on a canvas, and marks over it; return remarks.

    The canvas has the pixels of the picture. Its units are those of a slide, but for a small
    picture, whose marks would be too fine.
    """
    height, width = drawn.levels.shape[:2]
    scale = max(min(width, height) / HEIGHT, LEAST_SCALE)
    canvas = Canvas(width / scale, height / scale, PALETTES[theme], scale)
    box = Box(0, 0, canvas.width, canvas.height)
    canvas.image(box, drawn.levels)
    marks = _Marks(Stage(canvas, box, drawn), Labels(canvas))
    for one in ORDER:
        if one in shown:
            marks.draw(one)
    return canvas, (*marks.remarks, *marks.labels.write())


@dataclass(eq=False)
class _Marks:
    """The marks of one picture, and what is to be said about them."""

    stage: Stage
    labels: Labels
    remarks: list[str] = field(default_factory=list)
    map: Box | None = None

    def draw(self, shown: Shown) -> None:
        """Draw one kind of marks."""
        match shown:
            case Shown.WIREFRAME:
                self.wireframe()
            case Shown.BOUNDS:
                self.bounds()
            case Shown.AXES:
                self.axes()
            case Shown.TANGENTS:
                self.hedgehog.tangents()
            case Shown.NORMALS:
                self.hedgehog.normals()
            case Shown.LIGHTS:
                self.lights()
            case Shown.EYE:
                self.map = eye_map(self.stage, self.labels)
            case _:
                assert_never(shown)

    @property
    def bodies(self) -> Sequence[Body]:
        return self.stage.loaded.bodies

    @cached_property
    def hedgehog(self) -> Hedgehog:
        return Hedgehog.on(self.stage, self.labels, self.remarks)

    @cached_property
    def line_colour(self) -> str:
        """Return the colour of thin lines: ink, or that of paper on a picture that is as dark.

        A line must differ from the surface that it lies on, whatever its material.
        """
        covered = self.stage.depth.coverage > 0
        levels = self.stage.drawn.levels[covered if covered.any() else ...]
        palette = self.stage.canvas.palette
        apart = [abs(_grey(one) - float(levels.mean())) for one in (palette.ink, palette.paper)]
        return palette.ink if apart[0] >= apart[1] else palette.paper

    def wireframe(self) -> None:
        """Draw the edges of triangles that are seen."""
        fine = []
        for body in self.bodies:
            long, points = self._edge_pixels(body), body.positions_world
            if long < FINEST:
                fine.append(body)
            else:
                edges = edges_of(body.mesh)
                a, b = (points[edges.vertex[edges.ends[:, i]]] for i in (0, 1))
                width = min(LINE, LINE_PART * long / self.stage.canvas.scale)
                self._lines(seen_pieces(self.stage, a, b), self.line_colour, width)
        if fine:
            many = counted(max(len(body.mesh.triangles) for body in fine), "triangle")
            self.remarks.append(
                f"Wireframe: most edges of {_names(fine)} ({many}) are shorter than "
                f"{FINEST:g} pixels and would run together: only its outline is drawn."
            )
        for body in fine:
            self._outline(body)

    def _outline(self, body: Body) -> None:
        """Draw the sharp edges of a body, and those between its front and its back."""
        if len(body.mesh.triangles) > MOST_EDGED:
            self.stage.outline(sharp=False)
            return
        points = body.positions_world
        chains = [points[chain] for chain in creases(body.mesh)]
        chains += silhouettes(body.mesh, points, self.stage.eye)
        if chains:
            a = np.concatenate([one[:-1] for one in chains])
            b = np.concatenate([one[1:] for one in chains])
            self._lines(seen_pieces(self.stage, a, b), self.line_colour, LINE)

    def _edge_pixels(self, body: Body) -> float:
        """Return the median length of edges that the eye has in front of it, in pixels."""
        triangles = body.mesh.triangles[:: 1 + len(body.mesh.triangles) // TRIED]
        points = body.positions_world
        a, b = (self.stage.window(points[triangles[:, i]])[:, :2] for i in (0, 1))
        long = np.sqrt(((b - a) ** 2).sum(axis=1))
        long = long[np.isfinite(long)]
        return float(np.median(long)) * self.stage.canvas.scale if len(long) else np.inf

    def bounds(self) -> None:
        """Draw the box of each object's own axes, moved with it, and its name."""
        palette = self.stage.canvas.palette
        for i, body in enumerate(self.bodies):
            corners = body.hull.corners[:, :3]
            a, b = corners[EDGES[:, 0]], corners[EDGES[:, 1]]
            long = (a != b).any(axis=1)
            pieces = seen_pieces(self.stage, a[long], b[long])
            self._lines(pieces, palette.paper, BOUND + 2 * HALO)
            self._lines(pieces, palette.ink, BOUND)
            seen = self.stage.window(corners[self.stage.sees(corners)])
            if len(seen) and i < MOST_NAMED:
                places = sorted(map(_point, seen), key=lambda one: one[1])
                self.labels.name(places, body.name, f"object {i + 1}", 10.0)
        if len(self.bodies) > MOST_NAMED:
            self.remarks.append(f"The first {MOST_NAMED} of {len(self.bodies)} boxes are named.")

    def _lines(self, pieces: Array, colour: str, width: float) -> None:
        """Draw lines (n, 2, 2) of the canvas as one mark."""
        if len(pieces):
            self.stage.canvas.polygon(*pieces, fill=None, edge=colour, width=width)

    def axes(self) -> None:
        """Draw the world's axes, and thinner those of objects that are placed."""
        centre, radius = enclosing([body.ball for body in self.bodies])
        reach = BEYOND * (float(np.sqrt(centre @ centre)) + radius)
        seen = self._axes(np.zeros(3), reach * np.eye(3), AXIS, "{}")
        if not seen:
            self.remarks.append("The world's axes are outside of the picture or hidden.")
        placed = [body for body in self.bodies if body.world_from_object.exact != identity(4)]
        named = []
        for body in placed[:MOST_OWN_AXES]:
            M = np.array(to_floats(body.world_from_object.exact))
            long = BEYOND * np.abs(body.mesh.box).max(axis=0)
            if self._axes(M[:3, 3], (M[:3, :3] * long).T, OWN_AXIS, "*{}*"):
                named.append(body)
        if named:
            thick = "The thick axes are the world's, the thin ones" if seen else "The axes are"
            self.remarks.append(f"{thick} those of {_names(named)}.")
        if len(placed) > MOST_OWN_AXES:
            self.remarks.append(
                f"Of {len(placed)} objects that are placed, only the first {MOST_OWN_AXES} "
                "have axes here."
            )

    def _axes(self, origin: Array, ends: Array, wide: float, letter: str) -> bool:
        """Draw three axes as far as they are seen; tell whether anything of them is."""
        palette, canvas = self.stage.canvas.palette, self.stage.canvas
        found = False
        for name, along in zip("xyz", ends, strict=True):
            a, b = in_view(self.stage, origin[None], (origin + along)[None], AXIS_PAD)
            pieces = seen_pieces(self.stage, a, b)
            for piece in pieces:
                canvas.stroke(piece, wide, palette.ink, halo=HALO)
                found = True
            if not len(pieces):
                continue
            tail, tip = map(_point, self.stage.window(np.concatenate([a, b])))
            last, long = pieces[-1][1], hypot(tip[0] - tail[0], tip[1] - tail[1])
            if hypot(last[0] - tip[0], last[1] - tip[1]) < 3.0 and long > 0:
                u = (tip[0] - tail[0]) / long, (tip[1] - tail[1]) / long
                _head(canvas, tip, u, wide)
                beyond = (tip[0] + 18 * u[0], tip[1] + 18 * u[1])
                self.labels.letter(beyond, letter.format(name))
        return found

    def lights(self) -> None:
        """Draw every lamp where it is, and those outside the picture at its edge."""
        suns: Counter[tuple[bool, bool]] = Counter()  # in each corner
        for i, one in enumerate(self.stage.loaded.lights):
            if one.position is not None:
                place = self._lamp(one)
                self.labels.keep_free(Box(place[0] - 28, place[1] - 28, 56, 56))
            elif one.direction is not None:
                towards = self.stage.direction([float(x) for x in one.direction])
                corner = on_left, from_below = towards[0] > 0, towards[1] < -LEVEL * hypot(*towards)
                aside = CORNER + SUNS_APART * suns[corner]
                suns[corner] += 1
                if self.map is not None and on_left and from_below:
                    aside += self.map.right
                x = aside if on_left else self.stage.box.right - aside
                y = self.stage.box.bottom - CORNER if from_below else CORNER
                place = (x, y)
                glyphs.sun(self.stage.canvas, place, towards)
                self.labels.keep_free(Box(x - 80, y - 80 if from_below else 0, 160, y + 80))
            else:
                continue  # ambient light comes from nowhere
            clear = 34.0 if one.position is not None else 84.0
            self.labels.name([place], one.light.name, f"light {i + 1}", clear)

    def _lamp(self, one: PlacedLight) -> Point:
        """Draw a lamp in its place, or at the edge with an arrow that points to where it is."""
        assert one.position is not None  # whoever asks knows
        canvas, box = self.stage.canvas, self.stage.box
        point = np.array([float(x) for x in one.position])
        place = self.stage.place(point)
        if place is not None and box.holds(place):
            glyphs.lamp(canvas, place, radius=LAMP)
            if one.direction is not None:
                self._beam(point, np.array([float(x) for x in one.direction]), place)
            return place
        where = "outside of the picture" if place is not None else self._beyond_sight(point)
        at_edge, u = self._edge(point, place)
        if u is not None:
            tip = (at_edge[0] + u[0] * POINTER, at_edge[1] + u[1] * POINTER)
            glyphs.arrow(canvas, at_edge, tip, glyphs.Ink.PLAIN)
        glyphs.lamp(canvas, at_edge, radius=LAMP)
        self.remarks.append(f"The light {printable(one.light.name)} is {where}.")
        return at_edge

    def _beyond_sight(self, point: Array) -> str:
        """Tell where a point is that is not in front of the eye."""
        away = float(np.sqrt(((point - self.stage.eye) ** 2).sum()))
        if away <= AT_EYE:
            return "where the eye is"
        *row, shift = self.stage.clip_from_world[3]
        ahead = float(point @ row + shift) / (hypot(*row) or 1.0)
        return "behind the eye" if ahead < -AT_EYE * away else "beside the eye"

    def _edge(self, point: Array, place: Point | None) -> tuple[Point, Point | None]:
        """Return where at the edge a lamp is told, and which way it is: none for one at the eye."""
        box, (x, y) = self.stage.box, self.stage.box.middle
        towards = self.stage.direction(point - self.stage.eye)
        if place is not None:
            towards = (place[0] - x, place[1] - y)
        away = hypot(*towards)
        pad = min(EDGE_PAD, min(box.width, box.height) / 4)
        if away < 1e-9:
            return (x, box.bottom - pad), None
        u, inner = (towards[0] / away, towards[1] / away), box.inset(pad)
        long = min(abs(s / 2 / t) for s, t in ((inner.width, u[0]), (inner.height, u[1])) if t)
        return (x + u[0] * long, y + u[1] * long), u

    def _beam(self, point: Array, direction: Array, place: Point) -> None:
        """Draw which way the axis of a spot goes."""
        far = self.stage.place(point + direction * 0.1 * (1 + np.abs(point - self.stage.eye).max()))
        if far is None:
            return
        long = hypot(far[0] - place[0], far[1] - place[1])
        if long > 1e-6:
            u = (far[0] - place[0]) / long, (far[1] - place[1]) / long
            start, end = (
                (place[0] + u[0] * part, place[1] + u[1] * part) for part in (30.0, 30.0 + POINTER)
            )
            glyphs.arrow(self.stage.canvas, start, end, glyphs.Ink.PLAIN)


def _head(canvas: Canvas, tip: Point, u: Point, wide: float) -> None:
    """Draw the head of an axis, whose tip is at its end."""
    back = (tip[0] - u[0] * 3.6 * wide, tip[1] - u[1] * 3.6 * wide)
    barbs = [(back[0] - s * u[1] * 1.45 * wide, back[1] + s * u[0] * 1.45 * wide) for s in (1, -1)]
    canvas.polygon((*barbs, tip), fill=canvas.palette.ink, edge=canvas.palette.paper, width=HALO)


def _point(place: Array) -> Point:
    return float(place[0]), float(place[1])


def _grey(colour: str) -> float:
    return sum(int(colour[i : i + 2], 16) for i in (1, 3, 5)) / 3


def _names(bodies: Sequence[Body]) -> str:
    return shortlist([printable(body.name) for body in bodies], 3)
