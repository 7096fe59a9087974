"""The pieces that a formula is made of; every printer knows all of them."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Name:
    """A letter, or the name of a function such as det."""

    text: str


@dataclass(frozen=True)
class Number:
    """Digits."""

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
    """Something with an exponent; ᵀ is the transpose, ′ a prime."""

    base: Node
    exponent: str


@dataclass(frozen=True)
class Fraction:
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
    """A matrix."""

    rows: tuple[tuple[Node, ...], ...]


Node = Name | Number | Sign | Row | Power | Fraction | Root | Fence | Grid
