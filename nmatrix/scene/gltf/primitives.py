"""The primitives of a glTF file before anything of them is read: which are one, how large they are.

Two primitives of the same accessors have the same triangles, whatever their materials: they are
read once. And an honest corner of a triangle has a byte of its own somewhere in the file, so that
corners beyond the file's bytes tell of accessors that lie over one another.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from nmatrix.errors import printable
from nmatrix.linear.rational import RationalMatrix
from nmatrix.report import Vector
from nmatrix.scene.gltf.document import converted
from nmatrix.scene.gltf.extensions import DRACO
from nmatrix.scene.gltf.records import Document, DracoRecord, Primitive
from nmatrix.scene.words import NormalsFrom

if TYPE_CHECKING:
    from nmatrix.scene.geometry import DamagedPartError
    from nmatrix.scene.gltf.accessors import Values

SPARE_CORNERS = 1 << 20  # that need no bytes of their own

Content = tuple[object, ...]


@dataclass(frozen=True)
class Pose:
    """How a mesh stands at rest: the weights of its morph targets, and the skin that carries it."""

    weights: tuple[float, ...] = ()
    skin: int | None = None


AS_MODELLED = Pose()


@dataclass(frozen=True)
class MeshNormals:
    """The normals of a mesh, over all its primitives of triangles.

    `origin` is where they come from; where primitives differ, the one that is furthest from the
    file's own. `degenerate` counts those that are no direction. `remarks` tell what was made or is
    odd, `faults` are the primitives that cannot be read, and `packing` is what packed some of them.
    `at` is where the first of those that are no direction stands, in object space.
    """

    origin: NormalsFrom
    degenerate: int = 0
    packing: str = ""
    remarks: tuple[str, ...] = ()
    faults: tuple[DamagedPartError, ...] = ()
    at: Vector | None = None


@dataclass(frozen=True)
class Kept:
    """What of a file was read and may be needed again, by its index or by what it is made of."""

    accessors: dict[int, Values] = field(default_factory=dict)
    joints: dict[int, tuple[RationalMatrix, ...]] = field(default_factory=dict)
    normals: dict[Content, MeshNormals] = field(default_factory=dict)
    instances: Counter[int] = field(default_factory=Counter)  # how many, by node


def content_of(primitive: Primitive) -> Content:
    """Tell what the triangles of a primitive are made of.

    Examples
    --------
    >>> red, blue = Primitive({"POSITION": 0}, material=0), Primitive({"POSITION": 0}, material=1)
    >>> content_of(red) == content_of(blue)
    True
    """
    return (
        tuple(sorted(primitive.attributes.items())),
        primitive.indices,
        primitive.mode,
        tuple(tuple(sorted(target.items())) for target in primitive.targets),
        repr(primitive.extensions.get(DRACO)),
    )


def draco_of(primitive: Primitive) -> DracoRecord | None:
    """Find what of a primitive Draco packed, if any.

    Raises
    ------
    IllegalValueError
        If the extension is not as it has to be.
    """
    if DRACO not in primitive.extensions:
        return None
    return converted(primitive.extensions[DRACO], DracoRecord, DRACO)


def part_name(document: Document, mesh: int, primitive: int | None = None) -> str:
    """Name a mesh, or a primitive of it.

    Examples
    --------
    >>> from nmatrix.scene.gltf.records import Asset, MeshRecord
    >>> part_name(Document(Asset("2.0"), meshes=[MeshRecord(name="Wheel")]), 0, 1)
    'mesh 0 (Wheel), primitive 1'
    """
    name = document.meshes[mesh].name
    found = f"mesh {mesh} ({printable(name)})" if name else f"mesh {mesh}"
    return found if primitive is None else f"{found}, primitive {primitive}"


def beyond_bytes(document: Document, bytes_of_buffers: int) -> frozenset[Content]:
    """Find the primitives whose corners, with those before them, outnumber the file's bytes."""
    left = bytes_of_buffers + SPARE_CORNERS
    seen: set[Content] = set()
    beyond = set()
    for mesh in document.meshes:
        for primitive in mesh.primitives:
            content = content_of(primitive)
            if not primitive.has_triangles or DRACO in primitive.extensions or content in seen:
                continue
            seen.add(content)
            corners = corners_of(document, primitive)
            if corners > left:
                beyond.add(content)
            else:
                left -= corners
    return frozenset(beyond)


def corners_of(document: Document, primitive: Primitive) -> int:
    """Count the corners that a primitive claims to have, of triangles, strips or fans."""
    index = primitive.attributes["POSITION"] if primitive.indices is None else primitive.indices
    known = 0 <= index < len(document.accessors)
    return max(document.accessors[index].count, 0) if known else 0
