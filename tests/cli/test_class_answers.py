"""Answers and class lists as people have them, their points, and the files that graders want."""

from __future__ import annotations

import csv
import json
from io import StringIO
from pathlib import Path

import pytest

from nmatrix.lessons.exercises.scheme import Sheet
from nmatrix.lessons.exercises.sheet import exercise, exercises
from nmatrix.reading.headers import SYNONYMS, places_of
from nmatrix.reading.legacy import ENCODINGS
from nmatrix.reading.records import records_in

NAMES = {
    "cp1252": "Zoë Müller",
    "cp1250": "Łukasz Świątek",
    "cp1251": "Иванов Иван",
    "mac_roman": "José Núñez",
    "cp850": "Jürgen Müller",
}


def right(student: str, number: int = 5) -> str:
    return exercise(number, Sheet("7", student)).right


def rows(out: str) -> list[dict[str, str]]:
    return list(csv.DictReader(StringIO(out)))


@pytest.fixture(autouse=True)
def _in_a_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize("encoding", [*ENCODINGS, "utf-8", "utf-8-sig", "utf-16"])
def test_answers_are_graded_in_every_encoding_that_spreadsheets_save(nmatrix, encoding):
    name = NAMES.get(encoding, "李小龍, 'Ж' Zoë")
    text = f'Name;Question;Response\r\n"{name}";5;"{right(name)}"\r\n'
    Path("a.csv").write_bytes(text.encode(encoding))
    code, out, err = nmatrix("check exercise --batch a.csv --seed 7 -f csv")
    assert (code, err) == (0, "")
    assert [(row["student"], row["verdict"]) for row in rows(out)] == [(name, "correct")]
    if encoding in ENCODINGS:
        assert f"({encoding})" in nmatrix("check exercise --batch a.csv --seed 7")[1]


def test_a_roster_in_an_old_encoding_makes_the_sheets_of_its_names(nmatrix):
    Path("c.csv").write_bytes("Matricola\tNome\tCognome\n1\tNicolò\tPerò\n".encode("cp1252"))
    code, out, _ = nmatrix("handout --roster c.csv --exercises 1 -o out")
    assert code == 0
    assert "cp1252" in out
    assert "Nicolò Però" in Path("out/0001-nicolo-pero.html").read_text(encoding="utf-8")


@pytest.mark.parametrize("column", SYNONYMS)
def test_each_name_of_a_column_is_known_in_any_case(column):
    for known in SYNONYMS[column]:
        assert places_of(column, ["x", known.upper()]) == (1,)


@pytest.mark.parametrize(
    ("header", "student"),
    [
        ("E-mail,Full name", "Bo"),
        ("ID;Name", "Bo"),
        ("Nachname\tVorname", "Bo a@b.c"),
        ("Surname,First name", "Bo a@b.c"),
        ("sep=;\nName;E-mail", "a@b.c"),
    ],
)
def test_the_column_that_names_a_student_best_is_taken(header, student):
    parting = next(one for one in ";\t," if one in header)
    text = f"{header}\na@b.c{parting}Bo\n"
    found = records_in(text.encode(), ["student"], "x")
    assert [one.cells["student"] for one in found.rows] == [student]


def test_decimal_commas_are_read_where_they_can_only_be_that(nmatrix):
    typed = {one: right(one).replace(".", ",") for one in ("Ada", "Bo", "Cy")}
    lines = ["student;exercise;answer"]
    for student in typed:
        exact = exercise(5, Sheet("7", student)).grader.by.right[0][:3]
        for parting in (" ", "; "):
            numbers = (f"{float(x):.3f}".replace(".", ",") for x in exact)
            lines.append(f'{student};5;"{parting.join(numbers)}"')
    Path("a.csv").write_text("\n".join(lines), encoding="utf-8")
    found = rows(nmatrix("check exercise --batch a.csv --seed 7 -f csv")[1])
    assert [row["verdict"] for row in found] == ["correct"] * 6


def test_a_letter_that_is_no_choice_is_wrong_and_a_sentence_is_unreadable(nmatrix):
    Path("a.csv").write_text("student,exercise,answer\nAda,6,d\nAda,6,no idea at all\n")
    code, out, _ = nmatrix("check exercise --batch a.csv --seed 7 -f csv")
    assert code == 0
    assert [row["verdict"] for row in rows(out)] == ["unknown", "unreadable"]
    assert nmatrix("check exercise --batch a.csv --seed 7 --strict")[0] == 1


def test_points_count_entries_and_the_last_answer_of_a_student(nmatrix):
    numbers = right("Ada").split()
    half = " ".join([numbers[0], numbers[1], "99"])
    lines = [
        "student,exercise,answer",
        f"Ada,5,{half}",
        "Bo,5,99 98 97",
        f"Bo,5,{right('Bo')}",
        "Bo,3,z",
    ]
    Path("a.csv").write_text("\n".join(lines), encoding="utf-8")
    found = json.loads(nmatrix("check exercise --batch a.csv --seed 7 --points 6 -f json")[1])
    assert [(one["student"], one["points"], one["of"]) for one in found["students"]] == [
        ("Ada", 4, 12),
        ("Bo", 6, 12),
    ]
    table = rows(nmatrix("check exercise --batch a.csv --seed 7 --points 6 -f csv")[1])
    assert table[0] == {
        "student": "Ada", "exercise 3": "", "exercise 5": "4.0", "points": "4.0", "of": "12",
    }  # fmt: skip
    assert "the last one counts: Bo, exercise 5" in nmatrix(
        "check exercise --batch a.csv --seed 7 --points 6"
    )[1].replace("\n  ", " ")


def test_a_whole_class_of_right_answers_has_all_points(nmatrix):
    lines = ["student,exercise,answer"]
    for student in ("Ada", "Bo"):
        lines += [
            f'{student},{one.number},"{one.right}"' for one in exercises(10, Sheet("7", student))
        ]
    Path("a.csv").write_text("\n".join(lines), encoding="utf-8")
    table = rows(nmatrix("check exercise --batch a.csv --seed 7 --points 3 -f csv")[1])
    assert [(row["student"], row["points"]) for row in table] == [("Ada", "30.0"), ("Bo", "30.0")]
    assert list(table[0])[-3:] == ["exercise 10", "points", "of"]


def test_gradescope_gets_a_file_for_each_student(nmatrix):
    Path("a.csv").write_text(f"student,exercise,answer\nAda,5,{right('Ada')}\n../x,5,1 2 3\n")
    code, out, _ = nmatrix("check exercise --batch a.csv --seed 7 --points 4 -f gradescope -o out")
    assert code == 0
    assert "2 files" in out
    found = [json.loads(path.read_text()) for path in sorted(Path("out").glob("*/results.json"))]
    assert found[0]["score"] == 4
    assert found[0]["tests"][0]["status"] == "passed"
    for one in found:
        assert one["score"] == sum(test["score"] for test in one["tests"])
        assert all(0 <= test["score"] <= test["max_score"] for test in one["tests"])


def test_one_answer_is_graded_for_gradescope_on_stdout(nmatrix):
    code, out, err = nmatrix(
        f'check exercise 5 "{right("Ada")}" --seed 7 --student Ada -f gradescope'
    )
    assert (code, err) == (0, "")
    assert json.loads(out)["score"] == 1
    code, out, _ = nmatrix("check eye '9 9 9' -f gradescope --points 5")
    assert code == 1
    assert json.loads(out)["tests"][0]["max_score"] == 5


REFUSED = (
    "check eye --batch a.csv -f gradescope",
    "check eye --batch a.csv -o out",
    "check eye '0 0 5' -o out",
    "check eye '0 0 5' --strict",
    "check eye --batch a.csv --points 0",
    "check eye --batch a.csv --points many",
)


@pytest.mark.parametrize("line", REFUSED)
def test_options_of_a_class_that_cannot_be_meant_are_refused_in_one_line(nmatrix, line):
    Path("a.csv").write_text("student,answer\nAda,0 0 5\nBo,1 2 3\n")
    code, out, err = nmatrix(line)
    assert (code, out, err.count("\n")) == (2, "", 1)


def test_no_name_is_run_by_a_spreadsheet(nmatrix):
    names = ["=1+1", "+1", "-1", "@x"]
    Path("a.csv").write_text("student,answer\n" + "\n".join(f"{one},0 0 5" for one in names))
    table = rows(nmatrix("check eye --batch a.csv --points 2 -f csv")[1])
    assert [row["student"] for row in table] == [f"'{one}" for one in names]


@pytest.mark.parametrize("line", ["check eye --batch {}", "handout --roster {} -o out"])
@pytest.mark.parametrize(
    "content", [b"PK\x03\x04\x14\x00", b"\xd0\xcf\x11\xe0\xa1", bytes(range(256))]
)
def test_what_is_no_table_is_told_in_one_line(nmatrix, line, content):
    Path("class.xlsx").write_bytes(content)
    code, out, err = nmatrix(line.format("class.xlsx"))
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert "CSV UTF-8" in err
