"""Transparency, exactly: every layer in front of what is opaque, sorted at each sample by depth.

Layers are blended from the back to the front, all samples' farthest layers first. Two at the very
same depth stand in the order in which their triangles were named. Each fragment is found, sorted
and blended once, so the work grows with the samples that are covered, however many panes there are.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.raster.triangles.run_expansion import batches
from nmatrix.raster.triangles.spans import spans
from nmatrix.raster.triangles.vertices import Projected
from nmatrix.raster.triangles.visibility import CHUNK, TRIANGLE_MASK, Tile

Array = NDArray[Any]
Glass = Sequence[tuple[Projected, int]]

MOST_LAYERED = 1 << 21  # fragments that are held at once, however many lie on each other
SHORT = 1 << 16  # whole numbers below this are sorted in time that grows with their count alone


@dataclass(frozen=True, eq=False)
class Layers:
    """Transparent fragments in some rows of the canvas, drawable by drawable.

    `place` is each one's sample in the tile's rows, `triangle` its number. Those from
    `first[i]` to `first[i + 1]` belong to drawable i. `levels` holds which of them are blended
    together, the farthest of all samples first.
    """

    place: Array
    triangle: Array
    first: tuple[int, ...]
    levels: tuple[Array, ...]


def layers(glass: Glass, tile: Tile, rows: tuple[int, int]) -> Iterator[Layers]:
    """Yield the layers in front of a tile's rows, as many rows at a time as memory allows.

    `glass` holds the triangles of each transparent drawable, and the number of the first of them.
    """
    if not glass:
        return
    found = _layers(glass, tile, rows, MOST_LAYERED)
    if found is not None:
        yield found
        return
    for part in batches(_covered(glass, tile, rows), MOST_LAYERED):
        some = _layers(glass, tile, (rows[0] + part.start, rows[0] + part.stop), None)
        assert some is not None  # without a limit nothing exceeds it
        place = some.place + part.start * tile.columns
        yield Layers(place, some.triangle, some.first, some.levels)


def _layers(glass: Glass, tile: Tile, rows: tuple[int, int], most: int | None) -> Layers | None:
    """Return the layers of some rows that nothing opaque hides, or None if there are too many."""
    stripe = tile.part(rows)
    places, keys, first = [np.zeros(0, np.intp)], [np.zeros(0, np.int64)], [0]
    count = 0
    for projected, number in glass:
        for index, key in stripe.fragments(projected, number):
            seen = np.flatnonzero(key < stripe.keys.take(index))
            places.append(index.take(seen))
            keys.append(key.take(seen))
            count += len(seen)
            if most is not None and count > most:
                return None
        first.append(count)
    place, key = np.concatenate(places), np.concatenate(keys)
    return Layers(place, key & TRIANGLE_MASK, tuple(first), _levels(place, key))


def _levels(place: Array, key: Array) -> tuple[Array, ...]:
    """Return which fragments are the farthest of their sample, which the next, and so on.

    Examples
    --------
    >>> [one.tolist() for one in _levels(np.array([4, 7, 4]), np.array([10, 20, 30]))]
    [[2, 1], [0]]
    """
    if not len(place):
        return ()
    order = np.argsort(-key)
    order = order[_sorted(place[order])]
    sample = place[order]
    starts = np.flatnonzero(np.diff(sample, prepend=-1))
    rank = np.arange(len(sample)) - np.repeat(starts, np.diff(starts, append=len(sample)))
    by_level = order[_sorted(rank)]
    ends = np.cumsum(np.bincount(rank))
    return tuple(by_level[a:b] for a, b in pairwise((0, *ends.tolist())))


def _sorted(values: Array) -> Array:
    """Return the order of whole numbers that are not negative; equal ones keep theirs."""
    short = int(values.max()) < SHORT
    return np.argsort(values.astype(np.uint16) if short else values, kind="stable")


def _covered(glass: Glass, tile: Tile, rows: tuple[int, int]) -> Array:
    """Return how many samples of each row transparent triangles cover."""
    count = np.zeros(rows[1] - rows[0], np.intp)
    for projected, _ in glass:
        for chunk in projected.chunks(CHUNK, rows):
            for found in spans(chunk.x, chunk.y, rows, tile.columns):
                np.add.at(count, found.row.astype(np.intp) - rows[0], found.length)
    return count
