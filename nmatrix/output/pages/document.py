"""What is printed: a title, blocks, pictures, the paper that it goes on, and the file of it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from itertools import pairwise
from typing import assert_never

from nmatrix.report import Blank, Block, Heading, PageBreak


class Paper(StrEnum):
    """The sizes of paper."""

    A4 = "a4"
    LETTER = "letter"


class PageFormat(StrEnum):
    """The formats of documents; all but HTML and PDF are sources to edit."""

    HTML = "html"
    PDF = "pdf"
    TYP = "typ"
    TEX = "tex"
    MD = "md"


PAGES: Mapping[str, PageFormat] = {
    **{f".{one}": one for one in PageFormat},
    ".htm": PageFormat.HTML,
}
WITH_PICTURES_BESIDE = (PageFormat.TYP, PageFormat.TEX, PageFormat.MD)


@dataclass(frozen=True)
class Document:
    """One document.

    Parameters
    ----------
    title, subtitle
        What it is, and whose.
    blocks
        The same blocks that a terminal shows.
    pictures
        PNG files by the path that their `Figure` names.
    note
        The small print at the end.
    """

    title: str
    blocks: tuple[Block, ...]
    subtitle: str = ""
    pictures: Mapping[str, bytes] = field(default_factory=dict)
    note: str = ""
    paper: Paper = Paper.A4

    def sections(self) -> Iterator[tuple[tuple[Block, ...], bool]]:
        """Part the blocks at headings; an exercise, which is True, must stay on one page."""
        begins = [i for i, block in enumerate(self.blocks) if i == 0 or isinstance(block, Heading)]
        for begin, end in pairwise((*begins, len(self.blocks))):
            section = self.blocks[begin:end]
            kinds = set(map(type, section))
            yield section, Blank in kinds and PageBreak not in kinds


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
