"""Which files a command line means by names of files and folders.

A folder is searched to its depths, in the order of names. Hidden files and folders are passed over,
and links to folders are not followed: a circle of links would have no end.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from nmatrix.errors import IllegalValueError, printable

STANDARD_INPUT = "-"


def files_of(names: Iterable[str], suffixes: Sequence[str]) -> tuple[Path, ...]:
    """Find the files that names of files and folders mean, each once; `-` stays what it is.

    Of a folder only files with one of the suffixes count; a file that is named is taken as it is.

    Raises
    ------
    IllegalValueError
        For a name that nothing has, or a folder without any such file.

    Examples
    --------
    >>> [str(path) for path in files_of(["-"], (".obj",))]
    ['-']
    """
    found: dict[Path, Path] = {}
    for name in names:
        for path in _meant(name, suffixes):
            found.setdefault(path if name == STANDARD_INPUT else _one(path), path)
    return tuple(found.values())


def _meant(name: str, suffixes: Sequence[str]) -> Iterator[Path]:
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
            f"give a {_listed(suffixes)} file, a folder, or - for standard input",
        )
    if not is_folder:
        yield path
        return
    inside = list(_inside(path, suffixes))
    if not inside:
        raise IllegalValueError(
            f"folder ({printable(name)})",
            f"it holds no {_listed(suffixes)} file",
            "give another folder",
        )
    yield from inside


def _listed(suffixes: Sequence[str]) -> str:
    return f"{', '.join(suffixes[:-1])} or {suffixes[-1]}"


def _inside(folder: Path, suffixes: Sequence[str]) -> Iterator[Path]:
    """Walk through a folder; one that may not be opened is passed on, so that it gets its row."""
    refused: list[OSError] = []
    for here, folders, files in os.walk(folder, onerror=refused.append):
        folders[:] = sorted(one for one in folders if not one.startswith("."))
        for file in sorted(files):
            if not file.startswith(".") and Path(file).suffix.lower() in suffixes:
                yield Path(here, file)
    yield from (Path(error.filename) for error in refused)


def _one(path: Path) -> Path:
    """Name a file in the one way that all its names come to."""
    try:
        return path.resolve()
    except (OSError, RuntimeError):  # a circle of links
        return path
