"""The tree of an expression: what its grammar admits, and nothing else.

Every node knows where it stands in the text, so that a fault can be shown under its character.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction


@dataclass(frozen=True)
class Node:
    """A part of an expression, from the character at `start` to the one before `end`."""

    start: int
    end: int


@dataclass(frozen=True)
class Numeral(Node):
    """A number as it was typed."""

    text: str


@dataclass(frozen=True)
class Turn(Node):
    """An angle with its unit, in degrees."""

    degrees: Fraction


@dataclass(frozen=True)
class Name(Node):
    """A name of a value."""

    name: str


@dataclass(frozen=True)
class Word(Node):
    """Letters in quotes, such as the order of Euler angles."""

    word: str


@dataclass(frozen=True)
class Pasted(Node):
    """A matrix in the notation of another program, as rows of number texts."""

    rows: tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class Bracket(Node):
    """Entries in square brackets; rows are parted by semicolons or line ends."""

    rows: tuple[tuple[Node, ...], ...]


@dataclass(frozen=True)
class Prefix(Node):
    """A sign or a root before its operand."""

    sign: str
    operand: Node


@dataclass(frozen=True)
class Infix(Node):
    """An operator between its operands; `at` is where it stands."""

    sign: str
    left: Node
    right: Node
    at: int


@dataclass(frozen=True)
class Power(Node):
    """A power with a whole exponent, transposed or not: A^2, A^-1, A^T, A^-T."""

    base: Node
    exponent: int
    is_transposed: bool
    at: int


@dataclass(frozen=True)
class Member(Node):
    """A part of a value after a point: A.T, v.xyz."""

    value: Node
    name: str
    at: int


@dataclass(frozen=True)
class Index(Node):
    """Entries by their places, counted from 0; None is a whole row or column."""

    value: Node
    places: tuple[Node | None, ...]
    at: int


@dataclass(frozen=True)
class Call(Node):
    """A function with its arguments, some by name."""

    function: str
    arguments: tuple[Node, ...]
    named: tuple[tuple[str, Node], ...]
