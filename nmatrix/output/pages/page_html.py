"""A document as one HTML file: native MathML, its own font and pictures, no network, no script."""

from __future__ import annotations

import re
from base64 import b64encode
from collections.abc import Sequence
from functools import cache
from html import escape
from importlib.resources import files

from nmatrix.canvas.theme import PALETTES
from nmatrix.enums import Theme
from nmatrix.output.documents import Cells, blocks_in
from nmatrix.output.mathml import StyledMathML, prose
from nmatrix.output.pages.document import (
    ANSWER_HIGH,
    ANSWER_WIDE,
    DOTS_APART,
    SHORT_TABLE,
    Document,
    Field,
    Paper,
)
from nmatrix.output.write import OutputOptions
from nmatrix.report import Blank, Figure, Task

POLICY = "default-src 'none'; style-src 'unsafe-inline'; img-src data:; font-src data:"
SIZES = {Paper.A4: "A4", Paper.LETTER: "letter"}
LENGTHS = {
    "ANSWER_WIDE": ANSWER_WIDE,
    "ANSWER_HIGH": ANSWER_HIGH,
    "DOTS_APART": DOTS_APART,
}
_NOT_OF_A_PAGE = re.compile(
    r'^.*?(?=<svg)|<metadata>.*?</metadata>|<title>.*?</title>| id="(?:figure|patch)_[0-9]+"',
    re.DOTALL,
)
_NEEDLESS_DIGITS = re.compile(r"(\d\.\d)\d+")  # a tenth of a unit is a hundredth of a millimetre
_SIZE = re.compile(r'(<svg[^>]*?) width="[^"]*" height="[^"]*"')


def html(document: Document) -> bytes:
    """Write the document as one self-contained file."""
    body = blocks_in(document.blocks, HtmlPage(document))
    head = f'<header class="head">{"".join(map(_field, document.head))}</header>'
    page = f"""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{POLICY}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{escape(document.title)}</title>
<style>
{_style(document.paper)}{_foot(document.foot)}</style>
</head>
<body>
<main>
{head if document.head else ""}
<h1>{prose(document.title)}</h1>
{body}
</main>
<footer>{escape(document.foot)}</footer>
</body>
</html>
"""
    return page.encode("utf-8", "replace")


def _field(field: Field) -> str:
    label = f"{escape(field.label)} " if field.label else ""
    line = f'<i class="line" style="width: {field.room}mm"></i>'
    return f"<span>{label}{escape(field.value) if field.value else line}</span>"


@cache
def _style(paper: Paper) -> str:
    """Fill the colours, the lengths, the font and the paper into the style sheet."""
    folder = files(__package__)
    style = folder.joinpath("style.css").read_text(encoding="utf-8")
    for theme, palette in PALETTES.items():
        named = (f"--{name}: {colour};" for name, colour in palette.named.items())
        style = style.replace(f"{theme.name}_COLOURS", " ".join(named))
    for name, length in {**LENGTHS, "ROOM_HIGH": paper.room}.items():
        style = style.replace(name, f"{length}mm")
    font = b64encode(folder.joinpath("math.woff2").read_bytes()).decode()
    return style.replace("PAPER_SIZE", SIZES[paper]).replace("MATH_FONT", font)


def _foot(text: str) -> str:
    """Print a line and a number on every page: sheets get dropped."""
    page = 'counter(page) " / " counter(pages)'
    shown = "".join(c if c.isalnum() and c.isascii() else f"\\{ord(c):x} " for c in text)
    style = "font: 8pt serif; color: #3a3a3a;"
    return (
        f'@page {{ @bottom-left {{ content: "{shown}"; {style} white-space: nowrap; }} '
        f"@bottom-right {{ content: {page}; {style} }} }}\n"
    )


def inline(svg: bytes) -> str:
    """Turn an SVG file into elements of a page, as wide as the page lets them be.

    A drawing in the light theme follows the page's theme; a picture that holds pixels does not.
    """
    found = _SIZE.sub(r"\1", _NOT_OF_A_PAGE.sub("", svg.decode())).strip()
    found = _NEEDLESS_DIGITS.sub(r"\1", found).replace(" \n", " ")
    if "<image" in found:
        return found
    for name, colour in PALETTES[Theme.LIGHT].named.items():
        found = found.replace(colour.lower(), f"var(--{name})")
    return found


class HtmlPage(StyledMathML):
    """How a page writes each kind of block."""

    def __init__(self, document: Document) -> None:
        super().__init__(OutputOptions())
        self.pictures = document.pictures

    def paragraph(self, text: str) -> str:
        """Write a paragraph; one that leads to something stays on the page of it."""
        kind = ' class="leads"' if text.endswith(":") else ""
        return f"<p{kind}>{prose(text)}</p>"

    def table(self, title: str, columns: Sequence[str], rows: Cells) -> str:
        """Write a table; a short one stays on its page, the head of a long one is on each."""
        table = super().table(title, columns, rows)
        if len(rows) > SHORT_TABLE:
            return table
        return table.replace('class="wide"', 'class="wide together"', 1)

    def figure(self, figure: Figure) -> str:
        """Write a picture with its alternative text; a drawing follows the page's theme."""
        content, said = self.pictures[figure.path], escape(figure.alternative)
        if figure.path.endswith(".svg"):
            image = f'<div role="img" aria-label="{said}">{inline(content)}</div>'
        else:
            data = b64encode(content).decode()
            image = f'<img src="data:image/png;base64,{data}" alt="{said}">'
        title = f"<b>{prose(figure.title)}.</b> " if figure.title else ""
        caption = title + prose(figure.caption)
        return f"<figure>{image}<figcaption>{caption}</figcaption></figure>"

    def blank(self, blank: Blank) -> str:
        """Leave dotted room to work, and lines for the answer."""
        room = '<div class="room" role="img" aria-label="room to work"></div>\n'
        rows, columns, line = blank.rows, blank.columns, '<i class="answer"></i>'
        if blank.names:
            names = (f"<i>{name}</i> =" if name else "Answer" for name in blank.names)
            body = "".join(f"<span>{name} {line}</span>" for name in names)
            answer = f'<p class="answers">{body}</p>'
        else:
            row = f"<tr>{f'<td>{line}</td>' * columns}</tr>"
            said = f"room for an answer of {rows} rows and {columns} columns"
            answer = f'<table class="blank" aria-label="{said}">{row * rows}</table>'
        return room * blank.has_room + answer

    def task(self, task: Task, body: str) -> str:
        """Write an exercise that stays on its page, with a box for its points."""
        most = "" if task.points is None else str(task.points)
        title = f"<h2>{prose(task.title)}</h2>"
        points = f'<span class="points">/ {most}</span>'
        return f'<section class="task"><header>{title}{points}</header>\n{body}\n</section>'

    def page_break(self) -> str:
        """End a page."""
        return '<div class="break"></div>'
