"""Typst markup: matrices as `mat(…)` in square brackets."""

from __future__ import annotations

import re
from collections.abc import Sequence

from nmatrix.formula import Node
from nmatrix.output.documents import Cells, Dialect, compose
from nmatrix.output.formulas.typst import typst
from nmatrix.output.write import OutputOptions
from nmatrix.report import Formula, Report

_LISTLIKE = re.compile(r"^(\s*(?:[0-9]+)?)([-+.])", re.MULTILINE)


def write(report: Report, options: OutputOptions) -> str:
    """Write the report as Typst."""
    return compose(report, Typst(options))


class Typst(Dialect):
    """How this format writes each kind of block."""

    def heading(self, text: str) -> str:
        return f"== {escaped(text)}"

    def strong(self, text: str) -> str:
        return f"*{escaped(text)}*"

    def matrix(self, key: str, title: str, equation: Node) -> str:
        about = f"{escaped(title)}\n" if title else ""
        return f"{about}// key: {key}\n$ {typst(equation)} $"

    def table(self, title: str, columns: Sequence[str], rows: Cells) -> str:
        lines = [[escaped(column) for column in columns], *rows]
        cells = [f"[{cell}]" for line in lines for cell in line]
        head = f"{escaped(title)}\n\n" if title else ""
        return f"{head}#table(columns: {len(columns)}, {', '.join(cells)})"

    def formula(self, formula: Formula) -> str:
        return f"$ {typst(formula.tree)} $"

    def inline(self, node: Node) -> str:
        return f"${typst(node)}$"

    def words(self, text: str) -> str:
        return escaped(text)


def escaped(text: str) -> str:
    """Escape text, so that Typst shows it as it is, also where a line begins like a list."""
    shown = "".join(f"\\{c}" if c in "\\#$*_`<>@[]=~/\"'" else c for c in text)
    return _LISTLIKE.sub(r"\1\\\2", shown)
