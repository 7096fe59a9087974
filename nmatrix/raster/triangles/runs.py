"""Runs: neighbouring samples of a row in which the same triangle is seen."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from nmatrix.raster.triangles.visibility import TRIANGLE_MASK, Tile

Array = NDArray[Any]


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
        which = np.flatnonzero(mine)
        triangle, *rest = (one.take(which) for one in self)
        return Runs(triangle - first, *rest)


def visible_runs(tile: Tile, rows: tuple[int, int]) -> Runs:
    """Return what is seen in some rows of a tile.

    Examples
    --------
    >>> tile = Tile(np.array([7, 7, 9, 1 << 62]) | 1 << 24, (0, 2), 2)
    >>> runs = visible_runs(tile, (0, 2))
    >>> list(zip(runs.triangle.tolist(), runs.row.tolist(), runs.length.tolist()))
    [(7, 0, 2), (9, 1, 1), (0, 1, 1)]
    """
    columns = tile.columns
    names = tile.part(rows).keys.astype(np.int32).reshape(-1, columns)  # the lower half of each
    names &= TRIANGLE_MASK
    starts = np.ones(names.shape, bool)
    np.not_equal(names[:, 1:], names[:, :-1], out=starts[:, 1:])
    start = np.flatnonzero(starts)
    end = np.append(start[1:], names.size)
    triangle = names.ravel().take(start).astype(np.intp)
    seen = np.flatnonzero(triangle != TRIANGLE_MASK)
    start = start.take(seen)
    row = start // columns
    return Runs(triangle.take(seen), row + rows[0], start - row * columns, end.take(seen) - start)
