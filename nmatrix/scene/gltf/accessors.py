"""The numbers of a glTF mesh: accessors read straight from the buffers, and checked.

They are read here and not by a mesh library, so that a bad number is an error with a name.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.errors import IllegalValueError
from nmatrix.scene.gltf.file import GltfFile
from nmatrix.scene.gltf.records import FAN, TRIANGLES, Accessor, Primitive
from nmatrix.scene.meshes.mesh import Mesh, area_weighted_normals, normals_made, unit

TYPES = {
    5120: np.int8,
    5121: np.uint8,
    5122: np.int16,
    5123: np.uint16,
    5125: np.uint32,
    5126: np.float32,
}
LARGEST = {5120: 127, 5121: 255, 5122: 32767, 5123: 65535}  # of normalised integers
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
MOST_ROWS = 1 << 28  # more than memory holds, and a damaged file asks for

Array = NDArray[Any]


def mesh_parts(file: GltfFile, index: int) -> list[Mesh]:
    """Return the triangles of a mesh, primitive by primitive, of those that have any.

    Raises
    ------
    IllegalValueError
        For buffers that are missing or too short, indices out of range, numbers that are not
        finite.
    """
    parts = (_triangle_mesh(file, one) for one in file.document.meshes[index].primitives)
    return [part for part in parts if part is not None]


def primitive_mesh(file: GltfFile, mesh_index: int, primitive: int, coordinates: int = 0) -> Mesh:
    """Return the triangles of one primitive, with its coordinates, colours and tangents.

    Texture coordinates, of the set that is asked for, have v upwards; the file has it downwards.

    Raises
    ------
    IllegalValueError
        As `mesh_parts`, and for a primitive without triangles.
    """
    record = file.document.meshes[mesh_index].primitives[primitive]
    found = _triangle_mesh(file, record)
    if found is None:
        raise file.fault(f"primitive {primitive} of mesh {mesh_index} has no triangles")
    uv = _attribute(file, record, f"TEXCOORD_{coordinates}", (2,))
    colours = _attribute(file, record, "COLOR_0", (3, 4))
    tangents = _attribute(file, record, "TANGENT", (4,))
    for one in (uv, colours, tangents):
        if one is not None and len(one) != len(found.positions):
            raise file.fault(f"{len(one)} attributes stand beside {len(found.positions)} vertices")
    return replace(
        found,
        uv=None if uv is None else uv * (1, -1) + (0, 1),
        colours=None if colours is None else np.clip(colours, 0.0, 1.0),
        tangents=tangents,
    )


def _attribute(
    file: GltfFile, primitive: Primitive, name: str, widths: tuple[int, ...]
) -> Array | None:
    if name not in primitive.attributes:
        return None
    found = _read(file, primitive.attributes[name]).astype(np.float64)
    if found.shape[1] not in widths:
        raise file.fault(f"{name} has {found.shape[1]} components")
    return found


def _triangle_mesh(file: GltfFile, primitive: Primitive) -> Mesh | None:
    """Return a primitive's positions, normals and triangles, or None if it has no triangles."""
    if not primitive.has_triangles:
        return None
    positions = _vectors(file, primitive.attributes["POSITION"])
    if primitive.indices is None:
        order = np.arange(len(positions), dtype=np.intp)
    else:
        order = _read(file, primitive.indices).astype(np.intp).ravel()
    triangles = _triangles(order, primitive.mode)
    if len(triangles) == 0:
        return None
    if triangles.min() < 0 or triangles.max() >= len(positions):
        raise file.fault(f"index {int(triangles.max())} is beyond {len(positions)} vertices")
    remarks: tuple[str, ...] = ()
    if "NORMAL" in primitive.attributes:
        normals = unit(_vectors(file, primitive.attributes["NORMAL"]))
    else:
        normals = area_weighted_normals(positions, triangles)
        remarks = (normals_made(file.path.name),)
    try:
        return Mesh(positions, normals, triangles, remarks=remarks)
    except IllegalValueError as error:
        raise file.fault(str(error)) from None


def _vectors(file: GltfFile, index: int) -> Array:
    found = _read(file, index)
    if found.shape[1] != 3:
        raise file.fault(f"accessor {index} has {found.shape[1]} components and needs 3")
    return found.astype(np.float64)


def _triangles(order: Array, mode: int) -> Array:
    if mode == TRIANGLES:
        return order[: len(order) // 3 * 3].reshape(-1, 3)
    n = max(len(order) - 2, 0)
    first = np.arange(n)
    if mode == FAN:
        return np.stack([np.full(n, order[0]) if n else order[:0], order[1 : n + 1], order[2:]], 1)
    odd = first % 2
    return np.stack([order[first], order[first + 1 + odd], order[first + 2 - odd]], 1)


def _read(file: GltfFile, index: int) -> Array:
    record = file.entry("accessor", file.document.accessors, index)
    known = record.component_type in TYPES and record.type in WIDTHS
    if not known or not 0 <= record.count <= MOST_ROWS:
        raise file.fault(f"accessor {index} has an unknown type or size")
    if record.sparse is not None:
        raise file.fault(f"accessor {index} is sparse, which this reader does not know")
    found = _from_view(file, record)
    if record.normalized and record.component_type in LARGEST:
        return np.maximum(found / np.float64(LARGEST[record.component_type]), -1.0)
    if not np.isfinite(found).all():
        row = int(np.argwhere(~np.isfinite(found))[0][0])
        raise file.fault(f"row {row} of accessor {index} is not a finite number")
    return found


def _from_view(file: GltfFile, record: Accessor) -> Array:
    kind, width = np.dtype(TYPES[record.component_type]), WIDTHS[record.type]
    if record.buffer_view is None or record.count == 0:
        return np.zeros((record.count, width), kind)
    view = file.entry("buffer view", file.document.buffer_views, record.buffer_view)
    content = file.buffer(view.buffer)
    row = kind.itemsize * width
    stride = view.byte_stride or row
    start = view.byte_offset + record.byte_offset
    end = start + stride * (record.count - 1) + row
    first = min(start, view.byte_offset, record.byte_offset)
    if first < 0 or stride < row or end > len(content):
        raise file.fault("an accessor reaches beyond its buffer")
    return np.ndarray((record.count, width), kind, content, start, (stride, kind.itemsize))
