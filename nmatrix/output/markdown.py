"""Markdown with LaTeX formulas between dollars, as notebooks and wikis show them."""

from __future__ import annotations

from collections.abc import Sequence

from nmatrix.formula import Node, Numeral
from nmatrix.output.documents import Cells, Dialect, compose
from nmatrix.output.formulas.latex import latex
from nmatrix.output.write import OutputOptions
from nmatrix.report import Formula, Report


def write(report: Report, options: OutputOptions) -> str:
    """Write the report as Markdown."""
    return compose(report, Markdown(options))


class Markdown(Dialect):
    """How this format writes each kind of block."""

    def heading(self, text: str) -> str:
        return f"## {escaped(text)}"

    def strong(self, text: str) -> str:
        return f"**{escaped(text)}**"

    def matrix(self, key: str, title: str, equation: Node) -> str:
        about = f"{escaped(title)}\n\n" if title else ""
        return f"{about}<!-- key: {key} -->\n$$\n{latex(equation)}\n$$"

    def table(self, title: str, columns: Sequence[str], rows: Cells) -> str:
        head = [escaped(column) for column in columns]
        lines = [head, ["---"] * len(columns), *rows]
        body = "\n".join(f"| {' | '.join(line)} |" for line in lines)
        return f"{escaped(title)}\n\n{body}" if title else body

    def formula(self, formula: Formula) -> str:
        return f"$$\n{latex(formula.tree)}\n$$"

    def inline(self, node: Node) -> str:
        return node.text if isinstance(node, Numeral) else f"${latex(node)}$"

    def words(self, text: str) -> str:
        return escaped(text)


def escaped(text: str) -> str:
    """Escape text, so that Markdown shows it as it is."""
    return "".join(f"\\{c}" if c in "\\`*_{}[]<>#|$" else c for c in text)
