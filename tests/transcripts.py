"""The console transcripts of the documentation: run every command, put its output below it.

`python tests/transcripts.py` writes them anew; the tests compare.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PAGES = (ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md")))
BLOCK = re.compile(r"```console\n(.*?)```", re.DOTALL)


def output(command: str) -> str:
    """Return what a shell shows for a command, `nmatrix` being this checkout's."""
    script = f'nmatrix() {{ "{sys.executable}" -m nmatrix "$@"; }}; {command}'
    done = subprocess.run(
        ["bash", "-c", script],
        capture_output=True,
        text=True,
        check=False,
        cwd=ROOT,
        env={**os.environ, "NO_COLOR": "1", "PYTHONIOENCODING": "utf-8"},
    )
    return done.stdout + done.stderr


def filled(text: str) -> str:
    """Return a page with the output of every command below it."""

    def run(block: re.Match[str]) -> str:
        commands = [line for line in block[1].splitlines() if line.startswith("$ ")]
        return "```console\n" + "".join(f"{c}\n{output(c[2:])}" for c in commands) + "```"

    return BLOCK.sub(run, text)


if __name__ == "__main__":
    for page in PAGES:
        page.write_text(filled(page.read_text()))
