"""What many tests share: the command line, and where the reference data lies, if it is there."""

from __future__ import annotations

import os
import shlex
from pathlib import Path

import pytest

from nmatrix.cli.app import run

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


@pytest.fixture
def nmatrix(capsys):
    """Return what runs a line of words: its exit code, its stdout and its stderr."""

    def call(line: str) -> tuple[int, str, str]:
        capsys.readouterr()
        code = run(shlex.split(line))
        captured = capsys.readouterr()
        return code, captured.out, captured.err

    return call
