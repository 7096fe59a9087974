"""Pictures with captions: panels side by side, set in a legible font, written as PNG.

The font is the DejaVu Sans that matplotlib ships, found without importing matplotlib: Pillow's own
lacks ᵀ, ⁻¹ and κ.
"""

from __future__ import annotations

import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont, PngImagePlugin

Array = NDArray[Any]

PAPER, INK, FAINT = (255, 255, 255), (24, 24, 28), (96, 96, 104)
MARGIN = 16
NARROWEST = 220  # pixels for a panel's captions to be legible in


@dataclass(frozen=True, eq=False)
class Panel:
    """One picture with a title above and a line below."""

    image: Array
    title: str
    caption: str


@dataclass(frozen=True)
class Legend:
    """A scale of colours from 0 to a largest value."""

    colours: tuple[tuple[int, int, int], ...]
    largest: str
    unit: str


def levels(image: Array) -> Array:
    """Return an image in [0, 1] as 8-bit levels."""
    return np.asarray(np.rint(np.clip(image, 0.0, 1.0) * 255).astype(np.uint8))


def compose(title: str, panels: Sequence[Panel], legend: Legend | None = None) -> Array:
    """Return panels of one size side by side under one title, as an 8-bit image."""
    height, shown = panels[0].image.shape[:2]
    width = max(shown, NARROWEST)
    text = max(11, min(22, width // 20))
    line = round(text * 1.5)
    top = MARGIN + 2 * line
    total = (
        MARGIN + len(panels) * (width + MARGIN),
        top + line + height + 2 * line + (2 * line if legend else 0),
    )
    sheet = Image.new("RGB", total, PAPER)
    pen = ImageDraw.Draw(sheet)
    pen.text((MARGIN, MARGIN), title, INK, _fitting(title, text + 2, total[0] - 2 * MARGIN))
    for i, panel in enumerate(panels):
        left = MARGIN + i * (width + MARGIN)
        pen.text((left, top), panel.title, INK, _fitting(panel.title, text, width))
        sheet.paste(Image.fromarray(panel.image), (left + (width - shown) // 2, top + line))
        below = (left, top + line + height + 6)
        pen.text(below, panel.caption, FAINT, _fitting(panel.caption, text - 1, width))
    if legend:
        _draw_legend(pen, legend, (total[0] - MARGIN - width, total[1] - 2 * line + 4, width, line))
    return np.asarray(sheet)


def png(image: Array, texts: Mapping[str, str]) -> bytes:
    """Return an image as PNG bytes, with its numbers as text chunks."""
    chunks = PngImagePlugin.PngInfo()
    for key, value in texts.items():
        chunks.add_itxt(key, value)
    out = io.BytesIO()
    Image.fromarray(image).save(out, format="PNG", pnginfo=chunks)
    return out.getvalue()


def _draw_legend(pen: ImageDraw.ImageDraw, legend: Legend, box: tuple[int, int, int, int]) -> None:
    left, top, width, line = box
    bar = line // 2
    for x in range(width):
        colour = legend.colours[x * (len(legend.colours) - 1) // max(width - 1, 1)]
        pen.line([(left + x, top), (left + x, top + bar)], colour)
    font = _font(max(10, line // 2))
    pen.text((left, top + bar + 2), f"0{legend.unit}", FAINT, font)
    right = f"{legend.largest}{legend.unit}"
    pen.text((left + width - pen.textlength(right, font), top + bar + 2), right, FAINT, font)


def _fitting(text: str, size: int, width: int) -> ImageFont.FreeTypeFont | ImageFont.ImageFont:
    """Return the font in the largest size up to `size` in which the text fits."""
    while size > 8 and _font(size).getlength(text) > width:
        size -= 1
    return _font(size)


@cache
def _font(size: int) -> ImageFont.FreeTypeFont | ImageFont.ImageFont:
    spec = find_spec("matplotlib")
    if spec is None or spec.origin is None:
        return ImageFont.load_default(size)
    file = Path(spec.origin).parent / "mpl-data" / "fonts" / "ttf" / "DejaVuSans.ttf"
    return ImageFont.truetype(file, size) if file.is_file() else ImageFont.load_default(size)
