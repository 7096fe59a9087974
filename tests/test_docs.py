"""The documentation runs: every transcript shows what the command prints, every doctest holds."""

from __future__ import annotations

import doctest
import re
import tomllib
from pathlib import Path

import numpy as np
import pytest
import reference
import transcripts
from PIL import Image

import nmatrix
from nmatrix.calculator.functions import FUNCTIONS
from nmatrix.lessons.check.mistake import MistakeId
from nmatrix.lessons.check.mistakes import MISTAKES
from nmatrix.raster.proofs.catalogue import PROOFS

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


@pytest.mark.parametrize("proof", [one.name for one in PROOFS])
def test_pictures_are_what_the_proofs_draw(proof: str) -> None:
    drawn = transcripts.picture(proof).image
    with Image.open(transcripts.PICTURES / f"{proof}.png") as kept:
        assert kept.size == drawn.shape[1::-1], "run python tests/transcripts.py"
        apart = np.abs(np.asarray(kept).astype(int) - drawn).max(axis=2)
    assert (apart > 2).mean() < 0.001, "run python tests/transcripts.py"


def test_each_example_scene_is_drawn_wrongly_by_the_rule_beside_it() -> None:
    text = (DOCS / "scenes.md").read_text()
    rows = re.findall(r"^\| \[(\w+\.toml)\]\(.*\| (nothing by )?`([\w-]+)` \|$", text, re.MULTILINE)
    assert {file for file, _, _ in rows} == {one.name for one in (DOCS / "scenes").glob("*.toml")}
    for file, harmless, rule in rows:
        found = nmatrix.render(DOCS / "scenes" / file, size=(160, 120), samples=1, normals=rule)
        worst, difference = found.data["max_angle_error_deg"], found.data["max_level_difference"]
        assert found.data["mean_angle_error_deg"] < worst
        assert (worst < 1e-6 and difference == 0) if harmless else (worst > 20 and difference > 50)


@pytest.mark.parametrize("mistake", MistakeId)
def test_every_mistake_is_documented_and_counted(mistake: MistakeId) -> None:
    page = DOCS.joinpath("mistakes.md").read_text()
    told = MISTAKES[mistake]
    assert f"\n| `{mistake}` | {told.did} | `{told.command}` |\n" in page
    assert re.search(rf"\n\| `{mistake}` \| \d+ \| \d+ \| \d+ \| .*\|\n", page)


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


def test_the_page_of_functions_is_made_of_their_records_and_holds_all() -> None:
    assert reference.FUNCTIONS_PAGE.read_text() == reference.functions(), (
        "run python tests/reference.py"
    )
    families = [name for family in reference.FAMILIES.values() for name in family.FUNCTIONS]
    assert sorted(families) == sorted(FUNCTIONS)


def test_the_reference_is_made_of_the_docstrings_and_holds_every_public_name() -> None:
    written = reference.PAGE.read_text()
    assert written == reference.reference(), "run python tests/reference.py"
    named = re.findall(r"^### (\w+)$", written, re.MULTILINE)
    assert sorted(named) == sorted(name for name in nmatrix.__all__ if not name.startswith("_"))


def test_the_citation_says_what_the_project_says() -> None:
    project = tomllib.loads((DOCS.parent / "pyproject.toml").read_text())["project"]
    cited = (DOCS.parent / "CITATION.cff").read_text()
    assert re.findall(r"^version: (.*)$", cited, re.MULTILINE) == [nmatrix.__version__]
    listed = re.findall(r"^  - (?:name: )?(.*)$", cited, re.MULTILINE)
    authors = [one["name"] for one in project["authors"]]
    assert listed == [*project["license"].split(" AND "), *authors, *project["keywords"]]
    abstract = " ".join(cited.partition("abstract: >-")[2].partition("type:")[0].split())
    assert abstract == project["description"]
