"""Handouts in a real browser: brackets stretch, nothing overflows, on a phone and on A4."""

from __future__ import annotations

import pytest

from nmatrix.classroom.handout import HandoutPlan, student_files
from nmatrix.classroom.topics import Topic
from nmatrix.lessons.exercises.scheme import Sheet
from nmatrix.scene.setup import Setup
from nmatrix.scene.world import World

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


def test_a_step_is_not_parted_in_print(opened, file) -> None:
    found = opened(file)
    found.emulate_media(media="print")
    for selector in (".step", "figure", ".whole"):
        avoid = found.locator(selector).first.evaluate("e => getComputedStyle(e).breakInside")
        assert avoid == "avoid"
