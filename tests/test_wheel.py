"""What an installation gives: the wheel, outside of a checkout, is whole."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import sysconfig
import tarfile
import tomllib
from concurrent.futures import ThreadPoolExecutor
from email.parser import Parser
from importlib import import_module
from pathlib import Path
from tempfile import TemporaryDirectory
from zipfile import ZipFile

import pytest

from nmatrix import packing
from nmatrix.cli import help as pages
from nmatrix.cli.catalogue import COMMANDS
from nmatrix.cli.command import examples_and_notes
from nmatrix.errors import MissingPackageError
from nmatrix.version import __version__

pytestmark = pytest.mark.slow

ROOT = Path(__file__).resolve().parents[1]
HELP = {
    name: import_module(f"nmatrix.cli.{one.module}").HELP[name] for name, one in COMMANDS.items()
}
EXAMPLES = [
    *pages.EXAMPLES,
    *(one for text in HELP.values() for one in examples_and_notes(text)[0]),
]
JUDGES = ("nmatrix check", "nmatrix lint")
LONG = re.compile("nmatrix cost|stress --random|--frames")  # test_help runs them, from the checkout
A_DOCUMENT = re.compile(r"\bdocs/[\w./-]+\.\w+")


def run(*words: str | Path, **options) -> str:
    done = subprocess.run(
        list(map(str, words)), capture_output=True, text=True, check=False, **options
    )
    assert done.returncode == 0, (words, done.stdout, done.stderr)
    return done.stdout


@pytest.fixture(scope="module")
def hatch(tmp_path_factory) -> Path:
    """A Python with what the project is built by, and nothing else."""
    place = tmp_path_factory.mktemp("hatch")
    run(sys.executable, "-m", "venv", "--without-pip", place)
    wanted = tomllib.loads((ROOT / "pyproject.toml").read_text())["build-system"]["requires"]
    python = place / "bin" / "python"
    pins = ROOT / "constraints.txt"
    run(sys.executable, "-m", "pip", "-q", "--python", python, "install", "-c", pins, *wanted)
    return python


def built(hatch: Path, kind: str, source: Path, folder: Path) -> Path:
    run(hatch, "-m", "hatchling", "build", "-t", kind, "-d", folder, cwd=source)
    return next(folder.glob("nmatrix-*"))


@pytest.fixture(scope="module")
def wheel(hatch: Path, tmp_path_factory) -> Path:
    return built(hatch, "wheel", ROOT, tmp_path_factory.mktemp("wheel"))


@pytest.fixture(scope="module")
def installed(wheel: Path, tmp_path_factory) -> Path:
    """An environment with the wheel, and with the packages of the environment that runs tests."""
    place = tmp_path_factory.mktemp("installed") / "with a space"
    run(sys.executable, "-m", "venv", "--without-pip", place)
    python = place / "bin" / "python"
    run(sys.executable, "-m", "pip", "-q", "--python", python, "install", "--no-deps", wheel)
    script = "import sysconfig; print(sysconfig.get_path('purelib'))"
    ours = Path(run(python, "-I", "-c", script).strip())
    (ours / "others.pth").write_text(f"{sysconfig.get_path('purelib')}\n")
    return place


def shell(line: str, installed: Path, folder: Path) -> subprocess.CompletedProcess[str]:
    away = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    path = f"{installed / 'bin'}{os.pathsep}{os.environ['PATH']}"
    return subprocess.run(
        ["bash", "-c", f"set -o pipefail; {line}"],
        capture_output=True,
        text=True,
        check=False,
        cwd=folder,
        env={**away, "PATH": path},
    )


def test_every_file_of_the_package_is_in_the_wheel_and_nothing_else(wheel: Path) -> None:
    ours = {
        str(one.relative_to(ROOT))
        for one in (ROOT / "nmatrix").rglob("*")
        if one.is_file() and "__pycache__" not in one.parts
    }
    named = {one for one in ZipFile(wheel).namelist() if one.startswith("nmatrix/")}
    assert named == ours


def test_the_metadata_are_whole(wheel: Path) -> None:
    with ZipFile(wheel) as packed:
        text = packed.read(f"nmatrix-{__version__}.dist-info/METADATA").decode()
        points = packed.read(f"nmatrix-{__version__}.dist-info/entry_points.txt").decode()
        named = packed.namelist()
    told = Parser().parsestr(text)
    assert told["License-Expression"] == "MIT AND OFL-1.1"
    for one in told.get_all("License-File"):
        assert f"nmatrix-{__version__}.dist-info/licenses/{one}" in named
    assert told["Description-Content-Type"] == "text/markdown"
    assert told.get_payload() == (ROOT / "README.md").read_text()
    assert "nmatrix = nmatrix.__main__:main" in points
    assert "Private" not in text
    assert f"Programming Language :: Python :: 3.{sys.version_info.minor}" in text


def test_what_the_package_names_is_brought(installed: Path) -> None:
    share = installed / "share"
    told = "".join((ROOT / "docs" / "nmatrix.1").read_text("ascii"))
    assert (share / "man" / "man1" / "nmatrix.1").read_text("ascii") == told
    for path in (ROOT / "README.md", ROOT / "CHANGELOG.md", *ROOT.glob("docs/**/*.md")):
        if not any(part.startswith("_") for part in path.parts):
            there = share / "doc" / "nmatrix" / path.relative_to(ROOT)
            assert there.read_text() == path.read_text()
            for link in re.findall(r"\]\((?!\w+:)([^)#]+)", path.read_text()):
                assert (there.parent / link).exists(), (path, link)
    for module in (ROOT / "nmatrix").rglob("*.py"):
        for name in A_DOCUMENT.findall(module.read_text()):
            assert (share / "doc" / "nmatrix" / name).is_file(), (module, name)


def test_help_says_where_the_documents_are(installed: Path, tmp_path: Path) -> None:
    page = shell("nmatrix help --docs", installed, tmp_path).stdout
    folder = installed / "share" / "doc" / "nmatrix" / "docs"
    assert folder.is_dir()
    assert f"  {folder.resolve()}" in page.splitlines()


def test_every_example_of_every_help_runs_where_nothing_else_is(installed: Path) -> None:
    def fails(example: str) -> str:
        with TemporaryDirectory() as folder:
            done = shell(example, installed, Path(folder))
        missing = done.returncode == MissingPackageError.exit_code and "install" in done.stderr
        judged = example.startswith(JUDGES) and done.returncode == 1
        return "" if done.returncode == 0 or missing or judged else f"{example}: {done.stderr}"

    with ThreadPoolExecutor(2) as pool:
        failed = list(
            filter(None, pool.map(fails, (one for one in EXAMPLES if not LONG.search(one))))
        )
    assert failed == []


def test_the_module_runs_as_the_command_does(installed: Path, tmp_path: Path) -> None:
    where = "python -c 'import nmatrix; print(nmatrix.__file__)'"
    assert str(installed) in shell(where, installed, tmp_path).stdout
    answers = [
        shell(f"{one} view -f json", installed, tmp_path)
        for one in ("nmatrix", "python -m nmatrix")
    ]
    assert answers[0].returncode == answers[1].returncode == 0
    assert answers[0].stdout == answers[1].stdout != ""


def test_hints_have_the_ranges_of_the_metadata(installed: Path, tmp_path: Path) -> None:
    hint = (
        'python -c \'import nmatrix.requirements as r; print(r.install_command("typst", "numpy"))\''
    )
    assert (
        shell(hint, installed, tmp_path).stdout == "pip install 'typst>=0.15,<0.17' 'numpy>=2.0'\n"
    )


def test_the_installed_program_packs_itself_as_a_checkout_does(installed, tmp_path: Path) -> None:
    done = shell("python -m nmatrix.packing && ./nmatrix.pyz -V", installed, tmp_path)
    assert done.stdout == f"Written: nmatrix.pyz\nnmatrix {__version__}\n"
    assert (tmp_path / "nmatrix.pyz").read_bytes() == packing.program()


def test_the_source_distribution_makes_the_same_wheel(hatch, wheel, tmp_path: Path) -> None:
    with tarfile.open(built(hatch, "sdist", ROOT, tmp_path / "sdist")) as packed:
        packed.extractall(tmp_path, filter="data")
    source = tmp_path / f"nmatrix-{__version__}"
    made = built(hatch, "wheel", source, tmp_path / "wheel")
    assert content(made) == content(wheel)
    for name in ("tests", ".ci/run", "constraints.txt", "CHANGELOG.md", "LICENSE"):
        assert (source / name).exists()


def content(wheel: Path) -> dict[str, bytes]:
    with ZipFile(wheel) as packed:
        return {name: packed.read(name) for name in packed.namelist()}
