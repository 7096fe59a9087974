"""A class's folder: late enrolment, another roster, damage, and names that cannot be printed."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import threading
from pathlib import Path

import pytest

from nmatrix.classroom import run as running
from nmatrix.classroom.handout import HandoutPlan, handout, student_files
from nmatrix.classroom.manifest import files_of
from nmatrix.classroom.topics import Topic
from nmatrix.cli import workers
from nmatrix.lessons.exercises.scheme import Sheet
from nmatrix.output.files import write_file
from nmatrix.output.pages.document import PageFormat
from nmatrix.report import Code, Text
from nmatrix.scene.setup import Setup

pytestmark = pytest.mark.usefixtures("own_folder")

LINE = "handout --exercises 1 -o out --roster"
SHEETS = HandoutPlan((Topic.EXERCISES,), Setup(), 1)


def roster(*names: str) -> str:
    Path("class.csv").write_text("student\n" + "\n".join(names) + "\n", encoding="utf-8")
    return f"{LINE} class.csv"


def sheets() -> list[str]:
    return sorted(path.name for path in Path("out").glob("*.html"))


def test_a_folder_for_one_sheet_is_refused_and_told_what_goes_there(nmatrix) -> None:
    code, out, err = nmatrix("handout --exercises 1 -o .")
    assert (code, out) == (2, "")
    assert "--output (.): it is a folder, and one sheet is a file; a class with --roster" in err
    assert "such as handout.html" in err


def test_who_comes_late_gets_a_sheet_and_the_others_keep_theirs(nmatrix) -> None:
    assert nmatrix(roster("Ada", "Bo"))[0] == 0
    Path("out/0001-ada.html").write_bytes(b"kept")
    code, out, _ = nmatrix(roster("Ada", "Bo", "Cy"))
    assert code == 0
    assert "missing until now: 1 of 3 files" in " ".join(out.split())
    assert sheets() == ["0001-ada.html", "0002-bo.html", "0003-cy.html"]
    assert Path("out/0001-ada.html").read_bytes() == b"kept"
    assert nmatrix(roster("Bo", "Ada", "Cy"))[0] == 2


def test_force_takes_the_sheets_of_the_earlier_run_away(nmatrix) -> None:
    assert nmatrix(f"{roster('Bo', 'Cy')} --key")[0] == 0
    Path("out/notes.html").write_text("the teacher's own")
    assert nmatrix(f"{roster('Ada', 'Bo')} --force")[0] == 0
    assert sheets() == ["0001-ada.html", "0002-bo.html", "notes.html"]


def test_a_manifest_that_is_none_names_no_files() -> None:
    for text in (b"", b"{}", b"[]", b'{"kind": "html", "students": 3, "with_key": true}'):
        assert files_of(text) == frozenset()
    named = files_of(b'{"kind": "html", "students": ["../../x"], "with_key": true}')
    assert named == {"0001-x.html", "0001-x-key.html"}


def test_a_damaged_manifest_is_refused_in_one_line(nmatrix) -> None:
    line = roster("Ada")
    assert nmatrix(line)[0] == 0
    manifest = Path("out/manifest.json")
    there = json.loads(manifest.read_bytes())
    for students in (3, None, "Ada", {}):
        manifest.write_text(json.dumps({**there, "students": students}))
        code, _, err = nmatrix(line)
        assert (code, err.count("\n")) == (2, 1)


def test_an_emptied_sheet_is_written_again(nmatrix) -> None:
    assert nmatrix(roster("Ada", "Bo"))[0] == 0
    content = Path("out/0002-bo.html").read_bytes()
    Path("out/0002-bo.html").write_bytes(b"")
    assert nmatrix(roster("Ada", "Bo"))[0] == 0
    assert Path("out/0002-bo.html").read_bytes() == content


@pytest.mark.parametrize("wrong", ["--workers 0", "--dask nowhere:1", "--salt empty"])
def test_a_refused_run_leaves_no_folder(nmatrix, monkeypatch, wrong: str) -> None:
    monkeypatch.setattr(workers, "PATIENCE", "100ms")
    Path("empty").write_bytes(b"")
    code, _, err = nmatrix(f"{roster('Ada')} {wrong}")
    assert code in (2, 4)
    assert err.count("\n") == 1
    assert not Path("out").exists()


def test_a_quote_that_is_never_closed_is_named_by_its_line(nmatrix) -> None:
    code, _, err = nmatrix(roster("Ada", '"Bo', "Cy", "Dee"))
    assert code == 2
    assert "line 3 (Bo): a quote is never closed" in err


def test_a_name_that_a_pdf_cannot_print_is_told_before_anything_is_written(nmatrix) -> None:
    pytest.importorskip("typst", reason="typst is not installed")
    code, _, err = nmatrix(f"{roster('Ada', 'Мария', '李小龍', 'Bo')} --to pdf")
    assert code == 2
    assert "李小龍" in err
    assert not Path("out").exists()
    assert nmatrix(f"{roster('Ada', 'Мария', 'Łukasz')} --to pdf")[0] == 0


def test_every_printed_page_says_whose_it_is() -> None:
    name = 'Ada "</style>" B.'
    sheet = Sheet("7", name)
    page = student_files(SHEETS, sheet).sheet.decode()
    style = page.partition("<style>")[2].partition("</style>")[0]
    content = re.search(r'@bottom-left \{ content: "([^"]*)"', style)
    assert content is not None
    shown = re.sub(r"\\([0-9a-f]+) ", lambda c: chr(int(c[1], 16)), content[1])
    assert shown.startswith(f"{name} · seed 7 · ")
    for kind in (PageFormat.TYP, PageFormat.TEX):
        head = student_files(
            HandoutPlan((Topic.EXERCISES,), Setup(), 1, kind), Sheet("7", "Zoe")
        ).sheet.decode()
        assert re.search(r"(footer: context|sheetfoot)[^$]*Zoe", head)


@pytest.mark.parametrize(
    ("student", "words"),
    [
        ("", ""),
        ("Ada", " --student Ada"),
        ("Lovelace, Ada", ' --student "Lovelace, Ada"'),
        ('O"x', " --student 'O\"x'"),
        ("x" * 60, ' --student "YOUR NAME, AS IT STANDS ABOVE"'),
    ],
)
def test_a_sheet_says_how_to_check_it(student: str, words: str) -> None:
    last = handout(SHEETS, Sheet("7", student)).blocks[-1]
    assert isinstance(last, Code)
    assert last.text == f'nmatrix check exercise 1 "YOUR ANSWER" --seed 7{words}\n'


def test_a_graded_sheet_says_who_checks_it() -> None:
    last = handout(SHEETS, Sheet("7", "Ada", b"secret")).blocks[-1]
    assert isinstance(last, Text)
    assert "your teacher" in last.text


def test_a_pipe_is_written_to_and_not_replaced(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    read: list[bytes] = []
    reader = threading.Thread(target=lambda: read.append(pipe.read_bytes()))
    reader.start()
    write_file(pipe, b"content", force=False)
    reader.join(timeout=10)
    assert read == [b"content"]
    assert pipe.is_fifo()


def test_a_lost_picture_comes_back(nmatrix) -> None:
    line = f"{roster('Ada')} --topics proofs,exercises --to md"
    assert nmatrix(line)[0] == 0
    pictures = sorted(Path("out").glob("*.svg"))
    assert pictures
    pictures[0].unlink()
    assert nmatrix(line)[0] == 0
    assert sorted(Path("out").glob("*.svg")) == pictures


def test_a_killed_process_is_told_and_the_next_run_goes_on(nmatrix, monkeypatch) -> None:
    original = running.run
    monkeypatch.setattr(running, "run", _dies)
    code, _, err = nmatrix(f"{roster('Ada', 'Bo', 'Cy')} --workers 2")
    assert code == 2
    assert "killed" in err
    assert err.count("\n") == 1
    monkeypatch.setattr(running, "run", original)
    assert nmatrix(roster("Ada", "Bo", "Cy"))[0] == 0
    assert len(sheets()) == 3


def _dies(job: object) -> None:
    os.kill(os.getpid(), signal.SIGKILL)


def test_two_processes_print_a_class(tmp_path: Path) -> None:
    """In a shell of its own: a process that has used Typst cannot be forked, and must not be."""
    pytest.importorskip("typst", reason="typst is not installed")
    (tmp_path / "class.csv").write_text("student\nAda\nBo\nCy\n")
    words = ["handout", "--roster", "class.csv", "--exercises", "1", "--to", "pdf"]
    done = subprocess.run(
        [sys.executable, "-m", "nmatrix", *words, "--workers", "2", "-o", "out"],
        cwd=tmp_path, capture_output=True, check=False, timeout=120,
        env={**os.environ, "PYTHONPATH": str(Path(__file__).parents[2])},
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert len(list((tmp_path / "out").glob("*.pdf"))) == 3
