"""The notebooks of the documentation: run from their first cell, and kept with what they show.

`python tests/notebooks.py` runs them and writes their outputs anew; a test compares. What differs
from one run to the next (counts, times, names of widgets) is left out, so a notebook changes where
its outputs do.
"""

from __future__ import annotations

import os
import sys
import tempfile
from pathlib import Path
from typing import Any
from unittest import mock

ROOT = Path(__file__).resolve().parents[1]
FOLDER = ROOT / "docs" / "notebook"
NOTEBOOKS = tuple(sorted(FOLDER.glob("*.ipynb")))
LONGEST = 60  # seconds that a cell may take
VARIES = "varies"  # the tag of a cell whose output depends on what is installed
LANGUAGE = {
    "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
    "language_info": {"name": "python"},
}


def executed(path: Path) -> Any:
    """Run a notebook in a folder of its own, with this checkout's package, and return it."""
    import nbformat
    from nbclient import NotebookClient

    notebook = nbformat.read(path, as_version=4)
    with tempfile.TemporaryDirectory() as folder:
        own = {
            "PYTHONPATH": str(ROOT),
            "IPYTHONDIR": folder,  # nobody's start-up files
            "JUPYTER_RUNTIME_DIR": folder,
            "JUPYTER_PLATFORM_DIRS": "1",
            "NO_COLOR": "1",
        }
        with mock.patch.dict(os.environ, own):
            client = NotebookClient(
                notebook,
                timeout=LONGEST,
                kernel_name="python3",
                resources={"metadata": {"path": folder}},
                store_widget_state=False,
                extra_arguments=["--log-level=40"],  # errors
            )
            client.execute()
    return settled(notebook)


def settled(notebook: Any) -> Any:
    """Leave out what differs from one run to the next."""
    notebook.metadata = dict(LANGUAGE)
    for i, cell in enumerate(notebook.cells):
        cell.id = f"cell-{i}"
        cell.metadata = {key: one for key, one in cell.metadata.items() if key == "tags"}
        if cell.cell_type != "code":
            continue
        cell.execution_count = None
        for output in cell.outputs:
            if "execution_count" in output:
                output.execution_count = None
            if "data" in output:
                output.metadata = {}
                for kind in [kind for kind in output.data if "widget" in kind]:
                    del output.data[kind]
    return notebook


def varies(cell: Any) -> bool:
    """Tell whether the output of a cell depends on what is installed."""
    return VARIES in cell.metadata.get("tags", ())


if __name__ == "__main__":
    import nbformat

    for one in NOTEBOOKS:
        nbformat.write(executed(one), one)
        print(f"{one.relative_to(ROOT)}: {one.stat().st_size // 1000} kB", file=sys.stderr)
