"""Parts of a mesh file: polygons whose corners point into lists, made into one mesh a material.

A corner has a position and may have a normal, texture coordinates and a colour of its own; corners
that agree in all of them are one vertex.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.scene.material import Material
from nmatrix.scene.meshes.mesh import Mesh, area_weighted_normals, normals_made, unit
from nmatrix.scene.meshes.polygons import Cut, cut
from nmatrix.scene.words import VERTEX, NormalsFrom, counted

Array = NDArray[np.float64]
Indices = NDArray[np.integer[Any]]

NONE = -1  # the index of a corner that has no such value
FLAT = 0  # the smoothing group that smooths nothing
_MOST_KEYS = 1 << 62


@dataclass(frozen=True, eq=False)
class MeshPart:
    """The triangles of one material; the name is the material's, empty where there is none."""

    name: str
    mesh: Mesh
    material: Material | None = None


@dataclass(frozen=True, eq=False)
class MeshFile:
    """A mesh file: its parts, what has to be said of it, and where its normals come from.

    `named` are the files that it names: material libraries, or images.
    """

    parts: tuple[MeshPart, ...]
    remarks: tuple[str, ...]
    normals_from: NormalsFrom
    named: tuple[str, ...] = ()


def without_triangles(points: int, faces: int) -> tuple[str, str]:
    """Tell why a file has no surface, and what to do.

    Examples
    --------
    >>> without_triangles(3, 0)[0], without_triangles(3, 1)[0]
    ('it holds 3 points and no faces', 'it holds 1 face and none with three corners')
    """
    why = "it holds no triangles"
    if faces:
        why = f"it holds {counted(faces, 'face')} and none with three corners"
    elif points:
        why = f"it holds {counted(points, 'point')} and no faces"
    return why, "export its surface as faces"


@dataclass(frozen=True)
class Attribute:
    """Values (K, w), and the one of each corner (C,), or `NONE`."""

    values: Array
    at: Indices


@dataclass(frozen=True)
class Polygons:
    """The polygons of a file, corner by corner.

    Parameters
    ----------
    source
        The file's name, for remarks.
    positions
        (V, 3) places.
    corners
        (C,) the place of each corner, one polygon after the other.
    sizes
        (F,) the number of corners of each polygon, 3 at least.
    normals, uv, colours
        What the file says of corners.
    smoothing
        (F,) groups within which made normals are smooth; without any the whole surface is.
    """

    source: str
    positions: Array
    corners: Indices
    sizes: Indices
    normals: Attribute | None = None
    uv: Attribute | None = None
    colours: Attribute | None = None
    smoothing: Indices | None = None

    def parts(
        self, names: Sequence[str] = ("",), material: Indices | None = None
    ) -> tuple[tuple[MeshPart, ...], tuple[str, ...], NormalsFrom]:
        """Make the parts: `material` (F,) tells for each polygon which of the names is its own."""
        found = cut(self.positions, self.corners, self.sizes)
        normals, made = self._normals(found)
        remarks = [*made]
        if found.crossing:
            told = "polygon crosses itself" if found.crossing == 1 else "polygons cross themselves"
            remarks.append(f"{found.crossing:,} {told}: triangles of {self.source} overlap there.")
        parts = []
        bare = 0
        for index, name in enumerate(names):
            triangles = found.triangles
            if material is not None and len(names) > 1:
                triangles = triangles[material[found.polygon] == index]
            if not len(triangles):
                continue
            mesh, without = self._mesh(triangles, normals)
            bare += without
            parts.append(MeshPart(name, mesh))
        if bare:
            remarks.append(
                f"Texture coordinates are missing at {counted(bare, *VERTEX)}: 0 0 is taken."
            )
        return (
            tuple(parts),
            tuple(remarks),
            NormalsFrom.COMPUTED if made else NormalsFrom.FILE,
        )

    def _normals(self, found: Cut) -> tuple[Attribute, tuple[str, ...]]:
        """Find a normal for each corner: the file's, or one that is made of its polygons."""
        given = self.normals
        lacking = np.ones(len(self.corners), bool) if given is None else given.at == NONE
        if given is not None and not lacking.any():
            return Attribute(unit(given.values), given.at), ()
        triangles = found.triangles
        if given is not None:
            triangles = triangles[lacking[triangles].any(axis=1)]
        positions, at = self.positions, self.corners
        if self.smoothing is not None:
            group = np.repeat(self.smoothing, self.sizes)
            alone = int(self.smoothing.max(initial=0)) + 1
            own = alone + np.repeat(np.arange(len(self.sizes)), self.sizes)
            first, at = _vertices([self.corners, np.where(group == FLAT, own, group)])
            positions = positions[self.corners[first]]
        made = area_weighted_normals(positions, at[triangles])
        remarks = self._remarks_on_made(lacking)
        if given is None:
            return Attribute(made, at), remarks
        values = np.concatenate([unit(given.values), made])
        return Attribute(values, np.where(lacking, len(given.values) + at, given.at)), remarks

    def _remarks_on_made(self, lacking: NDArray[np.bool_]) -> tuple[str, ...]:
        """Tell that normals were made, and whether they are smooth or flat."""
        if self.smoothing is None:
            return (normals_made(self.source),)
        flat = np.repeat(self.smoothing == FLAT, self.sizes)[lacking]
        told = []
        if not flat.all():
            told.append(normals_made(self.source))
        if flat.any():
            told.append(f"Normals were made, flat: {self.source} has none and turns smoothing off.")
        return tuple(told)

    def _mesh(self, triangles: Indices, normals: Attribute) -> tuple[Mesh, int]:
        """Make one mesh of some triangles; the vertices without coordinates are counted."""
        places = triangles.ravel()
        others = [one for one in (normals, self.uv, self.colours) if one is not None]
        apart = [one.at[places] for one in others if one.at is not self.corners]
        first, vertex = _vertices([self.corners[places], *apart])
        kept = places[first]
        uv = without = None
        if self.uv is not None:
            at = self.uv.at[kept]
            without = at == NONE
            uv = np.where(without[:, None], 0.0, self.uv.values[at])
            if without.all():
                uv = without = None
        mesh = Mesh(
            self.positions[self.corners[kept]],
            normals.values[normals.at[kept]],
            vertex.reshape(-1, 3).astype(np.intp, copy=False),
            uv=uv,
            colours=None if self.colours is None else self.colours.values[self.colours.at[kept]],
        )
        return mesh, 0 if without is None else int(np.count_nonzero(without))


def _vertices(keys: Sequence[Indices]) -> tuple[Indices, Indices]:
    """Give corners that agree in all keys one number: the first of each, and the number of each.

    Examples
    --------
    >>> [one.tolist() for one in _vertices([np.array([2, 0, 2]), np.array([5, 5, 6])])]
    [[1, 0, 2], [1, 0, 2]]
    """
    leading = keys[0]
    first = np.full(int(leading.max(initial=0)) + 1, NONE)
    first[leading[::-1]] = np.arange(len(leading))[::-1]
    if all((key[first[leading]] == key).all() for key in keys[1:]):
        used = first != NONE
        return first[used], (np.cumsum(used) - 1)[leading]
    joint: NDArray[Any] = leading.astype(np.int64)
    most = len(first)
    for key in keys[1:]:
        span = int(key.max()) + 2
        if most * span > _MOST_KEYS:
            joint = np.unique(joint, return_inverse=True)[1]
            most = len(joint)
        joint, most = joint * span + key + 1, most * span
    _, first, vertex = np.unique(joint, return_index=True, return_inverse=True)
    return first, vertex
