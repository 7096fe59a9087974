"""Handouts in a real browser: brackets stretch, nothing overflows, on a phone and on A4."""

from __future__ import annotations

import pytest

from nmatrix.canvas.theme import PALETTES
from nmatrix.classroom.handout import HandoutPlan, student_files
from nmatrix.classroom.topics import Topic
from nmatrix.enums import Theme
from nmatrix.lessons.exercises.scheme import Sheet
from nmatrix.scene.setup import Setup
from nmatrix.scene.world import World

pytestmark = pytest.mark.slow  # a browser draws by software

A4_AT_96_DPI = 794 - 2 * 68  # pixels between the margins


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    plan = HandoutPlan(tuple(Topic), Setup(World(scale=(1, 2, 1))), 10)
    path = tmp_path_factory.mktemp("handout") / "sheet.html"
    path.write_bytes(student_files(plan, Sheet("1", "Ada")).sheet)
    return path


@pytest.mark.parametrize("width", [390, A4_AT_96_DPI])
def test_no_page_is_wider_than_its_paper(opened, file, width) -> None:
    found = opened(file, viewport={"width": width, "height": 900})
    assert found.requests_made == [f"file://{file}"]
    assert found.complaints == []
    assert found.evaluate("document.documentElement.scrollWidth") <= width
    if width != 390:  # on a phone a wide formula scrolls by itself
        widest = found.evaluate(
            """() => Math.max(...[...document.querySelectorAll("math")]
                .map(m => m.scrollWidth - m.clientWidth))"""
        )
        assert widest <= 1


def test_brackets_are_as_tall_as_their_matrices(opened, file) -> None:
    found = opened(file)
    heights = found.evaluate(
        """() => [...document.querySelectorAll("math mtable")].map(table => [
            table.getBoundingClientRect().height,
            table.previousElementSibling.getBoundingClientRect().height])"""
    )
    assert len(heights) > 5
    assert all(bracket >= 0.85 * table for table, bracket in heights)


def test_nothing_that_belongs_together_is_parted_in_print(opened, file) -> None:
    found = opened(file)
    found.emulate_media(media="print")
    for selector in (".task", "figure", ".framed", ".symbols", "tr"):
        avoid = found.locator(selector).first.evaluate("e => getComputedStyle(e).breakInside")
        assert avoid == "avoid"
    for selector in ("h1", "h2", "p.leads", "caption"):
        after = found.locator(selector).first.evaluate("e => getComputedStyle(e).breakAfter")
        assert after == "avoid"


def test_a_drawing_has_the_colours_of_its_page(opened, file) -> None:
    painted = set()
    for theme, media in ((Theme.LIGHT, "screen"), (Theme.DARK, "screen"), (Theme.PRINT, "print")):
        found = opened(file, color_scheme="dark" if theme is Theme.DARK else "light")
        found.emulate_media(media=media)
        ground, ink = found.evaluate(
            """() => [getComputedStyle(document.body).backgroundColor,
                getComputedStyle(document.body).color]"""
        )
        palette = PALETTES[theme]
        assert [ground, ink] == [as_css(palette.paper), as_css(palette.ink)]
        fills = found.evaluate(
            """() => [...document.querySelectorAll("figure [role=img] svg path")]
                .map(e => getComputedStyle(e).fill)"""
        )
        assert as_css(palette.body) in fills
        painted.add(tuple(fills))
    assert len(painted) == 3


def as_css(colour: str) -> str:
    red, green, blue = (int(colour[i : i + 2], 16) for i in (1, 3, 5))
    return f"rgb({red}, {green}, {blue})"


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_the_page_fits_a_phone(opened, file, theme) -> None:
    found = opened(file, viewport={"width": 390, "height": 844}, color_scheme=theme)
    assert found.evaluate("document.documentElement.scrollWidth") <= 390


def test_the_first_page_holds_the_drawing_the_spaces_and_the_first_exercise(opened, file) -> None:
    height = (297 - 11 - 15) / 25.4 * 96
    found = opened(file, viewport={"width": A4_AT_96_DPI, "height": 1000})
    found.emulate_media(media="print")
    bottom = found.locator(".task").first.evaluate("e => e.getBoundingClientRect().bottom")
    assert bottom <= height
