"""The container of a `.glb` file: a header, a chunk of JSON, and perhaps a chunk of bytes."""

from __future__ import annotations

import codecs
import struct
from collections.abc import Iterator
from pathlib import Path

from nmatrix.errors import IllegalValueError, quoted
from nmatrix.scene.gltf.document import check_version
from nmatrix.scene.gltf.records import Asset

MAGIC, SUFFIX = b"glTF", ".glb"
MOST_SHOWN = 12  # bytes of a file that begins with something else
HEADER, CHUNK_HEADER = 12, 8  # bytes
VERSION, OLD_VERSION = 2, 1  # the older is that of glTF 1.0
JSON_CHUNK, BINARY_CHUNK = 0x4E4F534A, 0x004E4942


def json_and_bytes(path: Path, content: bytes) -> tuple[bytes, bytes]:
    """Split a file into its JSON and the bytes behind it; one that is no container is all JSON.

    What the file is called matters only where it begins like neither.

    Raises
    ------
    IllegalValueError
        For a container that is cut short, of another version, or does not begin with JSON.
    """
    if content[: len(MAGIC)] == MAGIC:
        return _opened(path, content)
    if path.suffix.lower() == SUFFIX:
        head = content.removeprefix(codecs.BOM_UTF8).lstrip()
        if not head.startswith(b"{"):
            begins = quoted(content[:MOST_SHOWN].decode("latin-1"))
            why = f"a {SUFFIX} file begins with {MAGIC.decode()}, and it begins with {begins}"
            raise _fault(path, why)
    return content, b""


def _opened(path: Path, content: bytes) -> tuple[bytes, bytes]:
    if len(content) < HEADER:
        raise _cut_short(path, "its header")
    (version,) = struct.unpack_from("<I", content, len(MAGIC))
    if version == OLD_VERSION:
        check_version(path, Asset(version="1.0"))
    if version != VERSION:
        raise _fault(path, f"its container is of version {version}, and {VERSION} is read")
    chunks = list(_chunks(path, content))
    if not chunks and len(content) > HEADER:
        raise _cut_short(path, "the header of a chunk")
    if not chunks:
        raise _fault(path, "its container is empty: it has no chunk of JSON")
    kind, text = chunks[0]
    if kind != JSON_CHUNK:
        found = "BIN" if kind == BINARY_CHUNK else f"of the unknown type 0x{kind:08X}"
        raise _fault(path, f"its first chunk is {found}, and not JSON")
    return text, next((chunk for kind, chunk in chunks if kind == BINARY_CHUNK), b"")


def _chunks(path: Path, content: bytes) -> Iterator[tuple[int, bytes]]:
    """Walk over the chunks, with the type of each; a few bytes behind the last are padding."""
    at = HEADER
    while at + CHUNK_HEADER <= len(content):
        length, kind = struct.unpack_from("<II", content, at)
        at += CHUNK_HEADER
        if at + length > len(content):
            raise _cut_short(path, "a chunk")
        yield kind, content[at : at + length]
        at += length


def _cut_short(path: Path, where: str) -> IllegalValueError:
    return _fault(path, f"the file ends in the middle of {where}", "copy it again")


def _fault(path: Path, why: str, next_step: str = "export it again") -> IllegalValueError:
    return IllegalValueError(f"{path}", why, next_step)
