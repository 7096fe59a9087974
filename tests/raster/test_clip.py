"""Clipping against exact rational arithmetic; neighbours that share an edge agree along the cut."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from nmatrix.enums import DepthRange
from nmatrix.linear.projection import ClipSpace
from nmatrix.raster.triangles import clip as clip_module
from nmatrix.raster.triangles import vertices
from nmatrix.raster.triangles.clip import GUARD, clip, whole
from nmatrix.raster.triangles.spans import SUBPIXELS, Canvas, spans
from nmatrix.raster.triangles.vertices import Projected, project
from nmatrix.scene.meshes.mesh import Mesh

CANVAS = Canvas(32, 32)
ONE = np.zeros(1, np.intp)
Plane = tuple[Fraction | int, ...]
Point = tuple[Fraction, ...]
NEAR_AND_FAR = {
    DepthRange.MINUS_ONE_TO_ONE: ((0, 0, 1, 1), (0, 0, -1, 1)),
    DepthRange.ZERO_TO_ONE: ((0, 0, 1, 0), (0, 0, -1, 1)),
    DepthRange.REVERSED: ((0, 0, -1, 1), (0, 0, 1, 0)),
}


def exact_pieces(triangle: np.ndarray, depth: DepthRange) -> list[list[Point]]:
    """Cut by near, the eye plane, far and the guard band, one after the other, without rounding."""
    near, far = NEAR_AND_FAR[depth]
    band = Fraction(2 * int(GUARD), CANVAS.columns)
    sides = [(1, 0, 0, band), (-1, 0, 0, band), (0, 1, 0, band), (0, -1, 0, band)]
    found = [[tuple(map(Fraction, corner)) for corner in triangle.tolist()]]
    for plane in [near, (0, 0, 0, 1), far, *sides]:
        found = [piece for one in found for piece in cut_exactly(one, plane)]
    return found


def cut_exactly(triangle: list[Point], plane: Plane) -> list[list[Point]]:
    """Return the pieces inside; a quad is halved from the corner beside the one that is gone."""
    distance = [sum(a * b for a, b in zip(plane, p, strict=True)) for p in triangle]
    inside = [d >= 0 for d in distance]
    if sum(inside) in (0, 3):
        return [triangle] if inside[0] else []
    odd = inside.index(sum(inside) == 1)
    (p, d), (q, e), (r, f) = ((triangle[(odd + i) % 3], distance[(odd + i) % 3]) for i in range(3))
    pq = tuple(a + d / (d - e) * (b - a) for a, b in zip(p, q, strict=True))
    pr = tuple(a + d / (d - f) * (b - a) for a, b in zip(p, r, strict=True))
    return [[p, pq, pr]] if inside[odd] else [[pq, q, r], [pq, r, pr]]


def exact_samples(triangle: np.ndarray, depth: DepthRange) -> set[tuple[int, int]]:
    """Return the samples that the exact pieces cover, snapped."""
    half = Fraction(SUBPIXELS, 2)
    snapped = [
        [
            (
                round((x / w + 1) * CANVAS.columns * half - half),
                round((1 - y / w) * CANVAS.rows * half - half),
            )
            for x, y, _, w in piece
        ]
        for piece in exact_pieces(triangle, depth)
        if all(corner[3] > 0 for corner in piece)
    ]
    return covered(*np.array(snapped, float).transpose(2, 1, 0)) if snapped else set()


def our_samples(triangle: np.ndarray, depth: DepthRange) -> set[tuple[int, int]]:
    """Return the samples of one triangle of clip coordinates: a mesh of three unit vectors
    and a matrix that holds the corners as columns give them exactly.
    """
    mesh = Mesh(np.eye(3), np.zeros((3, 3)), np.array([[0, 1, 2]]))
    matrix = np.concatenate([triangle.T, np.zeros((4, 1))], axis=1)
    found = project(mesh, matrix, CANVAS, ClipSpace(depth))
    return covered(found.x[found.triangles], found.y[found.triangles])


def covered(x: np.ndarray, y: np.ndarray) -> set[tuple[int, int]]:
    """Return the samples of triangles with area; a sample that two take is a mistake."""
    found: list[tuple[int, int]] = []
    for one in spans(x, y, (0, CANVAS.rows), CANVAS.columns):
        rows, firsts, lengths = (part.astype(int).tolist() for part in one[1:])
        for row, first, length in zip(rows, firsts, lengths, strict=True):
            found += [(row, column) for column in range(first, first + length)]
    assert len(found) == len(set(found))
    return set(found)


def disagreements(triangles: np.ndarray, depth: DepthRange) -> int:
    return sum(our_samples(t, depth) != exact_samples(t, depth) for t in triangles)


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

    def shifted(depth: DepthRange, canvas: Canvas) -> list[tuple[float, ...]]:
        near, *others = right(depth, canvas)
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
        one = clip_module._cut(whole(np.stack([a[i], b[i], left[i]])[None], ONE), near)
        other = clip_module._cut(whole(np.stack([b[i], a[i], right[i]])[None], ONE), near)
        corners = [{tuple(p) for t in cut.corners for p in t.tolist()} for cut in (one, other)]
        common = (corners[0] & corners[1]) - {tuple(a[i].tolist())}
        found += len(common) != 1
    return found


def test_neighbours_cut_their_edge_at_the_same_point() -> None:
    assert different_cuts(300) == 0


def test_cutting_from_the_first_end_would_leave_cracks(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(clip_module, "_is_larger", lambda a, b: np.zeros(len(a), bool))
    assert different_cuts(300) > 100


def floor_under_the_eye(tilt: float) -> Projected:
    """Return a floor of many triangles that runs under the eye and far behind it, on the canvas."""
    rng = np.random.default_rng(8)
    steps = np.linspace(-1.0, 1.0, 18)
    x, z = np.meshgrid(steps, steps)
    x, z = (one + rng.uniform(-0.04, 0.04, one.shape) for one in (x, z))
    positions = np.stack([30 * x, -1 + tilt * x, 30 * z], axis=2).reshape(-1, 3)
    a = (np.arange(17)[:, None] * 18 + np.arange(17)).ravel()
    triangles = np.concatenate(
        [np.stack([a, a + 18, a + 1], 1), np.stack([a + 1, a + 18, a + 19], 1)]
    )
    matrix = np.array([[1.0, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1.02, -0.202], [0, 0, -1, 0]])
    mesh = Mesh(positions, np.zeros_like(positions), triangles)
    return project(mesh, matrix, CANVAS, ClipSpace())


@pytest.mark.parametrize("tilt", [0.0, 0.3, -1.0])
def test_a_floor_under_the_eye_has_no_cracks_and_no_doubles(tilt: float) -> None:
    found = floor_under_the_eye(tilt)
    assert found.cut is not None
    samples = covered(found.x[found.triangles], found.y[found.triangles])
    columns = [[row for row, column in samples if column == i] for i in range(CANVAS.columns)]
    assert len(samples) > 100
    assert all(rows == [] or len(rows) == max(rows) - min(rows) + 1 for rows in columns)


def test_nothing_divides_by_what_is_not_positive(monkeypatch: pytest.MonkeyPatch) -> None:
    divided = []
    right = vertices._divided

    def watched(corners: np.ndarray, *args: object) -> tuple[np.ndarray, ...]:
        divided.append(corners[3].min())
        return right(corners, *args)

    monkeypatch.setattr(vertices, "_divided", watched)
    for depth in DepthRange:
        for triangle in random_triangles(100, 5, depth):
            our_samples(triangle, depth)
    floor_under_the_eye(0.0)
    assert len(divided) == 301
    assert min(divided) > 0


@pytest.mark.parametrize("depth", DepthRange)
def test_what_is_left_lies_inside_and_is_made_of_its_own_corners(depth: DepthRange) -> None:
    corners = random_triangles(2000, 6, depth)
    cut = clip(whole(corners, np.arange(2000)), depth, CANVAS)
    assert len(cut.corners) > 200
    size = np.abs(cut.corners).max()
    for plane in NEAR_AND_FAR[depth]:
        assert (cut.corners @ np.array(plane) >= -1e-12 * size).all()
    assert np.abs(cut.weights.sum(axis=2) - 1).max() < 1e-9
    assert (cut.weights > -1e-12).all()
    rebuilt = np.einsum("nij,njk->nik", cut.weights, corners[cut.source])
    assert np.allclose(rebuilt, cut.corners, rtol=1e-9, atol=1e-9)
