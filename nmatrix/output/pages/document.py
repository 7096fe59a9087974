"""What is printed: a title, blocks, pictures, and the paper that it goes on."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from enum import StrEnum

from nmatrix.output.documents import sections
from nmatrix.report import Blank, Block, PageBreak


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
        """Give the blocks of each section, and whether a page must not part it: an exercise."""
        for section in sections(self.blocks):
            has_room = any(isinstance(block, Blank) for block in section)
            yield section, has_room and not any(isinstance(one, PageBreak) for one in section)
