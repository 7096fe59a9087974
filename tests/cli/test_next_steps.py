"""A next step repeats what was typed, and runs as it stands."""

from __future__ import annotations

import re
import shlex

import pytest

from nmatrix.cli.next_steps import LONGEST, with_own_words

COMMAND = re.compile(r"nmatrix (?P<line>.+?)(?: shows the right one)?$")

# Lines that lack something, and what their next step must still hold.
LACKING = {
    "check eye --scale 1 2 1 --eye 1 2 3": "--scale 1 2 1 --eye 1 2 3",
    "check view --eye 1 2 3 --handed left": "--eye 1 2 3 --handed left",
    "check --scale=1,2,1": "--scale=1,2,1",
    "check normal --world-matrix '1 0 0; 0 2 0; 0 0 1' --json": '"1 0 0; 0 2 0; 0 0 1" --json',
    "normal --normal 1 1 0 --normal 2 0 1": "--normal 1 1 0 --normal 2 0 1",
    "normal --normal '1 1 0' --digits 3": '--normal "1 1 0" --digits 3',
    "axes ros": "axes ros unity",
    "axes ros --order ZYX --json": "axes ros unity --order ZYX --json",
    "axes": "axes blender unity",
    "identify --digits 3": "--digits 3",
    "plan --json": "plan sample --json",
    "inspect --only mirrored": "inspect teapot --only mirrored",
}
# Wrong answers without a known mistake: the command that shows the right one.
WRONG = {
    "check world '1 2 3; 4 5 6; 7 8 10' --rotate 0 31 0": "world --rotate 0 31 0",
    "check view '1 2 3 4; 4 5 6 5; 7 8 10 6; 0 0 0 1' --eye 1 2 3": "view --eye 1 2 3",
    "check light '1 2 3' --space camera --light-direction 1 0 0": "light --space camera",
    "check eye '9 8 7' --space object --scale 1 2 1": "eye --space object --scale 1 2 1",
    "check normal '1 2 3; 4 5 6; 7 8 10' --scale 1 2 1 --unit": "normal --scale 1 2 1 shows",
}


@pytest.mark.parametrize("line", [*LACKING, *WRONG])
def test_a_next_step_runs_with_what_was_typed(nmatrix, line: str) -> None:
    found = nmatrix(line)
    assert found.is_one_line
    assert found.code == (2 if line in LACKING else 1)
    assert (LACKING | WRONG)[line] in found.err
    told = COMMAND.search(found.err.strip())
    assert told is not None
    again = nmatrix(told["line"])
    assert again.code in (0, 1), again.err
    assert again.out


def test_a_class_has_no_answer_beside_its_file(nmatrix) -> None:
    told = nmatrix("check --batch class.csv --scale 2").err
    assert told.endswith("try nmatrix check normal --batch class.csv --scale 2\n")


@pytest.mark.parametrize("typed", ["try nmatrix world 'x", '; try nmatrix world "', "nmatrix '"])
@pytest.mark.parametrize("line", ["world --scale {}", "normal {}", "check eye {}", "{}", "axes {}"])
def test_words_that_look_like_a_next_step_are_none(nmatrix, line: str, typed: str) -> None:
    found = nmatrix(line.format(shlex.quote(typed)))
    assert (found.code, found.is_one_line) == (2, True)


@pytest.mark.parametrize(
    "words",
    [
        ["axes", 'a "b" $c', "--json"],
        ["normal", "--scene", "my scene.toml"],
        ["normal", "--scene", "it's $5.toml"],
        ["normal", "--scene", "ünï 5.toml"],
    ],
)
def test_what_a_shell_would_part_is_quoted(words: list[str]) -> None:
    told = with_own_words(f"try nmatrix {words[0]} a b", words)
    again = shlex.split(told.partition("nmatrix ")[2])
    assert [one for one in words if one not in again] == []


@pytest.mark.parametrize(
    ("told", "words"),
    [
        ("try nmatrix axes a b", ["axes", "x" * LONGEST]),
        ("try nmatrix axes a b", ["axes", "--json", "a\nb"]),
        ("try nmatrix axes a b", ["axes", "\udcff"]),
        ("try nmatrix axes a b", ["axse", "ros"]),
        ("try nmatrix axes a b", []),
        ("try nmatrix derive rule", ["check", "normal", "1", "--scale", "2"]),
        ("nmatrix identify tells what it is", ["normal", "1", "--scale", "2"]),
        ("try nmatrix axes a b", ["axes", "p", "q"]),
    ],
)
def test_an_example_stays_where_nothing_fits_into_it(told: str, words: list[str]) -> None:
    assert with_own_words(told, words) == told
