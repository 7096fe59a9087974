"""The layout of a proof: the claim as title, panels that say one thing each, one large number.

A slide is 1600 × 900 units, or as much wider or higher as the picture's shape asks for: stages
grow, type keeps its size. Beyond 2.4 : 1 and 1.45 : 1 the slide stays as it is, in the middle.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from nmatrix.canvas.glyphs import BADGE_RADIUS, Verdict, badge, hatch, ring
from nmatrix.canvas.marks import Box, Canvas, Point
from nmatrix.canvas.text import LEADING, fitting, plain, width
from nmatrix.canvas.theme import PALETTES, Palette
from nmatrix.enums import Theme

WIDTH, HEIGHT = 1600.0, 900.0
WIDEST, HIGHEST = 2.4, 1.45  # width over height
MARGIN = 48.0
TITLE_SIZES = range(36, 45)
HEADING, NARROW_HEADING, CAPTION, BIG = 30, 24, 22, 84
TITLE_AT, STAGE_AT = 76.0, 156.0
GUTTER = 20.0
LABELS, LARGE_BADGE = 196.0, 27.0  # the words beside the rows of a table


@dataclass(frozen=True, eq=False)
class Panel:
    """One picture of a slide: what stands above it and below, and the box of its stage."""

    stage: Box
    heading: str = ""
    verdict: Verdict | None = None
    caption: str = ""

    @property
    def told(self) -> str:
        """Return the panel in one line of characters."""
        mark = {Verdict.WRONG: "✗ ", Verdict.RIGHT: "✓ ", None: ""}[self.verdict]
        caption = plain(self.caption.replace("\n", " "))
        return mark + ": ".join(filter(None, (plain(self.heading), caption)))


@dataclass(frozen=True)
class Row:
    """What a row of a table of panels shows: a word with its verdict, and a sentence under it."""

    heading: str
    verdict: Verdict
    caption: str


@dataclass(eq=False)
class Slide:
    """A proof in the making: its canvas, its title, its panels, and which of them are the same."""

    canvas: Canvas
    title: str
    panels: list[Panel] = field(default_factory=list)
    same: list[tuple[Panel, Panel]] = field(default_factory=list)

    @classmethod
    def of(cls, title: str, size: tuple[int, int], theme: Theme) -> Slide:
        """Begin a slide of so many pixels with its title."""
        scale = min(size[0] / WIDTH, size[1] / HEIGHT)
        canvas = Canvas(size[0] / scale, size[1] / scale, PALETTES[theme], scale)
        slide = cls(canvas, title)
        frame = slide.frame
        largest = fitting(title, TITLE_SIZES, frame.width, bold=True)
        canvas.text((frame.x, frame.y + TITLE_AT), title, largest, bold=True)
        return slide

    @property
    def palette(self) -> Palette:
        """Return the colours."""
        return self.canvas.palette

    @property
    def frame(self) -> Box:
        """Return the box that everything stands in: no margin above and below, one at the sides."""
        wide = min(self.canvas.width, WIDEST * self.canvas.height)
        high = min(self.canvas.height, self.canvas.width / HIGHEST)
        left, top = (self.canvas.width - wide) / 2, (self.canvas.height - high) / 2
        return Box(left + MARGIN, top, wide - 2 * MARGIN, high)

    def body(self, below: float, *, top: float = STAGE_AT) -> Box:
        """Return the box of the stages, which leaves so many units below them."""
        frame = self.frame
        return Box(frame.x, frame.y + top, frame.width, frame.height - top - below)

    def panel(
        self,
        stage: Box,
        heading: str = "",
        verdict: Verdict | None = None,
        caption: str = "",
        *,
        size: int = HEADING,
    ) -> Panel:
        """Lay a stage with its heading above it and its caption below."""
        box = self.canvas.on_pixels(stage)
        found = Panel(box, heading, verdict, caption)
        self.panels.append(found)
        self.canvas.polygon(box.corners, fill=self.palette.stage)
        if heading:
            self.heading(box.x, box.y - 16, heading, verdict, size=size)
        if caption:
            self.caption(box, caption)
        return found

    def table(
        self, box: Box, rows: Sequence[Row], columns: Sequence[str], undecided: int = 0
    ) -> list[list[Panel]]:
        """Lay rows of panels under the headings of their columns, beside the words of each row.

        In the first columns, as many as are `undecided`, the rows do not differ yet.
        """
        inner = Box(box.x + LABELS, box.y, box.width - LABELS, box.height)
        found = []
        for place, row in zip(inner.rows(len(rows), GUTTER), rows, strict=True):
            badge(self.canvas, (box.x + LARGE_BADGE, place.y + 44), row.verdict, LARGE_BADGE)
            colour = self.palette.named[row.verdict.value]
            self.canvas.text((box.x, place.y + 112), row.heading, HEADING - 2, colour, bold=True)
            self.canvas.paragraph(
                (box.x, place.y + 148), row.caption, CAPTION, LABELS - GUTTER, self._soft
            )
            found.append(
                [
                    self._cell(stage, f"{row.heading}, {column}", row.verdict if decided else None)
                    for decided, stage, column in zip(
                        (i >= undecided for i in range(len(columns))),
                        place.columns(len(columns), GUTTER),
                        columns,
                        strict=True,
                    )
                ]
            )
        for one, column in zip(found[0], columns, strict=True):
            self.heading(one.stage.x, one.stage.y - 16, column)
        return found

    def captioned(self, panel: Panel, caption: str) -> Panel:
        """Write the caption of a panel that was laid without one."""
        self.caption(panel.stage, caption)
        return self._instead(panel, replace(panel, caption=caption))

    def _instead(self, panel: Panel, other: Panel) -> Panel:
        self.panels = [other if one is panel else one for one in self.panels]
        return other

    def _cell(self, stage: Box, heading: str, verdict: Verdict | None) -> Panel:
        """Lay the stage of a panel whose heading stands at its row and its column."""
        laid = self.panel(stage)
        return self._instead(laid, replace(laid, heading=heading, verdict=verdict))

    def no_answer(
        self, panel: Panel, reason: str, size: int = HEADING, place: Point | None = None
    ) -> None:
        """Hatch a stage on which there is nothing to draw, and write the reason in it."""
        self.canvas.polygon(panel.stage.corners, fill=self.palette.stage)
        hatch(self.canvas, panel.stage.corners, 16.0, self.palette.rule, 2.4)
        (x, y), halo = place or panel.stage.middle, self.palette.stage
        colour = self.palette.wrong if panel.verdict is Verdict.WRONG else self.palette.ink
        y += 0.36 * size
        self.canvas.text((x, y), reason, size, colour, bold=True, align=0.5, halo=halo)

    def heading(
        self, x: float, y: float, text: str, verdict: Verdict | None = None, *, size: int = HEADING
    ) -> None:
        """Write a heading on a baseline, after its verdict, whose colour it has."""
        colour = self.palette.ink
        if verdict is not None:
            radius = BADGE_RADIUS * size / HEADING
            badge(self.canvas, (x + radius, y - 0.36 * size), verdict, radius)
            x += 2.6 * radius
            colour = self.palette.named[verdict.value]
        self.canvas.text((x, y), text, size, colour, bold=True)

    def caption(self, box: Box, text: str) -> None:
        """Write a caption below a stage."""
        self.canvas.paragraph((box.x, box.bottom + 38), text, CAPTION, box.width)

    def large_number(self, x: float, y: float, number: str, words: str, size: int = BIG) -> None:
        """Write the number that matters on a baseline, and what it is of beside it."""
        self.canvas.text((x, y), number, size, bold=True)
        aside = x + width(number, size, bold=True) + 18
        self.canvas.text((aside, y), words, HEADING if len(words) < 12 else CAPTION, self._soft)

    def footer(self, text: str, verdict: Verdict | None = None, *, x: float | None = None) -> None:
        """Write a sentence under everything, after its verdict."""
        frame = self.frame
        x, y = frame.x if x is None else x, frame.bottom - 40
        if verdict is not None:
            badge(self.canvas, (x + BADGE_RADIUS, y - 8), verdict)
            x += 2.6 * BADGE_RADIUS
        lines = self.canvas.paragraph((x, y), text, 24, frame.right - x, self.palette.ink)
        assert lines <= y + 24 * LEADING + 1e-6, text  # one line

    def compare(self, left: Panel, right: Panel, *, same: bool) -> None:
        """Draw = or ≠ between two panels, beside the heading if one stands above the other."""
        if same:
            self.same.append((left, right))
        x = (left.stage.right + right.stage.x) / 2
        if left.stage.x == right.stage.x:
            x = left.stage.right - 2 * BADGE_RADIUS
        y = (left.stage.middle[1] + right.stage.middle[1]) / 2
        ring(self.canvas, (x, y), same=same)

    @property
    def told(self) -> Sequence[str]:
        """Return the title and the panels in lines of characters."""
        return [plain(self.title), *(one.told for one in self.panels if one.told)]

    @property
    def _soft(self) -> str:
        return self.palette.soft
