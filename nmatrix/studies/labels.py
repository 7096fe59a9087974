"""Labels at the points of a chart: a greedy rule finds each a place that nothing else has.

A label may touch no other label and no point, and may not leave the frame. Of the places that are
left it takes the one over the fewest lines, the nearest first; a thin line leads to a far one.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import Enum, auto
from functools import cached_property
from math import hypot, inf

from nmatrix.canvas.marks import Box, Canvas, Point, Text
from nmatrix.canvas.text import width

PAD = 5.0  # units between a label and whatever else
APART = 9.0  # more of them between two labels side by side
GAP = 9.0  # between a point and its label
RINGS = 40
RING = 13.0  # units from one ring of places to the next
# Where a label lies beside its point, the best first: parts of its width and height.
SIDES = (
    *((1, 0), (-1, 0), (0, -1), (0, 1), (1, -1), (-1, -1), (1, 1), (-1, 1)),
    *((0.6, -1), (-0.6, -1), (0.6, 1), (-0.6, 1)),
)
OVER_A_LINE = 7.0  # rings that a label goes farther rather than lie over a line
LED = 3.0  # and rather than need a line that leads to it
CROSSING = 100.0  # and rather than have that line cross another
RETRIES = 4  # orders in which labels that found no room come first

Line = tuple[Point, Point]


class Weight(Enum):
    """How strongly a label is written."""

    PLAIN = auto()
    BOLD = auto()


@dataclass(frozen=True)
class Label:
    """What is written at a point, whose mark has a radius."""

    point: Point
    text: str
    size: float
    colour: str
    weight: Weight
    radius: float


@dataclass(frozen=True, eq=False)
class Ground:
    """The frame of a chart, its marks, which no label may touch, and its lines, if it can be."""

    frame: Box
    marks: Sequence[Box]
    lines: Sequence[Box]

    def placed(self, labels: Sequence[Label]) -> list[Placed]:
        """Place labels, in the order that leaves them the nearest to their points.

        Some orders are tried: that of the labels, from the left, from the right, and each with
        those that found no room before the others.
        """
        across = sorted(labels, key=lambda label: label.point)
        tries = (self._in_order(list(order)) for order in (labels, across, reversed(across)))
        found = min(tries, key=lambda placed: sum(one.cost for one in placed.values()))
        return [found[id(label)] for label in labels if found[id(label)].cost < inf]

    def _in_order(self, order: list[Label]) -> dict[int, Placed]:
        """Place labels one after the other, then each again among the others."""
        for _ in range(RETRIES):
            found: dict[int, Placed] = {}
            for label in order:
                found[id(label)] = self._best(label, found)
            lost = [label for label in order if found[id(label)].cost == inf]
            if not lost:
                break
            order = [*lost, *(label for label in order if label not in lost)]
        for label in order:
            again = self._best(label, found)
            crossing = again if again.cost < inf else self._best(label, found, may_cross=True)
            found[id(label)] = crossing
        return found

    def _best(
        self, label: Label, others: Mapping[int, Placed], *, may_cross: bool = False
    ) -> Placed:
        """Find the best place among the others', or one of no worth.

        In a crowd the line to a label may have to cross another label.
        """
        known = [one for key, one in others.items() if key != id(label) and one.cost < inf]
        taken = [*self.marks, *(one.room for one in known)]
        lines = [one.leader for one in known if one.leader is not None]
        away = [box for box in taken if not box.holds(label.point)]
        best = Placed(label, Box(0, 0, 0, 0), inf)
        for ring, box in _places(label):
            least = ring + CROSSING * may_cross
            if least >= best.cost:
                break
            padded = box.inset(-PAD)
            if not _within(padded, self.frame) or any(overlap(padded, one) for one in taken):
                continue
            one = Placed(label, box)
            if not may_cross and (
                any(_meet(line, box) for line in lines)
                or (one.leader is not None and any(_meet(one.leader, box) for box in away))
            ):
                continue
            over = sum(overlap(padded, line) for line in self.lines)
            cost = least + OVER_A_LINE * over + LED * (one.leader is not None)
            if cost < best.cost:
                best = replace(one, cost=cost)
        return best


@dataclass(frozen=True)
class Placed:
    """A label in its box, and how bad a place that is."""

    label: Label
    box: Box
    cost: float = 0.0

    @cached_property
    def leader(self) -> Line | None:
        """The line from the mark to the label; none where the two are neighbours."""
        (x, y), box, radius = self.label.point, self.box, self.label.radius
        end = min(max(x, box.x), box.right), min(max(y, box.y), box.bottom)
        length = hypot(end[0] - x, end[1] - y)
        start = radius + 3
        if length < start + GAP + RING:
            return None
        u = (end[0] - x) / length, (end[1] - y) / length
        near, far = ((x + u[0] * at, y + u[1] * at) for at in (start, length - 3))
        return near, far

    @property
    def room(self) -> Box:
        """What no other label may touch: the box, with room at its sides."""
        box = self.box
        return Box(box.x - APART, box.y, box.width + 2 * APART, box.height)

    def write(self, canvas: Canvas, halo: str) -> Text:
        """Write the label, and draw the line that leads to it."""
        label = self.label
        if self.leader is not None:
            canvas.stroke(self.leader, 1.6, label.colour)
        place = self.box.x, self.box.y + 0.76 * label.size
        bold = label.weight is Weight.BOLD
        return canvas.text(place, label.text, label.size, label.colour, bold=bold, halo=halo)


def _meet(line: Line, box: Box) -> bool:
    """Tell whether a line passes through a box: some part of it is between all four sides."""
    (ax, ay), (bx, by) = line
    first, last = 0.0, 1.0
    for start, step, low, high in (
        (ax, bx - ax, box.x, box.right),
        (ay, by - ay, box.y, box.bottom),
    ):
        if step == 0:
            if not low < start < high:
                return False
            continue
        enters, leaves = sorted(((low - start) / step, (high - start) / step))
        first, last = max(first, enters), min(last, leaves)
    return first < last


def overlap(a: Box, b: Box) -> bool:
    """Tell whether two boxes share more than a side.

    Examples
    --------
    >>> overlap(Box(0, 0, 2, 2), Box(1, 1, 2, 2)), overlap(Box(0, 0, 2, 2), Box(2, 0, 2, 2))
    (True, False)
    """
    return a.x < b.right and b.x < a.right and a.y < b.bottom and b.y < a.bottom


def _within(box: Box, frame: Box) -> bool:
    return (
        frame.x <= box.x
        and box.right <= frame.right
        and frame.y <= box.y
        and box.bottom <= frame.bottom
    )


def _places(label: Label) -> Iterator[tuple[int, Box]]:
    """Generate the boxes that a label could fill, ring by ring around its point."""
    (x, y), high = label.point, 0.98 * label.size
    wide = width(label.text, label.size, bold=label.weight is Weight.BOLD)
    for ring in range(RINGS):
        away = label.radius + GAP + RING * ring
        for right, down in SIDES:
            both = 0.9 if right and down else 1.0  # a corner is farther than a side
            yield (
                ring,
                Box(
                    x - wide / 2 + right * (wide / 2 + both * away),
                    y - high / 2 + down * (high / 2 + both * away),
                    wide,
                    high,
                ),
            )
