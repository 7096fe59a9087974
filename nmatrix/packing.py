"""The program as one file that any Python runs without an installation: `nmatrix.pyz`.

    python -m nmatrix.packing nmatrix.pyz

It holds this package and the pure packages that the command line stands on, each with its licence.
What needs NumPy, SymPy or another compiled package finds it where the machine's Python has it, and
says so where not.
"""

from __future__ import annotations

import io
import sys
import zipfile
from collections.abc import Iterable, Iterator, Mapping, Sequence
from importlib.metadata import PackageNotFoundError, distribution
from importlib.resources import files
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING

from nmatrix.errors import IllegalValueError, NMatrixError, printable, refusal
from nmatrix.requirements import PROJECT, listed, missing, read_requirement
from nmatrix.version import __version__

if TYPE_CHECKING:
    from importlib.resources.abc import Traversable

# Modules, not what an index calls them. Rich asks for three packages more, for documents and
# sources that it would colour; nothing here does.
PURE = ("annotated_doc", "rich", "shellingham", "typer")
LICENCES = ("LICENSE", "LICENCE", "COPYING", "NOTICE")
USUAL = "nmatrix.pyz"
COMMAND = f"python -m nmatrix.packing {USUAL}"
UNUSED = ("__pycache__", "py.typed")
FIRST_DAY = (1980, 1, 1, 0, 0, 0)  # of zip files: none remembers when it was packed
REGULAR = 0o100644 << 16
SHEBANG = b"#!/usr/bin/env python3\n"
START = b"""\
import sys

if __name__ == "__main__":
    if sys.version_info < (3, 11):
        sys.exit("error: Python (%d.%d): nmatrix needs 3.11 or newer" % sys.version_info[:2])
    from nmatrix.__main__ import main

    main()
"""


def program() -> bytes:
    """Pack the whole program, the same bytes each time.

    Raises
    ------
    MissingPackageError
        If a package that goes into it is not here.

    Examples
    --------
    >>> with zipfile.ZipFile(io.BytesIO(program())) as packed:
    ...     [name for name in packed.namelist() if name.count("/") < 1]
    ['__main__.py']
    """
    content = {"__main__.py": START, **metadata(), **modules("nmatrix")}
    for one in PURE:
        content |= modules(one)
    return zipped(content, SHEBANG)


def modules(package: str) -> dict[str, bytes]:
    """Read the files of an installed package by their names in a zip file, and its licences.

    They are found where Python finds them, so that a packed program can pack itself again.

    Raises
    ------
    MissingPackageError
        If it is not installed.

    Examples
    --------
    >>> sorted(one for one in modules("shellingham") if one.count("/") == 1)[:2]
    ['shellingham/LICENSE', 'shellingham/__init__.py']
    """
    try:
        folder = files(package)
    except ModuleNotFoundError:
        raise missing("a packed program", package) from None
    read = dict(_files_below(folder, PurePosixPath(package)))
    return read | {f"{package}/{one.name}": one.read_bytes() for one in _licences(package)}


def metadata() -> dict[str, bytes]:
    """Write what a zip file needs to know of this package's version and requirements."""
    lines = ["Metadata-Version: 2.1", "Name: nmatrix", f"Version: {__version__}"]
    lines += sorted(f"Requires-Dist: {_in_one_spelling(one)}" for one in listed())
    return {f"nmatrix-{__version__}.dist-info/METADATA": "\n".join([*lines, ""]).encode()}


def _in_one_spelling(requirement: str) -> str:
    """Write a requirement alike, whether a project or a built package lists it."""
    marker = requirement.partition(";")[2].strip()
    return "; ".join(filter(None, (read_requirement(requirement)[1], marker)))


def zipped(content: Mapping[str, bytes], head: bytes = b"") -> bytes:
    """Zip files by their names: sorted, undated, readable to all, so that bytes are the same.

    A zip file is found from its end: a head in front of it, `#!…`, makes it a program.

    Examples
    --------
    >>> zipped({"a": b"1", "b": b"2"}) == zipped({"b": b"2", "a": b"1"})
    True
    """
    stream = io.BytesIO()
    stream.write(head)
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as packed:
        for name in sorted(content):
            entry = zipfile.ZipInfo(name, FIRST_DAY)
            entry.compress_type, entry.external_attr, entry.create_system = (
                zipfile.ZIP_DEFLATED,
                REGULAR,
                3,  # Unix, whose permissions these are, on every system
            )
            packed.writestr(entry, content[name])
    return stream.getvalue()


def _files_below(folder: Traversable, name: PurePosixPath) -> Iterator[tuple[str, bytes]]:
    for one in folder.iterdir():
        inner = name / one.name
        if one.name in UNUSED or one.name.startswith("."):
            continue
        if one.is_dir():
            yield from _files_below(one, inner)
        else:
            yield str(inner), one.read_bytes()


def _licences(package: str) -> Iterable[Path]:
    if package == "nmatrix" and PROJECT.is_file():
        return [PROJECT.with_name("LICENSE")]
    try:
        brought = distribution(package).files or ()
    except PackageNotFoundError:  # itself packed: they lie among its modules
        return ()
    return [
        Path(str(one.locate()))
        for one in brought
        if one.parts[0].endswith(".dist-info") and one.name.upper().startswith(LICENCES)
    ]


def write(path: Path) -> None:
    """Write the program to a file that may be run as it is, in place of an older one.

    Raises
    ------
    IllegalValueError
        If something else lies there, or the file system refuses.
    """
    told, step = f"file ({printable(str(path))})", "choose another name"
    try:
        if path.exists() and not zipfile.is_zipfile(path):
            raise IllegalValueError(told, "it is there, and is no packed program", step)
        path.write_bytes(program())
        path.chmod(0o755)
    except OSError as error:
        raise IllegalValueError(told, refusal(error), step) from None


def main(words: Sequence[str]) -> int:
    """Write the program to the file that the words name, or tell in a line why not."""
    try:
        if len(words) > 1 or any(one.startswith("-") for one in words):
            raise IllegalValueError("arguments", "they name one file", f"try {COMMAND}")
        path = Path(*words) if words else Path(USUAL)
        write(path)
    except NMatrixError as error:
        sys.stderr.write(f"error: {error}\n")
        return error.exit_code
    sys.stdout.write(f"Written: {path}\n")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
