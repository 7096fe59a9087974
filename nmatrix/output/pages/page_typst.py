"""A document as Typst source: what the PDF is made of, and what a teacher may edit."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain

from nmatrix.formula import Node, Numeral
from nmatrix.output.documents import Cells, blocks_in
from nmatrix.output.formulas.spoken import spoken
from nmatrix.output.formulas.typst import quoted, typst
from nmatrix.output.mathml import ON_THE_LINE, PRODUCT
from nmatrix.output.pages.document import (
    ANSWER_HIGH,
    ANSWER_WIDE,
    DOTS_APART,
    INK_ON_PAPER,
    SHORT_TABLE,
    Document,
    Field,
    Paper,
    shares,
)
from nmatrix.output.spelling import RAISED
from nmatrix.output.typst import Typst, escaped
from nmatrix.output.write import OutputOptions
from nmatrix.report import Blank, Figure, Formula, Task

SIZES = {Paper.A4: "a4", Paper.LETTER: "us-letter"}
BOTH = {"1": "false", "1 / 1": "true"}
LOOK = f"""#set text(lang: "en", size: 10.5pt, font: "Libertinus Serif")
#set par(justify: false, leading: 0.6em, spacing: 0.85em)
#set super(typographic: false)
#let ink = rgb("{INK_ON_PAPER.ink}")
#let soft = rgb("{INK_ON_PAPER.soft}")
#let thin = 0.5pt + rgb("{INK_ON_PAPER.rule}")
#let sans(size, ..style, body) = text(font: "DejaVu Sans", size: size, ..style, body)
#let together(body) = block(breakable: false, width: 100%, body)
#let fill-in(width) = box(width: width, baseline: 1.5pt, line(length: 100%, stroke: 0.5pt))
#let head(..parts, last) = {{
  sans(9pt, grid(
    columns: (2fr, 1fr), align: (left, right),
    parts.pos().map(box).join(h(1.2em, weak: true)), last,
  ))
  v(-0.4em)
  line(length: 100%, stroke: 0.5pt)
}}
#let framed(body) = block(
  breakable: false, width: 100%, inset: (x: 10pt, y: 9pt), fill: rgb("{INK_ON_PAPER.body}"),
  stroke: (left: 3pt + ink), body,
)
#let symbols(..cells) = block(breakable: false, grid(
  columns: (auto, 1fr, auto, 1fr), column-gutter: (10pt, 18pt), row-gutter: 6.5pt, ..cells,
))
#let points(most) = box(stroke: 0.5pt, inset: 5pt, sans(9pt)[#h(2.2em) / #most])
#let task(title, most, body) = block(breakable: false, width: 100%, above: 1.2em)[
  #set par(spacing: 0.62em)
  #grid(columns: (1fr, auto), align: (left + bottom, right), title, points(most))
  #body
]
#let room = block(
  width: 100%, height: room-high, stroke: thin,
  fill: tiling(size: ({DOTS_APART}mm, {DOTS_APART}mm), place(
    dx: {DOTS_APART // 2}mm, dy: {DOTS_APART // 2}mm, circle(radius: 0.2mm, fill: luma(60%)),
  )),
)
#let answer = box(
  width: {ANSWER_WIDE}mm, height: {ANSWER_HIGH}mm, stroke: (bottom: 0.5pt + ink),
)
#let rule(x, y) = (bottom: if y == 0 {{ 0.8pt }} else {{ thin }})
#set table(stroke: rule, inset: (x: 4pt, y: 4.5pt))
#show table.cell.where(y: 0): set text(font: "DejaVu Sans", size: 8.5pt, weight: "bold")
#show figure.caption: set text(size: 9.5pt)
#show figure.caption: set align(left)
#show raw.where(block: true): block.with(
  breakable: false, width: 100%, inset: 7pt, fill: luma(95%),
)
#show heading.where(level: 1): it => block(above: 0.7em, below: 0.5em, sans(16pt, it.body))
#show heading.where(level: 2): it => block(
  above: 1.5em, below: 0.8em, sticky: true, sans(12pt, it.body),
)
#show math.equation.where(block: true): set block(above: 0.9em, below: 0.8em)"""


def typ(document: Document) -> bytes:
    """Write the document as Typst source."""
    return typ_of((document,), document.title)


def typ_of(documents: Sequence[Document], title: str) -> bytes:
    """Write documents as one source, each from a right-hand page on and with its own foot."""
    is_alone = len(documents) == 1
    pages = (_pages(one, "1 / 1" if is_alone else "1") for one in documents)
    body = "\n\n".join(pages) if is_alone else "\n".join(map(_on_its_own, pages))
    source = f"""#set document(title: {quoted(title)}, author: ())
#let room-high = {documents[0].paper.room}mm
{LOOK}

{body}
"""
    return source.encode("utf-8", "replace")


def _on_its_own(pages: str) -> str:
    """Begin on a right-hand page, so that two-sided sheets part, and count pages anew."""
    return f'#pagebreak(weak: true, to: "odd")\n#[\n{pages}\n]'


def _pages(document: Document, numbers: str) -> str:
    """Write the pages of a document; `numbers` is the pattern of their numbers."""
    body = blocks_in(document.blocks, TypstPage(OutputOptions()))
    head = f"#head{''.join(f'[{_field(one)}]' for one in document.head)}\n" * bool(document.head)
    return f"""#set page(
  paper: "{SIZES[document.paper]}",
  margin: (x: 18mm, top: 11mm, bottom: 15mm),
  numbering: "{numbers}",
  footer: context [
    #set text(size: 8pt, fill: luma(25%))
    {escaped(document.foot)} #h(1fr) #counter(page).display("{numbers}", both: {BOTH[numbers]})
  ],
)
{"#counter(page).update(1)" if numbers == "1" else ""}

{head}= {prose(document.title)}

{body}"""


def _field(field: Field) -> str:
    label = f"{escaped(field.label)} " if field.label else ""
    return label + (escaped(field.value) if field.value else f"#fill-in({field.room}mm)")


def prose(text: str) -> str:
    r"""Write words for a page, with exponents raised by markup: fonts differ in where ᵀ stands.

    Examples
    --------
    >>> print(prose("AᵀA"))
    A#super[T];A
    """
    joined = PRODUCT.sub("\\1\N{NO-BREAK SPACE}\\2", text)
    return RAISED.sub(lambda run: f"#super[{run[0].translate(ON_THE_LINE)}];", escaped(joined))


class TypstPage(Typst):
    """How a page writes each kind of block; every formula says what it looks like."""

    def heading(self, text: str) -> str:
        """Write a heading."""
        return f"== {prose(text)}"

    def paragraph(self, text: str) -> str:
        """Write a paragraph; one that leads to something stays on the page of it."""
        return f"#block(sticky: true)[{prose(text)}]" if text.endswith(":") else prose(text)

    def strong(self, text: str) -> str:
        """Write the one-line conclusion."""
        return f"*{prose(text)}*"

    def words(self, text: str) -> str:
        """Escape a text, so that it is shown as it is."""
        return prose(text)

    def matrix(self, key: str, title: str, equation: Node) -> str:
        """Write a matrix under its name."""
        about = f"#block(sticky: true)[{escaped(title)}]\n" if title else ""
        return about + _equation(equation)

    def table(self, title: str, columns: Sequence[str], rows: Cells) -> str:
        """Write a table whose first row is its head; a short one stays on its page."""
        head = ", ".join(f"[{prose(column)}]" for column in columns)
        cells = ", ".join(f"[{cell}]" for row in rows for cell in row)
        widths = ", ".join(f"{share:.3f}fr" for share in shares(columns, rows))
        about = f"#block(sticky: true)[*{prose(title)}*]\n" if title else ""
        table = f"#table(columns: ({widths},), table.header({head}), {cells})"
        return f"#together[\n{about}{table}\n]" if len(rows) <= SHORT_TABLE else about + table

    def formula(self, formula: Formula) -> str:
        """Write a formula with its sentence."""
        return _equation(formula.tree)

    def inline_formula(self, formula: Formula) -> str:
        """Write a formula among words, with its sentence."""
        return _among_words(formula.tree)

    def step(self, formula: Formula, because: str, *, verified: bool) -> str:
        """Write a step that stays together on a page."""
        mark = "✓" if verified else "not proved:"
        reason = f"#pad(left: 1.2em)[#text(fill: soft)[{mark} {prose(because)}]]"
        return f"#together[\n{self.formula(formula)}\n{reason}\n]"

    def inline(self, node: Node) -> str:
        """Write a number in a sentence; a screen reader reads a decimal as it is."""
        return node.text if isinstance(node, Numeral) else _among_words(node)

    def figure(self, figure: Figure) -> str:
        """Write a picture with its alternative text."""
        image = f"image({quoted(figure.path)}, alt: {quoted(figure.alternative)}, width: 100%)"
        title = f"*{prose(figure.title)}.* " if figure.title else ""
        return f"#figure({image}, caption: [{title}{prose(figure.caption)}], numbering: none)"

    def symbols(self, meanings: Sequence[tuple[str, str]]) -> str:
        """Write letters and their words in two columns, read downwards."""
        half = (len(meanings) + 1) // 2
        pairs = zip(meanings, (*meanings[half:], ("", "")), strict=False)
        cells = chain.from_iterable((*left, *right) for left, right in list(pairs)[:half])
        return f"#symbols({', '.join(f'[{cell}]' for cell in cells)})"

    def framed(self, body: str) -> str:
        """Put a bar beside some blocks, and a tint behind them."""
        return f"#framed[\n{body}\n]"

    def blank(self, blank: Blank) -> str:
        """Leave dotted room to work, and lines for the answer."""
        room = "#room\n" if blank.has_room else ""
        if blank.names:
            names = (
                f"#emph[{name}] \\= #answer" if name else "Answer #answer" for name in blank.names
            )
            return f"{room}#block[{' #h(1em) '.join(names)}]"
        lines = ", ".join(["answer"] * blank.rows * blank.columns)
        widths = ", ".join(["auto"] * blank.columns)
        grid = f"grid(columns: ({widths},), column-gutter: 4mm, {lines})"
        sides = "stroke: (left: 1pt, right: 1pt), inset: (x: 2mm, bottom: 2mm)"
        return f"{room}#block({sides}, {grid})"

    def task(self, task: Task, body: str) -> str:
        """Write an exercise that stays on its page, with a box for its points."""
        most = "" if task.points is None else str(task.points)
        return f"#task[== {prose(task.title)}][{most}][\n{body}\n]"

    def page_break(self) -> str:
        """End a page."""
        return "#pagebreak(weak: true)"


def _equation(node: Node) -> str:
    return f"#math.equation(block: true, alt: {quoted(spoken(node))}, $ {typst(node)} $)"


def _among_words(node: Node) -> str:
    return f"#math.equation(alt: {quoted(spoken(node))}, ${typst(node)}$)"
