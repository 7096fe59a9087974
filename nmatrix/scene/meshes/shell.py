"""Shells: whether a surface is closed, and whether its triangles are turned outwards.

A closed surface winds around each place a whole number of times. A ray from far away meets the
front of a triangle where that number grows and its back where it shrinks, so backs stay hidden from
outside if the number is nowhere below 0. Closed alone is not enough: a shell may be inside out as a
whole, or in a lobe where it passes through itself.
"""

from __future__ import annotations

from collections.abc import Iterator
from enum import Enum, auto
from math import pi
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.scene.meshes.watertight import PART, is_watertight

Array = NDArray[Any]

ROUNDING = 1e-12  # of a sum of products: what is nearer to 0 has no sign


class Shell(Enum):
    """What is known of a surface as a whole.

    OPEN: some edge is not shared by two triangles. INSIDE_OUT: closed, around a negative volume.
    CLOSED: closed, and nothing more is known. SOLID: closed, and no back is seen from outside.
    """

    OPEN = auto()
    INSIDE_OUT = auto()
    CLOSED = auto()
    SOLID = auto()

    @property
    def is_closed(self) -> bool:
        """True if the surface has an inside."""
        return self is not Shell.OPEN


def shell_of(positions: Array, triangles: Array) -> Shell:
    """Tell what kind of shell some triangles make.

    A closed surface whose every triangle is seen from one place inside, once in each direction,
    winds once around its inside and not at all around the rest: it is solid.

    Examples
    --------
    >>> corners = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    >>> faces = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
    >>> [shell_of(corners, one).name for one in (faces, faces[:, ::-1], faces[:3])]
    ['SOLID', 'INSIDE_OUT', 'OPEN']
    """
    if not is_watertight(positions, triangles):
        return Shell.OPEN
    used = positions[np.unique(triangles)]
    centre, size = used.mean(axis=0), float(np.abs(used - used.mean(axis=0)).max())
    volume = scale = angle = 0.0
    is_star = True
    for a, b, c in _seen_from(centre, size, positions, triangles):
        sixths = _determinant(a, b, c)
        volume += float(sixths.sum())
        scale += float(np.abs(sixths).sum())
        is_star = is_star and bool((sixths > ROUNDING).all())
        angle += float(_solid_angle(sixths, a, b, c).sum()) if is_star else 0.0
    if volume < -ROUNDING * scale:
        return Shell.INSIDE_OUT
    return Shell.SOLID if is_star and round(angle / (4 * pi)) == 1 else Shell.CLOSED


def _seen_from(
    centre: Array, size: float, positions: Array, triangles: Array
) -> Iterator[tuple[Array, ...]]:
    """Yield the corners (n, 3) of triangles around a centre, their largest coordinate about 1."""
    for first in range(0, len(triangles), PART):
        corners = positions[triangles[first : first + PART]]
        apart = (corners != np.roll(corners, 1, axis=1)).any(axis=2).all(axis=1)
        around = (corners[apart] - centre) / (size or 1.0)
        yield around[:, 0], around[:, 1], around[:, 2]


def _determinant(a: Array, b: Array, c: Array) -> Array:
    """Multiply out a · (b × c) for each triangle: six times the volume under it."""
    return np.asarray((a * np.cross(b, c)).sum(axis=1))


def _solid_angle(sixths: Array, a: Array, b: Array, c: Array) -> Array:
    """Measure the solid angle that each triangle fills, by van Oosterom and Strackee's formula."""
    p, q, r = (np.sqrt((one * one).sum(axis=1)) for one in (a, b, c))
    dots = ((one * other).sum(axis=1) for one, other in ((a, b), (b, c), (c, a)))
    ab, bc, ca = dots
    return np.asarray(2 * np.arctan2(sixths, p * q * r + ab * r + bc * p + ca * q))
