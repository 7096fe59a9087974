"""A document as one HTML file: native MathML, its own font and pictures, no network, no script."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Sequence
from functools import cache
from html import escape
from importlib.resources import files

from nmatrix.output.documents import Cells, blocks_in
from nmatrix.output.mathml import MathML, prose
from nmatrix.output.pages.document import Document, Paper
from nmatrix.output.write import OutputOptions
from nmatrix.report import Figure, Formula

POLICY = "default-src 'none'; style-src 'unsafe-inline'; img-src data:; font-src data:"
KEEP = ' class="whole"'
SIZES = {Paper.A4: "A4", Paper.LETTER: "letter"}


def html(document: Document) -> bytes:
    """Write the document as one self-contained file."""
    dialect = HtmlPage(document)
    body = "\n".join(
        f"<section{KEEP if whole else ''}>\n{blocks_in(section, dialect)}\n</section>"
        for section, whole in document.sections()
    )
    subtitle = f'<p class="subtitle">{escape(document.subtitle)}</p>' if document.subtitle else ""
    page = f"""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{POLICY}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{escape(document.title)}</title>
<style>
{_style(document.paper)}{_foot(document.subtitle)}</style>
</head>
<body>
<main>
<h1>{escape(document.title)}</h1>
{subtitle}
{body}
</main>
<footer>{escape(document.note)}</footer>
</body>
</html>
"""
    return page.encode("utf-8", "replace")


@cache
def _style(paper: Paper) -> str:
    """Fill the font and the paper into the style sheet."""
    folder = files(__package__)
    font = b64encode(folder.joinpath("math.woff2").read_bytes()).decode()
    style = folder.joinpath("style.css").read_text(encoding="utf-8")
    return style.replace("FONT", font).replace("PAPER", SIZES[paper])


def _foot(whose: str) -> str:
    """Print a name and a number on every page: sheets get dropped."""
    page = 'counter(page) " / " counter(pages)'
    name = "".join(c if c.isalnum() and c.isascii() else f"\\{ord(c):x} " for c in whose)
    style = "font: 8pt serif; color: #5a5a5a;"
    return (
        f'@page {{ @bottom-left {{ content: "{name}"; {style} white-space: nowrap; }} '
        f"@bottom-right {{ content: {page}; {style} }} }}\n"
    )


class HtmlPage(MathML):
    """How a page writes each kind of block."""

    def __init__(self, document: Document) -> None:
        super().__init__(OutputOptions())
        self.pictures = document.pictures

    def table(self, title: str, columns: Sequence[str], rows: Cells) -> str:
        """Write a table that scrolls by itself where the screen is narrow."""
        return f'<div class="wide">{super().table(title, columns, rows)}</div>'

    def step(self, formula: Formula, because: str, *, verified: bool) -> str:
        """Write a step that stays together on a page."""
        mark = "proved" if verified else "unproved"
        words = because if verified else f"not proved: {because}"
        return (
            f'<div class="step">{self.formula(formula)}<p class="{mark}">{prose(words)}</p></div>'
        )

    def figure(self, figure: Figure) -> str:
        """Write a picture with its alternative text."""
        data = b64encode(self.pictures[figure.path]).decode()
        caption = f"<figcaption>{prose(figure.caption)}</figcaption>" if figure.caption else ""
        image = f'<img src="data:image/png;base64,{data}" alt="{escape(figure.alternative)}">'
        return f"<figure>{image}{caption}</figure>"

    def blank(self, rows: int, columns: int) -> str:
        """Leave empty cells between brackets."""
        row = f"<tr>{'<td></td>' * columns}</tr>"
        said = f"room for an answer of {rows} rows and {columns} columns"
        return f'<table class="blank" aria-label="{said}">{row * rows}</table>'

    def page_break(self) -> str:
        """End a page."""
        return '<div class="break"></div>'
