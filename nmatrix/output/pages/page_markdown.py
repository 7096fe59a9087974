"""A document as Markdown, for wikis, notebooks and learning platforms."""

from __future__ import annotations

from nmatrix.output.documents import blocks_in
from nmatrix.output.markdown import Markdown, escaped
from nmatrix.output.options import OutputOptions
from nmatrix.output.pages.document import Document
from nmatrix.report import Figure


def md(document: Document) -> bytes:
    """Write the document as Markdown."""
    body = blocks_in(document.blocks, MarkdownPage(OutputOptions()))
    parts = [f"# {escaped(document.title)}", escaped(document.subtitle), body, "---"]
    parts.append(escaped(document.note))
    return ("\n\n".join(part for part in parts if part) + "\n").encode("utf-8", "replace")


class MarkdownPage(Markdown):
    """How a page writes each kind of block."""

    def figure(self, figure: Figure) -> str:
        """Write a picture with its alternative text."""
        return f"![{escaped(figure.alternative)}]({figure.path})\n\n{escaped(figure.caption)}"

    def page_break(self) -> str:
        """Draw a rule."""
        return "---"
