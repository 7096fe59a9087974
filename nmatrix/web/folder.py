"""The folder that `nmatrix web` writes: the pages, this program, and a Python that browsers run.

Pyodide is CPython compiled for browsers; npm's package of it is copied as it is. Beside it lies one
zip file with this package and the pure packages that the command line stands on. All addresses in
the folder are relative, and nothing in it asks another host.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from importlib.resources import files
from pathlib import Path, PurePosixPath
from zlib import adler32

from nmatrix.errors import IllegalValueError, MissingPackageError, printable, quantity, refusal
from nmatrix.output.explorer.page import colours
from nmatrix.output.files import write_file
from nmatrix.packing import metadata, modules, zipped
from nmatrix.version import __version__

BRINGS_PYODIDE = "npm install pyodide"
PYTHON = (
    "pyodide.mjs",
    "pyodide.asm.mjs",
    "pyodide.asm.wasm",
    "python_stdlib.zip",
)
LOCK = "pyodide-lock.json"  # the list of its packages
PURE = ("annotated_doc", "shellingham", "typer")  # Rich draws bars on terminals alone
PROGRAM, EXPLORER, COLOURS, CONTENTS = "nmatrix.zip", "explorer.html", "colours.css", "folder.json"
ENDINGS = (".css", ".html", ".js", ".svg")  # of the files that are the pages
FONT = "math.woff2"  # of the formulas: phones have none whose brackets stretch
LICENCES = """\
nmatrix %s is MIT, its font of mathematics OFL-1.1. Pyodide %s is MPL-2.0: npm's package pyodide
says where its source is; the Python in it is under the licence of the Python Software Foundation.
The packages in nmatrix.zip lie there beside their licences.
"""


def folder(pyodide: Path, explorer: Callable[[], bytes]) -> dict[str, bytes]:
    """Make the files of the folder, by their names: the same bytes each time.

    Parameters
    ----------
    pyodide
        Where npm's package is.
    explorer
        Writes the explorer's page.

    Raises
    ------
    MissingPackageError
        Without Pyodide; it tells the command that brings it.
    """
    python, version = _python(pyodide)
    found = {
        **pages(),
        **python,
        COLOURS: colours().encode(),
        EXPLORER: explorer(),
        PROGRAM: program(),
        "licences.txt": (LICENCES % (__version__, version)).encode(),
    }
    told = {
        "version": __version__,
        "python": list(python),
        "program": PROGRAM,
        "bytes": {name: len(found[name]) for name in (*python, PROGRAM)},
        "sums": {name: adler32(found[name]) for name in (*python, PROGRAM)},
    }
    return {**found, CONTENTS: f"{json.dumps(told, indent=1)}\n".encode()}


def pages() -> dict[str, bytes]:
    """Read the pages, their style and their scripts.

    Examples
    --------
    >>> {"index.html", "engine.js", "worker.js"} <= set(pages())
    True
    """
    found = (one for one in files(__package__).joinpath("pages").iterdir())
    own = {one.name: one.read_bytes() for one in found if one.name.endswith(ENDINGS)}
    return {**own, FONT: files("nmatrix.output.pages").joinpath(FONT).read_bytes()}


def program() -> bytes:
    """Pack this package and the pure ones below it; the pages lie outside already."""
    content: dict[str, bytes] = {**metadata(), **modules("nmatrix")}
    for one in PURE:
        content |= modules(one)
    own = PurePosixPath("nmatrix/web/pages")
    return zipped({name: one for name, one in content.items() if PurePosixPath(name).parent != own})


def write(target: Path, content: Mapping[str, bytes], *, force: bool) -> None:
    """Write the files, each whole or not at all.

    Raises
    ------
    IllegalValueError
        If something lies there already unless `force`, or the file system refuses.
    """
    told = f"{quantity('output')} ({printable(str(target))})"
    try:
        if target.exists() and not target.is_dir():
            raise IllegalValueError(told, "it is a file", "name a folder")
        if target.is_dir() and any(target.iterdir()) and not force:
            step = f"use {quantity('force')}, or name another"
            raise IllegalValueError(told, "the folder is not empty", step)
        target.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise IllegalValueError(told, refusal(error), "name another folder") from None
    for name, one in content.items():
        write_file(target / name, one, force=True)


def _python(pyodide: Path) -> tuple[dict[str, bytes], str]:
    """Read the files of Pyodide, and its version; of the packages that it could load none is."""
    try:
        found = {name: (pyodide / name).read_bytes() for name in (*PYTHON, LOCK)}
        version = json.loads((pyodide / "package.json").read_bytes())["version"]
        lock = {"info": json.loads(found[LOCK])["info"], "packages": {}}
    except OSError as error:
        missing = Path(error.filename or pyodide).name
        raise MissingPackageError(
            f"{quantity('pyodide')} ({printable(str(pyodide))})",
            f"the Python for browsers is not there ({missing}: {refusal(error)})",
            f"run {BRINGS_PYODIDE} in this folder, or name the one that holds {missing}",
        ) from None
    except (ValueError, KeyError, TypeError):
        raise IllegalValueError(
            f"{quantity('pyodide')} ({printable(str(pyodide))})",
            f"package.json or {LOCK} there is not that of npm's package pyodide",
            f"bring it again with {BRINGS_PYODIDE}",
        ) from None
    return {**found, LOCK: json.dumps(lock).encode()}, str(version)
