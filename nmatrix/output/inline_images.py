"""Pictures as three kinds of terminals take them: kitty's graphics, iTerm2's files, and sixels.

Each is one escape sequence that holds the whole picture and asks for no answer.
"""

from __future__ import annotations

import io
from base64 import standard_b64encode
from collections.abc import Iterator
from typing import Any, assert_never

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from nmatrix.output.terminal import Drawing

Array = NDArray[Any]

CHUNK = 4096  # characters of a kitty sequence, at the most
SIXEL_COLOURS = 256
SIX = 6  # pixels of a column that one character of a sixel picture paints
_FIRST_SIXEL = 63
_SHORTEST_RUN = 4  # equal characters that are written as a count


def inline_image(image: Image.Image, cells: tuple[int, int], drawing: Drawing) -> str:
    """Write a picture that covers so many columns and lines of the terminal.

    Raises
    ------
    ValueError
        If the terminal takes no pictures.
    """
    columns, lines = cells
    match drawing:
        case Drawing.KITTY:
            return "".join(_kitty(standard_b64encode(_png(image)).decode(), columns, lines))
        case Drawing.ITERM2:
            file = _png(image)
            how = f"inline=1;size={len(file)};width={columns};height={lines};preserveAspectRatio=1"
            return f"\x1b]1337;File={how}:{standard_b64encode(file).decode()}\a"
        case Drawing.SIXEL:
            return sixel(image)
        case Drawing.HALF_BLOCKS | Drawing.CHARACTERS:
            raise ValueError(f"{drawing} is no protocol for pictures")
        case _:
            assert_never(drawing)


def _png(image: Image.Image) -> bytes:
    out = io.BytesIO()
    image.save(out, "PNG")
    return out.getvalue()


def _kitty(text: str, columns: int, lines: int) -> Iterator[str]:
    """Write pieces of a PNG; q=2 keeps the terminal from answering into the shell."""
    first = f"a=T,f=100,q=2,c={columns},r={lines},"
    for start in range(0, len(text), CHUNK):
        more = int(start + CHUNK < len(text))
        yield f"\x1b_G{first}m={more};{text[start : start + CHUNK]}\x1b\\"
        first = "q=2,"


def sixel(image: Image.Image) -> str:
    r"""Write a picture in at most 256 colours of its own.

    A band is six rows. A colour paints its pixels of a band in one line of characters, whose lowest
    bit is the uppermost pixel; `$` goes back to the left, `-` down to the next band.

    Examples
    --------
    >>> sixel(Image.new("RGB", (5, 2), (255, 0, 0)))
    '\x1bP0;1q"1;1;5;2#0;2;100;0;0#0!5B\x1b\\'
    """
    painted = image.convert("RGB").quantize(SIXEL_COLOURS, kmeans=1)
    pixels = np.asarray(painted)
    height, width = pixels.shape
    palette = np.array(painted.getpalette("RGB"), float).reshape(-1, 3)
    used = np.unique(pixels).tolist()
    colours = "".join(
        "#{};2;{};{};{}".format(i, *np.rint(palette[i] / 255 * 100).astype(int)) for i in used
    )
    bands = (pixels[top : top + SIX] for top in range(0, height, SIX))
    painting = "-".join(map(_band, bands))
    return f'\x1bP0;1q"1;1;{width};{height}{colours}{painting}\x1b\\'


def _band(pixels: Array) -> str:
    """Write one band, a line of characters for each of its colours."""
    used, place = np.unique(pixels, return_inverse=True)
    bits = np.zeros((len(used), pixels.shape[1]), np.uint8)
    columns = np.arange(pixels.shape[1])
    for row, colours in enumerate(place.reshape(pixels.shape)):
        bits[colours, columns] |= 1 << row
    return "$".join(
        f"#{colour}{_runs(line)}" for colour, line in zip(used.tolist(), bits, strict=True)
    )


def _runs(line: Array) -> str:
    """Write a line of sixels with its runs counted, and without the empty ones at its end."""
    line = line[: np.flatnonzero(line)[-1] + 1]
    starts = np.flatnonzero(np.diff(line, prepend=line[0] ^ 1))
    counts = np.diff(starts, append=len(line))
    return "".join(
        f"!{count}{letter}" if count >= _SHORTEST_RUN else letter * count
        for letter, count in zip(
            map(chr, (line[starts] + _FIRST_SIXEL).tolist()), counts.tolist(), strict=True
        )
    )
