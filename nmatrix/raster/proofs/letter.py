"""The letter R as a solid: what turns and what is mirrored is seen on it at once.

Its face is cut into quadrilaterals that share whole edges: the stem, two bars and half a ring for
the bowl, the leg. The walls stand on the edges that only one of them has.
"""

from __future__ import annotations

from collections import Counter
from functools import cache
from itertools import pairwise
from math import cos, pi, sin

import numpy as np

from nmatrix.scene.meshes.mesh import Mesh, known
from nmatrix.scene.meshes.shell import Shell

HALF_DEPTH = 0.24
STEM = (-0.62, -0.22)  # x
BARS = (-0.12, 0.24, 0.64, 1.0)  # y of the lower and of the upper bar of the bowl
BOWL = (0.12, 0.44)  # the middle of its half ring
OUTER, INNER = 0.56, 0.20  # its radii
LEG = (0.26, 0.66)  # x of its foot
FOOT = -1.0
STEPS = 24  # of the half ring

Place = tuple[float, float]
Edge = tuple[Place, Place]


@cache
def letter_r() -> Mesh:
    """Build the letter, two high and about its middle: flat but for the round walls of its bowl."""
    corners: list[tuple[float, float, float]] = []
    normals: list[tuple[float, float, float]] = []

    def wall(points: list[tuple[float, float, float]], across: list[tuple[float, ...]]) -> None:
        corners.extend(points)
        normals.extend((one[0], one[1], one[2]) for one in across)

    quads, count = _face(), Counter(edge for quad in _face() for edge in _sides(quad))
    for quad in quads:
        for z, loop in ((HALF_DEPTH, quad), (-HALF_DEPTH, quad[::-1])):
            wall([(x, y, z) for x, y in loop], [(0, 0, 1 if z > 0 else -1)] * 4)
    for a, b in count:
        if (b, a) in count:
            continue
        flat = b[1] - a[1], a[0] - b[0]
        size = float(np.hypot(*flat))
        across = [_round(one, (a, b)) or (flat[0] / size, flat[1] / size, 0.0) for one in (a, b)]
        wall(
            [(*a, HALF_DEPTH), (*a, -HALF_DEPTH), (*b, -HALF_DEPTH), (*b, HALF_DEPTH)],
            [across[0], across[0], across[1], across[1]],
        )
    first = np.arange(0, len(corners), 4)[:, None]
    triangles = np.concatenate([first + np.array([0, 1, 2]), first + np.array([0, 2, 3])])
    mesh = Mesh(np.array(corners), np.array(normals, float), triangles)
    return known(mesh, Shell.SOLID)  # the walls close the two faces, and no two parts cross


def _face() -> list[list[Place]]:
    """Return the quadrilaterals of the face, counter-clockwise."""
    (left, right), x, levels = STEM, BOWL[0], (FOOT, *BARS)
    quads = [
        [(left, low), (right, low), (right, high), (left, high)] for low, high in pairwise(levels)
    ]
    for low, high in (BARS[:2], BARS[2:]):
        quads.append([(right, low), (x, low), (x, high), (right, high)])
    rays = [_ray(i) for i in range(STEPS + 1)]
    for (a, b), (c, d) in pairwise(rays):
        quads.append([a, b, d, c])
    quads.append([(LEG[0], FOOT), (LEG[1], FOOT), (x, BARS[0]), (right, BARS[0])])
    return quads


def _ray(i: int) -> tuple[Place, Place]:
    """Return the points of the half ring on its inner and on its outer arc, from below upwards."""
    x, y = BOWL
    if i in (0, STEPS):  # the very corners of the bars
        return ((x, BARS[1]), (x, BARS[0])) if i == 0 else ((x, BARS[2]), (x, BARS[3]))
    turn = pi * (i / STEPS - 0.5)
    inner, outer = ((x + r * cos(turn), y + r * sin(turn)) for r in (INNER, OUTER))
    return inner, outer


def _sides(quad: list[Place]) -> list[Edge]:
    return list(zip(quad, (*quad[1:], quad[0]), strict=True))


def _round(place: Place, edge: Edge) -> tuple[float, float, float] | None:
    """Return the normal of the bowl's round wall at a place on it; None for a flat edge."""
    arms = [(one[0] - BOWL[0], one[1] - BOWL[1]) for one in edge]
    radii = [float(np.hypot(*one)) for one in arms]
    if min(one[0] for one in arms) < -1e-9:
        return None
    for radius, sign in ((OUTER, 1.0), (INNER, -1.0)):
        if all(abs(one - radius) < 1e-9 for one in radii):
            dx, dy = place[0] - BOWL[0], place[1] - BOWL[1]
            return sign * dx / radius, sign * dy / radius, 0.0
    return None
