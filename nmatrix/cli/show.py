"""The only place that writes to a terminal: one report to stdout, errors and notes to stderr."""

from __future__ import annotations

import os
import struct
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import replace
from enum import StrEnum
from typing import TYPE_CHECKING, TextIO, TypeVar

from nmatrix.enums import Format
from nmatrix.errors import IllegalValueError, refusal
from nmatrix.output.write import Charset, Colour, OutputOptions, write
from nmatrix.report import Report

if TYPE_CHECKING:
    from nmatrix.cli.shared_options import CommonOptions
    from nmatrix.output.style import Line
    from nmatrix.output.terminal import Screen
    from nmatrix.raster.proofs.proof import Proof

Item = TypeVar("Item")

LONGEST_LINE = 600
WIDTH, NARROWEST, WIDEST = 80, 40, 1000  # columns
ENDLESS = 1_000_000  # lines of a page that is no terminal
_WITNESSES: ContextVar[tuple[list[Report], ...]] = ContextVar("witnesses", default=())
BRACKETS = "⎡⎢⎣│−ᵀ⁻¹°✓"


class ColorWhen(StrEnum):
    """When text carries terminal colours."""

    AUTO = "auto"
    ALWAYS = "always"
    NEVER = "never"


def show(report: Report, common: CommonOptions) -> None:
    """Write a report in the format asked for, then raise what it ends in, if anything."""
    from nmatrix.cli.shared_options import option_name  # it imports this module

    remarks = (*common.sources.about, *common.sources.remarks, *report.remarks)
    told = replace(report, remarks=remarks, about=len(common.sources.about))
    told = told.spelled(option_name)
    put(_written(told, options_of(common), common))
    for witness in _WITNESSES.get():
        witness.append(told)
    if report.failure is not None:
        raise report.failure


@contextmanager
def witnessed() -> Iterator[list[Report]]:
    """Collect the reports that are shown meanwhile, for who shows them once more otherwise."""
    seen: list[Report] = []
    token = _WITNESSES.set((*_WITNESSES.get(), seen))
    try:
        yield seen
    finally:
        _WITNESSES.reset(token)


def options_of(common: CommonOptions) -> OutputOptions:
    """Choose how an answer is written, as the command line and stdout have it."""
    return OutputOptions(
        format=common.format,
        digits=common.digits_checked,
        layout=common.layout,
        charset=_charset(),
        width=width(),
        colour=_colour(common),
        full=common.full,
        numbers=common.numbers,
    )


def _written(report: Report, options: OutputOptions, common: CommonOptions) -> str:
    """Write a report; a format of the environment that can say nothing of it is passed over."""
    try:
        return write(report, options)
    except IllegalValueError:
        if common.format_is_typed:
            raise
        return write(report, replace(options, format=Format.TEXT, colour=_colour(common.as_text())))


def show_page(page: Iterable[Line], when: ColorWhen = ColorWhen.AUTO) -> None:
    """Write a page of help."""
    from nmatrix.output.style import render

    colour = _colour_of(sys.stdout, when)
    put("".join(f"{render(line, colour)}\n" for line in page))


def put(text: str) -> None:
    """Write text to stdout in one piece, in the characters that it has.

    A reader that has gone away is no error.
    """
    try:
        sys.stdout.write(_sayable(text, sys.stdout))
        sys.stdout.flush()
    except OSError as error:
        _lose(error)


def put_bytes(content: bytes) -> None:
    """Write a file's content to stdout."""
    try:
        sys.stdout.buffer.write(content)
        sys.stdout.buffer.flush()
    except OSError as error:
        _lose(error)


def show_picture(proof: Proof, common: CommonOptions) -> None:
    """Show a picture in the terminal, in its colours where those may be written."""
    from nmatrix.canvas.slide import Slide
    from nmatrix.output.preview import parts_of, preview

    slide = proof.picture
    parts = parts_of(slide, proof.image) if isinstance(slide, Slide) else ()
    put(preview(proof.image, parts, _screen(common)))


def progress(items: Iterable[Item], total: int, what: str) -> Iterator[Item]:
    """Pass the items on, with a bar on stderr while they come, if that is a terminal."""
    if total == 1 or not sys.stderr.isatty():
        yield from items
        return
    from rich.console import Console
    from rich.progress import track

    yield from track(items, what, total, console=Console(stderr=True), transient=True)


def fail(message: str, exit_code: int, when: ColorWhen = ColorWhen.AUTO) -> int:
    """Write one line to stderr, whatever the message holds, and return the exit code.

    Scripts look for its first word, so only a terminal sees that in colour.
    """
    from nmatrix.output.style import Span, Style, render

    colour = _colour_of(sys.stderr, when) if sys.stderr.isatty() else Colour.PLAIN
    _put_aside(render((Span("error:", Style.WRONG),), colour), message)
    return exit_code


def put_remarks(remarks: Iterable[str]) -> None:
    """Write to stderr what belongs to an answer that another program reads from stdout."""
    for one in remarks:
        _put_aside("note:", one)


def _put_aside(head: str, message: str) -> None:
    line = "".join(_printable(character) for character in message)
    if len(line) > LONGEST_LINE:
        line = f"{line[: LONGEST_LINE - 1]}…"
    try:
        sys.stderr.write(_sayable(f"{head} {line}\n", sys.stderr))
        sys.stderr.flush()
    except OSError:  # there is nobody to be told
        _forget(sys.stderr.fileno())


def _sayable(text: str, stream: TextIO) -> str:
    """Spell what a stream's encoding lacks."""
    if text.isascii():
        return text
    from nmatrix.output.spelling import sayable

    return sayable(text, stream.encoding or "utf-8")


def _printable(character: str) -> str:
    if character.isprintable():
        return character
    return " " if character in "\n\t" else f"\\x{ord(character):02x}"


def _lose(error: OSError) -> None:
    """Leave stdout; a reader that has gone away is no error, a full disk is one."""
    _forget(sys.stdout.fileno())
    if not isinstance(error, BrokenPipeError):
        raise IllegalValueError(
            "standard output (stdout)",
            f"it takes no more: {refusal(error)}",
            "give it another place",
        ) from None


def _forget(descriptor: int) -> None:
    # Python flushes stdout once more on its way out; let it go where nobody reads.
    os.dup2(os.open(os.devnull, os.O_WRONLY), descriptor)


def _charset() -> Charset:
    try:
        BRACKETS.encode(sys.stdout.encoding or "ascii")
    except (UnicodeEncodeError, LookupError):
        return Charset.ASCII
    return Charset.UNICODE


def width() -> int:
    """Choose how wide text is: as COLUMNS says, else the terminal's width, 80 at the most."""
    told = os.environ.get("COLUMNS", "")
    if told.isdecimal() and len(told) <= len(str(WIDEST)) and NARROWEST <= int(told) <= WIDEST:
        return int(told)
    if not sys.stdout.isatty():
        return WIDTH
    return max(NARROWEST, min(WIDTH, os.get_terminal_size(sys.stdout.fileno()).columns))


def _screen(common: CommonOptions) -> Screen:
    """Look what can be drawn on; what is no terminal gets no pictures, and has no last line."""
    from nmatrix.output.terminal import CELL, Drawing, Screen, abilities

    in_colour, charset = _colour(common) is Colour.ANSI, _charset()
    blocks = Drawing.HALF_BLOCKS if charset is Charset.UNICODE else Drawing.CHARACTERS
    if not sys.stdout.isatty():
        drawing = blocks if in_colour else Drawing.CHARACTERS
        return Screen(WIDTH, ENDLESS, drawing, charset=charset)
    drawing, colours = abilities(os.environ)
    if not in_colour:
        drawing = Drawing.CHARACTERS
    elif not drawing.has_pixels:
        drawing = blocks
    size = os.get_terminal_size(sys.stdout.fileno())
    cell = _cell() or CELL
    return Screen(max(size.columns, 1), max(size.lines, 1), drawing, colours, cell, charset)


def _cell() -> tuple[int, int] | None:
    """Read how many pixels a character has, where the system knows it."""
    try:
        import fcntl
        import termios
    except ImportError:  # Windows
        return None
    try:
        told = fcntl.ioctl(sys.stdout.fileno(), termios.TIOCGWINSZ, bytes(8))
    except OSError:
        return None
    lines, columns, width, height = struct.unpack("HHHH", told)
    if not (lines and columns and width >= columns and height >= lines):
        return None
    return width // columns, height // lines


def _colour(common: CommonOptions) -> Colour:
    if common.format is not Format.TEXT:
        return Colour.PLAIN
    return _colour_of(sys.stdout, common.colour_when)


def _colour_of(stream: TextIO, when: ColorWhen) -> Colour:
    if when is ColorWhen.NEVER:
        return Colour.PLAIN
    if when is ColorWhen.ALWAYS or os.environ.get("FORCE_COLOR"):
        return Colour.ANSI
    if os.environ.get("NO_COLOR") or os.environ.get("TERM") == "dumb":
        return Colour.PLAIN
    return Colour.ANSI if stream.isatty() else Colour.PLAIN
