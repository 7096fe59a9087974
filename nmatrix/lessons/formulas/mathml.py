"""A formula as MathML, which browsers show without any script."""

from __future__ import annotations

import re
from html import escape

from nmatrix.lessons.formulas.parse import APART, FUNCTIONS, RAISED
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

MATH = '<math display="block" xmlns="http://www.w3.org/1998/Math/MathML"'
WIDE = '<mspace width="1em"></mspace>'
LOWERED = "₀₁₂₃₄₅₆₇₈₉"
RAISED_UP = str.maketrans(LOWERED, "0123456789")
PLAIN = str.maketrans(RAISED, "0123456789−⊤′s")


def mathml(node: Node) -> str:
    """Return the elements of a tree.

    Examples
    --------
    >>> from nmatrix.lessons.formulas.parse import parse
    >>> mathml(parse("A⁻ᵀ"))
    '<msup><mi>A</mi><mrow><mo>−</mo><mi>⊤</mi></mrow></msup>'
    """
    match node:
        case Name(text):
            found = f"<mi>{escape(text)}</mi>" if text in FUNCTIONS else _letters(text)
        case Number(text):
            found = f"<mn>{escape(text)}</mn>"
        case Sign(text):
            found = f"<mo>,</mo>{WIDE}" if text == APART else f"<mo>{escape(text)}</mo>"
        case Row(items):
            found = f"<mrow>{''.join(_spaced(items))}</mrow>"
        case Power(base, exponent):
            found = f"<msup>{mathml(base)}{_exponent(exponent)}</msup>"
        case Fraction(top, bottom):
            found = f"<mfrac>{mathml(top)}{mathml(bottom)}</mfrac>"
        case Root(inside):
            found = f"<msqrt>{mathml(inside)}</msqrt>"
        case Fence(inside, bars):
            left, right = ("|", "|") if bars else ("(", ")")
            found = f"<mrow><mo>{left}</mo>{mathml(inside)}<mo>{right}</mo></mrow>"
        case Grid(rows):
            lines = "".join(f"<mtr>{_cells(row)}</mtr>" for row in rows)
            found = f"<mrow><mo>[</mo><mtable>{lines}</mtable><mo>]</mo></mrow>"
    return found


def _cells(row: tuple[Node, ...]) -> str:
    return "".join(f"<mtd>{mathml(cell)}</mtd>" for cell in row)


def _spaced(items: tuple[Node, ...]) -> list[str]:
    """Return pieces with a thin space after the name of a function."""
    found = []
    for item in items:
        found.append(mathml(item))
        if isinstance(item, Name) and item.text in FUNCTIONS:
            found.append('<mspace width="0.17em"></mspace>')
    return found


def _letters(text: str) -> str:
    """Return one letter in italics; a word stands upright, x, y, z behind a letter below it."""
    if text[1:] and text[1] in LOWERED:
        number = text[1:].translate(RAISED_UP)
        return f"<msub><mi>{text[0]}</mi><mn>{number}</mn></msub>"
    if len(text) == 2 and text[1] in "xyz":
        return f"<msub><mi>{text[0]}</mi><mi>{text[1]}</mi></msub>"
    return f"<mi>{escape(text)}</mi>" if len(text) == 1 else f"<mtext>{escape(text)}</mtext>"


def _exponent(text: str) -> str:
    parts = re.findall(r"[0-9]+|.", text.translate(PLAIN).replace("-", "−"))
    found = "".join(
        f"<mo>{c}</mo>" if c in "−′" else f"<mn>{c}</mn>" if c.isdigit() else f"<mi>{c}</mi>"
        for c in parts
    )
    return found if len(parts) == 1 else f"<mrow>{found}</mrow>"
