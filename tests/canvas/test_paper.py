"""Slides on paper: nothing in them is lost or too small, and the words around them are told."""

from __future__ import annotations

import pytest

from nmatrix.canvas.glyphs import Verdict
from nmatrix.canvas.marks import Box, Polygon, Raster, Stroke, Text
from nmatrix.canvas.paper import LEAST_POINTS, on_paper
from nmatrix.canvas.slide import CAPTION, Slide
from nmatrix.enums import Theme

POINTS = 493.0


def slide_of(columns: int, size: tuple[int, int] = (1600, 900)) -> Slide:
    import numpy as np

    slide = Slide.of("The claim", size, Theme.PRINT)
    for i, box in enumerate(slide.body(200).columns(columns, 20)):
        panel = slide.panel(box, f"Panel {i}", Verdict.RIGHT, caption=f"What is seen in {i}.")
        canvas, stage = slide.canvas, panel.stage
        canvas.stroke((stage.corners[0], stage.corners[2]), 4, slide.palette.ink)
        canvas.text(stage.middle, "small", CAPTION)
        inside = canvas.on_pixels(stage.inset(20))
        wide, high = canvas.pixels_of(inside)
        canvas.image(inside, np.zeros((high, wide, 3), np.uint8))
    slide.large_number(
        slide.frame.x, slide.frame.bottom - 60, "36°", "off, and more words than fit"
    )
    return slide


@pytest.mark.parametrize("columns", [1, 3, 5])
@pytest.mark.parametrize("size", [(1600, 900), (2400, 1350), (1000, 1000)])
def test_no_letter_on_paper_is_under_eight_points(columns: int, size: tuple[int, int]) -> None:
    canvas = on_paper(slide_of(columns, size), POINTS).canvas
    sizes = [mark.size for mark in canvas.marks if isinstance(mark, Text)]
    assert len(sizes) == 2 * columns
    assert min(sizes) * POINTS / canvas.width >= LEAST_POINTS - 1e-9


def test_captions_become_words_and_stages_fill_the_width() -> None:
    slide = slide_of(3)
    cutting = on_paper(slide, POINTS)
    canvas = cutting.canvas
    assert cutting.words == "What is seen in 0. What is seen in 1. What is seen in 2."
    shown = {mark.text for mark in canvas.marks if isinstance(mark, Text)}
    assert shown == {"Panel 0", "Panel 1", "Panel 2", "small"}
    images = [mark.box for mark in canvas.marks if isinstance(mark, Raster)]
    assert len(images) == 3
    polygons = [mark for mark in canvas.marks if isinstance(mark, Polygon)]
    assert min(x for one in polygons for x, _ in one.loops[0]) == pytest.approx(0, abs=1)
    assert max(x for one in polygons for x, _ in one.loops[0]) == pytest.approx(canvas.width, abs=1)


def test_what_is_kept_keeps_its_place_on_its_stage() -> None:
    slide = slide_of(2)
    before = [mark for mark in slide.canvas.marks if isinstance(mark, Stroke)]
    canvas = on_paper(slide, POINTS).canvas
    after = [mark for mark in canvas.marks if isinstance(mark, Stroke)]
    shifts = {
        (round(a[0] - b[0], 6), round(a[1] - b[1], 6))
        for one, other in zip(before, after, strict=True)
        for a, b in zip(one.points, other.points, strict=True)
    }
    assert len(shifts) == 1
    page = Box(0, 0, canvas.width, canvas.height)
    assert all(page.holds(point) for one in after for point in one.points)
    loops = [loop for one in canvas.marks if isinstance(one, Polygon) for loop in one.loops]
    assert all(page.inset(-1).holds(point) for loop in loops for point in loop)
