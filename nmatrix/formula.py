"""A formula as a tree, read from the line that a person would type.

The line is what text shows: `(A t)ᵀ (N n)`, `tan θ = (κ − 1/κ) / 2`, `√3/2`. A slash takes what
stands directly before and after it, a number before a root with that root, as in `3√2/4`; a
function's name takes what follows it. A column of `|` in a matrix is the bar of [A | I]. Lists in
square brackets, words in quotes and what else a calculator takes are words, as they were typed.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from nmatrix.typed import LOWERED, RAISED, TypedRows, bar_of

APART = ",  "  # between two statements, which stand further apart than two numbers
# Names that LaTeX and Typst know.
OPERATORS = ("det", "tan", "sin", "cos", "arctan", "arccos", "max")
FUNCTIONS = (*OPERATORS, "sign", "rank", "rref", "fl")
SIGNS = frozenset((APART, *",=+−-·×/≠≤≥≈<>→←↔⇒⇔°"))
SQUARE_ROOT = "sqrt"  # as it is typed
SHORTEST = 3  # letters of such a function; Rx (…) may be a product
_ON_THE_LINE = str.maketrans(f"{RAISED}-T", "0123456789−⊤′s−⊤")
_LIST = r"\[(?:[^\[\]]|\[[^\[\]]*\])*\]"
_TOKEN = re.compile(
    rf"{_LIST}|\"[^\"]*\"|\.[A-Za-z]+|,\s\s+|\s+|[0-9]+(?:\.[0-9]+)?|[A-Za-z]+_\w*|[A-Za-z]+[0-9]+(?=\()|"
    rf"[A-Za-z]+[₀-₉]*|[Α-ω][₀-₉]*|[{RAISED}]+|\^\(?[-−]?(?:[0-9]+|T)\)?|√|==|[^\w\s]|\S"
)


@dataclass(frozen=True)
class Name:
    """A letter, a word, or the name of a function such as det."""

    text: str

    @property
    def letter_and_index(self) -> tuple[str, str]:
        """The letter and what stands below it, as in σ₁ and nx; a word has nothing below it.

        Examples
        --------
        >>> Name("σ₁").letter_and_index, Name("nx").letter_and_index, Name("det").letter_and_index
        (('σ', '1'), ('n', 'x'), ('det', ''))
        """
        first, below = self.text[0], self.text[1:]
        if below and below[0] in LOWERED:
            return first, "".join(str(LOWERED.index(digit)) for digit in below)
        return (first, below) if len(below) == 1 and below in "xyz" else (self.text, "")


@dataclass(frozen=True)
class Numeral:
    """A number, as typed."""

    text: str


@dataclass(frozen=True)
class Words:
    """Plain words where a letter would stand."""

    text: str


@dataclass(frozen=True)
class Sign:
    """An operator, a relation, a comma."""

    text: str


@dataclass(frozen=True)
class Row:
    """Pieces side by side."""

    items: tuple[Node, ...]


@dataclass(frozen=True)
class Power:
    """A base with an exponent, written on the line: −1, −⊤ for ⁻ᵀ, ′ for a prime."""

    base: Node
    exponent: str


@dataclass(frozen=True)
class Quotient:
    """One thing over another."""

    top: Node
    bottom: Node


@dataclass(frozen=True)
class Root:
    """A square root."""

    inside: Node


@dataclass(frozen=True)
class Fence:
    """Something in parentheses, or between the bars of a length."""

    inside: Node
    bars: bool = False


@dataclass(frozen=True)
class Grid:
    """A matrix; `bar` is how many columns stand before its vertical line, 0 where it has none."""

    rows: tuple[tuple[Node, ...], ...]
    bar: int = 0


Node = Name | Numeral | Words | Sign | Row | Power | Quotient | Root | Fence | Grid


def parse(text: str) -> Node:
    """Read one line.

    Examples
    --------
    >>> parse("A⁻ᵀ")
    Power(base=Name(text='A'), exponent='−⊤')
    >>> parse("1/κ")
    Quotient(top=Numeral(text='1'), bottom=Name(text='κ'))
    """
    return _joined(_line(text))


def parse_parts(parts: Sequence[str | TypedRows]) -> Row:
    """Read words and matrices side by side; what stands between two matrices is one line."""
    found: list[Node] = []
    line = ""
    for part in parts:
        if isinstance(part, str):
            line += part
            continue
        found += _line(line)
        found.append(_grid(part))
        line = ""
    return Row((*found, *_line(line)))


def _grid(rows: TypedRows) -> Grid:
    bar = bar_of(rows)
    cells = (row[:bar] + row[bar + 1 :] if bar else row for row in rows)
    return Grid(tuple(tuple(map(parse, row)) for row in cells), bar)


def _line(text: str) -> list[Node]:
    tokens = [token for token in _TOKEN.findall(text) if token.strip()]
    items, rest = _items(tokens, closing="")
    assert not rest  # every bracket of a lesson is closed
    return items


def _items(tokens: Sequence[str], closing: str) -> tuple[list[Node], Sequence[str]]:
    """Read the pieces up to a closing bracket; the second value is what follows it."""
    found: list[Node] = []
    while tokens:
        if tokens[0] == closing:
            return found, tokens[1:]
        if tokens[0] == "/" and found:
            below, tokens = _piece(tokens[1:])
            found[-1] = Quotient(_bare(found[-1]), _bare(below))
            continue
        piece, tokens = _piece(tokens)
        found.append(piece)
    return found, tokens


def _piece(tokens: Sequence[str]) -> tuple[Node, Sequence[str]]:
    """Read one piece with its exponents."""
    piece, tokens = _plain_piece(tokens)
    while tokens and not isinstance(piece, Sign):
        if _is_exponent(tokens[0]):
            piece = Power(piece, tokens[0].strip("^()").translate(_ON_THE_LINE))
        elif _is_part(tokens[0]):
            piece = Row((piece, Words(tokens[0])))
        else:
            break
        tokens = tokens[1:]
    return piece, tokens


def _is_exponent(token: str) -> bool:
    return token[0] in RAISED or (token[0] == "^" and len(token) > 1)


def _is_part(token: str) -> bool:
    """Tell what picks a part of the value before it: .x or [0, 1]."""
    return token[0] in ".[" and len(token) > 1


def _plain_piece(tokens: Sequence[str]) -> tuple[Node, Sequence[str]]:
    head, rest = tokens[0], tokens[1:]
    if head in "(|":
        items, rest = _items(rest, ")" if head == "(" else "|")
        return Fence(_joined(items), bars=head == "|"), rest
    if head == "√" and rest:
        inside, rest = _plain_piece(rest)
        return Root(_bare(inside)), rest
    if head[0].isdigit():
        return _number(head, rest)
    if head in FUNCTIONS and rest and rest[0][0] not in f")|=,{RAISED}":
        argument, rest = _piece(rest)
        return Row((Name(head), argument)), rest
    if head[0].isalpha():
        return _named(head, rest)
    sign = APART if head.startswith(",") and head != "," else head
    return Sign(sign) if sign in SIGNS else Words(f" {sign} " if sign == "==" else sign), rest


def _named(name: str, rest: Sequence[str]) -> tuple[Node, Sequence[str]]:
    """Read a letter, or the name of a function of the calculator with what it takes."""
    called = Words(name) if "_" in name else Name(name)
    if len(name) < SHORTEST or not rest or rest[0] != "(":
        return called, rest
    taken, rest = _plain_piece(rest)
    return Root(_bare(taken)) if name == SQUARE_ROOT else Row((called, taken)), rest


def _number(head: str, rest: Sequence[str]) -> tuple[Node, Sequence[str]]:
    """Read a number, with the root that it stands before: 3√2 is one piece."""
    if not (rest and rest[0] == "√"):
        return Numeral(head), rest
    root, rest = _plain_piece(rest)
    return Row((Numeral(head), root)), rest


def _joined(items: Sequence[Node]) -> Node:
    return items[0] if len(items) == 1 else Row(tuple(items))


def _bare(piece: Node) -> Node:
    """Take off parentheses that a fraction bar or a root makes needless."""
    return piece.inside if isinstance(piece, Fence) and not piece.bars else piece
