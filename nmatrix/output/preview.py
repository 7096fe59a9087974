"""A picture in the terminal, as large as it can be read there.

Where the terminal takes pictures, it gets the picture. Elsewhere two pixels stand in a character,
and the words of a proof, which no such pixels can spell, are written over its stages.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import product, zip_longest
from math import hypot
from textwrap import wrap
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from nmatrix.canvas.glyphs import Verdict
from nmatrix.canvas.marks import SMALLEST_TEXT, Box, Text
from nmatrix.canvas.slide import Panel, Slide
from nmatrix.canvas.text import plain as marked_down
from nmatrix.output.inline_images import inline_image
from nmatrix.output.style import RESET, plain, render, spelled
from nmatrix.output.terminal import Colours, Drawing, Screen
from nmatrix.output.write import Colour

Array = NDArray[Any]

RAMP = " .:-=+*#%@"
_LEVELS = (0, 95, 135, 175, 215, 255)
FIRST_OF_PALETTE = 16  # the first sixteen colours are the theme's
PALETTE = (*product(_LEVELS, repeat=3), *((shade,) * 3 for shade in range(8, 248, 10)))
HUE_FIRST = (1.0, 1.4, 1.4)  # weights: another shade is a smaller mistake than another hue
NARROWEST = 34  # columns in which a part can be read
GAP = 2
LEFT_FREE = 2  # lines of the terminal: its prompt
VERDICTS = {Verdict.WRONG: "✗", Verdict.RIGHT: "✓"}
LEGIBLE = 0.6  # of its size: smaller, the captions of a picture are no longer read


Paragraph = list[Text]


@dataclass(frozen=True, eq=False)
class Part:
    """A part of a picture, 8-bit (height, width, 3), and the words that belong to it."""

    image: Array
    words: str


def parts_of(slide: Slide, image: Array) -> tuple[Part, ...]:
    """Cut the stages out of the image of a slide, each with the words that stand nearest to it."""
    k, stages = slide.canvas.scale, [one.stage for one in slide.panels]
    beside: list[list[Paragraph]] = [[] for _ in stages]
    for one in _paragraphs(slide):
        away = [_distance(stage, one[0].box) for stage in stages]
        if min(away, default=0.0) > 0.0:  # else it stands on a stage, and is part of it
            beside[away.index(min(away))].append(one)
    found = []
    for panel, paragraphs in zip(slide.panels, beside, strict=True):
        left, top, right, bottom = (
            round(k * side)
            for side in (panel.stage.x, panel.stage.y, panel.stage.right, panel.stage.bottom)
        )
        found.append(Part(image[top:bottom, left:right], _told(panel, paragraphs)))
    return tuple(found)


def _paragraphs(slide: Slide) -> list[Paragraph]:
    """Gather the lines of text that go on from one another; ticks and the title are no words."""
    found: list[Paragraph] = []
    for mark in slide.canvas.marks:
        if isinstance(mark, Text) and mark.text != slide.title and mark.size > SMALLEST_TEXT:
            if found and _goes_on(found[-1][-1], mark):
                found[-1].append(mark)
            else:
                found.append([mark])
    return found


def _goes_on(last: Text, text: Text) -> bool:
    """Tell whether a text is the next line of the one before it, or stands right behind it."""
    (x, y), (left, level) = text.place, last.place
    is_below = x == left and text.size == last.size and 0 < y - level < 1.5 * text.size
    return is_below or (y == level and 0 < x - last.box.right < text.size)


def _distance(stage: Box, text: Box) -> float:
    """Return the distance between a text and a stage, 0 where it stands on it."""
    aside = max(stage.x - text.right, text.x - stage.right, 0.0)
    return hypot(aside, max(stage.y - text.bottom, text.y - stage.bottom, 0.0))


def _told(panel: Panel, paragraphs: Sequence[Paragraph]) -> str:
    """Write what stands above a stage in one line, and each paragraph below it in another."""
    heading = marked_down(panel.heading)
    above: list[str] = []
    below: list[str] = []
    for one in sorted(paragraphs, key=lambda one: (one[0].place[1], one[0].place[0])):
        text = " ".join(marked_down(line.text) for line in one)
        if text not in heading:  # of a table it says the row and the column
            (above if one[0].place[1] < panel.stage.y else below).append(text)
    mark = "" if panel.verdict is None else f"{VERDICTS[panel.verdict]} "
    first = ": ".join(filter(None, (*above, f"{mark}{heading}".strip())))
    return "\n".join((first, *below)).strip()


def preview(image: Array, parts: Sequence[Part], screen: Screen) -> str:
    """Draw an 8-bit image (height, width, 3), or its parts where it could not be read.

    Examples
    --------
    >>> print(preview(np.zeros((4, 2, 3), np.uint8), (), Screen(2, 24, Drawing.CHARACTERS)), end="")
    @@
    @@
    """
    if not screen.drawing.has_pixels:
        return "".join(_rows(parts or (Part(image, ""),), screen))
    height, width = image.shape[:2]
    cells = _cells(image, min(screen.columns, -(-width // screen.cell[0])), screen)
    shown = cells[0] * screen.cell[0]
    picture = Image.fromarray(image)
    if shown < width:
        picture = picture.resize((shown, round(height / width * shown)), Image.Resampling.LANCZOS)
    lines = [f"{spelled(one.words, screen.charset)}\n" for one in parts]
    words = "".join(lines) if shown < LEGIBLE * width else ""
    return f"{words}{inline_image(picture, cells, screen.drawing)}\n"


def _cells(image: Array, columns: int, screen: Screen) -> tuple[int, int]:
    """Return the columns and lines of an image at most so wide, and no higher than the screen."""
    height, width = image.shape[:2]
    shape = height / width * screen.cell[0] / screen.cell[1]  # lines for a column
    most = max(screen.lines - LEFT_FREE, 1)
    columns = max(1, min(columns, int(most / shape)))
    return columns, min(max(1, round(shape * columns)), most)


def _rows(parts: Sequence[Part], screen: Screen) -> Iterator[str]:
    """Draw parts in rows, as many side by side as can be read."""
    room = max(1, (screen.columns + GAP) // (NARROWEST + GAP))
    rows = -(-len(parts) // room)
    across = -(-len(parts) // rows)
    width = (screen.columns - GAP * (across - 1)) // across
    for first in range(0, len(parts), across):
        row = parts[first : first + across]
        if first:
            yield "\n"
        yield from _beside([_wrapped(one.words, width, screen) for one in row], width)
        yield from _beside([list(_drawn(one.image, width, screen)) for one in row], width)


Cell = tuple[str, int]  # a line of a part, and the columns that it takes


def _beside(columns: Sequence[Sequence[Cell]], width: int) -> Iterator[str]:
    """Set columns of lines side by side."""
    for lines in zip_longest(*columns, fillvalue=("", 0)):
        yield (" " * GAP).join(
            text + " " * (width - taken) for text, taken in lines
        ).rstrip() + "\n"


def _wrapped(words: str, width: int, screen: Screen) -> list[Cell]:
    colour = Colour.PLAIN if screen.drawing is Drawing.CHARACTERS else Colour.ANSI
    text = spelled(words, screen.charset)
    lines = [line for paragraph in text.splitlines() for line in wrap(paragraph, width)]
    return [(render(plain(line), colour), len(line)) for line in lines]


def _drawn(image: Array, width: int, screen: Screen) -> Iterator[Cell]:
    """Draw one image in lines of at most so many characters."""
    columns, lines = _cells(image, min(width, image.shape[1]), screen)
    if screen.drawing is Drawing.CHARACTERS:
        for row in np.asarray(_resized(image, columns, lines)):
            yield _ramp(row), columns
        return
    codes = _codes(_resized(image, columns, 2 * lines), screen.colours)
    for upper, lower in zip(codes[::2], codes[1::2], strict=True):
        yield _halves(upper, lower), columns


def _resized(image: Array, columns: int, rows: int) -> Image.Image:
    return Image.fromarray(image).resize((columns, rows), Image.Resampling.HAMMING)


def _halves(upper: Sequence[str], lower: Sequence[str]) -> str:
    """Draw two rows of colours in one line; a colour that stays is not said again."""
    said, line = ("", ""), []
    for now in zip(upper, lower, strict=True):
        for plane, colour, before in zip((38, 48), now, said, strict=True):
            if colour != before:
                line.append(f"\x1b[{plane};{colour}m")
        line.append("▀")
        said = now
    return "".join(line) + RESET


def _codes(image: Image.Image, colours: Colours) -> list[list[str]]:
    """Spell each pixel as the terminal is told its colour, the nearest that it has."""
    if colours is Colours.ALL:
        rows = np.asarray(image).tolist()
        return [["2;{};{};{}".format(*pixel) for pixel in row] for row in rows]
    palette = Image.fromarray(np.array([PALETTE], np.uint8))
    (there,), here = (np.asarray(p.convert("YCbCr"), float) * HUE_FIRST for p in (palette, image))
    apart = (there * there).sum(
        axis=1
    ) - 2 * here @ there.T  # and the square of here, for all alike
    return [[f"5;{FIRST_OF_PALETTE + one}" for one in row] for row in apart.argmin(axis=2).tolist()]


def _ramp(row: Array) -> str:
    """Draw darker characters for darker cells, as ink on paper."""
    dark = 1 - row.mean(axis=1) / 255
    return "".join(RAMP[round(one * (len(RAMP) - 1))] for one in dark.tolist())
