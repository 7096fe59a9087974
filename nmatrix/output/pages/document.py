"""What is printed: a title, blocks, pictures, the paper that it goes on, and the file of it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from typing import assert_never

from nmatrix.canvas.theme import PALETTES
from nmatrix.enums import Theme, VectorFormat
from nmatrix.report import Block

INK_ON_PAPER = PALETTES[Theme.PRINT]
ANSWER_WIDE, ANSWER_HIGH = 32, 6.5  # millimetres of a line of an answer
DOTS_APART = 6  # millimetres
SHORT_TABLE = 9  # rows that stay on one page
NARROWEST, WIDEST = 8, 60  # characters of a table's columns
FORMULAS = ("#math", "$")  # how cells with formulas begin


class Paper(StrEnum):
    """The sizes of paper."""

    A4 = "a4"
    LETTER = "letter"

    @property
    def room(self) -> int:
        """Millimetres to work in, below an exercise, so that the first page holds the first one."""
        return {Paper.A4: 36, Paper.LETTER: 30}[self]


class PageFormat(StrEnum):
    """The formats of documents; all but HTML and PDF are sources to edit."""

    HTML = "html"
    PDF = "pdf"
    TYP = "typ"
    TEX = "tex"
    MD = "md"

    @property
    def drawings(self) -> VectorFormat:
        """The format of its drawings: TeX knows no SVG, and Typst no PDF that can be heard."""
        return VectorFormat.PDF if self is PageFormat.TEX else VectorFormat.SVG

    @property
    def theme(self) -> Theme:
        """The theme of its pictures: HTML gives a drawing the colours of each reader's page."""
        return Theme.LIGHT if self is PageFormat.HTML else Theme.PRINT


PAGES: Mapping[str, PageFormat] = {
    **{f".{one}": one for one in PageFormat},
    ".htm": PageFormat.HTML,
}
WITH_PICTURES_BESIDE = (PageFormat.TYP, PageFormat.TEX, PageFormat.MD)


@dataclass(frozen=True)
class Field:
    """A part of the line above the title; without a value there is a line to write on.

    `room` is the length of that line in millimetres.
    """

    label: str
    value: str = ""
    room: int = 40


@dataclass(frozen=True)
class Document:
    """One document.

    Parameters
    ----------
    title
        What it is; of a sheet, the claim that it makes.
    blocks
        The same blocks that a terminal shows.
    head
        What stands above the title: the course, the date; the last one, the name, at the right.
    foot
        What stands at the foot of every page, beside its number.
    pictures
        PNG, SVG and PDF files by the path that their `Figure` names.
    """

    title: str
    blocks: tuple[Block, ...]
    head: tuple[Field, ...] = ()
    foot: str = ""
    pictures: Mapping[str, bytes] = field(default_factory=dict)
    paper: Paper = Paper.A4


def shares(columns: Sequence[str], rows: Sequence[Sequence[str]]) -> list[float]:
    """Share the line among columns by their longest words; markup of formulas says nothing.

    Examples
    --------
    >>> shares(["", "true"], [["x" * 30, "y" * 90]])
    [0.3333333333333333, 0.6666666666666666]
    """
    longest = [
        max(len(cell) for cell in (head, *cells) if not cell.startswith(FORMULAS))
        for head, *cells in zip(columns, *rows, strict=True)
    ]
    kept = [min(max(length, NARROWEST), WIDEST) for length in longest]
    return [length / sum(kept) for length in kept]


def write(document: Document, kind: PageFormat) -> bytes:
    """Write a document as one file; only the writer of its format is loaded.

    Raises
    ------
    MissingPackageError
        For PDF without Typst.
    """
    match kind:
        case PageFormat.HTML:
            from nmatrix.output.pages.page_html import html as found
        case PageFormat.PDF:
            from nmatrix.output.pages.page_pdf import pdf as found
        case PageFormat.TYP:
            from nmatrix.output.pages.page_typst import typ as found
        case PageFormat.TEX:
            from nmatrix.output.pages.page_sources import tex as found
        case PageFormat.MD:
            from nmatrix.output.pages.page_sources import md as found
        case _:
            assert_never(kind)
    return found(document)
