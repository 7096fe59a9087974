"""Tangents for normal maps: the direction in which u grows, for meshes that bring none."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.scene.meshes.mesh import Mesh

Array = NDArray[Any]


def with_tangents(mesh: Mesh) -> Mesh:
    """Return the mesh with a tangent (x, y, z, sign) at each vertex, if it has coordinates.

    On a triangle position is an affine function of u and v; t = ∂p/∂u and b = ∂p/∂v are the means
    over the triangles of a vertex, by area in the texture. t is made perpendicular to the normal
    n, and the sign is that of (n × t) · b.

    Examples
    --------
    >>> from nmatrix.scene.meshes.shapes import plane
    >>> with_tangents(plane()).tangents[0].tolist()
    [0.0, 0.0, 1.0, 1.0]
    """
    if mesh.uv is None or mesh.tangents is not None:
        return mesh
    along_u, along_v = _derivatives(mesh, mesh.uv)
    n = mesh.normals
    t = along_u - n * (n * along_u).sum(axis=1, keepdims=True)
    length = np.sqrt((t * t).sum(axis=1, keepdims=True))
    t = np.where(length > 0, t / np.where(length > 0, length, 1.0), _across(n))
    sign = np.where((np.cross(n, t) * along_v).sum(axis=1) < 0, -1.0, 1.0)
    return replace(mesh, tangents=np.concatenate([t, sign[:, None]], axis=1))


def _derivatives(mesh: Mesh, uv: Array) -> tuple[Array, Array]:
    """Return ∂p/∂u and ∂p/∂v at each vertex, of any length but the right direction."""
    p0, p1, p2 = (mesh.positions[mesh.triangles[:, i]] for i in range(3))
    w0, w1, w2 = (uv[mesh.triangles[:, i]] for i in range(3))
    (u1, v1), (u2, v2) = (w1 - w0).T[:, :, None], (w2 - w0).T[:, :, None]
    turn = np.sign(u1 * v2 - u2 * v1)  # the determinant's size is the weight
    faces = (
        ((p1 - p0) * v2 - (p2 - p0) * v1) * turn,
        ((p2 - p0) * u1 - (p1 - p0) * u2) * turn,
    )
    totals = []
    for face in faces:
        total = np.zeros_like(mesh.positions)
        for i in range(3):
            np.add.at(total, mesh.triangles[:, i], face)
        totals.append(total)
    return totals[0], totals[1]


def _across(normals: Array) -> Array:
    """Return a unit vector across each normal, for places where u does not grow."""
    least = np.eye(3)[np.abs(normals).argmin(axis=1)]
    found = np.cross(least, normals)
    length = np.sqrt((found * found).sum(axis=1, keepdims=True))
    return np.asarray(found / np.where(length > 0, length, 1.0))
