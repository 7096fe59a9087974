"""What is missing is installed by its own name, in the range of `pyproject.toml`."""

from __future__ import annotations

import ast
import re
import shlex
import sys
import tomllib
from importlib.metadata import PackageNotFoundError
from pathlib import Path

import pytest

from nmatrix import requirements
from nmatrix.requirements import install_command, is_required, missing, read_requirement

ROOT = Path(__file__).resolve().parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
EXTRAS = PROJECT["optional-dependencies"]
ASKED = sorted({*PROJECT["dependencies"], *(one for extra in EXTRAS.values() for one in extra)})
PACKAGE = sorted((ROOT / "nmatrix").rglob("*.py"))


@pytest.fixture(autouse=True)
def _read_anew():
    requirements._ranges.cache_clear()
    yield
    requirements._ranges.cache_clear()


def test_the_project_spells_packages_as_its_metadata_do() -> None:
    assert [one for one in ASKED if not re.fullmatch(r"[a-z][a-z0-9-]*[<>=][^ ]+", one)] == []


@pytest.mark.parametrize("line", ASKED)
def test_a_package_is_installed_in_the_range_that_the_project_asks_for(line: str) -> None:
    name = re.split("[<>=]", line)[0]
    brought = {two: one for one, two in requirements.PACKAGES.items()}
    module = brought.get(name, name.replace("-", "_"))
    assert is_required(module)
    assert shlex.split(install_command(module)) == ["pip", "install", line]


@pytest.mark.parametrize("line", ASKED)
def test_metadata_of_an_installed_package_say_the_same(line, monkeypatch) -> None:
    name, *_ = re.split("[<>=]", line)
    bounds = ",".join(sorted(line.removeprefix(name).split(",")))  # as a wheel writes them
    metadata = [f"{name}{bounds}; extra == 'some'"]
    monkeypatch.setattr(requirements, "PROJECT", Path("no/such/pyproject.toml"))
    monkeypatch.setattr(requirements, "requires", lambda _: metadata)
    assert requirements._ranges() == {name: line}
    assert read_requirement(line)[1] == line


def test_a_package_without_metadata_still_names_what_is_missing(monkeypatch) -> None:
    def absent(name: str) -> None:
        raise PackageNotFoundError(name)

    monkeypatch.setattr(requirements, "PROJECT", Path("no/such/pyproject.toml"))
    monkeypatch.setattr(requirements, "requires", absent)
    assert install_command("typst", "tree_sitter") == "pip install typst tree-sitter"
    assert not is_required("typst")


@pytest.mark.parametrize(
    ("left_by", "command"),
    [
        ("pipx_metadata.json", ["pipx", "inject", "nmatrix"]),
        ("uv-receipt.toml", ["uv", "pip", "install", "--python", "{prefix}"]),
    ],
)
def test_a_program_in_a_place_of_its_own_gets_packages_there(
    left_by: str, command: list[str], tmp_path, monkeypatch
) -> None:
    prefix = tmp_path / "a place"
    prefix.mkdir()
    (prefix / left_by).touch()
    monkeypatch.setattr(sys, "prefix", str(prefix))
    words = [one.format(prefix=prefix) for one in command]
    assert shlex.split(install_command("typst")) == [*words, "typst>=0.15,<0.17"]


def test_a_shell_of_windows_knows_double_quotes_alone(monkeypatch) -> None:
    monkeypatch.setattr(sys, "platform", "win32")
    assert install_command("typst") == 'pip install "typst>=0.15,<0.17"'


def test_what_else_can_be_done_stands_last() -> None:
    error = missing("--to pdf", "typst", otherwise="print the page")
    assert str(error).endswith("; pip install 'typst>=0.15,<0.17', or print the page")


def test_only_one_place_writes_a_command_that_installs() -> None:
    written = [path.name for path in PACKAGE if "pip install" in path.read_text("utf-8")]
    assert written == ["requirements.py"]


def test_every_package_that_is_imported_is_asked_for() -> None:
    found = {}
    for path in PACKAGE:
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            names = []
            if isinstance(node, ast.Import):
                names = [one.name for one in node.names]
            elif isinstance(node, ast.ImportFrom) and not node.level:
                names = [node.module or ""]
            found |= {one.partition(".")[0]: path.name for one in names}
    others = {
        one: at for one, at in found.items() if one not in {*sys.stdlib_module_names, "nmatrix"}
    }
    assert {one: at for one, at in others.items() if not is_required(one)} == {}


INSTALLS = re.compile(
    r"\b(?:pip|pipx|uv|uvx)\b[^`\n|;&]*?(?<![\w./-])['\"]?nmatrix\b(?![-./\w])[^`\n]*"
)


def test_no_document_installs_this_project_from_an_index() -> None:
    """The name on an index may be absent, or another project's."""
    files = [ROOT / "README.md", *ROOT.glob("docs/**/*.md"), *ROOT.glob("tests/**/*.py"), *PACKAGE]
    said = {}
    for path in files:
        for one in INSTALLS.findall(path.read_text("utf-8")):
            if path.name != Path(__file__).name and not re.search(r"inject|--from|--spec", one):
                said[path.name] = one
    assert said == {}


@pytest.mark.parametrize("extra", EXTRAS)
def test_every_extra_is_explained_to_those_who_install(extra: str) -> None:
    part = (ROOT / "README.md").read_text("utf-8").partition("## Other ways to get it")[2]
    assert f"`{extra}`" in part.partition("\n## ")[0]
