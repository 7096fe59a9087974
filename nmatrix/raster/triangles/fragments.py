"""Fragments: the outputs of vertices, interpolated at every visible sample.

A sample's weight for a corner is the area of the triangle opposite to it: a whole number that
grows by a whole number from sample to sample, so it is exact however long the run. Times 1/w of
the corner, and over the sum of the three, it is the corner's share in the scene.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum, auto
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.raster.triangles.run_expansion import RunExpansion
from nmatrix.raster.triangles.spans import SUBPIXELS
from nmatrix.raster.triangles.vertices import Projected
from nmatrix.raster.triangles.visibility import Runs

Array = NDArray[Any]


class Interpolation(Enum):
    """The ways to mix the values of three corners.

    AFFINE: by area alone, which is right where w is the same everywhere. SUMS: what the corners
    add up to grows evenly along a row, so two numbers for each run are enough; it loses a few u
    times the ratio of the w's. EXACT: each weight by itself, to 8u for any w's.
    """

    AFFINE = auto()
    SUMS = auto()
    EXACT = auto()


@dataclass(frozen=True, eq=False)
class VertexOutputs:
    """Outputs of the vertex stage by name: (k, V) of vertices, (k, F) of triangles.

    Of `directions` any positive multiple will do, so they need no division. `front` is the sign
    of the area of front faces where the side is read too, as `facing`: 1 or −1.
    """

    points: Mapping[str, Array] = field(default_factory=dict)
    directions: Mapping[str, Array] = field(default_factory=dict)
    faces: Mapping[str, Array] = field(default_factory=dict)
    interpolation: Interpolation = Interpolation.SUMS
    front: int = 0


@dataclass(frozen=True)
class Grid:
    """The points of a picture that are shaded: every sample, or the middles of whole pixels.

    `columns` of them stand in a row from (`top`, `left`) on; a point and the next are `spacing`
    samples apart, and the first of all stands in the middle of its spacing × spacing samples.
    """

    columns: int
    top: int = 0
    left: int = 0
    spacing: int = 1

    def samples(self, index: Array) -> Array:
        """Return rows or columns of samples for those of the grid: whole numbers of 1/2."""
        return np.asarray(self.spacing * index + (self.spacing - 1) / 2)


@dataclass(frozen=True, eq=False)
class Fragments:
    """Some points of a grid: each one's place in it, row · columns + column, and its inputs."""

    place: Array
    values: Mapping[str, Array]

    def __len__(self) -> int:
        """Return the number of points."""
        return len(self.place)

    def __getitem__(self, name: str) -> Array:
        """Return one input by its name, (k, m)."""
        return self.values[name]


def interpolate(projected: Projected, runs: Runs, grid: Grid, outputs: VertexOutputs) -> Fragments:
    """Interpolate the outputs of vertices at every point of a grid's runs."""
    expansion = RunExpansion(runs.length)
    place = expansion.counted((runs.row - grid.top) * grid.columns + (runs.first - grid.left))
    corners = projected.corners(runs.triangle)
    *areas, side = _areas(projected, corners, runs, grid)
    is_affine = outputs.interpolation is Interpolation.AFFINE
    near = np.ones(()) if is_affine else projected.inverse_w.take(corners)
    of_runs = {name: one[:, runs.triangle] for name, one in outputs.faces.items()}
    if outputs.front:
        of_runs["facing"] = side[None] * outputs.front
    values = {name: expansion.constants(one) for name, one in of_runs.items()}
    if outputs.interpolation is Interpolation.EXACT:
        weights = exact_weights(expansion, areas, near)
        for name, one in {**outputs.points, **outputs.directions}.items():
            values[name] = _weighted(expansion, weights, one.take(corners, 1))
        return Fragments(place, values)
    start, growth = (one * near for one in areas)
    share = None
    for name, one in outputs.directions.items():
        values[name] = expansion.ramps(*_sums(one.take(corners, 1), start, growth))
    for name, one in outputs.points.items():
        if share is None:
            share = 1.0 / expansion.ramps(start.sum(0)[None], growth.sum(0)[None])
        values[name] = expansion.ramps(*_sums(one.take(corners, 1), start, growth))
        values[name] *= share
    return Fragments(place, values)


def exact_weights(expansion: RunExpansion, areas: Sequence[Array], near: Array) -> Array:
    """Return the weights (3, m) of the corners, in [0, 1].

    Three whole numbers, not negative, each times 1/w with one rounding, over their sum.
    """
    start, growth = areas
    weights = expansion.ramps(start, growth)
    weights *= expansion.constants(np.broadcast_to(near, start.shape))
    weights /= weights[0] + weights[1] + weights[2]
    return weights


def _weighted(expansion: RunExpansion, weights: Array, values: Array) -> Array:
    """Return corner values (k, 3, n), each times its weight (3, m)."""
    total = weights[0] * expansion.constants(values[:, 0])
    for i in (1, 2):
        total += weights[i] * expansion.constants(values[:, i])
    return np.asarray(total)


def _sums(values: Array, start: Array, growth: Array) -> tuple[Array, Array]:
    """Return the weighted sum of corner values (k, 3, n) where runs start, and its growth."""
    return _dot(values, start), _dot(values, growth)


def _dot(values: Array, weights: Array) -> Array:
    """Return the sum over three corners, in one order: no bit depends on the place in an array."""
    found = values[:, 0] * weights[0]
    found += values[:, 1] * weights[1]
    found += values[:, 2] * weights[2]
    return np.asarray(found)


def _areas(
    projected: Projected, corners: Array, runs: Runs, grid: Grid
) -> tuple[Array, Array, Array]:
    """Return the three areas at the first point of each run, their growth along it, their sign.

    Whole numbers below 2⁵³: exact. Their sign is taken out, so that both windings count alike.
    """
    x = projected.x.take(corners)
    y = projected.y.take(corners)
    x -= SUBPIXELS * grid.samples(runs.first)
    y -= SUBPIXELS * grid.samples(runs.row)
    area, growth = np.empty_like(x), np.empty_like(y)
    for i in range(3):  # the corners after i are i − 2 and i − 1, counted from the end
        np.multiply(x[i - 2], y[i - 1], out=area[i])
        area[i] -= x[i - 1] * y[i - 2]
        np.subtract(y[i - 2], y[i - 1], out=growth[i])
    sign = np.sign(area[0] + area[1] + area[2])
    area *= sign
    growth *= SUBPIXELS * grid.spacing * sign
    return area, growth, sign
