r"""LaTeX that compiles with pdflatex and amsmath: paste it, or wrap it in a document.

Every matrix stands behind a comment `% key: …`, by which it is read again.
"""

from __future__ import annotations

from collections.abc import Sequence

from nmatrix.formula import Node
from nmatrix.output.documents import Cells, Dialect, compose
from nmatrix.output.formulas.latex import latex
from nmatrix.output.formulas.latex_words import escaped
from nmatrix.output.write import OutputOptions
from nmatrix.report import Formula, Report


def write(report: Report, options: OutputOptions) -> str:
    """Write the report as LaTeX."""
    return compose(report, Latex(options))


class Latex(Dialect):
    """How this format writes each kind of block."""

    def heading(self, text: str) -> str:
        return rf"\section*{{{escaped(text)}}}"

    def strong(self, text: str) -> str:
        return rf"\textbf{{{escaped(text)}}}"

    def matrix(self, key: str, title: str, equation: Node) -> str:
        about = f"{escaped(title)}\n" if title else ""
        return f"{about}% key: {key}\n\\[\n{latex(equation)}\n\\]"

    def table(self, title: str, columns: Sequence[str], rows: Cells) -> str:
        lines = [[escaped(column) for column in columns], *rows]
        body = " \\\\\n".join(" & ".join(row) for row in lines)
        head = f"{escaped(title)}\n\n" if title else ""
        return f"{head}\\begin{{tabular}}{{{'l' * len(columns)}}}\n{body}\n\\end{{tabular}}"

    def formula(self, formula: Formula) -> str:
        return f"\\[\n{latex(formula.tree)}\n\\]"

    def code(self, language: str, text: str) -> str:
        return f"\\begin{{verbatim}}\n{text.rstrip()}\n\\end{{verbatim}}"

    def remarks(self, remarks: Sequence[str]) -> str:
        items = "\n".join(rf"  \item {escaped(remark)}" for remark in remarks)
        return f"\\begin{{itemize}}\n{items}\n\\end{{itemize}}"

    def inline(self, node: Node) -> str:
        return f"${latex(node)}$"

    def words(self, text: str) -> str:
        return escaped(text)
