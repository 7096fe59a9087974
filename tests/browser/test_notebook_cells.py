"""What a notebook's page makes of an output: formulas, or the same as text."""

from __future__ import annotations

import re

import pytest

import nmatrix

pytestmark = pytest.mark.slow
SETUP = nmatrix.Setup(world={"scale": (1, 2, 1), "rotate": (0, 30, 0)})
NOT_ALLOWED = re.compile(r"<style>.*?</style>|</?(?:m[a-z]+|math)\b[^>]*>", re.DOTALL)


def cell(page, html: str, width: int, paper: str, ink: str) -> None:
    page.set_viewport_size({"width": width, "height": 400})
    style = f"margin: 0; background: {paper}; color: {ink}"
    page.set_content(f'<!doctype html><body style="{style}">{html}</body>')


def test_a_trusted_output_shows_formulas_and_its_text_is_hidden(blank) -> None:
    shown = SETUP.world()._repr_mimebundle_()["text/html"]
    cell(blank, shown, 700, "white", "black")
    assert blank.locator(".nmatrix").is_visible()
    assert blank.locator("math").first.is_visible()
    assert not blank.locator(".nmatrix-untrusted").is_visible()
    first, second = (blank.locator(".quantity").nth(i).bounding_box() for i in range(2))
    assert first["y"] == second["y"]
    assert first["x"] + first["width"] <= second["x"]


def test_an_output_that_is_not_trusted_shows_the_text_of_a_terminal(blank) -> None:
    shown = SETUP.world()._repr_mimebundle_()
    cell(blank, NOT_ALLOWED.sub("", shown["text/html"]), 700, "white", "black")
    assert blank.inner_text("body").strip() == shown["text/plain"].strip()


@pytest.mark.parametrize(("paper", "ink"), [("#ffffff", "#000000"), ("#111111", "#ffffff")])
def test_words_and_formulas_have_the_ink_of_the_notebook(blank, paper: str, ink: str) -> None:
    shown = SETUP.normal((1, 1, 0), steps=True)._repr_mimebundle_()["text/html"]
    cell(blank, shown, 700, paper, ink)
    found = blank.evaluate(
        "[...document.querySelectorAll('.nmatrix *')].map(one => getComputedStyle(one).color)"
    )
    red = int(ink[1:3], 16)
    assert set(found) == {f"rgb({red}, {red}, {red})"}


def test_a_narrow_cell_is_not_wider_than_its_page(blank) -> None:
    for report in (SETUP.world(), SETUP.space("object"), SETUP.trace((0, 1, 0))):
        cell(blank, report._repr_mimebundle_()["text/html"], 360, "white", "black")
        assert blank.evaluate("document.documentElement.scrollWidth") <= 360
