"""The parts of a glTF file that matter here, as typed records; msgspec checks their types."""

from __future__ import annotations

import msgspec


class NodeRecord(msgspec.Struct):
    """A node as the file has it."""

    name: str | None = None
    children: list[int] = []
    mesh: int | None = None
    camera: int | None = None
    matrix: list[float] | None = None
    translation: list[float] | None = None
    rotation: list[float] | None = None
    scale: list[float] | None = None


class Primitive(msgspec.Struct):
    """A piece of a mesh: where its attributes and indices are."""

    attributes: dict[str, int] = {}
    indices: int | None = None
    mode: int = 4


class MeshRecord(msgspec.Struct):
    """A mesh: its primitives."""

    primitives: list[Primitive] = []
    name: str | None = None


class Accessor(msgspec.Struct, rename="camel"):
    """How to read numbers out of a buffer view."""

    component_type: int
    count: int
    type: str
    buffer_view: int | None = None
    byte_offset: int = 0
    normalized: bool = False
    sparse: dict[str, object] | None = None


class BufferView(msgspec.Struct, rename="camel"):
    """A slice of a buffer."""

    buffer: int
    byte_length: int
    byte_offset: int = 0
    byte_stride: int | None = None


class Buffer(msgspec.Struct, rename="camel"):
    """A run of bytes, inside the file or beside it."""

    byte_length: int
    uri: str | None = None


class Document(msgspec.Struct, rename="camel"):
    """The parts of a glTF file that matter here."""

    asset: dict[str, object]
    nodes: list[NodeRecord] = []
    meshes: list[MeshRecord] = []
    accessors: list[Accessor] = []
    buffer_views: list[BufferView] = []
    buffers: list[Buffer] = []
