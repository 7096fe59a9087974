"""The console transcripts of the documentation: run every command, put its output below it.

`python tests/transcripts.py` writes them anew; the tests compare.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PAGES = (ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md")))
BLOCK = re.compile(r"```console\n(.*?)```", re.DOTALL)


def output(command: str, folder: Path) -> str:
    """Return what a shell in a folder shows for a command, `nmatrix` being this checkout's."""
    script = f'nmatrix() {{ "{sys.executable}" -m nmatrix "$@"; }}; {command}'
    done = subprocess.run(
        ["bash", "-c", script],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
        cwd=folder,
        env={
            **os.environ, "NO_COLOR": "1", "PYTHONIOENCODING": "utf-8", "PYTHONPATH": str(ROOT),
            "PYTHONUNBUFFERED": "1",
        },
    )  # fmt: skip
    return done.stdout


def filled(text: str) -> str:
    """Return a page with the output of every command below it.

    The commands run in a folder of the page's own, beside the documentation: what they write is
    nobody else's.
    """
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "docs").symlink_to(ROOT / "docs")

        def run(block: re.Match[str]) -> str:
            commands = [line for line in block[1].splitlines() if line.startswith("$ ")]
            shown = "".join(f"{one}\n{output(one[2:], folder)}" for one in commands)
            return f"```console\n{shown}```"

        return BLOCK.sub(run, text)


if __name__ == "__main__":
    for page in PAGES:
        page.write_text(filled(page.read_text()))
