"""What carries a glTF mesh beside its node's own matrix, and the normals that it has.

A part that cannot be read costs itself: the node says what is not known of it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from functools import partial

from nmatrix.answers.inspect.node import Carriers, FoundNormals, Maps
from nmatrix.answers.inspect.plain import SHARE
from nmatrix.errors import IllegalValueError, NMatrixError
from nmatrix.linear.affine import compose, rotation_from_quaternion
from nmatrix.linear.classify import Classification
from nmatrix.linear.rational import RationalMatrix, identity, product
from nmatrix.report import Vector
from nmatrix.scene.gltf.animations import Animated, animated_channels, animated_scales
from nmatrix.scene.gltf.file import GltfFile
from nmatrix.scene.gltf.instances import instance_matrices, is_instanced
from nmatrix.scene.gltf.nodes import Node
from nmatrix.scene.gltf.records import NodeRecord
from nmatrix.scene.gltf.skins import joint_matrices
from nmatrix.scene.words import NormalsFrom

Classify = Callable[[RationalMatrix], Classification]
UNSCALED: Vector = (1, 1, 1)
MOST_SCALES = 1 << 15  # uneven ones over time, of all nodes of a file


@dataclass(frozen=True, eq=False)
class Carried:
    """The nodes of a file whose world matrix is not all that carries their mesh.

    `maps` has their maps, `unread` the reason where these cannot be read; `animated` is what
    animations change, `remarks` what could not be read of animations.
    """

    maps: Mapping[int, Maps]
    unread: Mapping[int, str]
    animated: Mapping[int, tuple[Animated, ...]]
    remarks: tuple[str, ...]


def carried(file: GltfFile, classify: Classify, tolerance: float) -> Carried:
    """Find what carries each mesh: joints, instances, or a scale that changes over time."""
    maps: dict[int, Maps] = {}
    unread: dict[int, str] = {}
    skins: dict[int, Maps] = {}
    for index, record in enumerate(file.document.nodes):
        if record.mesh is None:
            continue
        try:
            if record.skin is not None:
                if record.skin not in skins:
                    joints = joint_matrices(file, record.skin)
                    each = map(classify, joints)
                    skins[record.skin] = Maps.of(
                        Carriers.JOINTS, each, partial(_joint, file, record.skin)
                    )
                maps[index] = skins[record.skin]
            elif is_instanced(file, index):
                places = instance_matrices(file, index)
                maps[index] = Maps.of(Carriers.INSTANCES, map(classify, places), _instance)
        except IllegalValueError as error:
            unread[index] = _reason(file, error)
    if not file.document.animations:
        return Carried(maps, unread, {}, ())
    scales = animated_scales(file)
    moved = {index: keys for index, keys in scales.keys.items() if index not in maps}
    left = MOST_SCALES
    for index, (uneven, distinct) in _uneven(file, moved, tolerance).items():
        left -= len(uneven)
        if left < 0:
            unread[index] = f"uneven scales over time are more than {MOST_SCALES:,}, with its own"
            continue
        node = file.nodes[index]
        others = tuple(one for one in uneven if one != _at_rest(node.record))
        each = map(classify, (node.world_from_object, *_placed(node, others)))
        found = Maps.of(Carriers.SCALES, each, partial(_scale, others))
        maps[index] = replace(found, total=distinct)
    changed = {
        index: tuple(one for one in Animated if one in found)
        for index, found in animated_channels(file).items()
    }
    return Carried(maps, unread, changed, scales.remarks)


def _joint(file: GltfFile, skin: int, place: int) -> str:
    index = file.entry("skin", file.document.skins, skin).joints[place]
    return f"joint {file.nodes.hierarchy.addresses[index]}"


def _instance(place: int) -> str:
    return f"instance {place}"


def _scale(others: tuple[Vector, ...], place: int) -> str:
    if place == 0:
        return "the scale at rest"
    return f"scale {' '.join(f'{float(one):.6g}' for one in others[place - 1])}"


def _uneven(
    file: GltfFile, keys: Mapping[int, tuple[Vector, ...]], tolerance: float
) -> dict[int, tuple[tuple[Vector, ...], int]]:
    """Find the nodes with uneven scales among their keys, and count all, with the one at rest."""
    looked: dict[int, tuple[Vector, ...]] = {}  # by the identity of keys, which nodes share
    found = {}
    for index, each in keys.items():
        record = file.nodes[index].record
        if record.matrix is not None:  # nothing animates it
            continue
        if id(each) not in looked:
            looked[id(each)] = tuple(key for key in each if not _is_even(key, tolerance))
        if looked[id(each)]:
            found[index] = looked[id(each)], len(each) + (_at_rest(record) not in each)
    return found


def _at_rest(record: NodeRecord) -> Vector:
    return tuple(record.scale or UNSCALED)


def _placed(node: Node, scales: tuple[Vector, ...]) -> Iterable[RationalMatrix]:
    """Place a node by some scales instead of its own."""
    above = identity(4) if node.parent is None else node.nodes.world(node.parent)
    turned = rotation_from_quaternion(node.record.rotation or (0, 0, 0, 1))
    return (product(above, compose(turned, one)) for one in scales)


def _is_even(scale: Vector, tolerance: float) -> bool:
    x, y, z = map(float, scale)
    if not x * y * z > 0:
        return False
    sizes = (abs(x), abs(y), abs(z))
    return max(sizes) - min(sizes) <= SHARE * tolerance * max(sizes)


def normals_of(file: GltfFile, mesh: int) -> FoundNormals:
    """Look through the normals of a mesh that some node has."""
    primitives = file.document.meshes[mesh].primitives
    if not any(one.has_triangles for one in primitives):
        return FoundNormals(NormalsFrom.NONE)
    from nmatrix.scene.gltf.meshes import mesh_normals  # arrays, which nodes alone do not need

    found = mesh_normals(file, mesh)
    unread = "; ".join(dict.fromkeys(fault.reason for fault in found.faults))
    return FoundNormals(found.origin, found.degenerate, unread, found.at)


def _reason(file: GltfFile, error: NMatrixError) -> str:
    """Tell why a part could not be read, without the file's name."""
    what, why, _ = error.parts
    where = what.removeprefix(f"{file.path}").strip(" ()")
    return f"{where}: {why}" if where else why
