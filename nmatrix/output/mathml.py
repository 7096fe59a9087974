"""MathML in a fragment of HTML: formulas that browsers show without any script."""

from __future__ import annotations

import re
from collections.abc import Sequence
from html import escape

from nmatrix.formula import Node, Numeral
from nmatrix.output.documents import Cells, Dialect, compose
from nmatrix.output.formulas.mathml import equation as displayed
from nmatrix.output.formulas.mathml import inline, mathml
from nmatrix.output.formulas.spoken import spoken
from nmatrix.output.spelling import RAISED
from nmatrix.output.write import OutputOptions
from nmatrix.report import Formula, Report

ON_THE_LINE = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻ᵀ", "0123456789−T")
PRODUCT = re.compile(r"\b([A-Z][⁻ᵀ¹]*) ([a-z])\b")


def write(report: Report, options: OutputOptions) -> str:
    """Write the report as HTML with MathML."""
    return compose(report, MathML(options))


def prose(text: str) -> str:
    r"""Write words for a page; exponents by markup, since not every font has ᵀ where it belongs.

    A matrix and its vector stay on one line.

    Examples
    --------
    >>> prose("A⁻ᵀ n < 1")
    'A<sup>−T</sup>\xa0n &lt; 1'
    """
    joined = PRODUCT.sub("\\1\N{NO-BREAK SPACE}\\2", text)
    return RAISED.sub(lambda run: f"<sup>{run[0].translate(ON_THE_LINE)}</sup>", escape(joined))


class MathML(Dialect):
    """How this format writes each kind of block."""

    def heading(self, text: str) -> str:
        return f"<h2>{prose(text)}</h2>"

    def paragraph(self, text: str) -> str:
        return f"<p>{prose(text)}</p>"

    def strong(self, text: str) -> str:
        return f"<p><strong>{prose(text)}</strong></p>"

    def matrix(self, key: str, title: str, equation: Node) -> str:
        about = f"<p>{prose(title)}</p>\n" if title else ""
        return about + displayed(mathml(equation), spoken(equation), key)

    def scalar(self, title: str, value: str) -> str:
        return f"<p>{prose(title)}: {value}</p>"

    def table(self, title: str, columns: Sequence[str], rows: Cells) -> str:
        caption = f"<caption>{prose(title)}</caption>" if title else ""
        head = "".join(f"<th>{prose(column)}</th>" for column in columns)
        body = "".join(f"<tr>{''.join(f'<td>{cell}</td>' for cell in row)}</tr>" for row in rows)
        return f"<table>{caption}<tr>{head}</tr>{body}</table>"

    def formula(self, formula: Formula) -> str:
        return displayed(mathml(formula.tree), spoken(formula.tree))

    def code(self, language: str, text: str) -> str:
        return f'<pre><code class="language-{escape(language)}">{escape(text)}</code></pre>'

    def remarks(self, remarks: Sequence[str]) -> str:
        items = "".join(f"<li>{prose(remark)}</li>" for remark in remarks)
        return f"<ul>{items}</ul>"

    def inline(self, node: Node) -> str:
        if isinstance(node, Numeral):
            return escape(node.text)
        return inline(mathml(node), spoken(node))

    def words(self, text: str) -> str:
        return prose(text)


class StyledMathML(MathML):
    """How pages with a style sheet write what bare elements cannot tell apart."""

    def table(self, title: str, columns: Sequence[str], rows: Cells) -> str:
        """Write a table that scrolls by itself where there is little room."""
        table = super().table(title, columns, rows)
        table = table.replace("<tr>", "<thead><tr>", 1).replace("</tr>", "</tr></thead>", 1)
        return f'<div class="wide">{table}</div>'

    def step(self, formula: Formula, because: str, *, verified: bool) -> str:
        """Write a step that stays together on a page."""
        mark = "proved" if verified else "unproved"
        words = because if verified else f"not proved: {because}"
        return (
            f'<div class="step">{self.formula(formula)}<p class="{mark}">{prose(words)}</p></div>'
        )

    def inline_formula(self, formula: Formula) -> str:
        """Write a formula among words."""
        return inline(mathml(formula.tree), spoken(formula.tree))

    def symbols(self, meanings: Sequence[tuple[str, str]]) -> str:
        """Write letters and their words in two columns, one on a phone."""
        entries = "".join(f"<div><dt>{a}</dt><dd>{b}</dd></div>" for a, b in meanings)
        return f'<dl class="symbols">{entries}</dl>'

    def framed(self, body: str) -> str:
        """Put a bar beside some blocks, and a tint behind them."""
        return f'<div class="framed">\n{body}\n</div>'
