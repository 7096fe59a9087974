"""R1 to R9: what rasterizers get wrong."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import DepthBuffer, Effect, Reflection
from nmatrix.linear.projection import DEFAULT_CLIP_SPACE
from nmatrix.raster.canvas import Canvas
from nmatrix.raster.fragments import exact_weights
from nmatrix.raster.lighting import Lighting, SpaceLamp
from nmatrix.raster.shading_space import Measure
from nmatrix.raster.spans import spans
from nmatrix.raster.spread import Spread
from nmatrix.raster.vertices import project
from nmatrix.raster.visibility import EMPTY, Tile
from nmatrix.scene.material import Material, grey
from nmatrix.scene.mesh import Mesh
from nmatrix.studies.hardcases.case import Case, Contestant, exactly, own

Array = NDArray[Any]
Compute = Callable[[], Sequence[float]]

SIZE = 64


def _case(
    id_: str,
    title: str,
    given: str,
    expected: tuple[Fraction, ...],
    reason: str,
    *answers: Contestant,
) -> Case:
    return Case(id_, title, given, expected, reason, answers)


# A floor from before the eye to behind it, under a field of view of 90°: w is 20, 20 and −8. Cut
# at w > 0 it fills the lower half of the picture less a triangle on either side.
FLOOR = np.array([[-5.0, -1, -20], [5, -1, -20], [0, -1, 8]])
AT_THE_EYE = np.array([[-5.0, -1, -20], [5, -1, -20], [0, -1, 0]])  # one corner has w = 0
FLAT = np.array([[-1.0, -1, -4], [0, 0, -4], [1, 1, -4]])  # no area
VIEW = np.array([[1.0, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1, -0.02], [0, 0, -1, 0]])


def _samples(corners: Array) -> list[float]:
    """Return how many samples of the picture a triangle covers."""
    mesh = Mesh(corners, np.tile([0.0, 1, 0], (3, 1)), np.array([[0, 1, 2]]))
    canvas = Canvas(SIZE, SIZE)
    tile = Tile.empty((0, SIZE), SIZE, DepthBuffer.FULL)
    tile.add(project(mesh, VIEW, canvas, DEFAULT_CLIP_SPACE), 0)
    return [float((tile.keys != EMPTY).sum())]


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
    """Divide by w at once, behind the eye too, and fill what comes out."""
    clip = np.c_[corners, np.ones(3)] @ VIEW.T
    x, y = clip[:, :2].T / clip[:, 3]
    px, py = (x + 1) * SIZE / 2 - 0.5, (1 - y) * SIZE / 2 - 0.5
    return [float(_filled(px, py, np.greater_equal).sum())]


def _filled(x: Array, y: Array, inside: Callable[[Array, float], Array]) -> Array:
    """Return which samples lie inside by edge functions of floats, whatever the winding."""
    rows, columns = np.mgrid[:SIZE, :SIZE].astype(float)
    edges = [
        (x[j] - x[i]) * (rows - y[i]) - (y[j] - y[i]) * (columns - x[i])
        for i, j in ((0, 1), (1, 2), (2, 0))
    ]
    front = np.all([inside(edge, 0.0) for edge in edges], axis=0)
    return np.asarray(front | np.all([inside(-edge, 0.0) for edge in edges], axis=0))


def _fan() -> tuple[Array, Array]:
    """Return triangles (3, N) around a sample, with corners on samples: every edge meets some."""
    rim = [(8, 8), (32, 6), (56, 10), (58, 32), (54, 56), (32, 58), (10, 54), (6, 32)]
    turned = [*rim[1:], rim[0]]
    x = np.array([[32.0] * len(rim), [p[0] for p in rim], [p[0] for p in turned]])
    y = np.array([[32.0] * len(rim), [p[1] for p in rim], [p[1] for p in turned]])
    return x, y


def _doubles(counts: Array) -> list[float]:
    return [float((counts > 1).sum())]


def _spans_twice() -> list[float]:
    x, y = _fan()
    counts = np.zeros((SIZE, SIZE))
    for found in spans(x * 256, y * 256, (0, SIZE), SIZE):
        for row, first, length in zip(found.row, found.first, found.length, strict=True):
            counts[int(row), int(first) : int(first) + int(length)] += 1
    return _doubles(counts)


def _edges_twice() -> list[float]:
    x, y = _fan()
    return _doubles(sum(_filled(x[:, i], y[:, i], np.greater_equal).astype(int) for i in range(8)))  # type: ignore[arg-type]  # eight arrays


AREAS = np.array([[1.0], [1.0], [1.0]])
NEAR = np.array([[1.0], [1e-12], [1e-12]])
TOTAL = Fraction(1) + 2 * Fraction(1e-12)
WEIGHTS = (Fraction(1) / TOTAL, Fraction(1e-12) / TOTAL, Fraction(1e-12) / TOTAL)


def _weights() -> list[float]:
    found = exact_weights(Spread(np.array([1])), (AREAS, np.zeros((3, 1))), NEAR)
    return list(map(float, found[:, 0]))


def _glow() -> list[float]:
    """Return the highlight of a face that the light does not reach, at shininess 0."""
    material = Material(reflection=Reflection.PHONG, shininess=0.0, specular=grey(1.0))
    on = frozenset({Effect.SPECULAR, Effect.EYE, Effect.POSITION})
    up, below = np.array([[0.0], [0], [1]]), np.array([[0.0], [0], [-1]])
    lamp = SpaceLamp(np.ones((1, 1)), to_light=below)
    lighting = Lighting(material, (lamp,), np.zeros((1, 1)), up * 5, Measure(), on)
    lit = lighting.light(up, np.zeros((3, 1)))
    return [float(lit.gloss[0, 0])] if lit.gloss is not None else [0.0]


CASES: tuple[Case, ...] = (
    _case(
        "R1",
        "a floor that passes the eye",
        "w = 20, 20, −8; samples of 64 × 64",
        (_true_samples(8),),
        "behind the eye a division by w turns everything around",
        own("clip, then divide", lambda: _samples(FLOOR)),
        Contestant("divide by w first", lambda: _divided_first(FLOOR)),
    ),
    _case(
        "R3",
        "a fan whose edges meet samples",
        "corners on samples; samples hit twice",
        exactly(0),
        "with ≥ an edge belongs to both its triangles",
        own("half-open spans", _spans_twice),
        Contestant("edge functions with ≥ 0", _edges_twice),
    ),
    _case(
        "R7",
        "weights under w from 1 to 10¹²",
        "equal areas, 1/w = 1, 10⁻¹², 10⁻¹²",
        WEIGHTS,
        "area alone is wrong by almost everything",
        own("exact weights", _weights),
        Contestant("affine weights", lambda: [1 / 3] * 3),
    ),
    _case(
        "R9",
        "a highlight on the dark side",
        "n·l < 0, shininess 0",
        exactly(0),
        "0⁰ is 1, and glows",
        own("gated by n·l", _glow),
        Contestant("max(r·v, 0)^s", lambda: [float(np.power(0.0, 0.0))]),
    ),
    _case(
        "R2",
        "a corner in the eye plane",
        "w = 20, 20, 0; samples of 64 × 64",
        (_true_samples(0),),
        "there is no place on the screen for w = 0",
        own("clip, then divide", lambda: _samples(AT_THE_EYE)),
        Contestant("divide by w first", lambda: _divided_first(AT_THE_EYE)),
    ),
    _case(
        "R6",
        "a triangle without area",
        "three corners on a line through samples; samples covered",
        exactly(0),
        "with ≥ the line itself counts as inside",
        own("half-open spans", lambda: _samples(FLAT)),
        Contestant("edge functions with ≥ 0", lambda: _divided_first(FLAT)),
    ),
)
