"""A document as LaTeX source, for pdflatex and what every distribution of TeX has."""

from __future__ import annotations

from collections.abc import Sequence

from nmatrix.output.documents import Cells, blocks_in
from nmatrix.output.latex import Latex, escaped
from nmatrix.output.options import OutputOptions
from nmatrix.output.pages.document import Document, Paper
from nmatrix.report import Figure

LONG = 30  # characters from which a cell is a sentence
SIZES = {Paper.A4: "a4paper", Paper.LETTER: "letterpaper"}


def tex(document: Document) -> bytes:
    """Write the document as LaTeX source."""
    body = blocks_in(document.blocks, LatexPage(OutputOptions()))
    subtitle = rf"\\[1ex] \large {escaped(document.subtitle)}" if document.subtitle else ""
    source = rf"""\documentclass[11pt,{SIZES[document.paper]}]{{article}}
\usepackage[utf8]{{inputenc}}
\usepackage[T1]{{fontenc}}
\usepackage{{amsmath,amssymb,graphicx,tabularx}}
\usepackage[margin=18mm]{{geometry}}
\setlength{{\parindent}}{{0pt}}
\setlength{{\parskip}}{{1ex}}
\pagestyle{{myheadings}}
\markright{{{escaped(document.subtitle)}}}
\begin{{document}}
{{\Large\bfseries {escaped(document.title)}}}{subtitle}

{body}

\vfill
{{\footnotesize {escaped(document.note)}}}
\end{{document}}
"""
    return source.encode("utf-8", "replace")


class LatexPage(Latex):
    """How a page writes each kind of block."""

    def table(self, title: str, columns: Sequence[str], rows: Cells) -> str:
        """Write a table whose long columns wrap, each with its share of the line."""
        longest = [max(map(len, column)) for column in zip(columns, *rows, strict=True)]
        found = super().table(title, columns, rows)
        if max(longest, default=0) <= LONG:
            return found
        shape = "".join("X" if size > LONG else "l" for size in longest)
        plain = rf"\begin{{tabular}}{{{'l' * len(columns)}}}"
        wide = rf"\begin{{tabularx}}{{\linewidth}}{{{shape}}}"
        return found.replace(plain, wide, 1).replace(r"\end{tabular}", r"\end{tabularx}")

    def code(self, language: str, text: str) -> str:
        """Write program text, small enough for the lines that nmatrix prints."""
        return f"{{\\footnotesize\n{super().code(language, text)}\n}}"

    def figure(self, figure: Figure) -> str:
        """Write a picture; its alternative text stands in a comment."""
        comment = escaped(" ".join(figure.alternative.split()))
        include = rf"\includegraphics[width=\linewidth]{{{figure.path}}}"
        return f"% alt: {comment}\n{include}\n\n{escaped(figure.caption)}"

    def blank(self, rows: int, columns: int) -> str:
        """Leave empty cells between brackets."""
        row = " & ".join([r"\rule{0pt}{8mm}\hspace{14mm}"] * columns)
        lines = (row + r" \\ \hline ") * rows
        return rf"\begin{{tabular}}{{|{'c|' * columns}}} \hline {lines} \end{{tabular}}"

    def page_break(self) -> str:
        """End a page."""
        return r"\clearpage"
