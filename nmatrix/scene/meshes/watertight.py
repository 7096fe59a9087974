"""Watertight surfaces: each edge is shared by two triangles, turned against each other.

Edges are directed from corner to corner, and named by the places of both. Memory follows parts of
the mesh, never the whole of its edges.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]

PART = 1 << 20  # triangles that are looked at together
MOST_KEYS = 1 << 22  # edges that are sorted together

_ODD = np.array([0x9E3779B97F4A7C15, 0xBF58476D1CE4E5B9, 0x94D049BB133111EB], np.uint64)


def is_watertight(positions: Array, triangles: Array) -> bool:
    """Check that every directed edge occurs once, and its reverse once: then there is an inside.

    Vertices in the same place count as one; triangles with two corners in one place, as none.

    Examples
    --------
    >>> corners = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    >>> faces = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
    >>> is_watertight(corners, faces), is_watertight(corners, faces[:3])
    (True, False)
    """
    place = same_place(positions)
    if place is None or not _is_balanced(place, triangles):
        return False
    count, groups = len(positions), 1 + 3 * len(triangles) // MOST_KEYS
    return all(_is_paired(place, triangles, count, (one, groups)) for one in range(groups))


def _is_paired(place: Array, triangles: Array, count: int, group: tuple[int, int]) -> bool:
    """Check that the edges whose lower end belongs to a group occur once in either sense."""
    there, back = [], []
    for start, end in _edges(place, triangles):
        kept = np.minimum(start, end) % group[1] == group[0]
        there.append(start[kept] * count + end[kept])
        back.append(end[kept] * count + start[kept])
    forwards, backwards = np.sort(np.concatenate(there)), np.sort(np.concatenate(back))
    return bool((forwards[1:] != forwards[:-1]).all() and (forwards == backwards).all())


def _is_balanced(place: Array, triangles: Array) -> bool:
    """Return False where some edge surely lacks its reverse, in one pass.

    Sums of hashes do not depend on the order: equal sets of edges have equal sums.
    """
    total = np.uint64(0)
    with np.errstate(over="ignore"):
        for start, end in _edges(place, triangles):
            one, other = start.astype(np.uint64), end.astype(np.uint64)
            total += _mixed(one, other).sum() - _mixed(other, one).sum()
    return not total


def _mixed(start: Array, end: Array) -> Array:
    found = start * _ODD[0] + end * _ODD[1]
    return np.asarray((found ^ (found >> np.uint64(29))) * _ODD[2])


def _edges(place: Array, triangles: Array) -> Iterator[tuple[Array, Array]]:
    for first in range(0, len(triangles), PART):
        corners = place[triangles[first : first + PART]]
        corners = corners[(corners != np.roll(corners, 1, axis=1)).all(axis=1)]
        yield corners.ravel(), np.roll(corners, -1, axis=1).ravel()


def same_place(positions: Array) -> Array | None:
    """Return a number for each vertex, alike where positions are; None if hashes collide."""
    bits = (positions + 0.0).view(np.uint64)  # −0 becomes 0
    hashed = bits[:, 0] * _ODD[0] ^ np.bitwise_right_shift(bits[:, 0], 29)
    for axis in (1, 2):
        hashed = (hashed ^ np.bitwise_right_shift(hashed, 31)) * _ODD[axis] + bits[:, axis]
    del bits
    _, first, place = np.unique(hashed, return_index=True, return_inverse=True)
    return place if (positions[first[place]] == positions).all() else None
