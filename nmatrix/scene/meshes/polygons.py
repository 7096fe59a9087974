"""Polygons as triangles: fans where they fit, else ears cut off by exact orientations.

Every cut has n − 2 triangles that use the polygon's own corners. If all are turned as the polygon
is, they cover it once: signed areas add up to its own whatever the cut, and so do winding numbers.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections import deque
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Indices = NDArray[np.integer[Any]]
Point = tuple[float, float]

TRIANGLE = 3
BALANCED = 1e-12  # a mean normal, to that of the largest triangle: rounding leaves less of none
LOOKS = 16  # at each corner of a polygon: one that does not cross itself takes three
MOST_FORCED = 16  # cuts of a corner that is no ear; what is left then is cut as a fan
_ROUNDING = 4 * 2.0**-52  # Shewchuk's (3 + 16ε)ε, with room
_SMALLEST = 1e-290  # products below it have lost digits


@dataclass(frozen=True)
class Cut:
    """Triangles (T, 3) as places among all corners, the polygon of each, and failures.

    `crossing` counts the polygons that cross themselves, so that no cut of them is right.
    """

    triangles: Indices
    polygon: Indices
    crossing: int = 0


def cut(positions: Array, corners: Indices, sizes: Indices) -> Cut:
    """Cut polygons, given as corners one polygon after the other, into triangles.

    Polygons may be concave and lie in any plane; what is not flat is seen along its mean normal.

    Examples
    --------
    >>> arrow = np.array([[-2.0, 2, 0], [0, 0, 0], [2, 2, 0], [0, 1.2, 0]])
    >>> cut(arrow, np.arange(4), np.array([4])).triangles.tolist()
    [[1, 2, 3], [1, 3, 0]]
    """
    if (sizes == TRIANGLE).all():
        return Cut(np.arange(len(corners)).reshape(-1, 3), np.arange(len(sizes)))
    firsts = np.cumsum(sizes) - sizes
    counts = np.maximum(sizes - 2, 0)
    polygon = np.repeat(np.arange(len(sizes)), counts)
    triangles = np.empty((len(polygon), 3), np.intp)
    ahead = np.cumsum(counts) - counts  # triangles before each polygon's
    crossing = 0
    for size in np.unique(sizes[sizes >= TRIANGLE]).tolist():
        chosen = np.flatnonzero(sizes == size)
        local = np.tile(_fan(size), (len(chosen), 1, 1))
        if size > TRIANGLE:
            at = corners[firsts[chosen][:, None] + np.arange(size)]
            local, failures = _cut_alike(positions, at)
            crossing += failures
        rows = ahead[chosen][:, None] + np.arange(size - 2)
        triangles[rows] = local + firsts[chosen][:, None, None]
    return Cut(triangles, polygon, crossing)


def _fan(size: int, start: int = 0) -> Indices:
    """List the triangles that all have one corner in common.

    Examples
    --------
    >>> _fan(4, 1).tolist()
    [[1, 2, 3], [1, 3, 0]]
    """
    steps = np.arange(1, size - 1)
    rows = np.stack([np.zeros_like(steps), steps, steps + 1], axis=1)
    return np.asarray((rows + start) % size)


def _cut_alike(positions: Array, at: Indices) -> tuple[Indices, int]:
    """Cut polygons of one size (m, n); the number that cross themselves comes along."""
    count, size = at.shape
    flat = _flattened(positions[at])
    found = np.tile(_fan(size), (count, 1, 1))
    open_ = np.arange(count)
    for start in (0, 1):
        fan = _fan(size, start)
        a, b, c = (flat[open_][:, fan[:, i]] for i in range(3))
        turns, sure = _turns(a, b, c)
        fits = (sure & (turns >= 0)).all(axis=1)
        found[open_[fits]] = fan
        open_ = open_[~fits]
    crossing = 0
    for row in open_.tolist():
        triangles, is_right = _ears(flat[row])
        found[row] = triangles
        crossing += not is_right
    return found, crossing


def _flattened(points: NDArray[Any]) -> Array:
    """Drop the coordinate along which a polygon (m, n, 3) is seen best, so that it turns left."""
    with np.errstate(all="ignore"):
        away = points - points[:, :1]
        _, exponents = np.frexp(np.abs(away).max(axis=(1, 2), keepdims=True))
        away = np.ldexp(away, -exponents)
        crosses = np.cross(away[:, 1:-1], away[:, 2:])
        normal = crosses.sum(axis=1)
        sizes = np.abs(crosses).max(axis=2)
        largest = np.take_along_axis(crosses, sizes.argmax(axis=1)[:, None, None], axis=1)[:, 0]
        is_balanced = np.abs(normal).max(axis=1) <= BALANCED * sizes.max(axis=1)
        normal = np.where(is_balanced[:, None], largest, normal)  # a bow tie has no mean normal
    axis = np.abs(np.nan_to_num(normal)).argmax(axis=1)
    sign = np.take_along_axis(normal, axis[:, None], axis=1)[:, 0]
    kept = np.stack([(axis + 1) % 3, (axis + 2) % 3], axis=1)
    kept[sign < 0] = kept[sign < 0][:, ::-1]
    return np.asarray(np.take_along_axis(points, kept[:, None, :], axis=2))


def _turns(a: Array, b: Array, c: Array) -> tuple[Array, NDArray[np.bool_]]:
    """Double the signed areas of triangles a b c in the plane, and tell whose sign is sure."""
    with np.errstate(all="ignore"):
        (bx, by), (cx, cy) = (np.moveaxis(one - a, -1, 0) for one in (b, c))
        left, right = bx * cy, by * cx
        found = left - right
        sure = np.abs(found) > _ROUNDING * (np.abs(left) + np.abs(right)) + _SMALLEST
    return found, sure | (((bx == 0) | (cy == 0)) & ((by == 0) | (cx == 0)))


def turn(a: Point, b: Point, c: Point) -> int:
    """Tell exactly whether the way from a over b to c turns left (1), right (−1) or not (0).

    Examples
    --------
    Three tenths, as a float, is less than three times a tenth.

    >>> turn((0.0, 0.0), (1.0, 1.0), (3.0, 3.0)), turn((0.0, 0.0), (0.1, 1.0), (0.3, 3.0))
    (0, 1)
    """
    left, right = (b[0] - a[0]) * (c[1] - a[1]), (b[1] - a[1]) * (c[0] - a[0])
    found = left - right
    if abs(found) > _ROUNDING * (abs(left) + abs(right)) + _SMALLEST:
        return 1 if found > 0 else -1
    (ax, ay), (bx, by), (cx, cy) = (map(Fraction, one) for one in (a, b, c))
    exact = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    return (exact > 0) - (exact < 0)


def _ears(corners: Array) -> tuple[Indices, bool]:
    """Cut one polygon (n, 2) that turns left, and tell whether all its triangles do.

    Where no ear is left, the rest has no area or the polygon crosses itself.
    """
    ring = _Ring(corners)
    ring.cut()
    found = np.array(ring.found, np.intp)
    return found, all(turn(*(ring.points[i] for i in one)) >= 0 for one in ring.found)


class _Ring:
    """The corners that are left of one polygon, and the ears that were cut off.

    A corner is an ear if it turns left and no other corner lies in its triangle; only those that do
    not turn left themselves, the obstacles, need to be looked at. A cut can make an ear of nothing
    but the two corners beside it, so each cut costs two looks; and a look sees only the obstacles
    that are abreast of the triangle.
    """

    def __init__(self, corners: Array) -> None:
        self.points: list[Point] = [(x, y) for x, y in corners.tolist()]
        count = len(self.points)
        self.found: list[tuple[int, int, int]] = []
        self.left = dict.fromkeys(range(count))
        self.before = [count - 1, *range(count - 1)]
        self.after = [*range(1, count), 0]
        self.waiting = deque(range(count))
        self.waits = [True] * count
        steps = np.abs(np.diff(corners, axis=0, append=corners[:1])).sum(axis=0)
        with np.errstate(all="ignore"):  # along the axis on which corners lie apart the most
            self.axis = int(np.argmin(np.nan_to_num(steps / np.ptp(corners, axis=0), nan=np.inf)))
        self.order = np.argsort(corners[:, self.axis], kind="stable")
        self.sorted = corners[self.order]
        self.abreast: list[float] = self.sorted[:, self.axis].tolist()
        self.rank = np.argsort(self.order).tolist()
        self.turns = [0] * count
        self.is_obstacle = np.zeros(count, bool)  # in the sorted order
        for corner in range(count):
            self._turned(corner)

    def cut(self) -> None:
        """Cut ears until a triangle is left; where there is none any corner has to do."""
        looks, most_looks = 0, LOOKS * len(self.points)
        is_fresh, forced = True, 0
        while len(self.left) > TRIANGLE:
            if self.waiting:
                corner = self.waiting.popleft()
                self.waits[corner] = False
                looks += 1
                if corner in self.left and self._is_ear(corner):
                    self._cut_off(corner)
                    is_fresh = False
                continue
            straight = next((one for one in self.left if self.turns[one] == 0), None)
            if straight is not None:
                self._cut_off(straight)
            elif not is_fresh and looks < most_looks:
                is_fresh = True
                self.waiting.extend(self.left)
                self.waits = [True] * len(self.points)
            elif forced < MOST_FORCED:
                forced += 1
                self._cut_off(next(iter(self.left)))
            else:
                break
        first, *others = self.left
        self.found += [(first, a, b) for a, b in pairwise(others)]

    def _cut_off(self, corner: int) -> None:
        """Take a corner out of the ring, and look at those beside it again."""
        before, after = self.before[corner], self.after[corner]
        self.found.append((before, corner, after))
        del self.left[corner]
        self.is_obstacle[self.rank[corner]] = False
        self.after[before], self.before[after] = after, before
        for one in (before, after):
            self._turned(one)
        if not self.waits[after]:
            self.waiting.appendleft(after)
        if not self.waits[before]:
            self.waiting.append(before)
        self.waits[before] = self.waits[after] = True

    def _turned(self, corner: int) -> None:
        self.turns[corner] = turn(*(self.points[one] for one in self._triangle(corner)))
        self.is_obstacle[self.rank[corner]] = self.turns[corner] <= 0

    def _triangle(self, corner: int) -> tuple[int, int, int]:
        return self.before[corner], corner, self.after[corner]

    def _is_ear(self, corner: int) -> bool:
        if self.turns[corner] <= 0:
            return False
        a, b, c = (self.points[one] for one in self._triangle(corner))
        low, high = (end(one[self.axis] for one in (a, b, c)) for end in (min, max))
        some = slice(bisect_left(self.abreast, low), bisect_right(self.abreast, high))
        near = self.sorted[some][self.is_obstacle[some]]
        inside = np.ones(len(near), bool)
        for p, q in ((a, b), (b, c), (c, a)):
            near = near[inside]
            turns, sure = _turns(np.array(p), np.array(q), near)
            inside = (turns >= 0) | ~sure
        others = {(x, y) for x, y in near[inside].tolist()} - {a, b, c}
        return not any(
            turn(a, b, p) >= 0 and turn(b, c, p) >= 0 and turn(c, a, p) >= 0 for p in others
        )
