"""Triangles with positions and normals: checked when made, never changed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.errors import IllegalValueError
from nmatrix.scene.meshes.shell import Shell, shell_of

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
        (V, 3) linear colours in [0, 1], if it has them.
    tangents
        (V, 4) tangent vectors and the sign of the bitangent, if it has them.
    built_as
        The kind of shell, if those who built it know: `known` sets it.
    """

    positions: Array
    normals: Array
    triangles: Indices
    uv: Array | None = None
    colours: Array | None = None
    tangents: Array | None = None
    built_as: Shell | None = field(default=None, init=False)

    def __post_init__(self) -> None:
        if self.positions.shape != self.normals.shape:
            raise IllegalValueError(
                f"a mesh of {len(self.positions)} positions and {len(self.normals)} normals",
                "each vertex has one of each",
                "export it again",
            )
        _check_finite(self.positions, "position")
        if len(self.triangles) == 0:
            raise IllegalValueError("a mesh", "it has no triangles", "nothing can be drawn")
        low, high = int(self.triangles.min()), int(self.triangles.max())
        if low < 0 or high >= len(self.positions):
            raise IllegalValueError(
                f"index {high if high >= len(self.positions) else low}",
                f"the mesh has {len(self.positions)} vertices",
                "export it again",
            )

    @cached_property
    def shell(self) -> Shell:
        """What is known of the surface as a whole; vertices in the same place count as one."""
        return self.built_as or shell_of(self.positions, self.triangles)

    @property
    def degenerate_normals(self) -> int:
        """The number of normals that are no direction: zero, or not finite."""
        size = np.abs(self.normals).max(axis=1)
        return int(np.count_nonzero(~(np.isfinite(size) & (size > 0))))


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


def area_weighted_normals(positions: NDArray[Any], triangles: NDArray[Any]) -> Array:
    """Return a unit normal per vertex: its triangles' cross products, added up.

    A cross product is twice the area times the normal, so large triangles count more. A vertex
    without any area gets the zero vector.
    """
    a, b, c = (positions[triangles[:, i]] for i in range(3))
    with np.errstate(all="ignore"):
        faces = np.cross(b - a, c - a)
        total = np.zeros((len(positions), 3))
        for i in range(3):
            np.add.at(total, triangles[:, i], faces)
        length = np.sqrt((total * total).sum(axis=1, keepdims=True))
        unit = total / length
    return np.where(np.isfinite(unit), unit, 0.0)


def _check_finite(values: Array, what: str) -> None:
    if not np.isfinite(values).all():
        row = int(np.argwhere(~np.isfinite(values))[0][0])
        raise IllegalValueError(
            f"{what} {row} ({' '.join(map(str, values[row].tolist()))})",
            "it is not a finite number",
            "mend the mesh",
        )
