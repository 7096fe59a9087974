"""A refusal of the parser is one line: WHAT (value): why; next step. Help begins with examples."""

from __future__ import annotations

import re

import pytest

from nmatrix.cli.catalogue import COMMANDS


@pytest.mark.parametrize(
    ("line", "what", "next_step"),
    [
        ("wrold", "command (wrold)", "did you mean world?"),
        ("xyzzy", "command (xyzzy)", "the commands are world, view"),
        ("--verison", "option (--verison)", "did you mean --version?"),
        ("-f json world", "option (-f)", "try nmatrix world -f json"),
        ("world --sacle 1 1 1", "option (--sacle)", "did you mean --scale?"),
        ("world --zzz", "option (--zzz)", "see --help"),
        ("world -f josn", "--format (josn)", "did you mean json?"),
        ("view --handed rihgt", "--handed (rihgt)", "did you mean right?"),
        ("view --handed=up", "--handed (up)", "try right"),
        ("world extra", "argument (extra)", "leave it out"),
        ("normal '1 0 0; 0 1 0; 0 0 1' more", "argument (more)", "leave it out"),
        ("identify", "MATRIX", "try nmatrix identify"),
        ("calc M --stpes", "option (--stpes)", "did you mean --steps?"),
        ("calc --stpes M", "option (--stpes)", "did you mean --steps?"),
        ("calc M -M", "option (-M)", "see --help"),
        ("--", "arguments", "see --help"),
    ],
)
def test_every_refusal_names_the_value_and_the_next_step(
    nmatrix, line: str, what: str, next_step: str
) -> None:
    code, out, err = nmatrix(line)
    assert code == 2
    assert out == ""
    assert err.startswith(f"error: {what}: ")
    assert err.count("\n") == 1
    assert f"; {next_step}" in err


@pytest.mark.parametrize("name", list(COMMANDS))
def test_the_help_of_a_command_begins_with_its_examples(nmatrix, name: str) -> None:
    code, out, _ = nmatrix(f"{name} --help")
    examples = out.partition("Usage:")[0].split("\n")
    shown = [line.strip() for line in examples if line.strip()]
    assert code == 0
    assert 2 <= len(shown) <= 3
    assert all("nmatrix " in line and "\\" not in line for line in shown)
    assert any(line.startswith(f"nmatrix {name}") for line in shown)


def test_the_overview_begins_with_examples(nmatrix) -> None:
    code, out, _ = nmatrix("--help")
    assert code == 0
    assert out.splitlines()[0] == "  nmatrix world --scale 1 2 1"
    assert out.index("nmatrix space camera") < out.index("Usage:")


@pytest.mark.parametrize("line", ["world --help --scale", "world --scale --help", "calc --help"])
def test_help_is_shown_whatever_stands_beside_it(nmatrix, line: str) -> None:
    code, out, err = nmatrix(line)
    assert (code, err) == (0, "")
    assert "Usage:" in out


@pytest.mark.parametrize(
    ("name", "panels"),
    [
        ("view", {"Options", "View", "Conventions", "Output"}),
        ("projection", {"Options", "Lens", "Conventions", "Output"}),
        ("world", {"Options", "World", "Conventions", "Output"}),
        ("inspect", {"Arguments", "Options", "Output"}),
    ],
)
def test_help_has_a_panel_for_each_group_that_the_command_takes(
    nmatrix, name: str, panels: set[str]
) -> None:
    _, out, _ = nmatrix(f"{name} --help --full")
    shown = {line for line in out.splitlines() if re.fullmatch("[A-Z][a-z]+", line)}
    assert shown - {"Scene"} == panels


@pytest.mark.parametrize("expression", ["-M", "-(1+2)", "-det(M)", "--det(M)", "-M + -M", "-.5*M"])
def test_an_expression_may_begin_with_a_minus(nmatrix, expression: str) -> None:
    for line in (f"'{expression}' --scale 1 2 1", f"--scale 1 2 1 -f text -- '{expression}'"):
        code, out, err = nmatrix(f"calc {line}")
        assert (code, err) == (0, "")
        assert out.startswith(expression)
