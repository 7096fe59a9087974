"""One number as it is typed: a decimal or p/q, read as the nearest float64 or kept exact.

Only ASCII digits count; U+2212 is read as a minus.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from fractions import Fraction
from math import inf, isinf

from nmatrix.errors import IllegalValueError, counted, quoted
from nmatrix.linear.rounding import nearest

LONGEST = 4000  # characters; the longest exact float64 takes about 1100
SMALLEST = Fraction(49, 10**325)  # 2⁻¹⁰⁷⁴ in its shortest spelling, 4.9e-324
WRITE_LIKE = "write it like 1.5, -2e-3 or 1/3"

ReadOne = Callable[[str, str], Fraction]  # of a word, under the name that an error speaks of

_NUMBER = re.compile(
    r"(?P<decimal>(?P<sign>[+-]?)(?P<mantissa>[0-9]+(?:\.[0-9]+)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)"
    r"|(?P<top>[+-]?[0-9]+)/(?P<bottom>[+-]?[0-9]+)"
)
_BRACKETED = re.compile(r"(?:vec[234])?[\[({](.*)[\])}]", re.DOTALL)
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


def fractions(text: str, count: int, name: str, read: ReadOne = fraction) -> tuple[Fraction, ...]:
    """Read so many exact numbers, separated by blanks or commas, in brackets or without.

    Raises
    ------
    IllegalValueError
        If there are more or fewer, or one of them is not a number.

    Examples
    --------
    >>> fractions("1, 1/2 -3", 3, "--translate") == fractions("(1, 1/2, -3)", 3, "--translate")
    True
    """
    words = number_words(text)
    if len(words) != count:
        raise IllegalValueError(
            f"{name} ({quoted(text)})",
            f"it takes {counted(count, 'number')}, got {len(words)}",
            "separate them by blanks or commas",
        )
    return tuple(read(word, name) for word in words)


def numbers(text: str, count: int, name: str, read: ReadOne = fraction) -> tuple[float, ...]:
    """Read so many numbers as `fractions` does, each as the nearest float64.

    Examples
    --------
    >>> numbers("-3 0 -1.5", 3, "--translate")
    (-3.0, 0.0, -1.5)
    """
    return tuple(map(nearest, fractions(text, count, name, read)))


def number_words(text: str) -> list[str]:
    """Part the words of a list of numbers.

    Examples
    --------
    >>> number_words("[1, 2 3]"), number_words("")
    (['1', '2', '3'], [])
    """
    stripped = text.strip(" \t\r\n")
    bracketed = _BRACKETED.fullmatch(stripped)
    inside = stripped if bracketed is None else bracketed[1].strip(" \t\r\n")
    return _SEPARATOR.split(inside) if inside else []


def spread(text: str, count: int) -> str:
    """Repeat a number that stands alone for so many.

    Examples
    --------
    >>> spread("2", 3), spread("1 2 1", 3)
    ('2 2 2', '1 2 1')
    """
    return " ".join(number_words(text) * count) if len(number_words(text)) == 1 else text


def ratio(text: str, name: str) -> float:
    """Read a number, or width and height as 16/9 or 16:9.

    Examples
    --------
    >>> ratio("16:9", "--aspect") == ratio("16/9", "--aspect") == 16 / 9
    True
    """
    width, colon, height = text.partition(":")
    if not colon:
        return number(text, name)
    if not fraction(height, name):
        raise IllegalValueError(f"{name} ({quoted(text)})", "its height is 0", "write it like 16:9")
    return nearest(fraction(width, name) / fraction(height, name))


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
