"""From runs to samples: numbers that stay or grow evenly along each run, written out in full."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.raster.pieces import Pieces, pieces

Array = NDArray[Any]

WIDE = 16  # pieces from here on lie along their run, shorter ones beside each other


class Spread:
    """How runs of these lengths are written out; every array comes out in the same order.

    Examples
    --------
    >>> Spread(np.array([3, 1])).ramps(np.array([[10.0, 5.0]]), np.array([[1.0, 0.0]])).tolist()
    [[12.0, 5.0, 10.0, 11.0]]
    """

    def __init__(self, lengths: Array) -> None:
        self.samples = int(lengths.sum())
        self._pieces = [*pieces(lengths)]

    def ramps(self, start: Array, growth: Array) -> Array:
        """Return start + i · growth for sample i of each run; both are (k, runs)."""
        out = np.empty((len(start), self.samples), start.dtype)
        for piece, block in self._blocks(out):
            slope = growth.take(piece.run, 1)
            begin = start.take(piece.run, 1)
            begin += slope * piece.offset
            step = np.arange(piece.size, dtype=out.dtype)
            if piece.size < WIDE:
                np.multiply(slope[:, None], step[:, None], out=block)
                np.add(block, begin[:, None], out=block)
            else:
                np.multiply(slope[:, :, None], step, out=block)
                np.add(block, begin[:, :, None], out=block)
        return out

    def counted(self, start: Array) -> Array:
        """Return start + i for sample i of each run; start is (runs,)."""
        out = np.empty((1, self.samples), start.dtype)
        for piece, block in self._blocks(out):
            begin = start.take(piece.run)
            begin += piece.offset
            step = np.arange(piece.size, dtype=out.dtype)
            if piece.size < WIDE:
                np.add(begin, step[:, None], out=block[0])
            else:
                np.add(begin[:, None], step, out=block[0])
        return np.asarray(out[0])

    def constants(self, values: Array) -> Array:
        """Return values (k, runs) at every sample."""
        out = np.empty((len(values), self.samples), values.dtype)
        for piece, block in self._blocks(out):
            value = values.take(piece.run, 1)
            block[:] = value[:, None] if piece.size < WIDE else value[:, :, None]
        return out

    def _blocks(self, out: Array) -> Iterator[tuple[Pieces, Array]]:
        """Return where the pieces of each length belong, as (k, size, n) or (k, n, size)."""
        end = 0
        for piece in self._pieces:
            size, count = piece.size, len(piece.run)
            start, end = end, end + size * count
            shape = (size, count) if size < WIDE else (count, size)
            yield piece, out[:, start:end].reshape(len(out), *shape)
