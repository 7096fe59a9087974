"""A formula in every way to show or say it, all from the same parts: words and matrices."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from typing import TYPE_CHECKING, TypeAlias

from nmatrix.lessons.formulas import beside
from nmatrix.lessons.formulas.mathml import LOWERED, MATH, mathml
from nmatrix.lessons.formulas.parse import APART as SET_APART
from nmatrix.lessons.formulas.parse import RAISED, parse
from nmatrix.lessons.formulas.spoken import spoken
from nmatrix.lessons.formulas.tree import Grid, Node, Row
from nmatrix.lessons.formulas.typst import typst
from nmatrix.report import Formula

if TYPE_CHECKING:
    import sympy as sp


@dataclass(frozen=True)
class Words:
    """A fixed piece of a formula, written for each way to show it."""

    text: str
    latex: str


Part: TypeAlias = "Words | sp.Expr | sp.MatrixBase"


EQUALS = Words(" = ", " = ")
NOT_EQUAL = Words(" ≠ ", r" \neq ")
IMPLIES = Words("  ⇒  ", r" \;\Rightarrow\; ")
A = Words("A", "A")
A_T = Words("Aᵀ", r"A^{\mathsf T}")
A_INVERSE_T = Words("A⁻ᵀ", r"A^{-\mathsf T}")
C = Words("C", "C")
N = Words("N", "N")
DET = Words("det A", r"\det A")
IDENTITY = Words("I", "I")
APART = Words(SET_APART, r",\; ")  # between two statements


def words(text: str, latex: str | None = None) -> Words:
    """Return a piece that reads alike in both."""
    if latex is None:
        latex = text.replace("−", "-").replace("·", r"\cdot")
    return Words(text, latex)


def formula(*parts: Part) -> Formula:
    r"""Return a formula whose parts stand side by side, matrices over several lines.

    Examples
    --------
    >>> formula(A, EQUALS, IDENTITY).latex
    'A = I'
    """
    node = tree(parts)
    said = spoken(node)
    return Formula(
        text=beside.side_by_side([_text(part) for part in parts]),
        latex="".join(_latex(part) for part in parts),
        mathml=f'{MATH} alttext="{escape(said)}">{mathml(node)}</math>',
        typst=typst(node),
        spoken=said,
    )


def tree(parts: Sequence[Part]) -> Node:
    """Return the parts as one tree; what stands between two matrices is read as one line."""
    found: list[Node] = []
    line = ""
    for part in parts:
        cells = _cells(part)
        if cells is None:
            line += _text(part)[0]
            continue
        found += _parsed(line)
        line = ""
        found.append(Grid(tuple(tuple(map(parse, row)) for row in cells)))
    return Row((*found, *_parsed(line)))


def _parsed(line: str) -> list[Node]:
    if not line.strip():
        return []
    node = parse(line)
    return list(node.items) if isinstance(node, Row) else [node]


def _cells(part: Part) -> list[list[str]] | None:
    """Return a matrix as texts, or None for anything else."""
    if isinstance(part, Words) or not hasattr(part, "tolist"):
        return None
    return [[_plain(entry) for entry in row] for row in part.tolist()]


def _text(part: Part) -> list[str]:
    if isinstance(part, Words):
        return [part.text]
    cells = _cells(part)
    return [_plain(part)] if cells is None else beside.matrix(cells)


_ROOT = re.compile(r"sqrt\((\d+)\)")
_INDEX = re.compile(r"_(\d)")
_ZEROS = re.compile(r"(/|(?<!\d))(\d*?[1-9])(0{15,})(?!\d)")
_LOWERED = str.maketrans("0123456789", LOWERED)
_RAISED = str.maketrans("0123456789", RAISED[:10])


def _plain(expression: sp.Expr) -> str:
    """Return an expression as one types it: √3/2, s₁ for s_1, 10²⁰ for a one with twenty zeros."""
    text = _ZEROS.sub(_typed_power, _ROOT.sub(r"√\1", str(expression)))
    return (
        _INDEX.sub(lambda found: found[1].translate(_LOWERED), text)
        .replace("**2", "²")
        .replace("**3", "³")
        .replace("**", "^")
        .replace("*", "·")
        .replace("sqrt", "√")
        .replace("-", "−")
        .replace("kappa", "κ")
        .replace("_", "")
    )


def _typed_power(number: re.Match[str]) -> str:
    slash, factor, zeros = number.groups()
    power = f"10{str(len(zeros)).translate(_RAISED)}"
    if factor == "1":
        return slash + power
    return f"/({factor}*{power})" if slash else f"{factor}*{power}"


def _latex_power(number: re.Match[str]) -> str:
    slash, factor, zeros = number.groups()
    product = "" if factor == "1" else rf"{factor} \cdot "
    return f"{slash}{product}10^{{{len(zeros)}}}"


def _latex(part: Part) -> str:
    if isinstance(part, Words):
        return part.latex
    import sympy as sp

    return _ZEROS.sub(_latex_power, str(sp.latex(part, mat_delim="", mat_str="bmatrix")))
