"""The chart of a study: error against time, both as powers, legible without colour.

Each setting has its panel, on the same axes. A mark is a method, its number a line of the key;
marks in a crowd share a label. A cross is a method that also gives wrong answers. What nobody
beats in both is black, joined by steps.
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
LETTER, HIGH = 0.023, 0.06  # of the panel: the width of a digit, the height of a line
ROOM_OF_TEXT = 0.15  # labels that start closer to the right edge are written to the left
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

    def of(self, setting: str) -> list[Row]:
        """Return the rows of a panel, the fastest first."""
        found = [row for row in self.rows if row.setting == setting]
        return sorted(found, key=lambda row: row.timing.ratio)

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
        lines.append("")
        if any(row.failures for row in self.rows):
            lines += ["  ●  always an answer", "  ×  wrong answers too"]
        return [*lines, "  black, joined: the front"]

    def label(self, rows: Sequence[Row]) -> str:
        """Return the numbers of marks that lie close together: 3, 5–7."""
        numbers = sorted(self.numbers[self.name(row)] for row in rows)
        runs: list[list[int]] = []
        for number in numbers:
            if runs and number == runs[-1][-1] + 1:
                runs[-1].append(number)
            else:
                runs.append([number])
        return ", ".join(f"{r[0]}–{r[-1]}" if len(r) > 2 else ", ".join(map(str, r)) for r in runs)


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
        for axis in axes:
            axis.margins(0.15)
        for axis, setting in zip(axes, settings, strict=False):
            _marks(axis, numbered.of(setting))
        axes[0].autoscale_view()  # all share its scales, and numbers need to know who is close
        for axis, setting in zip(axes, settings, strict=False):
            _numbers(axis, numbered, numbered.of(setting))
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


def _marks(axis: Axes, rows: Sequence[Row]) -> None:
    _scales(axis, fine=rows[0].unit != "rad")
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
    if rows[0].unit == "rad":
        _epsilon_lines(axis)


def _numbers(axis: Axes, numbered: Numbered, rows: Sequence[Row]) -> None:
    """Write the numbers beside the marks: of the front below to the left, of others above."""
    front, beaten = ([row for row in rows if row.on_front is which] for which in (True, False))
    for group in _groups(axis, numbered, front):
        _write(axis, numbered.label(group), group[0], (-4, -9), "right", FRONT)
    for group in _groups(axis, numbered, beaten):
        is_far = _place(axis, group[-1])[0] > 1 - ROOM_OF_TEXT
        aside, side = (-4, "right") if is_far else (3, "left")
        _write(axis, numbered.label(group), group[-1], (aside, 4), side, BEATEN)


def _write(
    axis: Axes,
    text: str,
    at: Row,
    offset: tuple[int, int],
    side: str,
    shade: str,
) -> None:
    note = axis.annotate(
        text, _at(at), offset, textcoords="offset points", ha=side, fontsize=7, color=shade
    )
    note.set_in_layout(False)


def _groups(axis: Axes, numbered: Numbered, rows: Sequence[Row]) -> list[list[Row]]:
    """Return rows, from left to right, by the label that they share: so close that theirs meet."""
    groups: list[list[Row]] = []
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


def _place(axis: Axes, row: Row) -> tuple[float, float]:
    """Return where a mark is, as fractions of the panel."""
    x, y = (axis.transScale + axis.transLimits).transform(_at(row))
    return float(x), float(y)


def _scales(axis: Axes, *, fine: bool) -> None:
    """Take powers of ten, and what lies between them where everything is close together."""
    from matplotlib.ticker import LogLocator, NullLocator

    axis.set(xscale="log", yscale="log")
    for side in (axis.xaxis, axis.yaxis) if fine else ():
        side.set_major_locator(LogLocator(subs=(1, 2, 5)))
        side.set_minor_locator(NullLocator())
        side.set_major_formatter("{x:g}")


def _at(row: Row) -> tuple[float, float]:
    return row.timing.ratio, _height(row)


def _height(row: Row) -> float:
    return max(row.error or SMALLEST, SMALLEST)


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
