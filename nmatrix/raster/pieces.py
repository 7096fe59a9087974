"""Runs of neighbours cut into lengths of powers of two, so that equal lengths form one full array.

A run of 13 is 8 + 4 + 1. All pieces of one length are worked on together: nothing is masked,
nothing is computed twice, and no element has to look up the run that it belongs to.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]


class Pieces(NamedTuple):
    """All pieces of one length: the run of each, and where in its run it begins."""

    size: int
    run: Array
    offset: Array


def pieces(lengths: Array) -> Iterator[Pieces]:
    """Cut runs (N,) of whole, non-negative lengths; long pieces stand in front of short ones.

    Examples
    --------
    >>> for piece in pieces(np.array([5, 4])):
    ...     print(piece.size, piece.run.tolist(), piece.offset.tolist())
    1 [0] [4]
    4 [0, 1] [0, 0]
    """
    left, size = lengths, 1
    names: Array | None = None  # of the runs that are at least this long; None for all
    while len(left):
        odd = np.flatnonzero((left & size) != 0)
        if len(odd):
            run = odd if names is None else names.take(odd)
            yield Pieces(size, run, left.take(odd) & -2 * size)
        size *= 2
        longer = np.flatnonzero(left >= size)
        names = longer if names is None else names.take(longer)
        left = left.take(longer)


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
