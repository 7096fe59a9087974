"""Where an object's triangles come from: a shape, a mesh file, arrays that are there already.

These are small frozen values; `mesh` reads or builds the triangles, and only then is NumPy loaded.
A reader of other files brings a value of its own.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from nmatrix.scene.words import Shape

if TYPE_CHECKING:
    from nmatrix.scene.meshes.mesh import Mesh


class Geometry(Protocol):
    """Anything that has triangles."""

    def mesh(self) -> Mesh:
        """Build or read the triangles."""


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
