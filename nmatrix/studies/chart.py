"""The chart of a study: error against time, both as powers, legible without colour.

Each setting has its panel, on the same axes. A mark is a method, its number a line of the key; a
cross is one that also gives wrong answers. What nobody beats in both is black, joined by steps.
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from nmatrix.studies.rows import Row

if TYPE_CHECKING:
    from matplotlib.axes import Axes

SMALLEST = 1e-17  # where an error of zero, or below all that a float64 can say, is drawn
EPSILONS = {"float64": 2.0**-53, "float32": 2.0**-24, "float16": 2.0**-11}
PANEL = (3.2, 2.6)  # inches
KEY, KEY_LINE = 2.3, 0.155
ACROSS = 3
FRONT, BEATEN = "black", "0.55"
PICTURES = "levels"  # the unit of studies in which each setting has methods of its own


@dataclass(frozen=True)
class Numbered:
    """The rows of a study, and the number that stands for each of their methods."""

    rows: Sequence[Row]

    @cached_property
    def settings(self) -> list[str]:
        """Return the panels."""
        return list(dict.fromkeys(row.setting for row in self.rows))

    @property
    def is_grouped(self) -> bool:
        """Return whether each setting has methods of its own."""
        return self.rows[0].unit == PICTURES

    def name(self, row: Row) -> tuple[str, str]:
        """Return what one number stands for."""
        return (row.setting if self.is_grouped else "", row.method)

    @cached_property
    def numbers(self) -> dict[tuple[str, str], int]:
        """Return the numbers, counted from 1."""
        names = dict.fromkeys(map(self.name, self.rows))
        return {name: i + 1 for i, name in enumerate(names)}

    @cached_property
    def key(self) -> list[str]:
        """Return the lines of the key."""
        lines, heading = [], ""
        for (setting, method), number in self.numbers.items():
            if setting != heading:
                lines.append(setting)
                heading = setting
            lines.append(f"{number:3}  {method}")
        lines += ["", "  ●  always an answer"]
        if any(row.failures for row in self.rows):
            lines.append("  ×  wrong answers too")
        return [*lines, "  black, joined: the front"]


def chart(rows: Sequence[Row], title: str, kind: str) -> bytes:
    """Return the chart as `svg` or `png`; the same rows give the same bytes."""
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    numbered = Numbered(rows)
    settings = numbered.settings
    across = min(ACROSS, len(settings))
    down = -(-len(settings) // across)
    height = max(PANEL[1] * down, KEY_LINE * (len(numbered.key) + 3)) + 0.3
    with rc_context({"svg.hashsalt": "nmatrix", "font.size": 8}):
        figure = Figure(figsize=(PANEL[0] * across + KEY, height), layout="constrained")
        parts = figure.subfigures(1, 2, squeeze=False, width_ratios=(PANEL[0] * across, KEY))
        panels, side = parts[0]
        axes = panels.subplots(down, across, squeeze=False, sharex=True, sharey=True).ravel()
        for axis, setting in zip(axes, settings, strict=False):
            _panel(axis, numbered, setting)
        for axis in axes[len(settings) :]:
            axis.axis("off")
        panels.suptitle(title, fontsize=11)
        panels.supxlabel("time ratio")
        panels.supylabel(rows[0].unit)
        side.text(0.0, 0.97, "\n".join(numbered.key), va="top", family="monospace", fontsize=7.5)
        out = io.BytesIO()
        undated = {"Date": None} if kind == "svg" else None
        figure.savefig(out, format=kind, dpi=150, metadata=undated)
    return out.getvalue()


def _panel(axis: Axes, numbered: Numbered, setting: str) -> None:
    rows = [row for row in numbered.rows if row.setting == setting]
    _scales(axis, fine=rows[0].unit != "rad")
    axis.set_title(setting, fontsize=9)
    axis.tick_params(labelbottom=True)
    for row in rows:
        at = (row.timing.ratio, _height(row))
        shade = FRONT if row.on_front else BEATEN
        axis.plot(*at, "x" if row.failures else "o", color=shade, markersize=4)
        number = str(numbered.numbers[numbered.name(row)])
        axis.annotate(number, at, (3, 3), textcoords="offset points", fontsize=7, color=shade)
    front = sorted((row.timing.ratio, _height(row)) for row in rows if row.on_front)
    if front:
        axis.step(*zip(*front, strict=True), where="post", color=FRONT, linewidth=0.8)
    if rows[0].unit == "rad":
        _epsilon_lines(axis)


def _scales(axis: Axes, *, fine: bool) -> None:
    """Take powers of ten, or of two where everything lies close together."""
    if fine:
        axis.set_xscale("log", base=2)
        axis.set_yscale("log", base=2)
        axis.xaxis.set_major_formatter("{x:g}")
        axis.yaxis.set_major_formatter("{x:g}")
    else:
        axis.set(xscale="log", yscale="log")
    axis.margins(0.1)


def _height(row: Row) -> float:
    return max(row.error or SMALLEST, SMALLEST)


def _epsilon_lines(axis: Axes) -> None:
    for name, epsilon in EPSILONS.items():
        axis.axhline(epsilon, color="0.7", linestyle=":", linewidth=0.7)
        axis.annotate(
            name, (0.01, epsilon), xycoords=("axes fraction", "data"), fontsize=6, color="0.4"
        )
