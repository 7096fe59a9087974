"""From triangles to a picture: tiles for visibility, stripes for colour, samples to pixels.

A tile is as many rows as its keys may take memory; a stripe as many as stay in the cache while they
are coloured. Neither changes a bit of the picture.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from nmatrix.errors import IllegalValueError
from nmatrix.raster.triangles.fragments import Fragments, Grid, VertexOutputs, interpolate
from nmatrix.raster.triangles.layers import Layers, layers
from nmatrix.raster.triangles.run_expansion import batches
from nmatrix.raster.triangles.spans import Canvas
from nmatrix.raster.triangles.vertices import Projected
from nmatrix.raster.triangles.visibility import (
    EMPTY,
    NOTHING,
    STEPS,
    TRIANGLE_BITS,
    TRIANGLE_MASK,
    Kept,
    Runs,
    Tile,
    runs_of,
)
from nmatrix.scene.words import DepthBuffer

Array = NDArray[Any]

TILE_SAMPLES = 1 << 22
STRIPE_SAMPLES = 1 << 16
MOST_SHADED = 1 << 16  # samples that are shaded together: their arrays stay in the cache
BOTH_NOTHING = np.int64(NOTHING << 32 | NOTHING)
LARGEST_KEPT = 12 << 20  # bytes: the keys of a picture of 1024 × 1024


@dataclass(frozen=True, eq=False)
class Drawable:
    """Projected triangles, the outputs of their vertices, and their fragment shader.

    Opaque ones hide what is behind, but for samples that are not `kept`; those with an `opacity`
    let 1 − it through. `even` is a mask (F,) of triangles whose colour at a pixel's middle may
    stand for that of all its samples.
    """

    projected: Projected
    outputs: VertexOutputs
    fragment: Callable[[Fragments], Array]
    opacity: Callable[[Fragments], Array] | None = None
    kept: Kept | None = None
    even: Array | None = None


@dataclass(frozen=True, eq=False)
class DepthMap:
    """How far away opaque surfaces are, and what they cover, for each pixel (height, width).

    `farthest` is that of a pixel's samples, 0 near and 1 far, infinite where one of them is empty;
    `coverage` is the part of its samples that is not.
    """

    farthest: Array
    coverage: Array

    @classmethod
    def empty(cls, canvas: Canvas) -> DepthMap:
        """Return the map of a picture in which nothing is seen."""
        shape = canvas.height, canvas.width
        return cls(np.full(shape, np.inf), np.zeros(shape))

    def take(self, tile: Tile, canvas: Canvas) -> None:
        """Write the rows of a finished tile."""
        k, (top, bottom) = canvas.per_side, tile.rows
        keys = tile.keys.reshape((bottom - top) // k, k, canvas.width, k)
        filled, codes = keys != EMPTY, keys.max(axis=(1, 3)) >> TRIANGLE_BITS
        rows = slice(top // k, bottom // k)
        if tile.depth is DepthBuffer.FLOAT32:
            far = codes.astype(np.int32).view(np.float32).astype(float)
        else:
            far = codes / STEPS[tile.depth]
        self.farthest[rows] = np.where(filled.all(axis=(1, 3)), far, np.inf)
        self.coverage[rows] = filled.mean(axis=(1, 3))


@dataclass(frozen=True, eq=False)
class Picture:
    """The image (height, width, channels) as `finish` kept it, and the work of drawing it.

    `fragments` were covered by triangles, hidden ones included; `shaded` were coloured, for each
    drawable, and stand for `seen` samples of it. `depth` is there where the drawing keeps it.
    """

    image: Array
    fragments: int
    shaded: tuple[int, ...]
    seen: tuple[int, ...]
    depth: DepthMap | None = None


class Window(NamedTuple):
    """Rows and columns of samples, whole pixels: first and one more than the last of each."""

    rows: tuple[int, int]
    columns: tuple[int, int]


@dataclass(frozen=True, eq=False)
class Drawing:
    """Some drawables on a canvas, over a background (channels,)."""

    drawables: Sequence[Drawable]
    canvas: Canvas
    background: Array
    depth: DepthBuffer = DepthBuffer.FULL
    keeps_depth: bool = False

    def picture(self, finish: Callable[[Array], Array] = np.asarray) -> Picture:
        """Draw everything; `finish` turns pixels, each by itself, into what is kept of them.

        Raises
        ------
        IllegalValueError
            For more triangles than a key can name.
        """
        _keep_freed_memory()
        blank = finish(self.background[None, None])
        image = np.empty((self.canvas.height, self.canvas.width, blank.shape[2]), blank.dtype)
        rows, columns = self._touched(self.drawables)
        left, right = (column // self.canvas.per_side for column in columns)
        top, bottom = (row // self.canvas.per_side for row in rows)
        for empty in (
            *(image[:top], image[bottom:]),
            *(image[top:bottom, :left], image[top:bottom, right:]),
        ):
            empty[:] = blank
        fragments, shaded = 0, np.zeros((2, len(self.drawables)), np.int64)
        depth = DepthMap.empty(self.canvas) if self.keeps_depth else None
        for some in _steps(rows, TILE_SAMPLES, self.canvas):
            tile = Tile.empty(some, self.canvas.columns, self.depth)
            for one, first in zip(self.drawables, self._first, strict=False):
                if one.opacity is None:
                    fragments += tile.add(one.projected, first, one.kept)
            if depth is not None:
                depth.take(tile, self.canvas)
            for few in _steps(some, self._stripe_samples, self.canvas):
                pixels, counts = self._stripe(tile, Window(few, columns))
                shaded += counts
                top, bottom = (row // self.canvas.per_side for row in few)
                image[top:bottom, left:right] = finish(pixels)
        each, once = shaded
        seen = each + self.canvas.per_side**2 * once
        return Picture(image, fragments, tuple((each + once).tolist()), tuple(seen.tolist()), depth)

    @property
    def _stripe_samples(self) -> int:
        """The samples of a stripe: more where many make one pixel, which is shaded once."""
        return STRIPE_SAMPLES * min(4, self.canvas.per_side**2)

    @cached_property
    def _first(self) -> list[int]:
        """The number of the first triangle of each drawable, and one more than the last."""
        first = [0]
        for one in self.drawables:
            first.append(first[-1] + one.projected.triangles.shape[1])
        if first[-1] > TRIANGLE_MASK:
            raise IllegalValueError(
                f"{first[-1]} triangles",
                f"a picture holds {TRIANGLE_MASK} at the most",
                "split the scene",
            )
        return first

    def _touched(self, drawables: Sequence[Drawable]) -> Window:
        """Return the window outside of which no sample is covered: empty where none is at all."""
        boxes = [one.projected.box for one in drawables if one.projected.triangles.size]
        if not boxes:
            return Window((0, 0), (0, 0))
        low, high = (np.array(ends) for ends in zip(*boxes, strict=True))
        k, limits = self.canvas.per_side, (self.canvas.columns, self.canvas.rows)
        first = np.clip(np.ceil(low.min(axis=0)) // k * k, 0, limits).astype(int)
        last = np.clip(-(-np.ceil(high.max(axis=0)) // k) * k, first, limits).astype(int)
        (left, top), (right, bottom) = first.tolist(), last.tolist()
        if left == right:
            bottom = top
        return Window((top, bottom), (left, right))

    @cached_property
    def _glass(self) -> list[int]:
        """The drawables that let light through."""
        return [i for i, one in enumerate(self.drawables) if one.opacity is not None]

    @cached_property
    def _even(self) -> Array | None:
        """A mask of the triangles of all drawables that may be shaded once a pixel, then False."""
        if self.canvas.per_side == 1 or all(one.even is None for one in self.drawables):
            return None
        parts = [
            np.zeros(last - first, bool) if one.even is None or one.opacity else one.even
            for one, first, last in zip(self.drawables, self._first, self._first[1:], strict=False)
        ]
        return np.append(np.concatenate(parts), False)

    def _stripe(self, tile: Tile, window: Window) -> tuple[Array, Array]:
        """Return the pixels (rows, width, channels) of a window, and the samples coloured.

        They are counted for each drawable: samples, and pixels that are coloured once (2, n).
        """
        k, (top, bottom), (left, right) = self.canvas.per_side, *window
        grid = Grid(right - left, top, left)
        samples = np.empty((len(self.background), (bottom - top) * grid.columns))
        samples[:] = self.background[:, None]
        counts = np.zeros((2, len(self.drawables)), np.int64)
        names = tile.names(*window)
        whole = self._taken_whole(names, window)
        self._colour_all(samples, runs_of(names, top, left), grid, counts[0])
        even, uneven = self._parted(whole)
        self._colour_all(samples, uneven.finer(k), grid, counts[0])
        triangles = [(self.drawables[i].projected, self._first[i]) for i in self._glass]
        for some in layers(triangles, tile, window.rows):
            counts[0, self._glass] += np.diff(some.first)
            self._blend(samples, some, grid)
        pixels = self._resolved(samples, grid.columns)
        middles = Grid(grid.columns // k, top // k, left // k, spacing=k)
        self._colour_all(pixels.reshape(len(pixels), -1), even, middles, counts[1])
        return pixels.transpose(1, 2, 0), counts

    def _parted(self, whole: Runs) -> tuple[Runs, Runs]:
        """Part runs of pixels: those that are shaded once, and those of triangles that are not."""
        if self._even is None:
            return whole, whole
        even = self._even.take(whole.triangle)
        return whole.some(even), whole.some(~even)

    def _taken_whole(self, names: Array, window: Window) -> Runs:
        """Take pixels whose samples all see one triangle out of the names; return their runs.

        No pixel in a row that glass may touch is among them: layers meet at each sample.
        """
        if self._even is None:
            return Runs(*(np.zeros(0, np.intp) for _ in Runs._fields))
        k, top = self.canvas.per_side, window.rows[0]
        pairs = names.view(np.int64).reshape(len(names) // k, k, -1)
        same = np.equal(pairs[:, 0], pairs[:, 1])
        for i in range(2, k):
            same &= pairs[:, 0] == pairs[:, i]
        middles = names[::k, ::k].copy()
        whole = np.asarray(same if k == 2 else same.reshape(*middles.shape, k // 2).all(axis=2))
        for i in range(1, k):
            whole &= middles == names[::k, i::k]
        glass, _ = self._touched([self.drawables[i] for i in self._glass])
        whole[slice(*(max(row - top, 0) // k for row in glass))] = False
        hidden = np.multiply(whole, BOTH_NOTHING)  # all bits of both names of a pair
        pairs |= (hidden if k == 2 else hidden.repeat(k // 2, axis=1))[:, None]
        middles[~whole] = NOTHING
        return runs_of(middles, top // k, window.columns[0] // k)

    def _colour_all(self, points: Array, runs: Runs, grid: Grid, counts: Array) -> None:
        """Colour the points (channels, n) of runs, and count them for each drawable."""
        for i, mine in runs.by_owner(self._first):
            one = self.drawables[i]
            for part in batches(mine.length, MOST_SHADED):
                some = Runs(*(values[part] for values in mine))
                found = interpolate(one.projected, some, grid, one.outputs)
                counts[i] += len(found)
                for channel, values in zip(points, one.fragment(found), strict=True):
                    channel[found.place] = values

    def _blend(self, samples: Array, some: Layers, grid: Grid) -> None:
        """Colour every transparent fragment, some of one drawable at a time, and lay them over."""
        row, column = np.divmod(some.place, self.canvas.columns)
        runs = Runs(some.triangle, row + grid.top, column, np.ones_like(row))
        places = row * grid.columns + column - grid.left
        own, through = np.empty((len(samples), len(row))), np.empty(len(row))
        for i, (begin, end) in zip(self._glass, pairwise(some.first), strict=True):
            one = self.drawables[i]
            assert one.opacity is not None  # it is glass
            for first in range(begin, end, MOST_SHADED):
                part = slice(first, min(first + MOST_SHADED, end))
                mine = Runs(*(one[part] for one in runs)).of(self._first[i], self._first[i + 1])
                found = interpolate(one.projected, mine, grid, one.outputs)
                opacity = one.opacity(found)
                through[part] = 1.0 - opacity
                own[:, part] = opacity * one.fragment(found)
        for which in some.levels:
            place = places[which]
            samples[:, place] = own[:, which] + through[which] * samples[:, place]

    def _resolved(self, samples: Array, columns: int) -> Array:
        """Return pixels (channels, rows, width): the mean of their samples."""
        k = self.canvas.per_side
        grid = samples.reshape(len(samples), -1, k, columns // k, k)
        pixels = grid[:, :, 0, :, 0]
        for i in range(1, k * k):  # in one order everywhere: no bit depends on the stripe
            pixels = pixels + grid[:, :, i // k, :, i % k]
        if k > 1:
            pixels /= k * k
        return np.asarray(pixels)


@cache
def _keep_freed_memory() -> None:
    """Let the allocator keep what is freed, so that arrays of a stripe reuse warm pages.

    The C library gives larger blocks back to the system at once, and each new one costs a page
    fault for every 4 KiB. It stops doing so for sizes up to the largest block that it has seen
    freed, and this one is never touched.
    """
    np.empty(LARGEST_KEPT, np.uint8)


def _steps(rows: tuple[int, int], samples: int, canvas: Canvas) -> Iterator[tuple[int, int]]:
    """Cut rows of samples into whole rows of pixels, of about so many samples together."""
    step = max(1, samples // (canvas.columns * canvas.per_side)) * canvas.per_side
    for top in range(*rows, step):
        yield top, min(top + step, rows[1])
