"""Coverage: spans against exact integer edge functions, and meshes without gap or double."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from strategies import half_pixel_grids

from nmatrix.raster.triangles import spans as spans_module
from nmatrix.raster.triangles.spans import SUBPIXELS, Spans, spans

Array = np.ndarray
Triangles = tuple[Array, Array]  # x and y, (3, N) whole numbers of 1/256 sample

BAND = 1 << 23  # the guard band, in 1/256 sample
ROWS, COLUMNS = 9, 11


def hits(triangles: Triangles, rows: tuple[int, int], columns: int) -> Array:
    """Count the times that each triangle takes each sample, (N, rows, columns)."""
    x, y = triangles
    change = np.zeros((x.shape[1], rows[1] - rows[0], columns + 1), int)
    for found in spans(x.astype(float), y.astype(float), rows, columns):
        row, first = (found.row - rows[0]).astype(int), found.first.astype(int)
        np.add.at(change, (found.triangle, row, first), 1)
        np.add.at(change, (found.triangle, row, first + found.length), -1)
    return change.cumsum(axis=2)[:, :, :-1]


def edge_functions(triangles: Triangles, rows: tuple[int, int], columns: int) -> Array:
    """Count them by the top-left rule, in whole numbers below 2⁵³ throughout."""
    (xa, xb, xc), (ya, yb, yc) = (one.astype(np.int64) for one in triangles)
    area = (xb - xa) * (yc - ya) - (xc - xa) * (yb - ya)
    (xb, xc), (yb, yc) = (np.where(area < 0, [q, p], [p, q]) for p, q in ((xb, xc), (yb, yc)))
    inside = np.broadcast_to((area != 0)[:, None, None], (len(area), rows[1] - rows[0], columns))
    row = np.arange(*rows)[:, None] * SUBPIXELS
    column = np.arange(columns) * SUBPIXELS
    x, y = (np.stack(one)[:, :, None, None] for one in ([xa, xb, xc], [ya, yb, yc]))
    for i, j in ((0, 1), (1, 2), (2, 0)):
        dx, dy = x[j] - x[i], y[j] - y[i]
        is_left_or_top = (dy < 0) | ((dy == 0) & (dx > 0))
        inside = inside & (dx * (row - y[i]) - dy * (column - x[i]) >= ~is_left_or_top)
    return inside.astype(int)


def disagreements(triangles: Triangles, rows: tuple[int, int] = (0, ROWS)) -> int:
    """Count samples that spans take and edge functions do not, or the reverse, or twice."""
    ours, exact = hits(triangles, rows, COLUMNS), edge_functions(triangles, rows, COLUMNS)
    return int((ours != exact).sum())


def small(count: int, seed: int) -> Triangles:
    """Return triangles about as large as the canvas, many with corners on samples or halfway."""
    rng = np.random.default_rng(seed)
    grid = rng.choice([1, 64, 128, 256], count)
    x, y = rng.integers(-3 * SUBPIXELS, 14 * SUBPIXELS, (2, 3, count))
    return x // grid * grid, y // grid * grid


def near_misses(count: int, seed: int) -> Triangles:
    """Return triangles with an edge that crosses a row e/(256 h) from a sample, e = −1, 0 or 1.

    Nothing that is not on a sample can be closer. Runs go up to 2²⁴, heights down to 1.
    """
    rng = np.random.default_rng(seed)
    height = rng.integers(1, 1 << rng.integers(1, 24, count))
    below = rng.integers(0, np.minimum(height, BAND) + 1)  # how far the row is below the top
    coprime = np.gcd(below, height) == 1
    height, below = height[coprime], below[coprime]
    e = rng.integers(-1, 2, len(height))
    pairs = zip(below.tolist(), height.tolist(), strict=True)
    inverse = np.array([pow(d, -1, h) if h > 1 else 0 for d, h in pairs])
    reach = BAND // height
    run = e * inverse % height + height * rng.integers(-reach, reach + 1)
    x0 = (e - below * run) // height + SUBPIXELS * rng.integers(0, COLUMNS, len(height))
    y0 = SUBPIXELS * rng.integers(0, ROWS, len(height)) - below
    third = rng.integers(-BAND, BAND + 1, (2, len(height)))
    x, y = np.stack([x0, x0 + run, third[0]]), np.stack([y0, y0 + height, third[1]])
    kept = (np.abs(x) <= BAND).all(axis=0) & (np.abs(y) <= BAND).all(axis=0)
    return x[:, kept], y[:, kept]


def slivers(count: int, seed: int) -> Triangles:
    """Return triangles across the whole guard band, one or a few units high or wide."""
    rng = np.random.default_rng(seed)
    far = rng.choice([-BAND, BAND], (3, count)) + rng.integers(-9, 10, (3, count))
    far = np.clip(far, -BAND, BAND)
    thin = rng.integers(-2, 3, (3, count)) + SUBPIXELS * rng.integers(0, 9, count)
    return (far, thin) if seed % 2 else (thin, far)


SETS = [small(3000, 1), near_misses(20_000, 2), slivers(2000, 3), slivers(2000, 4)]


def turned(triangles: Triangles) -> Triangles:
    """Return triangles of the other winding, from another corner on."""
    x, y = triangles
    return x[[1, 0, 2]], y[[1, 0, 2]]


@pytest.mark.parametrize("triangles", SETS, ids=["small", "near misses", "flat", "upright"])
@pytest.mark.parametrize("way", [tuple, turned])
def test_spans_are_what_edge_functions_say(
    triangles: Triangles, way: Callable[[Triangles], Triangles]
) -> None:
    assert disagreements(way(triangles)) == 0


@pytest.mark.parametrize("rows", [(0, 1), (3, 7), (ROWS - 1, ROWS), (4, 4)])
def test_rows_may_be_cut_anywhere(rows: tuple[int, int]) -> None:
    for triangles in SETS:
        x, y = (one[:, :2000] for one in triangles)
        assert disagreements((x, y), rows) == 0


def test_the_sets_reach_the_limits_of_the_guard_band() -> None:
    x, y = SETS[1]
    height, run = np.abs(y[1] - y[0]), np.abs(x[1] - x[0])
    assert x.shape[1] > 5000
    assert height.min() == 1
    assert height.max() > 1 << 22
    assert run[height < 8].max() > 1 << 22
    assert (np.ptp(SETS[2][0], axis=0) >= (1 << 24) - 9).any()


def test_a_line_covers_nothing() -> None:
    corner = np.random.default_rng(5).integers(-500, 3000, (2, 1, 500))
    step = np.random.default_rng(6).integers(-400, 400, (2, 1, 500))
    x, y = corner + step * np.array([0, 3, -2])[:, None]
    assert not hits((x, y), (0, ROWS), COLUMNS).any()


def numpy_with(**changes: object) -> SimpleNamespace:
    """Return NumPy with some functions exchanged."""
    return SimpleNamespace(**{**vars(np), **changes})


def with_bias(times: float) -> Callable[..., spans_module.Edge]:
    """Return edges whose crossings are shifted by another share of the spacing."""
    right = spans_module._edge

    def edge(x0: Array, y0: Array, x1: Array, y1: Array) -> spans_module.Edge:
        start, slope = right(x0, y0, x1, y1)
        return spans_module.Edge(
            start + (1 - times) * 0.5 / (np.maximum(y1 - y0, 1) * SUBPIXELS), slope
        )

    return edge


def with_closed_ends(*args: object, right: Callable[..., Iterator[Spans]] = spans_module._rows):
    """Return spans that take the sample at their end too."""
    for found in right(*args):
        length = np.minimum(found.length + 1, args[-1] - found.first.astype(int))
        yield found._replace(length=length)


MUTANTS = {
    "no bias": ("_edge", with_bias(0.0)),
    "twice the bias": ("_edge", with_bias(2.0)),
    "bias to the right": ("_edge", with_bias(-1.0)),
    "rounding down": ("np", numpy_with(ceil=np.floor)),
    "closed rows": ("_first_sample", lambda y, rows: np.clip(np.floor(y / 256) + 1, *rows)),
    "closed right ends": ("_rows", with_closed_ends),
    "corners not sorted": ("_downwards", lambda x, y: [(x[i], y[i]) for i in range(3)]),
}


@pytest.mark.parametrize("name", MUTANTS)
def test_edge_functions_notice(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(spans_module, *MUTANTS[name])
    assert sum(map(disagreements, SETS)) > 0


def jittered_grid(size: int, cells: int, grid: int, seed: int) -> Triangles:
    """Return a mesh that covers all of a square canvas: shaken vertices, diagonals at random."""
    rng = np.random.default_rng(seed)
    cell = size * SUBPIXELS / (cells - 2)  # one cell stands out on each side
    place = np.arange(cells + 1)[:, None] * cell - cell
    shake = rng.uniform(-0.2, 0.2, (2, cells + 1, cells + 1)) * cell
    x, y = (
        np.rint(one / grid).astype(int) * grid for one in (place.T + shake[0], place + shake[1])
    )
    number = np.arange(x.size).reshape(x.shape)
    a, b, c, d = (
        one.ravel() for one in (number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1])
    )
    other = rng.random(len(a)) < 0.5
    a, b, c, d = (np.where(other, p, q) for p, q in ((a, b), (b, c), (c, d), (d, a)))
    triangles = np.concatenate([[a, b, c], [a, c, d]], axis=1)
    return x.ravel()[triangles], y.ravel()[triangles]


def fan(size: int, spokes: int, grid: int, seed: int) -> Triangles:
    """Return a fan around a point in the canvas, with a rim far outside of it."""
    rng = np.random.default_rng(seed)
    centre = np.rint(rng.uniform(0.3, 0.7, (2, 1)) * size * SUBPIXELS / grid) * grid
    turn = np.linspace(0, 2 * np.pi, spokes, endpoint=False)
    turn += rng.uniform(0, 1 / spokes, spokes)
    rim = np.rint((centre + np.array([np.cos(turn), np.sin(turn)]) * BAND * 0.7) / grid) * grid
    x, y = (
        np.stack([np.full(spokes, c), one, np.roll(one, -1)]).astype(int)
        for c, one in zip(centre[:, 0], rim, strict=True)
    )
    return x, y


def wrong_samples(mesh: Triangles, size: int) -> int:
    """Count the samples of a square canvas that a mesh does not take exactly once."""
    change = np.zeros((size, size + 1), np.int32)
    for found in spans(mesh[0].astype(float), mesh[1].astype(float), (0, size), size):
        row, first = found.row.astype(int), found.first.astype(int)
        np.add.at(change, (row, first), 1)
        np.add.at(change, (row, first + found.length), -1)
    return int((change.cumsum(axis=1)[:, :-1] != 1).sum())


def meshes(size: int, seed: int) -> list[Triangles]:
    found = []
    for grid in (1, 128, 256):
        found += [jittered_grid(size, cells, grid, seed) for cells in (12 + seed, size // 3)]
        found += [fan(size, spokes, grid, seed + spokes) for spokes in (12, 40, 97)]
    return found


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("way", [tuple, turned])
def test_meshes_take_each_sample_exactly_once(
    seed: int, way: Callable[[Triangles], Triangles]
) -> None:
    assert [wrong_samples(way(mesh), 256) for mesh in meshes(256, seed)] == [0] * 15


@pytest.mark.slow
@pytest.mark.parametrize("way", [tuple, turned])
def test_ten_million_samples_without_gap_or_double(way: Callable[[Triangles], Triangles]) -> None:
    size = 3200
    assert size * size >= 10**7
    assert [wrong_samples(way(mesh), size) for mesh in meshes(size, 7)] == [0] * 15


@pytest.mark.parametrize("name", ["no bias", "closed right ends", "corners not sorted"])
def test_meshes_notice(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(spans_module, *MUTANTS[name])
    assert sum(wrong_samples(mesh, 256) for mesh in meshes(256, 0)) > 0


@given(half_pixel_grids)
@settings(max_examples=25, deadline=None)
def test_half_pixel_grids_take_each_sample_exactly_once(triangles: Array) -> None:
    x, y = (triangles.transpose(2, 1, 0) * SUBPIXELS).astype(int)
    assert (hits((x, y), (0, 64), 64).sum(axis=0) == 1).all()
