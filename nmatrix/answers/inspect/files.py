"""Many files: which ones a command line means, each inspected by itself.

A folder is searched to its depths, in the order of names. Hidden files and folders are passed over,
and links to folders are not followed: a circle of links would have no end.
"""

from __future__ import annotations

import codecs
import os
import re
from collections.abc import Iterable, Iterator
from pathlib import Path

from nmatrix.answers.inspect.file import STANDARD_INPUT, InspectedFile, inspect_file
from nmatrix.errors import IllegalValueError, printable
from nmatrix.linear.classify import FROM_FILE
from nmatrix.scene.gltf.container import MAGIC
from nmatrix.scene.words import GLTF_SUFFIXES, MESH_SUFFIXES

SUFFIXES = (*GLTF_SUFFIXES, *MESH_SUFFIXES)
STL_HEADER, STL_TRIANGLE = 80, 50  # bytes
OBJ_STATEMENT = re.compile(rb"^\s*(?:v|vn|vt|f|l|p|o|g|s|mtllib|usemtl)\s", re.MULTILINE)


def files_of(names: Iterable[str]) -> tuple[Path, ...]:
    """Find the files that names of files and folders mean, each once; `-` stays what it is.

    Raises
    ------
    IllegalValueError
        For a name that nothing has, or a folder without any such file.
    """
    found: dict[Path, Path] = {}
    for name in names:
        for path in _meant(name):
            found.setdefault(path if name == STANDARD_INPUT else _one(path), path)
    return tuple(found.values())


def _meant(name: str) -> Iterator[Path]:
    path = Path(name)
    if name == STANDARD_INPUT:
        yield path
        return
    try:
        is_folder, exists = path.is_dir(), path.exists()
    except (OSError, ValueError):  # a name too long, or with a NUL: no file has it
        is_folder = exists = False
    if not exists:
        raise IllegalValueError(
            f"file ({printable(name)})",
            "it does not exist",
            f"give a {_listed()} file, a folder, or - for standard input",
        )
    if not is_folder:
        yield path
        return
    inside = list(_inside(path))
    if not inside:
        raise IllegalValueError(
            f"folder ({printable(name)})", f"it holds no {_listed()} file", "give another folder"
        )
    yield from inside


def _listed() -> str:
    return f"{', '.join(SUFFIXES[:-1])} or {SUFFIXES[-1]}"


def _inside(folder: Path) -> Iterator[Path]:
    """Walk through a folder; one that may not be opened is passed on, so that it gets its row."""
    refused: list[OSError] = []
    for here, folders, files in os.walk(folder, onerror=refused.append):
        folders[:] = sorted(one for one in folders if not one.startswith("."))
        for file in sorted(files):
            if not file.startswith(".") and Path(file).suffix.lower() in SUFFIXES:
                yield Path(here, file)
    yield from (Path(error.filename) for error in refused)


def _one(path: Path) -> Path:
    """Name a file in the one way that all its names come to."""
    try:
        return path.resolve()
    except (OSError, RuntimeError):  # a circle of links
        return path


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
