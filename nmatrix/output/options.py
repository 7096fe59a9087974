"""How an answer is to be written: the choices that every writer shares."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from nmatrix.enums import Format, Layout


class Charset(StrEnum):
    """Which characters the reader's terminal can show."""

    UNICODE = "unicode"
    ASCII = "ascii"


class Colour(StrEnum):
    """Whether text carries terminal colours."""

    PLAIN = "plain"
    ANSI = "ansi"


@dataclass(frozen=True)
class OutputOptions:
    """One format, and how people want to see their numbers.

    Parameters
    ----------
    digits
        Significant digits for people; machine formats print what round-trips.
    layout
        How json, csv, numpy and js order a matrix; glsl is column-major whatever it says.
    width
        Columns of text.
    """

    format: Format = Format.TEXT
    digits: int = 6
    layout: Layout = Layout.ROW_MAJOR
    charset: Charset = Charset.UNICODE
    width: int = 80
    colour: Colour = Colour.PLAIN
