"""Shapes with analytic normals, at a chosen tessellation; triangles wind outwards."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.scene.mesh import Indices, Mesh

Array = NDArray[Any]


def sphere(rings: int = 48, sectors: int = 96) -> Mesh:
    """Return the unit sphere; its normals are its positions.

    Examples
    --------
    >>> mesh = sphere(4, 8)
    >>> bool(abs((mesh.positions * mesh.normals).sum(axis=1) - 1).max() < 1e-12)
    True
    """
    latitude = np.linspace(0, np.pi, rings + 1)[:, None]
    longitude = np.linspace(0, 2 * np.pi, sectors + 1)[None, :]
    positions = np.stack(
        [
            np.sin(latitude) * np.sin(longitude),
            np.cos(latitude) * np.ones_like(longitude),
            np.sin(latitude) * np.cos(longitude),
        ],
        axis=2,
    ).reshape(-1, 3)
    return _without_slivers(positions, positions.copy(), _grid(rings, sectors))


def torus(rings: int = 32, sectors: int = 64, radius: float = 1.0, tube: float = 0.4) -> Mesh:
    """Return a torus about the y axis.

    Examples
    --------
    >>> float(torus().positions[:, 1].max())
    0.4
    """
    around = np.linspace(0, 2 * np.pi, sectors + 1)[None, :]
    turn = np.linspace(0, 2 * np.pi, rings + 1)[:, None]
    out = np.stack(
        [np.sin(around) + 0 * turn, 0 * around + 0 * turn, np.cos(around) + 0 * turn], axis=2
    )
    up = np.array([0.0, 1.0, 0.0])
    normals = np.sin(turn)[:, :, None] * out + np.cos(turn)[:, :, None] * up
    positions = radius * out + tube * normals
    return Mesh(positions.reshape(-1, 3), normals.reshape(-1, 3), _grid(rings, sectors))


def plane(cells: int = 1) -> Mesh:
    """Return the square from −1 to 1 in x and z, facing up.

    Examples
    --------
    >>> plane().normals.tolist()[0]
    [0.0, 1.0, 0.0]
    """
    return Mesh(*_face(np.array([0.0, 1.0, 0.0]), cells))


def box(cells: int = 1) -> Mesh:
    """Return the cube from −1 to 1; each face has its own vertices, so that edges stay sharp.

    Examples
    --------
    >>> len(box().positions), len(box().triangles)
    (24, 12)
    """
    outward = [sign * axis for axis in np.eye(3) for sign in (1.0, -1.0)]
    positions, normals, triangles = zip(*(_face(n, cells) for n in outward), strict=True)
    shifted = [t + i * len(positions[0]) for i, t in enumerate(triangles)]
    corners = np.concatenate([p + n for p, n in zip(positions, normals, strict=True)])
    return Mesh(corners, np.concatenate(normals), np.concatenate(shifted))


def cone(sectors: int = 64) -> Mesh:
    """Return a cone with its tip at (0, 1, 0), over a disc of radius 1 at y = −1.

    At the tip there is no normal: each sector has its own tip vertex, with the normal of the
    line through the sector's middle.

    Examples
    --------
    >>> mesh = cone(3)
    >>> mesh.positions[:, 1].min(), mesh.positions[:, 1].max()
    (np.float64(-1.0), np.float64(1.0))
    """
    side, base = np.arange(sectors), np.zeros(sectors, np.intp)
    around = np.linspace(0, 2 * np.pi, sectors + 1)
    rim = np.stack([np.sin(around), -np.ones_like(around), np.cos(around)], axis=1)
    slope = _sideways((around[:-1] + around[1:]) / 2), _sideways(around)
    down = np.array([0.0, -1.0, 0.0])
    positions = np.concatenate([np.tile(-down, (sectors, 1)), rim, rim, down[None]])
    normals = np.concatenate([*slope, np.tile(down, (sectors + 2, 1))])
    first, under = sectors + side, 2 * sectors + 1 + side
    mantle = np.stack([side, first, first + 1], axis=1)
    disc = np.stack([base + len(positions) - 1, under + 1, under], axis=1)
    return Mesh(positions, normals, np.concatenate([mantle, disc]).astype(np.intp))


def _sideways(around: Array) -> Array:
    """Return the normals of the cone's side: it falls by 2 over 1, so they are (2, 1)/√5."""
    out = np.stack([2 * np.sin(around), np.ones_like(around), 2 * np.cos(around)], axis=1)
    return np.asarray(out / np.sqrt(5.0))


def _face(normal: Array, cells: int) -> tuple[Array, Array, Indices]:
    """Return a square grid through the origin with this axis as its normal."""
    u = np.roll(normal, 1)
    v = np.cross(normal, u)
    step = np.linspace(-1, 1, cells + 1)
    positions = (step[None, :, None] * u - step[:, None, None] * v).reshape(-1, 3)
    return positions, np.tile(normal, (len(positions), 1)), _grid(cells, cells)


def _without_slivers(positions: Array, normals: Array, triangles: Indices) -> Mesh:
    """Return a mesh without the triangles that a pole shrinks to a line."""
    a, b, c = (positions[triangles[:, i]] for i in range(3))
    area = np.sqrt((np.cross(b - a, c - a) ** 2).sum(axis=1))
    # What is left of a pole triangle is rounding, 1e-16 of its neighbours.
    return Mesh(positions, normals, triangles[area > 1e-12 * area.max()])


def _grid(rings: int, sectors: int) -> Indices:
    """Return two triangles for every cell of a grid: rows run down, columns right."""
    rows, columns = np.divmod(np.arange(rings * sectors), sectors)
    a = rows * (sectors + 1) + columns
    b, c = a + sectors + 1, a + 1
    lower = np.stack([a, b, b + 1], axis=1)
    upper = np.stack([a, b + 1, c], axis=1)
    return np.concatenate([lower, upper]).astype(np.intp)
