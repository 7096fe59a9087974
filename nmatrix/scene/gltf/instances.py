"""Instances by EXT_mesh_gpu_instancing: one mesh in many places under one node, exactly."""

from __future__ import annotations

from fractions import Fraction

from nmatrix.errors import IllegalValueError, NoAnswerError, counted
from nmatrix.linear.affine import compose, rotation_from_quaternion
from nmatrix.linear.rational import RationalMatrix, product
from nmatrix.scene.gltf.document import converted
from nmatrix.scene.gltf.extensions import INSTANCING
from nmatrix.scene.gltf.file import GltfFile
from nmatrix.scene.gltf.records import Instancing

TYPES = {"TRANSLATION": "VEC3", "ROTATION": "VEC4", "SCALE": "VEC3"}
UNMOVED: dict[str, tuple[Fraction, ...]] = {
    "TRANSLATION": (Fraction(0),) * 3,
    "ROTATION": (*(Fraction(0),) * 3, Fraction(1)),
    "SCALE": (Fraction(1),) * 3,
}
MOST = 1 << 17  # instances of all nodes of a file


def is_instanced(file: GltfFile, node_index: int) -> bool:
    """Find out whether a node puts its mesh in places of their own."""
    record = file.document.nodes[node_index]
    return record.mesh is not None and INSTANCING in record.extensions


def instance_count(file: GltfFile, node_index: int) -> int:
    """Count how often a node claims to draw its mesh, without a look at the places."""
    if not is_instanced(file, node_index):
        return 1
    accessors = file.document.accessors
    try:
        indices = _instancing(file, node_index).attributes.values()
    except IllegalValueError:  # which `instance_matrices` tells
        return 0
    return max((accessors[i].count for i in indices if 0 <= i < len(accessors)), default=0)


def _instancing(file: GltfFile, node_index: int) -> Instancing:
    given = file.document.nodes[node_index].extensions[INSTANCING]
    return converted(given, Instancing, INSTANCING)


def instance_matrices(file: GltfFile, node_index: int) -> tuple[RationalMatrix, ...]:
    """Multiply a node's world matrix and each instance's T · R · S, exactly.

    They are 4×4 matrices that take the mesh to the world; a node that is not instanced has its one
    world matrix.

    Raises
    ------
    IllegalValueError
        For places that cannot be read, differ in number, have a quaternion of zeros, or are, with
        those of the nodes before, more than 131,072.
    """
    world = file.nodes[node_index].world_from_object
    if not is_instanced(file, node_index):
        return (world,)
    from nmatrix.scene.gltf.accessors import values

    given = _instancing(file, node_index)
    found = {
        name: values(file, given.attributes[name], f"{name} of instances", (kind,))
        for name, kind in TYPES.items()
        if name in given.attributes
    }
    counts = {len(one) for one in found.values()}
    if len(counts) != 1:
        listed = ", ".join(f"{len(one)} of {name}" for name, one in found.items()) or "none"
        raise file.fault(f"its instances are {listed}; they are alike in number")
    before = file.kept.instances
    if node_index not in before and before.total() + max(counts) > MOST:
        raise file.fault(
            f"with its {counted(max(counts), 'instance')} the file has more than {MOST:,}"
        )
    before[node_index] = max(counts)
    columns = {
        name: found[name].exact() if name in found else [unmoved] * max(counts)
        for name, unmoved in UNMOVED.items()
    }
    places = []
    for i, (move, turn, scale) in enumerate(zip(*columns.values(), strict=True)):
        try:
            turned = rotation_from_quaternion(turn)
        except NoAnswerError as error:
            raise file.fault(f"instance {i}: {error}") from None
        places.append(product(world, compose(turned, scale, translate=move)))
    return tuple(places)
