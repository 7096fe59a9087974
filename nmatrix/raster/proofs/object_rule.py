"""The proof of object space: a light is carried there by M⁻¹ and measured there by the metric."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from math import atan2, cos, degrees, hypot, radians, sin
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.canvas.glyphs import (
    DASH_OFF,
    DASH_ON,
    DIAGRAM_SHAFT,
    EDGE,
    HALO,
    Ink,
    Verdict,
    arc,
    arrow,
    circle,
    disc,
    line,
)
from nmatrix.canvas.marks import Box, Point
from nmatrix.canvas.slide import BIG, CAPTION, GUTTER, Slide
from nmatrix.canvas.text import width
from nmatrix.enums import NormalRule, Space
from nmatrix.linear.rational import linear_part
from nmatrix.raster.drawn_scene import DrawnScene, drawn_scene, level_difference
from nmatrix.raster.loaded_scene import Body, LoadedScene, loaded
from nmatrix.raster.overlay.mesh_lines import isoline
from nmatrix.raster.overlay.stage import Stage
from nmatrix.raster.proofs.proof import Proof, ProofSettings
from nmatrix.raster.proofs.rules import EGG, TALL
from nmatrix.raster.proofs.staging import Pose, draw_on, put
from nmatrix.raster.render import Change
from nmatrix.raster.shading.lighting import ShadingLight
from nmatrix.raster.shading.normals import angles_deg, normals_by
from nmatrix.raster.shading.space import Measure, as_array, column, dot, length, quotient
from nmatrix.raster.shading.surface import Surface
from nmatrix.scene.light import SceneLight
from nmatrix.scene.scene import Scene
from nmatrix.scene.words import LightKind

Array = NDArray[Any]

FROM_THE_RIGHT = SceneLight("sun", LightKind.DIRECTIONAL, direction=(-0.8, -0.8, -0.2))
BESIDE = Pose((2.6, 2.2, 9.4), radius=2, room=0.08)
BELOW = 160.0  # units under the stages
COUNTED = (160, 160)  # pixels, whatever the size of the slide
ROUNDING = 1e-9  # of the light
FACING = 0.3  # the cosine at the eye from which on a mark on the surface is seen well
RADIUS, ASIDE = 80.0, 45.0  # of the circle, and how far from the middle it stands
UNDER_CIRCLE = 150.0  # for the large number
LETTERS_APART = 26.0  # degrees
HELD_AT = 25.0  # degrees: the true light in moving pictures
AROUND = 3.6  # units: the line around what is off by half the worst or more
DASHES = (DASH_ON * AROUND, DASH_OFF * AROUND)
RULES = ("M^{T} *l*", "M^{−1} *l*, no metric", "M^{−1} *l* + metric")


@dataclass(frozen=True, eq=False)
class CarriedLight:
    """One light and one body in object space, by the two wrong rules and by the right one.

    Shares are of the light, vertex by vertex: 0 where none falls, 1 where it falls straight down.
    """

    scene: LoadedScene

    @property
    def body(self) -> Body:
        """The body."""
        return self.scene.bodies[0]

    @cached_property
    def to_light_world(self) -> Array:
        """The unit vector (3, 1) to the light in the world."""
        direction = self.scene.lights[0].direction
        assert direction is not None  # the proof's lights are at infinity
        towards = -column(direction)
        return np.asarray(towards / length(towards))

    @cached_property
    def wrong(self) -> tuple[Array, Array]:
        """The unit vectors (3, 1) to the light in object space by Mᵀl and by M⁻¹l."""
        return wrong_lights(
            self.to_light_world, as_array(linear_part(self.body.world_from_object.exact))
        )

    @cached_property
    def cosines(self) -> Array:
        """The cosines (V,) of the true normals and the light: the edge of the light is at 0."""
        normals = normals_by(self.scene, self.body, NormalRule.EXACT)
        return np.asarray(dot(normals, self.to_light_world))

    @cached_property
    def edge(self) -> list[Array]:
        """The lines (k, 3) in the world along which the light ends."""
        return isoline(self.body.positions_world, self.body.mesh.triangles, self.cosines)

    @cached_property
    def too_bright(self) -> tuple[Array, Array]:
        """By how much of the light each vertex (V,) is too bright by either wrong rule."""
        right = np.maximum(self.cosines, 0)
        normals = self.body.mesh.normals.T
        first, second = (np.maximum(dot(normals, one), 0) - right for one in self.wrong)
        return first, second

    @property
    def between_deg(self) -> float:
        """The angle between Mᵀl and M⁻¹l."""
        first, second = self.wrong
        return float(angles_deg(first.T, second.T)[0])

    @property
    def points_alike(self) -> bool:
        """True if both rules give one direction."""
        return self.between_deg < ROUNDING

    @property
    def edge_moves(self) -> bool:
        """True if Mᵀl lights a vertex that should be dark, or the other way around."""
        by_transposed = dot(self.body.mesh.normals.T, self.wrong[0])
        clear = np.minimum(np.abs(by_transposed), np.abs(self.cosines)) > ROUNDING
        return bool((clear & ((by_transposed > 0) != (self.cosines > 0))).any())

    @property
    def agrees(self) -> tuple[bool, bool]:
        """Tell of each wrong rule whether it does no harm on this body."""
        first, second = (bool(np.abs(one).max() < ROUNDING) for one in self.too_bright)
        return first, second


def object_rule(settings: ProofSettings) -> Proof:
    """Draw object-space lighting with Mᵀl, with M⁻¹l, and by the metric; mark where they part."""
    scene = _scene(settings)
    carried = CarriedLight(loaded(scene))
    carried.scene.maps(carried.body).space_from_world(Space.OBJECT)  # there is one, or no answer
    slide = settings.slide(_title(carried))
    idea, *boxes = slide.body(BELOW).columns(4, GUTTER)
    told = "The shape is still plain here, only the light has moved. Two rules, two lights."
    if carried.points_alike:
        told = "The shape is still plain here, only the light has moved. Both rules move it alike."
    plain = slide.panel(idea, "In object space", caption=told).stage
    _two_lights(slide, plain, carried, held=settings.is_moving)
    agrees = carried.agrees
    verdicts = (*(Verdict.RIGHT if one else Verdict.WRONG for one in agrees), Verdict.RIGHT)
    panels = [slide.panel(*one) for one in zip(boxes, RULES, verdicts, strict=True)]
    view, lens = BESIDE.camera(settings, [carried.scene], panels[2].stage)
    seen = replace(scene, view=view, lens=lens, has_camera=True)
    right = draw_on(slide, panels[2], seen)
    changes = [partial(_lit_by, one) for one in carried.wrong]
    wrong = [
        put(slide, panel, right.drawn.redrawn(change))
        for panel, change in zip(panels, changes, strict=False)
    ]
    edge_seen = False
    for stage in (*wrong, right):
        if not stage.is_empty:
            stage.outline()
            edge_seen = stage.light_edge(carried.edge)
            stage.lights()
    shares_seen = not wrong[1].is_empty and _mark_shares(wrong[1], carried, held=settings.is_moving)
    captions = _captions(carried, edge_seen=edge_seen, shares_seen=shares_seen)
    panels = [
        slide.captioned(panel, caption) for panel, caption in zip(panels, captions, strict=True)
    ]
    if agrees[1] or carried.points_alike:
        slide.compare(*panels[:2], same=carried.points_alike)
    if agrees[1]:
        slide.compare(*panels[1:], same=True)
    return Proof.of(
        settings.subject,
        slide,
        _verdict(carried),
        [right.drawn],
        numbers=_counted(seen, changes),
        max_level_difference=max(level_difference(one.drawn, right.drawn) for one in wrong),
    )


def wrong_lights(to_light_world: Array, M: Array) -> tuple[Array, Array]:
    """Return the unit vectors (3, 1) to the light in object space by Mᵀl and by M⁻¹l.

    Examples
    --------
    >>> M = np.diag([1, 0.25, 1])
    >>> l = np.array([[0.3], [0.9], [0.2]])
    >>> n = np.array([1, 1, 0]) / np.sqrt(2)
    >>> [round(float((n @ light)[0]), 4) for light in wrong_lights(l, M)]
    [0.8735, 0.7622]
    """
    transposed, inverted = M.T @ to_light_world, np.linalg.solve(M, to_light_world)
    return quotient(transposed, length(transposed)), quotient(inverted, length(inverted))


def _scene(settings: ProofSettings) -> Scene:
    """Return the body in object space, under its light as one at infinity."""
    one = settings.object(settings.placed(TALL), settings.geometry(EGG))
    scene = settings.scene(one, lights=(FROM_THE_RIGHT,))
    light = scene.lights[0]
    if not light.has_direction:  # a lamp: its light as it comes to the middle of the body
        (body,) = loaded(scene).bodies
        direction = tuple((body.centre - np.array(light.position, float)).tolist())
        direction = direction if any(direction) else FROM_THE_RIGHT.direction
        light = replace(FROM_THE_RIGHT, direction=direction)
    in_object = replace(scene.settings, space=Space.OBJECT)
    return replace(scene, lights=(light,), settings=in_object)


def _lit_by(to_light: Array, surface: Surface) -> Surface:
    """Return the surface as it is lit along a vector of object space, without the metric."""
    light = ShadingLight(surface.lighting.lights[0].colour, to_light=to_light)
    lighting = replace(surface.lighting, lights=(light,), measure=Measure())
    return replace(surface, space=replace(surface.space, uses_metric=False), lighting=lighting)


def _title(carried: CarriedLight) -> str:
    if not all(carried.agrees):
        return "Object space: carry the light by M^{−1}, then measure with the metric"
    if carried.body.kind.needs_inverse_transpose:
        return "On this shape each rule is right: a test here proves nothing"
    return "Turn, mirror, scale it evenly: each rule carries the light"


def _captions(carried: CarriedLight, *, edge_seen: bool, shares_seen: bool) -> tuple[str, str, str]:
    moved, shade = carried.agrees
    same = "The same shade: here it does no harm."
    first = "Dark begins at the wrong place."
    if carried.points_alike:
        first = "Here it is the light that M^{−1} gives: its edge is right, its shade is not."
    elif not carried.edge_moves:
        first = "Here no edge of the light moves, but the shade is wrong."
    elif edge_seen:
        first += " The dashed line is the true edge of the light."
    second = "The edge is right, the shade is not"
    second += ": on this side it is off by up to so much of the light." if shares_seen else "."
    return (
        same if moved else first,
        same if shade else second,
        "Lengths are measured by M^{T}M: exactly what world space shows.",
    )


def _verdict(carried: CarriedLight) -> str:
    if all(carried.agrees):
        return "All three are the same here: this map cannot tell a wrong rule."
    off = carried.too_bright[1]
    shares = ((off.max(), "bright"), (-off.min(), "dark"))
    told = [f"{_percent(share)} of it too {word}" for share, word in shares if share > ROUNDING]
    keeps = f", up to {' and '.join(told)}, unseen sides included" if told else ""
    if carried.points_alike:
        return f"Mᵀl and M⁻¹l are one direction here; without the metric the shade is off{keeps}."
    return (
        f"Mᵀl turns the light by {_degrees(carried.between_deg)} in object space; M⁻¹l keeps the "
        f"edge of the light{keeps}."
    )


def _two_lights(slide: Slide, stage: Box, carried: CarriedLight, *, held: bool) -> None:
    """Draw both lights on the plain shape, in the plane of the two, at their true angle.

    In moving pictures the true one is held in its place: nothing may jump.
    """
    canvas, palette = slide.canvas, slide.palette
    wrong, right = (one[:, 0] for one in carried.wrong)
    between, alike = carried.between_deg, carried.points_alike
    first = degrees(atan2(right[1], right[0])) if np.abs(right[:2]).max() > ROUNDING else 90.0
    # The wrong one lies on the side on which it is seen along the z axis of object space.
    side = 1 if right[0] * wrong[1] >= right[1] * wrong[0] else -1
    if held:
        first, side = HELD_AT, 1
    other = first + side * between
    upper = Box(stage.x, stage.y, stage.width, stage.height - UNDER_CIRCLE)
    middle = _on_circle(upper.middle, -ASIDE, first + side * between / 2)
    canvas.polygon(circle(middle, RADIUS), fill=palette.body)
    canvas.polygon(arc(middle, RADIUS, first + 90, first + 270), fill=palette.rule)  # the dark half
    canvas.polygon(circle(middle, RADIUS), fill=None, edge=palette.ink, width=2 * EDGE)
    apart = max(0.0, LETTERS_APART - between) / 2  # letters never cover one another
    lights = [(first, first - side * apart, Ink.RIGHT, "M^{−1}*l*")]
    if alike:
        canvas.text(
            (upper.x + 24, upper.y + 44), "M^{T}*l* = M^{−1}*l*", 26, palette.right, bold=True
        )
        lights = [(first, first, Ink.RIGHT, "")]
    else:
        lights.append((other, other + side * apart, Ink.WRONG, "M^{T}*l*"))
        canvas.stroke(arc(middle, RADIUS + 50, first, other), 3.2, palette.ink)
    for angle, letters_at, ink, letters in lights:
        ends = _on_circle(middle, RADIUS, angle + 90), _on_circle(middle, RADIUS, angle - 90)
        line(canvas, ends, ink)
        far, near = (_on_circle(middle, RADIUS + away, angle) for away in (84, 10))
        arrow(canvas, far, near, ink, DIAGRAM_SHAFT)
        x, y = _on_circle(middle, RADIUS + 110, letters_at)
        room = stage.inset(8 + width(letters, 26, bold=True) / 2)
        x, colour = min(max(x, room.x), room.right), ink.colour(palette)
        canvas.text((x, y + 9), letters, 26, colour, bold=True, align=0.5, halo=palette.stage)
    disc(canvas, middle, 7.0, palette.ink)
    x, y = stage.x + 24, stage.bottom - 72
    canvas.text((x, y), _degrees(between), BIG, bold=True)
    canvas.text((x, y + 42), "between the two lights", CAPTION, palette.soft)


def _on_circle(middle: Point, radius: float, angle: float) -> Point:
    turn = radians(angle)
    return middle[0] + radius * cos(turn), middle[1] - radius * sin(turn)


def _mark_shares(stage: Stage, carried: CarriedLight, *, held: bool) -> bool:
    """Surround what is far too bright and far too dark, and write by how much of the light.

    Tells whether there is any such place that is seen. In moving pictures the words are held.
    """
    body, palette = carried.body, stage.canvas.palette
    points, off = body.positions_world, carried.too_bright[1]
    normals = normals_by(carried.scene, body, NormalRule.EXACT)
    to_eye = (stage.eye - points).T
    seen = np.flatnonzero(dot(normals, to_eye) > FACING * length(to_eye))
    corners = stage.free_corners(14)
    for sign, words in ((1, "too bright"), (-1, "too dark")):
        share = float((sign * off).max())
        if share < ROUNDING or not len(seen):
            continue  # nowhere, or nowhere in sight
        worst = seen[np.argmax(sign * off[seen])]
        share_seen = float(sign * off[worst])
        if share_seen < ROUNDING:
            continue
        for around in isoline(points, body.mesh.triangles, sign * off - share / 2):
            stage.surface_line(around, AROUND, palette.wrong, dash=DASHES, halo=palette.paper)
        place = stage.place(points[worst])
        if place is not None and stage.box.holds(place):
            nearest = min(corners, key=lambda one: hypot(one[0] - place[0], one[1] - place[1]))
            corner = corners[1 if sign > 0 else 0] if held else nearest
            corners.remove(corner)
            _tag(stage, place, corner, _percent(share_seen), words)
    return len(corners) < len(stage.free_corners(14))


def _tag(stage: Stage, place: Point, corner: Point, share: str, words: str) -> None:
    """Write in a corner of the stage by how much of the light a place of the body is off."""
    canvas, palette = stage.canvas, stage.canvas.palette
    wide = width(words, CAPTION)
    x = corner[0] if corner[0] < stage.box.middle[0] else corner[0] - wide
    y = corner[1] if corner[1] < stage.box.middle[1] else corner[1] - 64
    end = min(max(place[0], x - 8), x + wide + 8), min(max(place[1], y - 8), y + 72)
    canvas.stroke((place, end), 3.2, palette.ink, halo=HALO)
    disc(canvas, place, 8.0, palette.bright, palette.dim)
    middle, halo = x + wide / 2, palette.stage
    canvas.text((middle, y + 30), share, 36, palette.wrong, bold=True, align=0.5, halo=halo)
    canvas.text((x, y + 58), words, CAPTION, palette.ink, halo=halo)


def _counted(scene: Scene, changes: Sequence[Change]) -> dict[str, int]:
    """Compare pictures of one size, however large the slide is: where light ends, and levels."""
    exact = drawn_scene(scene, size=COUNTED, samples=1)
    naive = drawn_scene(scene, size=COUNTED, samples=1, space=Space.WORLD, normals=NormalRule.NONE)
    transposed, inverted = (exact.redrawn(one) for one in changes)
    dark, dark_naive, dark_transposed, dark_inverted = (
        _unlit(one) for one in (exact, naive, transposed, inverted)
    )
    return {
        "terminator_transposed_pixels": int((dark_transposed != dark).sum()),
        "terminator_inverted_pixels": int((dark_inverted != dark).sum()),
        "terminator_transposed_against_naive_pixels": int((dark_transposed != dark_naive).sum()),
        "levels_transposed": level_difference(transposed, exact),
        "levels_inverted": level_difference(inverted, exact),
    }


def _unlit(drawn: DrawnScene) -> Array:
    """Tell of every pixel whether it gets ambient light alone."""
    ambient = drawn.loaded.bodies[0].material.ambient[0]
    return np.asarray(np.abs(drawn.rendered.image[:, :, 0] - ambient) < ROUNDING)


def _degrees(angle: float) -> str:
    return f"{angle:.0f}°" if angle >= 9.5 or angle < ROUNDING else f"{angle:.2g}°"


def _percent(share: float) -> str:
    return f"{100 * share:.0f} %" if share >= 0.095 or share < ROUNDING else f"{100 * share:.2g} %"
