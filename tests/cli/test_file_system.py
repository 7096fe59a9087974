"""What the file system refuses is one line in our form, whatever the command."""

from __future__ import annotations

import errno
import os
import subprocess
import sys
from pathlib import Path

import pytest

from nmatrix.errors import refusal

LONG = "a" * 300
READS = [
    "world --scene {}.toml",
    "plan {}.toml",
    "render {}.toml",
    "render normals --mesh {}.obj",
    "inspect {}.obj",
    "handout --roster {}.csv",
    "handout --exercises 1 --salt {}.csv",
    "check normal --batch {}.csv",
    "world --world-matrix {}.csv",
]
WRITES = [
    "render normals --size 32 18 -o {}.png",
    "render normals --size 32 18 --frames 2 -o {}.gif",
    "explore -o {}.html",
    "handout --topics spaces -o {}.html",
    "handout --roster class --exercises 1 -o {}",
    "cost normals --quick --chart {}.svg",
]


@pytest.fixture
def hostile(own_folder) -> None:
    for ending in (".toml", ".obj", ".csv", ".png", ".gif", ".html", ".svg"):
        Path(f"folder{ending}").mkdir()
    Path("file").write_text("")


def is_in_our_form(found) -> bool:
    what, colon, rest = found.err.removeprefix("error: ").partition(": ")
    no_words_of_python = not any(word in found.err for word in ("Errno", "Error(", "Traceback"))
    return (
        found.code == 2
        and found.is_one_line
        and bool(what and colon and rest)
        and no_words_of_python
    )


@pytest.mark.parametrize("line", READS)
@pytest.mark.parametrize("name", ["folder", LONG, "file/x", "nowhere/x", "nothing", "a\x07b"])
def test_what_cannot_be_read_is_refused(nmatrix, hostile, line: str, name: str) -> None:
    found = nmatrix(line.format(f"'{name}'"))
    assert is_in_our_form(found), found


@pytest.mark.parametrize("line", WRITES)
@pytest.mark.parametrize("name", [LONG, "file/x", "/proc/nmatrix/x"])
def test_what_cannot_be_written_is_refused(nmatrix, hostile, line: str, name: str) -> None:
    found = nmatrix(line.format(name))
    assert is_in_our_form(found), found


@pytest.mark.parametrize("line", WRITES[:4])
def test_a_folder_is_not_called_a_file_that_exists(nmatrix, hostile, line: str) -> None:
    found = nmatrix(line.format("folder"))
    assert is_in_our_form(found), found
    assert "it is a folder" in found.err
    assert "--force" not in found.err


@pytest.mark.parametrize("number", [errno.EACCES, errno.EROFS, errno.ENOSPC, errno.EIO])
def test_a_disk_that_refuses_is_told(nmatrix, own_folder, monkeypatch, number: int) -> None:
    def refuse(*_: object, **__: object) -> None:
        raise OSError(number, os.strerror(number), "somewhere")

    monkeypatch.setattr("tempfile.mkstemp", refuse)
    monkeypatch.setattr(Path, "open", refuse)
    for line in ("explore", "world --scene sample", "render normals --size 32 18"):
        found = nmatrix(line)
        assert is_in_our_form(found), found
        assert refusal(OSError(number, os.strerror(number))) in found.err


def shell(line: str, folder: Path) -> subprocess.CompletedProcess[str]:
    root = Path(__file__).resolve().parents[2]
    return subprocess.run(
        ["bash", "-c", line.replace("nmatrix", f"{sys.executable} -m nmatrix")],
        capture_output=True,
        text=True,
        check=False,
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(root)},
    )


@pytest.mark.parametrize(
    ("line", "code", "told"),
    [
        ("nmatrix world >/dev/full", 2, "no space is left"),
        ("nmatrix --help >/dev/full", 2, "no space is left"),
        ("nmatrix render normals --size 32 18 -o - >/dev/full", 2, "no space is left"),
        ("nmatrix world >&-", 0, ""),
        ("nmatrix wrold 2>&-", 2, ""),
        ("nmatrix normal - <&-", 2, "standard input: it is closed"),
        ("nmatrix help options | true; exit ${PIPESTATUS[0]}", 0, ""),
    ],
)
def test_streams_that_are_closed_or_full(line: str, code: int, told: str, tmp_path: Path) -> None:
    if "/dev/full" in line and not Path("/dev/full").exists():
        pytest.skip("there is no full device on this machine")
    done = shell(line, tmp_path)
    assert done.returncode == code, done.stderr
    assert done.stderr.count("\n") == bool(told)
    assert told in done.stderr
