"""The idea of the rule in one drawing: a circle becomes an ellipse, and A n leans off its tangent.

Letters: n a normal, t a tangent, A the map. In a drawing y goes up; on a canvas it goes down.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, hypot, pi, sin, sqrt

from nmatrix.canvas.glyphs import (
    DIAGRAM_SHAFT,
    EDGE,
    Ink,
    Verdict,
    arrow,
    badge,
    circle,
    disc,
    line,
    right_angle,
)
from nmatrix.canvas.marks import Box, Canvas, Point, Text

LETTER = 26  # the size of letters beside arrows
ARROW, TANGENT = 78.0, 56.0  # lengths in units
THIN = 10.0  # what is left of a circle that is flattened
GAP = 88.0  # between the circle and the ellipse
PAD = 34.0
BADGE = 13.0  # the radius of a verdict beside its letters
ROOM_ASIDE = 160.0  # for arrows and letters on the right
ROOM_ABOVE = 60.0  # for the arrow of n above the circle


@dataclass(frozen=True)
class Idea:
    """Where the drawing's arrows are: all begin at `before` or `after` and end at their tips."""

    before: Point
    after: Point
    normal: Point
    tangent: Point
    moved_tangent: Point
    wrong: Point | None
    right: Point


def circle_to_ellipse(canvas: Canvas, box: Box, stretch: float) -> Idea:
    """Draw a circle with a normal, and the ellipse that A makes of it.

    A tangent t goes to A t. The right angle of n and t is kept by A⁻ᵀ, for n·t = (A⁻ᵀn)·(A t); A n
    leans off it, here as far as it can: n is at 45°, where the lean is arctan k − arctan 1/k.
    The two stand above each other and A = diag(1, stretch); in a box that is wider than high they
    stand side by side, A = diag(stretch, 1), and there is room for verdicts.

    Examples
    --------
    >>> from nmatrix.canvas.theme import PALETTES, Theme
    >>> canvas = Canvas(361, 554, PALETTES[Theme.LIGHT])
    >>> found = circle_to_ellipse(canvas, Box(0, 0, 361, 554), 2.0)
    >>> u = [b - a for a, b in zip(found.after, found.right)]
    >>> t = [b - a for a, b in zip(found.after, found.moved_tangent)]
    >>> abs(u[0] * t[0] + u[1] * t[1]) < 1e-9
    True
    """
    is_wide = box.width > box.height
    first, second, radius = _side_by_side(box, stretch) if is_wide else _stacked(box, stretch)
    wider, higher = (stretch, 1.0) if is_wide else (1.0, stretch)
    palette, half = canvas.palette, sqrt(0.5)
    edge = {"fill": palette.body, "edge": palette.ink, "width": 2 * EDGE}
    canvas.polygon(circle(first, radius), **edge)  # type: ignore[arg-type]  # names of its own
    ellipse = [
        (second[0] + wider * (x - first[0]), second[1] + higher * (y - first[1]))
        for x, y in circle(first, radius, 128)
    ]
    canvas.polygon(ellipse, **edge)  # type: ignore[arg-type]
    before = first[0] + radius * half, first[1] - radius * half
    after = second[0] + wider * radius * half, second[1] - higher * radius * half
    n, t = (half, half), (half, -half)
    At, An, right = (
        _unit((wider * t[0], higher * t[1])),
        _unit((wider * n[0], higher * n[1])),
        _unit((n[0] / wider, n[1] / higher)),
    )
    for place, along in ((before, t), (after, At)):
        line(canvas, (_at(place, along, -TANGENT), _at(place, along, TANGENT)), Ink.TANGENT)
    right_angle(canvas, before, _down(t), _down(n), Ink.PLAIN)
    clear = -1 if wider > higher else 1  # the side of the tangent that A n does not lean to
    right_angle(canvas, after, _down((clear * At[0], clear * At[1])), _down(right), Ink.RIGHT)
    arrow(canvas, before, _at(before, n, ARROW), Ink.NORMAL, DIAGRAM_SHAFT)
    leans = stretch != 1
    if leans:
        arrow(canvas, after, _at(after, An, ARROW * 1.2), Ink.WRONG, DIAGRAM_SHAFT)
    arrow(canvas, after, _at(after, right, ARROW * 1.2), Ink.RIGHT, DIAGRAM_SHAFT)
    for place in (before, after):
        disc(canvas, place, 7.0, palette.ink)
    _map_arrow(canvas, first, (second[0] - wider * radius, second[1] - higher * radius), radius)
    x, y = _at(before, n, ARROW + 8)
    _letter(canvas, (x, y), "*n*", palette.normal)
    x, y = _at(before, t, TANGENT + 8)
    _letter(canvas, (x, y + 14), "*t*", palette.tangent)
    x, y = _at(after, At, TANGENT + 8)
    _letter(canvas, (x, y + 14), "A*t*", palette.tangent)
    if leans:
        x, y = _at(after, An, 1.2 * ARROW + 12)
        place = (x, y + 9) if is_wide else (x - 20, y - 6)
        letters = _letter(canvas, place, "A*n*", palette.wrong)
        if is_wide:
            badge(canvas, (letters.box.right + 24, place[1] - 9), Verdict.WRONG, BADGE)
    x, y = _at(after, right, 1.2 * ARROW + 10)
    place = (x + 4, y + 18) if is_wide else (x, y + 10)
    letters = _letter(canvas, place, "A^{−T}*n*" if leans else "A*n*", palette.right)
    if is_wide:
        badge(canvas, (letters.box.right + 24, place[1] - 9), Verdict.RIGHT, BADGE)
    return Idea(
        before,
        after,
        _at(before, n, ARROW),
        _at(before, t, TANGENT),
        _at(after, At, TANGENT),
        _at(after, An, 1.2 * ARROW) if leans else None,
        _at(after, right, 1.2 * ARROW),
    )


def circle_to_line(canvas: Canvas, box: Box) -> tuple[tuple[Point, Point], ...]:
    """Draw a circle with its normals, and the line that A makes of it, with normals to both sides.

    The two stand above each other, or side by side in a box that is wider than high. Returns the
    ends of the line's arrows, up and down in turn.

    Examples
    --------
    >>> from nmatrix.canvas.theme import PALETTES, Theme
    >>> canvas = Canvas(361, 554, PALETTES[Theme.LIGHT])
    >>> found = circle_to_line(canvas, Box(0, 0, 361, 554))
    >>> all(a[0] == b[0] for a, b in found), len(found)
    (True, 6)
    """
    palette, edge = canvas.palette, 2 * EDGE
    first, second, radius = _placed_flat(box)
    long = 0.55 * radius
    canvas.polygon(circle(first, radius), fill=palette.body, edge=palette.ink, width=edge)
    for turn in range(6):
        n = cos(pi / 6 + turn * pi / 3), sin(pi / 6 + turn * pi / 3)
        foot = _at(first, n, radius)
        arrow(canvas, foot, _at(first, n, radius + long), Ink.NORMAL, DIAGRAM_SHAFT)
        disc(canvas, foot, 7.0, palette.ink)
    corner = second[0] - radius - long, second[1] - long - 2
    _map_arrow(canvas, first, corner, radius + long)
    (left, y), right = (second[0] - radius, second[1]), second[0] + radius
    canvas.stroke(((left, y), (right, y)), THIN + 2 * edge, palette.ink)
    canvas.stroke(((left, y), (right, y)), THIN, palette.body)
    ends = []
    for x in (second[0] - 0.6 * radius, second[0], second[0] + 0.6 * radius):
        for side in (-1, 1):
            foot, tip = (x, y + side * THIN), (x, y + side * (THIN + long))
            arrow(canvas, foot, tip, Ink.RIGHT, DIAGRAM_SHAFT)
            ends.append((foot, tip))
    return tuple(ends)


def _placed_flat(box: Box) -> tuple[Point, Point, float]:
    """Return the middles of the circle and the line, and the radius, that fit the box."""
    if box.width > box.height:
        radius = min((box.width - 2 * PAD - GAP) / 5.1, (box.height - 2 * PAD) / 3.1)
        aside = (GAP + 3.55 * radius) / 2
        (x, y), shift = box.middle, 0.275 * radius
        return (x - aside + shift, y), (x + aside + shift, y), radius
    radius = min((box.width - 2 * PAD) / 3.1, (box.height - 2 * PAD - GAP - THIN) / 4.2)
    used = 4.2 * radius + GAP + THIN
    top = box.middle[1] - used / 2
    return (box.middle[0], top + 1.55 * radius), (box.middle[0], top + used - 0.55 * radius), radius


def _side_by_side(box: Box, stretch: float) -> tuple[Point, Point, float]:
    """Return the middles of the circle and of the wider ellipse, and the radius, that fit."""
    room = box.width - 2 * PAD - GAP - 2 * ROOM_ASIDE
    radius = min(room / 2 / (1 + stretch), (box.height - 2 * PAD - ROOM_ABOVE) / 2)
    used = 2 * radius * (1 + stretch) + GAP + 2 * ROOM_ASIDE
    left = box.x + (box.width - used) / 2 + radius
    right = left + radius + ROOM_ASIDE + GAP + stretch * radius
    middle = box.middle[1] + ROOM_ABOVE / 2
    return (left, middle), (right, middle), radius


def _stacked(box: Box, stretch: float) -> tuple[Point, Point, float]:
    """Return the middles of the circle and of the higher ellipse, and the radius, that fit."""
    high = box.height - 2 * PAD - GAP - ROOM_ABOVE
    radius = min(high / 2 / (1 + stretch), (box.width - 2 * PAD - ROOM_ASIDE) / 2)
    left = box.x + (box.width - 2 * radius - ROOM_ASIDE) / 2 + radius
    used = 2 * radius * (1 + stretch) + GAP
    top = box.y + (box.height + ROOM_ABOVE - used) / 2
    return (left, top + radius), (left, top + used - stretch * radius), radius


def _map_arrow(canvas: Canvas, first: Point, corner: Point, radius: float) -> None:
    """Draw the arrow of the map from the circle to an ellipse with this upper left corner."""
    if corner[1] > first[1]:
        start, end = first[1] + radius + 16, corner[1] - 16
        arrow(canvas, (first[0], start), (first[0], end), Ink.PLAIN, DIAGRAM_SHAFT)
        canvas.text((first[0] - 18, (start + end) / 2 + 9), "A", LETTER + 4, bold=True, align=1)
    else:
        end, y = corner[0] - 24, first[1]
        arrow(canvas, (end - GAP, y), (end, y), Ink.PLAIN, DIAGRAM_SHAFT)
        canvas.text((end - GAP / 2, y - 18), "A", LETTER + 4, bold=True, align=0.5)


def _letter(canvas: Canvas, place: Point, text: str, colour: str) -> Text:
    return canvas.text(place, text, LETTER, colour, bold=True, halo=canvas.palette.stage)


def _unit(v: Point) -> Point:
    size = hypot(*v)
    return v[0] / size, v[1] / size


def _at(place: Point, along: Point, far: float) -> Point:
    """Return the point so far along a direction whose y goes up."""
    return place[0] + along[0] * far, place[1] - along[1] * far


def _down(v: Point) -> Point:
    return v[0], -v[1]
