"""Choose the writer of a document; only that one is loaded."""

from __future__ import annotations

from nmatrix.output.pages.document import Document, PageFormat

WITH_PICTURES_BESIDE = (PageFormat.TYP, PageFormat.TEX, PageFormat.MD)


def write(document: Document, kind: PageFormat) -> bytes:
    """Return the document as one file.

    Raises
    ------
    MissingPackageError
        For PDF without Typst.
    """
    if kind is PageFormat.HTML:
        from nmatrix.output.pages.html import html

        return html(document)
    if kind is PageFormat.PDF:
        from nmatrix.output.pages.pdf import pdf

        return pdf(document)
    if kind is PageFormat.TYP:
        from nmatrix.output.pages.typ import typ

        return typ(document)
    if kind is PageFormat.TEX:
        from nmatrix.output.pages.tex import tex

        return tex(document)
    from nmatrix.output.pages.md import md

    return md(document)
