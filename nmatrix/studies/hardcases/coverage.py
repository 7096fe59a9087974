"""The samples that triangles cover, each of them exactly once."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from math import cos, pi
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.linear.projection import DEFAULT_CLIP_SPACE, ClipSpace
from nmatrix.raster.triangles.spans import SUBPIXELS, Canvas
from nmatrix.raster.triangles.vertices import project
from nmatrix.raster.triangles.visibility import EMPTY, Tile
from nmatrix.scene.meshes.mesh import Mesh
from nmatrix.scene.words import DepthBuffer
from nmatrix.studies.hardcases.case import Case, Contestant, exactly, own

Array = NDArray[Any]
Inside = Callable[[Array, float], Array]
Cover = Callable[[Array], Array]
Naive = tuple[tuple[str, Cover], ...]

SIZE = 64
FRAME = np.arange(SIZE, dtype=float)

# A floor from before the eye to behind it, under a field of view of 90°: w is 20, 20 and −8. Cut
# at w > 0 it fills the lower half of the picture less a triangle on either side.
FLOOR = np.array([[-5.0, -1, -20], [5, -1, -20], [0, -1, 8]])
AT_THE_EYE = np.array([[-5.0, -1, -20], [5, -1, -20], [0, -1, 0]])  # one corner has w = 0
FLAT = np.array([[-1.0, -1, -4], [0, 0, -4], [1, 1, -4]])  # no area
VIEW = np.array([[1.0, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1, -0.02], [0, 0, -1, 0]])


def rasterized(
    corners: Array,
    matrix: Array,
    size: int = SIZE,
    clip: ClipSpace = DEFAULT_CLIP_SPACE,
    buffer: DepthBuffer = DepthBuffer.FULL,
) -> Array:
    """Draw triangles with corners (3 N, 3); the visibility keys (size, size) of the samples."""
    faces = np.arange(len(corners)).reshape(-1, 3)
    mesh = Mesh(corners, np.tile([0.0, 1, 0], (len(corners), 1)), faces)
    tile = Tile.empty((0, size), size, buffer)
    tile.add(project(mesh, matrix, Canvas(size, size), clip), 0)
    return np.asarray(tile.keys).reshape(size, size)


def drawn(corners: Array, matrix: Array) -> Array:
    """Return the rasterizer's coverage of one triangle, as 0 and 1 over the samples."""
    return np.asarray(rasterized(corners, matrix) != EMPTY).astype(int)


def drawn_flat(corners: Array) -> Array:
    """Return the rasterizer's coverage for corners (3, 2) in pixels; samples at whole numbers."""
    x, y = (corners.T + 0.5) / (SIZE / 2) - 1
    return drawn(np.stack([x, -y, np.zeros(3)], axis=1), np.eye(4))


def _edges(corners: Array, samples: Array) -> list[Array]:
    """Evaluate the three edge functions at all samples, in the type of the numbers given."""
    x, y = corners.T
    rows, columns = samples[:, None], samples[None]
    return [
        (x[j] - x[i]) * (rows - y[i]) - (y[j] - y[i]) * (columns - x[i])
        for i, j in ((0, 1), (1, 2), (2, 0))
    ]


def filled(corners: Array, inside: Inside, dtype: type = np.float64) -> Array:
    """Return the coverage by edge functions, whatever the winding, as 0 and 1 over the samples."""
    edges = _edges(corners.astype(dtype), FRAME.astype(dtype))
    front = np.all([inside(edge, 0.0) for edge in edges], axis=0)
    back = np.all([inside(-edge, 0.0) for edge in edges], axis=0)
    return np.asarray(front | back).astype(int)


def _in_whole_numbers(corners: Array) -> Array:
    """Return the coverage by edge functions of 64-bit fixed point, which wrap around silently."""
    fixed = np.rint(corners * SUBPIXELS).astype(np.int64)
    edges = _edges(fixed, (FRAME * SUBPIXELS).astype(np.int64))
    return np.asarray(np.all([edge > 0 for edge in edges], axis=0)).astype(int)


def _count(covered: Array) -> list[float]:
    return [float(covered.sum())]


def _true_samples(end: int) -> Fraction:
    """Count samples whose ray meets the floor before the eye; it ends in a point at z = end."""
    count = 0
    for row in range(SIZE):
        for column in range(SIZE):
            x = Fraction(2 * column + 1 - SIZE, SIZE)
            y = Fraction(SIZE - 2 * row - 1, SIZE)
            if y < 0:
                z = 1 / y  # the ray (x, y, −1) meets y = −1 at this z
                side = Fraction(5, 20 + end) * (end - z)
                count += -20 <= z <= end and abs(-x * z) <= side
    return Fraction(count)


def _divided_first(corners: Array) -> list[float]:
    """Divide by w before clipping, behind the eye too, and fill the result."""
    clip = np.c_[corners, np.ones(3)] @ VIEW.T
    x, y = clip[:, :2].T / clip[:, 3]
    pixels = np.stack([(x + 1) * SIZE / 2 - 0.5, (1 - y) * SIZE / 2 - 0.5], axis=1)
    return _count(filled(pixels, np.greater_equal))


def _floor(id_: str, title: str, given: str, corners: Array, end: int | None, reason: str) -> Case:
    return Case(
        id_,
        title,
        f"{given}; samples covered of 64 × 64",
        (Fraction(0) if end is None else _true_samples(end),),
        reason,
        (
            own("clip, then divide", lambda: _count(drawn(corners, VIEW))),
            Contestant("divide by w first", lambda: _divided_first(corners)),
        ),
    )


def once_case(
    id_: str,
    title: str,
    given: str,
    triangles: Array,
    reason: str,
    naive: Naive,
) -> Case:
    """Make a case of triangles (N, 3, 2) that fill the picture: doubles and gaps must be 0."""

    def counted(cover: Cover) -> Callable[[], list[float]]:
        def count() -> list[float]:
            hits = sum((cover(one) for one in triangles), np.zeros((SIZE, SIZE), int))
            return [float((hits > 1).sum()), float((hits == 0).sum())]

        return count

    return Case(
        id_,
        title,
        f"{given}; samples hit twice, samples missed",
        exactly(0, 0),
        reason,
        (
            own("half-open spans", counted(drawn_flat)),
            *(Contestant(name, counted(cover)) for name, cover in naive),
        ),
    )


def _edge_functions(name: str, dtype: type = np.float64) -> Naive:
    return (
        (f"{name} with ≥ 0", lambda one: filled(one, np.greater_equal, dtype)),
        (f"{name} with > 0", lambda one: filled(one, np.greater, dtype)),
    )


EDGES = _edge_functions("edge functions")


def fan(radius: float, centre: tuple[float, float] = (32.0, 32.0)) -> Array:
    """Return triangles (8, 3, 2) around a sample, whose inner edges run through samples."""
    rim = [(centre[0] + radius * _eighth(i), centre[1] + radius * _eighth(i - 2)) for i in range(8)]
    return np.array([[centre, rim[i], rim[(i + 1) % 8]] for i in range(8)])


def _eighth(i: int) -> float:
    """Return the cosine of so many eighths of a turn, to whole numbers: an octagon's corners."""
    return float(round(cos(i * pi / 4) * 1.4))


def halves(size: float) -> Array:
    """Return two triangles that meet in the picture's diagonal, with corners far outside."""
    a, b, c, d = (-size, -size), (size, -size), (size, size), (-size, size)
    return np.array([[a, b, c], [a, c, d]])


def half_pixel_grid(rng: np.random.Generator) -> Array:
    """Return triangles (N, 3, 2) of a bent grid whose corners lie on samples or between two."""
    cells = 8
    base = np.linspace(-2.0, SIZE + 1.0, cells + 1)
    x, y = np.meshgrid(np.rint(base * 2) / 2, np.rint(base * 2) / 2)
    bend = rng.integers(-3, 4, size=(2, cells - 1, cells - 1)) / 2
    x[1:-1, 1:-1] += bend[0]
    y[1:-1, 1:-1] += bend[1]
    p = np.stack([x, y], axis=2)
    found = []
    for i in range(cells):
        for j in range(cells):
            a, b, c, d = p[i, j], p[i, j + 1], p[i + 1, j + 1], p[i + 1, j]
            pair = ((a, b, c), (a, c, d)) if rng.integers(2) else ((a, b, d), (b, c, d))
            found += [one if rng.integers(2) else one[::-1] for one in pair]
    return np.array(found)


CASES: tuple[Case, ...] = (
    _floor(
        "R1",
        "a floor that passes the eye",
        "w = 20, 20, −8",
        FLOOR,
        8,
        "behind the eye a division by w turns everything around",
    ),
    _floor(
        "R2",
        "a corner in the eye plane",
        "w = 20, 20, 0",
        AT_THE_EYE,
        0,
        "there is no place on the screen for w = 0",
    ),
    once_case(
        "R3",
        "edges that meet samples",
        "a fan around a sample",
        fan(100.0),
        "with ≥ an edge belongs to both its triangles, with > to neither",
        EDGES,
    ),
    once_case(
        "R4",
        "the same with corners a million pixels away",
        "a fan around a sample, corners at 10⁶",
        fan(1e6),
        "float32 has no digits left for the samples themselves",
        _edge_functions("float32 edges", np.float32),
    ),
    once_case(
        "R5",
        "corners a billion pixels away",
        "two halves of a square, corners at ±10⁹",
        halves(1e9),
        "products of fixed-point numbers pass 2⁶³ and wrap; clip to a guard band first",
        (("64-bit fixed point", _in_whole_numbers),),
    ),
    _floor(
        "R6",
        "a triangle without area",
        "three corners on a line through samples",
        FLAT,
        None,
        "with ≥ the line itself counts as inside",
    ),
)
