"""Every command has its function, its examples and its documentation; every format the last."""

from __future__ import annotations

import re
from importlib import import_module
from pathlib import Path

import pytest
from typer.core import TyperOption

from nmatrix.cli.app import load
from nmatrix.cli.catalogue import COMMANDS, Panel
from nmatrix.cli.command import examples_and_notes
from nmatrix.enums import Format

ROOT = Path(__file__).resolve().parents[2]
DOCS = "\n".join(
    page.read_text(encoding="utf-8")
    for page in (ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md")))
)
PAGE = (ROOT / "docs" / "command-line.md").read_text(encoding="utf-8")


def options(name: str) -> list[TyperOption]:
    found = [one for one in load(name).params if isinstance(one, TyperOption)]
    return [one for one in found if "--help" not in one.opts]


@pytest.mark.parametrize("name", COMMANDS)
def test_a_command_has_a_function_and_two_or_three_examples_of_itself(name: str) -> None:
    module = import_module(f"nmatrix.cli.{COMMANDS[name].module}")
    assert getattr(module, name).__module__ == module.__name__
    examples, _ = examples_and_notes(module.HELP[name])
    assert 2 <= len(examples) <= 3
    assert any(example.startswith(f"nmatrix {name}") for example in examples)


@pytest.mark.parametrize("name", COMMANDS)
def test_a_module_has_help_for_its_commands_and_no_others(name: str) -> None:
    module = COMMANDS[name].module
    listed = {other for other, one in COMMANDS.items() if one.module == module}
    assert set(import_module(f"nmatrix.cli.{module}").HELP) == listed


@pytest.mark.parametrize("name", COMMANDS)
def test_a_command_is_documented_with_every_option(name: str) -> None:
    assert re.search(rf"nmatrix {name}\b", DOCS)
    for option in options(name):
        assert re.search(rf"{max(option.opts, key=len)}(?![\w-])", DOCS), option.opts


@pytest.mark.parametrize("panel", Panel)
def test_no_panel_of_the_overview_is_empty(panel: Panel) -> None:
    assert panel in {one.panel for one in COMMANDS.values()}


def test_every_group_of_options_has_its_row_with_each_option() -> None:
    rows = dict(re.findall(r"^\| (\w+) \| (.*) \|$", PAGE, re.MULTILINE))
    for name in COMMANDS:
        for option in options(name):
            if option.rich_help_panel is not None:
                assert f"`{max(option.opts, key=len)}" in rows[option.rich_help_panel], option.opts


@pytest.mark.parametrize("format_", Format)
def test_every_format_is_documented(format_: Format) -> None:
    assert f"\n| `{format_}` | " in PAGE.partition("## Formats")[2]
