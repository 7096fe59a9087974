r"""LaTeX that compiles with pdflatex and amsmath: paste it, or wrap it in a document.

Every matrix stands behind a comment `% key: …`, by which it is read again.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from nmatrix.output.documents import Cells, Dialect, compose
from nmatrix.output.formulas.latex import bmatrix, latex
from nmatrix.output.style import spelled
from nmatrix.output.write import Charset, OutputOptions
from nmatrix.report import Formula, Report

_CHARACTERS = {
    "\\": r"\textbackslash{}",
    **{c: f"\\{c}" for c in "&%$#_{}"},
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    **{c: f"$^{{{i}}}$" for i, c in enumerate("⁰¹²³⁴⁵⁶⁷⁸⁹")},
    **{c: f"$_{{{i}}}$" for i, c in enumerate("₀₁₂₃₄₅₆₇₈₉")},
    "⁻": "$^{-}$",
    "ᵀ": r"$^{\mathsf T}$",
    "κ": r"$\kappa$",
    "σ": r"$\sigma$",
    "θ": r"$\theta$",
    "·": r"$\cdot$",
    "×": r"$\times$",
    "−": "$-$",
    "≠": r"$\neq$",
    "≤": r"$\le$",
    "≥": r"$\ge$",
    "→": r"$\to$",
    "π": r"$\pi$",
    "λ": r"$\lambda$",
    "✗": r"$\times$",
    "√": r"$\surd$",
    "°": r"$^{\circ}$",
    "∞": r"$\infty$",
    "±": r"$\pm$",
    "′": "$'$",
    "…": r"\dots{}",
    "—": "---",
    "⇒": r"$\Rightarrow$",
    "⇔": r"$\Leftrightarrow$",
}

_TWO_RAISED = re.compile(r"(?<=\$([\^_])\{[0-9\-])\}\$\$\1\{")  # A⁻ᵀ has one exponent
_TWO_FORMULAS = re.compile(r"(?<!\\)\$\$(?!')")

# What the T1 fonts have beyond Latin-1.
_EASTERN = "ĂăĄąĆćČčĎďĐđĘęĚěĞğİıĹĺĽľŁłŃńŇňŐőŔŕŘřŚśŞşŠšŢţŤťŮůŰűŸŹźŻżŽž"


def write(report: Report, options: OutputOptions) -> str:
    """Write the report as LaTeX."""
    return compose(report, Latex(options))


def symbol(key: str) -> str:
    """Write a key as a formula's name."""
    return rf"\mathtt{{{key.replace('_', chr(92) + '_')}}}"


def power_of_ten(number: str) -> str:
    r"""Write the exponent of a number as mathematics does.

    Examples
    --------
    >>> power_of_ten("1.5e-07")
    '1.5 \\times 10^{-7}'
    """
    mantissa, mark, exponent = number.partition("e")
    return rf"{mantissa} \times 10^{{{int(exponent)}}}" if mark else number


def escaped(text: str) -> str:
    r"""Escape text, so that LaTeX shows it as it is, also where its fonts lack a character.

    Examples
    --------
    >>> escaped("50 % of A⁻¹")
    '50 \\% of A$^{-1}$'
    """
    written = "".join(_CHARACTERS.get(mark) or _in_latin(mark) for mark in text)
    return _TWO_FORMULAS.sub("", _TWO_RAISED.sub("", written))


def _in_latin(mark: str) -> str:
    """Keep a letter that LaTeX's fonts have, and spell any other character in ASCII."""
    if mark.isascii() or (mark.isalpha() and mark <= "ÿ") or mark in _EASTERN:
        return mark if mark.isprintable() else " "
    return "".join(_CHARACTERS.get(c, c) for c in spelled(mark, Charset.ASCII))


class Latex(Dialect):
    """How this format writes each kind of block."""

    def heading(self, text: str) -> str:
        return rf"\section*{{{escaped(text)}}}"

    def strong(self, text: str) -> str:
        return rf"\textbf{{{escaped(text)}}}"

    def matrix(self, key: str, title: str, cells: Cells) -> str:
        about = f"{escaped(title)}\n" if title else ""
        return f"{about}% key: {key}\n\\[\n{symbol(key)} = {bmatrix(cells)}\n\\]"

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

    def number(self, text: str) -> str:
        return power_of_ten(text)

    def inline(self, text: str) -> str:
        return f"${power_of_ten(text)}$"

    def words(self, text: str) -> str:
        return escaped(text)
