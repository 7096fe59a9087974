"""A document as Typst source: what the PDF is made of, and what a teacher may edit."""

from __future__ import annotations

from collections.abc import Sequence

from nmatrix.output.documents import Cells, blocks_in
from nmatrix.output.formulas.spoken import matrix_in_words, spoken
from nmatrix.output.formulas.typst import matrix, typst
from nmatrix.output.pages.document import Document, Paper
from nmatrix.output.typst import Typst, escaped
from nmatrix.output.write import OutputOptions
from nmatrix.report import Figure, Formula

TOGETHER = "#block(breakable: false, width: 100%)"
SIZES = {Paper.A4: "a4", Paper.LETTER: "us-letter"}


def typ(document: Document) -> bytes:
    """Write the document as Typst source."""
    page = TypstPage(OutputOptions())
    body = "\n\n".join(
        f"{TOGETHER}[\n{blocks_in(section, page)}\n]" if whole else blocks_in(section, page)
        for section, whole in document.sections()
    )
    subtitle = (
        f"#text(fill: luma(35%))[{escaped(document.subtitle)}]\n" if document.subtitle else ""
    )
    footer = " · ".join(escaped(part) for part in (document.subtitle, document.note) if part)
    source = f"""#set document(title: {quoted(document.title)}, author: ())
#set text(lang: "en", size: 10.5pt)
#set page(
  paper: "{SIZES[document.paper]}",
  margin: 18mm,
  numbering: "1 / 1",
  footer: context [
    #set text(size: 8pt, fill: luma(35%))
    {footer} #h(1fr) #counter(page).display("1 / 1", both: true)
  ],
)
#set par(justify: false)
#let rule(x, y) = (bottom: if y == 0 {{ 0.8pt }} else {{ 0.4pt + luma(60%) }})
#set table(stroke: rule, inset: 4pt)
#show heading.where(level: 2): it => block(above: 1.6em, below: 0.8em, sticky: true)[
  #line(length: 100%, stroke: 0.4pt + luma(60%)) #it.body
]
#show math.equation.where(block: true): set block(above: 0.9em, below: 0.7em)

= {escaped(document.title)}
{subtitle}
{body}
"""
    return source.encode("utf-8", "replace")


def quoted(text: str) -> str:
    r"""Write text as a string of Typst.

    Examples
    --------
    >>> print(quoted('a "b"'))
    "a \"b\""
    """
    plain = "".join(c if c.isprintable() else " " for c in text)
    return '"' + plain.replace("\\", "\\\\").replace('"', '\\"') + '"'


class TypstPage(Typst):
    """How a page writes each kind of block; every formula says what it looks like."""

    def matrix(self, key: str, title: str, cells: Cells) -> str:
        """Write a matrix under its name."""
        about = f"#block(sticky: true)[{escaped(title)}]\n" if title else ""
        return about + _equation(f'#raw("{key}") = {matrix(cells)}', matrix_in_words(key, cells))

    def table(self, title: str, columns: Sequence[str], rows: Cells) -> str:
        """Write a table whose first row is its head."""
        head = ", ".join(f"[*{escaped(column)}*]" for column in columns)
        cells = ", ".join(f"[{cell}]" for row in rows for cell in row)
        widths = ", ".join(["auto"] * (len(columns) - 1) + ["1fr"])
        about = f"#block(sticky: true)[*{escaped(title)}*]\n" if title else ""
        return f"{about}#table(columns: ({widths},), table.header({head}), {cells})"

    def formula(self, formula: Formula) -> str:
        """Write a formula with its sentence."""
        return _equation(typst(formula.tree), spoken(formula.tree))

    def step(self, formula: Formula, because: str, *, verified: bool) -> str:
        """Write a step that stays together on a page."""
        mark = "✓" if verified else "not proved:"
        reason = f"#pad(left: 1.2em)[#text(fill: luma(30%))[{mark} {escaped(because)}]]"
        return f"{TOGETHER}[\n{self.formula(formula)}\n{reason}\n]"

    def inline(self, text: str) -> str:
        """Write a number in a sentence, which a screen reader reads as it is."""
        mantissa, mark, exponent = text.partition("e")
        return f"{mantissa} · 10#super[{int(exponent)}]" if mark else text

    def figure(self, figure: Figure) -> str:
        """Write a picture with its alternative text."""
        image = f"image({quoted(figure.path)}, alt: {quoted(figure.alternative)}, width: 100%)"
        return f"#figure({image}, caption: [{escaped(figure.caption)}], numbering: none)"

    def blank(self, rows: int, columns: int) -> str:
        """Leave empty cells between brackets."""
        cells = ", ".join(["[]"] * rows * columns)
        widths = ", ".join(["16mm"] * columns)
        thin = "0.4pt + luma(60%)"
        left = f"left: if x == 0 {{ 1pt }} else {{ {thin} }}"
        right = f"right: if x == {columns - 1} {{ 1pt }} else {{ {thin} }}"
        stroke = f"(x, y) => (top: {thin}, bottom: {thin}, {left}, {right})"
        return f"#table(columns: ({widths},), rows: 8mm, stroke: {stroke}, {cells})"

    def page_break(self) -> str:
        """End a page."""
        return "#pagebreak(weak: true)"


def _equation(body: str, said: str) -> str:
    return f"#math.equation(block: true, alt: {quoted(said)}, $ {body} $)"
