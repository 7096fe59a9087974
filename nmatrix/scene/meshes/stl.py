"""STL files, binary or text: triangles that share nothing, so each is flat.

The normals that such files hold repeat what the corners say, or are wrong or zero: they are made.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.errors import IllegalValueError, printable
from nmatrix.scene.meshes.mesh import Mesh, cross_products, unit
from nmatrix.scene.meshes.parts import MeshFile, MeshPart
from nmatrix.scene.meshes.text import BLANKS, is_beyond, numbers, readable, refused_word
from nmatrix.scene.words import VERTEX, NormalsFrom, counted

Array = NDArray[np.float64]

HEADER, COUNT, TRIANGLE = 80, 4, 50  # bytes
TOGETHER = 1 << 16  # triangles whose normals are made at once
_RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_NAMES = re.compile(rb"^[ ]*(?:end)?solid\b[^\n]*", re.IGNORECASE | re.MULTILINE)
_COMMENT = re.compile(rb"#[^\n]*")
_VERTEX = re.compile(rb"vertex\s+(\S+\s+\S+\s+\S+)")


def read_stl(path: Path, content: bytes) -> MeshFile:
    """Read the triangles of an STL file, with the normals of their own planes.

    Raises
    ------
    IllegalValueError
        For a file that breaks off, or a coordinate that is no finite number.
    """
    positions, remarks = _from_text(path, content) if _is_text(content) else _binary(path, content)
    if not len(positions):
        return MeshFile((), (*remarks, f"{path.name} holds no triangles."), NormalsFrom.NONE)
    bad = ~np.isfinite(positions).all(axis=1)
    if bad.any():
        corner = int(np.argmax(bad))
        shown = " ".join(f"{one:g}" for one in positions[corner].tolist())
        raise IllegalValueError(
            f"{path}, triangle {corner // 3 + 1} ({shown})",
            "a coordinate is a finite number",
            "export it again",
        )
    triangles = np.arange(len(positions)).reshape(-1, 3)
    normals = np.empty_like(positions)
    for first in range(0, len(triangles), TOGETHER):
        some = cross_products(positions, triangles[first : first + TOGETHER])
        normals[3 * first :][: 3 * len(some)] = np.repeat(unit(some), 3, axis=0)
    mesh = Mesh(positions, normals, triangles)
    made = f"Normals were made, flat: {path.name} is drawn by the planes of its triangles."
    return MeshFile((MeshPart("", mesh),), (*remarks, made), NormalsFrom.COMPUTED)


def _is_text(content: bytes) -> bool:
    """Tell text from binary files, some of which begin with `solid` too."""
    if len(content) >= HEADER + COUNT:
        count = int.from_bytes(content[HEADER : HEADER + COUNT], "little")
        if len(content) == HEADER + COUNT + TRIANGLE * count:
            return False
    beginning = content[: 1 << 10].lower()
    return b"\0" not in beginning and (b"solid" in beginning or b"facet" in beginning)


def _binary(path: Path, content: bytes) -> tuple[Array, list[str]]:
    """Read the corners (3 T, 3) of a binary file."""
    held = len(content) - HEADER - COUNT
    if held < 0:
        raise IllegalValueError(
            f"{path}",
            f"it has {counted(len(content), 'byte')}, and an STL file begins with {HEADER + COUNT}",
            "copy the file again",
        )
    count = int.from_bytes(content[HEADER : HEADER + COUNT], "little")
    whole, rest = divmod(held, TRIANGLE)
    remarks = []
    if count > whole and rest:
        raise IllegalValueError(
            f"{path}",
            f"it breaks off in triangle {whole + 1:,} of {count:,}",
            "copy the file again",
        )
    if count > whole or (count == 0 and whole and not rest):
        remarks.append(
            f"The header counts {counted(count, 'triangle')}; {path.name} holds {whole:,}."
        )
        count = whole
    elif held > count * TRIANGLE:
        more = held - count * TRIANGLE
        remarks.append(f"Not read of {path.name}: {counted(more, 'byte')} after the last triangle.")
    records = np.frombuffer(content, _RECORD, count, HEADER + COUNT)
    if records["attribute"].any():
        remarks.append(f"Not drawn of {path.name}: the attribute bytes of triangles.")
    return records["corners"].astype(np.float64).reshape(-1, 3), remarks


def _from_text(path: Path, content: bytes) -> tuple[Array, list[str]]:
    """Read the corners (3 T, 3) of a text, which may hold several solids."""
    text = content.translate(BLANKS).replace(b"\r", b"\n")
    text = _NAMES.sub(b"", text).lower()
    if b"#" in text:
        text = _COMMENT.sub(b"", text)
    facets = text.split(b"endloop")
    for index, facet in enumerate(facets):
        is_last = index == len(facets) - 1
        corners = facet.count(b"vertex")
        if is_last and (corners or b"facet" in facet.replace(b"endfacet", b"")):
            why = f"it breaks off in facet {index + 1:,}"
            raise IllegalValueError(f"{path}", why, "copy the file again")
        if not is_last and corners != 3:
            why = f"facet {index + 1:,} has {counted(corners, *VERTEX)}, and a triangle has 3"
            raise IllegalValueError(f"{path}", why, "export it again")
    triangles = len(facets) - 1
    del facets
    values = numbers(b" ".join(_VERTEX.findall(text)), np.float64)
    if values is None or len(values) != 9 * triangles or is_beyond(values, text):
        raise _bad_vertex(path, content)
    return values.reshape(-1, 3), []


def _bad_vertex(path: Path, content: bytes) -> IllegalValueError:
    """Find the vertex that cannot be read, and its line."""
    text: Any = content.translate(BLANKS).replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    for number, line in enumerate(text.split(b"\n"), 1):
        words = line.lower().split()
        if b"vertex" not in words or words[0] in (b"solid", b"endsolid"):
            continue
        given = words[words.index(b"vertex") + 1 :][:3]
        why = f"a vertex has 3 numbers and this one {len(given)}" if len(given) < 3 else None
        for word in given:
            if word not in (b"nan", b"inf", b"-inf"):
                why = refused_word(word, whole=False) or why
        if why is not None:
            shown = printable(readable(line.strip()[:40]))
            return IllegalValueError(f"{path}, line {number} ({shown})", why, "mend that line")
    return IllegalValueError(f"{path}", "a vertex of it cannot be read", "export it again")
