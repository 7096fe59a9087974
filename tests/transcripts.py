"""The transcripts, the sample pages and the pictures of the documentation: what the commands make.

`python tests/transcripts.py` writes them anew; the tests compare.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from nmatrix import Picture, render
from nmatrix.raster.proofs.catalogue import PROOFS

ROOT = Path(__file__).resolve().parents[1]
REFERENCE = ROOT / "docs" / "reference.md"  # made of docstrings, which run where they stand
PAGES = (
    ROOT / "README.md",
    *(page for page in sorted((ROOT / "docs").glob("*.md")) if page != REFERENCE),
)
SHOWN = (1200, 675)  # pixels of a proof
PICTURES = ROOT / "docs" / "pictures"
SAMPLES = ROOT / "docs" / "samples"
SHEET = 'nmatrix handout --scale 1 2 1 --seed 7 --student "Ada Lovelace" --key -o handout.html'
EXPLORER = "nmatrix explore --scale 1 2 1 --light-direction -1 -2 -1 -o explorer.html"
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


def sampled(folder: Path) -> list[Path]:
    """Write the sample pages into a folder and return them."""
    for command in (SHEET, EXPLORER):
        output(command, folder)
    return sorted(folder.glob("*.html"))


def picture(proof: str) -> Picture:
    """Draw a proof as the documentation shows it."""
    return render(proof, size=SHOWN)


if __name__ == "__main__":
    for one in PROOFS:
        (PICTURES / f"{one.name}.png").write_bytes(picture(one.name).png)
    with tempfile.TemporaryDirectory() as name:
        for sample in sampled(Path(name)):
            (SAMPLES / sample.name).write_bytes(sample.read_bytes())
    for page in PAGES:
        page.write_text(filled(page.read_text()))
