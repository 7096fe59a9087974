"""What a terminal can show: text in styled pieces, few colours, and ASCII where it knows no more.

A line is a tuple of spans; its width is counted before any colour goes in. Colours are of the fixed
part of the 256: the first sixteen are each theme's own, and some of them cannot be read on its own
background. Those chosen here stand out from black and from white alike.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import StrEnum

from nmatrix.output.spelling import sayable
from nmatrix.output.write import Charset, Colour

RESET = "\x1b[0m"
GREY, ROSE, OLIVE, BLUE, GREEN, ORANGE = 244, 197, 64, 33, 29, 166  # of the 256 colours


class Style(StrEnum):
    """What a piece of text is; the value is its ANSI escape, empty for ordinary text."""

    PLAIN = ""
    TITLE = "\x1b[1m"
    DIM = f"\x1b[38;5;{GREY}m"
    X = f"\x1b[38;5;{ROSE}m"
    Y = f"\x1b[38;5;{OLIVE}m"
    Z = f"\x1b[38;5;{BLUE}m"
    RIGHT = f"\x1b[1;38;5;{GREEN}m"
    WRONG = f"\x1b[1;38;5;{ORANGE}m"


AXES = {"x": Style.X, "y": Style.Y, "z": Style.Z}
MARKS = {"✓": Style.RIGHT, "✗": Style.WRONG}
_MARK = re.compile(f"([{''.join(MARKS)}])")


@dataclass(frozen=True)
class Span:
    """A piece of a line in one style."""

    text: str
    style: Style = Style.PLAIN


Line = tuple[Span, ...]


def plain(text: str) -> Line:
    """Make a line of ordinary text, in which only ✓ and ✗ have a colour.

    Examples
    --------
    >>> [span.style.name for span in plain("✗ A n")]
    ['WRONG', 'PLAIN']
    """
    pieces = _MARK.split(text) if not text.isascii() else [text]
    return tuple(Span(piece, MARKS.get(piece, Style.PLAIN)) for piece in pieces if piece)


def width(line: Line) -> int:
    """Count the columns that a line takes.

    Examples
    --------
    >>> width((Span("x", Style.X), Span(" = 1")))
    5
    """
    return sum(len(span.text) for span in line)


def render(line: Line, colour: Colour) -> str:
    """Turn a line into characters, with escapes only where colour is wanted.

    Examples
    --------
    >>> render((Span("x", Style.X), Span(" ")), Colour.PLAIN)
    'x'
    """
    if colour is Colour.PLAIN:
        return "".join(span.text for span in line).rstrip()
    return "".join(_coloured(span) for span in line)


def _coloured(span: Span) -> str:
    styled = span.style is not Style.PLAIN and span.text.strip()
    return f"{span.style}{span.text}{RESET}" if styled else span.text


def printable(text: str) -> str:
    r"""Spell out control characters, which could repaint a terminal.

    Examples
    --------
    >>> printable("a\x1b[2Jb")
    'a\\x1b[2Jb'
    """
    if text.isprintable():
        return text
    return "".join(
        mark if mark.isprintable() or mark == "\n" else mark.encode("unicode_escape").decode()
        for mark in text
    )


def spelled(text: str, charset: Charset) -> str:
    """Write a text in the characters that the terminal has.

    Examples
    --------
    >>> spelled("A⁻ᵀ is 90° − θ, to 10⁻¹⁴", Charset.ASCII)
    'A^-T is 90 deg - theta, to 10^-14'
    """
    return text if charset is Charset.UNICODE else sayable(text, "ascii")
