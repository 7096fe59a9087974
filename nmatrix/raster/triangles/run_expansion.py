"""Expand constant or linear values of runs to the samples of the runs.

Samples stand one run after the other. Each knows its run and its place in it; all else is read from
there, so that no sum is carried from sample to sample and no bit depends on what stands before.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]

COUNTED = 1 << 16  # samples that are counted already: no array of them is made again
LONG = 6  # from this mean length on, repeating is faster than looking up each sample's run
_COUNTS, _FLOATS = np.arange(COUNTED), np.arange(float(COUNTED))


class RunExpansion:
    """Runs of these lengths, each at least 1, expanded to their samples.

    Examples
    --------
    >>> start, growth = np.array([[10.0, 5.0]]), np.array([[1.0, 0.0]])
    >>> RunExpansion(np.array([3, 1])).ramps(start, growth).tolist()
    [[10.0, 11.0, 12.0, 5.0]]
    """

    def __init__(self, lengths: Array) -> None:
        end = np.cumsum(lengths)
        self.samples = int(end[-1]) if len(end) else 0
        self._lengths, self._begin = lengths, end - lengths
        self._run: Array | None = None
        if self.samples < LONG * len(lengths):
            self._run = np.zeros(self.samples, np.intp)
            self._run[self._begin[1:]] = 1
            np.cumsum(self._run, out=self._run)

    def each(self, values: Array) -> Array:
        """Return values (runs,) at every sample."""
        found = values.repeat(self._lengths) if self._run is None else values.take(self._run)
        return np.asarray(found)

    def constants(self, values: Array) -> Array:
        """Return values (k, runs) at every sample."""
        return np.stack([self.each(row) for row in values])

    def counted(self, start: Array) -> Array:
        """Return start + i for sample i of each run, (runs,) whole numbers."""
        out = self.each(start - self._begin)
        out += _first(self.samples, _COUNTS)
        return out

    def ramps(self, start: Array, growth: Array) -> Array:
        """Return start + i · growth for sample i of each run; both are (k, runs)."""
        out = np.empty((len(start), self.samples))
        for i, (first, slope) in enumerate(zip(start, growth, strict=True)):
            np.multiply(self.each(slope), self._step, out=out[i])
            out[i] += self.each(first)
        return out

    @cached_property
    def _step(self) -> Array:
        """The place of each sample in its run."""
        step = self.each(self._begin.astype(float))
        return np.subtract(_first(self.samples, _FLOATS), step, out=step)


def _first(count: int, known: Array) -> Array:
    """Return the whole numbers below a count, as they are known or made."""
    return known[:count] if count <= len(known) else np.arange(count, dtype=known.dtype)


def batches(sizes: Array, most: int) -> Iterator[slice]:
    """Cut a list where the sizes (N,) so far pass a multiple of `most`: memory stays bounded.

    Examples
    --------
    >>> [(one.start, one.stop) for one in batches(np.array([3, 3, 3, 9, 1]), 6)]
    [(0, 2), (2, 3), (3, 4), (4, 5)]
    """
    total = np.cumsum(sizes)
    if not len(total) or total[-1] <= most:
        yield slice(0, len(total))
        return
    group = (total - 1) // most
    cuts = np.flatnonzero(np.diff(group)) + 1
    for first, last in zip([0, *cuts.tolist()], [*cuts.tolist(), len(total)], strict=True):
        yield slice(first, last)
