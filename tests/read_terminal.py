"""A small terminal: it reads sixels as pixels, and coloured characters as letters and colours."""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

STEPS = (0, 95, 135, 175, 215, 255)
SIXELS = re.compile(r'\x1bP0;1q"1;1;(\d+);(\d+)(.*?)\x1b\\', re.DOTALL)
WORD = re.compile(r"#(\d+)(?:;2;(\d+);(\d+);(\d+))?|!(\d+)([?-~])|([?-~])|([$-])")


def pixels_of_sixels(text: str) -> np.ndarray:
    """Paint the first picture of sixels in a text; unpainted pixels fail."""
    found = SIXELS.search(text)
    assert found is not None
    width, height = int(found[1]), int(found[2])
    image = np.full((height + 6, width, 3), -1)
    palette: dict[int, tuple[int, ...]] = {}
    x = y = colour = 0
    end = 0
    for word in WORD.finditer(found[3]):
        assert word.start() == end, found[3][end : end + 20]
        end = word.end()
        index, red, green, blue, count, repeated, once, move = word.groups()
        if red is not None:
            palette[int(index)] = tuple(round(int(one) * 2.55) for one in (red, green, blue))
        elif index is not None:
            colour = int(index)
        elif move == "$":
            x = 0
        elif move == "-":
            x, y = 0, y + 6
        else:
            times, bits = int(count or 1), ord(repeated or once) - 63
            for row in range(6):
                if bits >> row & 1:
                    image[y + row, x : x + times] = palette[colour]
            x += times
            assert x <= width
    assert end == len(found[3])
    assert (image[height:] == -1).all()
    assert (image[:height] >= 0).all()
    return image[:height].astype(np.uint8)


@dataclass(frozen=True)
class Shown:
    """What stands on a terminal: letters in lines, and the two colours of each."""

    letters: list[str]
    colours: list[list[tuple[tuple[int, ...], tuple[int, ...]]]]

    def halves(self) -> np.ndarray:
        """Return the pixels of half blocks."""
        planes = np.array(self.colours, int)
        rows, columns = planes.shape[:2]
        return planes.transpose(0, 2, 1, 3).reshape(2 * rows, columns, 3).astype(np.uint8)


def characters(text: str, ink: int = 0, paper: int = 255) -> Shown:
    """Read text with colours of 24 bits and of the 256."""
    letters, colours = [], []
    for line in text.splitlines():
        row: list[tuple[tuple[int, ...], tuple[int, ...]]] = []
        row_letters, fore, back = "", (ink,) * 3, (paper,) * 3
        for codes, letter in re.findall(r"\x1b\[([\d;]*)m|([^\x1b])", line):
            if letter:
                row_letters += letter
                row.append((fore, back))
                continue
            numbers = [int(one) for one in codes.split(";")]
            if numbers[0] == 0:
                fore, back = (ink,) * 3, (paper,) * 3
            if numbers[0] == 38:
                fore = _colour(numbers[1:])
            if numbers[0] == 48:
                back = _colour(numbers[1:])
        letters.append(row_letters)
        colours.append(row)
    return Shown(letters, colours)


def _colour(codes: list[int]) -> tuple[int, ...]:
    if codes[0] == 2:
        return tuple(codes[1:4])
    index = codes[1]
    if index >= 232:
        return (8 + 10 * (index - 232),) * 3
    return tuple(
        STEPS[part] for part in ((index - 16) // 36, (index - 16) // 6 % 6, (index - 16) % 6)
    )
