"""Where the reference data lies, if it is there at all."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

CHECKOUT = Path(__file__).resolve().parents[1]


def data_folder() -> Path | None:
    """Return the folder of the reference data: NMATRIX_DATA, or beside the checkout."""
    given = os.environ.get("NMATRIX_DATA")
    folder = Path(given) if given else CHECKOUT.parent / "shared" / "data"
    return folder if (folder / "golden.json").is_file() else None


@pytest.fixture(scope="session")
def data() -> Path:
    found = data_folder()
    if found is None:
        pytest.skip("the reference data is not here: set NMATRIX_DATA to its folder")
    return found
