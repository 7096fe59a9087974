"""A document as PDF, through Typst: the same bytes every time, and readable by ear (UA-1)."""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path
from tempfile import TemporaryDirectory

from nmatrix.errors import MissingPackageError
from nmatrix.output.pages.document import Document
from nmatrix.output.pages.typ import typ

NO_TIME = datetime(2020, 1, 1, tzinfo=UTC)  # a document does not say when it was made


def pdf(document: Document) -> bytes:
    """Return the document as PDF.

    Raises
    ------
    MissingPackageError
        If Typst is not installed.
    """
    check_typst()
    import typst

    with TemporaryDirectory() as name:
        folder = Path(name)
        for path, content in document.pictures.items():
            folder.joinpath(path).parent.mkdir(parents=True, exist_ok=True)
            folder.joinpath(path).write_bytes(content)
        source = folder / "main.typ"
        source.write_bytes(typ(document))
        found = typst.compile(
            str(source),
            root=name,
            format="pdf",
            ignore_system_fonts=True,
            pdf_standards=["ua-1"],  # refuses what has no alternative text
            timestamp=NO_TIME,
        )
    assert isinstance(found, bytes)  # without an output path the file comes back
    return found


def check_typst() -> None:
    """Say now, and not after the work, that Typst is missing."""
    try:
        import typst  # noqa: F401  # whether it is there
    except ImportError:
        raise MissingPackageError(
            "--to pdf",
            "it needs the package typst",
            "pip install 'nmatrix[pdf]', or print the HTML from a browser",
        ) from None
