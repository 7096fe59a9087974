"""One list of marks as pixels, SVG and PDF: images on their pixels, text as text."""

from __future__ import annotations

import re

import numpy as np
import pytest

from nmatrix.canvas.glyphs import Ink, Verdict, arrow, lamp
from nmatrix.canvas.marks import Box, Canvas, Text
from nmatrix.canvas.paint import pixels, vector
from nmatrix.canvas.slide import GUTTER, Slide
from nmatrix.canvas.text import runs
from nmatrix.canvas.theme import PALETTES
from nmatrix.enums import Theme, VectorFormat

TOLD = {"Title": "A title", "Description": "What it shows."}


def slide(size: tuple[int, int] = (800, 450), theme: Theme = Theme.LIGHT) -> Slide:
    found = Slide.of("Every title is a claim", size, theme)
    left, right = found.body(190).columns(2, GUTTER)
    a = found.panel(left, "A *n*", Verdict.WRONG, "A caption of a few words.")
    b = found.panel(right, "A^{−T} *n*", Verdict.RIGHT, "Another one.")
    arrow(found.canvas, a.stage.middle, (a.stage.x + 30, a.stage.y + 30), Ink.WRONG)
    lamp(found.canvas, b.stage.middle)
    found.compare(a, b, same=False)
    return found


@pytest.mark.parametrize("size", [(1600, 900), (801, 449), (64, 64), (333, 1000), (8192, 96)])
def test_a_picture_has_the_size_that_was_asked_for(size: tuple[int, int]) -> None:
    found = pixels(slide(size).canvas)
    assert found.shape == (size[1], size[0], 3)
    assert np.ptp(found) > 100


@pytest.mark.parametrize("scale", [1.0, 0.37, 2.5])
def test_an_image_lies_on_its_pixels_unchanged(scale: float) -> None:
    canvas = Canvas(200, 100, PALETTES[Theme.LIGHT], scale)
    box = canvas.on_pixels(Box(33.3, 21.7, 50.4, 40.2))
    wide, high = canvas.pixels_of(box)
    image = np.random.default_rng(1).integers(0, 256, (high, wide, 3), np.uint8)
    canvas.image(box, image)
    left, top = round(box.x * scale), round(box.y * scale)
    assert (pixels(canvas)[top : top + high, left : left + wide] == image).all()


def test_text_in_svg_is_text_in_its_font_and_size() -> None:
    canvas = slide().canvas
    svg = vector(canvas, VectorFormat.SVG, TOLD).decode()
    written = re.findall(r"<text[^>]*font-size: ([\d.]+)px[^>]*DejaVu Sans[^>]*>([^<]*)", svg)
    assert [text for _, text in written] == [
        run.letters for mark in canvas.marks if isinstance(mark, Text) for run in runs(mark.text)
    ]
    assert min(float(size) for size, _ in written) >= 0.68 * 20
    assert "<title>A title</title>" in svg


def test_vector_files_are_the_same_bytes_again() -> None:
    for kind in VectorFormat:
        first, second = (vector(slide().canvas, kind, TOLD) for _ in range(2))
        assert first == second
        assert len(first) > 2000


def test_a_pdf_embeds_its_fonts() -> None:
    pdf = vector(slide().canvas, VectorFormat.PDF, TOLD)
    assert pdf.startswith(b"%PDF")
    assert b"DejaVuSans" in pdf


def test_the_print_theme_is_one_channel_of_grey() -> None:
    found = pixels(slide(theme=Theme.PRINT).canvas).astype(int)
    assert np.ptp(found, axis=2).max() <= 1


def test_themes_draw_the_same_marks() -> None:
    first, *others = (
        [(type(one), getattr(one, "points", getattr(one, "loops", None))) for one in marks]
        for marks in (slide(theme=theme).canvas.marks for theme in Theme)
    )
    assert all(first == other for other in others)


@pytest.mark.parametrize("theme", [Theme.LIGHT, Theme.DARK])
def test_ideas_are_legible_on_their_stage(theme: Theme) -> None:
    palette = PALETTES[theme]

    def luminance(colour: str) -> float:
        parts = [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
        linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]
        return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]

    def contrast(name: str) -> float:
        a, b = sorted((luminance(palette.named[name]), luminance(palette.stage)))
        return (b + 0.05) / (a + 0.05)

    assert contrast("ink") > 12
    for name in ("right", "normal", "eye"):
        assert contrast(name) > 4.5, name
    assert contrast("wrong") > 3.8, "large or bold only"
    assert contrast("soft") > 4.5
