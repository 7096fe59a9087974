"""How an answer is to be written: the choices that every writer shares."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from nmatrix.enums import Format, Layout
from nmatrix.errors import IllegalValueError, quantity
from nmatrix.linear.values import number

MOST_DIGITS = 17


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

    def __post_init__(self) -> None:
        digits = number(self.digits, "digits")
        if not (isinstance(digits, int) and 1 <= digits <= MOST_DIGITS):
            raise IllegalValueError(
                f"{quantity('digits')} ({digits})",
                f"a float64 has 1 to {MOST_DIGITS} significant digits",
                f"try {quantity('digits')} 6",
            )
