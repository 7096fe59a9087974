"""Weights, depth and light at one sample."""

from __future__ import annotations

from decimal import Decimal, localcontext
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import Effect, Reflection
from nmatrix.raster.shading.lighting import Lighting, ShadingLight
from nmatrix.raster.shading.space import Measure
from nmatrix.raster.triangles.fragments import exact_weights
from nmatrix.raster.triangles.run_expansion import RunExpansion
from nmatrix.raster.triangles.visibility import STEPS, TRIANGLE_BITS
from nmatrix.scene.material import Material, grey
from nmatrix.scene.words import DepthBuffer
from nmatrix.studies.hardcases.case import Case, Contestant, exactly, own
from nmatrix.studies.hardcases.coverage import SIZE, VIEW, rasterized
from nmatrix.studies.hardcases.oracle import exact_rows, root, solve

Array = NDArray[Any]

AREAS = np.array([[1.0], [1.0], [1.0]])
NEAR = np.array([[1.0], [1e-12], [1e-12]])
TOTAL = Fraction(1) + 2 * Fraction(1e-12)
WEIGHTS = (Fraction(1) / TOTAL, Fraction(1e-12) / TOTAL, Fraction(1e-12) / TOTAL)


def _weights() -> list[float]:
    found = exact_weights(RunExpansion(np.array([1])), (AREAS, np.zeros((3, 1))), NEAR)
    return list(map(float, found[:, 0]))


# A triangle from w = 16 to w = 1 whose corners lie on corners of the picture.
SLOPED = np.array([[-16.0, -16, -16], [4, -4, -4], [0, 1, -1]])
SAMPLE = (40, 32)  # row and column


def _depth_drawn() -> list[float]:
    code = int(rasterized(SLOPED, VIEW)[SAMPLE]) >> TRIANGLE_BITS
    return [code / STEPS[DepthBuffer.FULL]]


def _true_depth() -> tuple[Fraction, ...]:
    """Meet the sample's ray with the plane of the triangle, and take the window depth there."""
    row, column = SAMPLE
    ray = (Fraction(2 * column + 1 - SIZE, SIZE), Fraction(SIZE - 2 * row - 1, SIZE), Fraction(-1))
    plane = solve(exact_rows(SLOPED.tolist()), [Fraction(1)] * 3)  # plane · p = 1
    distance = 1 / sum((a * b for a, b in zip(plane, ray, strict=True)), Fraction(0))
    ndc = (Fraction(VIEW[2, 2]) * -distance + Fraction(VIEW[2, 3])) / distance
    return ((ndc + 1) / 2,)


def _depth_in_perspective() -> list[float]:
    """Interpolate depth with perspective weights, as attributes of vertices are."""
    row, column = SAMPLE
    clip = np.c_[SLOPED, np.ones(3)] @ VIEW.T
    x, y, z = (clip[:, :3] / clip[:, 3:]).T
    at = np.array([(2 * column + 1 - SIZE) / SIZE, (SIZE - 2 * row - 1) / SIZE, 1.0])
    weights = np.linalg.solve(np.stack([x, y, np.ones(3)]), at) / clip[:, 3]
    return [float((weights @ z / weights.sum() + 1) / 2)]


def _gloss(shininess: float, to_light: Array, eye: Array) -> list[float]:
    """Return the highlight at the origin of a face that looks along z."""
    material = Material(reflection=Reflection.PHONG, shininess=shininess, specular=grey(1.0))
    on = frozenset({Effect.SPECULAR, Effect.EYE, Effect.POSITION})
    light = ShadingLight(np.ones((1, 1)), to_light=to_light)
    lighting = Lighting(material, (light,), np.zeros((1, 1)), eye, Measure(), on)
    lit = lighting.light(UP, np.zeros((3, 1)))
    return [float(lit.gloss[0, 0])] if lit.gloss is not None else [0.0]


UP = np.array([[0.0], [0], [1]])
M, SHARP = 4001, 1_000_000
# (2m, 0, m² − 1) has the whole length m² + 1, so r·v is a fraction.
ASIDE = np.array([[2.0 * M], [0], [M * M - 1.0]])
COSINE = Fraction(M * M - 1, M * M + 1)


def _true_highlight() -> tuple[Fraction, ...]:
    with localcontext() as exact:
        exact.prec = 60
        power = (Decimal(COSINE.numerator) / Decimal(COSINE.denominator)) ** SHARP
    return (Fraction(power),)


def _float32_highlight() -> list[float]:
    return [float(np.float32(COSINE) ** np.float32(SHARP))]


SQUEEZED = np.diag([1.0, 0.25, 1.0])
NORMAL, TO_LIGHT = np.array([1.0, 1.0, 0.0]), np.array([0.3, 0.9, 0.2])


def _lit_in_object_space() -> list[float]:
    """Return n·l as the renderer computes it in object space, by the metric."""
    metric = Measure(SQUEEZED, np.linalg.inv(SQUEEZED).T)
    n = NORMAL[:, None] / metric.normal_length(NORMAL[:, None])
    to_light = np.linalg.solve(SQUEEZED, TO_LIGHT)[:, None]
    light = ShadingLight(np.ones((1, 1)), to_light=to_light / metric.vector_length(to_light))
    on = frozenset({Effect.DIFFUSE})
    white = Material(diffuse=grey(1.0))
    lighting = Lighting(white, (light,), np.zeros((1, 1)), UP, metric, on)
    return [float(lighting.light(n, None).matte[0, 0])]


def _by_transpose() -> list[float]:
    n, moved = NORMAL / np.linalg.norm(NORMAL), SQUEEZED.T @ TO_LIGHT
    return [float(n @ moved / np.linalg.norm(moved))]


def _true_lambert() -> tuple[Fraction, ...]:
    """Return A⁻ᵀn · l over both lengths, by the textbook."""
    n = solve(exact_rows(SQUEEZED.T.tolist()), [Fraction(x) for x in NORMAL.tolist()])
    light = [Fraction(x) for x in TO_LIGHT.tolist()]
    squares = sum((x * x for x in n), Fraction(0)) * sum((x * x for x in light), Fraction(0))
    return (sum((a * b for a, b in zip(n, light, strict=True)), Fraction(0)) / root(squares),)


CASES: tuple[Case, ...] = (
    Case(
        "R7",
        "weights under w from 1 to 10¹²",
        "equal areas, 1/w = 1, 10⁻¹², 10⁻¹²",
        WEIGHTS,
        "area alone is wrong by almost everything",
        (own("exact weights", _weights), Contestant("affine weights", lambda: [1 / 3] * 3)),
    ),
    Case(
        "R8",
        "depth on the screen",
        "a triangle from w = 16 to w = 1; window depth at row 40, column 32",
        _true_depth(),
        "z/w is linear on the screen; perspective weights are for what vertices say",
        (
            own("plane of depths", _depth_drawn),
            Contestant("perspective weights", _depth_in_perspective),
        ),
        within=1e-11,  # 38 bits are stored
    ),
    Case(
        "R9",
        "a highlight on the dark side",
        "n·l < 0, shininess 0",
        exactly(0),
        "0⁰ is 1, and glows",
        (
            own("gated by n·l", lambda: _gloss(0.0, -UP, 5 * UP)),
            Contestant("max(r·v, 0)^s", lambda: [float(np.power(0.0, 0.0))]),
        ),
    ),
    Case(
        "R10",
        "a shininess of a million",
        f"r·v = {COSINE.numerator}/{COSINE.denominator}, s = 10⁶",
        _true_highlight(),
        "a power multiplies the relative error of its base by s: float64 keeps ten digits",
        (
            own("float64", lambda: _gloss(float(SHARP), UP, ASIDE)),
            Contestant("float32", _float32_highlight),
        ),
        within=1e-9,  # s·u = 1.1e-10
    ),
    Case(
        "M3",
        "light by the course's Mᵀ",
        "scale 1 ¼ 1, n = (1, 1, 0)/√2, l = (0.3, 0.9, 0.2)",
        _true_lambert(),
        "a direction is a vector, and Mᵀ moves covectors",
        (own("object space", _lit_in_object_space), Contestant("Mᵀ l", _by_transpose)),
    ),
)
