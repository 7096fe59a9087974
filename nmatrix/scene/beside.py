"""The files of an asset: its own bytes, and the files that it names, which lie in its folder."""

from __future__ import annotations

import re
import stat
from pathlib import Path, PureWindowsPath

from nmatrix.errors import IllegalValueError, counted, printable, quantity

POINTER = b"version https://git-lfs.github.com/spec/"  # how a pointer of Git LFS begins
LONGEST_POINTER = 1024
_SIZE = re.compile(rb"^size (\d+)\s*$", re.MULTILINE)
_ADDRESS = re.compile(r"[A-Za-z][A-Za-z0-9+.-]+:")  # two letters at least: C: is a drive


def asset_bytes(path: Path) -> bytes:
    """Read the whole of an asset's file.

    Raises
    ------
    IllegalValueError
        If there is no such file, it is empty, or it only points to where its content is.
    """
    try:
        check_ends(path)
        content = path.read_bytes()
    except IllegalValueError:
        raise
    except (OSError, ValueError) as error:  # a name with a NUL is a ValueError
        reason = getattr(error, "strerror", None) or "no file has such a name"
        raise IllegalValueError(f"{path}", _in_words(reason), "check the name") from None
    check_content(path, content)
    return content


def check_ends(path: Path) -> None:
    """Refuse what may never end: an asset names a file, and neither a pipe nor a device.

    Raises
    ------
    IllegalValueError
        If it is one.
    OSError, ValueError
        If there is no such file.
    """
    kind = path.stat().st_mode
    if not (stat.S_ISREG(kind) or stat.S_ISDIR(kind)):  # to read a folder is an error of its own
        why = "it is a pipe or a device, and no file"
        raise IllegalValueError(f"{path}", why, "save what comes from it as a file")


def check_content(path: Path, content: bytes) -> None:
    """Refuse content that holds no asset whatever its format is.

    Raises
    ------
    IllegalValueError
        If it is empty, or a pointer of Git LFS.
    """
    if not content.strip():
        raise IllegalValueError(f"{path}", "it is empty", "copy the file again")
    if content.startswith(POINTER) and len(content) <= LONGEST_POINTER:
        size = _SIZE.search(content)
        told = f" of {counted(int(size[1]), 'byte')}" if size else ""
        why = f"it is a pointer of Git LFS: the file itself{told} was not fetched"
        raise IllegalValueError(f"{path}", why, "run git lfs pull")


def beside(file: Path, name: str, *, allow_outside: bool = False) -> Path:
    """Find the path of a file that another one names; it need not exist.

    An asset may come from anyone, so it reaches nothing outside its own folder: neither by `..`,
    by an absolute path, by a link, nor by an address.

    Raises
    ------
    IllegalValueError
        If the name leads out of the folder and that was not allowed, or it is an address.

    Examples
    --------
    >>> beside(Path("models/cube.gltf"), "images/a.png").as_posix()
    'models/images/a.png'
    >>> beside(Path("models/cube.gltf"), "../a.png")
    Traceback (most recent call last):
    nmatrix.errors.IllegalValueError: models/cube.gltf: it names ../a.png, which lies ...
    """
    shown = printable(name)
    if _ADDRESS.match(name) and not name.lower().startswith("file:"):
        why = f"it names {shown}, an address, and nothing is fetched"
        raise IllegalValueError(f"{file}", why, "save that file beside it and name it")
    is_file_address = name.lower().startswith("file:")
    windows = PureWindowsPath(name)
    is_absolute = is_file_address or Path(name).is_absolute() or bool(windows.drive or windows.root)
    target = Path(name[5:].removeprefix("//")) if is_file_address else file.parent / name
    if allow_outside:
        return target
    if is_absolute or not _is_below(target, file.parent):
        why = f"it names {shown}, which lies outside its folder"
        next_step = f"if you trust it, add {quantity('allow_outside')}"
        raise IllegalValueError(f"{file}", why, next_step)
    return target


def _is_below(target: Path, folder: Path) -> bool:
    try:
        return target.resolve().is_relative_to(folder.resolve())
    except (OSError, ValueError, RuntimeError):  # no file has such a name, or links go in circles
        return ".." not in target.parts


def _in_words(reason: str) -> str:
    """Start an operating system's reason as the part of a sentence that it is here."""
    return reason[:1].lower() + reason[1:]
