"""The triangles of a glTF mesh, primitive by primitive, as it stands at rest.

Each primitive is read by itself: what is wrong with one costs that one. Of a vertex buffer that
many primitives share only the vertices that a primitive's triangles refer to are taken.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.errors import MissingPackageError, NMatrixError, counted
from nmatrix.linear.rational import to_floats
from nmatrix.scene.geometry import DamagedPartError
from nmatrix.scene.gltf.accessors import PackedError, Rows, Values, values
from nmatrix.scene.gltf.extensions import DRACO, PACKING
from nmatrix.scene.gltf.file import GltfFile
from nmatrix.scene.gltf.primitives import (
    AS_MODELLED,
    MeshNormals,
    Pose,
    content_of,
    draco_of,
    part_name,
)
from nmatrix.scene.gltf.records import FAN, TRIANGLES, DracoRecord, Primitive
from nmatrix.scene.gltf.skinning import Vertices, blended, carried
from nmatrix.scene.gltf.skins import joint_matrices
from nmatrix.scene.meshes.mesh import Mesh, unit
from nmatrix.scene.words import NormalsFrom

Array = NDArray[Any]

TYPES = {
    "POSITION": ("VEC3",),
    "NORMAL": ("VEC3",),
    "TANGENT": ("VEC4",),
    "COLOR_0": ("VEC3", "VEC4"),
}
COORDINATES, TYPES_OF_COORDINATES = "TEXCOORD_", ("VEC2",)
FIELDS = {
    "POSITION": "positions",
    "NORMAL": "normals",
    "TANGENT": "tangents",
    "COLOR_0": "colours",
}
FAR_FROM_ONE = 0.02  # a sum of weights; four of 8 bits may be off by 0.008
FEW = 4  # vertices for each corner: beyond, corners are sorted and vertices are not marked


def primitive_mesh(
    file: GltfFile,
    mesh_index: int,
    primitive: int,
    pose: Pose = AS_MODELLED,
    coordinates: int = 0,
) -> Mesh:
    """Read the triangles of one primitive, with its colours and tangents, at rest.

    Where it has no normals each triangle has its own, flat, as the format demands (3.7.2.1): no two
    triangles share a vertex then, and tangents are left out. A normal that is not finite counts as
    none. Texture coordinates, of the set that is asked for, have v upwards; the file has it
    downwards.

    Raises
    ------
    DamagedPartError
        If it cannot be read, is packed, or has no triangles; the cause names what was found.
    """
    name = part_name(file.document, mesh_index, primitive)
    try:
        record = file.document.meshes[mesh_index].primitives[primitive]
        return _Part(file, record, name, coordinates).mesh(pose)
    except NMatrixError as error:
        raise DamagedPartError(file.path, name, error) from None


def mesh_normals(file: GltfFile, mesh_index: int) -> MeshNormals:
    """Count the normals of a mesh that are no direction, and tell where its normals come from.

    Vertices that no triangle refers to do not count. A primitive that cannot be read is a fault of
    the result, and the others count.

    Raises
    ------
    IllegalValueError
        For a mesh that does not exist.
    """
    found = []
    faults = []
    mesh = file.entry("mesh", file.document.meshes, mesh_index)
    for i, primitive in enumerate(mesh.primitives):
        if not primitive.has_triangles:
            continue
        content = content_of(primitive)
        if content not in file.kept.normals:
            try:
                read = primitive_mesh(file, mesh_index, i)
            except DamagedPartError as error:
                faults.append(error)
                packing = _packing(error.cause)
                if packing:
                    found.append(MeshNormals(NormalsFrom.PACKED, packing=packing))
                continue
            own = "NORMAL" in primitive.attributes
            origin = NormalsFrom.FILE if own else NormalsFrom.COMPUTED
            count = read.degenerate_normals
            at = read.degenerate_at
            file.kept.normals[content] = MeshNormals(origin, count, remarks=read.remarks, at=at)
        found.append(file.kept.normals[content])
    furthest = (NormalsFrom.PACKED, NormalsFrom.COMPUTED, NormalsFrom.FILE, NormalsFrom.NONE)
    origins = {one.origin for one in found} or {NormalsFrom.NONE}
    return MeshNormals(
        min(origins, key=furthest.index),
        sum(one.degenerate for one in found),
        next((one.packing for one in found if one.packing), ""),
        tuple(dict.fromkeys(text for one in found for text in one.remarks)),
        tuple(faults),
        next((one.at for one in found if one.at is not None), None),
    )


def _packing(error: NMatrixError) -> str:
    """Name what packed a primitive that cannot be read, if that is why."""
    if isinstance(error, MissingPackageError):
        return PACKING[DRACO]
    return error.packing if isinstance(error, PackedError) else ""


@dataclass(frozen=True, eq=False)
class _Part:
    """A primitive on its way to a mesh; `name` is what remarks call it."""

    file: GltfFile
    record: Primitive
    name: str
    coordinates: int

    def mesh(self, pose: Pose) -> Mesh:
        triangles = _triangles(self.corners, self.record.mode)
        if len(triangles) == 0:
            raise self.file.fault("it has no triangles")
        if triangles.max() >= self.count:
            raise self.file.fault(f"its index {triangles.max()} is beyond {self._vertices}")
        rows, triangles = _referred(triangles, self.count)
        vertices, remarks = self._at_rest(rows, triangles, pose)
        if vertices.normals is None:
            remarks.append(f"Flat normals were made where {self.file.path.name} has none.")
            vertices, normals = _flat(vertices)
        else:
            normals = unit(vertices.normals)
        uv, colours = vertices.uv, vertices.colours
        return Mesh(
            vertices.positions,
            normals,
            vertices.triangles,
            uv=None if uv is None else uv * (1, -1) + (0, 1),
            colours=None if colours is None else np.clip(colours, 0.0, 1.0),
            tangents=vertices.tangents,
            remarks=tuple(remarks),
        )

    def _at_rest(self, rows: Rows, triangles: Array, pose: Pose) -> tuple[Vertices, list[str]]:
        """Read the vertices that are referred to, morphed and carried by their joints."""
        remarks = []
        present = set(self.record.attributes)
        if "NORMAL" not in present:
            present.discard("TANGENT")  # 3.7.2.1: without normals they are ignored
        found = {name: self._values(name) for name in self.fields if name in present}
        read = {name: one.finite(rows) for name, one in found.items() if name != "NORMAL"}
        if "NORMAL" in found:
            normals = read["NORMAL"] = found["NORMAL"].floats(rows)
            bad = ~np.isfinite(normals).all(axis=1)
            if bad.any():
                first = int(np.arange(self.count)[rows][bad][0])
                count = int(np.count_nonzero(bad))
                some = counted(count, "normal is", "normals are")
                told = f"{some} not finite, first that of vertex {first}, and taken as none"
                remarks.append(f"{self.name}: {told}.")
                normals[bad] = 0.0
        for i, (target, weight) in enumerate(zip(self.record.targets, pose.weights, strict=False)):
            for name in read:
                if weight and name in target:
                    delta = self._of_target(i, name, target[name]).finite(rows)
                    read[name][:, : delta.shape[1]] += weight * delta
        vertices = Vertices(
            triangles=triangles, **{self.fields[name]: one for name, one in read.items()}
        )
        if pose.skin is None:
            return vertices, remarks
        if "JOINTS_0" not in self.record.attributes:
            remarks.append(f"{self.name} has a skin and no joints: it stands as it was modelled.")
            return vertices, remarks
        blends, told_of_weights = self._blends(rows, pose.skin)
        return carried(vertices, blends), remarks + told_of_weights

    def _blends(self, rows: Rows, skin: int) -> tuple[Array, list[str]]:
        """Blend the matrices of the joints that carry each vertex."""
        matrices = np.array([to_floats(one)[:3] for one in joint_matrices(self.file, skin)])
        joints, weights = [], []
        number = 0
        while f"JOINTS_{number}" in self.record.attributes:
            joints.append(self._values(f"JOINTS_{number}").raw(rows))
            weights.append(self._values(f"WEIGHTS_{number}").finite(rows))
            number += 1
        joint, weight = np.hstack(joints), np.hstack(weights)
        if joint.dtype.kind not in "iu":
            raise self.file.fault("its joints are no whole numbers")
        total = weight.sum(axis=1)
        idle = weight == 0
        idle[:, 0] &= total != 0  # a vertex without weights follows its first joint
        joint = np.where(idle, 0, joint.astype(np.int64))
        if len(matrices) == 0 or joint.max() >= len(matrices) or joint.min() < 0:
            worst = joint.min() if joint.min() < 0 else joint.max()
            has = counted(len(matrices), "joint")
            raise self.file.fault(f"a vertex follows joint {worst}, and skin {skin} has {has}")
        far = np.abs(total - 1) > FAR_FROM_ONE
        if not far.any():
            return blended(matrices, joint, weight), []
        worst = total[np.argmax(np.abs(total - 1))]
        count = int(np.count_nonzero(far))
        some = counted(count, "vertex", "vertices")
        told = f"the weights of {some} were brought to a sum of 1, at worst from {worst:g}"
        return blended(matrices, joint, weight), [f"{self.name}: {told}."]

    @cached_property
    def unpacked(self) -> tuple[Mapping[str, Values], Array | None]:
        """What Draco packed, if there is no other place for it in the file."""
        packed = draco_of(self.record)
        if packed is None or self._has_fallback(packed):
            return {}, None
        from nmatrix.scene.gltf.draco import unpacked

        return unpacked(self.file, self.record, packed)

    def _has_fallback(self, packed: DracoRecord) -> bool:
        accessors = self.file.document.accessors
        indices = [self.record.attributes.get(name, -1) for name in packed.attributes]
        if self.record.indices is not None:
            indices.append(self.record.indices)
        return all(
            0 <= i < len(accessors) and accessors[i].buffer_view is not None for i in indices
        )

    @property
    def fields(self) -> dict[str, str]:
        """The attributes that are read, and what they are called here."""
        return {**FIELDS, f"{COORDINATES}{self.coordinates}": "uv"}

    @cached_property
    def count(self) -> int:
        """How many vertices there are, whether triangles refer to them or not."""
        return len(self._found("POSITION"))

    @cached_property
    def corners(self) -> Array:
        """The corners of triangles, strips or fans, as indices of vertices."""
        _, corners = self.unpacked
        if corners is not None:
            return corners
        if self.record.indices is None:
            self._check_room(self.count)
            return np.arange(self.count, dtype=np.intp)
        found = values(self.file, self.record.indices, "its indices", ("SCALAR",))
        self._check_room(len(found))
        if not found.is_integer or found.stored.dtype.kind != "u":
            kind = f"its indices (accessor {self.record.indices}) are of {found.stored.dtype.name}"
            raise self.file.fault(f"{kind} and have to be of uint8, uint16 or uint32")
        return found.raw().ravel().astype(np.intp)

    @property
    def _vertices(self) -> str:
        return counted(self.count, "vertex", "vertices")

    def _check_room(self, corners: int) -> None:
        if content_of(self.record) in self.file.beyond_bytes:
            are = counted(corners, "corner is", "corners are")
            raise self.file.fault(f"{are} more than the file has bytes left for")

    def _values(self, name: str) -> Values:
        """Look up an attribute, which has an element for every vertex."""
        found = self._found(name)
        if len(found) != self.count:
            why = f"{name} has {counted(len(found), 'element')} for {self._vertices}"
            raise self.file.fault(why)
        return found

    def _found(self, name: str) -> Values:
        unpacked, _ = self.unpacked
        if name in unpacked:
            return unpacked[name]
        if name not in self.record.attributes:
            raise self.file.fault(f"it has no {name}")
        return values(self.file, self.record.attributes[name], name, _types(name))

    def _of_target(self, number: int, name: str, accessor: int) -> Values:
        types = ("VEC3",) if name == "TANGENT" else _types(name)
        found = values(self.file, accessor, f"{name} of morph target {number}", types)
        if len(found) != self.count:
            why = f"{name} of morph target {number} has {counted(len(found), 'element')}"
            raise self.file.fault(f"{why} for {self._vertices}")
        return found


def _types(name: str) -> tuple[str, ...]:
    """Tell what types an attribute may have; those of joints and weights have four components."""
    return TYPES_OF_COORDINATES if name.startswith(COORDINATES) else TYPES.get(name, ("VEC4",))


def _referred(triangles: Array, count: int) -> tuple[Rows, Array]:
    """Find the vertices that triangles refer to, and number the corners by those alone."""
    if count > FEW * triangles.size:
        used, corners = np.unique(triangles, return_inverse=True)
        return used, corners.reshape(triangles.shape)
    is_used = np.zeros(count, bool)
    is_used[triangles] = True
    if is_used.all():
        return slice(None), triangles
    return np.flatnonzero(is_used), (np.cumsum(is_used) - 1)[triangles]


def _flat(vertices: Vertices) -> tuple[Vertices, Array]:
    """Give every triangle vertices of its own, and them its normal."""
    order = vertices.triangles.ravel()
    positions = vertices.positions[order]
    triangles = np.arange(len(order), dtype=np.intp).reshape(-1, 3)
    faces = Mesh(positions, np.zeros_like(positions), triangles).face_normals
    uv, colours = vertices.uv, vertices.colours
    split = Vertices(
        positions,
        triangles,
        uv=None if uv is None else uv[order],
        colours=None if colours is None else colours[order],
    )
    return split, np.repeat(faces, 3, axis=0)


def _triangles(corners: Array, mode: int) -> Array:
    if mode == TRIANGLES:
        return corners[: len(corners) // 3 * 3].reshape(-1, 3)
    n = max(len(corners) - 2, 0)
    first = np.arange(n)
    if mode == FAN:
        hub = np.full(n, corners[0] if n else 0, corners.dtype)
        return np.stack([hub, corners[1 : n + 1], corners[2:]], 1)
    odd = first % 2
    return np.stack([corners[first], corners[first + 1 + odd], corners[first + 2 - odd]], 1)
