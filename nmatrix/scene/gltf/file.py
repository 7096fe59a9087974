"""A glTF 2.0 file, read by its own rules: nodes in their hierarchy, buffers, images.

Files are `.gltf` (JSON, with buffers beside it or inside) or `.glb` (one container).
"""

from __future__ import annotations

import base64
import binascii
import codecs
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TypeVar
from urllib.parse import unquote

from nmatrix.errors import IllegalValueError, counted, printable
from nmatrix.scene.beside import asset_bytes, beside
from nmatrix.scene.gltf.container import json_and_bytes
from nmatrix.scene.gltf.document import read_document
from nmatrix.scene.gltf.nodes import Nodes, placed
from nmatrix.scene.gltf.primitives import Content, Kept, beyond_bytes
from nmatrix.scene.gltf.records import Document, ImageRecord
from nmatrix.scene.hierarchy import Hierarchy

Entry = TypeVar("Entry")

PADDING = 3  # bytes that the end of a container may have more
MOST_DIGITS = 16  # of a number in an error


@dataclass(frozen=True, eq=False)
class GltfFile:
    """A file that was read: nodes in the file's order, and its bytes for meshes and images."""

    path: Path
    document: Document
    binary: bytes
    nodes: Nodes
    remarks: tuple[str, ...]
    allow_outside: bool = False

    @property
    def hierarchy(self) -> Hierarchy:
        """The nodes by name."""
        return self.nodes.hierarchy

    @cached_property
    def in_scene(self) -> tuple[int, ...]:
        """The nodes of the default scene, parents first, in the file's order."""
        document = self.document
        if not document.scenes:
            roots = [i for i, above in enumerate(self.hierarchy.parents) if above is None]
        else:
            chosen = document.scene or 0
            roots = self.entry("scene", document.scenes, chosen, "scene").nodes
            for i, root in enumerate(roots):  # those below were looked up with their parents
                self.entry("node", document.nodes, root, f"scenes[{chosen}].nodes[{i}]")
        waiting, found = list(reversed(roots)), dict[int, None]()
        while waiting:
            at = waiting.pop()
            if at not in found:
                found[at] = None
                waiting.extend(reversed(document.nodes[at].children))
        return tuple(found)

    def fault(self, why: str, next_step: str = "export it again") -> IllegalValueError:
        """Return the error for this file."""
        return IllegalValueError(f"{self.path}", why, next_step)

    def entry(
        self, kind: str, entries: Sequence[Entry | None], index: int, place: str = ""
    ) -> Entry:
        """Look up what another part of the file, at a place in its JSON, refers to by its index.

        Raises
        ------
        IllegalValueError
            If there is no such entry, or it cannot be read.
        """
        if not 0 <= index < len(entries):
            where = f"{place}: " if place else ""
            raise self.fault(f"{where}{kind} {index} does not exist", "mend the file")
        found = entries[index]
        if found is None:
            raise self.fault(f"{kind} {index} cannot be read", "mend the file")
        return found

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
            If the buffer names no file, is missing or too short.
        """
        record = self.entry("buffer", self.document.buffers, index)
        place = record.uri or index  # several buffers may be one file
        if place not in self._buffers:
            self._buffers[place] = self._bytes_of(index, record.uri)
        content = self._buffers[place]
        if len(content) < record.byte_length:
            raise IllegalValueError(
                f"{self.path} (buffer {index})",
                f"it has {counted(len(content), 'byte')} and needs {record.byte_length:,}",
                "copy the file again",
            )
        return content

    def held(self, index: int) -> int | None:
        """Count the bytes of a buffer without reading them; None where nobody knows."""
        uri = self.document.buffers[index].uri
        if uri is None:
            return len(self.binary) if index == 0 else None
        if uri.startswith("data:"):
            text = uri.partition(",")[2]
            return len(text) * 3 // 4 - text[-2:].count("=")
        with suppress(OSError, ValueError):
            named = beside(self.path, unquote(uri), allow_outside=self.allow_outside)
            return named.stat().st_size
        return None

    def _bytes_of(self, index: int, uri: str | None) -> bytes:
        if uri is not None:
            return self._named(f"buffer {index}", uri)
        if index == 0 and self.binary:  # the container holds the first one alone
            return self.binary
        if self.document.buffers[index].byte_length == 0:
            return b""
        raise self.fault(f"buffer {index} names no file (it has no uri)")

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


def read_gltf(path: Path, *, content: bytes | None = None, allow_outside: bool = False) -> GltfFile:
    """Read the nodes of a `.gltf` or `.glb` file; the files that it names lie in its folder.

    `content` is that of the file, where it was read before.

    Raises
    ------
    IllegalValueError
        For a file that cannot be read, is no glTF 2, has a cycle, an unknown reference or a number
        that is not finite, or names a file outside of its folder where that is not allowed.
    """
    if content is None:
        content = asset_bytes(path)
    text, binary = json_and_bytes(path, content)
    remarks = []
    if text.startswith(codecs.BOM_UTF8):
        text = text.removeprefix(codecs.BOM_UTF8)
        remarks.append(
            "It begins with a byte order mark, which glTF forbids; it was read all the same."
        )
    document, unread = read_document(path, text)
    buffers, images = document.buffers, [one for one in document.images if one is not None]
    for uri in (*(one.uri for one in buffers), *(one.uri for one in images)):
        if uri is not None and not uri.startswith("data:"):
            beside(path, unquote(uri), allow_outside=allow_outside)
    nodes = placed(path, document.nodes, len(document.meshes))
    file = GltfFile(path, document, binary, nodes, (), allow_outside)
    remarks += [*unread, *_told_of_buffers(document, file.held), *nodes.told()]
    return replace(file, remarks=tuple(remarks))


def _told_of_buffers(document: Document, held: Callable[[int], int | None]) -> Iterator[str]:
    """Tell of the buffers that are said to be shorter than they are, or than what is asked of them.

    `held` counts the bytes that a buffer has, where that is known.
    """
    ends = Counter[int]()
    for view in document.buffer_views:
        ends[view.buffer] = max(ends[view.buffer], view.byte_offset + view.byte_length)
    for index, buffer in enumerate(document.buffers):
        said = in_digits(buffer.byte_length)
        if ends[index] > buffer.byte_length:
            yield (
                f"Buffer {index} is said to have {said} bytes, and buffer views reach to its byte "
                f"{in_digits(ends[index])}."
            )
        elif (held(index) or 0) > buffer.byte_length + PADDING:
            has = f"has {held(index)}: not all is read"
            yield f"Buffer {index} is said to have {said} bytes and {has}."


def in_digits(number: int) -> str:
    """Write a number that may have hundreds of digits.

    Examples
    --------
    >>> in_digits(36), in_digits(10**300)
    ('36', 'about 10^300')
    """
    digits = str(number)
    return digits if len(digits) <= MOST_DIGITS else f"about 10^{len(digits) - 1}"
