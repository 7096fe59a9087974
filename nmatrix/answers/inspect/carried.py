"""What a glTF file says of its nodes beside their transforms: normals, joints, instances, keys."""

from __future__ import annotations

from collections.abc import Mapping

from nmatrix.answers.inspect.node import FoundNormals, Maps
from nmatrix.errors import IllegalValueError
from nmatrix.scene.gltf.file import GltfFile
from nmatrix.scene.words import NormalsFrom


def carried_otherwise(file: GltfFile, tolerance: float) -> Mapping[int, Maps]:
    return {}


def animated_paths(file: GltfFile) -> Mapping[int, tuple[str, ...]]:
    return {}


def normals_of(file: GltfFile, mesh: int) -> FoundNormals:
    from nmatrix.scene.gltf.accessors import mesh_parts

    try:
        parts = mesh_parts(file, mesh)
    except IllegalValueError as error:
        return FoundNormals(NormalsFrom.PACKED, None, str(error))
    return FoundNormals(NormalsFrom.FILE, sum(part.degenerate_normals for part in parts))
