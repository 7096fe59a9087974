"""The text of mesh files: lines with their numbers, and figures by the million, read at once."""

from __future__ import annotations

import codecs
import re
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import isinf
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.errors import IllegalValueError, printable

FIGURE = re.compile(rb"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?")
BLOCK = 1 << 19  # bytes of a text that are split at once
BLANKS = bytes.maketrans(b"\t\v\f", b"   ")
_COMMENT = re.compile(rb"(?:^|(?<=\s))#[^\n]*")
_GAP, _BREAK, _SLASH = b" \n/"
_WIDE = ((codecs.BOM_UTF16_LE, "utf-16-le"), (codecs.BOM_UTF16_BE, "utf-16-be"))


class BadFigureError(IllegalValueError):
    """A word that stands where a number is meant: `row` is the line among those that were given."""

    def __init__(self, row: int, what: str, why: str) -> None:
        self.row = row
        super().__init__(what, why)


def lines_of(content: bytes) -> Iterator[tuple[int, bytes]]:
    r"""Split a text of any 8-bit encoding, or UTF-16 with a mark, into numbered lines without tabs.

    Lines end in LF, CR or both; one that ends in a backslash goes on in the next.

    Examples
    --------
    >>> list(lines_of(b"v 1 \\\r\n2 3\r\nf\t1"))
    [(1, b'v 1  2 3'), (3, b'f 1')]
    """
    for numbers, block in blocks_of(content):
        yield from zip(numbers, block.split(b"\n"), strict=True)


def blocks_of(content: bytes) -> Iterator[tuple[Sequence[int], bytes]]:
    """Split a text like `lines_of`, but into blocks of many lines, with the number of each line."""
    for mark, encoding in _WIDE:
        if content.startswith(mark):
            content = content[2:].decode(encoding, "replace").encode()
    content = content.removeprefix(codecs.BOM_UTF8).replace(b"\0", b"").translate(BLANKS)
    if b"\r" in content:
        content = content.replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    number, start = 1, 0
    while start <= len(content):
        stop = content.find(b"\n", start + BLOCK)
        while content[stop - 1 : stop] == b"\\" and stop > 0:  # the last line goes on
            stop = content.find(b"\n", stop + 1)
        stop = len(content) if stop < 0 else stop
        block = content[start:stop]
        count = 1 + block.count(b"\n")
        numbers: Sequence[int] = range(number, number + count)
        if b"\\\n" in block:
            lines = block.split(b"\n")
            begins = [not before.endswith(b"\\") for before in [b"", *lines[:-1]]]
            numbers = [one for one, begin in zip(numbers, begins, strict=True) if begin]
            block = block.replace(b"\\\n", b" ")
        yield numbers, block
        number, start = number + count, stop + 1


def readable(name: bytes) -> str:
    """Decode a name: UTF-8, or else Latin-1, of which every byte is a letter.

    Examples
    --------
    >>> readable("Möbius".encode()), readable("Möbius".encode("latin-1"))
    ('Möbius', 'Möbius')
    """
    try:
        return name.decode()
    except UnicodeDecodeError:
        return name.decode("latin-1")


@dataclass(frozen=True)
class Figures:
    """The numbers of some lines, one after the other.

    `row` is the line of each; `word` the blank-separated word that it belongs to, and `part` its
    place between the slashes of that word.
    """

    values: NDArray[Any]
    row: NDArray[np.int32]
    word: NDArray[np.int32]
    part: NDArray[np.int32]


def figures(lines: Sequence[bytes], dtype: type, *, slashes: bool = False) -> Figures:
    """Read the numbers of some lines; a comment at the end of a line counts for nothing.

    Raises
    ------
    BadFigureError
        For the first word that is no number.

    Examples
    --------
    >>> found = figures([b"1//3 2", b"4/5"], int, slashes=True)
    >>> found.values.tolist(), found.row.tolist(), found.word.tolist(), found.part.tolist()
    ([1, 3, 2, 4, 5], [0, 0, 0, 1, 1], [0, 0, 1, 2, 2], [0, 2, 0, 0, 1])
    """
    text = b"\n".join(lines)
    if b"#" in text:
        text = _COMMENT.sub(b"", text)
    letters = np.frombuffer(text, np.uint8)
    breaks = letters == _BREAK
    gaps = (letters == _GAP) | breaks
    cuts = letters == _SLASH if slashes else np.zeros_like(gaps)
    starts = np.flatnonzero(_starting(gaps | cuts))
    values = numbers(text.replace(b"/", b" ") if slashes else text, dtype)
    if values is None or len(values) != len(starts):
        raise _bad_figure(text, dtype, slashes=slashes)
    first_of_word = np.flatnonzero(_starting(gaps))
    word = np.searchsorted(first_of_word, starts, side="right") - 1
    if 1 + np.count_nonzero(np.diff(word)) < len(first_of_word):  # one is nothing but slashes
        raise _bad_figure(text, dtype, slashes=slashes)
    if slashes:
        before = np.cumsum(cuts, dtype=np.int32) - cuts
        part = before[starts] - before[first_of_word[word]]
    else:
        part = np.zeros(len(starts), np.int32)
    row = np.cumsum(breaks, dtype=np.int32)[starts]
    return Figures(values, row, word.astype(np.int32), part.astype(np.int32))


def _starting(outside: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Mark the letters that are not outside and stand after one that is, or at the beginning."""
    found = ~outside
    found[1:] &= outside[:-1]
    return found


def numbers(text: bytes, dtype: type) -> NDArray[Any] | None:
    """Read a text of nothing but numbers and blanks; None if there is anything else.

    Examples
    --------
    >>> numbers(b" 1 2.5", float), numbers(b"1 x", float)
    (array([1. , 2.5]), None)
    """
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            return np.fromstring(text, dtype, sep=" ")
        except (DeprecationWarning, ValueError):  # it ends before the text does
            return None


def is_beyond(values: NDArray[Any], text: bytes) -> bool:
    """Tell whether some figures of a text are too large, where none says that it is infinite."""
    return bool(np.isinf(values).any()) and b"inf" not in text.lower()


def refused_word(word: bytes, *, whole: bool) -> str | None:
    """Explain why a word is no number, or no finite one; None if it is one."""
    if FIGURE.fullmatch(word) is None or (whole and not word.lstrip(b"+-").isdigit()):
        shown = printable(readable(word[:40]))
        return f"{shown} stands where a {'whole ' if whole else ''}number is meant"
    if isinf(float(word)):
        return f"{printable(readable(word[:40]))} is beyond the largest float64, 1.8e308"
    return None


def _bad_figure(text: bytes, dtype: type, *, slashes: bool) -> BadFigureError:
    """Find the word at which the reading stopped."""
    whole = np.issubdtype(dtype, np.integer)
    for row, line in enumerate(text.split(b"\n")):
        for word in line.split():
            figures_of_word = [one for one in word.split(b"/") if one] if slashes else []
            for figure in figures_of_word or [word]:
                why = refused_word(figure, whole=whole)
                if why is not None:
                    return BadFigureError(row, printable(readable(word[:40])), why)
    return BadFigureError(0, "text", "a number in it cannot be read")
