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
    return Mesh(positions, positions.copy(), _grid(rings, sectors))


def torus(rings: int = 32, sectors: int = 64, radius: float = 1.0, tube: float = 0.4) -> Mesh:
    """Return a torus about the y axis."""
    around = np.linspace(0, 2 * np.pi, sectors + 1)[None, :]
    turn = np.linspace(0, 2 * np.pi, rings + 1)[:, None]
    out = np.stack(
        [np.sin(around) + 0 * turn, 0 * around + 0 * turn, np.cos(around) + 0 * turn], axis=2
    )
    up = np.array([0.0, 1.0, 0.0])
    normals = np.sin(turn)[:, :, None] * out + np.cos(turn)[:, :, None] * up
    positions = radius * out + tube * normals
    return Mesh(positions.reshape(-1, 3), normals.reshape(-1, 3), _grid(rings, sectors))


def _grid(rings: int, sectors: int) -> Indices:
    """Return two triangles for every cell of a grid, without those that shrink to a line."""
    rows, columns = np.divmod(np.arange(rings * sectors), sectors)
    a = rows * (sectors + 1) + columns
    b, c = a + sectors + 1, a + 1
    lower = np.stack([a, b, b + 1], axis=1)
    upper = np.stack([a, b + 1, c], axis=1)
    return np.concatenate([lower, upper]).astype(np.intp)
