"""Numbers with square roots, as people and nmatrix write them: √3/2, 2√3/3, (√6 − √2)/4, 1/√2.

They are computed exactly and rounded once, to the float64 that is nearest to them: that float is
what is read, and it is exact from there on, as a fraction is.
"""

from __future__ import annotations

import re
from fractions import Fraction

from nmatrix.errors import IllegalValueError, quoted
from nmatrix.surds import Surd, TooManyRootsError, root

LONGEST = 80  # characters; the longest root that nmatrix writes has a dozen
DEEPEST = 8  # parentheses
DIGITS = 15  # of a number in it
WRITE_LIKE = "write it like √3/2 or sqrt(3)/2"

_TOKEN = re.compile(r"\s*([0-9]+(?:\.[0-9]+)?|√|sqrt|[-+*·/()])")

Exact = Fraction | Surd


def has_root(text: str) -> bool:
    """Recognise a number that holds a root.

    Examples
    --------
    >>> has_root("√3/2"), has_root("sqrt(2)"), has_root("1/3")
    (True, True, False)
    """
    return "√" in text or "sqrt" in text


def root_number(text: str, name: str) -> Fraction:
    """Read a number made of roots, fractions, sums and products as the nearest float64.

    Raises
    ------
    IllegalValueError
        If it is no such number, or its roots are of negative numbers or of roots.

    Examples
    --------
    >>> root_number("√3/2", "x") == Fraction(3**0.5 / 2), root_number("2√4/3·3", "x")
    (True, Fraction(4, 1))
    >>> float(root_number("-(√6 − √2)/4", "x"))
    -0.25881904510252074
    """
    plain = text.strip().replace("−", "-")
    tokens = [one[1] for one in _TOKEN.finditer(plain)]
    is_long = len(text) > LONGEST or any(len(one) > DIGITS for one in tokens)
    try:
        if is_long or "".join(tokens) != "".join(plain.split()):
            raise _NotReadError("it is not a number")
        return Fraction(float(_whole(tokens)))
    except ZeroDivisionError:
        why = "nothing is divided by 0"
    except TooManyRootsError:
        why = "its root is of too large a number"
    except _NotReadError as fault:
        why = str(fault)
    raise IllegalValueError(f"{name} ({quoted(text)})", why, WRITE_LIKE)


class _NotReadError(ValueError):
    """Characters that are no number, with the reason."""


def _whole(tokens: list[str]) -> Exact:
    found, rest = _sum(tokens, 0)
    if rest:
        raise _NotReadError(f"{rest[0]} is one too many")
    return found


def _sum(tokens: list[str], depth: int) -> tuple[Exact, list[str]]:
    if depth > DEEPEST:
        raise _NotReadError(f"its parentheses nest deeper than {DEEPEST}")
    total: Exact = Fraction(0)
    while True:
        is_minus = tokens[:1] == ["-"]
        product, tokens = _product(tokens[1:] if tokens[:1] in (["-"], ["+"]) else tokens, depth)
        total = total - product if is_minus else total + product
        if tokens[:1] not in (["-"], ["+"]):
            return total, tokens


def _product(tokens: list[str], depth: int) -> tuple[Exact, list[str]]:
    """Multiply factors, which may stand side by side, and divide by what stands behind a slash."""
    found, tokens = _factor(tokens, depth)
    while tokens and tokens[0] not in ("+", "-", ")"):
        if tokens[0] == "/":
            below, tokens = _factor(tokens[1:], depth)
            found = found / below
        else:
            other, tokens = _factor(tokens[1:] if tokens[0] in "*·" else tokens, depth)
            found = found * other
    return found, tokens


def _factor(tokens: list[str], depth: int) -> tuple[Exact, list[str]]:
    """Read a number, a root or a sum in parentheses; all that follows is the second value."""
    head, rest = (tokens[0], tokens[1:]) if tokens else ("", [])
    if head == "(":
        found, rest = _sum(rest, depth + 1)
        if rest[:1] != [")"]:
            raise _NotReadError("a parenthesis is not closed")
        return found, rest[1:]
    if head in ("√", "sqrt"):
        square, rest = _factor(rest, depth + 1)
        if isinstance(square, Surd) or square < 0:
            raise _NotReadError("roots of roots and of negative numbers are not read")
        return root(square), rest
    if not head[:1].isdigit():
        raise _NotReadError(f"a number is missing {f'before {head}' if head else 'at its end'}")
    return Fraction(head), rest
