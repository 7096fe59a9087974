"""What a picture is made of: strokes, polygons, text and images, gathered on a canvas.

A canvas measures in units: 900 of them are the height of a picture of 16:9, x goes right and y
down. `scale` is the number of pixels of a unit where the picture is written as pixels.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from nmatrix.canvas.text import LEADING, width, wrapped
from nmatrix.canvas.theme import Palette

if TYPE_CHECKING:
    from numpy.typing import NDArray

Point = tuple[float, float]
SMALLEST_TEXT = 20  # units


@dataclass(frozen=True)
class Stroke:
    """A line through points; `dash` is the lengths of a dash and a gap."""

    points: tuple[Point, ...]
    width: float
    colour: str
    dash: tuple[float, float] | None = None
    round_ends: bool = True


@dataclass(frozen=True)
class Polygon:
    """Closed loops, filled by the even-odd rule and edged."""

    loops: tuple[tuple[Point, ...], ...]
    fill: str | None
    edge: str | None = None
    width: float = 0.0
    opacity: float = 1.0


@dataclass(frozen=True)
class Text:
    """One line of marked-up text; `place` is where its baseline begins. `halo` surrounds it."""

    place: Point
    text: str
    size: float
    colour: str
    bold: bool = False
    halo: str | None = None

    @property
    def box(self) -> Box:
        """Return the box of its letters, from the ascenders to the descenders."""
        (x, y), wide = self.place, width(self.text, self.size, bold=self.bold)
        return Box(x, y - 0.76 * self.size, wide, 0.98 * self.size)


@dataclass(frozen=True, eq=False)
class Raster:
    """An 8-bit image (height, width, 3) that fills a box."""

    box: Box
    pixels: NDArray[Any]


Mark = Stroke | Polygon | Text | Raster


@dataclass(frozen=True)
class Box:
    """A rectangle in units: its upper left corner and its sides."""

    x: float
    y: float
    width: float
    height: float

    @property
    def right(self) -> float:
        """Return the x of its right side."""
        return self.x + self.width

    @property
    def bottom(self) -> float:
        """Return the y of its lower side."""
        return self.y + self.height

    @property
    def middle(self) -> Point:
        """Return its middle."""
        return self.x + self.width / 2, self.y + self.height / 2

    @property
    def corners(self) -> tuple[Point, ...]:
        """Return its corners, clockwise from the upper left."""
        return (
            (self.x, self.y),
            (self.right, self.y),
            (self.right, self.bottom),
            (self.x, self.bottom),
        )

    def inset(self, pad: float) -> Box:
        """Return the box with every side so far inside."""
        return Box(self.x + pad, self.y + pad, self.width - 2 * pad, self.height - 2 * pad)

    def holds(self, point: Point) -> bool:
        """Tell whether a point is inside."""
        return self.x <= point[0] <= self.right and self.y <= point[1] <= self.bottom

    def columns(self, count: int, gutter: float) -> tuple[Box, ...]:
        """Divide the box into columns of one width.

        Examples
        --------
        >>> [(one.x, one.width) for one in Box(0, 0, 100, 9).columns(2, 20)]
        [(0.0, 40.0), (60.0, 40.0)]
        """
        wide = (self.width - gutter * (count - 1)) / count
        return tuple(
            Box(self.x + i * (wide + gutter), self.y, wide, self.height) for i in range(count)
        )

    def rows(self, count: int, gutter: float) -> tuple[Box, ...]:
        """Divide the box into rows of one height."""
        high = (self.height - gutter * (count - 1)) / count
        return tuple(
            Box(self.x, self.y + i * (high + gutter), self.width, high) for i in range(count)
        )


@dataclass(eq=False)
class Canvas:
    """A picture in the making: marks are laid over one another in the order of the calls."""

    width: float
    height: float
    palette: Palette
    scale: float = 1.0
    marks: list[Mark] = field(default_factory=list)

    @property
    def pixels(self) -> tuple[int, int]:
        """Return the width and the height in pixels."""
        return round(self.width * self.scale), round(self.height * self.scale)

    def on_pixels(self, box: Box) -> Box:
        """Return a box moved to the nearest pixels, so that boxes of one size stay so."""
        k = self.scale
        wide, high = max(round(box.width * k), 1), max(round(box.height * k), 1)
        return Box(round(box.x * k) / k, round(box.y * k) / k, wide / k, high / k)

    def pixels_of(self, box: Box) -> tuple[int, int]:
        """Return the pixels of the sides of a box that lies on pixels."""
        return round(box.width * self.scale), round(box.height * self.scale)

    def stroke(
        self,
        points: Iterable[Sequence[float]],
        width: float,
        colour: str,
        *,
        dash: tuple[float, float] | None = None,
        halo: float = 0.0,
        round_ends: bool = True,
    ) -> None:
        """Draw a line through points, over a wider one of paper if it has a halo."""
        line = _points(points)
        if len(line) < 2:
            return
        if halo:
            self.marks.append(Stroke(line, width + 2 * halo, self.palette.paper))
        self.marks.append(Stroke(line, width, colour, dash, round_ends and dash is None))

    def polygon(
        self,
        *loops: Iterable[Sequence[float]],
        fill: str | None,
        edge: str | None = None,
        width: float = 0.0,
        opacity: float = 1.0,
    ) -> None:
        """Fill closed loops and draw their edges."""
        self.marks.append(Polygon(tuple(map(_points, loops)), fill, edge, width, opacity))

    def text(  # noqa: PLR0913  # each is a side of one line, and most are left out
        self,
        place: Point,
        text: str,
        size: float,
        colour: str | None = None,
        *,
        bold: bool = False,
        align: float = 0.0,
        halo: str | None = None,
    ) -> Text:
        """Write a line; `align` is the part of its width that lies left of the place."""
        x = place[0] - align * width(text, size, bold=bold)
        found = Text((x, place[1]), text, size, colour or self.palette.ink, bold, halo)
        self.marks.append(found)
        return found

    def paragraph(
        self, place: Point, text: str, size: float, room: float, colour: str | None = None
    ) -> float:
        """Write text in lines that fit the room; return the baseline of the line after them."""
        x, y = place
        for line in wrapped(text, size, room):
            self.text((x, y), line, size, colour or self.palette.soft)
            y += LEADING * size
        return y

    def image(self, box: Box, pixels: NDArray[Any]) -> None:
        """Lay an image over a box that lies on pixels."""
        self.marks.append(Raster(box, pixels))


def _points(points: Iterable[Sequence[float]]) -> tuple[Point, ...]:
    return tuple((float(p[0]), float(p[1])) for p in points)
