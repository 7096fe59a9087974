"""Pictures with captions: panels side by side, set in a legible font, and the files of pictures.

The font is the DejaVu Sans that matplotlib ships, found without importing matplotlib: Pillow's own
lacks ᵀ, ⁻¹ and κ.
"""

from __future__ import annotations

import io
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any, assert_never

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont, PngImagePlugin

from nmatrix.enums import PixelFormat
from nmatrix.errors import IllegalValueError

Array = NDArray[Any]

PAPER, INK, FAINT = (255, 255, 255), (24, 24, 28), (96, 96, 104)
MARGIN = 16
FRAME_MILLISECONDS = 60  # while an animation shows one
LARGEST_WEBP = 16383  # pixels on a side
IMAGE_DESCRIPTION = 0x010E  # the tag of Exif
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


def compose(
    title: str, panels: Sequence[Panel], legend: Legend | None = None, columns: int = 3
) -> Array:
    """Return panels of one size in rows under one title, as an 8-bit image."""
    height, shown = panels[0].image.shape[:2]
    grid = _Grid(max(shown, NARROWEST), height, columns=min(columns, len(panels)))
    rows = -(-len(panels) // grid.columns)
    total = (
        MARGIN + grid.columns * (grid.width + MARGIN),
        grid.top + rows * grid.pitch + (2 * grid.line if legend else 0),
    )
    sheet = Image.new("RGB", total, PAPER)
    pen = ImageDraw.Draw(sheet)
    pen.text((MARGIN, MARGIN), title, INK, _fitting(title, grid.text + 2, total[0] - 2 * MARGIN))
    for i, panel in enumerate(panels):
        left, top = grid.place(i)
        pen.text((left, top), panel.title, INK, _fitting(panel.title, grid.text, grid.width))
        picture = Image.fromarray(panel.image)
        sheet.paste(picture, (left + (grid.width - shown) // 2, top + grid.line))
        below = (left, top + grid.line + height + 6)
        pen.text(below, panel.caption, FAINT, _fitting(panel.caption, grid.text - 1, grid.width))
    if legend:
        left = total[0] - MARGIN - grid.width
        _draw_legend(pen, legend, (left, total[1] - 2 * grid.line + 4, grid.width, grid.line))
    return np.asarray(sheet)


@dataclass(frozen=True)
class _Grid:
    """The grid of panels: their width and height in pixels, and the lines of text around them."""

    width: int
    height: int
    columns: int

    @property
    def text(self) -> int:
        return max(11, min(22, self.width // 20))

    @property
    def line(self) -> int:
        return round(self.text * 1.5)

    @property
    def top(self) -> int:
        return MARGIN + 2 * self.line

    @property
    def pitch(self) -> int:
        return self.line + self.height + 2 * self.line

    def place(self, i: int) -> tuple[int, int]:
        row, column = divmod(i, self.columns)
        return MARGIN + column * (self.width + MARGIN), self.top + row * self.pitch


def png(image: Array, texts: Mapping[str, str]) -> bytes:
    """Return an image as a PNG file, with its numbers as text chunks."""
    return picture_file([image], texts, PixelFormat.PNG)


def picture_file(images: Sequence[Array], texts: Mapping[str, str], kind: PixelFormat) -> bytes:
    """Return images of one size as one file; several are an endless animation.

    Its numbers stand in the text chunks of a PNG, as JSON in the comment of a GIF or a JPEG, and as
    JSON in the Exif description of a WebP. PNG and WebP keep every level; a GIF has 256 colours.

    Raises
    ------
    IllegalValueError
        For a picture that is too large for a WebP.
    """
    height, width = images[0].shape[:2]
    if kind is PixelFormat.WEBP and max(width, height) > LARGEST_WEBP:
        raise IllegalValueError(
            f"a picture of {width} × {height} pixels",
            f"a WebP has {LARGEST_WEBP} on a side at the most",
            "end its name in .png, or draw it smaller",
        )
    first, *others = (Image.fromarray(np.ascontiguousarray(one)) for one in images)
    told = json.dumps(texts, ensure_ascii=False)
    how: dict[str, Any] = {}
    if others:
        how = {"save_all": True, "append_images": others, "duration": FRAME_MILLISECONDS, "loop": 0}
    match kind:
        case PixelFormat.PNG:
            how["pnginfo"] = chunks = PngImagePlugin.PngInfo()
            for key, value in texts.items():
                chunks.add_itxt(key, value)
        case PixelFormat.GIF:
            how["comment"] = told.encode()
        case PixelFormat.WEBP:
            exif = Image.Exif()
            exif[IMAGE_DESCRIPTION] = told
            how |= {"lossless": True, "exif": exif}
        case PixelFormat.JPEG:
            how |= {"comment": told.encode(), "quality": 95, "subsampling": 0}
        case _:
            assert_never(kind)
    out = io.BytesIO()
    first.save(out, kind.upper(), **how)
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
