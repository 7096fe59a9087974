"""A document as source: LaTeX for every distribution of TeX, Markdown for wikis and notebooks."""

from __future__ import annotations

from collections.abc import Sequence

from nmatrix.output import latex, markdown
from nmatrix.output.documents import Cells, blocks_in
from nmatrix.output.pages.document import Document, Paper
from nmatrix.output.write import OutputOptions
from nmatrix.report import Figure

LONG = 30  # characters from which a cell is a sentence
SIZES = {Paper.A4: "a4paper", Paper.LETTER: "letterpaper"}


def tex(document: Document) -> bytes:
    """Write the document as LaTeX source."""
    body = blocks_in(document.blocks, LatexPage(OutputOptions()))
    subtitle = rf"\\[1ex] \large {latex.escaped(document.subtitle)}" if document.subtitle else ""
    source = rf"""\documentclass[11pt,{SIZES[document.paper]}]{{article}}
\usepackage[utf8]{{inputenc}}
\usepackage[T1]{{fontenc}}
\usepackage{{amsmath,amssymb,graphicx,tabularx}}
\usepackage[margin=18mm]{{geometry}}
\setlength{{\parindent}}{{0pt}}
\setlength{{\parskip}}{{1ex}}
\pagestyle{{myheadings}}
\markright{{{latex.escaped(document.subtitle)}}}
\begin{{document}}
{{\Large\bfseries {latex.escaped(document.title)}}}{subtitle}

{body}

\vfill
{{\footnotesize {latex.escaped(document.note)}}}
\end{{document}}
"""
    return source.encode("utf-8", "replace")


class LatexPage(latex.Latex):
    """How a page of LaTeX writes each kind of block."""

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
        comment = latex.escaped(" ".join(figure.alternative.split()))
        include = rf"\includegraphics[width=\linewidth]{{{figure.path}}}"
        return f"% alt: {comment}\n{include}\n\n{latex.escaped(figure.caption)}"

    def blank(self, rows: int, columns: int) -> str:
        """Leave empty cells between brackets."""
        row = " & ".join([r"\rule{0pt}{8mm}\hspace{14mm}"] * columns)
        lines = (row + r" \\ \hline ") * rows
        return rf"\begin{{tabular}}{{|{'c|' * columns}}} \hline {lines} \end{{tabular}}"

    def page_break(self) -> str:
        """End a page."""
        return r"\clearpage"


def md(document: Document) -> bytes:
    """Write the document as Markdown."""
    body = blocks_in(document.blocks, MarkdownPage(OutputOptions()))
    title, subtitle = f"# {markdown.escaped(document.title)}", markdown.escaped(document.subtitle)
    parts = (title, subtitle, body, "---", markdown.escaped(document.note))
    return ("\n\n".join(part for part in parts if part) + "\n").encode("utf-8", "replace")


class MarkdownPage(markdown.Markdown):
    """How a page of Markdown writes each kind of block."""

    def figure(self, figure: Figure) -> str:
        """Write a picture with its alternative text."""
        alternative, caption = map(markdown.escaped, (figure.alternative, figure.caption))
        return f"![{alternative}]({figure.path})\n\n{caption}"

    def page_break(self) -> str:
        """Draw a rule."""
        return "---"
