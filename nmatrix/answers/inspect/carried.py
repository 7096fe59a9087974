"""What carries a glTF mesh beside its node's own matrix, and the normals that it has.

A part that cannot be read costs itself: the node says what is not known of it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
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
from nmatrix.scene.gltf.skins import joint_matrices
from nmatrix.scene.words import NormalsFrom

Classify = Callable[[RationalMatrix], Classification]
UNSCALED: Vector = (1, 1, 1)


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
    for index, keys in scales.keys.items():
        over_time = None if index in maps else _over_time(file.nodes[index], keys, tolerance)
        if over_time is not None:
            each = map(classify, (file.nodes[index].world_from_object, *over_time.placed))
            found = Maps.of(Carriers.SCALES, each, partial(_scale, over_time.uneven))
            maps[index] = replace(found, total=over_time.distinct)
    changed = {
        index: tuple(one for one in Animated if one in found)
        for index, found in animated_channels(file).items()
    }
    return Carried(maps, unread, changed, scales.remarks)


def _joint(file: GltfFile, skin: int, place: int) -> str:
    index = file.document.skins[skin].joints[place]
    return f"joint {file.nodes.hierarchy.addresses[index]}"


def _instance(place: int) -> str:
    return f"instance {place}"


def _scale(uneven: tuple[Vector, ...], place: int) -> str:
    if place == 0:
        return "the scale at rest"
    return f"scale {' '.join(f'{float(one):.6g}' for one in uneven[place - 1])}"


@dataclass(frozen=True)
class _OverTime:
    """How many scales a node goes through, and the uneven ones with the maps that they make."""

    distinct: int
    uneven: tuple[Vector, ...]
    placed: tuple[RationalMatrix, ...]


def _over_time(node: Node, keys: tuple[Vector, ...], tolerance: float) -> _OverTime | None:
    """Count a node's scales, and place it by the uneven ones; None if there are none of these."""
    record = node.record
    if record.matrix is not None:  # nothing animates it
        return None
    uneven = [key for key in keys if not _is_even(key, tolerance)]
    if not uneven:
        return None
    above = identity(4) if node.parent is None else node.nodes.world(node.parent)
    turned = rotation_from_quaternion(record.rotation or (0, 0, 0, 1))
    at_rest = tuple(record.scale or UNSCALED)
    others = tuple(key for key in uneven if key != at_rest)
    placed = tuple(product(above, compose(turned, key)) for key in others)
    return _OverTime(len({*keys, at_rest}), others, placed)


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
