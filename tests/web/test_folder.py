"""The folder is whole, small, the same each time, and asks nobody else."""

from __future__ import annotations

import io
import json
import re
import zipfile
from pathlib import Path
from zlib import adler32

import pytest

from nmatrix.canvas.theme import PALETTES
from nmatrix.enums import Theme
from nmatrix.errors import IllegalValueError, MissingPackageError
from nmatrix.web import folder as web
from nmatrix.web.folder import LOCK, PROGRAM, PYTHON, folder, pages, program, write

LARGEST = 16_000_000  # bytes of the folder
LARGEST_PAGE = 300_000  # of all that is read before Python
ADDRESS = re.compile(rb"""(?:https?:)?//[\w-]+\.[\w.-]+""")
NAMES = (b"http://www.w3.org",)  # of XML: nobody fetches them


@pytest.fixture
def pyodide(tmp_path: Path) -> Path:
    """A small stand-in of npm's package."""
    place = tmp_path / "pyodide"
    place.mkdir()
    for name in PYTHON:
        (place / name).write_bytes(name.encode())
    (place / LOCK).write_text('{"info": {"python": "3.14.2"}, "packages": {"numpy": {}}}')
    (place / "package.json").write_text('{"version": "314.0.0"}')
    return place


def made(pyodide: Path) -> dict[str, bytes]:
    return folder(pyodide, lambda: b"<!doctype html>")


def test_the_folder_is_the_same_each_time(pyodide: Path) -> None:
    assert made(pyodide) == made(pyodide)


def test_it_tells_the_length_and_the_sum_of_each_file_that_is_fetched(pyodide: Path) -> None:
    found = made(pyodide)
    told = json.loads(found["folder.json"])
    assert told["bytes"] == {name: len(found[name]) for name in (*told["python"], told["program"])}
    assert told["sums"] == {name: adler32(found[name]) for name in told["bytes"]}
    assert set(told["python"]) == {*PYTHON, LOCK}


def test_python_in_it_knows_no_package_that_it_could_ask_another_host_for(pyodide: Path) -> None:
    assert json.loads(made(pyodide)[LOCK]) == {"info": {"python": "3.14.2"}, "packages": {}}


def test_the_program_has_its_licences_and_not_the_pages_once_more(pyodide: Path) -> None:
    with zipfile.ZipFile(io.BytesIO(made(pyodide)[PROGRAM])) as packed:
        names = packed.namelist()
    assert {"nmatrix/LICENSE", "typer/LICENSE", "shellingham/LICENSE"} <= set(names)
    assert "nmatrix/cli/app.py" in names
    assert not [one for one in names if one.startswith("nmatrix/web/pages/")]


def test_no_file_of_ours_names_another_host(pyodide: Path) -> None:
    for name, content in pages().items():
        found = [one for one in ADDRESS.findall(content) if one not in NAMES]
        assert found == [], name
        assert b'="/' not in content, f"{name} asks the root of the host, and not its own folder"


def test_the_pages_have_the_colours_of_every_picture(pyodide: Path) -> None:
    told = made(pyodide)["colours.css"].decode()
    for theme in (Theme.LIGHT, Theme.DARK):
        assert all(f"--{name}:{one}" in told for name, one in PALETTES[theme].named.items())


def test_the_pages_are_small_before_python_comes() -> None:
    assert sum(map(len, pages().values())) <= LARGEST_PAGE


def test_the_whole_folder_is_small(content: dict[str, bytes]) -> None:
    assert sum(map(len, content.values())) <= LARGEST
    assert content[LOCK] != b""


@pytest.mark.parametrize("name", [*PYTHON, LOCK, "package.json"])
def test_without_a_file_of_pyodide_the_command_that_brings_it_is_told(name, pyodide) -> None:
    (pyodide / name).unlink()
    with pytest.raises(MissingPackageError, match="run npm install pyodide") as error:
        made(pyodide)
    assert name in str(error.value)


@pytest.mark.parametrize("text", ["", "[]", "{}", "null", '{"info": 1, "version"', "\x00"])
@pytest.mark.parametrize("name", [LOCK, "package.json"])
def test_files_that_are_not_those_of_npm_are_refused(name, text, pyodide) -> None:
    (pyodide / name).write_text(text)
    with pytest.raises(IllegalValueError, match="bring it again with npm install pyodide"):
        made(pyodide)


def test_a_folder_that_holds_something_is_kept(tmp_path: Path) -> None:
    (tmp_path / "mine").write_text("mine")
    with pytest.raises(IllegalValueError, match="is not empty"):
        write(tmp_path, {"index.html": b""}, force=False)
    write(tmp_path, {"index.html": b"<p>"}, force=True)
    assert (tmp_path / "index.html").read_bytes() == b"<p>"
    assert (tmp_path / "mine").read_text() == "mine"


def test_a_file_in_the_place_of_the_folder_is_kept(tmp_path: Path) -> None:
    place = tmp_path / "site"
    place.write_text("mine")
    for force in (False, True):
        with pytest.raises(IllegalValueError, match="it is a file"):
            write(place, {"index.html": b""}, force=force)
    assert place.read_text() == "mine"


def test_the_command_says_what_it_needs(nmatrix, own_folder, monkeypatch) -> None:
    monkeypatch.delenv("NMATRIX_PYODIDE", raising=False)
    found = nmatrix("web")
    assert (found.code, found.out, found.is_one_line) == (4, "", True)
    assert "npm install pyodide" in found.err


def test_the_command_writes_the_folder_by_each_way_to_name_pyodide(
    nmatrix, own_folder, monkeypatch, pyodide
) -> None:
    monkeypatch.delenv("NMATRIX_PYODIDE", raising=False)
    found = nmatrix(f"web -o one --pyodide {pyodide} -f json")
    assert found.code == 0, found.err
    sizes = [one.stat().st_size for one in Path("one").iterdir()]
    assert (len(found.data["files"]), found.data["bytes"]) == (len(sizes), sum(sizes))
    monkeypatch.setenv("NMATRIX_PYODIDE", str(pyodide))
    assert nmatrix("web -o a/deep/two").code == 0
    assert nmatrix("web -o one").code == 2
    assert nmatrix("web -o one --force").code == 0
    monkeypatch.delenv("NMATRIX_PYODIDE")
    Path("node_modules").mkdir()
    pyodide.rename("node_modules/pyodide")
    assert nmatrix("web").code == 0
    assert {one.name for one in Path("site").iterdir()} == {
        one.name for one in Path("one").iterdir()
    }


def test_everything_that_is_packed_is_imported_by_someone() -> None:
    """What a page never needs is no burden of the reader's."""
    assert "rich" not in web.PURE
    assert len(program()) < 2_000_000
