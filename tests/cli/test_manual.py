"""The manual page says what the help pages say."""

from __future__ import annotations

import re
import shutil
import subprocess
from datetime import date

import manual
import pytest
from typer.core import TyperOption

from nmatrix.cli import help as pages
from nmatrix.cli.app import load
from nmatrix.cli.catalogue import COMMANDS
from nmatrix.version import __version__

MANDOC = shutil.which("mandoc")
with_mandoc = pytest.mark.skipif(MANDOC is None, reason="it needs mandoc")


@pytest.fixture(scope="module")
def page() -> str:
    return manual.PAGE.read_text("ascii")


@pytest.fixture(scope="module")
def shown() -> str:
    """The page as a reader sees it, on 80 columns, without bold."""
    command = ["mandoc", "-T", "utf8", "-O", "width=80", str(manual.PAGE)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    return re.sub(".\b", "", done.stdout)


def test_the_page_is_the_one_that_the_commands_make(page: str) -> None:
    day = manual.day_of(page)
    assert page == manual.manual(day), "run python tests/manual.py"
    assert date.fromisoformat(day).isoformat() == day
    assert f'"nmatrix {__version__}"' in page.splitlines()[0]


@with_mandoc
def test_the_page_has_no_fault_that_mandoc_knows() -> None:
    done = subprocess.run(
        ["mandoc", "-T", "lint", "-W", "style", str(manual.PAGE)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.stdout, done.returncode) == ("", 0)


@with_mandoc
@pytest.mark.parametrize("name", COMMANDS)
def test_a_reader_sees_every_option_every_sentence_and_every_example(name: str, shown: str) -> None:
    command = load(name)
    told = " ".join(shown.split())
    assert " ".join((command.help or "").split()) in told.replace(".  ", ". ")
    for one in command.params:
        if isinstance(one, TyperOption):
            assert pages.as_typed(one) in shown
        assert " ".join(pages.description_of(one).split()) in told
    for example in command.examples:
        assert " ".join(example.split()) in told.replace("\\ ", "")


@with_mandoc
def test_a_terminal_of_80_columns_shows_it_whole(shown: str) -> None:
    assert max(map(len, shown.splitlines())) <= 80


def test_every_variable_that_the_program_reads_is_told(page: str) -> None:
    read = {
        name
        for path in (manual.PAGE.parents[1] / "nmatrix").rglob("*.py")
        for name in re.findall(r"\bNMATRIX_[A-Z]+", path.read_text("utf-8"))
    }
    assert {one for one in read if one not in page} == set()


def test_no_text_is_taken_for_an_order() -> None:
    assert manual.plain(".5 and 'a' - \\n ~ ^") == r"\&.5 and \(aqa\(aq \- \en \(ti \(ha"
    assert manual.plain("κ −") == r"\[u03BA] \[u2212]"
    assert manual.prose(". . . end") == [r"\&. . . end"]


def test_the_page_changes_its_day_only_with_its_words() -> None:
    assert manual.day_of(manual.manual("2001-02-03")) == "2001-02-03"
