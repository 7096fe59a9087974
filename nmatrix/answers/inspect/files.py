"""Many files, each inspected by itself."""

from __future__ import annotations

import codecs
import re
from pathlib import Path

from nmatrix.answers.inspect.file import InspectedFile, inspect_file
from nmatrix.errors import IllegalValueError
from nmatrix.linear.classify import FROM_FILE
from nmatrix.reading.folders import STANDARD_INPUT
from nmatrix.scene.gltf.container import MAGIC
from nmatrix.scene.words import GLTF_SUFFIXES, MESH_SUFFIXES

SUFFIXES = (*GLTF_SUFFIXES, *MESH_SUFFIXES)
STL_HEADER, STL_TRIANGLE = 80, 50  # bytes
OBJ_STATEMENT = re.compile(rb"^\s*(?:v|vn|vt|f|l|p|o|g|s|mtllib|usemtl)\s", re.MULTILINE)


def inspected(
    path: Path,
    tolerance: float = FROM_FILE,
    *,
    standard_input: bytes = b"",
    allow_outside: bool = False,
) -> InspectedFile:
    """Inspect a file; an error is what becomes of it, and no end of the others."""
    content = None
    try:
        if str(path) == STANDARD_INPUT:
            content, path = standard_input, Path(f"standard-input{_ending(standard_input)}")
        elif path.is_dir():
            raise IllegalValueError(f"{path}", "it may not be opened", "check its permissions")
        return inspect_file(path, tolerance, content=content, allow_outside=allow_outside)
    except IllegalValueError as error:
        return InspectedFile(str(path) if content is None else STANDARD_INPUT, error=error)


def _ending(content: bytes) -> str:
    r"""Recognise a format by the beginning of its content, and by its length.

    Raises
    ------
    IllegalValueError
        If it is none of those that are read.

    Examples
    --------
    >>> _ending(b'{"asset": {}}'), _ending(b"ply\nformat"), _ending(b"# a cube\nv 0 0 0")
    ('.gltf', '.ply', '.obj')
    """
    head = content.removeprefix(codecs.BOM_UTF8).lstrip()
    if content[:4] == MAGIC:
        return ".glb"
    if head.startswith(b"{"):
        return ".gltf"
    if head.startswith(b"ply"):
        return ".ply"
    triangles = int.from_bytes(content[STL_HEADER : STL_HEADER + 4], "little")
    is_binary_stl = len(content) == STL_HEADER + 4 + STL_TRIANGLE * triangles
    if is_binary_stl or head.startswith(b"solid"):
        return ".stl"
    if OBJ_STATEMENT.search(content):
        return ".obj"
    raise IllegalValueError(
        "standard input",
        "it is empty" if not head else "it is neither glTF, OBJ, PLY nor STL",
        "pass the content of such a file",
    )
