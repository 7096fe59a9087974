"""Small meshes of every kind that surfaces come in, by dice: closed, open, inside out, bad."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import pi, sqrt
from random import Random
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from nmatrix.scene.meshes import shapes
from nmatrix.scene.meshes.creases import mean_normals
from nmatrix.scene.meshes.mesh import Mesh, cross_products, joined, unit

Array = NDArray[Any]
Thing = TypeVar("Thing")
Vector = tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class Dice:
    """A source of chance: one seed gives one row of throws, on every machine."""

    source: Random

    def between(self, low: float, high: float) -> float:
        return low + (high - low) * self.source.random()

    def power(self, low: float, high: float) -> float:
        """Throw a number whose power of ten lies between two."""
        return float(10.0 ** self.between(low, high))

    def whole(self, low: int, high: int) -> int:
        return low + int(self.source.random() * (high - low + 1))

    def chance(self, part: float) -> bool:
        return self.source.random() < part

    def one_of(self, things: Sequence[Thing]) -> Thing:
        return things[int(self.source.random() * len(things))]

    def vector(self, reach: float) -> Vector:
        x, y, z = (self.between(-reach, reach) for _ in range(3))
        return x, y, z

    def direction(self) -> Vector:
        """Throw a unit vector, each as likely as any other."""
        height, turn = self.between(-1, 1), self.between(0, 2 * pi)
        out = sqrt(1 - height * height)
        return out * float(np.cos(turn)), height, out * float(np.sin(turn))

    def array(self, rows: int, reach: float) -> Array:
        return np.array([self.vector(reach) for _ in range(rows)])


def area_weighted_normals(positions: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Return a unit normal per vertex, by the areas of its triangles."""
    areas = np.repeat(cross_products(positions, triangles), 3, axis=0)
    return mean_normals(triangles.ravel(), areas)


def closed(dice: Dice) -> Mesh:
    """Throw a closed surface, wound outwards."""
    coarse = dice.whole(3, 8)
    build: Sequence[Callable[[], Mesh]] = (
        lambda: shapes.sphere(coarse, 2 * coarse),
        lambda: shapes.torus(coarse, coarse + 3),
        lambda: shapes.box(dice.whole(1, 3)),
        lambda: shapes.cone(coarse + 2),
        lambda: _soldered(shapes.sphere(coarse, coarse)),
    )
    return dice.one_of(build)()


def opened(dice: Dice) -> Mesh:
    """Throw a surface with an edge: a sheet, or a closed one with a hole."""
    if dice.chance(0.4):
        return shapes.plane(dice.whole(1, 4))
    whole = closed(dice)
    hole = dice.whole(1, max(1, len(whole.triangles) // 2))
    return replace(whole, triangles=whole.triangles[hole:])


def turned(mesh: Mesh, *, turns_normals: bool) -> Mesh:
    """Wind every triangle the other way, and turn the normals with it or leave them."""
    normals = -mesh.normals if turns_normals else mesh.normals
    return replace(mesh, normals=normals, triangles=mesh.triangles[:, ::-1].copy())


def turned_shells(dice: Dice) -> Mesh:
    """Throw several closed surfaces in one mesh, one of them inside out; some lie in another."""
    parts = []
    for _ in range(dice.whole(2, 3)):
        away = 0.0 if dice.chance(0.5) else 1.5
        parts.append(_moved(closed(dice), dice.between(0.3, 1.2), dice.vector(away)))
    which = dice.whole(0, len(parts) - 1)
    parts[which] = turned(parts[which], turns_normals=dice.chance(0.7))
    return joined(parts)


def crossing(dice: Dice) -> Mesh:
    """Throw a closed surface that passes through itself; parts of its inside count negatively."""
    kinds = (_mirrored_prism, _figure_eight, _crumpled, _tetrahedron)
    return dice.one_of(kinds)(dice)


def ruined(dice: Dice, mesh: Mesh) -> Mesh:
    """Repeat vertices, and add triangles without area."""
    count = len(mesh.positions)
    twin = np.arange(count) + count
    some = np.array([[dice.chance(0.5)] * 3 for _ in mesh.triangles])
    triangles = np.where(some, twin[mesh.triangles], mesh.triangles)
    a, b = dice.whole(0, count - 1), dice.whole(0, count - 1)
    thin = np.array([[a, a, b], [a, b, a + count], [a, b, b], [b, b, b]])
    twice = [np.concatenate([one, one]) for one in (mesh.positions, mesh.normals)]
    uv = None if mesh.uv is None else np.concatenate([mesh.uv, mesh.uv])
    return Mesh(twice[0], twice[1], np.concatenate([triangles, thin]), uv)


def with_wild_normals(dice: Dice, mesh: Mesh) -> Mesh:
    """Exchange normals for any others: anywhere, nowhere, away from the face."""
    wild = unit(dice.array(len(mesh.normals), 1.0))
    tame = mesh.normals
    kinds = {
        "anywhere": wild,
        "nowhere": tame * np.array([[not dice.chance(0.4)] for _ in tame]),
        "averted": -tame,
        "some averted": tame * np.array([[-1.0 if dice.chance(0.3) else 1.0] for _ in tame]),
        "shaken": unit(tame + 0.6 * wild),
        "hardly shaken": unit(tame + dice.power(-9, -2) * wild),
    }
    return replace(mesh, normals=kinds[dice.one_of(list(kinds))])


def painted(dice: Dice, mesh: Mesh) -> Mesh:
    """Give each vertex a colour."""
    return replace(mesh, colours=0.5 + dice.array(len(mesh.positions), 0.5))


def _moved(mesh: Mesh, scale: float, by: Vector) -> Mesh:
    return replace(mesh, positions=mesh.positions * scale + np.array(by))


def _soldered(mesh: Mesh) -> Mesh:
    """Make one vertex of all in one place, with the mean of its faces' normals."""
    positions, place = np.unique(mesh.positions, axis=0, return_inverse=True)
    triangles = place.reshape(-1)[mesh.triangles]
    return Mesh(positions, area_weighted_normals(positions, triangles), triangles)


def _prism(below: Array, above: Array) -> Mesh:
    """Join two outlines (n, 2) at y = −1 and y = 1 by sides, and close both by a fan."""
    n = len(below)
    rim = [
        np.stack([one[:, 0], np.full(n, y), one[:, 1]], axis=1)
        for one, y in ((below, -1.0), (above, 1.0))
    ]
    positions = np.concatenate([*rim, [[0.0, -1.0, 0.0], [0.0, 1.0, 0.0]]])
    i = np.arange(n)
    j = (i + 1) % n
    faces = [
        (i, i + n, j),
        (j, i + n, j + n),
        (i, j, 0 * i + 2 * n),
        (j + n, i + n, 0 * i + 2 * n + 1),
    ]
    triangles = np.concatenate([np.stack(face, axis=1) for face in faces])
    return Mesh(positions, area_weighted_normals(positions, triangles), triangles)


def _outline(corners: int) -> Array:
    turn = np.arange(corners) * (2 * pi / corners)
    return np.stack([np.cos(turn), np.sin(turn)], axis=1)


def _mirrored_prism(dice: Dice) -> Mesh:
    """A prism whose upper end is the mirror image of the lower: the sides cross between them."""
    below = _outline(dice.whole(3, 7))
    return _prism(below, below * [-dice.between(0.2, 1.5), dice.between(0.5, 1.0)])


def _figure_eight(dice: Dice) -> Mesh:
    """A tube over a figure eight with lobes of unequal width."""
    turn = (np.arange(dice.whole(8, 14)) + 0.25) * (2 * pi / 12)
    x = np.cos(turn) * np.where(np.cos(turn) > 0, 1.0, dice.between(0.2, 1.0))
    below = np.stack([x, np.sin(2 * turn) / 2], axis=1)
    return _prism(below, below * dice.between(0.5, 1.0))


def _crumpled(dice: Dice) -> Mesh:
    """A sphere whose vertices are moved so far that it passes through itself."""
    ball = _soldered(shapes.sphere(4, 6))
    positions = ball.positions + dice.array(len(ball.positions), dice.between(0.2, 1.0))
    return Mesh(positions, area_weighted_normals(positions, ball.triangles), ball.triangles)


def _tetrahedron(dice: Dice) -> Mesh:
    """Four corners anywhere: as likely inside out as not."""
    positions = dice.array(4, 1.0)
    triangles = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
    return Mesh(positions, area_weighted_normals(positions, triangles), triangles)
