"""What an installed program has beside it: its manual page, and the documentation as it is read."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

READ = {".md", ".ipynb", ".png", ".svg", ".html", ".toml", ".csv", ".calc", ".gltf", ".ply"}
BESIDE = ("README.md", "CHANGELOG.md", "CITATION.cff", "LICENSE", "nmatrix/output/pages/OFL.txt")
MANUAL = "docs/nmatrix.1"


class Documents(BuildHookInterface[Any]):
    """Lays the documents where a system keeps them, under `share`."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Name the documents and their places."""
        root = Path(self.root)
        found = (path.relative_to(root) for path in sorted((root / "docs").rglob("*")))
        read = (one for one in found if one.suffix in READ and not set("._") & set(heads(one)))
        places = {name.as_posix(): f"share/doc/nmatrix/{name.as_posix()}" for name in read}
        places |= {name: f"share/doc/nmatrix/{name}" for name in BESIDE}
        places[MANUAL] = "share/man/man1/nmatrix.1"
        build_data["shared_data"] |= {str(root / name): place for name, place in places.items()}


def heads(name: Path) -> list[str]:
    """Take the first character of each part: a point or a line hides what is no document."""
    return [part[0] for part in name.parts]
