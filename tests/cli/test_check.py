"""`nmatrix check` as a grader meets it: exit codes, keys, notations, classes."""

from __future__ import annotations

import csv
import io
import json
from io import StringIO
from pathlib import Path

import pytest

from nmatrix.lessons.check.mistakes import MISTAKES

KEYS = ["verdict", "mistake", "also", "explanation", "max_difference", "wrong_entries"]


@pytest.mark.parametrize(
    "answer",
    [
        '"1 0 0; 0 0.5 0; 0 0 1"',
        '"[[1,0,0],[0,1/2,0],[0,0,1]]"',
        '"mat3(1.0, 0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 1.0)"',
        '"array([[2., 0., 0.], [0., 1., 0.], [0., 0., 2.]])"',
        '"1 0 0 0 0.5 0 0 0 1"',
        '"1 0 0 0; 0 0.5 0 0; 0 0 1 0; 0 0 0 1"',
    ],
)
def test_any_notation_of_the_right_answer_exits_with_zero(nmatrix, answer):
    code, out, err = nmatrix(f"check normal {answer} --scale 1 2 1 -f json")
    assert (code, err) == (0, "")
    found = json.loads(out)
    assert found["verdict"] == "correct"
    assert [key for key in found if key in KEYS] == KEYS
    assert found["mistake"] is None


def test_a_mistake_exits_with_one_after_the_whole_answer(nmatrix):
    code, out, err = nmatrix('check normal "1 0 0; 0 2 0; 0 0 1" --scale 1 2 1 -f json')
    found = json.loads(out)
    assert code == 1
    assert err.startswith("error: answer (wrong): not-inverted")
    assert err.count("\n") == 1
    assert found["wrong_entries"] == [[1, 1]]
    assert found["also"] == ["used-world-matrix"]


def test_the_wrong_entries_are_marked_for_people(nmatrix):
    code, out, _ = nmatrix('check normal "1 0 0; 0 2 0; 0 0 1" --scale 1 2 1')
    assert code == 1
    assert out.count("✗") == 2  # the title and the one entry
    assert "2 ✗" in out
    assert "0.5" not in out  # the right answer stays hidden


@pytest.mark.parametrize(
    ("line", "code", "words"),
    [
        ("check world prose", 2, "prose"),
        ('check world "1 2 3 4 5"', 2, "it is to have 9 or 16 numbers"),
        ('check light "1 2" --space camera', 2, "3 or 4 numbers"),
        ("check", 2, "WHAT"),
        ("check colour 1", 2, "it is one of"),
        ("check world", 2, "ANSWER or --batch"),
        ('check world "1 0 0; 0 1 0; 0 0 1" --unit', 2, "length"),
        ('check eye "0 0 0" --normal 1 0 0', 2, "check normal"),
        ('check eye "0 0 0" --tolerance -1', 2, "not negative"),
        ("check world --batch no-such.csv", 2, "no such file"),
        ("check world --batch .", 2, "it is a folder"),
        ("check exercise 3 c --scale 1 2 1", 2, "numbers of its own"),
        ("check exercise 3 c --unit", 2, "numbers of its own"),
        ("check exercise 3 c --tolerance x", 2, "numbers of its own"),
        ("check exercise 3 c --batch answers.csv", 2, "in the file"),
        ('check light "1 0 0" --light-position 1 2 3 --unit', 2, "only a direction"),
    ],
)
def test_what_cannot_be_checked_is_refused_in_one_line(nmatrix, line, code, words):
    found, out, err = nmatrix(line)
    assert found == code
    assert words in err
    assert err.startswith("error: ")
    assert err.count("\n") == 1
    assert out == ""


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ('check normal "1 0 0; 0 1 0; 0 0 1" --scale 1 0 1', "inverse transpose"),
        ('check eye "0 0 0" --space object --scale 1 0 1', "object space"),
        ('check normal "0 1 0" --normal 1 0 0 --scale 1 0 1', "silhouette"),
    ],
)
def test_a_scene_without_an_answer_is_told_in_full(nmatrix, line, words):
    code, out, err = nmatrix(f"{line} -f json")
    assert (code, err.count("\n")) == (3, 1)
    assert words in err
    found = json.loads(out)
    assert (found["verdict"], found["mistake"]) == ("unknown", None)
    assert words in found["explanation"]


DAMAGED = """student,answer
Ada,"1 0 0; 0 0.5 0; 0 0 1"
Bo,"1 0 0; 0 0.5 0; 0 0 1
Cy,"1 0 0; 0 2 0; 0 0 1"
Di,"1 0 0; 0 0.5 0; 0 0 1" oh
Eve,1 0 0; 0 0.5 0; 0 0 1,2
Flo,LONG
Gil,"1 0 0; 0 0.5 0; 0 0 1"
"""


def test_a_bad_row_costs_only_itself(nmatrix, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("class.csv").write_text(DAMAGED.replace("LONG", "1" * 200_000))
    code, out, _ = nmatrix("check normal --scale 1 2 1 --batch class.csv --strict -f json")
    assert code == 1
    rows = json.loads(out)["rows"]
    assert [(row["student"], row["verdict"]) for row in rows] == [
        ("Ada", "correct"),
        ("Bo", "unreadable"),
        ("Cy", "mistake"),
        ("Di", "unreadable"),
        ("Eve", "unreadable"),
        ("Flo", "unreadable"),
        ("Gil", "correct"),
    ]
    assert rows[2]["also"] == ["used-world-matrix"]
    for row, words in ((1, "line 3: a quote"), (3, "line 5: a quote"), (5, "line 7: a cell is")):
        assert words in rows[row]["explanation"]


def test_a_class_may_come_from_standard_input(nmatrix, monkeypatch):
    text = io.TextIOWrapper(io.BytesIO(b"student;answer\nAda;0,0,5\n"), encoding="utf-8")
    monkeypatch.setattr("sys.stdin", text)
    code, out, _ = nmatrix("check eye --batch - -f json")
    assert code == 0
    assert json.loads(out)["summary"]["correct"] == 1


def test_a_tolerance_takes_the_place_of_the_digits(nmatrix):
    line = 'check normal "1 0 0; 0 0.52 0; 0 0 1" --scale 1 2 1'
    assert nmatrix(line)[0] == 1
    assert nmatrix(f"{line} --tolerance 0.05")[0] == 0
    assert nmatrix('check eye "0 0 5" --tolerance 0')[0] == 0


def test_of_a_light_with_two_parts_either_is_right(nmatrix):
    options = "--space camera --light-direction 0 -1 0 --light-position 2 2 8"
    for answer in ("0 -1 0", "2 2 3"):
        assert nmatrix(f'check light "{answer}" {options}')[0] == 0
    assert nmatrix(f'check light "2 2 8" {options}')[0] == 1


def test_column_major_answers_are_read_as_such(nmatrix):
    transposed = '"1 0 0 0; 0 1 0 0; 0 0 1 0; 1 2 3 1"'
    line = f"check world {transposed} --translate 1 2 3"
    assert "transposed-layout" in nmatrix(line)[2]
    assert nmatrix(f"{line} --input-layout column-major")[0] == 0


def test_what_nmatrix_writes_it_accepts(nmatrix, tmp_path):
    options = "--translate 1 2 3 --rotate 10 20 30 --scale 1 2 -1"
    for form in ("json", "csv", "numpy", "glsl", "latex"):
        _, out, _ = nmatrix(f"world {options} -f {form} --digits 12")
        file = tmp_path / f"answer.{'json' if form == 'json' else 'txt'}"
        file.write_text(out, encoding="utf-8")
        code, _, err = nmatrix(f"check world {file}#world_from_object {options}")
        assert (code, err) == (0, ""), form


CLASS = """\ufeffStudent;Exercise;Answer
Ada;1;1 0 0; 0 0.5 0; 0 0 1
"Lovelace; A.";1;"1 0 0; 0 0.5 0; 0 0 1"

Bo;1;"1 0 0; 0 2 0; 0 0 1"
Cy;1;half
<script>;1;"1 2 3; 4 5 6; 7 8 9"
"""


def test_a_class_is_graded_row_by_row(nmatrix, tmp_path):
    file = tmp_path / "class.csv"
    file.write_text(CLASS, encoding="utf-8")
    code, out, err = nmatrix(f"check normal --batch {file} --scale 1 2 1 -f csv --strict")
    rows = list(csv.DictReader(StringIO(out)))
    assert [row["verdict"] for row in rows] == [
        "unreadable", "correct", "mistake", "unreadable", "unknown",
    ]  # fmt: skip
    assert rows[0]["explanation"].startswith("line 2: ")
    assert rows[1]["student"] == "Lovelace; A."
    assert rows[2]["mistake"] == "not-inverted"
    assert (code, err.count("\n")) == (1, 1)
    summary = json.loads(nmatrix(f"check normal --batch {file} --scale 1 2 1 -f json")[1])
    assert summary["summary"] == {"correct": 1, "mistake": 1, "unknown": 1, "unreadable": 2}


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "it is empty"),
        (b"grade,answer\nAda,1\n", "column student"),
        (b"student,answer,answer\n", "two of them"),
        ("student,answer\n山田太郎,1\n".encode("shift_jis"), "UTF-8"),
        (b'student,answer\n"Ada,1\n' * 3, ""),
    ],
)
def test_a_class_file_that_cannot_be_read_is_refused(nmatrix, tmp_path, content, words):
    file = tmp_path / "class.csv"
    file.write_bytes(content)
    code, _, err = nmatrix(f"check eye --batch {file} --strict")
    assert code in (1, 2)
    assert words in err
    assert err.count("\n") == 1


def test_who_answers_twice_and_who_cannot_be_read_are_named(nmatrix, tmp_path):
    path = tmp_path / "class.csv"
    path.write_text("student,answer\nAda,0 0 5\nAda,0 0 4\nBo,five\n", encoding="utf-8")
    code, out, err = nmatrix(f"check eye --batch {path} --strict -f markdown")
    assert code == 1
    assert "Answered more than once, each row graded by itself: Ada." in out
    assert "line 4" in out
    assert "Bo" in out
    assert "see the reasons above" in err


def test_two_mistakes_that_look_alike_are_both_said(nmatrix):
    _, out, _ = nmatrix('check normal "1 0 0; 0 2 0; 0 0 1" --scale 1 2 1')
    said = " ".join(out.split())
    assert "not-inverted, or used-world-matrix" in said
    assert "Or, with the same numbers here: You used the matrix itself." in said


def test_a_class_with_one_good_file_exits_with_zero_whatever_its_grades(nmatrix, tmp_path):
    file = tmp_path / "class.csv"
    file.write_text("student,answer\nAda,0 0 5\nBo,0 0 0\n")
    assert nmatrix(f"check eye --batch {file}")[0] == 0


@pytest.mark.parametrize(
    "command",
    sorted({c for one in MISTAKES.values() for c in (one.command, *one.elsewhere.values())}),
)
def test_the_command_that_shows_the_right_way_runs(nmatrix, command):
    code, out, err = nmatrix(command.removeprefix("nmatrix "))
    assert (code, err) == (0, "")
    assert out


def test_neither_numpy_nor_sympy_is_loaded():
    import subprocess
    import sys

    code = (
        "import sys; from nmatrix.cli.app import run; "
        "run(['check','normal','1 0 0; 0 2 0; 0 0 1','--scale','1','2','1']); "
        "print([m for m in ('numpy','sympy') if m in sys.modules], file=sys.stderr)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stderr.endswith("[]\n")


def test_only_line_feeds_end_a_row(nmatrix, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("class.csv").write_text("student,answer\nA\u2028B\x0bC,0 0 5\n", encoding="utf-8")
    code, out, _ = nmatrix("check eye --batch class.csv -f json")
    assert (code, json.loads(out)["summary"]["correct"]) == (0, 1)
