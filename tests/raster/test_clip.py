"""Clipping against exact rational arithmetic; neighbours that share an edge agree along the cut."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest

from nmatrix.enums import DepthRange
from nmatrix.raster import clip as clip_module
from nmatrix.raster.clip import GUARD, Triangles, clip, whole
from nmatrix.raster.cover import cover, snap

SIZE = 32
Point = tuple[Fraction, ...]


def exact_polygon(triangle: np.ndarray, depth: DepthRange) -> list[Point]:
    """Cut by near, the eye plane and the guard band, one after the other, without rounding."""
    near = {
        DepthRange.MINUS_ONE_TO_ONE: (0, 0, 1, 1),
        DepthRange.ZERO_TO_ONE: (0, 0, 1, 0),
        DepthRange.REVERSED: (0, 0, -1, 1),
    }[depth]
    band = Fraction(2 * int(GUARD), SIZE)
    sides = [(1, 0, 0, band), (-1, 0, 0, band), (0, 1, 0, band), (0, -1, 0, band)]
    polygon = [tuple(map(Fraction, corner)) for corner in triangle.tolist()]
    for plane in [near, (0, 0, 0, 1), *sides]:
        polygon = cut_polygon(polygon, plane)
    return polygon


def cut_polygon(polygon: list[Point], plane: tuple[Fraction | int, ...]) -> list[Point]:
    kept = []
    for i, p in enumerate(polygon):
        q = polygon[(i + 1) % len(polygon)]
        d, e = (sum(a * b for a, b in zip(plane, point, strict=True)) for point in (p, q))
        if d >= 0:
            kept.append(p)
        if (d >= 0) != (e >= 0):
            t = d / (d - e)
            kept.append(tuple(a + t * (b - a) for a, b in zip(p, q, strict=True)))
    return kept


def exact_samples(triangle: np.ndarray, depth: DepthRange) -> set[tuple[int, int]]:
    corners = [p for p in exact_polygon(triangle, depth) if p[3] > 0]
    snapped = [
        (round((x / w + 1) / 2 * SIZE * 256), round((1 - y / w) / 2 * SIZE * 256))
        for x, y, _, w in corners
    ]
    fan = [[snapped[0], *pair] for pair in pairwise(snapped[1:])]
    return covered(np.array(fan, np.int64)) if fan else set()


def our_samples(cut: Triangles) -> set[tuple[int, int]]:
    ndc = cut.corners[:, :, :2] / cut.corners[:, :, 3:]
    return covered(snap((ndc * [1, -1] + 1) / 2 * SIZE))


def covered(snapped: np.ndarray) -> set[tuple[int, int]]:
    found = cover(snapped, SIZE, SIZE)
    return set(zip(found.x.tolist(), found.y.tolist(), strict=True))


def disagreements(triangles: np.ndarray, depth: DepthRange) -> int:
    return sum(
        our_samples(clip(whole(t[None]), depth, SIZE, SIZE)) != exact_samples(t, depth)
        for t in triangles
    )


def random_triangles(count: int, seed: int, depth: DepthRange) -> np.ndarray:
    """Return triangles of which most cross the near plane, many of them the eye plane too."""
    rng = np.random.default_rng(seed)
    corners = rng.normal(size=(count, 3, 4)) * [2, 2, 2, 1.5] + [0, 0, 0, 0.5]
    if depth is DepthRange.REVERSED:
        corners[:, :, 2] = corners[:, :, 3] - corners[:, :, 2]
    return corners


DIRECTED = np.array(
    [
        # a corner on the near plane, on the eye plane, at the eye; edges in the near plane
        [[0, 0, -1, 1], [1, 0, 0, 1], [0, 1, 0, 1]],
        [[0, 0, -1, 1], [1, 0, -2, 1], [0, 1, 0, 1]],
        [[0, 0, -1, 1], [1, 0, -1, 1], [0, 1, 0, 1]],
        [[0, 0, -1, 1], [1, 0, -1, 1], [0, 1, -3, 1]],
        [[0.5, 0.5, 0, 0], [1, 0, 0, 1], [0, 1, 0, 1]],
        [[0, 0, 0, 0], [1, 0, 0, 1], [0, 1, 0, 1]],
        [[0, 0, 0, 0], [0, 0, 0, 0], [0, 1, 0, 1]],
        [[-1, -1, 2, -1], [1, -1, 0, 1], [0, 1, 0, 1]],
        [[-1, -1, 2, -1], [1, -1, 2, -1], [0, 1, 0, 1]],
        [[0.25, 0, 1, -0.75], [1, -1, 0.5, 2], [-1, 1, 0.5, 3]],
        # far outside of the guard band, on either side, and across all of it
        [[-1e7, 0, 0, 1], [1e7, 0.5, 0, 1], [0, 1e7, 0, 1]],
        [[1e7, 1, 0, 1], [1e8, 0, 0, 1], [1e7, 0, 0, 1]],
        [[-1e9, -1e9, 0, 1], [1e9, -1e9, 0, 1], [0, 1e9, 0, 1]],
        [[0, 0, 0, 1e-12], [1, 0, 0, 1], [0, 1, 0, 1]],
        [[1e-9, 1e-9, 0, 1e-12], [1, 0, 0, 1], [0, 1, 0, 1]],
        # degenerate: a line, a point, twice the same corner
        [[0, 0, -3, 1], [0.5, 0.5, 0, 1], [1, 1, 3, 1]],
        [[0, 0, 0, 1], [0, 0, 0, 1], [0, 0, 0, 1]],
        [[0, 0, -2, 1], [0, 0, -2, 1], [0.7, 0.2, 1, 1]],
        # behind everything, in front of everything
        [[0, 0, -2, 1], [1, 0, -2, 1], [0, 1, -2, 1]],
        [[-0.5, -0.5, 0, 1], [0.5, -0.5, 0, 1], [0, 0.5, 0, 1]],
    ],
    float,
)


@pytest.mark.parametrize("depth", DepthRange)
def test_random_triangles_are_cut_as_exact_arithmetic_cuts_them(depth: DepthRange) -> None:
    assert disagreements(random_triangles(250, 11, depth), depth) == 0


@pytest.mark.slow
@pytest.mark.parametrize("depth", DepthRange)
def test_ten_thousand_triangles_are_cut_exactly(depth: DepthRange) -> None:
    assert disagreements(random_triangles(10_000, 12, depth), depth) == 0


def test_directed_triangles_are_cut_exactly() -> None:
    assert len(DIRECTED) == 20
    assert disagreements(DIRECTED, DepthRange.MINUS_ONE_TO_ONE) == 0


def test_cutting_a_little_in_front_of_the_near_plane_is_noticed(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    right = clip_module._planes

    def shifted(depth: DepthRange, x: float, y: float) -> list[tuple[float, ...]]:
        near, *others = right(depth, x, y)
        return [(*near[:3], near[3] - 0.02), *others]

    monkeypatch.setattr(clip_module, "_planes", shifted)
    depth = DepthRange.MINUS_ONE_TO_ONE
    assert disagreements(random_triangles(250, 11, depth), depth) > 0


def different_cuts(count: int) -> int:
    """Count the shared edges that two neighbours cut at different points, bit for bit."""
    rng = np.random.default_rng(2)
    a, b, left, right = rng.normal(size=(4, count, 4)) * [3, 3, 3, 1] + [0, 0, 0, 1.5]
    a[:, 2] = np.abs(a[:, 2]) - a[:, 3]
    b[:, 2] = -np.abs(b[:, 2]) - b[:, 3]
    near = np.array([0.0, 0.0, 1.0, 1.0])
    found = 0
    # One apex lies inside and one outside: the first triangle has one corner outside, b, the
    # second one corner inside, a; each is cut from its odd corner.
    left[:, 2], right[:, 2] = 100.0, -100.0
    for i in range(count):
        one = clip_module._cut(whole(np.stack([a[i], b[i], left[i]])[None]), near)
        other = clip_module._cut(whole(np.stack([b[i], a[i], right[i]])[None]), near)
        corners = [{tuple(p) for t in cut.corners for p in t.tolist()} for cut in (one, other)]
        common = (corners[0] & corners[1]) - {tuple(a[i].tolist())}
        found += len(common) != 1
    return found


def test_neighbours_cut_their_edge_at_the_same_point() -> None:
    assert different_cuts(300) == 0


def test_cutting_from_the_first_end_would_leave_cracks(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(clip_module, "_is_larger", lambda a, b: np.zeros(len(a), bool))
    assert different_cuts(300) > 100
