"""Visibility: at every sample the least of the integer keys of depth and triangle.

The minimum does not care about order, so any order of triangles gives the same picture. Where two
lie at the very same depth, the one that was named first is seen.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from nmatrix.raster.triangles.run_expansion import RunExpansion, batches
from nmatrix.raster.triangles.spans import SUBPIXELS, Spans, spans
from nmatrix.raster.triangles.vertices import Corners, Projected
from nmatrix.scene.words import DepthBuffer

Array = NDArray[Any]
Kept = Callable[[Array, Array, Array], Array]  # of triangles, rows and columns; False for holes

TRIANGLE_BITS = 24
TRIANGLES = 1 << TRIANGLE_BITS
TRIANGLE_MASK = TRIANGLES - 1
NOTHING = TRIANGLE_MASK  # the name where no triangle is
EMPTY = np.iinfo(np.int64).max
CHUNK = 1 << 14  # triangles that are set up together: their arrays stay in the cache
MOST_FRAGMENTS = 1 << 16  # that are held at once, however large the triangles
# The largest code of a buffer. One of floats stores bits: those of 1.0 are the largest.
STEPS = {
    DepthBuffer.UNORM16: (1 << 16) - 1,
    DepthBuffer.UNORM24: (1 << 24) - 1,
    DepthBuffer.FLOAT32: 0x3F800000,
    DepthBuffer.FULL: 1 << 38,
}


@dataclass(frozen=True, eq=False)
class Tile:
    """Some rows of the canvas: the key of what is in front at each sample, or `EMPTY`."""

    keys: Array
    rows: tuple[int, int]
    columns: int
    depth: DepthBuffer = DepthBuffer.FULL

    @classmethod
    def empty(cls, rows: tuple[int, int], columns: int, depth: DepthBuffer) -> Tile:
        """Return a tile in which nothing is seen yet."""
        keys = np.full((rows[1] - rows[0]) * columns, EMPTY, np.int64)
        return cls(keys, rows, columns, depth)

    def part(self, rows: tuple[int, int]) -> Tile:
        """Return some rows of the tile, on the same memory."""
        first, last = ((row - self.rows[0]) * self.columns for row in rows)
        return Tile(self.keys[first:last], rows, self.columns, self.depth)

    def names(self, rows: tuple[int, int], columns: tuple[int, int]) -> Array:
        """Return the triangle that is seen at each sample of a window, or `NOTHING`."""
        keys = self.part(rows).keys.reshape(-1, self.columns)[:, slice(*columns)]
        names = keys.astype(np.int32)  # the lower half of each
        names &= TRIANGLE_MASK
        return names

    def add(self, projected: Projected, first: int, kept: Kept | None = None) -> int:
        """Draw triangles, numbered from `first` on, and return how many samples they cover."""
        covered = 0
        for place, keys in self.fragments(projected, first):
            index, key = place, keys
            if kept is not None:
                row, column = np.divmod(place, self.columns)
                names = (keys & TRIANGLE_MASK).astype(np.intp) - first
                solid = kept(names, row + self.rows[0], column)
                index, key = place[solid], keys[solid]
            np.minimum.at(self.keys, index, key)
            covered += len(index)
        return covered

    def fragments(self, projected: Projected, first: int) -> Iterator[tuple[Array, Array]]:
        """Return the place in the tile, and the key, of every sample that triangles cover."""
        for chunk in projected.chunks(CHUNK, self.rows):
            plane, names = Plane.through(chunk), chunk.triangle + first
            for found in spans(chunk.x, chunk.y, self.rows, self.columns):
                for part in batches(found.length, MOST_FRAGMENTS):
                    some = Spans(*(one[part] for one in found))
                    yield self._along(some, plane, names, is_reversed=projected.is_reversed)

    def _along(
        self, found: Spans, plane: Plane, names: Array, *, is_reversed: bool
    ) -> tuple[Array, Array]:
        """Return place and key of every sample of some spans."""
        expansion = RunExpansion(found.length)
        place = ((found.row - self.rows[0]) * self.columns + found.first).astype(np.intp)
        key = depth_code(expansion.ramps(*plane.along(found))[0], self.depth)
        if is_reversed:
            np.subtract(STEPS[self.depth], key, out=key)
        key <<= TRIANGLE_BITS
        key |= expansion.each(names.take(found.triangle))
        return expansion.counted(place), key


class Runs(NamedTuple):
    """Visible samples row by row: triangle, row and first column on the canvas, how many."""

    triangle: Array
    row: Array
    first: Array
    length: Array

    def of(self, first: int, last: int) -> Runs:
        """Return the runs of triangles first ≤ t < last, numbered from 0."""
        mine = (self.triangle >= first) & (self.triangle < last)
        if not first and mine.all():
            return self
        found = self.some(mine)
        return found._replace(triangle=found.triangle - first)

    def by_owner(self, first: Sequence[int]) -> Iterator[tuple[int, Runs]]:
        """Yield the runs of each owner of triangles first[i] ≤ t < first[i + 1] that has any.

        Its triangles are numbered from 0 then, and its runs stay in their order.
        """
        if len(first) == 2 and len(self.triangle):
            yield 0, self
            return
        owner = np.searchsorted(first, self.triangle, "right") - 1
        order = np.argsort(owner, kind="stable")
        sorted_runs, owner = Runs(*(one.take(order) for one in self)), owner.take(order)
        ends = [*(np.flatnonzero(np.diff(owner)) + 1).tolist(), len(owner)]
        for begin, end in pairwise([0, *ends]) if len(owner) else ():
            i = int(owner[begin])
            mine = Runs(*(one[begin:end] for one in sorted_runs))
            yield i, mine._replace(triangle=mine.triangle - first[i])

    def some(self, which: Array) -> Runs:
        """Return the runs of a mask."""
        if which.all():
            return self
        kept = np.flatnonzero(which)
        return Runs(*(one.take(kept) for one in self))

    def finer(self, k: int) -> Runs:
        """Return the same runs of pixels as runs of their k × k samples."""
        triangle, row, first, length = (one.repeat(k) for one in self)
        row *= k
        row += np.tile(np.arange(k), len(self.row))
        return Runs(triangle, row, first * k, length * k)


def runs_of(names: Array, top: int, left: int) -> Runs:
    """Return the runs of one triangle in rows of names (rows, columns) from (top, left) on.

    Examples
    --------
    >>> runs = runs_of(np.array([[7, 7], [9, NOTHING]]), 0, 0)
    >>> list(zip(runs.triangle.tolist(), runs.row.tolist(), runs.length.tolist()))
    [(7, 0, 2), (9, 1, 1)]
    """
    columns = names.shape[1]
    starts = np.ones(names.shape, bool)
    np.not_equal(names[:, 1:], names[:, :-1], out=starts[:, 1:])
    start = np.flatnonzero(starts)
    end = np.append(start[1:], names.size)
    triangle = names.ravel().take(start).astype(np.intp)
    seen = np.flatnonzero(triangle != NOTHING)
    start = start.take(seen)
    row = start // columns
    first = start - row * columns + left
    return Runs(triangle.take(seen), row + top, first, end.take(seen) - start)


class Plane(NamedTuple):
    """Depth over the canvas, for each triangle: at its first corner, and per sample from there."""

    x: Array
    y: Array
    depth: Array
    right: Array
    down: Array

    @classmethod
    def through(cls, corners: Corners) -> Plane:
        """Return the planes through triangles with area; depth is linear on the screen."""
        x, y, z, _ = corners
        ax, ay, bx, by = x[1] - x[0], y[1] - y[0], x[2] - x[0], y[2] - y[0]
        scale = SUBPIXELS / (ax * by - bx * ay)
        az, bz = z[1] - z[0], z[2] - z[0]
        right, down = (az * by - bz * ay) * scale, (bz * ax - az * bx) * scale
        return cls(x[0] / SUBPIXELS, y[0] / SUBPIXELS, z[0], right, down)

    def along(self, found: Spans) -> tuple[Array, Array]:
        """Return the depth (1, spans) where each span begins, and its growth along it."""
        x, y, depth, right, down = (one.take(found.triangle) for one in self)
        depth += right * (found.first - x)
        depth += down * (found.row - y)
        return depth[None], right[None]


def depth_code(z: Array, buffer: DepthBuffer) -> Array:
    """Return depths, 0 in front and 1 behind, as integers that a buffer tells apart.

    A buffer of floats stores the bits themselves: between 0 and 1 their order is that of the
    numbers. Reversed depth, 1 in front, is counted down from its largest code.

    Examples
    --------
    >>> depth_code(np.array([0.0, 1.0]), DepthBuffer.UNORM16).tolist()
    [0, 65535]
    """
    if buffer is DepthBuffer.FULL:
        return np.asarray((z * float(STEPS[buffer])).astype(np.int64))
    if buffer is DepthBuffer.FLOAT32:
        return np.asarray(np.maximum(z, 0.0).astype(np.float32).view(np.int32).astype(np.int64))
    return np.asarray(np.rint(z * STEPS[buffer]).astype(np.int64))
