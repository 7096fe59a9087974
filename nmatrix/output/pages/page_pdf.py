"""A document as PDF, through Typst: the same bytes every time, and readable by ear (UA-1)."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import UTC, datetime
from itertools import product
from pathlib import Path
from shutil import copy
from tempfile import TemporaryDirectory

from nmatrix.canvas.text import font_file
from nmatrix.errors import IllegalValueError, quantity
from nmatrix.output.pages.document import Document
from nmatrix.output.pages.page_typst import typ_of
from nmatrix.report import Text
from nmatrix.requirements import missing

NO_TIME = datetime(2020, 1, 1, tzinfo=UTC)  # a document does not say when it was made


def pdf(document: Document) -> bytes:
    """Print the document as PDF.

    Raises
    ------
    MissingPackageError
        If Typst is not installed.
    """
    return pdf_of((document,), document.title)


def pdf_of(documents: Sequence[Document], title: str) -> bytes:
    """Print documents as one PDF, sheet by sheet for two-sided paper.

    Raises
    ------
    MissingPackageError
        If Typst is not installed.
    """
    check_typst()
    import typst

    with TemporaryDirectory() as name:
        folder = Path(name)
        pictures = {path: one for document in documents for path, one in document.pictures.items()}
        for path, content in pictures.items():
            folder.joinpath(path).parent.mkdir(parents=True, exist_ok=True)
            folder.joinpath(path).write_bytes(content)
        fonts = folder / "fonts"  # beside these, matplotlib has one with a box for any character
        fonts.mkdir()
        for bold, oblique in product((False, True), repeat=2):
            copy(font_file(bold=bold, oblique=oblique), fonts)
        source = folder / "main.typ"
        source.write_bytes(typ_of(documents, title))
        found = typst.compile(
            str(source),
            root=name,
            format="pdf",
            ignore_system_fonts=True,
            font_paths=[str(fonts)],
            pdf_standards=["ua-1"],  # refuses what has no alternative text
            timestamp=NO_TIME,
        )
    assert isinstance(found, bytes)  # without an output path the file comes back
    return found


def check_names(names: Sequence[str]) -> None:
    """Refuse a name that the fonts of a PDF cannot print, before half the class is done.

    Raises
    ------
    MissingPackageError
        If Typst is not installed.
    IllegalValueError
        If a name has a character that they lack.
    """
    check_typst()
    while not _is_printable(names):
        half = len(names) // 2
        if not half:
            raise IllegalValueError(
                f"student ({names[0][:30]})",
                "the fonts of a PDF lack a character of this name",
                "write it in Latin letters, or print the HTML",
            )
        names = names[half:] if _is_printable(names[:half]) else names[:half]


def _is_printable(names: Sequence[str]) -> bool:
    import typst

    try:
        pdf(Document("Names", tuple(map(Text, names))))
    except typst.TypstError:
        return False
    return True


def check_typst() -> None:
    """Refuse to begin where Typst is missing."""
    try:
        import typst  # noqa: F401  # whether it is there
    except ImportError:
        otherwise = "print the HTML from a browser"
        raise missing(f"{quantity('to')} pdf", "typst", otherwise=otherwise) from None
