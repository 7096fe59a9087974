"""What an installed program has beside it: its manual page, and the documentation as it is read."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

READ = {".md", ".ipynb", ".png", ".svg", ".html", ".toml", ".csv", ".calc", ".gltf", ".ply"}
MANUAL = "docs/nmatrix.1"


class Documents(BuildHookInterface[Any]):
    """Lays the documents where a system keeps them, under `share`."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Name the documents and their places."""
        root = Path(self.root)
        placed = {root / MANUAL: "share/man/man1/nmatrix.1"}
        for path in (root / "README.md", *sorted((root / "docs").rglob("*"))):
            name = path.relative_to(root)
            made = any(part.startswith(("_", ".")) for part in name.parts)  # by the site's build
            if path.suffix in READ and not made:
                placed[path] = f"share/doc/nmatrix/{name.as_posix()}"
        build_data["shared_data"] |= {str(path): place for path, place in placed.items()}
