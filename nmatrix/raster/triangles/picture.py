"""From triangles to a picture: tiles for visibility, stripes for colour, samples to pixels.

A tile is as many rows as its keys may take memory; a stripe as many as stay in the cache while they
are coloured. Neither changes a bit of the picture.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.errors import IllegalValueError
from nmatrix.raster.triangles.fragments import Fragments, VertexOutputs, interpolate
from nmatrix.raster.triangles.layers import Layers, layers
from nmatrix.raster.triangles.spans import Canvas
from nmatrix.raster.triangles.vertices import Projected
from nmatrix.raster.triangles.visibility import TRIANGLE_MASK, Runs, Tile, visible_runs
from nmatrix.scene.words import DepthBuffer

Array = NDArray[Any]

TILE_SAMPLES = 1 << 22
STRIPE_SAMPLES = 1 << 16
LARGEST_KEPT = 12 << 20  # bytes: the keys of a picture of 1024 × 1024


@dataclass(frozen=True, eq=False)
class Drawable:
    """Projected triangles, the outputs of their vertices, and their fragment shader.

    Opaque ones hide what is behind; others let 1 − `opacity` of it through.
    """

    projected: Projected
    outputs: VertexOutputs
    fragment: Callable[[Fragments], Array]
    opacity: float = 1.0


@dataclass(frozen=True, eq=False)
class Picture:
    """The image (height, width, channels) as `finish` kept it, and the work of drawing it.

    `fragments` were covered by triangles, hidden ones included; `shaded` were coloured, for each
    drawable.
    """

    image: Array
    fragments: int
    shaded: tuple[int, ...]


@dataclass(frozen=True, eq=False)
class Drawing:
    """Some drawables on a canvas, over a background (channels,)."""

    drawables: Sequence[Drawable]
    canvas: Canvas
    background: Array
    depth: DepthBuffer = DepthBuffer.FULL

    def picture(self, finish: Callable[[Array], Array] = np.asarray) -> Picture:
        """Draw everything; `finish` turns rows of pixels into what is kept of them.

        Raises
        ------
        IllegalValueError
            For more triangles than a key can name.
        """
        _keep_freed_memory()
        kept, fragments, shaded = [], 0, np.zeros(len(self.drawables), np.int64)
        for rows in _steps((0, self.canvas.rows), TILE_SAMPLES, self.canvas):
            tile = Tile.empty(rows, self.canvas.columns, self.depth)
            for one, first in zip(self.drawables, self._first, strict=False):
                if one.opacity == 1.0:
                    fragments += tile.add(one.projected, first)
            for some in _steps(rows, STRIPE_SAMPLES, self.canvas):
                samples, counts = self._stripe(tile, some)
                shaded += counts
                kept.append(finish(self._resolved(samples)))
        return Picture(np.concatenate(kept), fragments, tuple(shaded.tolist()))

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

    def _stripe(self, tile: Tile, rows: tuple[int, int]) -> tuple[Array, Array]:
        """Return the samples (channels, n) of some rows, and how many each drawable coloured."""
        columns = self.canvas.columns
        samples = np.empty((len(self.background), (rows[1] - rows[0]) * columns))
        samples[:] = self.background[:, None]
        counts = np.zeros(len(self.drawables), np.int64)
        runs = visible_runs(tile, rows)
        for i, one in enumerate(self.drawables):
            mine = runs.of(self._first[i], self._first[i + 1]) if one.opacity == 1.0 else None
            if mine is not None and len(mine.triangle):
                found = self._fragments(i, mine)
                for channel, values in zip(samples, one.fragment(found), strict=True):
                    channel[found.sample - rows[0] * columns] = values
                counts[i] += len(found)
        glass = [i for i, one in enumerate(self.drawables) if one.opacity < 1.0]
        triangles = [(self.drawables[i].projected, self._first[i]) for i in glass]
        for some in layers(triangles, tile, rows):
            counts[glass] += np.diff(some.first)
            self._blend(samples, glass, some, rows[0])
        return samples, counts

    def _fragments(self, i: int, runs: Runs) -> Fragments:
        one = self.drawables[i]
        return interpolate(one.projected, runs, self.canvas.columns, one.outputs)

    def _blend(self, samples: Array, glass: Sequence[int], some: Layers, top: int) -> None:
        """Colour every transparent fragment, some of one drawable at a time, and lay them over."""
        row, column = np.divmod(some.place, self.canvas.columns)
        runs = Runs(some.triangle, row + top, column, np.ones_like(row))
        own, through = np.empty((len(samples), len(row))), np.empty(len(row))
        for i, (begin, end) in zip(glass, pairwise(some.first), strict=True):
            opacity = self.drawables[i].opacity
            through[begin:end] = 1.0 - opacity
            for first in range(begin, end, STRIPE_SAMPLES):
                part = slice(first, min(first + STRIPE_SAMPLES, end))
                mine = Runs(*(one[part] for one in runs)).of(self._first[i], self._first[i + 1])
                own[:, part] = opacity * self.drawables[i].fragment(self._fragments(i, mine))
        for which in some.levels:
            place = some.place[which]
            samples[:, place] = own[:, which] + through[which] * samples[:, place]

    def _resolved(self, samples: Array) -> Array:
        """Return pixels (rows, width, channels): the mean of their samples."""
        k = self.canvas.per_side
        grid = samples.reshape(len(samples), -1, k, self.canvas.width, k)
        pixels = grid[:, :, 0, :, 0]
        for i in range(1, k * k):  # in one order everywhere: no bit depends on the stripe
            pixels = pixels + grid[:, :, i // k, :, i % k]
        if k > 1:
            pixels /= k * k
        return np.asarray(pixels.transpose(1, 2, 0))


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
