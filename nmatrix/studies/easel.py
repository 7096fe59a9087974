"""What charts of studies are drawn with: logarithmic scales, the marks of roles, and their key.

A role is told by its shape and by its colour: what others are measured against is a diamond, the
front a dot, what is beaten a ring, and what is seen to be wrong a cross.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from math import ceil, floor, log10

from nmatrix.canvas.glyphs import blend, disc
from nmatrix.canvas.marks import Box, Point
from nmatrix.canvas.slide import Slide
from nmatrix.canvas.text import LEADING, width
from nmatrix.studies.measurements import Study, Unit
from nmatrix.studies.summary import ROUNDED, Measure, Role, Standing, Summary

NAME, BEATEN_NAME, WORDS, KEY = 25, 22, 24, 22  # text sizes
DOT, RING, CROSS, DIAMOND = 11.0, 9.0, 10.0, 17.0  # radii of the marks
DASHES = (7.0, 5.0)  # of the cross through the reference
DOTS = (3.0, 6.0)  # of the lines down to the easiest setting
STAGE_AT, BELOW, KEY_AT = 146.0, 184.0, 34.0  # units from the top, and from the bottom
MOST_TICKS = 9
SPELLED = {-1: "½", -2: "¼"}  # powers of two that the font has a letter for


@dataclass(frozen=True)
class Scale:
    """A logarithmic scale: the values at the start and at the end of a side."""

    low: float
    high: float
    start: float
    end: float

    def at(self, value: float) -> float:
        """Locate a value; one beyond an end stands at that end.

        Examples
        --------
        >>> Scale(1, 100, 0, 50).at(10), Scale(1, 100, 0, 50).at(0)
        (25.0, 0.0)
        """
        inside = min(max(value, self.low), self.high)
        part = log10(inside / self.low) / log10(self.high / self.low)
        return self.start + part * (self.end - self.start)

    def exponents(self, base: float) -> range:
        """Choose powers of a base for ticks: all between the ends, or every other, or fewer.

        Examples
        --------
        >>> list(Scale(0.2, 9, 0, 1).exponents(2))
        [-2, -1, 0, 1, 2, 3]
        """
        first = ceil(log10(self.low) / log10(base) - 1e-9)
        last = floor(log10(self.high) / log10(base) + 1e-9)
        step = 1
        while (last - first) // step >= MOST_TICKS:
            step *= 2
        return range(-(-first // step) * step, last + 1, step)


class Easel:
    """A slide with what is to be drawn on it."""

    def __init__(self, slide: Slide, summary: Summary, shown: Sequence[Standing]) -> None:
        self.canvas, self.palette, self.frame = slide.canvas, slide.palette, slide.frame
        self.summary, self.shown = summary, shown
        self.is_told = summary.measure is Measure.TIME
        self.colours = {
            Role.REFERENCE: self.palette.ink,
            Role.FRONT: self.palette.right,
            Role.BEATEN: self.palette.soft,
            Role.WRONG: self.palette.wrong,
        }

    def role(self, one: Standing) -> Role:
        """Look up what a contestant is beside the others."""
        return self.summary.roles[one.name]

    def ends(self, one: Standing) -> tuple[float, float]:
        """Where a price begins and ends: one number, or the spread of a time that is not told."""
        if self.is_told or one.spread is None:
            return one.price, one.price
        return one.spread

    @property
    def axis_of_prices(self) -> str:
        """What prices are multiples of."""
        is_counted = not self.is_told and self.summary.reference.spread is None
        measure = self.summary.measure if is_counted else Measure.TIME
        return f"{measure}, as a multiple of {self.summary.reference.spoken}"

    @cached_property
    def rule(self) -> str:
        """The colour of the grid: paper, unless the stage is paper as well."""
        is_bare = self.palette.stage == self.palette.paper
        return blend((self.palette.paper, self.palette.rule), 0.6 if is_bare else 0.0)

    def stage(self, left: float, right: float) -> Box:
        """Lay the stage, which keeps so much free at its sides."""
        frame = self.frame
        wide, high = frame.width - left - right, frame.height - STAGE_AT - BELOW
        found = self.canvas.on_pixels(Box(frame.x + left, frame.y + STAGE_AT, wide, high))
        is_bare = self.palette.stage == self.palette.paper
        edge = self.palette.rule if is_bare else self.palette.stage
        self.canvas.polygon(found.corners, fill=self.palette.stage, edge=edge, width=2.0)
        return found

    def over(self, words: str, align: float) -> None:
        """Write what an axis is of above the stage, at its left or right end."""
        x = self.frame.x + align * self.frame.width
        self.canvas.text((x, self.frame.y + STAGE_AT - 20), words, WORDS, align=align)

    def axis_below(self, scale: Scale, stage: Box, base: int, words: str) -> None:
        """Draw the grid of a scale of powers of 2 or 10, with its numbers below the stage."""
        for k in scale.exponents(base):
            x, number = scale.at(float(base) ** k), f"{_half(k)}×" if base == 2 else power(k)
            self.canvas.stroke(((x, stage.y), (x, stage.bottom)), 2.0, self.rule)
            below = x, stage.bottom + 33
            self.canvas.text(below, number, WORDS, self.palette.soft, align=0.5)
        self.canvas.text((stage.middle[0], stage.bottom + 74), words, WORDS, align=0.5)

    def mark(self, place: Point, role: Role) -> None:
        """Draw the mark of a role, edged in paper."""
        (x, y), colour, paper = place, self.colours[role], self.palette.paper
        match role:
            case Role.REFERENCE:
                r = DIAMOND
                diamond = ((x, y - r), (x + r, y), (x, y + r), (x - r, y))
                self.canvas.polygon(diamond, fill=colour, edge=paper, width=2.0)
            case Role.FRONT:
                disc(self.canvas, place, DOT + 2, paper)
                disc(self.canvas, place, DOT, colour)
            case Role.BEATEN:
                disc(self.canvas, place, RING + 2, paper)
                disc(self.canvas, place, RING, colour)
                disc(self.canvas, place, RING - 3.4, paper)
            case Role.WRONG:
                for wide, ink in ((9.0, paper), (5.2, colour)):
                    for down in (CROSS, -CROSS):
                        ends = ((x - CROSS, y - down), (x + CROSS, y + down))
                        self.canvas.stroke(ends, wide, ink)

    def bar(self, one: Standing, scale: Scale, y: float) -> Box | None:
        """Draw the spread of a time that is not told, between two caps; return its box."""
        if one.is_reference or self.is_told or one.spread is None:
            return None
        left, right = (scale.at(end) for end in one.spread)
        colour = self.colours[self.role(one)]
        for ends in (((left, y), (right, y)), *(((x, y - 9), (x, y + 9)) for x in (left, right))):
            self.canvas.stroke(ends, 3.6, colour, round_ends=False)
        return Box(left - 2, y - 9, right - left + 4, 18)

    def key(self, *, has_lines_down: bool) -> None:
        """Explain the marks that are there, in one line."""
        cheaper = "faster" if self.is_told else "with less work"
        words = {
            Role.FRONT: f"nothing {cheaper} is as exact",
            Role.BEATEN: f"something {cheaper} is" if self.is_told else "something is",
        }
        if self._is_rounding_beaten:
            words[Role.FRONT] += f" (to {power(round(log10(ROUNDED[Unit.RADIANS])))})"
        if self.summary.study is Study.SPACES:
            words = {Role.FRONT: f"the least {self.summary.measure.noun}", Role.BEATEN: "more"}
        present = {self.role(one) for one in self.shown}
        x, y = self.frame.x + 12, self.frame.bottom - KEY_AT
        for role in (role for role in words if role in present):
            self.mark((x, y - 8), role)
            x = self._key_word(x, y, words[role])
        if has_lines_down:
            self.canvas.stroke(((x, y - 22), (x, y)), 2.6, self.palette.soft, dash=DOTS)
            self.canvas.stroke(((x - 7, y), (x + 7, y)), 2.6, self.palette.soft)
            self._key_word(x, y, "down to its easiest matrices")

    @property
    def _is_rounding_beaten(self) -> bool:
        """Whether something beaten is more exact than the front, which is as exact as need be."""
        of = {
            role: [one.worst for one in self.shown if self.role(one) is role]
            for role in (Role.FRONT, Role.BEATEN)
        }
        is_angle = self.shown[0].unit is Unit.RADIANS
        return is_angle and all(of.values()) and min(of[Role.BEATEN]) < min(of[Role.FRONT])

    def about(self, words: str, on_a_busy_machine: str) -> None:
        """Write what was measured, and above it that times cannot be trusted, if they cannot."""
        place = self.frame.right, self.frame.bottom - KEY_AT
        self.canvas.text(place, words, KEY, self.palette.soft, align=1.0)
        if not self.is_told and self.summary.reference.spread is not None:
            above = place[0], place[1] - LEADING * KEY
            self.canvas.text(above, on_a_busy_machine, KEY, self.palette.soft, align=1.0)

    def _key_word(self, x: float, y: float, words: str) -> float:
        """Write a word of the key; return where the next one begins."""
        self.canvas.text((x + 22, y), words, KEY, self.palette.soft)
        return x + 22 + width(words, KEY) + 40


def power(k: int) -> str:
    """Write a power of ten in the mark-up of pictures."""
    return {-1: "0.1", 0: "1", 1: "10", 2: "100"}.get(k, f"10^{{{str(k).replace('-', '−')}}}")


def _half(k: int) -> str:
    return SPELLED.get(k) or (f"1/{2**-k}" if k < 0 else str(2**k))
