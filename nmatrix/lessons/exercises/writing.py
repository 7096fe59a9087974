"""Exact numbers on paper: fractions as fractions, matrices as formulas, answers as typed text."""

from __future__ import annotations

import re
from collections.abc import Sequence
from fractions import Fraction

from nmatrix.lessons.formulas import beside
from nmatrix.lessons.formulas.mathml import MATH, mathml
from nmatrix.lessons.formulas.parse import parse
from nmatrix.lessons.formulas.spoken import spoken
from nmatrix.lessons.formulas.tree import Grid, Node, Row
from nmatrix.lessons.formulas.typst import typst
from nmatrix.linear.rational import RationalMatrix
from nmatrix.report import Formula

MINUS = "−"
LARGEST_BOTTOM = 1000  # of a fraction that is written as one


def written(value: Fraction) -> str:
    """Return a number as one writes it by hand.

    Examples
    --------
    >>> written(Fraction(-1, 2)), written(Fraction(3))
    ('−1/2', '3')
    """
    shown = str(value) if value.denominator <= LARGEST_BOTTOM else f"{float(value):.4f}"
    return shown.replace("-", MINUS)


def typed(rows: RationalMatrix) -> str:
    """Return numbers as a student might type them, exactly where they are short."""
    return "; ".join(" ".join(map(_typed, row)) for row in rows)


def _typed(value: Fraction) -> str:
    return str(value) if value.denominator <= LARGEST_BOTTOM else f"{float(value):.9f}"


def column(values: Sequence[Fraction]) -> RationalMatrix:
    """Return a vector as a column."""
    return tuple((value,) for value in values)


def equation(*parts: str | RationalMatrix) -> Formula:
    """Return a line of words and matrices as a formula.

    Examples
    --------
    >>> equation("n = ", ((Fraction(1, 2), Fraction(-1)),)).text
    'n = [ 1/2  −1 ]'
    """
    items: list[Node] = []
    text: list[list[str]] = []
    latex = []
    for part in parts:
        if isinstance(part, str):
            items.append(parse(part))
            text.append([part])
            latex.append(_latex_line(part))
        else:
            cells = [[written(entry) for entry in row] for row in part]
            items.append(Grid(tuple(tuple(map(parse, row)) for row in cells)))
            text.append(beside.matrix(cells))
            latex.append(_latex_matrix(part))
    node = Row(tuple(items))
    said = spoken(node)
    return Formula(
        text=beside.side_by_side(text),
        latex="".join(latex),
        mathml=f'{MATH} alttext="{said}">{mathml(node)}</math>',
        typst=typst(node),
        spoken=said,
    )


LATEX = {
    "−": "-",
    "·": r"\cdot ",
    "⁻¹": "^{-1}",
    "⁻ᵀ": r"^{-\mathsf T}",
    "ᵀ": r"^{\mathsf T}",
    "≠": r"\neq ",
    "det": r"\det ",
    "′": "'",
}


_WORD = re.compile(r"(?<!\\)\b(?!det\b)[a-z]{3,}\b")


def _latex_line(line: str) -> str:
    line = _WORD.sub(lambda word: rf"\mathrm{{{word[0]}}}", line)
    for sign, command in LATEX.items():
        line = line.replace(sign, command)
    return line


def _latex_matrix(rows: RationalMatrix) -> str:
    body = r" \\ ".join(" & ".join(map(_latex_number, row)) for row in rows)
    return rf"\begin{{bmatrix}} {body} \end{{bmatrix}}"


def _latex_number(value: Fraction) -> str:
    if value.denominator == 1 or value.denominator > LARGEST_BOTTOM:
        return written(value).replace(MINUS, "-")
    sign = "-" if value < 0 else ""
    return rf"{sign}\tfrac{{{abs(value.numerator)}}}{{{value.denominator}}}"
