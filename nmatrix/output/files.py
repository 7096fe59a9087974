"""Files that are what their names say, written whole or not at all, never over another one."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TypeVar

from nmatrix.enums import PixelFormat, VectorFormat
from nmatrix.errors import IllegalValueError, printable, quantity, refusal

Kind = TypeVar("Kind")

PICTURES: Mapping[str, PixelFormat] = {
    **{f".{one}": one for one in PixelFormat},
    ".jpg": PixelFormat.JPEG,
}
_VECTORS: Mapping[str, VectorFormat] = {f".{one}": one for one in VectorFormat}
CHARTS: Mapping[str, PixelFormat | VectorFormat] = {**_VECTORS, **PICTURES}
SLIDES: Mapping[str, PixelFormat | VectorFormat] = {**PICTURES, **_VECTORS}


def kind_of(path: Path, kinds: Mapping[str, Kind], name: str = "output") -> Kind:
    """Choose what is written into a file by the ending of its name, in upper case or lower.

    A device or a pipe may be called anything and gets the first of the kinds.

    Raises
    ------
    IllegalValueError
        For another ending, or none; it lists those of the kinds.

    Examples
    --------
    >>> kind_of(Path("a.JPG"), PICTURES).value
    'jpeg'
    """
    if path.exists() and not _is_taken(path):
        return next(iter(kinds.values()))
    found = kinds.get(path.suffix.lower())
    if found is None:
        why = f"its ending says what is written: {', '.join(kinds)}"
        if kinds is PICTURES and path.suffix.lower() in _VECTORS:
            why = f"a picture of a scene is pixels, and only a proof is lines: {', '.join(kinds)}"
        raise IllegalValueError(
            f"{quantity(name)} ({printable(str(path)[-60:])})",
            why,
            f"end it in {next(iter(kinds))}",
        )
    return found


def refuse_existing(paths: Sequence[Path], *, force: bool) -> None:
    """Refuse to overwrite, before the work is done and not after.

    Raises
    ------
    IllegalValueError
        If one of the files exists and `force` is not given, or their folder does not exist.
    """
    for path in paths:
        if str(path) == "-":
            continue
        if _is_taken(path) and not force:
            raise _exists(path)
        if not path.parent.is_dir():
            raise IllegalValueError(
                f"{path}",
                f"there is no folder {path.parent}",
                f"choose another one with {quantity('output')}",
            )


def _is_taken(path: Path) -> bool:
    """Whether something would be lost; a device or a pipe loses nothing."""
    return path.is_file() or path.is_dir()


def _exists(path: Path) -> IllegalValueError:
    instead = "use " if path.is_dir() else f"use {quantity('force')}, or "
    return IllegalValueError(
        f"{path}",
        "it is a folder" if path.is_dir() else "the file exists",
        f"{instead}{quantity('output')} with another name",
    )


def write_file(path: Path, content: bytes, *, force: bool = False) -> None:
    """Write a file under a temporary name beside its place, then rename it.

    A device or a pipe is written to, not replaced.

    Raises
    ------
    IllegalValueError
        If the file exists and `force` is not given, or the place cannot be written.
    """
    if _is_taken(path) and not force:
        raise _exists(path)
    try:
        if path.exists() and not _is_taken(path):
            path.write_bytes(content)
            return
        descriptor, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
        try:
            with os.fdopen(descriptor, "wb") as file:
                file.write(content)
            Path(temporary).chmod(0o644)
            Path(temporary).replace(path)
        except BaseException:
            Path(temporary).unlink(missing_ok=True)
            raise
    except OSError as error:
        raise IllegalValueError(
            f"{path}",
            f"it cannot be written ({refusal(error)})",
            f"choose another folder with {quantity('output')}",
        ) from None
