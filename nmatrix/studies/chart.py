"""The chart of a study: error against time, both as powers, legible without colour.

Each setting has its panel, on the same axes. A mark is a method, its number a line of the key;
marks close together share a label. A cross is a method that also gives wrong answers. Methods that
no other beats in both error and time, the front, are black and joined by steps.
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from nmatrix.enums import PixelFormat, VectorFormat
from nmatrix.studies.measurements import Measurement, Unit, by_setting

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SMALLEST = 1e-17  # where errors of zero, or below the resolution of float64, are drawn
EPSILONS = {"float64": 2.0**-53, "float32": 2.0**-24, "float16": 2.0**-11}
PIXELS_AN_INCH = 150
PANEL = (3.2, 2.6)  # inches
KEY, KEY_LINE = 2.3, 0.155
ACROSS = 3
LETTER, HIGH = 0.023, 0.06  # of the panel: the width of a digit, the height of a line
ROOM_OF_TEXT = 0.15  # labels that start closer to the right edge are written to the left
FRONT, BEATEN = "black", "0.55"


@dataclass(frozen=True)
class Numbered:
    """The rows of a study, and a number for each of their methods."""

    rows: Sequence[Measurement]

    @property
    def is_grouped(self) -> bool:
        """True where each setting has methods of its own, as the dials of a picture have."""
        return self.rows[0].unit is Unit.LEVELS

    def name(self, row: Measurement) -> tuple[str, str]:
        """Join the setting (empty unless grouped) and the method, which share one number."""
        return (row.setting if self.is_grouped else "", row.method)

    @cached_property
    def numbers(self) -> dict[tuple[str, str], int]:
        """The numbers, counted from 1."""
        names = dict.fromkeys(map(self.name, self.rows))
        return {name: i + 1 for i, name in enumerate(names)}

    @cached_property
    def key(self) -> list[str]:
        """The lines of the key."""
        lines, heading = [], ""
        for (setting, method), number in self.numbers.items():
            if setting != heading:
                lines.append(setting)
                heading = setting
            lines.append(f"{number:3}  {method}")
        lines.append("")
        if any(row.failures for row in self.rows):
            lines += ["  ●  always an answer", "  ×  wrong answers too"]
        return [*lines, "  black, joined: the front"]

    def label(self, rows: Sequence[Measurement]) -> str:
        """Write the numbers of marks that lie close together: 3, 5–7."""
        numbers = sorted(self.numbers[self.name(row)] for row in rows)
        runs: list[list[int]] = []
        for number in numbers:
            if runs and number == runs[-1][-1] + 1:
                runs[-1].append(number)
            else:
                runs.append([number])
        return ", ".join(f"{r[0]}–{r[-1]}" if len(r) > 2 else ", ".join(map(str, r)) for r in runs)


def chart(rows: Sequence[Measurement], title: str, kind: PixelFormat | VectorFormat) -> bytes:
    """Draw the chart and return its file; equal rows give equal bytes."""
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    numbered = Numbered(rows)
    settings = by_setting(rows)
    across = min(ACROSS, len(settings))
    down = -(-len(settings) // across)
    height = max(PANEL[1] * down, KEY_LINE * (len(numbered.key) + 3)) + 0.3
    with rc_context({"svg.hashsalt": "nmatrix", "font.size": 8}):
        figure = Figure(figsize=(PANEL[0] * across + KEY, height), layout="constrained")
        parts = figure.subfigures(1, 2, squeeze=False, width_ratios=(PANEL[0] * across, KEY))
        panels, side = parts[0]
        axes = panels.subplots(down, across, squeeze=False, sharex=True, sharey=True).ravel()
        for axis in axes:
            axis.margins(0.15)
        for axis, panel in zip(axes, settings.values(), strict=False):
            _marks(axis, panel)
        axes[0].autoscale_view()  # all share its scales, which labels are placed by
        for axis, panel in zip(axes, settings.values(), strict=False):
            _numbers(axis, numbered, panel)
        for axis in axes[len(settings) :]:
            axis.axis("off")
        panels.suptitle(title, fontsize=11)
        panels.supxlabel("counted work" if rows[0].timing is None else "time ratio")
        panels.supylabel(rows[0].unit)
        side.text(0.0, 0.97, "\n".join(numbered.key), va="top", family="monospace", fontsize=7.5)
        return _file(figure, title, kind)


def _file(figure: Figure, title: str, kind: PixelFormat | VectorFormat) -> bytes:
    """Return a figure's file, without the date that would make each one another."""
    out = io.BytesIO()
    if isinstance(kind, VectorFormat):
        date = "Date" if kind is VectorFormat.SVG else "CreationDate"
        figure.savefig(out, format=kind, metadata={"Title": title, date: None})
        return out.getvalue()
    from PIL import Image

    from nmatrix.raster.image import picture_file

    figure.savefig(out, format="png", dpi=PIXELS_AN_INCH)
    pixels = np.asarray(Image.open(out).convert("RGB"))
    return picture_file([pixels], {"Title": title}, kind)


def _marks(axis: Axes, rows: Sequence[Measurement]) -> None:
    _scales(axis, fine=rows[0].unit is not Unit.RADIANS)
    axis.set_title(rows[0].setting, fontsize=9)
    axis.tick_params(labelbottom=True)
    for row in sorted(rows, key=lambda row: row.on_front):
        axis.plot(
            *_at(row),
            "x" if row.failures else "o",
            color=FRONT if row.on_front else BEATEN,
            markersize=4,
        )
    front = [_at(row) for row in rows if row.on_front]
    if front:
        axis.step(*zip(*front, strict=True), where="post", color=FRONT, linewidth=0.8)
    if rows[0].unit is Unit.RADIANS:
        _epsilon_lines(axis)


def _numbers(axis: Axes, numbered: Numbered, rows: Sequence[Measurement]) -> None:
    """Write the numbers beside the marks: of the front below, to the left; of the others above."""
    front = [row for row in rows if row.on_front]
    beaten = [row for row in rows if not row.on_front]
    for group in _groups(axis, numbered, front):
        _write(axis, numbered.label(group), group[0], (-4, -9), "right", FRONT)
    for group in _groups(axis, numbered, beaten):
        is_far = _place(axis, group[-1])[0] > 1 - ROOM_OF_TEXT
        aside, side = (-4, "right") if is_far else (3, "left")
        _write(axis, numbered.label(group), group[-1], (aside, 4), side, BEATEN)


def _write(
    axis: Axes,
    text: str,
    at: Measurement,
    offset: tuple[int, int],
    side: str,
    shade: str,
) -> None:
    note = axis.annotate(
        text, _at(at), offset, textcoords="offset points", ha=side, fontsize=7, color=shade
    )
    note.set_in_layout(False)


def _groups(axis: Axes, numbered: Numbered, rows: Sequence[Measurement]) -> list[list[Measurement]]:
    """Group rows, sorted from left to right, whose labels would overlap."""
    groups: list[list[Measurement]] = []
    for row in rows:
        x, y = _place(axis, row)
        for group in groups:
            before_x, before_y = _place(axis, group[-1])
            width = LETTER * (len(numbered.label(group)) + 1)
            if abs(y - before_y) < HIGH and x - before_x < width:
                group.append(row)
                break
        else:
            groups.append([row])
    return groups


def _place(axis: Axes, row: Measurement) -> tuple[float, float]:
    """Locate a mark in fractions of the panel's width and height."""
    x, y = (axis.transScale + axis.transLimits).transform(_at(row))
    return float(x), float(y)


def _scales(axis: Axes, *, fine: bool) -> None:
    """Set logarithmic scales; fine ones have ticks at 1, 2 and 5 times powers of ten."""
    from matplotlib.ticker import LogLocator, NullLocator

    axis.set(xscale="log", yscale="log")
    for side in (axis.xaxis, axis.yaxis) if fine else ():
        side.set_major_locator(LogLocator(subs=(1, 2, 5)))
        side.set_minor_locator(NullLocator())
        side.set_major_formatter("{x:g}")


def _at(row: Measurement) -> tuple[float, float]:
    return row.price, max(row.error, SMALLEST)


def _epsilon_lines(axis: Axes) -> None:
    for name, epsilon in EPSILONS.items():
        axis.axhline(epsilon, color="0.7", linestyle=":", linewidth=0.7)
        axis.annotate(
            name,
            (0.99, epsilon),
            xycoords=("axes fraction", "data"),
            ha="right",
            fontsize=6,
            color="0.4",
        )
