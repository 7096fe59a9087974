"""Shaders of many dialects and habits of naming: every fault on its line, and no false alarm."""

from __future__ import annotations

import re

import pytest
from shader_programs import CORRECT, FAULTY

from nmatrix.enums import Severity
from nmatrix.linting.program import lint

MARK = re.compile(r"//.*\b(NM\d{3})\b")


def told(program: dict[str, str]) -> set[tuple[str, int, str]]:
    """Lint a program; its findings but notes, by their lines."""
    faults = lint({name: text.encode() for name, text in program.items()}).faults
    return {
        (one.span.file, program[one.span.file][: one.span.start].count("\n") + 1, one.rule.value)
        for one in faults
        if one.severity is not Severity.NOTE
    }


def test_there_are_enough() -> None:
    assert len(FAULTY) >= 40
    assert len(CORRECT) >= 40


@pytest.mark.parametrize("name", FAULTY)
def test_every_fault_is_told_on_its_line_and_nothing_else(name: str) -> None:
    program = FAULTY[name]
    marked = {
        (file, number, mark[1])
        for file, text in program.items()
        for number, line in enumerate(text.splitlines(), 1)
        if (mark := MARK.search(line))
    }
    assert marked
    assert told(program) == marked


@pytest.mark.parametrize("name", CORRECT)
def test_nothing_is_told_of_a_correct_shader(name: str) -> None:
    assert told(CORRECT[name]) == set()
