"""From a line of mathematics, as one types it, to its tree.

The line is what `derive` prints as text: `(A t)ᵀ (N n)`, `tan θ = (κ − 1/κ) / 2`, `√3/2`. A slash
takes what stands directly before and after it; a function's name takes what follows it.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from nmatrix.lessons.formulas.tree import (
    Fence,
    Fraction,
    Name,
    Node,
    Number,
    Power,
    Root,
    Row,
    Sign,
)

APART = ",  "  # between two statements, which stand further apart than two numbers
FUNCTIONS = ("det", "tan", "sin", "cos", "arctan", "sign", "max", "rank", "fl")
RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹⁻ᵀ′ˢ"
_TOKEN = re.compile(
    rf",\s\s+|\s+|[0-9]+(?:\.[0-9]+)?|[A-Za-z]+[₀-₉]*|[Α-ω][₀-₉]*|[{RAISED}]+|\^\(?-?−?[0-9]+\)?|√|[^\w\s]|\S"
)


def parse(text: str) -> Node:
    """Return the tree of a line.

    Examples
    --------
    >>> parse("A⁻ᵀ")
    Power(base=Name(text='A'), exponent='⁻ᵀ')
    >>> parse("1/κ")
    Fraction(top=Number(text='1'), bottom=Name(text='κ'))
    """
    tokens = [token for token in _TOKEN.findall(text) if token.strip()]
    items, rest = _items(tokens, closing="")
    assert not rest  # every bracket of a lesson is closed
    return _joined(items)


def _items(tokens: Sequence[str], closing: str) -> tuple[list[Node], Sequence[str]]:
    """Return the pieces up to a closing bracket, and what follows it."""
    found: list[Node] = []
    while tokens:
        if tokens[0] == closing:
            return found, tokens[1:]
        if tokens[0] == "/" and found:
            below, tokens = _piece(tokens[1:])
            found[-1] = Fraction(_bare(found[-1]), _bare(below))
            continue
        piece, tokens = _piece(tokens)
        found.append(piece)
    return found, tokens


def _piece(tokens: Sequence[str]) -> tuple[Node, Sequence[str]]:
    """Return one piece with its exponents."""
    piece, tokens = _plain_piece(tokens)
    while tokens and (tokens[0][0] in RAISED or tokens[0].startswith("^")):
        piece = Power(piece, tokens[0].strip("^()"))
        tokens = tokens[1:]
    return piece, tokens


def _plain_piece(tokens: Sequence[str]) -> tuple[Node, Sequence[str]]:
    head, rest = tokens[0], tokens[1:]
    if head in "(|":
        items, rest = _items(rest, ")" if head == "(" else "|")
        return Fence(_joined(items), bars=head == "|"), rest
    if head == "√" and rest:
        inside, rest = _plain_piece(rest)
        return Root(_bare(inside)), rest
    if head[0].isdigit():
        return Number(head), rest
    if head in FUNCTIONS and rest and rest[0][0] not in f")|=,{RAISED}":
        argument, rest = _piece(rest)
        return Row((Name(head), argument)), rest
    if head[0].isalpha():
        return Name(head), rest
    return Sign(APART if head.startswith(",") and head != "," else head), rest


def _joined(items: Sequence[Node]) -> Node:
    return items[0] if len(items) == 1 else Row(tuple(items))


def _bare(piece: Node) -> Node:
    """Return what a fraction or a root needs no parentheses around."""
    return piece.inside if isinstance(piece, Fence) and not piece.bars else piece
