"""Markdown with LaTeX formulas between dollars, as notebooks and wikis show them."""

from __future__ import annotations

from collections.abc import Sequence

from nmatrix.output.documents import Cells, Dialect, compose
from nmatrix.output.formulas.latex import bmatrix, latex
from nmatrix.output.latex import power_of_ten, symbol
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

    def matrix(self, key: str, title: str, cells: Cells) -> str:
        about = f" ({escaped(title)})" if title else ""
        return f"`{key}`{about}\n\n$$\n{symbol(key)} = {bmatrix(cells)}\n$$"

    def scalar(self, key: str, title: str, value: str) -> str:
        return f"`{key}`{f' ({escaped(title)})' if title else ''}: {value}"

    def table(self, title: str, columns: Sequence[str], rows: Cells) -> str:
        head = [escaped(column) for column in columns]
        lines = [head, ["---"] * len(columns), *rows]
        body = "\n".join(f"| {' | '.join(line)} |" for line in lines)
        return f"{escaped(title)}\n\n{body}" if title else body

    def formula(self, formula: Formula) -> str:
        return f"$$\n{latex(formula.tree)}\n$$"

    def number(self, text: str) -> str:
        return power_of_ten(text)

    def inline(self, text: str) -> str:
        return f"${power_of_ten(text)}$" if "e" in text else text

    def words(self, text: str) -> str:
        return escaped(text)


def escaped(text: str) -> str:
    """Escape text, so that Markdown shows it as it is."""
    return "".join(f"\\{c}" if c in "\\`*_{}[]<>#|$" else c for c in text)
