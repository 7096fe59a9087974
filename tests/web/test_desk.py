"""The desk answers as the command line does, with plain values, whatever it is asked."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import pytest

from nmatrix.cli.web import desk as opened
from nmatrix.lessons.exercises.exercise import Choice, ExerciseKind
from nmatrix.lessons.exercises.scheme import Sheet
from nmatrix.lessons.exercises.sheet import exercise
from nmatrix.web.desk import LONGEST


@pytest.fixture
def desk():
    return opened()


def asked(desk, name: str, **how: object) -> dict:
    """Ask as the worker does: what JSON cannot hold would fail there."""
    return json.loads(json.dumps(desk.answer(name, json.loads(json.dumps(how)))))


@pytest.mark.parametrize(
    "line",
    [
        "world --scale 1 2 1",
        "world --scale 1 2 1 -f json",
        "calc '1 +'",
        "check normal '1 0 0; 0 2 0; 0 0 1' --scale 1 2 1",
        "nothing",
        "help world",
        "",
    ],
)
def test_a_command_line_leaves_what_a_pipe_gets(desk, nmatrix, line: str) -> None:
    told, found = asked(desk, "command", words=line), nmatrix(line)
    assert (told["code"], told["out"], told["err"]) == found
    assert asked(desk, "command", words=f"nmatrix {line}") == told


def test_a_command_reads_the_files_and_the_input_that_it_is_given(desk) -> None:
    files = {"a.calc": "a = 1/3\na*2\n", "-": "1 0 0\n0 2 0\n0 0 1\n"}
    assert "2/3" in asked(desk, "command", words="calc a.calc", files=files)["out"]
    told = asked(desk, "command", words="identify -", files=files)
    assert (told["code"], told["files"]) == (0, [])
    assert "scaled by 1 2 1" in told["out"]


def test_files_that_a_command_wrote_are_given_back(desk) -> None:
    told = asked(desk, "command", words="handout --to moodle --variants 1 -o bank.xml")
    (file,) = told["files"]
    assert (file["name"], file["base64"]) == ("bank.xml", None)
    assert file["text"].startswith("<?xml")
    assert asked(desk, "command", words="calc bank.xml")["code"] == 2, (
        "each line has its own folder"
    )


def test_half_a_character_is_no_defect(desk) -> None:
    half = "\ud800"
    for name, how in (
        ("exercise", {"number": 1, "seed": half, "student": half}),
        ("grade", {"number": 3, "seed": half, "answer": "a"}),
        ("command", {"words": f"calc '{half}'"}),
        ("shown", {"words": ["calc", "a"], "files": {"b": half, "-": half}}),
        ("say", {"text": f"# {half}\nsave {half}", "whole": True}),
    ):
        assert "defect" not in json.dumps(asked(desk, name, **how)), name


@pytest.mark.parametrize("number", [0, -1, 101, 10**30, 1.5, "3", None])
@pytest.mark.parametrize("name", ["exercise", "key", "grade"])
def test_an_exercise_that_no_sheet_has_is_refused(desk, name: str, number: object) -> None:
    answer = {"answer": "a"} if name == "grade" else {}
    told = asked(desk, name, number=number, **answer)
    assert (told["code"], told["error"].startswith("exercise")) == (2, True)


def test_a_question_that_there_is_not_ends_nothing(desk) -> None:
    assert asked(desk, "nonsense")["code"] == 70
    assert asked(desk, "say", txt="a")["code"] == 70
    assert asked(desk, "say", text="2")["turns"][0]["text"] == "ans  2\n"


@pytest.mark.parametrize("name", ["../up", "/etc/x", "a/b", "..", "", "a\nb", "n" * 300])
def test_a_file_lies_in_the_folder_of_its_line(desk, name: str) -> None:
    told = asked(desk, "command", words="world", files={name: "x"})
    assert (told["code"], "name" in told["error"].partition(": ")[2]) == (2, True)


def test_an_answer_for_eyes_has_formulas_and_the_line_that_gives_it(desk) -> None:
    told = asked(desk, "shown", words=["identify", "1 0 0; 0 2 0; 0 0 1"])
    assert told["command"] == "nmatrix identify '1 0 0; 0 2 0; 0 0 1'"
    assert "<strong>It is an affine map: scaled by 1 2 1.</strong>" in told["html"]
    assert told["text"] == asked(desk, "command", words=told["command"])["out"]
    short, whole = (asked(desk, "shown", words=f"world {one}")["html"] for one in ("", "--full"))
    assert len(short) < len(whole)
    assert "<math" in short


def test_markup_in_what_is_typed_is_text(desk) -> None:
    nasty = "<img src=x onerror=alert(1)>"
    for line in (["calc", nasty], ["check", "exercise", "3", nasty], ["identify", nasty]):
        told = asked(desk, "shown", words=line)
        assert "<img" not in told["html"]
    said = asked(desk, "say", text=f"{nasty}\nshow {nasty}")
    assert "<img" not in json.dumps([one["html"] for one in said["turns"]])
    asked_for = asked(desk, "exercise", number=1, student=nasty)
    assert "<img" not in asked_for["html"]
    graded = asked(desk, "grade", number=3, student=nasty, answer="a")
    assert "<img" not in graded["html"]


def test_a_session_goes_on_from_line_to_line(desk) -> None:
    first = asked(desk, "say", text="a = 1/3")
    assert first["names"][-1] == {"name": "a", "value": "1/3"}
    second = asked(desk, "say", text="a + 1/6\nb")
    assert [one["failed"] for one in second["turns"]] == [False, False]
    assert second["turns"][0]["text"] == "ans  1/2\n"
    third = asked(desk, "say", text="a +")
    assert third["turns"][0]["failed"]
    assert "^" in third["turns"][0]["text"]
    assert third["session"] == second["session"]
    assert asked(desk, "say", text="quit")["closed"]


def test_a_statement_that_goes_on_waits_for_its_next_line(desk) -> None:
    told = asked(desk, "say", text="A = [1 2")
    assert (told["turns"], told["more"]) == ([], "A = [1 2")
    told = asked(desk, "say", text=f"{told['more']}\n3 4]")
    assert (told["turns"][0]["failed"], told["more"]) == (False, "")
    told = asked(desk, "say", text="v = 1 2 3", whole=True)
    assert (len(told["turns"]), told["more"]) == (1, "")


def test_a_line_is_shown_again_with_its_steps_as_it_was(desk) -> None:
    number = asked(desk, "say", text="A = [2 1; 1 1]\ninverse(A)")["turns"][1]["number"]
    asked(desk, "say", text="A = 0")
    plain, steps = (asked(desk, "again", number=number, steps=one) for one in (False, True))
    assert plain["text"] == "ans\n  ⎡  1  -1 ⎤\n  ⎣ -1   2 ⎦\n"
    assert len(steps["text"]) > len(plain["text"])
    assert "minors" in steps["html"]
    assert "\\begin" in asked(desk, "again", number=number, format="latex")["text"]
    assert "its session has ended" in asked(desk, "again", number=999)["error"]


def test_a_session_comes_back_from_its_text(desk) -> None:
    text = asked(desk, "say", text="M2 = [1 2\n3 4]\nv = 1 2\n\nnumbers decimal\nv * 2")["session"]
    other = opened()
    state = asked(other, "resume", text=text)
    assert state["session"] == text
    assert state["settings"]["numbers"] == "decimal"
    assert {"M2", "v", "ans"} <= {one["name"] for one in state["names"]}
    assert asked(other, "say", text="undo")["turns"][0]["failed"] is False
    assert {one["name"] for one in asked(other, "resume", text="")["names"]} == {"M", "V", "P"}


def test_what_is_saved_is_given_to_the_page_and_loaded_from_it(desk) -> None:
    (saved,) = asked(desk, "say", text="a = 7\nsave mine.calc")["files"]
    assert saved == {"name": "mine.calc", "text": "a = 7\n"}
    other = opened()
    told = asked(other, "say", text="load mine.calc\na", files={"mine.calc": saved["text"]})
    assert told["turns"][1]["text"] == "ans  7\n"
    assert "the page has not got it" in asked(other, "say", text="load no.calc")["turns"][0]["text"]


@pytest.mark.parametrize("number", range(1, len(ExerciseKind) + 1))
def test_an_exercise_is_asked_and_graded_as_on_its_sheet(desk, nmatrix, number: int) -> None:
    one, whose = exercise(number, Sheet("7", "Ada")), {"seed": "7", "student": "Ada"}
    told = asked(desk, "exercise", number=number, **whose)
    assert (told["title"], told["form"]) == (one.title, one.form)
    assert bool(told["choices"]) is isinstance(one.grader, Choice)
    assert (told["fields"] is None) is bool(told["choices"])
    right = asked(desk, "grade", number=number, answer=one.right, **whose)
    assert (right["verdict"], right["next"], right["err"]) == ("correct", "", "")
    assert asked(desk, "key", number=number, **whose)["right"] == one.right
    for wrong in one.planned:
        graded = asked(desk, "grade", number=number, answer=wrong.text, **whose)
        found = nmatrix(f"check exercise {number} --seed 7 --student Ada -f json -- '{wrong.text}'")
        for key in ("verdict", "mistake", "also", "explanation"):
            assert graded[key] == found.data[key]
        assert graded["wrong"] == found.data["wrong_entries"]
        assert bool(graded["rule"]) is (graded["mistake"] is not None)
        assert graded["rule"] in graded["explanation"]


def test_cells_are_the_answer_that_they_would_be_as_text(desk) -> None:
    cells = [["1", "1/2", "-3"], ["0", " 2 ", "0"], ["0", "0", "1"]]
    told = asked(desk, "grade", number=2, answer=cells, seed="7")
    assert told["command"].endswith("-- '1 1/2 -3; 0 2 0; 0 0 1'")
    column = asked(desk, "grade", number=4, answer=[["-1"], ["2"], ["3"]], seed="7")
    assert column["command"].endswith("-- '-1 2 3'")
    empty = asked(desk, "grade", number=4, answer=[["1"], [" "], ["3"]], seed="7")
    assert empty["error"] == "cell (2): it is empty; write a number there"
    refused = asked(desk, "grade", number=2, answer="abc", seed="7")
    assert (refused["code"], refused["error"].startswith("answer (abc):")) == (2, True)


def test_a_sheet_of_a_space_takes_the_options_of_its_command(desk) -> None:
    told = asked(desk, "sheet", space="object", options=["--scale", "1", "2", "1"])
    assert told["command"] == "nmatrix space object --scale 1 2 1"
    assert told["text"] == asked(desk, "command", words=told["command"])["out"]


def test_words_are_offered_for_what_was_begun(desk) -> None:
    asked(desk, "say", text="inverted = 1\n")
    told = asked(desk, "complete", text="2 * inv + 1", cursor=7)
    assert told == {"begun": "inv", "words": ["inverse(", "inverse_transpose(", "inverted"]}


def test_the_catalogue_says_why_a_command_cannot_run(desk, monkeypatch) -> None:
    found = {one["name"]: one for one in asked(desk, "catalogue")["commands"]}
    assert found["world"]["why_not"] == found["derive"]["why_not"] == ""
    monkeypatch.setattr("nmatrix.web.desk.find_spec", lambda _: None)
    found = {one["name"]: one for one in asked(desk, "catalogue")["commands"]}
    assert "pip install 'sympy" in found["derive"]["why_not"]
    assert found["world"]["why_not"] == ""


def test_what_is_too_long_is_refused_before_anything_reads_it(desk) -> None:
    long = "1 " * LONGEST
    for name, how in (
        ("say", {"text": long}),
        ("command", {"words": ["identify", long]}),
        ("command", {"words": "identify -", "files": {"-": long}}),
        ("grade", {"number": 1, "answer": [[long]]}),
        ("complete", {"text": long, "cursor": 1}),
    ):
        told = asked(desk, name, **how)
        assert told["error"].startswith("what was typed: it has 200,0"), told
        assert told["code"] == 2


def test_a_quotation_mark_that_nobody_closes_is_refused(desk) -> None:
    assert "close it" in asked(desk, "command", words="calc 'a")["error"]


def test_streams_and_the_folder_are_as_before_whatever_a_line_did(desk) -> None:
    before = (sys.stdin, sys.stdout, sys.stderr, Path.cwd())
    asked(desk, "command", words="calc -", files={"-": "1/0"})
    asked(desk, "command", words="nothing", files={"a/b": ""})
    assert before == (sys.stdin, sys.stdout, sys.stderr, Path.cwd())


def test_a_comma_in_a_cell_is_a_point(desk) -> None:
    cells = [["0", "0", "-1/4", "3"], ["0", "0,5", "0", "1"], ["1", "0", "0", "2"], list("0001")]
    whose = {"number": 1, "seed": "7", "student": "Ada"}
    assert asked(desk, "grade", answer=cells, **whose)["verdict"] == "correct"
