"""A formula as a sentence, for those who hear it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from nmatrix.formula import (
    APART,
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
from nmatrix.output.spelling import greek

SIGNS = {
    "=": "equals",
    "≠": "is not equal to",
    "⇒": "so",
    "⇔": "exactly if",
    "≤": "is at most",
    "≥": "is at least",
    "≈": "is about",
    "<": "is less than",
    ">": "is greater than",
    "+": "plus",
    "−": "minus",
    "-": "minus",
    "·": "dot",
    "×": "cross",
    ",": ",",
    APART: ",",
    "/": "over",
    "→": "becomes",
    "←": "becomes",
    "↔": "changes places with",
    "°": "degrees",
}
POWERS = {
    "−⊤": "inverse transposed",
    "⊤": "transposed",
    "−1": "inverse",
    "2": "squared",
    "3": "cubed",
    "′": "prime",
    "−2": "to the minus two",
    "s": "to the s",
}
FUNCTIONS = {
    "det": "the determinant of",
    "tan": "tangent of",
    "sin": "sine of",
    "cos": "cosine of",
    "arctan": "arc tangent of",
    "arccos": "arc cosine of",
    "rref": "the reduced echelon form of",
    "sign": "the sign of",
    "fl": "the rounded value of",
}


def spoken(node: Node) -> str:  # noqa: C901  # one branch for each kind of node
    """Read a tree aloud.

    Examples
    --------
    >>> from nmatrix.formula import parse
    >>> spoken(parse("A⁻ᵀ = C / det A"))
    'A inverse transposed equals C over the determinant of A'
    """
    match node:
        case Name():
            found = _name(node)
        case Numeral(text):
            found = text
        case Words(text):
            found = text
        case Sign(text):
            found = SIGNS.get(text, text)
        case Row(items):
            found = " ".join(_in_a_row(items)).replace(" ,", ",")
        case Power(base, exponent):
            found = _power(base, exponent)
        case Quotient(top, bottom):
            found = f"{_grouped(top)} over {_grouped(bottom)}"
        case Root(inside):
            found = _root(inside)
        case Fence(inside, bars):
            found = f"the length of {_grouped(inside)}" if bars else _grouped(inside)
        case Grid(rows, bar):
            found = _grid(rows, bar)
    return found


def _name(name: Name) -> str:
    letter, below = name.letter_and_index
    if letter in FUNCTIONS:
        return FUNCTIONS[letter]
    said = "infinity" if letter == "∞" else greek(letter) or letter
    return f"{said} {below}".strip()


def _in_a_row(items: tuple[Node, ...]) -> Iterator[str]:
    """Read each piece aloud; a length after a thing, or a sign beside a number, multiplies."""
    for i, item in enumerate(items):
        beside = (*items[i - 1 : i], *items[i + 1 : i + 2])
        if item in (Sign("×"), Sign("·")) and any(map(_is_number, beside)):
            yield "times"
            continue
        if i and _is_length(item) and not isinstance(items[i - 1], Sign):
            yield "times"
        yield spoken(item)


def _is_number(node: Node) -> bool:
    """Recognise what multiplies entry by entry, or row by column: a number, or a matrix."""
    match node:
        case Numeral() | Root() | Grid():
            return True
        case Quotient(top, bottom):
            return _is_number(top) and _is_number(bottom)
        case Fence(inside, bars):
            return not bars and _is_number(inside)
        case Power(base):
            return _is_number(base)
        case Row(items):
            return all(isinstance(one, Sign) or _is_number(one) for one in items)
    return False


def _is_length(node: Node) -> bool:
    return (isinstance(node, Fence) and node.bars) or (
        isinstance(node, Power) and _is_length(node.base)
    )


def _power(base: Node, exponent: str) -> str:
    """Read a power aloud; of a length or a function it comes before what they are of."""
    said = POWERS.get(exponent) or f"to the power {exponent}"
    if isinstance(base, Fence) and base.bars and exponent == "2":
        return f"the squared length of {_grouped(base.inside)}"
    if isinstance(base, Name) and base.text in FUNCTIONS:
        return f"{FUNCTIONS[base.text].removesuffix(' of')} {said} of"
    return f"{_whole(base)} {said}"


def _root(inside: Node) -> str:
    """Read a root aloud; of a number it needs no words between."""
    return (
        f"root {inside.text}" if isinstance(inside, Numeral) else f"the root of {_grouped(inside)}"
    )


def _whole(node: Node) -> str:
    """Read a base aloud so that its end is heard before the exponent."""
    if isinstance(node, Fence) and isinstance(node.inside, Row):
        return f"the group {spoken(node.inside)} end of group"
    return spoken(node)


def _grouped(node: Node) -> str:
    """Read a piece aloud so that its end is heard, if it is a sum or a product."""
    is_long = isinstance(node, Row) and any(isinstance(one, Sign) for one in node.items)
    return f"the group {spoken(node)} end of group," if is_long else spoken(node)


def _grid(rows: tuple[tuple[Node, ...], ...], bar: int) -> str:
    if len(rows[0]) == 1:
        return f"the vector {', '.join(spoken(row[0]) for row in rows)}"
    lines = "; ".join(_said(row[:bar]) + " bar " * (bar > 0) + _said(row[bar:]) for row in rows)
    return f"the {len(rows)} by {len(rows[0])} matrix with rows {lines}"


def _said(cells: Sequence[Node]) -> str:
    return ", ".join(map(spoken, cells))
