"""The layout of slides: type keeps its size, everything stays on the sheet at any shape."""

from __future__ import annotations

import pytest

from nmatrix.canvas.glyphs import Verdict
from nmatrix.canvas.marks import Text
from nmatrix.canvas.slide import GUTTER, Slide
from nmatrix.enums import Theme

SHAPES = [(1600, 900), (1024, 768), (1000, 1000), (900, 1600), (3000, 700), (64, 64)]


def drawn(size: tuple[int, int], title: str = "A claim that fits one line") -> Slide:
    slide = Slide.of(title, size, Theme.LIGHT)
    for box in slide.body(190).columns(4, GUTTER):
        slide.panel(box, "A^{−T} *n*", Verdict.RIGHT, "Some words of a caption that wraps here.")
    slide.large_number(slide.frame.x, slide.frame.bottom - 60, "36.9°", "off")
    return slide


@pytest.mark.parametrize("size", SHAPES)
def test_nothing_leaves_the_sheet(size: tuple[int, int]) -> None:
    slide = drawn(size)
    for mark in slide.canvas.marks:
        points = mark.box.corners if isinstance(mark, Text) else getattr(mark, "points", ())
        for x, y in points:
            assert -1e-6 <= x <= slide.canvas.width
            assert -1e-6 <= y <= slide.canvas.height


@pytest.mark.parametrize("size", SHAPES)
def test_type_keeps_its_size_and_stages_grow(size: tuple[int, int]) -> None:
    slide = drawn(size)
    assert {one.size for one in slide.canvas.marks if isinstance(one, Text)} == {44, 30, 22, 84}
    (stage,) = {slide.canvas.pixels_of(one.stage) for one in slide.panels}
    assert stage[1] >= 500 * slide.canvas.scale


@pytest.mark.parametrize("size", SHAPES)
def test_a_stage_lies_on_whole_pixels(size: tuple[int, int]) -> None:
    slide = drawn(size)
    for panel in slide.panels:
        for side in (panel.stage.x, panel.stage.y, panel.stage.right, panel.stage.bottom):
            assert side * slide.canvas.scale == pytest.approx(round(side * slide.canvas.scale))


def test_a_long_title_shrinks_to_36_and_no_further() -> None:
    slide = drawn(
        (1600, 900),
        "A claim of more words than there is room for at its full size, and yet some more",
    )
    (title,) = (one for one in slide.canvas.marks if isinstance(one, Text) and one.size < 44
                and one.bold and one.size > 30)  # fmt: skip
    assert title.size == 36


def test_a_panel_is_told_in_one_line() -> None:
    slide = drawn((1600, 900))
    assert slide.told[0] == "A claim that fits one line"
    assert slide.told[1] == "✓ A⁻ᵀ n: Some words of a caption that wraps here."
