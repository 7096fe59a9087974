"""The notebooks of the documentation run, and show what is kept in them."""

from __future__ import annotations

import io
import re
from base64 import b64decode
from pathlib import Path
from typing import Any

import nbformat
import notebooks
import numpy as np
import pytest
from PIL import Image

LARGEST = 400_000  # bytes of a notebook
PLACE = re.compile(r"/(?:home|root|tmp|usr|Users)/|[A-Z]:\\\\")


def pixels(png: str) -> np.ndarray:
    with Image.open(io.BytesIO(b64decode(png))) as image:
        return np.asarray(image.convert("RGB")).astype(int)


def same(kept: Any, found: Any) -> bool:
    """Compare outputs; pictures by their pixels, which are packed alike by one zlib only."""
    if len(kept) != len(found):
        return False
    for one, other in zip(kept, found, strict=True):
        pictures = [output.get("data", {}).pop("image/png", None) for output in (one, other)]
        if one != other or (pictures[0] is None) != (pictures[1] is None):
            return False
        if pictures[0] is not None:
            before, after = map(pixels, pictures)
            if before.shape != after.shape or (abs(before - after).max(axis=2) > 2).mean() > 0.001:
                return False
    return True


@pytest.mark.filterwarnings("default")  # of the notebook's own packages
@pytest.mark.parametrize("path", notebooks.NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_shows_what_its_cells_give(path: Path) -> None:
    kept = nbformat.read(path, as_version=4)
    found = notebooks.executed(path)
    assert len(kept.cells) == len(found.cells)
    for one, other in zip(kept.cells, found.cells, strict=True):
        if one.cell_type == "code" and not notebooks.varies(one):
            assert same(one.outputs, other.outputs), f"run python tests/notebooks.py: {one.source}"


@pytest.mark.parametrize("path", notebooks.NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_is_small_and_holds_nothing_of_the_run_that_made_it(path: Path) -> None:
    kept = nbformat.read(path, as_version=4)
    nbformat.validate(kept)
    assert notebooks.settled(nbformat.read(path, as_version=4)) == kept
    written = path.read_text(encoding="utf-8")
    assert len(written.encode()) < LARGEST
    assert not PLACE.search(written)
    code = [cell for cell in kept.cells if cell.cell_type == "code"]
    assert all(output.output_type != "error" for cell in code for output in cell.outputs)
    assert any("text/html" in output.get("data", {}) for cell in code for output in cell.outputs)


def test_a_changed_output_is_noticed() -> None:
    (path, *_) = notebooks.NOTEBOOKS
    first, second = (
        [cell.outputs for cell in nbformat.read(path, as_version=4).cells if cell.get("outputs")]
        for _ in range(2)
    )
    assert all(same(*pair) for pair in zip(first, second, strict=True))
    second = [cell.outputs for cell in nbformat.read(path, as_version=4).cells if "outputs" in cell]
    third = nbformat.read(path, as_version=4)
    third = [cell.outputs for cell in third.cells if "outputs" in cell]
    third[1][0].data["text/html"] += " "
    assert not same(second[1], third[1])
