"""A command line gives the same bytes in a browser as in a pipe, and so does every grading."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from base64 import b64encode
from itertools import islice
from pathlib import Path

import pytest
from command_lines import command_lines

from nmatrix.lessons.exercises.exercise import LETTERS, Choice, ExerciseKind
from nmatrix.lessons.exercises.scheme import Sheet
from nmatrix.lessons.exercises.sheet import exercise
from nmatrix.web.desk import NEEDS

pytestmark = pytest.mark.slow

MISSING = 4
NOT_HERE = re.compile(r"it needs [a-z, -]+, which this page does not bring; run it in a terminal")
MANY = """async (asked) => {
  const {ask} = await import('./engine.js');
  const told = [];
  for (const one of asked) {
    told.push(await ask("command", one).catch((error) => ({refused: error.message})));
  }
  return told;
}"""
ENVIRONMENT = {
    **{name: one for name, one in os.environ.items() if not name.startswith("NMATRIX_")},
    "PYTHONPATH": str(Path(__file__).resolve().parents[2]),
    "PYTHONIOENCODING": "utf-8",
}
ENVIRONMENT.pop("COLUMNS", None)


class Pipes:
    """Runs lines as processes while something else goes on."""

    def __init__(self, asked: list[dict[str, object]]) -> None:
        self._running = subprocess.Popen(
            [sys.executable, Path(__file__).with_name("forked.py")],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            env=ENVIRONMENT,
        )
        assert self._running.stdin is not None
        self._running.stdin.write(json.dumps(asked))
        self._running.stdin.close()

    def told(self) -> list[dict[str, object]]:
        with self._running as running:
            assert running.stdout is not None
            return json.load(running.stdout)


def of_browser(told: dict[str, object]) -> dict[str, object]:
    files = {
        one["name"]: one["base64"] or b64encode(one["text"].encode()).decode()
        for one in told.get("files", ())
    }
    return {name: told.get(name) for name in ("code", "out", "err")} | {"files": files}


def test_the_same_command_line_gives_the_same_bytes(opened) -> None:
    asked = command_lines()
    pipes = Pipes(asked)
    here, there = opened().evaluate(MANY, asked), pipes.told()
    alike = 0
    for line, one, other in zip(asked, here, there, strict=True):
        if one.get("code") == MISSING:
            assert NOT_HERE.search(one["err"]), line
            words = line["words"]
            assert words[0] in (*NEEDS, "handout", "calc") or "--scene" in words, line
            continue
        assert of_browser(one) == other, line
        alike += 1
    assert alike >= 300


def gradings() -> list[dict[str, object]]:
    """The ten kinds of thirty students: by turns the right answer and each wrong one in mind."""
    found = []
    for i in range(30):
        sheet = Sheet("7", f"student {i}")
        for number in range(1, len(ExerciseKind) + 1):
            one = exercise(number, sheet)
            wrong = [two.text for two in one.planned]
            if isinstance(one.grader, Choice):
                wrong = list(LETTERS[: len(one.grader.options)])
            answers = [*dict.fromkeys((one.right, *wrong))]
            whose = ["--seed", sheet.seed, "--student", sheet.student, "-f", "json"]
            answer = answers[i % len(answers)]
            found.append({"words": ["check", "exercise", str(number), *whose, "--", answer]})
    return found


def test_a_grading_is_the_same_to_the_byte(opened) -> None:
    asked = gradings()
    assert len(asked) >= 300
    pipes = Pipes(asked)
    here, there = opened().evaluate(MANY, asked), pipes.told()
    for line, one, other in zip(asked, here, there, strict=True):
        assert of_browser(one) == other, line
    assert {json.loads(one["out"])["verdict"] for one in here} == {"correct", "mistake", "unknown"}


def test_forked_lines_are_what_processes_of_their_own_print() -> None:
    asked = [one for one in islice(command_lines(), 0, None, 80) if not one["files"]]
    for line, told in zip(asked, Pipes(asked).told(), strict=True):
        done = subprocess.run(
            [sys.executable, "-m", "nmatrix", *line["words"]],
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            check=False,
            env=ENVIRONMENT,
        )
        del told["files"]
        assert told == {"code": done.returncode, "out": done.stdout, "err": done.stderr}
