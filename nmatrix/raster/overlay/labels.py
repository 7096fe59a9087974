"""Names in a picture: set where there is room, in letters that the font has."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from functools import cache

from nmatrix.canvas.marks import Box, Canvas, Point
from nmatrix.canvas.text import font_file, width
from nmatrix.errors import printable, shortlist

SIZE, LEAST_PIXELS = 22.0, 11.0  # units, and pixels where these are larger
LONGEST = 24  # letters
APART = 16.0  # units between two names
RIGHT_TO_LEFT = ("R", "AL", "AN")
MARKUP = str.maketrans({"*": "∗", "{": "(", "}": ")"})


@dataclass(frozen=True)
class _Name:
    """Words that stand beside one of some places, so far from it."""

    places: tuple[Point, ...]
    text: str
    clear: float


@dataclass(eq=False)
class Labels:
    """The words on a canvas: written last, over all marks, and not over one another."""

    canvas: Canvas
    names: list[_Name] = field(default_factory=list)
    letters: list[tuple[Point, str]] = field(default_factory=list)
    taken: list[Box] = field(default_factory=list)
    replaced: dict[str, str] = field(default_factory=dict)

    @property
    def size(self) -> float:
        """Return the size of the letters in units."""
        return max(SIZE, LEAST_PIXELS / self.canvas.scale)

    def name(self, places: Iterable[Point], name: str, otherwise: str, clear: float) -> None:
        """Name what has its corners at some places, or stands at one.

        `otherwise` is written for a name in letters that the font lacks, or whose order it does
        not know.
        """
        if not is_settable(name):
            name = self.replaced.setdefault(name, otherwise)
        short = name if len(name) <= LONGEST else f"{name[: LONGEST - 1]}…"
        self.names.append(_Name(tuple(places), printable(short).translate(MARKUP), clear))

    def letter(self, middle: Point, letter: str) -> None:
        """Write a letter around a place."""
        wide = width(letter, self.size)
        baseline = (middle[0] - wide / 2, middle[1] + 0.3 * self.size)
        self.letters.append((baseline, letter))
        self.keep_free(self._box(baseline, wide))

    def keep_free(self, box: Box) -> None:
        """Let no name stand in a box."""
        self.taken.append(box)

    def cover(self, box: Box) -> None:
        """Take away the letters in a box that something covers, and let no name stand there."""
        self.letters = [one for one in self.letters if not box.holds(one[0])]
        self.keep_free(box)

    def write(self) -> tuple[str, ...]:
        """Write each name on the first side of its places that has room; return remarks."""
        for baseline, letter in self.letters:
            self._set(baseline, letter)
        left_out = [one.text for one in self.names if not self._is_written(one)]
        found = [
            f"The letters of {printable(name)} cannot be set here: it is called {otherwise}."
            for name, otherwise in self.replaced.items()
        ]
        if left_out:
            found.append(f"There was no room for the name of {shortlist(left_out)}.")
        return tuple(found)

    def _is_written(self, name: _Name) -> bool:
        wide = width(name.text, self.size)
        for baseline in self._sides(name, wide):
            box = self._box(baseline, wide)
            if self._is_free(box):
                self.keep_free(Box(box.x - APART, box.y, box.width + 2 * APART, box.height))
                self._set(baseline, name.text)
                return True
        return False

    def _sides(self, name: _Name, wide: float) -> Iterator[Point]:
        """Yield where words so wide can begin: right, left, above and below of each place."""
        clear = name.clear
        for x, y in name.places:
            level = y + 0.36 * self.size
            yield x + clear, level
            yield x - clear - wide, level
            yield x - wide / 2, y - clear
            yield x - wide / 2, y + clear + 0.8 * self.size

    def _box(self, baseline: Point, wide: float) -> Box:
        return Box(baseline[0], baseline[1] - 0.76 * self.size, wide, 0.98 * self.size)

    def _set(self, baseline: Point, text: str) -> None:
        self.canvas.text(baseline, text, self.size, halo=self.canvas.palette.paper)

    def _is_free(self, box: Box) -> bool:
        inside = box.x >= 0 and box.y >= 0
        inside = inside and box.right <= self.canvas.width and box.bottom <= self.canvas.height
        return inside and not any(common_area(box, other) > 0 for other in self.taken)


def common_area(a: Box, b: Box) -> float:
    """Return the area of the part that two boxes have in common.

    Examples
    --------
    >>> common_area(Box(0, 0, 2, 2), Box(1, 1, 2, 2))
    1
    """
    wide = min(a.right, b.right) - max(a.x, b.x)
    high = min(a.bottom, b.bottom) - max(a.y, b.y)
    return max(wide, 0) * max(high, 0)


def is_settable(text: str) -> bool:
    """Return whether the font has every letter of a text, and sets them in their order.

    Examples
    --------
    >>> is_settable("Ünïcode Ω"), is_settable("椅子"), is_settable("כדור")
    (True, False, False)
    """
    known = _letters()
    return all(
        ord(letter) in known and unicodedata.bidirectional(letter) not in RIGHT_TO_LEFT
        for letter in text
    )


@cache
def _letters() -> frozenset[int]:
    from matplotlib.ft2font import FT2Font

    return frozenset(FT2Font(str(font_file())).get_charmap())
