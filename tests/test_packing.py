"""One file, any Python, no installation: the same bytes as the installed program."""

from __future__ import annotations

import io
import os
import re
import subprocess
import sys
import zipfile
from importlib.metadata import metadata
from pathlib import Path

import pytest

from nmatrix import packing
from nmatrix.errors import IllegalValueError, MissingPackageError

ROOT = Path(__file__).resolve().parents[1]
LICENSE = (ROOT / "LICENSE").read_text("utf-8")
SCALED = "1 0 0; 0 2 0; 0 0 1"
# They need neither NumPy nor SymPy, nor any other package.
LINES = [
    ["--version"],
    ["--help"],
    ["help", "options"],
    ["check", "--help", "--full"],
    ["--show-completion", "bash"],
    ["world", "--scale", "1", "2", "1"],
    ["world", "--translate", "-3", "0", "-1.5", "--rotate", "0", "30", "0", "--order", "ZYX"],
    ["world", "--rotate", "0", "30", "0", "--steps"],
    ["world", "--scale", "1", "2", "1", "-f", "json"],
    ["world", "--scale", "1", "2", "1", "-f", "latex"],
    ["view", "--eye", "3", "3", "2.5", "--target", "0", "0", "0", "-f", "mathml"],
    ["projection", "--fov", "90", "--aspect", "16/9", "--near", "0.1", "-f", "typst"],
    ["normal", SCALED, "--normal", "1", "1", "0"],
    ["normal", SCALED, "--normal", "1", "1", "0", "-f", "glsl"],
    ["calc", "inv([[1, 2], [3, 4]])", "--steps"],
    ["calc", "1/3 + 1/6"],
    ["identify", "0 -1 0; 1 0 0; 0 0 1"],
    ["axes", "opengl", "unreal"],
    ["light", "camera", "--eye", "3", "3", "3"],
    ["eye", "object", "--scale", "1", "2", "1"],
    ["space", "object"],
    ["space", "object", "-f", "glsl"],
    ["trace", "--point", "0", "0", "6"],
    ["trace", "--pixel", "256", "128", "--depth-value", "0.5"],
    ["check", "normal", SCALED, "--scale", "1", "2", "1"],
    ["check", "exercise", "2", "1 0 0; 0 2 0; 0 0 4", "--seed", "7", "--student", "Ada"],
    ["check", "normal", "--batch", "answers", "--scale", "1", "2", "1"],
    ["wrold"],
    ["world", "--scael", "2"],
    ["world", "--scale", "1", "0", "x"],
    ["normal", "1 0 0; 0 0 0; 0 0 1"],
]
SOME = LINES[4:6] + LINES[26:28]


@pytest.fixture(scope="module")
def packed(tmp_path_factory) -> Path:
    path = tmp_path_factory.mktemp("a folder") / "nmatrix.pyz"
    packing.write(path)
    return path


def run(command: list[str], words: list[str], folder: Path) -> tuple[int, bytes, bytes]:
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "PYTHONDONTWRITEBYTECODE": "1"}
    done = subprocess.run(
        [*command, *words], capture_output=True, check=False, cwd=folder, env=environment
    )
    return done.returncode, done.stdout, done.stderr


@pytest.mark.parametrize("words", SOME, ids=" ".join)
def test_a_packed_program_writes_the_same_bytes_without_any_package(
    words: list[str], packed: Path, tmp_path: Path
) -> None:
    bare = [sys.executable, "-I", "-S", str(packed)]
    assert run(bare, words, tmp_path) == run([sys.executable, "-m", "nmatrix"], words, tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize("words", [one for one in LINES if one not in SOME], ids=" ".join)
def test_so_do_all_its_exact_commands(words: list[str], packed: Path, tmp_path: Path) -> None:
    test_a_packed_program_writes_the_same_bytes_without_any_package(words, packed, tmp_path)


def test_it_runs_by_its_own_name_and_leaves_nothing(packed: Path, tmp_path: Path) -> None:
    done = run([str(packed)], ["calc", "2 * 3"], tmp_path)
    assert done[0] == 0
    assert list(tmp_path.iterdir()) == []
    assert [one.name for one in packed.parent.iterdir()] == ["nmatrix.pyz"]


@pytest.mark.slow
def test_packages_that_this_python_has_are_used(packed: Path, tmp_path: Path) -> None:
    words = ["render", "normals", "--mesh", "teapot", "--size", "64", "64", "-o", "a.png"]
    installed, answers = [sys.executable, "-m", "nmatrix"], []
    for command in ([sys.executable, str(packed)], installed):
        code, _, err = run(command, words, tmp_path)
        assert (code, err) == (0, b"")
        answers.append((tmp_path / "a.png").read_bytes())
        (tmp_path / "a.png").unlink()
    assert answers[0] == answers[1]


@pytest.mark.parametrize(
    ("words", "package"),
    [
        ("render teapot", "numpy>=2.0"),
        ("derive", "sympy>=1.13"),
        ("explore", "numpy>=2.0"),
        ("inspect teapot", "msgspec>=0.19"),
        ("cost normals --quick", "numpy>=2.0"),
        ("world --scene sample", "msgspec>=0.19"),
        ("lint phong.vert", "tree-sitter>=0.25"),
        ("handout --to pdf", "typst>=0.15,<0.17"),
    ],
)
def test_what_needs_a_package_says_so_in_one_line(words, package, packed, tmp_path) -> None:
    bare = [sys.executable, "-I", "-S", str(packed)]
    code, out, err = run(bare, words.split(), tmp_path)
    assert (code, out) == (MissingPackageError.exit_code, b"")
    assert re.fullmatch(rf"error: .*; pip install '{re.escape(package)}'.*\n", err.decode())


@pytest.mark.slow
def test_jobs_go_to_processes_as_well(packed: Path, tmp_path: Path) -> None:
    words = "handout --roster class --topics exercises --workers 2 -o sheets".split()
    code, _, err = run([sys.executable, "-I", "-S", str(packed)], words, tmp_path)
    assert (code, err) == (0, b"")
    assert len(list((tmp_path / "sheets").glob("*.html"))) >= 2


def test_the_same_bytes_are_packed_each_time(packed: Path) -> None:
    assert packing.program() == packed.read_bytes()


def test_a_packed_program_packs_itself(packed: Path, tmp_path: Path) -> None:
    script = f"import sys; sys.path.insert(0, {str(packed)!r})\n"
    script += "from nmatrix.packing import write; from pathlib import Path; write(Path('again'))"
    code, _, err = run([sys.executable, "-I", "-S", "-c", script], [], tmp_path)
    assert (code, err) == (0, b"")
    assert (tmp_path / "again").read_bytes() == packed.read_bytes()


def test_it_holds_pure_files_and_their_licences_and_is_small(packed: Path) -> None:
    with zipfile.ZipFile(packed) as content:
        assert content.testzip() is None
        names = set(content.namelist())
        assert not [one for one in names if one.endswith((".so", ".pyd", ".pyc"))]
        for package in ("nmatrix", *packing.PURE):
            assert f"{package}/LICENSE" in names
        assert content.read("nmatrix/LICENSE").decode() == LICENSE
        assert content.read("typer/_click/LICENSE.txt").startswith(b"Copyright 2014 Pallets")
        ours = {str(one.relative_to(ROOT)) for one in (ROOT / "nmatrix").rglob("*.py")}
        assert ours <= names
    assert packed.stat().st_size < 3_000_000


@pytest.mark.parametrize("package", packing.PURE)
def test_the_licence_names_what_is_packed(package: str) -> None:
    told = metadata(package)
    licence = re.sub(" License$", "", told["License-Expression"] or told["License"])
    assert re.search(rf"^ +{re.escape(told['Name'])} +{licence}\b", LICENSE, re.MULTILINE)


def test_an_old_python_is_told_in_one_line(packed: Path) -> None:
    with zipfile.ZipFile(packed) as content:
        start = content.read("__main__.py").decode()
    script = f"import sys; sys.version_info = (3, 9, 7)\n{start}"
    done = subprocess.run(
        [sys.executable, "-I", "-S"], input=script, capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr == "error: Python (3.9): nmatrix needs 3.11 or newer\n"


def test_what_cannot_be_packed_or_written_is_told(tmp_path: Path) -> None:
    with pytest.raises(MissingPackageError, match="the package no-such-package"):
        packing.modules("no_such_package")
    with pytest.raises(IllegalValueError, match="there is no such file or folder; choose another"):
        packing.write(tmp_path / "no" / "nmatrix.pyz")
    mine = tmp_path / "thesis.txt"
    mine.write_text("all of it")
    for path in (mine, tmp_path):
        with pytest.raises(IllegalValueError, match="it is there, and is no packed program"):
            packing.write(path)
    assert mine.read_text() == "all of it"


@pytest.mark.parametrize("words", [["--help"], ["a", "b"], ["no/such/folder/a.pyz"]], ids=" ".join)
def test_a_slip_where_it_is_packed_is_one_line(words, capsys, tmp_path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert packing.main(words) == IllegalValueError.exit_code
    told = capsys.readouterr()
    assert (told.out, told.err.count("\n")) == ("", 1)
    assert told.err.startswith("error: ")
    assert list(tmp_path.iterdir()) == []


def test_it_is_packed_under_its_usual_name_and_again(capsys, tmp_path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert [packing.main(words) for words in ([], [packing.USUAL])] == [0, 0]
    assert capsys.readouterr().out == f"Written: {packing.USUAL}\n" * 2


def test_a_zip_file_tells_nothing_of_the_day_or_the_machine() -> None:
    with zipfile.ZipFile(io.BytesIO(packing.zipped({"b": b"2", "a": b"1"}))) as content:
        told = [(one.filename, one.date_time, one.create_system) for one in content.infolist()]
    assert told == [(name, (1980, 1, 1, 0, 0, 0), 3) for name in "ab"]
