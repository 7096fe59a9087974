"""One number as it is typed: a decimal or p/q, read as the nearest float64 or kept exact.

Only ASCII digits count; U+2212 is read as a minus.
"""

from __future__ import annotations

import re
from fractions import Fraction
from math import inf, isinf

from nmatrix.errors import IllegalValueError, quoted
from nmatrix.linear.rounding import nearest

LONGEST = 4000  # characters; the longest exact float64 takes about 1100
SMALLEST = Fraction(49, 10**325)  # 2⁻¹⁰⁷⁴ in its shortest spelling, 4.9e-324
WRITE_LIKE = "write it like 1.5, -2e-3 or 1/3"

_NUMBER = re.compile(
    r"(?P<decimal>(?P<sign>[+-]?)(?P<mantissa>[0-9]+(?:\.[0-9]+)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)"
    r"|(?P<top>[+-]?[0-9]+)/(?P<bottom>[+-]?[0-9]+)"
)
_SEPARATOR = re.compile(r"[ \t\r\n]*,[ \t\r\n]*|[ \t\r\n]+")


def fraction(text: str, name: str = "number") -> Fraction:
    """Read a number exactly as it was typed, if a float64 lies near it.

    The float test comes first, so that an exponent of a million never builds an integer.

    Raises
    ------
    IllegalValueError
        If the text is not a number, or its size is beyond float64.

    Examples
    --------
    >>> fraction("1/3"), fraction("-.5"), fraction("1e-3")
    (Fraction(1, 3), Fraction(-1, 2), Fraction(1, 1000))
    """
    if len(text) > LONGEST:
        raise IllegalValueError(
            f"{name} ({quoted(text)})",
            f"{len(text)} characters are too many for a number",
            f"use at most {LONGEST}",
        )
    found = _NUMBER.fullmatch(text.strip(" \t\r\n").replace("−", "-"))
    if found is None:
        raise IllegalValueError(f"{name} ({quoted(text)})", "it is not a number", WRITE_LIKE)
    value = _ratio(found, text, name) if found["top"] else _decimal(found, text, name)
    _check_size(value, text, name)
    return value


def number(text: str, name: str = "number") -> float:
    """Read a number as the nearest float64; −0 is 0.

    Raises
    ------
    IllegalValueError
        If the text is not a number, or its size is beyond float64.

    Examples
    --------
    >>> number("1/3"), number("−2.5e-1"), number("-0")
    (0.3333333333333333, -0.25, 0.0)
    """
    return nearest(fraction(text, name))


def number_or_infinity(text: str, name: str = "number") -> float:
    """Read a number, or the word `inf`, which only a far plane may be.

    Examples
    --------
    >>> number_or_infinity("inf"), number_or_infinity("100")
    (inf, 100.0)
    """
    return inf if text.strip() == "inf" else number(text, name)


def fractions(text: str, count: int, name: str) -> tuple[Fraction, ...]:
    """Read so many exact numbers, separated by blanks or commas.

    Raises
    ------
    IllegalValueError
        If there are more or fewer, or one of them is not a number.

    Examples
    --------
    >>> fractions("1, 1/2 -3", 3, "--translate")
    (Fraction(1, 1), Fraction(1, 2), Fraction(-3, 1))
    """
    stripped = text.strip(" \t\r\n")
    parts = _SEPARATOR.split(stripped, maxsplit=count) if stripped else []
    if len(parts) != count:
        got = len(_SEPARATOR.split(stripped)) if stripped else 0
        raise IllegalValueError(
            f"{name} ({quoted(text)})",
            f"it takes {count} numbers, got {got}",
            "separate them by blanks or commas",
        )
    return tuple(fraction(part, name) for part in parts)


def numbers(text: str, count: int, name: str) -> tuple[float, ...]:
    """Read so many numbers as `fractions` does, each as the nearest float64.

    Examples
    --------
    >>> numbers("-3 0 -1.5", 3, "--translate")
    (-3.0, 0.0, -1.5)
    """
    return tuple(map(nearest, fractions(text, count, name)))


def number_list(text: str, name: str) -> tuple[float, ...]:
    """Read any number of numbers, at least one, separated by blanks or commas.

    Examples
    --------
    >>> number_list("0.5, 2 100", "--at")
    (0.5, 2.0, 100.0)
    """
    return tuple(number(part, name) for part in _SEPARATOR.split(text.strip(" \t\r\n")))


def _decimal(found: re.Match[str], text: str, name: str) -> Fraction:
    if not found["mantissa"].strip("0."):
        return Fraction(0)
    rounded = float(found["decimal"])
    if isinf(rounded):
        raise _too_large(text, name)
    if rounded == 0.0:
        raise _too_small(text, name)
    return Fraction(found["decimal"])


def _ratio(found: re.Match[str], text: str, name: str) -> Fraction:
    top, bottom = int(found["top"]), int(found["bottom"])
    if bottom == 0:
        raise IllegalValueError(f"{name} ({quoted(text)})", "nothing is divided by 0", WRITE_LIKE)
    return Fraction(top, bottom)


def _check_size(value: Fraction, text: str, name: str) -> None:
    try:
        value.numerator / value.denominator
    except OverflowError:
        raise _too_large(text, name) from None
    if value and abs(value) < SMALLEST:
        raise _too_small(text, name)


def _too_large(text: str, name: str) -> IllegalValueError:
    return IllegalValueError(
        f"{name} ({quoted(text)})", "it is beyond the largest float64, 1.8e308", "scale it down"
    )


def _too_small(text: str, name: str) -> IllegalValueError:
    return IllegalValueError(
        f"{name} ({quoted(text)})",
        "it is not zero, yet below the smallest float64, 5e-324",
        "write 0 or scale it up",
    )
