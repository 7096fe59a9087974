"""Lines on meshes: isolines, creases and silhouettes as chains of points, and what of them is seen.

Vertices in the same place count as one, so that chains run across the seams of a mesh.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.raster.shading.normals import angles_deg, unit
from nmatrix.scene.meshes.mesh import Mesh
from nmatrix.scene.meshes.watertight import same_place

Array = NDArray[Any]

CREASE_DEG = 22.0
ROUNDING = 1e-9  # of depths that were computed in two ways
SHORTEST = 2.0  # pixels: shorter pieces between hidden ones are grazes, not lines


def isoline(points: Array, triangles: Array, values: Array) -> list[Array]:
    """Return the lines (k, 3) on a mesh where a function of its vertices is zero.

    The function is linear on every triangle, so the line crosses each by a straight piece, from
    edge to edge; triangles that share an edge meet in one point of it. The edge of the light is
    such a line, of n·l.

    Parameters
    ----------
    points, triangles, values
        (V, 3) places, (F, 3) indices, (V,) the function. A vertex at zero counts as above it.

    Examples
    --------
    >>> square = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    >>> (line,) = isoline(square, np.array([[0, 1, 2], [0, 2, 3]]), square[:, 0] - 0.25)
    >>> line[:, 0].tolist()
    [0.25, 0.25, 0.25]
    """
    place = _places(points)
    _, first, welded = np.unique(
        np.stack([place, values + 0.0], axis=1), axis=0, return_index=True, return_inverse=True
    )
    points, values, corners = points[first], values[first], welded.reshape(-1)[triangles]
    above = values >= 0
    cut = corners[above[corners].any(axis=1) & ~above[corners].all(axis=1)]
    edges = np.sort(np.stack([cut, np.roll(cut, -1, axis=1)], axis=2), axis=2)
    crossed = above[edges[..., 0]] != above[edges[..., 1]]
    pairs = edges[crossed].reshape(-1, 2, 2)  # each triangle is crossed on two edges
    unique, ends = np.unique(pairs.reshape(-1, 2), axis=0, return_inverse=True)
    a, b = values[unique[:, 0]], values[unique[:, 1]]
    part = np.divide(a, a - b, out=np.zeros_like(a), where=a != b)[:, None]
    places = points[unique[:, 0]] * (1 - part) + points[unique[:, 1]] * part
    return [places[chain] for chain in _chains(ends.reshape(-1, 2))]


@lru_cache(maxsize=8)
def creases(mesh: Mesh) -> tuple[Array, ...]:
    """Return the sharp edges of a mesh as chains of vertices: where normals jump, where it ends.

    An edge is sharp if the normals of the two triangles that share it differ by more than 22° at
    one of its ends. On a surface that is shaded smoothly there is none, however coarse it is.
    """
    edges, corners = edges_of(mesh), mesh.triangles.reshape(-1)
    sharp = edges.count != 2
    two = np.flatnonzero(~sharp)
    normals = unit(mesh.normals)
    for end in (0, 1):
        one, other = (
            normals[corners[half[two, end]]] for half in (edges.halves[0], edges.halves[1])
        )
        sharp[two] |= angles_deg(one, other) > CREASE_DEG
    return tuple(edges.vertex[chain] for chain in _chains(edges.ends[sharp]))


def silhouettes(mesh: Mesh, points: Array, eye: Array) -> list[Array]:
    """Return the edges between a triangle that faces the eye and one that does not, as chains.

    `points` (V, 3) are the vertices, and the chains (k, 3), where the eye is, in the world say.
    """
    edges = edges_of(mesh)
    a, b, c = (points[mesh.triangles[:, i]] for i in range(3))
    facing = (np.cross(b - a, c - a) * (eye - a)).sum(axis=1) > 0
    one, other = (facing[half[:, 0] // 3] for half in edges.halves)
    kept = (edges.count == 2) & (one != other)
    return [points[edges.vertex[chain]] for chain in _chains(edges.ends[kept])]


@dataclass(frozen=True, eq=False)
class Edges:
    """The edges of a mesh, by the places of their ends.

    `ends` (E, 2) are places, and `vertex` a vertex in each place. `halves` are two arrays (E, 2):
    the corners, numbered through all triangles, of the first triangle and of the second one there.
    `count` (E,) is the number of triangles that share the edge.
    """

    ends: Array
    vertex: Array
    halves: tuple[Array, Array]
    count: Array


@lru_cache(maxsize=8)
def edges_of(mesh: Mesh) -> Edges:
    """Return the edges of a mesh; triangles with two corners in one place have none."""
    _, vertex, place = np.unique(_places(mesh.positions), return_index=True, return_inverse=True)
    placed = place.reshape(-1)[mesh.triangles]
    whole = np.flatnonzero((placed != np.roll(placed, -1, axis=1)).all(axis=1))
    corners = whole[:, None, None] * 3 + np.array([[0, 1], [1, 2], [2, 0]])
    corners = corners.reshape(-1, 2)
    ends = placed.reshape(-1)[corners]
    turned = ends[:, 0] > ends[:, 1]
    ends[turned], corners[turned] = ends[turned][:, ::-1], corners[turned][:, ::-1]
    key = ends[:, 0] * len(vertex) + ends[:, 1]
    order = np.argsort(key, kind="stable")
    starts = np.flatnonzero(np.diff(key[order], prepend=-1))
    count = np.diff(starts, append=len(order))
    second = np.minimum(starts + 1, len(order) - 1)
    halves = corners[order[starts]], corners[order[second]]
    return Edges(ends[order[starts]], vertex, halves, count)


def visible_pieces(window: Array, farthest: Array) -> list[Array]:
    """Return the pieces (k, 3) of a line that lie in front of a surface or on it.

    The line is looked at once a pixel. It is seen if it is not behind the farthest surface of the
    3 × 3 pixels around it, by no more than depth changes from one pixel to the next there: so a
    line on a surface is seen also where the surface is steep, along an inner corner, and at a rim,
    where one of the nine is empty.

    Parameters
    ----------
    window
        (n, 3) pixels x and y and depth, 0 near and 1 far, which is linear between the points.
    farthest
        (height, width) the depth of the picture, infinite where something is empty.
    """
    steps = np.ceil(np.abs(np.diff(window[:, :2], axis=0)).max(axis=1)).astype(int).clip(1)
    if steps.sum() > 10 * sum(farthest.shape) + 1000:  # most of it lies outside
        steps = np.ones_like(steps)
    parts = [
        a + (b - a) * (np.arange(n) / n)[:, None]
        for a, b, n in zip(window[:-1], window[1:], steps, strict=True)
    ]
    line = np.concatenate([*parts, window[-1:]])
    shown = np.concatenate([[False], seen(line, farthest), [False]])
    turns = np.flatnonzero(shown[1:] != shown[:-1]).tolist()
    pieces = []
    for start, end in zip(turns[::2], turns[1::2], strict=True):
        piece = line[start:end]
        whole = start == 0 and end == len(line)
        if len(piece) > 1 and (whole or np.ptp(piece[:, :2], axis=0).max() >= SHORTEST):
            pieces.append(piece)
    return pieces


def seen(line: Array, farthest: Array) -> Array:
    """Return a mask of the points (n, 3) that lie in the picture and are not hidden.

    What is nearer than the near plane or beyond the far one is not in the picture.
    """
    height, width = farthest.shape
    column, row = np.floor(line[:, 0]).astype(int), np.floor(line[:, 1]).astype(int)
    inside = (column >= 0) & (column < width) & (row >= 0) & (row < height)
    inside &= np.abs(line[:, 2] - 0.5) <= 0.5 + ROUNDING
    around = np.stack(
        [
            farthest[(row + dy).clip(0, height - 1), (column + dx).clip(0, width - 1)]
            for dy in (-1, 0, 1)
            for dx in (-1, 0, 1)
        ]
    )
    deepest = around.max(axis=0)
    nearest = around.min(axis=0)
    change = np.subtract(deepest, nearest, out=np.zeros_like(nearest), where=deepest < np.inf)
    return np.asarray(inside & (line[:, 2] <= deepest + change / 2 + ROUNDING))


def _places(points: Array) -> Array:
    place = same_place(np.ascontiguousarray(points, np.float64))
    return np.arange(len(points)) if place is None else place


def _chains(pairs: Array) -> list[list[int]]:
    """Join pairs of ends to chains that are as long as they are unbranched."""
    near: defaultdict[int, list[int]] = defaultdict(list)
    for a, b in pairs.tolist():
        near[a].append(b)
        near[b].append(a)
    chains = []
    branching = [one for one, ends in near.items() if len(ends) != 2]
    for start in (*branching, *near):
        while near[start]:
            chain = [start, near[start].pop()]
            near[chain[1]].remove(start)
            while len(near[chain[-1]]) == 1:
                following = near[chain[-1]].pop()
                near[following].remove(chain[-1])
                chain.append(following)
            chains.append(chain)
    return chains
