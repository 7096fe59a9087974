"""Where an object's triangles come from: a shape, a mesh file, arrays that are there already.

These are small frozen values; `mesh` reads or builds the triangles, and only then is NumPy loaded.
A reader of other files brings a value of its own.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from nmatrix.errors import IllegalValueError, MissingPackageError, NMatrixError
from nmatrix.scene.words import Shape

if TYPE_CHECKING:
    from nmatrix.scene.meshes.mesh import Mesh

MOST_NAMED = 3  # parts that a remark names


class DamagedPartError(IllegalValueError):
    """A part of a file cannot be drawn, while the rest of the file can.

    `part` names it and `cause` is why.
    """

    def __init__(self, path: Path, part: str, cause: NMatrixError) -> None:
        what, why, next_step = cause.parts
        where = what.removeprefix(f"{path}").strip(" ()")
        self.part, self.cause = part, cause
        self.reason = f"{where}: {why}" if where else why
        if isinstance(cause, MissingPackageError):
            self.reason, next_step = f"{self.reason} ({next_step})", ""
        super().__init__(f"{path} ({part})", self.reason, next_step)


def left_out(faults: Iterable[DamagedPartError], made: str = "drawn") -> tuple[str, ...]:
    """Tell in a sentence for each reason which parts of a file are not drawn, or not used.

    Examples
    --------
    >>> cause = IllegalValueError("a.gltf (buffer 0, a.bin)", "no such file")
    >>> left_out(DamagedPartError(Path("a.gltf"), f"mesh {i}", cause) for i in range(5))
    ('5 parts are not drawn (mesh 0; mesh 1; mesh 2; …): buffer 0, a.bin: no such file.',)
    """
    parts: dict[str, dict[str, None]] = {}
    for one in faults:
        parts.setdefault(one.reason, {})[one.part] = None
    return tuple(
        f"{next(iter(names))} is not {made}: {reason}."
        if len(names) == 1
        else f"{len(names)} parts are not {made} ({_listed(list(names))}): {reason}."
        for reason, names in parts.items()
    )


def _listed(names: list[str]) -> str:
    return "; ".join(names if len(names) <= MOST_NAMED else [*names[:MOST_NAMED], "…"])


class Geometry(Protocol):
    """Anything that has triangles."""

    def mesh(self) -> Mesh:
        """Build or read the triangles.

        Raises
        ------
        DamagedPartError
            If these triangles cannot be drawn, and what else the file has can.
        """


@dataclass(frozen=True)
class ShapeGeometry:
    """A shape with analytic normals, cut as finely as `tessellation` says; empty means its default.

    Sphere and torus take rings and sectors, a cone its sectors, plane and box cells along an edge.
    """

    shape: Shape
    tessellation: tuple[int, ...] = ()

    def mesh(self) -> Mesh:
        """Build the triangles."""
        from nmatrix.scene.meshes import shapes

        build: dict[Shape, Callable[..., Mesh]] = {
            Shape.SPHERE: shapes.sphere,
            Shape.TORUS: shapes.torus,
            Shape.PLANE: shapes.plane,
            Shape.BOX: shapes.box,
            Shape.CONE: shapes.cone,
        }
        return build[self.shape](*self.tessellation)


@dataclass(frozen=True)
class FileGeometry:
    """A mesh file."""

    path: Path

    def mesh(self) -> Mesh:
        """Read the triangles."""
        from nmatrix.scene.meshes.file import read_mesh

        return read_mesh(self.path)


@dataclass(frozen=True)
class TangentGeometry:
    """Other triangles, with tangents made from their texture coordinates for a normal map."""

    plain: Geometry

    def mesh(self) -> Mesh:
        """Build or read the triangles; without texture coordinates they stay as they are."""
        from nmatrix.scene.meshes.tangents import with_tangents

        return with_tangents(self.plain.mesh())


@dataclass(frozen=True, eq=False)
class LoadedGeometry:
    """Triangles that are there already."""

    loaded: Mesh

    def mesh(self) -> Mesh:
        """Return the triangles."""
        return self.loaded
