"""A glTF 2.0 file, read by its own rules: nodes in their hierarchy, buffers, images.

Files are `.gltf` (JSON, with buffers beside it or inside) or `.glb` (one container). World
matrices are exact products of the local ones, rounded at each node, but for what rounding would
change of their rank and mirroring.
"""

from __future__ import annotations

import base64
import binascii
import codecs
import struct
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from enum import Enum
from functools import cached_property
from math import isfinite
from pathlib import Path
from typing import TypeVar
from urllib.parse import unquote

from nmatrix.errors import IllegalValueError, NoAnswerError, printable, shortlist
from nmatrix.linear.affine import compose, rotation_from_quaternion
from nmatrix.linear.rank_keeping import rounded_keeping_rank
from nmatrix.linear.rational import (
    AFFINE_ROW,
    RationalMatrix,
    identity,
    product,
    rational_matrix,
    to_floats,
)
from nmatrix.scene.beside import asset_bytes, beside
from nmatrix.scene.gltf.document import check_version, read_document
from nmatrix.scene.gltf.primitives import Content, Kept, beyond_bytes
from nmatrix.scene.gltf.records import Asset, Document, ImageRecord, NodeRecord
from nmatrix.scene.hierarchy import Hierarchy

Entry = TypeVar("Entry")

MAGIC, JSON_CHUNK, BINARY_CHUNK = b"glTF", 0x4E4F534A, 0x004E4942
OLD_CONTAINER = 1  # the version of a container of glTF 1.0
UNIT_SLACK = 1e-6
LAST_ROW_SLACK = 1e-6  # files hold float32
MOST_NAMED = 5  # nodes that a remark names


class Mended(Enum):
    """What of a node's transform was nearly as the format has it, and taken as that."""

    QUATERNION = (
        "quaternion was not of length one and normalised",
        "quaternions were not of length one and normalised",
    )
    LAST_ROW = ("matrix did not quite end in 0 0 0 1", "matrices did not quite end in 0 0 0 1")


@dataclass(frozen=True)
class Node:
    """A node in its place: its own matrix and the one that its ancestors make of it."""

    name: str
    local: RationalMatrix
    world_from_object: RationalMatrix
    mesh: int | None
    parent: int | None = None
    mended: Mended | None = None


@dataclass(frozen=True, eq=False)
class GltfFile:
    """A file that was read: nodes in the file's order, and its bytes for meshes and images."""

    path: Path
    document: Document
    binary: bytes
    nodes: tuple[Node, ...]
    remarks: tuple[str, ...]
    allow_outside: bool = False

    @cached_property
    def hierarchy(self) -> Hierarchy:
        """The nodes by name."""
        return Hierarchy(
            tuple(node.name for node in self.nodes), tuple(node.parent for node in self.nodes)
        )

    @cached_property
    def in_scene(self) -> tuple[int, ...]:
        """The nodes of the default scene, parents first, in the file's order."""
        document = self.document
        if not document.scenes:
            roots = [i for i, node in enumerate(self.nodes) if node.parent is None]
        else:
            roots = self.entry("scene", document.scenes, document.scene or 0).nodes
        waiting, found = list(reversed(roots)), dict[int, None]()
        while waiting:
            at = waiting.pop()
            node = self.entry("node", document.nodes, at)
            if at not in found:
                found[at] = None
                waiting.extend(reversed(node.children))
        return tuple(found)

    def fault(self, why: str, next_step: str = "export it again") -> IllegalValueError:
        """Return the error for this file."""
        return IllegalValueError(f"{self.path}", why, next_step)

    def entry(self, kind: str, entries: Sequence[Entry], index: int) -> Entry:
        """Look up what another part of the file refers to by its index.

        Raises
        ------
        IllegalValueError
            If there is no such entry.
        """
        if not 0 <= index < len(entries):
            raise self.fault(f"{kind} {index} does not exist", "mend the file")
        return entries[index]

    @cached_property
    def kept(self) -> Kept:
        """What was read and may be needed again."""
        return Kept()

    @cached_property
    def beyond_bytes(self) -> frozenset[Content]:
        """The primitives that have more corners than the file has bytes left for."""
        sizes = {}
        for index, record in enumerate(self.document.buffers):
            with suppress(IllegalValueError):
                sizes[record.uri or index] = len(self.buffer(index))
        return beyond_bytes(self.document, sum(sizes.values()))

    @cached_property
    def _buffers(self) -> dict[int | str, bytes]:
        return {}

    def buffer(self, index: int) -> bytes:
        """Return the bytes of a buffer: embedded, beside the file, or the container's own.

        They are read once, however many accessors look into them.

        Raises
        ------
        IllegalValueError
            If the buffer is missing or too short.
        """
        record = self.entry("buffer", self.document.buffers, index)
        place = record.uri or index  # several buffers may be one file
        if place not in self._buffers:
            self._buffers[place] = self._bytes_of(index, record.uri)
        content = self._buffers[place]
        if len(content) < record.byte_length:
            raise IllegalValueError(
                f"{self.path} (buffer {index})",
                f"it has {len(content)} bytes and needs {record.byte_length}",
                "copy the file again",
            )
        return content

    def _bytes_of(self, index: int, uri: str | None) -> bytes:
        if uri is not None:
            return self._named(f"buffer {index}", uri)
        return self.binary if index == 0 else b""  # the container holds the first one alone

    def image(self, record: ImageRecord) -> bytes:
        """Return the bytes of an image that the file holds itself.

        Raises
        ------
        IllegalValueError
            If they are missing or cut short.
        """
        if record.uri is not None:
            return self._named("an image", record.uri)
        views = self.document.buffer_views
        if record.buffer_view is None or not 0 <= record.buffer_view < len(views):
            raise self.fault("an image has no bytes")
        view = views[record.buffer_view]
        content = self.buffer(view.buffer)
        if view.byte_offset < 0 or view.byte_offset + view.byte_length > len(content):
            raise self.fault("an image reaches beyond its buffer")
        return content[view.byte_offset : view.byte_offset + view.byte_length]

    def _named(self, what: str, uri: str) -> bytes:
        """Read what a part of the file names: bytes inside of it or a file beside it."""
        if uri.startswith("data:"):
            try:
                return base64.b64decode(uri.partition(",")[2], validate=True)
            except (binascii.Error, ValueError):
                raise self.fault(f"{what} is embedded and is not base64") from None
        name = unquote(uri)
        try:
            return asset_bytes(beside(self.path, name, allow_outside=self.allow_outside))
        except IllegalValueError as error:
            _, why, next_step = error.parts
            shown = f"{self.path} ({what}, {printable(name)})"
            raise IllegalValueError(shown, why, next_step) from None


def read_gltf(path: Path, *, allow_outside: bool = False) -> GltfFile:
    """Read the nodes of a `.gltf` or `.glb` file; the files that it names lie in its folder.

    Raises
    ------
    IllegalValueError
        For a file that cannot be read, is no glTF 2, has a cycle, an unknown reference or a number
        that is not finite, or names a file outside of its folder where that is not allowed.
    """
    content = asset_bytes(path)
    text, binary = _container(path, content) if content[:4] == MAGIC else (content, b"")
    remarks = []
    if text.startswith(codecs.BOM_UTF8):
        text = text.removeprefix(codecs.BOM_UTF8)
        remarks.append(
            "It begins with a byte order mark, which glTF forbids; it was read all the same."
        )
    document = read_document(path, text)
    named = (*(one.uri for one in document.buffers), *(one.uri for one in document.images))
    for uri in named:
        if uri is not None and not uri.startswith("data:"):
            beside(path, unquote(uri), allow_outside=allow_outside)
    nodes = _placed(path, document)
    return GltfFile(path, document, binary, nodes, (*remarks, *_told(nodes)), allow_outside)


def _container(path: Path, content: bytes) -> tuple[bytes, bytes]:
    text, binary, at = b"", b"", 12
    if len(content) >= 8 and struct.unpack_from("<I", content, 4)[0] == OLD_CONTAINER:
        check_version(path, Asset(version="1.0"))
    while at + 8 <= len(content):
        length, kind = struct.unpack_from("<II", content, at)
        chunk = content[at + 8 : at + 8 + length]
        if len(chunk) < length:
            raise IllegalValueError(
                f"{path}", "the file ends in the middle of a chunk", "copy it again"
            )
        if kind == JSON_CHUNK:
            text = chunk
        elif kind == BINARY_CHUNK:
            binary = chunk
        at += 8 + length
    return text, binary


def _placed(path: Path, document: Document) -> tuple[Node, ...]:
    order, parents = _order(path, document.nodes)
    worlds: list[RationalMatrix] = [identity(4)] * len(document.nodes)
    local: list[RationalMatrix] = [identity(4)] * len(document.nodes)
    mended: list[Mended | None] = [None] * len(document.nodes)
    for index in order:
        record = document.nodes[index]
        parent = parents[index]
        above = identity(4) if parent is None else worlds[parent]
        try:
            local[index], mended[index] = _local(path, index, record)
        except NoAnswerError as error:
            raise _node_fault(path, index, record, str(error)) from None
        try:
            worlds[index] = rounded_keeping_rank(product(above, local[index]))
            to_floats(worlds[index])
        except IllegalValueError as error:
            raise _node_fault(path, index, record, str(error)) from None
    return tuple(
        Node(
            _name(i, record),
            local[i],
            worlds[i],
            _mesh(path, i, record, document),
            parents[i],
            mended[i],
        )
        for i, record in enumerate(document.nodes)
    )


def _told(nodes: Sequence[Node]) -> list[str]:
    """Tell of the nodes whose transforms were mended."""
    told = []
    for kind in Mended:
        names = [printable(node.name) for node in nodes if node.mended is kind]
        if names:
            what = kind.value[len(names) > 1]
            told.append(f"{len(names)} {what}: {shortlist(names, MOST_NAMED)}.")
    return told


def _order(path: Path, nodes: Sequence[NodeRecord]) -> tuple[list[int], list[int | None]]:
    """Return the nodes with parents first, and each node's parent."""
    parents: list[int | None] = [None] * len(nodes)
    for index, record in enumerate(nodes):
        for child in record.children:
            if not 0 <= child < len(nodes):
                raise _node_fault(path, index, record, f"child {child} does not exist")
            if parents[child] is not None:
                raise _node_fault(path, child, nodes[child], "it has two parents")
            parents[child] = index
    order = [index for index, parent in enumerate(parents) if parent is None]
    for index in order:  # grows while it is walked: children follow their parents
        order.extend(nodes[index].children)
    if len(order) < len(nodes):
        missing = min(set(range(len(nodes))) - set(order))
        raise _node_fault(
            path, missing, nodes[missing], "it is its own ancestor: the hierarchy is a cycle"
        )
    return order, parents


def _local(path: Path, index: int, record: NodeRecord) -> tuple[RationalMatrix, Mended | None]:
    given = [record.matrix, record.translation, record.rotation, record.scale]
    for numbers, size in zip(given, (16, 3, 4, 3), strict=True):
        if numbers is not None and (len(numbers) != size or not all(map(isfinite, numbers))):
            raise _node_fault(path, index, record, f"a transform needs {size} finite numbers")
    if record.matrix is not None:
        columns = [record.matrix[i : i + 4] for i in range(0, 16, 4)]
        rows = rational_matrix(zip(*columns, strict=True))
        if max(abs(x - y) for x, y in zip(rows[3], AFFINE_ROW, strict=True)) > LAST_ROW_SLACK:
            last = " ".join(f"{float(x):g}" for x in rows[3])
            why = f"its matrix ends in {last} and not in 0 0 0 1"
            raise _node_fault(path, index, record, why)
        return (*rows[:3], AFFINE_ROW), None if rows[3] == AFFINE_ROW else Mended.LAST_ROW
    quaternion = record.rotation or [0, 0, 0, 1]
    length = sum(component * component for component in quaternion) ** 0.5
    turned = rotation_from_quaternion(quaternion)
    built = compose(turned, record.scale or (1, 1, 1), translate=record.translation or (0, 0, 0))
    return built, Mended.QUATERNION if abs(length - 1) > UNIT_SLACK else None


def _mesh(path: Path, index: int, record: NodeRecord, document: Document) -> int | None:
    if record.mesh is not None and not 0 <= record.mesh < len(document.meshes):
        raise _node_fault(path, index, record, f"mesh {record.mesh} does not exist")
    return record.mesh


def _name(index: int, record: NodeRecord) -> str:
    return record.name or f"node {index}"


def _node_fault(path: Path, index: int, record: NodeRecord, why: str) -> IllegalValueError:
    return IllegalValueError(f"{path} ({_name(index, record)[:60]})", why, "mend the file")
