"""The documentation as a site: whole, linked, described, offline, and true."""

from __future__ import annotations

import re
from functools import cache
from html import unescape
from pathlib import Path
from urllib.parse import unquote, urldefrag

import pytest
import transcripts
from lxml import etree, html
from symptoms import MISTAKES, RULES

import nmatrix as package
from nmatrix.cli.app import load
from nmatrix.cli.catalogue import COMMANDS
from nmatrix.lessons.check.mistake import MistakeId
from nmatrix.lessons.check.mistakes import MISTAKES as TOLD
from nmatrix.linting.rules import RuleId
from nmatrix.raster.proofs.catalogue import PROOFS

pytestmark = pytest.mark.slow
MADE_BY_SPHINX = {"genindex.html", "search.html"}
APART = ("samples/", "try/", "_static/")  # pages with tests of their own
LOADS = {"img": "src", "script": "src", "link": "href", "source": "src", "iframe": "src"}
FOREIGN = re.compile(r"(?:https?:)?//", re.IGNORECASE)
SHORTEST, LONGEST = 40, 160  # characters of a description
# What measures, draws for long, or writes into a folder of its own, is run by the build alone.
LONG = ("cost", "render", "handout", "stress", "web")


@cache
def page(path: Path) -> etree._Element:
    return html.fromstring(path.read_bytes(), parser=html.HTMLParser(encoding="utf-8"))


def pages(site: Path) -> dict[str, etree._Element]:
    """Return the pages of the documentation by their names."""
    found = {one.relative_to(site).as_posix(): one for one in sorted(site.rglob("*.html"))}
    return {name: page(one) for name, one in found.items() if not name.startswith(APART)}


@cache
def anchors(path: Path) -> set[str]:
    return set(page(path).xpath("//@id")) | set(page(path).xpath("//a/@name"))


def text(site: Path, name: str) -> str:
    return page(site / name).xpath("//article")[0].text_content()


def printed(site: Path, name: str) -> list[str]:
    """Return the transcripts of a page."""
    blocks = page(site / name).xpath("//article//div[contains(@class, 'highlight-console')]")
    return [block.text_content().strip("\n") for block in blocks]


def test_every_link_and_every_anchor_leads_somewhere(site: Path) -> None:
    for name, one in pages(site).items():
        for link in [*one.xpath("//@href"), *one.xpath("//@src")]:
            target, anchor = urldefrag(link)
            target = target.partition("?")[0]
            if re.match(r"[a-z]+:", target):
                continue
            found = ((site / name).parent / unquote(target)).resolve() if target else site / name
            assert found.is_file(), (name, link)
            if anchor and found.suffix == ".html":
                assert unquote(anchor) in anchors(found), (name, link)


def test_nothing_is_loaded_from_elsewhere(site: Path) -> None:
    for name, one in pages(site).items():
        for tag, attribute in LOADS.items():
            for loaded in one.xpath(f"//{tag}/@{attribute}"):
                assert not FOREIGN.match(loaded), (name, loaded)
    for style in site.rglob("*.css"):
        loaded = re.findall(r"url\(\s*['\"]?([^)'\"]+)|@import\s+['\"]([^'\"]+)", style.read_text())
        assert not [one for one in loaded if FOREIGN.match("".join(one))], style


def test_every_page_has_a_title_a_description_and_one_heading(site: Path) -> None:
    titles: dict[str, str] = {}
    for name, one in pages(site).items():
        title = one.findtext(".//title")
        assert title, name
        assert title not in titles, (name, titles[title])
        titles[title] = name
        if name in MADE_BY_SPHINX:
            continue
        (description,) = one.xpath("//meta[@name='description']/@content")
        assert SHORTEST <= len(description) <= LONGEST, (name, description)
        assert len(one.xpath("//h1")) == 1, name


def test_no_page_has_the_same_id_twice(site: Path) -> None:
    for name, one in pages(site).items():
        ids = one.xpath("//@id")
        assert sorted(set(ids)) == sorted(ids), name


def test_pictures_have_words(site: Path) -> None:
    for name, one in pages(site).items():
        for picture in one.xpath("//article//img"):
            assert len(picture.get("alt", "")) > 10, name


def test_every_page_is_reached_from_the_contents_and_leads_on(site: Path) -> None:
    contents = page(site / "index.html").xpath("//*[@class='sidebar-tree']//a/@href")
    for name, one in pages(site).items():
        if name in MADE_BY_SPHINX or name == "index.html":
            continue
        assert name in contents, name
        assert one.xpath("//link[@rel='prev']/@href"), name
    assert sum(not one.xpath("//link[@rel='next']") for one in pages(site).values()) == 3


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_has_a_page_with_all_of_its_options(command: str, site: Path) -> None:
    one = page(site / f"commands/{command}.html")
    heading = one.xpath("string(//h1)")
    assert heading.startswith(f"nmatrix {command}: "), heading
    ids = anchors(site / f"commands/{command}.html")
    for parameter in load(command).params:
        names = [option for option in parameter.opts if option.startswith("--")]
        for option in names:
            assert f"cmdoption-nmatrix-{command}-{option.lstrip('-')}" in ids
            assert f"{parameter.help or ''}"[:30] in text(site, f"commands/{command}.html")


@pytest.mark.parametrize("command", COMMANDS)
def test_the_examples_of_a_command_are_what_it_prints(command: str, site: Path, tmp_path) -> None:
    shown = printed(site, f"commands/{command}.html")
    examples = load(command).examples
    assert [one.splitlines()[0].removeprefix("$ ") for one in shown] == list(examples[: len(shown)])
    assert len(shown) == len(examples) or command == "cost"
    if command not in LONG:
        first = shown[0].partition("\n")[2]
        assert transcripts.output(examples[0], tmp_path).strip("\n") == first


@pytest.mark.parametrize("mistake", MistakeId)
def test_every_mistake_has_a_page_on_which_check_names_it(mistake: MistakeId, site: Path) -> None:
    name = f"mistakes/{mistake}.html"
    words = " ".join(text(site, name).split())
    assert f"Mistake: {mistake}" in " ".join(printed(site, name)[0].split())
    for told in (TOLD[mistake].did, TOLD[mistake].rule, *MISTAKES[mistake].searched):
        assert " ".join(told.split()) in words, told
    keywords = page(site / name).xpath("string(//meta[@name='keywords']/@content)")
    assert mistake in keywords.split(", ")
    links = page(site / "mistakes.html").xpath("//article//table//a/@href")
    assert name in links


@pytest.mark.parametrize("rule", RuleId)
def test_every_rule_has_a_page_with_the_words_that_are_searched(rule: RuleId, site: Path) -> None:
    name = f"lint/{rule.value}.html"
    for words in RULES[rule]:
        assert words in text(site, name)
    assert page(site / name).xpath("//meta[@name='keywords']")


@pytest.mark.parametrize("proof", [one.name for one in PROOFS])
def test_every_proof_has_its_place_in_the_gallery(proof: str, site: Path) -> None:
    assert proof in anchors(site / "gallery.html")
    pictures = page(site / "gallery.html").xpath("//article//img/@src")
    assert f"_images/{proof}.png" in pictures


@pytest.mark.parametrize("name", [one for one in package.__all__ if not one.startswith("_")])
def test_every_public_name_has_an_anchor_of_its_own(name: str, site: Path) -> None:
    headings = page(site / "reference.html").xpath("//article//section[h3]")
    found = [one.get("id") for one in headings if one.findtext("h3") == name]
    assert len(found) == 1, name
    own = name.replace("_", "-").lower()
    assert (f"class-{own}" if name[0].isupper() else own) in anchors(site / "reference.html")


def test_the_citation_is_that_of_the_file(site: Path) -> None:
    words = text(site, "cite.html")
    assert f"Version {package.__version__}" in words
    assert "@software{nmatrix" in words


def test_the_front_page_tries_the_program_or_tells_how(site: Path) -> None:
    one = page(site / "index.html")
    has_web = (site / "try" / "index.html").is_file()
    assert bool(one.xpath("//a[@href='try/index.html']")) is has_web
    assert has_web or "nmatrix web -o" in unescape(text(site, "index.html"))
