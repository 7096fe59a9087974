"""Which samples a triangle covers, decided on integers: the top-left rule by half-open spans.

Corners are snapped to 1/256 of a pixel. In each row of sample centres an edge crosses at a
rational x; its ceiling, by integer division, is the first sample on its right. Neighbours share
the edge, hence the number: each sample belongs to exactly one of them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]

SUBPIXELS = 256
CENTRE = SUBPIXELS // 2


@dataclass(frozen=True, eq=False)
class Samples:
    """Covered samples: pixel coordinates and the triangle that covers each."""

    x: Array
    y: Array
    triangle: Array


def snap(pixels: Array) -> Array:
    """Return positions in pixels as integers in 1/256 pixel."""
    return np.asarray(np.rint(pixels * SUBPIXELS).astype(np.int64))


def signed_areas(points: Array) -> Array:
    """Return twice the signed area of snapped triangles (N, 3, 2), exactly."""
    a, b = points[:, 1] - points[:, 0], points[:, 2] - points[:, 0]
    return np.asarray(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])


def cover(points: Array, width: int, height: int) -> Samples:
    """Return every sample that the snapped triangles (N, 3, 2) cover, in either winding.

    Examples
    --------
    >>> square = snap(np.array([[[0, 0], [2, 0], [2, 2]], [[0, 0], [2, 2], [0, 2.0]]]))
    >>> found = cover(square, 4, 4)
    >>> sorted(zip(found.x.tolist(), found.y.tolist()))
    [(0, 0), (0, 1), (1, 0), (1, 1)]
    """
    order = np.argsort(points[:, :, 1], axis=1, kind="stable")
    sorted_points = np.take_along_axis(points, order[:, :, None], 1)
    first = np.clip(_ceiling(sorted_points[:, 0, 1]), 0, height)
    last = np.clip(_ceiling(sorted_points[:, 2, 1]), 0, height)
    triangle, y = _ranges(first, last)
    top, middle, bottom = (sorted_points[triangle, i] for i in range(3))
    centre = y * SUBPIXELS + CENTRE
    upper = (centre < middle[:, 1])[:, None]
    long_edge = _crossing(top, bottom, centre)
    short_edge = _crossing(np.where(upper, top, middle), np.where(upper, middle, bottom), centre)
    left = np.clip(np.minimum(long_edge, short_edge), 0, width)
    right = np.clip(np.maximum(long_edge, short_edge), 0, width)
    row, x = _ranges(left, right)
    return Samples(x, y[row], triangle[row])


def _ceiling(subpixels: Array) -> Array:
    """Return the first sample whose centre is not before a position."""
    return np.asarray(-((CENTRE - subpixels) // SUBPIXELS))


def _crossing(start: Array, end: Array, centre: Array) -> Array:
    """Return the first sample on the right of an edge in the row through `centre`."""
    run, rise = end[:, 0] - start[:, 0], end[:, 1] - start[:, 1]
    rise = np.maximum(rise, 1)  # rows never cross a horizontal edge
    # ⌈(x₀ + run·(y − y₀)/rise − ½) / 256⌉, with everything over the one denominator
    top = (start[:, 0] - CENTRE) * rise + run * (centre - start[:, 1])
    return np.asarray(-(-top // (rise * SUBPIXELS)))


def _ranges(first: Array, last: Array) -> tuple[Array, Array]:
    """Return the owner and the value of every integer in the half-open ranges."""
    count = np.maximum(last - first, 0)
    owner = np.repeat(np.arange(len(count)), count)
    starts = np.cumsum(count) - count
    return owner, first[owner] + np.arange(len(owner)) - starts[owner]
