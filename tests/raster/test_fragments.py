"""Interpolation against exact fractions: weights to 8u, and sums where the plan has them."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

import numpy as np
import pytest

from nmatrix.enums import Effect
from nmatrix.linear.rational import identity
from nmatrix.raster.loaded_scene import loaded
from nmatrix.raster.planning.plan import planned
from nmatrix.raster.triangles import fragments as fragments_module
from nmatrix.raster.triangles.fragments import (
    Fragments,
    Grid,
    Interpolation,
    VertexOutputs,
    interpolate,
)
from nmatrix.raster.triangles.spans import SUBPIXELS, spans
from nmatrix.raster.triangles.vertices import Projected
from nmatrix.raster.triangles.visibility import Runs
from nmatrix.scene.camera import View
from nmatrix.scene.geometry import ShapeGeometry
from nmatrix.scene.lens import Lens
from nmatrix.scene.light import SceneLight
from nmatrix.scene.scene import Scene, SceneObject, Settings
from nmatrix.scene.words import LightKind, Shape

U = 2.0**-53
SIZE = 24
BAND = 1 << 23
# A row of samples that begins at a near corner and ends just before two far ones.
HARD = np.array([[0, 23 * 256 + 1, 23 * 256], [12 * 256, 12 * 256 - 3000, 12 * 256 + 1]])
RIGHT = fragments_module.exact_weights


def loose_triangles(count: int, ratio: float, seed: int, reach: int = SIZE * 256) -> Projected:
    """Return triangles with corners of their own, with w from 1 to `ratio`, and a hard one."""
    rng = np.random.default_rng(seed)
    x, y = rng.integers(-reach, reach + SIZE * SUBPIXELS, (2, 3 * count)).astype(float)
    inverse_w = ratio ** -rng.uniform(0, 1, 3 * count)
    nearest = rng.integers(0, 3, count)
    inverse_w[3 * np.arange(count) + nearest] = 1.0
    inverse_w[3 * np.arange(count) + (nearest + 1) % 3] = 1 / ratio
    x, y = np.append(x, HARD[0]), np.append(y, HARD[1])
    inverse_w = np.append(inverse_w, [1.0, 1 / ratio, 1 / ratio])
    numbers = np.arange(len(x)).reshape(-1, 3).T
    return Projected(x, y, np.full(len(x), 0.5), inverse_w, numbers)


def runs_of(projected: Projected) -> Runs:
    """Return everything that the triangles cover, as if nothing hid anything."""
    x, y = projected.x[projected.triangles], projected.y[projected.triangles]
    parts = [
        (one.triangle, one.row.astype(int), one.first.astype(int), one.length)
        for one in spans(x, y, (0, SIZE), SIZE)
    ]
    return Runs(*(np.concatenate(part) for part in zip(*parts, strict=True)))


def whose(projected: Projected, runs: Runs, found: Fragments) -> np.ndarray:
    """Return the triangle of each fragment: what a constant of the triangles says."""
    numbers = np.arange(projected.triangles.shape[1], dtype=float)[None]
    read = interpolate(projected, runs, Grid(SIZE), VertexOutputs(faces={"triangle": numbers}))
    assert (read.place == found.place).all()
    return read["triangle"][0].astype(int)


def weights_of(
    projected: Projected, interpolation: Interpolation
) -> tuple[np.ndarray, list[list[Fraction]]]:
    """Return weights (3, m) as attributes read them, and what they are exactly.

    Corner i of every triangle says 1 in channel i and 0 elsewhere.
    """
    runs = runs_of(projected)
    corners = np.tile(np.eye(3), projected.triangles.shape[1])
    read = VertexOutputs(points={"weights": corners}, interpolation=interpolation)
    found = interpolate(projected, runs, Grid(SIZE), read)
    triangles = whose(projected, runs, found)
    exact = [
        true_weights(projected, triangle, *divmod(sample, SIZE), interpolation)
        for triangle, sample in zip(triangles.tolist(), found.place.tolist(), strict=True)
    ]
    return found["weights"], exact


def true_weights(
    projected: Projected, triangle: int, row: int, column: int, interpolation: Interpolation
) -> list[Fraction]:
    corners = projected.triangles[:, triangle].tolist()
    x = [int(projected.x[i]) - SUBPIXELS * column for i in corners]
    y = [int(projected.y[i]) - SUBPIXELS * row for i in corners]
    areas = [abs(x[i - 2] * y[i - 1] - x[i - 1] * y[i - 2]) for i in range(3)]
    if interpolation is not Interpolation.AFFINE:
        areas = [
            a * Fraction(projected.inverse_w[i].item()) for a, i in zip(areas, corners, strict=True)
        ]
    total = sum(areas)
    return [Fraction(one) / total for one in areas]


def worst_relative(found: np.ndarray, exact: list[list[Fraction]]) -> float:
    """Return the largest error relative to each weight itself; a weight of zero must be zero."""
    worst = Fraction(0)
    for ours, right in zip(found.T.tolist(), exact, strict=True):
        for a, b in zip(ours, right, strict=True):
            assert b or not a
            worst = max(worst, abs(Fraction(a) / b - 1) if b else Fraction(0))
    return float(worst)


def worst_absolute(found: np.ndarray, exact: list[list[Fraction]]) -> float:
    """Return the largest error relative to the largest corner's value, which is 1."""
    return float(np.abs(found.T - np.array(exact, float)).max())


@pytest.mark.parametrize("ratio", [1.0, 256.0, 1e6, 1e12])
@pytest.mark.parametrize("reach", [SIZE * 256, BAND - SIZE * 256], ids=["small", "guard band"])
def test_exact_weights_err_by_eight_units_at_the_most(ratio: float, reach: int) -> None:
    projected = loose_triangles(20, ratio, 1, reach)
    found, exact = weights_of(projected, Interpolation.EXACT)
    assert found.shape[1] > 500
    assert ((found >= 0) & (found <= 1)).all()
    assert worst_relative(found, exact) <= 8 * U


def test_affine_weights_are_areas() -> None:
    found, exact = weights_of(loose_triangles(20, 1e12, 2), Interpolation.AFFINE)
    assert worst_absolute(found, exact) <= 8 * U


@pytest.mark.parametrize("ratio", [1.0, 16.0, 256.0])
@pytest.mark.parametrize("reach", [SIZE * 256, BAND - SIZE * 256], ids=["small", "guard band"])
def test_sums_err_by_rounding_alone_up_to_the_plans_ratio(ratio: float, reach: int) -> None:
    found, exact = weights_of(loose_triangles(30, ratio, 3, reach), Interpolation.SUMS)
    assert worst_absolute(found, exact) <= 1e-12


def test_sums_would_not_do_for_extreme_ratios() -> None:
    found, exact = weights_of(loose_triangles(20, 1e12, 1), Interpolation.SUMS)
    assert worst_relative(found, exact) > 1e4 * 8 * U
    assert worst_absolute(found, exact) > 1e-12


def single_precision(expansion: object, areas: np.ndarray, near: np.ndarray) -> np.ndarray:
    return RIGHT(expansion, areas, near.astype(np.float32).astype(float))


def normalised_by_area(expansion: object, areas: np.ndarray, near: np.ndarray) -> np.ndarray:
    start, growth = areas
    weights = expansion.ramps(start * near, growth * near)
    return weights / expansion.constants(start.sum(axis=0)[None])


def from_rounded_growth(expansion: object, areas: np.ndarray, near: np.ndarray) -> np.ndarray:
    start, growth = areas
    weights = expansion.ramps(start * near, growth * near)
    return weights / weights.sum(axis=0)


@pytest.mark.parametrize(
    "mutant", [single_precision, normalised_by_area, from_rounded_growth], ids=lambda f: f.__name__
)
def test_the_bound_of_weights_notices(
    mutant: Callable[..., np.ndarray], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(fragments_module, "exact_weights", mutant)
    found, exact = weights_of(loose_triangles(20, 1e12, 1), Interpolation.EXACT)
    assert (np.abs(found.T - np.array(exact, float)) > 8 * U * np.array(exact, float)).any()


def directions_and_points(projected: Projected) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(4)
    values = rng.normal(size=(3, len(projected.x)))
    read = VertexOutputs(points={"p": values}, directions={"d": values})
    found = interpolate(projected, runs_of(projected), Grid(SIZE), read)
    return found["p"], found["d"]


def test_directions_are_positive_multiples_of_points() -> None:
    points, directions = directions_and_points(loose_triangles(30, 64.0, 5))
    share = (points * directions).sum(axis=0) / (directions * directions).sum(axis=0)
    assert (share > 0).all()
    assert np.allclose(directions * share, points, rtol=1e-9, atol=1e-12)


def test_both_windings_read_the_same_and_know_their_side() -> None:
    one = loose_triangles(30, 64.0, 6)
    other = Projected(one.x, one.y, one.depth, one.inverse_w, one.triangles[::-1])
    values = np.random.default_rng(7).normal(size=(2, len(one.x)))
    for interpolation in Interpolation:
        read = VertexOutputs(points={"p": values}, interpolation=interpolation, front=1)
        a, b = (interpolate(p, runs_of(p), Grid(SIZE), read) for p in (one, other))
        assert (a.place == b.place).all()
        assert np.allclose(a["p"], b["p"], rtol=1e-12, atol=1e-13)
        assert (a["facing"] == -b["facing"]).all()
        assert set(np.unique(a["facing"])) == {-1.0, 1.0}


def weighs_exactly(gap: float) -> bool:
    """Plan a floor of one cell, seen from a gap before its edge: does it weigh exactly?"""
    scene = Scene(
        (SceneObject("floor", ShapeGeometry(Shape.PLANE, (1,)), identity(4)),),
        (SceneLight("bulb", LightKind.POINT, position=(0, 1, 0)),),
        View(eye=(0.0, 1.0, 1.0 + gap), target=(0.0, 1.0, 0.0)),
        Lens(fov_degrees=90, near=gap / 2, far=10.0),
        Settings(size=(16, 16)),
    )
    (body,) = planned(loaded(scene)).bodies
    ratio = (2 + gap) / gap
    assert f"up to {ratio:.3g}" in body.decisions[Effect.EXACT_WEIGHTS].because
    return Effect.EXACT_WEIGHTS in body.effects


def test_the_plan_weighs_exactly_where_sums_lose_too_much() -> None:
    assert not weighs_exactly(0.5)
    assert not weighs_exactly(2 / 254)
    assert weighs_exactly(2 / 258)
    assert weighs_exactly(1e-3)
