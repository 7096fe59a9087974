"""The marks that stand for ideas: arrows, lamps, eyes, verdicts, angles, axes, hatching.

Each is told by its shape as well as by its colour: what is wrong is dashed with an open head, what
is right solid with a filled one.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from enum import StrEnum
from math import atan2, cos, hypot, pi, radians, sin

from nmatrix.canvas.marks import Box, Canvas, Point
from nmatrix.canvas.theme import Palette

SHAFT = 4.8  # units; of diagrams 5.6
DIAGRAM_SHAFT = 5.6
HEAD_LONG, HEAD_WIDE = 3.6, 2.9  # shafts
DASH_ON, DASH_OFF = 2.1, 1.5  # shafts
HALO = 1.6
SUN_RADIUS, EYE_RADIUS, BADGE_RADIUS = 19.0, 20.0, 20.0
EDGE = 1.6
SQUARE = 17.0  # the side of a right angle's mark


class Verdict(StrEnum):
    """What a panel shows: a mistake, or what is right."""

    WRONG = "wrong"
    RIGHT = "right"


class Ink(StrEnum):
    """What an arrow or a line stands for."""

    WRONG = "wrong"
    RIGHT = "right"
    NORMAL = "normal"
    TANGENT = "tangent"
    PLAIN = "ink"
    EYE = "eye"

    def colour(self, palette: Palette) -> str:
        """Return its colour in a theme."""
        return palette.named[self.value]


def arrow(canvas: Canvas, a: Point, b: Point, ink: Ink, shaft: float = SHAFT) -> None:
    """Draw an arrow whose tip is at b; one too short for its head is a smaller one."""
    length = hypot(b[0] - a[0], b[1] - a[1])
    if length < 1e-6:
        return
    shaft = min(shaft, length / HEAD_LONG / 1.25)
    along = (b[0] - a[0]) / length, (b[1] - a[1]) / length
    across = -along[1], along[0]
    long, wide = HEAD_LONG * shaft, HEAD_WIDE * shaft / 2
    back = b[0] - along[0] * long, b[1] - along[1] * long
    barbs = [(back[0] + s * across[0] * wide, back[1] + s * across[1] * wide) for s in (1, -1)]
    colour, paper = ink.colour(canvas.palette), canvas.palette.paper
    if ink is Ink.WRONG:
        head = [barbs[0], b, barbs[1]]
        for line in ((a, b), head):
            canvas.stroke(line, shaft + 2 * HALO, paper)
        canvas.stroke((a, b), shaft, colour, dash=(DASH_ON * shaft, DASH_OFF * shaft))
        canvas.stroke(head, shaft, colour)
        return
    neck = b[0] - along[0] * long * 0.8, b[1] - along[1] * long * 0.8
    canvas.stroke((a, neck), shaft + 2 * HALO, paper)
    canvas.polygon((*barbs, b), fill=paper, edge=paper, width=2 * HALO)
    canvas.stroke((a, neck), shaft, colour)
    canvas.polygon((*barbs, b), fill=colour)


def line(canvas: Canvas, points: Iterable[Sequence[float]], ink: Ink, width: float = SHAFT) -> None:
    """Draw a line without a head, dashed where it stands for what is wrong."""
    dash = (DASH_ON * width, DASH_OFF * width) if ink is Ink.WRONG else None
    canvas.stroke(points, width, ink.colour(canvas.palette), dash=dash)


def disc(canvas: Canvas, place: Point, radius: float, fill: str, edge: str | None = None) -> None:
    """Draw a disc, edged or not."""
    canvas.polygon(circle(place, radius), fill=fill, edge=edge, width=EDGE if edge else 0)


def circle(place: Point, radius: float, steps: int = 64) -> list[Point]:
    """Return the points of a circle."""
    return [
        (place[0] + radius * cos(2 * pi * i / steps), place[1] + radius * sin(2 * pi * i / steps))
        for i in range(steps)
    ]


def arc(place: Point, radius: float, first: float, last: float, steps: int = 48) -> list[Point]:
    """Return the points of an arc from one angle to another, in degrees, counted upwards from x."""
    turns = [radians(first + (last - first) * i / steps) for i in range(steps + 1)]
    return [(place[0] + radius * cos(t), place[1] - radius * sin(t)) for t in turns]


def sun(canvas: Canvas, place: Point, towards: Point, *, lost: bool = False) -> None:
    """Draw a light at infinity: a disc, and three parallel arrows the way its light goes.

    One that should not come from there is hollow.
    """
    palette, length = canvas.palette, hypot(*towards)
    fill, edge = (palette.stage, palette.wrong) if lost else (palette.light, palette.ink)
    width = 4.0 if lost else EDGE
    canvas.polygon(circle(place, SUN_RADIUS), fill=fill, edge=edge, width=width)
    if length < 1e-6:  # it shines along the view: towards the eye or away
        disc(canvas, place, 4.0, edge)
        return
    u = towards[0] / length, towards[1] / length
    v = -u[1], u[0]
    for i in (-1, 0, 1):
        start = _moved(place, u, SUN_RADIUS + 9 - 4 * abs(i), v, 17 * i)
        outline = _light_arrow(start, _moved(start, u, 40, v, 0))
        canvas.polygon(outline, fill=fill, edge=edge, width=1.6 * EDGE if lost else EDGE)


def _light_arrow(a: Point, b: Point) -> list[Point]:
    """Return the outline of an arrow of light."""
    length = hypot(b[0] - a[0], b[1] - a[1])
    u = (b[0] - a[0]) / length, (b[1] - a[1]) / length
    v = -u[1], u[0]
    half, barb, neck = 2.6, 8.5, length - 16
    return [
        _moved(a, u, along, v, side)
        for along, side in (
            (0, half),
            (neck, half),
            (neck, barb),
            (length, 0),
            (neck, -barb),
            (neck, -half),
            (0, -half),
        )
    ]


def lamp(canvas: Canvas, place: Point, *, radius: float = SUN_RADIUS, lost: bool = False) -> None:
    """Draw a lamp at its place: a disc with twelve rays; hollow where it should not be."""
    palette = canvas.palette
    for i in range(12):
        u = cos(pi * i / 6), sin(pi * i / 6)
        near, far = (_moved(place, u, radius * part, u, 0) for part in (1.32, 1.75))
        if lost:
            canvas.stroke((near, far), 4.0, palette.wrong, halo=HALO)
        else:
            canvas.stroke((near, far), 6.6, palette.ink)
            canvas.stroke((near, far), 3.6, palette.light)
    if lost:
        canvas.polygon(circle(place, radius), fill=palette.stage, edge=palette.wrong, width=4.0)
    else:
        disc(canvas, place, radius, palette.light, palette.ink)


def eye(canvas: Canvas, place: Point, towards: Point, radius: float = EYE_RADIUS) -> None:
    """Draw an eye: a lens of two arcs and an iris, which looks along a direction."""
    turn = atan2(towards[1], towards[0])
    u, v = (cos(turn), sin(turn)), (-sin(turn), cos(turn))
    half = 0.62 * radius
    lids = [
        _moved(place, u, side * half * (1 - t * t) - 0.15 * radius, v, radius * t)
        for side, ts in ((1, range(-12, 13)), (-1, range(11, -12, -1)))
        for t in (i / 12 for i in ts)
    ]
    colour, white = canvas.palette.eye, canvas.palette.paper
    canvas.polygon(lids, fill=white, edge=white, width=3.2 + 2 * HALO)
    canvas.polygon(lids, fill=white, edge=colour, width=3.2)
    disc(canvas, _moved(place, u, 0.05 * radius, v, 0), 0.34 * radius, colour)


def badge(canvas: Canvas, place: Point, verdict: Verdict, radius: float = BADGE_RADIUS) -> None:
    """Draw a verdict: ✗ on a square, ✓ on a disc."""
    x, y = place
    k = radius / BADGE_RADIUS
    if verdict is Verdict.WRONG:
        canvas.polygon(_rounded_square(place, 0.95 * radius, 4 * k), fill=canvas.palette.wrong)
        for s in (1, -1):
            ends = ((x - 8 * k, y - 8 * s * k), (x + 8 * k, y + 8 * s * k))
            canvas.stroke(ends, 4.6 * k, canvas.palette.paper)
    else:
        disc(canvas, place, radius, canvas.palette.right)
        tick = ((x - 9 * k, y + 0.5 * k), (x - 3 * k, y + 7 * k), (x + 9 * k, y - 7 * k))
        canvas.stroke(tick, 4.6 * k, canvas.palette.paper)


def _rounded_square(place: Point, half: float, radius: float) -> list[Point]:
    inner = half - radius
    corners = ((inner, -inner, 0), (-inner, -inner, 90), (-inner, inner, 180), (inner, inner, 270))
    return [
        point
        for dx, dy, turn in corners
        for point in arc((place[0] + dx, place[1] + dy), radius, turn, turn + 90, 8)
    ]


def ring(canvas: Canvas, place: Point, *, same: bool, radius: float = 26.0) -> None:
    """Draw = or ≠ in a ring, which stands between two panels."""
    x, y = place
    colour = canvas.palette.right if same else canvas.palette.wrong
    canvas.polygon(circle(place, radius), fill=canvas.palette.paper, edge=colour, width=4.2)
    for dy in (-6.0, 6.0):
        canvas.stroke(((x - 12, y + dy), (x + 12, y + dy)), 4.6, colour)
    if not same:
        canvas.stroke(((x - 8, y + 15), (x + 8, y - 15)), 4.6, colour)


def right_angle(
    canvas: Canvas, corner: Point, u: Point, v: Point, ink: Ink, side: float = SQUARE
) -> None:
    """Draw the square mark of a right angle between two unit directions."""
    square = (
        _moved(corner, u, side, v, 0),
        _moved(corner, u, side, v, side),
        _moved(corner, u, 0, v, side),
    )
    canvas.stroke(square, 3.2, ink.colour(canvas.palette))


def hatching(loop: Sequence[Point], spacing: float = 12.0) -> list[tuple[Point, Point]]:
    """Return stripes at 45° inside a closed loop, by the even-odd rule.

    Examples
    --------
    >>> [(a[0] + a[1], b[0] + b[1]) for a, b in hatching([(0, 0), (9, 0), (9, 9), (0, 9)], 6)]
    [(6.0, 6.0), (12.0, 12.0)]
    """
    sums = [x + y for x, y in loop]
    stripes = []
    step = int(min(sums) // spacing) + 1
    while step * spacing < max(sums):
        level, cuts = step * spacing, []
        for (ax, ay), (bx, by) in zip(loop, (*loop[1:], loop[0]), strict=True):
            a, b = ax + ay - level, bx + by - level
            if (a < 0) != (b < 0):
                t = a / (a - b)
                cuts.append((ax + t * (bx - ax), ay + t * (by - ay)))
        cuts.sort()
        stripes += list(zip(cuts[::2], cuts[1::2], strict=False))
        step += 1
    return stripes


def hatch(canvas: Canvas, loop: Sequence[Point], spacing: float, colour: str, wide: float) -> None:
    """Draw stripes at 45° inside a closed loop."""
    for stripe in hatching(loop, spacing):
        canvas.stroke(stripe, wide, colour, round_ends=False)


def ramp_bar(canvas: Canvas, box: Box, ends: tuple[str, str], size: float = 22.0) -> None:
    """Draw the scale of a map of colours with both of its ends written above it."""
    ramp(canvas, box)
    canvas.text((box.x, box.y - 10), ends[0], size)
    canvas.text((box.right, box.y - 10), ends[1], size, align=1.0)


def ramp(canvas: Canvas, box: Box, steps: int = 96) -> None:
    """Draw the colours of a map from its least to its largest value, left to right."""
    stops = canvas.palette.heat
    for i, part in enumerate(box.columns(steps, 0)):
        wide = Box(part.x, part.y, box.right - part.x, part.height)  # over all that follow: no seam
        canvas.polygon(wide.corners, fill=blend(stops, i / (steps - 1)))


def blend(stops: Sequence[str], part: float) -> str:
    """Return the colour so far along stops of one distance.

    Examples
    --------
    >>> blend(("#000000", "#FFFFFF"), 0.5)
    '#808080'
    """
    place = min(max(part, 0.0), 1.0) * (len(stops) - 1)
    i = min(int(place), len(stops) - 2)
    a, b = ([int(stops[j][k : k + 2], 16) for k in (1, 3, 5)] for j in (i, i + 1))
    mixed = (round(x + (place - i) * (y - x)) for x, y in zip(a, b, strict=True))
    return "#" + "".join(f"{one:02X}" for one in mixed)


def _moved(place: Point, u: Point, along: float, v: Point, aside: float) -> Point:
    return place[0] + u[0] * along + v[0] * aside, place[1] + u[1] * along + v[1] * aside
