"""The layout of slides: type keeps its size, everything stays on the sheet at any shape."""

from __future__ import annotations

import pytest

from nmatrix.canvas.glyphs import Verdict
from nmatrix.canvas.marks import Box, Polygon, Text
from nmatrix.canvas.slide import GUTTER, Row, Slide
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


def test_a_table_has_a_verdict_for_each_row_and_a_heading_for_each_column() -> None:
    slide = Slide.of("Rows", (1600, 900), Theme.LIGHT)
    rows = [Row("stuck", Verdict.WRONG, "it turns"), Row("right", Verdict.RIGHT, "it stays")]
    cells = slide.table(slide.body(80), rows, ["before", "after"], undecided=1)
    assert [[one.verdict for one in row] for row in cells] == [
        [None, Verdict.WRONG],
        [None, Verdict.RIGHT],
    ]
    assert cells[1][1].told == "✓ right, after"
    assert slide.panels == [*cells[0], *cells[1]]
    for row in cells:
        assert len({one.stage.y for one in row}) == 1
    for column in zip(*cells, strict=True):
        assert len({one.stage.x for one in column}) == 1
    headings = [one.text for one in slide.canvas.marks if isinstance(one, Text)]
    assert {"before", "after", "stuck", "right"} <= set(headings)


def test_a_caption_may_be_written_after_its_panel() -> None:
    slide = Slide.of("Later", (1600, 900), Theme.LIGHT)
    first = slide.panel(slide.body(190), "A panel")
    second = slide.captioned(first, "What is so.")
    assert slide.panels == [second]
    assert second.told == "A panel: What is so."


def test_an_equals_sign_stands_between_its_panels_and_on_no_heading() -> None:
    slide = Slide.of("A claim", (1600, 900), Theme.LIGHT)
    upper, lower = slide.body(90).rows(2, 62)
    left, right = (slide.panel(box, "standard") for box in upper.columns(2, GUTTER))
    below = slide.panel(lower.columns(2, GUTTER)[0], "reversed")
    slide.compare(left, right, same=True)
    beside = ring_of(slide)
    assert beside.middle == pytest.approx(
        ((left.stage.right + right.stage.x) / 2, left.stage.middle[1])
    )
    slide.compare(left, below, same=True)
    stacked = ring_of(slide)
    assert left.stage.bottom < stacked.middle[1] < below.stage.y
    heading = next(
        one for one in slide.canvas.marks if isinstance(one, Text) and one.text == "reversed"
    )
    assert stacked.x > heading.box.right
    assert slide.same == [(left, right), (left, below)]


def ring_of(slide: Slide) -> Box:
    """Return the box of the last ring that was drawn."""
    *_, ring = (one for one in slide.canvas.marks if isinstance(one, Polygon))
    x, y = zip(*ring.loops[0], strict=True)
    return Box(min(x), min(y), max(x) - min(x), max(y) - min(y))
