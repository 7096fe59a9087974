"""`nmatrix check exercise`: sheets of students, salts, classes."""

from __future__ import annotations

import json

import pytest


def test_an_exercise_is_graded_for_its_student(nmatrix):
    from nmatrix.lessons.exercises.scheme import Sheet
    from nmatrix.lessons.exercises.sheet import exercise

    one = exercise(2, Sheet("7", "Ada"))
    of = "--seed 7 --student Ada"
    assert nmatrix(f'check exercise 2 "{one.right}" {of}')[0] == 0
    code, out, _ = nmatrix(f'check exercise 2 "{one.planned[0].text}" {of} -f json')
    assert (code, json.loads(out)["mistake"]) == (1, one.planned[0].mistake.value)
    assert nmatrix(f'check exercise 2 "{one.right}" --seed 8 --student Ada')[0] == 1


def test_a_salt_makes_another_sheet(nmatrix, tmp_path):
    from nmatrix.lessons.exercises.scheme import Sheet
    from nmatrix.lessons.exercises.sheet import exercise

    (tmp_path / "salt").write_bytes(b"only the teacher knows")
    salted = exercise(1, Sheet("7", "Ada", b"only the teacher knows"))
    line = f'check exercise 1 "{salted.right}" --seed 7 --student Ada'
    assert nmatrix(f"{line} --salt {tmp_path / 'salt'}")[0] == 0
    assert nmatrix(line)[0] == 1
    assert nmatrix(f"{line} --salt {tmp_path / 'none'}")[0] == 2


def test_a_class_of_exercises_is_graded_by_student_and_number(nmatrix, tmp_path):
    from nmatrix.lessons.exercises.scheme import Sheet
    from nmatrix.lessons.exercises.sheet import exercises

    lines = ["student,exercise,answer"]
    for student in ("Ada", "Bo"):
        sheet = exercises(10, Sheet("7", student))
        lines += [f'{student},{one.number},"{one.right}"' for one in sheet]
    lines += ["Cy,one,a", "Cy,3,z"]
    file = tmp_path / "class.csv"
    file.write_text("\n".join(lines), encoding="utf-8")
    code, out, _ = nmatrix(f"check exercise --batch {file} --seed 7 --strict -f json")
    assert code == 1
    assert json.loads(out)["summary"] == {
        "correct": 20, "mistake": 0, "unknown": 0, "unreadable": 2,
    }  # fmt: skip


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("check exercise", "number of the exercise"),
        ("check exercise 3", "number of the exercise"),
        ("check exercise three a", "whole number"),
        ("check exercise 0 a", "1 to 100"),
        ("check exercise 3 perhaps", "none of the choices"),
        ("check eye 1 2", "takes one ANSWER"),
        ('check eye "0 0 5" --seed 7', "check exercise"),
        ("check exercise --batch none.csv --student Ada", "students stand in the file"),
    ],
)
def test_misuse_of_exercises_is_one_line(nmatrix, line, words):
    code, out, err = nmatrix(line)
    assert (code, out) == (2, "")
    assert words in err
    assert err.count("\n") == 1
