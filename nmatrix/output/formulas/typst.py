"""A formula as Typst mathematics."""

from __future__ import annotations

from collections.abc import Sequence

from nmatrix.formula import (
    APART,
    FUNCTIONS,
    OPERATORS,
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

SIGNS = {
    APART: "\\, quad",
    "·": "dot",
    "×": "times",
    "≠": "!=",
    "←": "<-",
    "↔": "<->",
    "≈": "approx",
    "⇒": "=>",
    "⇔": "<=>",
    "≤": "<=",
    "≥": ">=",
}
ESCAPED = '#$"\\_*`~@&;,'
EXPONENTS = str.maketrans({"⊤": " top", "′": "prime", "−": "-"})


def typst(node: Node) -> str:  # noqa: C901  # one branch for each kind of node
    r"""Print a tree as markup.

    Examples
    --------
    >>> from nmatrix.formula import parse
    >>> typst(parse("tan θ = √3/2"))
    'tan θ = frac(sqrt(3), 2)'
    """
    match node:
        case Name():
            found = _name(node)
        case Numeral(text):
            found = text
        case Words(text):
            found = quoted(text)
        case Sign(text):
            found = SIGNS.get(text, f"\\{text}" if text in ESCAPED else text)
        case Row(items):
            found = " ".join(map(typst, items))
        case Power(base, exponent):
            found = f"{typst(base)}^({exponent.translate(EXPONENTS)})"
        case Quotient(top, bottom):
            found = f"frac({typst(top)}, {typst(bottom)})"
        case Root(inside):
            found = f"sqrt({typst(inside)})"
        case Fence(inside, bars):
            found = f"abs({typst(inside)})" if bars else f"({typst(inside)})"
        case Grid(rows, bar):
            found = matrix([list(map(typst, row)) for row in rows], bar)
    return found


def matrix(cells: Sequence[Sequence[str]], bar: int = 0) -> str:
    """Put printed cells into square brackets, with a line behind so many columns.

    Examples
    --------
    >>> matrix([["1", "0"], ["0", "2"]])
    'mat(delim: "[", 1, 0; 0, 2)'
    """
    rows = "; ".join(", ".join(row) for row in cells)
    line = f"augment: #{bar}, " if bar else ""
    return f'mat(delim: "[", {line}{rows})'


def quoted(text: str) -> str:
    r"""Write text as a string of Typst.

    Examples
    --------
    >>> print(quoted('a "b"'))
    "a \"b\""
    """
    plain = "".join(c if c.isprintable() else " " for c in text)
    return '"' + plain.replace("\\", "\\\\").replace('"', '\\"') + '"'


def _name(name: Name) -> str:
    letter, below = name.letter_and_index
    if below:
        return f"{letter}_{below}"
    if letter in OPERATORS or len(letter) == 1:
        return letter
    return f"op({quoted(letter)})" if letter in FUNCTIONS else quoted(letter)
