"""Command lines of the site, run while it is built: what stands on a page is what was printed."""

from __future__ import annotations

import contextlib
import io
import os
import shlex
import sys
import tempfile
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from nmatrix.cli.app import run

ROOT = Path(__file__).resolve().parents[2]
SETTING = {"COLUMNS": "80", "NO_COLOR": "1"}
SHELL = set("|<>~")  # what only a shell understands


@cache
def printed(command: str) -> str:
    """Run a command line as in a terminal of 80 columns, in an empty folder of its own."""
    with tempfile.TemporaryDirectory() as name, _in_folder(Path(name)):
        if SHELL & set(command):
            return _by_a_shell(command, Path(name))
        screen = io.TextIOWrapper(io.BytesIO(), "utf-8", write_through=True)
        with contextlib.redirect_stdout(screen), contextlib.redirect_stderr(screen):
            run(shlex.split(command)[1:])
        return screen.buffer.getvalue().decode()


def transcript(command: str) -> str:
    """Show a command line and what it prints, as Markdown; what is long scrolls."""
    return f"```console\n$ {command}\n{printed(command).rstrip()}\n```\n"


@contextlib.contextmanager
def _in_folder(folder: Path) -> Iterator[None]:
    """Work in a folder, with the setting of a plain terminal."""
    before, old = {name: os.environ.get(name) for name in SETTING}, Path.cwd()
    os.environ |= SETTING
    os.chdir(folder)
    try:
        yield
    finally:
        os.chdir(old)
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


def _by_a_shell(command: str, folder: Path) -> str:
    """Run a command line with pipes or redirections, by the program that transcripts use."""
    sys.path.append(str(ROOT / "tests"))
    from transcripts import output

    return output(command, folder)
