"""The canvas, and the samples that a triangle covers: half-open spans, the top-left rule.

Corners are whole numbers of 1/256 sample, and sample (i, j) stands at 256·(i, j). Rows and columns
are half-open: an edge takes the first sample that is not before it. Neighbours share the edge,
hence its crossings: each sample belongs to exactly one of them.

Why floats decide exactly: an edge crosses row j at x = (x₀·h + (256 j − y₀)·r)/(256 h), for its run
r and its height h, so two different places are at least 1/(256 h) apart. Half of that is taken
off before rounding up. The guard band reaches 2¹⁵ samples to either side of the canvas's middle,
and no canvas is wider than 2¹⁶: so |x₀|, |y₀|, r, h ≤ 2²⁴, five roundings of numbers below 2⁴⁸/h
lose a quarter of 1/(256 h) at the most, and no ceiling can change.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from nmatrix.raster.triangles.run_expansion import RunExpansion, batches

Array = NDArray[Any]

SUBPIXELS = 256
MOST_ROWS = 1 << 18  # that are held at once, however tall the triangles


@dataclass(frozen=True)
class Canvas:
    """A picture's size in pixels, and samples along one side of a pixel.

    Examples
    --------
    >>> Canvas(640, 480, per_side=2).columns
    1280
    """

    width: int
    height: int
    per_side: int = 1

    @property
    def columns(self) -> int:
        """Return the samples in a row."""
        return self.width * self.per_side

    @property
    def rows(self) -> int:
        """Return the samples in a column."""
        return self.height * self.per_side


class Spans(NamedTuple):
    """Covered samples row by row: the triangle, its row, the first column, how many."""

    triangle: Array
    row: Array
    first: Array
    length: Array


class Edge(NamedTuple):
    """The column where an edge crosses a row, `start + slope · row`, half a spacing to the left."""

    start: Array
    slope: Array


def spans(x: Array, y: Array, rows: tuple[int, int], columns: int) -> Iterator[Spans]:
    """Yield the spans of rows [first, last) that triangles (3, N) of either winding cover.

    Examples
    --------
    >>> x, y = np.array([[0.0], [512], [0]]), np.array([[0.0], [0], [512]])
    >>> for one in spans(x, y, (0, 4), 4):
    ...     print(one.row.tolist(), one.first.tolist(), one.length.tolist())
    [0.0, 1.0] [0.0, 0.0] [2, 1]
    """
    (xa, ya), (xb, yb), (xc, yc) = _downwards(x, y)
    top, middle, bottom = (_first_sample(level, rows) for level in (ya, yb, yc))
    long = _edge(xa, ya, xc, yc)
    upper, lower = _edge(xa, ya, xb, yb), _edge(xb, yb, xc, yc)
    for short, first, last in ((upper, top, middle), (lower, middle, bottom)):
        half = np.flatnonzero(last > first)
        count = (last.take(half) - first.take(half)).astype(np.intp)
        for part in batches(count, MOST_ROWS):
            yield from _rows(half[part], first, count[part], (long, short), columns)


def _rows(
    half: Array, first: Array, count: Array, edges: tuple[Edge, Edge], columns: int
) -> Iterator[Spans]:
    expansion = RunExpansion(count)
    triangle = expansion.each(half)
    row = expansion.counted(first.take(half).astype(np.intp)).astype(float)
    crossed = [e.slope.take(triangle) * row + e.start.take(triangle) for e in edges]
    left = np.maximum(np.ceil(np.minimum(*crossed)), 0.0)
    right = np.minimum(np.ceil(np.maximum(*crossed)), columns)
    seen = np.flatnonzero(right > left)
    if len(seen):
        triangle, row, left, right = (one.take(seen) for one in (triangle, row, left, right))
        yield Spans(triangle, row, left, (right - left).astype(np.intp))


def _downwards(x: Array, y: Array) -> list[tuple[Array, Array]]:
    """Return the three corners sorted by y."""
    corners = [(x[i], y[i]) for i in range(3)]
    for i, j in ((0, 1), (1, 2), (0, 1)):
        (xi, yi), (xj, yj) = corners[i], corners[j]
        swap = yi > yj
        corners[i] = np.where(swap, xj, xi), np.minimum(yi, yj)
        corners[j] = np.where(swap, xi, xj), np.maximum(yi, yj)
    return corners


def _first_sample(y: Array, rows: tuple[int, int]) -> Array:
    """Return the first row that is not above a height."""
    return np.asarray(np.clip(np.ceil(y / SUBPIXELS), *rows))


def _edge(x0: Array, y0: Array, x1: Array, y1: Array) -> Edge:
    height = np.maximum(y1 - y0, 1.0)  # a level edge crosses no row; 1 keeps division quiet
    slope = (x1 - x0) / height
    return Edge((x0 - y0 * slope - 0.5 / height) / SUBPIXELS, slope)
