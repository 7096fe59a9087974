"""Where an object's triangles come from: a shape, a mesh file, a primitive of a glTF file.

These are small frozen values; `mesh` reads or builds the triangles, and only then is NumPy loaded.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from nmatrix.scene.words import Shape

if TYPE_CHECKING:
    from nmatrix.scene.gltf.nodes import GltfScene
    from nmatrix.scene.meshes.mesh import Mesh


@dataclass(frozen=True)
class ShapeGeometry:
    """A shape with analytic normals; `tessellation` is how finely it is cut, its default if empty.

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
class GltfGeometry:
    """One primitive of one mesh of a glTF file."""

    scene: GltfScene
    mesh_index: int
    primitive: int

    def mesh(self) -> Mesh:
        """Read the triangles."""
        from nmatrix.scene.gltf.accessors import primitive_mesh

        return primitive_mesh(self.scene, self.mesh_index, self.primitive)


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
        """Return them."""
        return self.loaded


Geometry = ShapeGeometry | FileGeometry | GltfGeometry | TangentGeometry | LoadedGeometry
