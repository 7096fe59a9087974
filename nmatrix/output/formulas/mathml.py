"""A formula as MathML, which browsers show without any script."""

from __future__ import annotations

import re
from collections.abc import Sequence
from html import escape

from nmatrix.formula import (
    APART,
    FUNCTIONS,
    Fence,
    Grid,
    Name,
    Node,
    Numeral,
    Power,
    Quotient,
    Root,
    Row,
    Sign,
    Words,
)

NAMESPACE = "http://www.w3.org/1998/Math/MathML"
WIDE = '<mspace width="1em"></mspace>'


def mathml(node: Node) -> str:  # noqa: C901  # one branch for each kind of node
    """Print a tree as elements.

    Examples
    --------
    >>> from nmatrix.formula import parse
    >>> mathml(parse("A⁻ᵀ"))
    '<msup><mi>A</mi><mrow><mo>−</mo><mi>⊤</mi></mrow></msup>'
    """
    match node:
        case Name():
            found = _name(node)
        case Numeral(text):
            found = f"<mn>{escape(text.replace('-', '−'))}</mn>"
        case Words(text):
            found = f"<mtext>{escape(text)}</mtext>"
        case Sign(text):
            found = f"<mo>,</mo>{WIDE}" if text == APART else f"<mo>{escape(text)}</mo>"
        case Row(items):
            found = f"<mrow>{''.join(_spaced(items))}</mrow>"
        case Power(base, exponent):
            found = f"<msup>{mathml(base)}{_exponent(exponent)}</msup>"
        case Quotient(top, bottom):
            found = f"<mfrac>{mathml(top)}{mathml(bottom)}</mfrac>"
        case Root(inside):
            found = f"<msqrt>{mathml(inside)}</msqrt>"
        case Fence(inside, bars):
            left, right = ("|", "|") if bars else ("(", ")")
            found = f"<mrow><mo>{left}</mo>{mathml(inside)}<mo>{right}</mo></mrow>"
        case Grid(rows, bar):
            found = matrix([list(map(mathml, row)) for row in rows], bar)
    return found


def equation(body: str, said: str, key: str = "") -> str:
    """Put elements on a line of their own, with the sentence that is heard in their place.

    A key names the quantity to programs.
    """
    named = f' data-key="{escape(key)}"' if key else ""
    head = f'<math display="block" xmlns="{NAMESPACE}"{named}'
    return f'{head} alttext="{escape(said)}">{body}</math>'


def inline(body: str, said: str) -> str:
    """Put elements among words, with what is heard in their place."""
    return f'<math xmlns="{NAMESPACE}" alttext="{escape(said)}">{body}</math>'


def matrix(cells: Sequence[Sequence[str]], bar: int = 0) -> str:
    """Put printed cells into square brackets, with a line behind so many columns.

    Examples
    --------
    >>> matrix([["<mn>1</mn>"]])
    '<mrow><mo>[</mo><mtable><mtr><mtd><mn>1</mn></mtd></mtr></mtable><mo>]</mo></mrow>'
    """
    line = ' style="border-left: 1px solid"'
    opened = [f"<mtd{line if place == bar > 0 else ''}>" for place in range(len(cells[0]))]
    rows = "".join(
        f"<mtr>{''.join(f'{td}{cell}</mtd>' for td, cell in zip(opened, row, strict=True))}</mtr>"
        for row in cells
    )
    return f"<mrow><mo>[</mo><mtable>{rows}</mtable><mo>]</mo></mrow>"


def _spaced(items: tuple[Node, ...]) -> list[str]:
    """Print pieces with a thin space after the name of a function."""
    found = []
    for item in items:
        found.append(mathml(item))
        if isinstance(item, Name) and item.text in FUNCTIONS:
            found.append('<mspace width="0.17em"></mspace>')
    return found


def _name(name: Name) -> str:
    """Print one letter in italics and a word upright."""
    letter, below = name.letter_and_index
    if below:
        kind = "mn" if below.isdigit() else "mi"
        return f"<msub><mi>{letter}</mi><{kind}>{below}</{kind}></msub>"
    is_symbol = len(letter) == 1 or letter in FUNCTIONS
    return f"<mi>{escape(letter)}</mi>" if is_symbol else f"<mtext>{escape(letter)}</mtext>"


def _exponent(text: str) -> str:
    parts = re.findall(r"[0-9]+|.", text)
    found = "".join(
        f"<mo>{c}</mo>" if c in "−′" else f"<mn>{c}</mn>" if c.isdigit() else f"<mi>{c}</mi>"
        for c in parts
    )
    return found if len(parts) == 1 else f"<mrow>{found}</mrow>"
