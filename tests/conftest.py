"""What many tests share: the command line, and where the reference data lies, if it is there."""

from __future__ import annotations

import json
import os
import shlex
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from nmatrix.cli.app import run

# Of Chromium: WebGL by software, and no request of its own.
FLAGS = [
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--disable-quic",
    "--no-first-run",
    "--hide-scrollbars",
]

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
def own_folder(tmp_path, monkeypatch):
    """Work in a folder of the test's own."""
    monkeypatch.chdir(tmp_path)


@pytest.fixture(scope="session")
def browser() -> Iterator:
    """A real Chromium, once for all tests; skipped with a reason where there is none."""
    playwright = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    program = os.environ.get("CHROMIUM") or shutil.which("chromium") or shutil.which("chrome")
    if program is None:
        pytest.skip("there is no chromium here")
    with playwright.sync_playwright() as running:
        found = running.chromium.launch(executable_path=program, args=FLAGS)
        yield found
        found.close()


class Answer(NamedTuple):
    """What a line of words came to."""

    code: int
    out: str
    err: str

    @property
    def data(self) -> dict[str, Any]:
        return json.loads(self.out)

    @property
    def is_one_line(self) -> bool:
        return self.err.startswith("error: ") and self.err.count("\n") == 1


@pytest.fixture
def nmatrix(capsys):
    """Run a line as a shell would part it, and return its answer."""

    def call(line: str) -> Answer:
        capsys.readouterr()
        code = run(shlex.split(line))
        captured = capsys.readouterr()
        return Answer(code, captured.out, captured.err)

    return call


@pytest.fixture(scope="session")
def site(tmp_path_factory: pytest.TempPathFactory, worker_id: str) -> Path:
    """Build the documentation as a site, once for all workers, and return its folder."""
    pytest.importorskip("furo", reason="the extra docs is not installed")
    folder = tmp_path_factory.getbasetemp()
    folder = (folder if worker_id == "master" else folder.parent) / "site"
    told = folder.with_suffix(".told")
    try:
        folder.with_suffix(".begun").mkdir()
    except FileExistsError:
        while not told.exists():
            time.sleep(0.2)
    else:
        builder = CHECKOUT / "docs" / "website"
        built = subprocess.run(
            [sys.executable, builder, "-o", folder],
            capture_output=True,
            text=True,
            check=False,
            cwd=CHECKOUT,
            env={**os.environ, "PYTHONPATH": str(CHECKOUT)},
        )
        told.with_suffix(".telling").write_text(f"{built.returncode}\n{built.stderr}")
        told.with_suffix(".telling").rename(told)
    assert told.read_text().strip() == "0"
    return folder
