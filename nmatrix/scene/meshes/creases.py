"""Creases: where the faces around a vertex turn too far, made normals are not smooth across it.

A smooth surface turns little from face to face; a cube turns by 90° at each edge, and a normal that
is the mean of three of its sides would shade it as a pillow. So each corner takes only those faces
around its vertex that turn from its own by no more than the crease angle.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.scene.meshes.mesh import unit

Array = NDArray[np.float64]
Indices = NDArray[np.integer[Any]]

CREASE_DEG = 50  # a cylinder of eight sides is smooth, a column of six has edges
MOST_FACES = 64  # around a vertex: with more it is the tip of a cone or the hub of a disc
TOGETHER = 1 << 21  # pairs of faces that are compared at once


def mean_normals(vertices: Indices, areas: Array) -> Array:
    """Return a unit normal (V, 3) per vertex: those of its faces, added up by their areas.

    `vertices` (C,) are those of corners, `areas` (C, 3) the normals of their faces, as long as the
    faces' areas. A vertex without any area gets the zero vector.

    Examples
    --------
    >>> mean_normals(np.array([0, 0, 1]), np.array([[0.0, 0, 3], [0, 4, 0], [1, 0, 0]])).tolist()
    [[0.0, 0.8, 0.6], [1.0, 0.0, 0.0]]
    """
    return unit(np.stack([np.bincount(vertices, one) for one in areas.T], axis=1))


def creased_normals(
    smooth: Array, vertices: Indices, faces: Indices, areas: Array
) -> tuple[Array, Indices]:
    """Make further normals for the corners at creases.

    Parameters
    ----------
    smooth
        (V, 3) the unit normal of each vertex, of all its faces.
    vertices, faces
        (C,) the vertex and the face of each corner.
    areas
        (F, 3) the normal of each face, as long as its area.

    Returns
    -------
    The smooth normals and below them those that were made (K, 3), and the one of each corner (C,).

    Examples
    --------
    >>> mean, sides = np.array([[0.0, 0.7, 0.7]]), np.array([[0.0, 0, 1], [0, 1, 0]])
    >>> found, at = creased_normals(mean, np.array([0, 0]), np.array([0, 1]), sides)
    >>> found[at].tolist()  # two faces that meet at a right angle
    [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0]]
    """
    turned = unit(areas)
    # Faces that are all within half of the angle of their mean are within the angle of each other.
    near = (turned[faces] * smooth[vertices]).sum(axis=1) >= np.cos(np.radians(CREASE_DEG / 2))
    count = np.bincount(vertices, minlength=len(smooth))
    is_creased = np.zeros(len(smooth), bool)
    is_creased[vertices[~near & areas[faces].any(axis=1)]] = True
    is_creased &= count <= MOST_FACES
    corners = np.flatnonzero(is_creased[vertices])
    corners = corners[np.argsort(vertices[corners], kind="stable")]
    if not len(corners):
        return smooth, vertices
    made = np.zeros((len(corners), 3))
    around = count[vertices[corners]]
    for size in np.unique(around):
        of_size = np.flatnonzero(around == size).reshape(-1, size)
        step = max(TOGETHER // (size * size), 1)
        for first in range(0, len(of_size), step):
            some = of_size[first : first + step]
            own = faces[corners[some]]
            cosines = np.einsum("mif,mjf->mij", turned[own], turned[own])
            joined = cosines >= np.cos(np.radians(CREASE_DEG))
            made[some] = np.einsum("mij,mjf->mif", joined, areas[own])
    made = unit(made.reshape(-1, 3))
    without = ~made.any(axis=1)  # a face without area goes along with the others
    made[without] = smooth[vertices[corners[without]]]
    at = vertices.copy()
    at[corners] = len(smooth) + np.arange(len(corners))
    return np.concatenate([smooth, made]), at
