"""Polygons as triangles: the cut covers the polygon once, in any plane, by exact areas."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from math import cos, pi, sin

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nmatrix.scene.meshes.polygons import LOOKS, MOST_FORCED, _Ring, cut, turn

ARROW = [(-2, 2), (0, 0), (2, 2), (0, 1.2)]
COMB = [(0, 0), (7, 0), (7, 3), (6, 3), (5, 1), (4, 3), (3, 1), (2, 3), (1, 1), (0, 3)]
KEYHOLE = [(0, 0), (4, 0), (4, 4), (0, 4), (0, 0), (1, 1), (1, 3), (3, 3), (3, 1), (1, 1)]
SPIRAL = [
    (0, 0),
    (5, 0),
    (5, 5),
    (1, 5),
    (1, 2),
    (3, 2),
    (3, 3),
    (2, 3),
    (2, 4),
    (4, 4),
    (4, 1),
    (0, 1),
]
NOTCHED = [(0, 0), (1, 0), (2, 0), (2, 2), (1, 2), (1, 1), (0, 1)]
PLANES = {
    "z": [(1, 0, 0), (0, 1, 0)],
    "x": [(0, 1, 0), (0, 0, 1)],
    "back": [(-1, 0, 0), (0, 1, 0)],
    "askew": [(1, 2, 2), (2, 1, -2)],
}


def double_area(points: list[tuple[Fraction, Fraction]]) -> Fraction:
    """Add up the shoelace terms exactly: twice the signed area."""
    pairs = zip(points, [*points[1:], points[0]], strict=True)
    return sum((a[0] * b[1] - b[0] * a[1] for a, b in pairs), Fraction(0))


def exact(points: list[tuple[float, float]]) -> list[tuple[Fraction, Fraction]]:
    return [(Fraction(x), Fraction(y)) for x, y in points]


def in_space(points: list[tuple[float, float]], plane: str) -> np.ndarray:
    u, v = (np.array(one, float) for one in PLANES[plane])
    return np.array([x * u + y * v for x, y in points])


def areas_of_cut(points: list[tuple[float, float]], triangles: np.ndarray) -> list[Fraction]:
    flat = exact(points)
    return [double_area([flat[i] for i in one]) for one in triangles.tolist()]


@pytest.mark.parametrize("plane", PLANES)
@pytest.mark.parametrize("points", [ARROW, COMB, KEYHOLE, SPIRAL, NOTCHED])
def test_a_concave_polygon_is_covered_once_from_any_start_and_either_way(
    points: list[tuple[float, float]], plane: str
) -> None:
    for turned in (points, points[::-1]):
        whole = double_area(exact(turned))
        for start in range(len(points)):
            ring = turned[start:] + turned[:start]
            found = cut(in_space(ring, plane), np.arange(len(ring)), np.array([len(ring)]))
            areas = areas_of_cut(ring, found.triangles)
            assert len(areas) == len(ring) - 2
            assert sum(areas) == whole
            assert all(area * whole >= 0 for area in areas)
            assert not found.crossing


@settings(max_examples=60, deadline=None)
@given(
    st.lists(st.floats(0.05, 1.0), min_size=4, max_size=24),
    st.sampled_from(sorted(PLANES)),
    st.floats(0, 1),
)
def test_any_polygon_around_a_point_is_covered_once(
    radii: list[float], plane: str, start: float
) -> None:
    angles = [2 * pi * (start + i) / len(radii) for i in range(len(radii))]
    ring = [(r * cos(a), r * sin(a)) for r, a in zip(radii, angles, strict=True)]
    found = cut(in_space(ring, "z"), np.arange(len(ring)), np.array([len(ring)]))
    areas = areas_of_cut(ring, found.triangles)
    assert sum(areas) == double_area(exact(ring))
    assert min(areas) >= 0
    tilted = cut(in_space(ring, plane), np.arange(len(ring)), np.array([len(ring)]))
    assert not tilted.crossing


def test_polygons_of_many_sizes_keep_their_order() -> None:
    points = in_space([*NOTCHED, *ARROW, *COMB], "askew")
    sizes = np.array([len(NOTCHED), 3, len(ARROW), len(COMB)])
    corners = np.array([*range(7), 0, 1, 3, *range(7, 21)])
    found = cut(points, corners, sizes)
    assert found.polygon.tolist() == [0] * 5 + [1] + [2] * 2 + [3] * 8
    starts = np.repeat(np.cumsum(sizes) - sizes, sizes - 2)
    ends = np.repeat(np.cumsum(sizes), sizes - 2)
    assert ((found.triangles >= starts[:, None]) & (found.triangles < ends[:, None])).all()


def test_polygons_that_cross_themselves_are_counted() -> None:
    bow = in_space([(0, 0), (2, 2), (2, 0), (0, 3)], "z")
    assert cut(bow, np.arange(4), np.array([4])).crossing == 1
    flat = np.zeros((5, 3))
    assert len(cut(flat, np.arange(5), np.array([5])).triangles) == 3


@settings(max_examples=200)
@given(
    st.lists(st.floats(-1e9, 1e9), min_size=6, max_size=6), st.sampled_from([0.0, 1e-300, 1e290])
)
def test_the_sense_of_a_turn_is_exact(numbers: list[float], scale: float) -> None:
    a, b = (numbers[0], numbers[1]), (numbers[2], numbers[3])
    for c in ((numbers[4], numbers[5]), (3 * b[0] - 2 * a[0], 3 * b[1] - 2 * a[1])):
        points = [(x * (scale or 1), y * (scale or 1)) for x, y in (a, b, c)]
        area = double_area(exact(points))
        assert turn(*points) == (area > 0) - (area < 0)


def star(count: int) -> list[tuple[float, float]]:
    """Place every second corner nearer to the middle."""
    return [
        (cos(2 * pi * i / count) * (1 - i % 2 / 9), sin(2 * pi * i / count) * (1 - i % 2 / 9))
        for i in range(count)
    ]


def teeth(count: int) -> list[tuple[float, float]]:
    return [*((i / count, float(i % 2)) for i in range(count - 1)), (0.5, -5.0)]


def anywhere(count: int) -> list[tuple[float, float]]:
    """Place corners at random, so that the polygon crosses itself all over."""
    return np.random.default_rng(7).random((count, 2)).tolist()


@pytest.mark.parametrize(
    ("shape", "most"), [(star, 3), (teeth, 3), (anywhere, LOOKS + MOST_FORCED)]
)
def test_looks_for_ears_grow_with_the_corners_whatever_the_shape(
    monkeypatch: pytest.MonkeyPatch, shape: Callable[[int], list], most: int
) -> None:
    looked = []
    look = _Ring._is_ear
    monkeypatch.setattr(_Ring, "_is_ear", lambda ring, at: looked.append(at) or look(ring, at))
    for count in (100, 400):
        looked.clear()
        points = shape(count)
        found = cut(in_space(points, "z"), np.arange(count), np.array([count]))
        whole = double_area(exact(points))
        assert abs(sum(areas_of_cut(points, found.triangles))) == abs(whole)
        assert bool(found.crossing) == (shape is anywhere)
        assert count - 3 <= len(looked) <= most * count


@pytest.mark.parametrize("plane", PLANES)
def test_a_bow_tie_crosses_itself_though_its_areas_cancel(plane: str) -> None:
    bow = in_space([(0, 0), (1, 1), (1, 0), (0, 1)], plane)
    assert cut(bow, np.arange(4), np.array([4])).crossing == 1
