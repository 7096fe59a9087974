"""What is in front at every sample: one integer key of depth and triangle, and its minimum.

The minimum does not care about order, so any order of triangles gives the same picture.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.errors import IllegalValueError
from nmatrix.raster.cover import CENTRE, SUBPIXELS, cover, signed_areas

Array = NDArray[Any]

TRIANGLE_BITS = 24
DEPTH_STEPS = 2.0**38
EMPTY = np.iinfo(np.int64).max
# A chunk ends where either is reached, so that memory is bounded whatever the triangles' size.
CHUNK_TRIANGLES = 1 << 14
CHUNK_SAMPLES = 1 << 18


@dataclass(frozen=True, eq=False)
class Visible:
    """The visible triangle of every covered sample, and where in it the sample lies."""

    pixel: Array
    triangle: Array
    barycentric: Array
    fragments: int


def visible(points: Array, depth: Array, width: int, height: int) -> Visible:
    """Return what is seen of snapped triangles (N, 3, 2) with depths (N, 3), 0 in front, 1 behind.

    Depth is linear on the screen. Triangles without area cover nothing.
    """
    if len(points) >= 1 << TRIANGLE_BITS:
        raise IllegalValueError(
            f"{len(points)} triangles", "a picture holds 2²⁴ at the most", "split the mesh"
        )
    area = signed_areas(points)
    size = _box_samples(points, width, height)
    solid = np.flatnonzero((area != 0) & (size > 0))
    keys = np.full(width * height, EMPTY, np.int64)
    fragments = 0
    for chunk in _chunks(solid, size[solid]):
        found = cover(points[chunk], width, height)
        index = chunk[found.triangle]
        weights = barycentric(points, area, index, found.x, found.y)
        z = (weights * depth[index]).sum(axis=1)
        key = (np.clip(z, 0.0, 1.0) * DEPTH_STEPS).astype(np.int64) << TRIANGLE_BITS
        np.minimum.at(keys, found.y * width + found.x, key | index)
        fragments += len(index)
    pixel = np.flatnonzero(keys != EMPTY)
    index = keys[pixel] & ((1 << TRIANGLE_BITS) - 1)
    weights = barycentric(points, area, index, pixel % width, pixel // width)
    return Visible(pixel, index, weights, fragments)


def _box_samples(points: Array, width: int, height: int) -> Array:
    """Return how many samples lie in the box around each triangle: it covers no more."""
    low, high = points.min(axis=1), points.max(axis=1)
    first = np.clip((low - CENTRE) // SUBPIXELS, 0, [width, height])
    last = np.clip((high - CENTRE) // SUBPIXELS + 1, 0, [width, height])
    return np.asarray((last - first).prod(axis=1))


def _chunks(triangles: Array, samples: Array) -> list[Array]:
    """Cut a list of triangles where their boxes, or they themselves, become too many."""
    total = np.cumsum(samples) - samples
    by_size, by_number = total // CHUNK_SAMPLES, np.arange(len(total)) // CHUNK_TRIANGLES
    new = (np.diff(by_size) > 0) | (np.diff(by_number) > 0)
    return np.split(triangles, np.flatnonzero(new) + 1)


def barycentric(points: Array, area: Array, index: Array, x: Array, y: Array) -> Array:
    """Return the three weights of samples in their triangles: exact integer areas, one division."""
    sample = np.stack([x, y], axis=1) * SUBPIXELS + CENTRE
    a, b, c = (points[index, i] - sample for i in range(3))
    parts = [_cross(b, c), _cross(c, a), _cross(a, b)]
    return np.asarray(np.stack(parts, axis=1) / area[index][:, None])


def _cross(u: Array, v: Array) -> Array:
    return np.asarray(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0])
