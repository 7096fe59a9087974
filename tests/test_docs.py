"""The documentation runs: every transcript shows what the command prints, every doctest holds."""

from __future__ import annotations

import doctest
import re
from pathlib import Path

import pytest
import reference
import transcripts

import nmatrix
from nmatrix.lessons.check.mistakes import MISTAKES, MistakeId

DOCS = Path(__file__).parents[1] / "docs"


@pytest.mark.parametrize("page", transcripts.PAGES, ids=lambda page: page.name)
def test_transcripts_are_what_the_commands_print(page: Path) -> None:
    text = page.read_text()
    assert transcripts.filled(text) == text, "run python tests/transcripts.py"


@pytest.mark.parametrize("page", transcripts.PAGES, ids=lambda page: page.name)
def test_python_blocks_hold(page: Path) -> None:
    failed, _ = doctest.testfile(str(page), module_relative=False, optionflags=doctest.ELLIPSIS)
    assert failed == 0


@pytest.mark.parametrize("page", transcripts.PAGES, ids=lambda page: page.name)
def test_links_lead_somewhere(page: Path) -> None:
    for target in re.findall(r"\]\(([^)#:]+)\)", page.read_text()):
        assert (page.parent / target).exists(), target


@pytest.mark.parametrize("mistake", MistakeId)
def test_every_mistake_is_documented_and_counted(mistake: MistakeId) -> None:
    page = DOCS.joinpath("mistakes.md").read_text()
    told = MISTAKES[mistake]
    assert f"\n| `{mistake}` | {told.did} | `{told.command}` |\n" in page
    assert re.search(rf"\n\| `{mistake}` \| \d+ \| \d+ \| \d+ \|\n", page)


def test_a_changed_output_is_noticed() -> None:
    text = "```console\n$ nmatrix --version\nnmatrix 9.9.9\n```"
    assert transcripts.filled(text) != text


def test_sample_pages_are_what_the_commands_write(tmp_path: Path) -> None:
    pictures = re.compile(r"data:image/png;base64,[^\"]+")  # compressed alike by one zlib only
    written = transcripts.sampled(tmp_path)
    assert {page.name for page in written} == {"explorer.html", "handout-key.html", "handout.html"}
    for page in written:
        kept = (transcripts.SAMPLES / page.name).read_text()
        assert pictures.sub("", page.read_text()) == pictures.sub("", kept), (
            "run python tests/transcripts.py"
        )


def test_the_reference_is_made_of_the_docstrings_and_holds_every_public_name() -> None:
    written = reference.PAGE.read_text()
    assert written == reference.reference(), "run python tests/reference.py"
    named = re.findall(r"^### (\w+)$", written, re.MULTILINE)
    assert sorted(named) == sorted(name for name in nmatrix.__all__ if not name.startswith("_"))
