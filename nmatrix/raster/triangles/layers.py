"""Transparency, exactly: every layer in front of what is opaque, sorted at each sample by depth.

Layers are blended from the back to the front, all samples' farthest layers first. Two at the very
same depth stand in the order in which their triangles were named.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.raster.triangles.vertices import Projected
from nmatrix.raster.triangles.visibility import TRIANGLE_MASK, Runs, Tile

Array = NDArray[Any]


def layers(
    glass: Sequence[tuple[Projected, int]], tile: Tile, rows: tuple[int, int]
) -> Iterator[Runs]:
    """Yield the layers in front of a tile's rows, from the back to the front: runs of length one.

    `glass` holds the triangles of each transparent drawable, and the number of the first of them.
    """
    stripe = tile.part(rows)
    place, key = _in_front(stripe, glass)
    order = np.lexsort((-key, place))
    place, key = place[order], key[order]
    starts = np.flatnonzero(np.diff(place, prepend=-1))
    rank = np.arange(len(place)) - np.repeat(starts, np.diff(starts, append=len(place)))
    for level in range(int(rank.max()) + 1 if len(rank) else 0):
        which = np.flatnonzero(rank == level)
        triangle = key[which] & TRIANGLE_MASK
        row, column = np.divmod(place[which], stripe.columns)
        yield Runs(triangle, row + rows[0], column, np.ones_like(row))


def _in_front(stripe: Tile, glass: Sequence[tuple[Projected, int]]) -> tuple[Array, Array]:
    """Return place and key of every transparent fragment that nothing opaque hides."""
    places, keys = [np.zeros(0, np.intp)], [np.zeros(0, np.int64)]
    for projected, first in glass:
        for index, key in stripe.fragments(projected, first):
            seen = np.flatnonzero(key < stripe.keys.take(index))
            places.append(index.take(seen))
            keys.append(key.take(seen))
    return np.concatenate(places), np.concatenate(keys)
