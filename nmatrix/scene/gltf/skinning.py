"""Vertices carried by joints: positions, normals and tangents by the blend of joint matrices."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]


@dataclass(frozen=True, eq=False)
class Vertices:
    """The vertices of a primitive and the attributes that it has, each (V, …), and its triangles.

    Normals may have any length, texture coordinates have v downwards.
    """

    positions: Array
    triangles: Array
    normals: Array | None = None
    tangents: Array | None = None
    uv: Array | None = None
    colours: Array | None = None


def blended(matrices: Array, joints: Array, weights: Array) -> Array:
    """Blend joint matrices (J, 3, 4) by the weights (V, K) of each vertex, brought to a sum of 1.

    A vertex without any weight follows its first joint.

    Examples
    --------
    >>> still = np.eye(4)[:3]
    >>> moved = still + [[0, 0, 0, 8], [0, 0, 0, 0], [0, 0, 0, 0]]
    >>> blended(np.array([still, moved]), np.array([[0, 1]]), np.array([[0.5, 1.5]]))[0, 0]
    array([1., 0., 0., 6.])
    """
    total = weights.sum(axis=1, keepdims=True)
    without = total[:, 0] == 0
    shares = np.divide(weights, total, out=np.zeros_like(weights), where=~without[:, None])
    shares[without, 0] = 1.0
    found = np.zeros((len(joints), 3, 4))
    for column in range(joints.shape[1]):
        found += shares[:, column, None, None] * matrices[joints[:, column]]
    return found


def carried(vertices: Vertices, blends: Array) -> Vertices:
    """Take each vertex where its blend (3, 4) takes it.

    Normals go by the cofactors of the blend's block, with the sign of its determinant, so that they
    stay outward where it mirrors; there triangles are turned around, and a tangent's sign with it.
    """
    block = blends[:, :, :3]
    a, b, c = (block[:, :, i] for i in range(3))
    cofactors = np.stack([np.cross(b, c), np.cross(c, a), np.cross(a, b)], axis=2)
    mirrors = (a * cofactors[:, :, 0]).sum(axis=1) < 0
    sign = np.where(mirrors, -1.0, 1.0)[:, None]
    turned = mirrors[vertices.triangles].all(axis=1)
    found = replace(
        vertices,
        positions=_each(block, vertices.positions) + blends[:, :, 3],
        triangles=np.where(turned[:, None], vertices.triangles[:, ::-1], vertices.triangles),
    )
    if vertices.normals is not None:
        found = replace(found, normals=sign * _each(cofactors, vertices.normals))
    if vertices.tangents is not None:
        along = _each(block, vertices.tangents[:, :3])
        length = np.sqrt((along * along).sum(axis=1, keepdims=True))
        along = np.divide(along, length, out=np.zeros_like(along), where=length > 0)
        found = replace(found, tangents=np.hstack([along, sign * vertices.tangents[:, 3:]]))
    return found


def _each(matrices: Array, vectors: Array) -> Array:
    """Multiply the i-th matrix (3, 3) and the i-th vector."""
    return np.asarray(np.einsum("nij,nj->ni", matrices, vectors))
