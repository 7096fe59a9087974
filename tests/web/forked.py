"""Many command lines as processes of their own, forked from one that has the program loaded.

`python forked.py` reads a list of {words, files} as JSON from stdin and writes a list of
{code, out, err, files}: what each left in its pipes, and in an empty folder of its own.
"""

from __future__ import annotations

import json
import os
import sys
import tempfile
from base64 import b64encode
from contextlib import suppress
from importlib import import_module
from pathlib import Path
from pkgutil import walk_packages
from typing import NoReturn

import nmatrix

LARGE = ("numpy", "sympy", "msgspec", "matplotlib", "PIL", "tree_sitter", "numba")


def main() -> None:
    asked = json.load(sys.stdin)
    load_what_is_light()
    done = [answer(one["words"], one.get("files") or {}) for one in asked]
    json.dump(done, sys.stdout)


def load_what_is_light() -> None:
    """Load all modules once, but those that stand on large packages: a fork copies every page."""
    sys.modules.update(dict.fromkeys(LARGE))
    for one in walk_packages(nmatrix.__path__, "nmatrix.", onerror=lambda _: None):
        if one.name != "nmatrix.__main__":
            with suppress(ImportError):
                import_module(one.name)
    for name in LARGE:
        del sys.modules[name]


def answer(words: list[str], files: dict[str, str]) -> dict[str, object]:
    with tempfile.TemporaryDirectory() as own, tempfile.TemporaryDirectory() as pipes:
        for name, text in files.items():
            place = Path(pipes, "stdin") if name == "-" else Path(own, name)
            place.write_bytes(text.encode())
        Path(pipes, "stdin").touch()
        child = os.fork()
        if child == 0:
            run(words, own, pipes)
        _, status = os.waitpid(child, 0)
        out, err = (Path(pipes, one).read_bytes().decode() for one in ("stdout", "stderr"))
        code = os.waitstatus_to_exitcode(status)
        return {"code": code, "out": out, "err": err, "files": written(Path(own), files)}


def written(folder: Path, given: dict[str, str]) -> dict[str, str]:
    """Files by their names, in Base64, without those that lay there before."""
    found = {
        str(path.relative_to(folder)): path.read_bytes()
        for path in folder.rglob("*")
        if path.is_file()
    }
    new = {name: one for name, one in found.items() if given.get(name, "").encode() != one}
    return {name: b64encode(one).decode() for name, one in sorted(new.items())}


def run(words: list[str], own: str, pipes: str) -> NoReturn:
    os.chdir(own)
    for number, name in enumerate(("stdin", "stdout", "stderr")):
        how = os.O_RDONLY if number == 0 else os.O_WRONLY | os.O_CREAT
        os.dup2(os.open(Path(pipes, name), how), number)
    # Three streams that have read and written nothing yet.
    sys.stdin, sys.stdout, sys.stderr = (
        os.fdopen(number, mode, encoding="utf-8", errors=errors, closefd=False)
        for number, mode, errors in (
            (0, "r", "strict"),
            (1, "w", "strict"),
            (2, "w", "backslashreplace"),
        )
    )
    sys.argv = ["nmatrix", *words]
    from nmatrix.__main__ import main as program

    code: object = 0
    try:
        program()
    except SystemExit as left:
        code = left.code
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(int(code or 0))


if __name__ == "__main__":
    main()
