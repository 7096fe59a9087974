"""A picture in the terminal: two pixels to a character, or a ramp of characters without colour."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.output.style import RESET

Array = NDArray[Any]

RAMP = " .:-=+*#%@"


def preview(image: Array, columns: int, *, in_colour: bool) -> str:
    """Draw an 8-bit image (height, width, 3) in lines of at most so many characters.

    Examples
    --------
    >>> print(preview(np.zeros((2, 2, 3), np.uint8), 2, in_colour=False), end="")
    @@
    """
    height, width = image.shape[:2]
    columns = min(columns, width)
    rows = max(1, round(height / width * columns / 2))
    small = _resized(image, 2 * rows if in_colour else rows, columns)
    lines = (
        zip(small[::2], small[1::2], strict=True) if in_colour else ((row, row) for row in small)
    )
    draw = _halves if in_colour else _ramp
    return "".join(f"{draw(upper, lower)}\n" for upper, lower in lines)


def _resized(image: Array, rows: int, columns: int) -> Array:
    """Average the colours in every cell of a grid."""
    row = np.linspace(0, image.shape[0], rows + 1).astype(int)
    column = np.linspace(0, image.shape[1], columns + 1).astype(int)
    across = np.add.reduceat(image.astype(float), column[:-1], axis=1)
    total = np.add.reduceat(across, np.minimum(row[:-1], image.shape[0] - 1), axis=0)
    count = np.maximum(np.diff(row), 1)[:, None, None] * np.diff(column)[None, :, None]
    return np.asarray(np.rint(total / count).astype(int))


def _halves(upper: Array, lower: Array) -> str:
    cells = (
        f"\x1b[38;2;{a[0]};{a[1]};{a[2]}m\x1b[48;2;{b[0]};{b[1]};{b[2]}m▀"
        for a, b in zip(upper.tolist(), lower.tolist(), strict=True)
    )
    return "".join(cells) + RESET


def _ramp(row: Array, _: Array) -> str:
    """Draw darker characters for darker cells, as ink on paper."""
    dark = 1 - row.mean(axis=1) / 255
    return "".join(RAMP[round(one * (len(RAMP) - 1))] for one in dark.tolist())
