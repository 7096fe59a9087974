"""The chart of a study: one picture that says what more or less time buys.

Normals are a plot of error against time around what people write, at (1, 1). The dials of a
picture and the shading spaces are rows of dots, sorted. Names stand at the points.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import degrees, sqrt

from nmatrix.canvas.glyphs import blend
from nmatrix.canvas.marks import SMALLEST_TEXT, Box, Point
from nmatrix.canvas.paint import pixels, vector
from nmatrix.canvas.slide import Slide
from nmatrix.canvas.text import plain, width
from nmatrix.enums import PixelFormat, Theme, VectorFormat
from nmatrix.studies.easel import (
    BEATEN_NAME,
    DASHES,
    DIAMOND,
    DOT,
    DOTS,
    KEY,
    NAME,
    WORDS,
    Easel,
    Scale,
    power,
)
from nmatrix.studies.labels import Ground, Label, Weight
from nmatrix.studies.measurements import Study
from nmatrix.studies.summary import MOST, VISIBLE, Role, Standing, Summary, multiple

STEP = 5.0  # the width of the front
ERRORS_FROM, ERRORS_TO = 10.0**-17.7, 10.0**1.3  # of normals, in radians
ROUNDING = 2.0**-53  # an angle that is less is rounding, on any matrices
BUSY_BARS = "the machine was busy: bars are the spread of a time"
BUSY_NUMBERS = "the machine was busy: times are told as their spread"
ERROR_OF_A_PICTURE = "how far a pixel is off, in levels of 255 (root of the mean square)"
LABELS = {"inverse": "inv(A).T, what people write", "matrix": "matrix: A itself"}


@dataclass(frozen=True)
class Look:
    """How much of a study is drawn, at what size in pixels, and in which colours."""

    size: tuple[int, int] = (1600, 900)
    theme: Theme = Theme.LIGHT
    everything: bool = False


def chart_file(summary: Summary, look: Look, kind: PixelFormat | VectorFormat) -> bytes:
    """Draw the chart and return its file; equal summaries give equal bytes."""
    slide = chart(summary, look)
    told = [
        f"{one.name}: {one.worst:.2g} {one.unit}, {multiple(one.price)} the {summary.measure}."
        for one in summary.shown(everything=look.everything)
    ]
    words = {"Title": plain(slide.title), "Description": " ".join(told)}
    if isinstance(kind, VectorFormat):
        return vector(slide.canvas, kind, words)
    from nmatrix.raster.image import picture_file

    return picture_file([pixels(slide.canvas)], words, kind)


def chart(summary: Summary, look: Look) -> Slide:
    """Draw the chart of a study under its sentence."""
    slide = Slide.of(summary.sentence, look.size, look.theme)
    kind = _Plot if summary.study is Study.NORMALS else _Rows
    kind(slide, summary, summary.shown(everything=look.everything)).draw()
    return slide


class _Plot(Easel):
    """`cost normals`: the largest angle off against time, around what people write."""

    def draw(self) -> None:
        """Draw the lines under the points, and the points under their names."""
        self.plot = self.stage(86, 104)
        ends = [x for one in self.shown for x in self.ends(one)]
        low, high = min(0.5, *ends) / 1.5, max(2.0, *ends) * 1.5
        self.x = Scale(low, high, self.plot.x, self.plot.right)
        self.y = Scale(ERRORS_FROM, ERRORS_TO, self.plot.bottom, self.plot.y)
        self.lines: list[Box] = []
        self._band()
        self._axes()
        self._cross()
        falling = [self._down(one) for one in self.shown]
        if self.is_told:
            self._front()
        spreads = [self.bar(one, self.x, self._place(one)[1]) for one in self.shown]
        self.marks = [box for box in spreads if box is not None]
        for one in reversed(self.shown):
            (x, y), r = self._place(one), _radius(self.role(one))
            self.mark((x, y), self.role(one))
            self.marks.append(Box(x - r, y - r, 2 * r, 2 * r))
        self._names()
        self.key(has_lines_down=any(falling))
        count = self.summary.settings
        kinds = "kind" if count == 1 else "kinds"
        self.about(f"the worst of {count} {kinds} of matrices", BUSY_BARS)

    def _place(self, one: Standing) -> Point:
        low, high = self.ends(one)
        middle = 1.0 if one.is_reference else sqrt(low * high)
        return self.x.at(middle), self.y.at(one.worst)

    def _band(self) -> None:
        """Tint and bound the errors that everyone sees."""
        stage, edge = self.plot, self.y.at(VISIBLE)
        stands_out = self.palette.inside != self.palette.stage  # on paper both are white
        ink, part = (self.palette.inside, 0.55) if stands_out else (self.palette.rule, 0.3)
        self.tint = blend((self.palette.stage, ink), part)
        self.band = Box(stage.x, stage.y, stage.width, edge - stage.y)
        self.canvas.polygon(self.band.corners, fill=self.tint)
        self.canvas.stroke(((stage.x, edge), (stage.right, edge)), 2.4, self.palette.wrong)

    def _axes(self) -> None:
        stage, soft = self.plot, self.palette.soft
        self.axis_below(self.x, stage, 2, self.axis_of_prices)
        self.over("largest angle off, in radians", 0.0)
        for k in self.y.exponents(10):
            y = self.y.at(10.0**k)
            self.canvas.stroke(((stage.x, y), (stage.right, y)), 2.0, self.rule)
            self.canvas.text((stage.x - 14, y + 9), power(k), WORDS, soft, align=1.0)
        known = self.summary.reference.worst
        if known <= ERRORS_FROM:  # of nothing there are no multiples
            return
        self.over(f"against {self.summary.reference.spoken}", 1.0)
        multiples = Scale(ERRORS_FROM / known, ERRORS_TO / known, stage.bottom, stage.y)
        for k in multiples.exponents(10):
            y = multiples.at(10.0**k)
            self.canvas.text((stage.right + 14, y + 9), f"{power(k)}×", WORDS, soft)

    def _cross(self) -> None:
        """Draw a thin dashed cross through the reference, except over its own line down."""
        stage, known = self.plot, self.summary.reference
        (x, y), low = self._place(known), self._foot(known)
        for ends in (((x, stage.y), (x, y)), ((x, low), (x, stage.bottom))):
            self.canvas.stroke(ends, 1.8, self.palette.ink, dash=DASHES)
        self.canvas.stroke(((stage.x, y), (stage.right, y)), 1.8, self.palette.ink, dash=DASHES)
        self.lines.append(_around((x, stage.y), (x, stage.bottom)))
        self.lines.append(_around((stage.x, y), (stage.right, y)))

    def _foot(self, one: Standing) -> float:
        """Locate the error of the easiest matrices, where that is visibly lower than the worst."""
        low, y = self.y.at(max(one.easiest, ROUNDING)), self._place(one)[1]
        return low if low - y > 2 * DIAMOND else y

    def _down(self, one: Standing) -> bool:
        """Draw a dotted line from a point down to the error of its easiest matrices, if lower."""
        (x, y), low, colour = self._place(one), self._foot(one), self.colours[self.role(one)]
        if low == y:
            return False
        self.canvas.stroke(((x, y), (x, low)), 2.6, colour, dash=DOTS)
        self.canvas.stroke(((x - 8, low), (x + 8, low)), 2.6, colour)
        self.lines.append(_around((x, y), (x, low)))
        return True

    def _front(self) -> None:
        """Draw the least error that a time buys; whatever is faster is seen to be wrong."""
        places = [self._place(one) for one in self.summary.front if one in self.shown]
        if not places:
            return
        line = [(places[0][0], self.band.bottom)]
        for x, y in places:
            line += [(x, line[-1][1]), (x, y)]
        line.append((self.plot.right, line[-1][1]))
        self.canvas.stroke(line, STEP, self.palette.right)
        self.lines += [_around(a, b) for a, b in pairwise(line)]

    def _names(self) -> None:
        """Write what the band is, then each name at its point, the most important first."""
        words = f"visible: more than {degrees(VISIBLE):g}°"
        corner = self.band.right - 12, self.band.bottom - KEY - 12
        band = Label(corner, words, KEY, self.palette.wrong, Weight.BOLD, 0.0)
        order = list(Role)
        shown = sorted(self.shown, key=lambda one: order.index(self.role(one)))
        names = [self._label(one) for one in shown]
        (known,) = Ground(self.band, self.marks, self.lines).placed([band])
        ground = Ground(self.plot.inset(4), [*self.marks, known.room], self.lines)
        for placed in (known, *ground.placed(names)):
            is_inside = self.band.holds(placed.box.middle)
            placed.write(self.canvas, self.tint if is_inside else self.palette.stage)

    def _label(self, one: Standing) -> Label:
        role = self.role(one)
        is_beaten = role is Role.BEATEN
        is_small = is_beaten or len(self.shown) > MOST
        return Label(
            self._place(one),
            LABELS.get(one.name, one.name),
            BEATEN_NAME if is_small else NAME,
            self.colours[role],
            Weight.PLAIN if is_beaten else Weight.BOLD,
            _radius(role),
        )


class _Rows(Easel):
    """`cost shading` and `cost spaces`: a row for each, with a dot, and a number at the right.

    The dot of a picture is its error and the number its time; the dot of a space is its time and
    the number its counted work.
    """

    def draw(self) -> None:
        """Draw the rows, the most exact first."""
        study, heading = self.summary.study, self._numbers
        names = max(width(_name(one), NAME, bold=True) for one in self.shown) + 24
        self.plot = self.stage(names, max(width(heading, WORDS) + 24, 170))
        self.over("one dial changed at a time" if study is Study.SHADING else "shading space", 0.0)
        self.over(heading, 1.0)
        self.x = self._scale()
        if study is Study.SPACES:
            self.axis_below(self.x, self.plot, 2, self.axis_of_prices)
        else:
            self.axis_below(self.x, self.plot, 10, ERROR_OF_A_PICTURE)
        middle = self.x.at(self._values(self.summary.reference)[0])
        ends = ((middle, self.plot.y), (middle, self.plot.bottom))
        self.canvas.stroke(ends, 1.8, self.palette.ink, dash=DASHES)
        for one, row in zip(self.shown, self.plot.inset(14).rows(len(self.shown), 0), strict=True):
            self._row(one, row)
        self.key(has_lines_down=False)
        self.about(self._about, BUSY_BARS if study is Study.SPACES else BUSY_NUMBERS)

    def _row(self, one: Standing, row: Box) -> None:
        y, role = row.middle[1], self.role(one)
        size = min(NAME, max(SMALLEST_TEXT, int(0.8 * row.height)))
        self.canvas.stroke(((self.plot.x, y), (self.plot.right, y)), 2.0, self.rule)
        low, high = (self.x.at(value) for value in self._values(one))
        if self.summary.study is Study.SPACES:
            self.bar(one, self.x, y)
        self.mark(((low + high) / 2, y), role)
        for x, words in ((self.plot.x - 16, _name(one)), (self.frame.right, self._number(one))):
            self.canvas.text(
                (x, y + 0.36 * size),
                words,
                size,
                self.colours[role],
                bold=role is not Role.BEATEN,
                align=1.0,
            )

    def _scale(self) -> Scale:
        values = [value for one in self.shown for value in self._values(one) if value > 0]
        known = self._values(self.summary.reference)[0] or max(values, default=1.0)
        least = 2 if self.summary.study is Study.SPACES else 4  # times, so that there are ticks
        low, high = min([known / least, *values]) / 1.5, max([known * least, *values]) * 1.5
        return Scale(low, high, self.plot.x, self.plot.right)

    def _values(self, one: Standing) -> tuple[float, float]:
        """Where a dot lies: an error, or the ends of a time."""
        if self.summary.study is Study.SHADING:
            return one.worst, one.worst
        return (1.0, 1.0) if one.is_reference else self.ends(one)

    @property
    def _numbers(self) -> str:
        """What the numbers at the right are."""
        return str(self.shown[0].unit) if self.summary.study is Study.SPACES else "time"

    def _number(self, one: Standing) -> str:
        if self.summary.study is Study.SPACES:
            return f"{one.worst:.0f}"
        low, high = self.ends(one)
        if one.is_reference or low == high:
            return multiple(one.price)
        return f"{low:.2f}–{high:.2f}×"

    @property
    def _about(self) -> str:
        if self.summary.study is Study.SHADING:
            return "the usual frame: 4 samples, phong, shadow map of 512"
        count, _, noun = self.summary.rows[-1].setting.partition(" ")
        return f"{int(count):,} {noun}"


def _name(one: Standing) -> str:
    return one.spoken.removeprefix("the ")


def _radius(role: Role) -> float:
    return DIAMOND if role is Role.REFERENCE else DOT


def _around(a: Point, b: Point) -> Box:
    """Build the box of an upright or level line."""
    x, y = min(a[0], b[0]), min(a[1], b[1])
    return Box(x - 2, y - 2, abs(a[0] - b[0]) + 4, abs(a[1] - b[1]) + 4)
