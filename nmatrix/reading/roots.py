"""Numbers as people and nmatrix write them exactly: 1/3, √3/2, 2√3/3, (√6 − √2)/4, 1/√2.

A root stays a root, as p/q stays a fraction: what is read is the number itself, no float.
"""

from __future__ import annotations

import re
from fractions import Fraction

from nmatrix.errors import IllegalValueError, quoted
from nmatrix.reading.numbers import fraction
from nmatrix.surds import Surd, TooManyRootsError, root

LONGEST = 80  # characters; the longest root that nmatrix writes has a dozen
DEEPEST = 8  # parentheses
DIGITS = 15  # of a number in it
WRITE_LIKE = "write it like √3/2 or sqrt(3)/2"
OPEN, CLOSE = "⟮⟯"  # parentheses inside of a number, where others part the rows

_TOKEN = re.compile(rf"\s*([0-9]+(?:\.[0-9]+)?|√|sqrt|[-+*·/(){OPEN}{CLOSE}])")
_WITHIN = rf"\(([-+*·/√0-9. {OPEN}{CLOSE}]{{1,60}})\)"
_ROOT_OF = re.compile(rf"(?:(?<![A-Za-z_.\\])(?:(?:np|numpy|math|Math)\.)?sqrt|√){_WITHIN}")
_IN_PARENTHESES = re.compile(rf"{_WITHIN}(?=[ ]?[/*·])|(?<=[/*·]){_WITHIN}")
# A sign between blanks stands between two terms; with none behind it is that of the next entry.
_SPACED = re.compile(rf"(?<=[0-9{CLOSE}])[ ]+([-+*·/])[ ]+(?=[0-9√{OPEN}])")
_TWO = re.compile(r"[0-9.]\s+[0-9]")

Exact = Fraction | Surd


def has_root(text: str) -> bool:
    """Recognise a text with a root in it.

    Examples
    --------
    >>> has_root("√3/2"), has_root("sqrt(2)"), has_root("1/3")
    (True, True, False)
    """
    return "√" in text or "sqrt" in text


def in_one_word(text: str) -> str:
    """Write each number with a root without blanks and parentheses, which part entries and rows.

    Examples
    --------
    >>> in_one_word("[[sqrt(3)/2, (√6 − √2)/4], [-sqrt(2)/4 + sqrt(6)/4, 1]]")
    '[[√⟮3⟯/2, ⟮√6-√2⟯/4], [-√⟮2⟯/4+√⟮6⟯/4, 1]]'
    """
    if not has_root(text):
        return text
    inside = rf"{OPEN}\g<1>{CLOSE}"
    rooted = _ROOT_OF.sub(rf"√{inside}", text.replace("−", "-"))
    if "√" not in rooted:  # code that takes roots of its own
        return text
    hidden = _IN_PARENTHESES.sub(lambda found: f"{OPEN}{found[1] or found[2]}{CLOSE}", rooted)
    return _SPACED.sub(r"\1", hidden)


def exact_number(text: str, name: str) -> Exact:
    """Read a decimal, p/q, or a number made of roots by sums, products and quotients.

    Raises
    ------
    IllegalValueError
        If it is no such number, can be read in two ways, or has roots of negative numbers or of
        roots.

    Examples
    --------
    >>> print(exact_number("√3/2", "x"), exact_number("2√4/3·3", "x"), exact_number("0.5", "x"))
    √3/2 4 1/2
    >>> print(exact_number("-(√6 − √2)/4", "x"), exact_number("1/√2", "x"))
    (√2 − √6)/4 √2/2
    """
    plain = text.strip().replace(OPEN, "(").replace(CLOSE, ")")
    if not has_root(text):
        return fraction(plain, name)
    plain = plain.replace("−", "-")
    tokens = [one[1] for one in _TOKEN.finditer(plain)]
    is_long = len(text) > LONGEST or any(len(one) > DIGITS for one in tokens)
    try:
        if is_long or "".join(tokens) != "".join(plain.split()) or _TWO.search(plain):
            raise _NotReadError("it is not a number")
        return _whole(tokens)
    except ZeroDivisionError:
        why = "nothing is divided by 0"
    except TooManyRootsError:
        why = "its roots are too many or of too large numbers"
    except _NotReadError as fault:
        why = str(fault)
    raise IllegalValueError(f"{name} ({quoted(plain)})", why, WRITE_LIKE)


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
    below = ""
    while tokens and tokens[0] not in ("+", "-", ")"):
        sign = tokens[0] if tokens[0] in "*·/" else ""
        if below not in ("", "(") and not sign:
            raise _NotReadError(
                f"{tokens[0]} may stand below the line of its fraction or beside it"
            )
        rest = tokens[len(sign) :]
        other, tokens = _factor(rest, depth)
        found = found / other if sign == "/" else found * other
        below = rest[0] if sign == "/" else ""
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
