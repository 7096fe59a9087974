"""Triangles with positions and normals: checked when made, never changed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.errors import IllegalValueError, counted
from nmatrix.report import Vector
from nmatrix.scene.meshes.shell import Shell, shell_of
from nmatrix.scene.meshes.watertight import PART, same_place

Array = NDArray[np.float64]
Indices = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class Mesh:
    """A triangle mesh in object space.

    Parameters
    ----------
    positions, normals
        (V, 3) arrays; normals are unit vectors or zero where there is none.
    triangles
        (F, 3) indices, counter-clockwise seen from outside.
    uv
        (V, 2) texture coordinates, v upwards, if the mesh has them.
    colours
        (V, 3) linear colours in [0, 1], or (V, 4) with an opacity, if it has them.
    tangents
        (V, 4) tangent vectors and the sign of the bitangent, if it has them.
    built_as
        The kind of shell, if those who built it know: `known` sets it.
    remarks
        What was made because the file lacks it.
    """

    positions: Array
    normals: Array
    triangles: Indices
    uv: Array | None = None
    colours: Array | None = None
    tangents: Array | None = None
    remarks: tuple[str, ...] = ()
    built_as: Shell | None = field(default=None, init=False)

    def __post_init__(self) -> None:
        if self.positions.shape != self.normals.shape:
            raise IllegalValueError(
                f"a mesh of {counted(len(self.positions), 'position')} and "
                f"{counted(len(self.normals), 'normal')}",
                "each vertex has one of each",
                "export it again",
            )
        _check_finite(self.positions, "position")
        if self.uv is not None:
            _check_finite(self.uv, "texture coordinate")
        if len(self.triangles) == 0:
            raise IllegalValueError("a mesh", "it has no triangles", "nothing can be drawn")
        low, high = int(self.triangles.min()), int(self.triangles.max())
        if low < 0 or high >= len(self.positions):
            raise IllegalValueError(
                f"index {high if high >= len(self.positions) else low}",
                f"the mesh has {counted(len(self.positions), 'vertex', 'vertices')}",
                "export it again",
            )

    @cached_property
    def shell(self) -> Shell:
        """What is known of the surface as a whole; vertices in the same place count as one."""
        return self.built_as or shell_of(self.positions, self.triangles)

    @cached_property
    def normal_cosine(self) -> float:
        """The smallest cosine between the normals of one triangle's corners."""
        return least_cosine(self.normals.T, self.triangles)

    @cached_property
    def spread(self) -> Array:
        """The covariance (3, 3) of the vertices about their middle."""
        middle = self.positions.mean(axis=0)
        total = np.zeros((3, 3))
        for first in range(0, len(self.positions), PART):
            away = self.positions[first : first + PART] - middle
            total += away.T @ away
        return total / len(self.positions)

    @cached_property
    def box(self) -> tuple[Array, Array]:
        """The lowest and the highest coordinates."""
        return self.positions.min(axis=0), self.positions.max(axis=0)

    @cached_property
    def is_box(self) -> bool:
        """True if all triangles lie in faces of the box around them, and normals point out of it.

        Examples
        --------
        >>> from nmatrix.scene.meshes import shapes
        >>> shapes.box(3).is_box, shapes.cone().is_box
        (True, False)
        """
        few = self.normals[:: 1 + len(self.normals) // 16]
        if not (np.abs(few).max(axis=1) == 1.0).all():
            return False
        corners, normals = self.positions[self.triangles], self.normals[self.triangles]
        areas = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        found = np.zeros(len(self.triangles), bool)
        for side, sign in zip(self.box, (-1.0, 1.0), strict=True):
            for axis in range(3):
                on_face = (corners[:, :, axis] == side[axis]).all(axis=1)
                along = (normals[:, :, axis] == sign).all(axis=1)
                found |= on_face & along & (areas[:, axis] * sign > 0)
        return bool(found.all())

    @cached_property
    def sagitta(self) -> float:
        """How far the round surface that the normals feign rises above the triangles.

        An arc over an edge e, with normals m and n at its ends, rises by (n − m) · e / 8, and the
        surface over the middle of a triangle by a third more.

        Examples
        --------
        >>> from nmatrix.scene.meshes import shapes
        >>> shapes.box().sagitta
        0.0
        >>> 0.001 < shapes.sphere(48, 96).sagitta < 0.002
        True
        """
        normals = np.where(np.isfinite(self.normals), self.normals, 0.0)
        rise = 0.0
        for i in range(3):
            a, b = self.triangles[:, i - 1], self.triangles[:, i]
            turns = (normals[b] - normals[a]) * (self.positions[b] - self.positions[a])
            rise = max(rise, float(turns.sum(axis=1).max()))
        return rise / 6

    @cached_property
    def face_normals(self) -> Array:
        """The unit normal (F, 3) of each triangle, by its winding.

        A triangle without area has none of its own: it takes the mean of its vertices'.
        """
        own = unit(cross_products(self.positions, self.triangles))
        without = np.flatnonzero(~own.any(axis=1))
        if len(without):
            given = np.nan_to_num(self.normals[self.triangles[without]], posinf=0.0, neginf=0.0)
            own[without] = unit(given.mean(axis=1))
        return own

    @property
    def degenerate_normals(self) -> int:
        """The number of normals that are no direction, zero or not finite, of vertices in use."""
        return len(self._degenerate)

    @property
    def degenerate_at(self) -> Vector | None:
        """Where the first of these normals stands."""
        found = self._degenerate
        return tuple(self.positions[found[0]].tolist()) if len(found) else None

    @cached_property
    def _degenerate(self) -> Indices:
        """The vertices in use whose normal is no direction."""
        size = np.abs(self.normals).max(axis=1)
        bad = ~(np.isfinite(size) & (size > 0))
        if bad.any():
            used = np.zeros(len(bad), bool)
            used[self.triangles] = True
            bad &= used
        return np.flatnonzero(bad)


def least_cosine(normals: NDArray[Any], triangles: NDArray[Any]) -> float:
    """Find the smallest cosine between two normals (3, V) of one triangle.

    It is −1, the worst, where some normal is not of length one, to 1e-9.

    Examples
    --------
    >>> least_cosine(np.eye(3), np.array([[0, 1, 2], [0, 0, 1]]))
    0.0
    """
    x, y, z = normals
    if not bool((np.abs(x * x + y * y + z * z - 1.0) <= 1e-9).all()):
        return -1.0
    found = 1.0
    for first in range(0, len(triangles), PART):
        a, b, c = ([one.take(corner) for one in normals] for corner in triangles[first:][:PART].T)
        for p, q in ((a, b), (b, c), (c, a)):
            found = min(found, float((p[0] * q[0] + p[1] * q[1] + p[2] * q[2]).min()))
    return found


def known(mesh: Mesh, shell: Shell) -> Mesh:
    """Put down on a new mesh what kind of shell it was built as; a changed copy forgets it."""
    object.__setattr__(mesh, "built_as", shell)
    return mesh


def joined(parts: Sequence[Mesh]) -> Mesh:
    """Return one mesh of several; coordinates and colours stay where every part has them."""
    if len(parts) == 1:
        return parts[0]
    starts = np.cumsum([0, *(len(part.positions) for part in parts)])
    uv = [part.uv for part in parts if part.uv is not None]
    colours = [part.colours for part in parts if part.colours is not None]
    return Mesh(
        np.concatenate([part.positions for part in parts]),
        np.concatenate([part.normals for part in parts]),
        np.concatenate([part.triangles + s for part, s in zip(parts, starts, strict=False)]),
        uv=np.concatenate(uv) if len(uv) == len(parts) else None,
        colours=np.concatenate(colours) if len(colours) == len(parts) else None,
        remarks=tuple(dict.fromkeys(one for part in parts for one in part.remarks)),
    )


def unit(vectors: NDArray[Any]) -> Array:
    """Return the vectors at length one, however long they are; the zero vector stays zero.

    Examples
    --------
    >>> unit(np.array([[0.0, 3.0, 4.0], [0.0, 0.0, 0.0]])).tolist()
    [[0.0, 0.6, 0.8], [0.0, 0.0, 0.0]]
    """
    _, exponents = np.frexp(np.abs(vectors).max(axis=1, keepdims=True))
    scaled = np.ldexp(vectors, -exponents)  # exactly, so that no square overflows or vanishes
    length = np.sqrt((scaled * scaled).sum(axis=1, keepdims=True))
    return np.asarray(np.divide(scaled, length, out=np.zeros_like(scaled), where=length > 0))


MADE_SMOOTH = "Normals were made, smooth but for sharp edges"


def normals_made(source: str) -> str:
    """Tell that the normals are not those of the file: smooth, but for creases."""
    return f"{MADE_SMOOTH}: {source} lacks some or all."


def welded_normals(
    positions: NDArray[Any], triangles: NDArray[Any], face_normals: NDArray[Any]
) -> Array:
    """Return one unit normal (V, 3) for each place: its faces' normals, by their angles there.

    By angles and not by areas, so that it does not depend on how a face is cut into triangles.

    Examples
    --------
    >>> corner = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 0], [0, 1, 0], [0, 0, 1]])
    >>> faces = np.array([[0, 1, 2], [3, 4, 5]])
    >>> welded_normals(corner, faces, np.array([[0.0, 0, 1], [1, 0, 0]])).round(2).tolist()[0]
    [0.71, 0.0, 0.71]
    """
    place = same_place(positions)
    if place is None:
        place = np.unique(positions, axis=0, return_inverse=True)[1].reshape(-1)
    total = np.zeros((int(place.max()) + 1, 3))
    for i in range(3):
        corner, after, before = (triangles[:, (i + j) % 3] for j in range(3))
        a, b = (unit(positions[other] - positions[corner]) for other in (after, before))
        sine = np.sqrt((np.cross(a, b) ** 2).sum(axis=1))
        angle = np.arctan2(sine, (a * b).sum(axis=1))
        np.add.at(total, place[corner], face_normals * angle[:, None])
    return unit(total)[place]


def cross_products(positions: NDArray[Any], triangles: NDArray[Any]) -> Array:
    """Multiply the edges of triangles (F, 3) crosswise, scaled so that nothing overflows."""
    corners = positions[triangles]
    edges = corners[:, 1:] - corners[:, :1]
    _, exponents = np.frexp(np.abs(edges).max(axis=(1, 2), keepdims=True))
    edges = np.ldexp(edges, -exponents)
    return np.asarray(np.cross(edges[:, 0], edges[:, 1]))


def _check_finite(values: Array, what: str) -> None:
    if not np.isfinite(values).all():
        row = int(np.argwhere(~np.isfinite(values))[0][0])
        raise IllegalValueError(
            f"{what} {row} ({' '.join(map(str, values[row].tolist()))})",
            "it is not a finite number",
            "mend the mesh",
        )
