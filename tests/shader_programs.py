"""A corpus of small shaders, faulty and correct, of many dialects and habits of naming."""

from __future__ import annotations

from pathlib import Path

FOLDER = Path(__file__).parent / "lint"


def programs(file: str) -> dict[str, dict[str, str]]:
    """Read the sources of a corpus: files of one stem are one program."""
    found: dict[str, dict[str, str]] = {}
    for part in (FOLDER / file).read_text("utf-8").split("=== ")[1:]:
        name, text = part.split("\n", 1)
        stem = name if name.endswith("hlsl") else name.split(".")[0]
        found.setdefault(stem, {})[name] = text
    return found


FAULTY, CORRECT = programs("faulty.txt"), programs("correct.txt")
