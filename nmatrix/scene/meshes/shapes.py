"""Shapes with analytic normals, at a chosen tessellation; triangles wind outwards."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.scene.meshes.mesh import Indices, Mesh, known
from nmatrix.scene.meshes.shell import Shell

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
    away = np.sin(latitude)
    away[-1] = 0.0  # sin π is 1e-16 in floats, and the south pole would be a ring
    across, along = _around(sectors)
    positions = np.stack(
        [away * across, np.cos(latitude) * np.ones_like(across), away * along], axis=2
    ).reshape(-1, 3)
    triangles = _without_slivers(positions, _grid(rings, sectors))
    mesh = Mesh(positions, positions.copy(), triangles, _unit_square(rings, sectors))
    return known(mesh, Shell.SOLID)


def torus(rings: int = 32, sectors: int = 64, radius: float = 1.0, tube: float = 0.4) -> Mesh:
    """Return a torus about the y axis.

    Examples
    --------
    >>> float(torus().positions[:, 1].max())
    0.4
    """
    across, along = _around(sectors)
    sine, cosine = (one[:, None, None] for one in _around(rings))
    out = np.stack([across, 0 * across, along], axis=1)
    normals = sine * out + cosine * np.array([0.0, 1.0, 0.0])
    positions = radius * out + tube * normals
    mesh = Mesh(
        positions.reshape(-1, 3),
        normals.reshape(-1, 3),
        _grid(rings, sectors),
        _unit_square(rings, sectors),
    )
    return known(mesh, Shell.SOLID) if 0 < tube < radius else mesh


def plane(cells: int = 1) -> Mesh:
    """Return the square from −1 to 1 in x and z, facing up.

    Examples
    --------
    >>> plane().normals.tolist()[0]
    [0.0, 1.0, 0.0]
    """
    mesh = Mesh(*_face(np.array([0.0, 1.0, 0.0]), cells), _unit_square(cells, cells))
    return known(mesh, Shell.OPEN)


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
    uv = np.tile(_unit_square(cells, cells), (6, 1))
    mesh = Mesh(corners, np.concatenate(normals), np.concatenate(shifted), uv)
    return known(mesh, Shell.SOLID)


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
    across, along = _around(sectors)
    rim = np.stack([across, -np.ones_like(across), along], axis=1)
    between = (side + 0.5) * (2 * np.pi / sectors)
    slope = _sideways(np.sin(between), np.cos(between)), _sideways(across, along)
    down = np.array([0.0, -1.0, 0.0])
    positions = np.concatenate([np.tile(-down, (sectors, 1)), rim, rim, down[None]])
    normals = np.concatenate([*slope, np.tile(down, (sectors + 2, 1))])
    first, under = sectors + side, 2 * sectors + 1 + side
    mantle = np.stack([side, first, first + 1], axis=1)
    disc = np.stack([base + len(positions) - 1, under + 1, under], axis=1)
    turn = np.arange(sectors + 1) / sectors
    uv = np.concatenate(
        [
            np.stack([(side + 0.5) / sectors, np.ones(sectors)], axis=1),
            np.stack([turn, np.zeros(sectors + 1)], axis=1),
            (rim[:, [0, 2]] + 1) / 2,
            [[0.5, 0.5]],
        ]
    )
    mesh = Mesh(positions, normals, np.concatenate([mantle, disc]).astype(np.intp), uv)
    return known(mesh, Shell.SOLID)


def _around(sectors: int) -> tuple[Array, Array]:
    """Return sine and cosine of a full turn; the last is the first, bit for bit, so that it closes.

    Examples
    --------
    >>> [one[0] == one[-1] for one in _around(7)]
    [np.True_, np.True_]
    """
    turn = np.linspace(0, 2 * np.pi, sectors + 1)
    turn[-1] = 0.0
    return np.sin(turn), np.cos(turn)


def _unit_square(rings: int, sectors: int) -> Array:
    """Return texture coordinates for a grid: u along a row, v upwards."""
    u, v = np.meshgrid(np.arange(sectors + 1) / sectors, 1 - np.arange(rings + 1) / rings)
    return np.stack([u, v], axis=2).reshape(-1, 2)


def _sideways(across: Array, along: Array) -> Array:
    """Return the normals of the cone's side: it falls by 2 over 1, so they are (2, 1)/√5."""
    return np.asarray(
        np.stack([2 * across, np.ones_like(across), 2 * along], axis=1) / np.sqrt(5.0)
    )


def _face(normal: Array, cells: int) -> tuple[Array, Array, Indices]:
    """Return a square grid through the origin with this axis as its normal."""
    u = np.roll(normal, 1)
    v = np.cross(normal, u)
    step = (2 * np.arange(cells + 1) - cells) / cells  # symmetric, bit for bit
    positions = (step[None, :, None] * u - step[:, None, None] * v).reshape(-1, 3)
    return positions, np.tile(normal, (len(positions), 1)), _grid(cells, cells)


def _without_slivers(positions: Array, triangles: Indices) -> Indices:
    """Return the triangles that a pole does not shrink to a line."""
    a, b, c = (positions[triangles[:, i]] for i in range(3))
    return np.asarray(triangles[np.cross(b - a, c - a).any(axis=1)])


def _grid(rings: int, sectors: int) -> Indices:
    """Return two triangles for every cell of a grid: rows run down, columns right."""
    rows, columns = np.divmod(np.arange(rings * sectors), sectors)
    a = rows * (sectors + 1) + columns
    b, c = a + sectors + 1, a + 1
    lower = np.stack([a, b, b + 1], axis=1)
    upper = np.stack([a, b + 1, c], axis=1)
    return np.concatenate([lower, upper]).astype(np.intp)
