"""A formula as Typst mathematics."""

from __future__ import annotations

from nmatrix.lessons.formulas.mathml import LOWERED, PLAIN, RAISED_UP
from nmatrix.lessons.formulas.parse import APART, FUNCTIONS
from nmatrix.lessons.formulas.tree import (
    Fence,
    Fraction,
    Grid,
    Name,
    Node,
    Number,
    Power,
    Root,
    Row,
    Sign,
)

SIGNS = {
    APART: "\\, quad",
    "·": "dot",
    "×": "times",
    "≠": "!=",
    "⇒": "=>",
    "⇔": "<=>",
    "≤": "<=",
    "≥": ">=",
}
ESCAPED = '#$"\\_*`~@&;,'
NAMED = ("det", "tan", "sin", "cos", "arctan", "max")  # operators that Typst knows


def typst(node: Node) -> str:
    r"""Return the markup of a tree.

    Examples
    --------
    >>> from nmatrix.lessons.formulas.parse import parse
    >>> typst(parse("tan θ = √3/2"))
    'tan θ = frac(sqrt(3), 2)'
    """
    match node:
        case Name(text):
            found = _name(text)
        case Number(text):
            found = text
        case Sign(text):
            found = SIGNS.get(text, f"\\{text}" if text in ESCAPED else text)
        case Row(items):
            found = " ".join(map(typst, items))
        case Power(base, exponent):
            found = f"{typst(base)}^({_exponent(exponent)})"
        case Fraction(top, bottom):
            found = f"frac({typst(top)}, {typst(bottom)})"
        case Root(inside):
            found = f"sqrt({typst(inside)})"
        case Fence(inside, bars):
            found = f"abs({typst(inside)})" if bars else f"({typst(inside)})"
        case Grid(rows):
            lines = "; ".join(", ".join(map(typst, row)) for row in rows)
            found = f'mat(delim: "[", {lines})'
    return found


def _name(text: str) -> str:
    if text[1:] and text[1] in LOWERED:
        return f"{text[0]}_{text[1:].translate(RAISED_UP)}"
    if text in NAMED or len(text) == 1:
        return text
    if text in FUNCTIONS:
        return f'op("{text}")'
    if len(text) == 2 and text[1] in "xyz":
        return f"{text[0]}_{text[1]}"
    return f'"{text}"'


def _exponent(text: str) -> str:
    return text.translate(PLAIN).replace("⊤", " top").replace("′", "prime").replace("−", "-")
