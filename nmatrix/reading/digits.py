"""How well typed numbers are known: a decimal to half a unit of its last digit, others exactly.

`0.70711` may stand for anything that rounds to it; `2`, `1/3` and `0.5` are what they say. Numbers
of single precision, printed in full, are known to half a unit of float32.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import chain

from nmatrix.linear.rational import ZERO, RationalMatrix
from nmatrix.linear.rounding import short_text, spacing

ENOUGH = 3  # digits, behind the point or significant, from which on a decimal counts as rounded
FLOAT32_DIGITS = 8  # single precision is printed with so many digits or more
FLOAT32_BITS, FLOAT64_BITS = 24, 53

_DECIMAL = re.compile(
    r"[+-]?(?P<whole>[0-9]*)\.?(?P<behind>[0-9]*)(?:[eE](?P<exponent>[+-]?[0-9]+))?"
)


@dataclass(frozen=True)
class Digits:
    """The digits of one typed decimal: how many stand behind its point, how many count, and e.

    `is_whole` is a whole number, also as programs print one, `250.0`.
    """

    behind: int
    significant: int
    exponent: int = 0
    is_whole: bool = False

    @property
    def last_place(self) -> Fraction:
        """One unit of the last digit.

        Examples
        --------
        >>> digits_of("1.25e-3").last_place
        Fraction(1, 100000)
        """
        return Fraction(10) ** (self.exponent - self.behind)

    @property
    def decimals(self) -> int:
        """The digits behind the point once the exponent is written out."""
        return max(0, self.behind - self.exponent)

    @property
    def is_rounded(self) -> bool:
        """Whether there are enough of them to take the number for a rounded one."""
        return not self.is_whole and max(self.behind, self.significant) >= ENOUGH


def digits_of(text: str) -> Digits | None:
    """Count the digits of a number as it was typed; p/q has none and is exact.

    Examples
    --------
    >>> digits_of("-0.70711").last_place, digits_of("250.0").is_rounded, digits_of("1/3")
    (Fraction(1, 100000), False, None)
    """
    found = _DECIMAL.fullmatch(text.strip().replace("−", "-"))
    if found is None:
        return None
    whole, behind = found["whole"], found["behind"]
    significant = len((whole + behind).lstrip("0"))
    exponent = int((found["exponent"] or "0")[:7])
    return Digits(len(behind), significant, exponent, is_whole=behind in ("", "0"))


TypedDigits = tuple[tuple[Digits | None, ...], ...]


def half_units(entries: RationalMatrix, digits: TypedDigits) -> RationalMatrix:
    """Return half the last unit of each entry that was rounded, and 0 for what is exact.

    Examples
    --------
    >>> entries = ((Fraction("0.70711"), Fraction(2)),)
    >>> half_units(entries, ((digits_of("0.70711"), digits_of("2")),))
    ((Fraction(1, 200000), Fraction(0, 1)),)
    """
    single = _is_single_precision(entries, digits)
    return tuple(
        tuple(
            max(
                one.last_place / 2 if one is not None and one.is_rounded else ZERO,
                spacing(entry, FLOAT32_BITS) / 2 if single else ZERO,
            )
            for entry, one in zip(row, typed, strict=True)
        )
        for row, typed in zip(entries, digits, strict=True)
    )


def shared_half_units(entries: RationalMatrix, digits: TypedDigits) -> RationalMatrix:
    """Return how well each entry is known if all were written in one precision.

    A program that writes six digits writes 1.0000002 as 1: so every entry is taken as rounded to
    the most digits that any of them has, behind the point and in all. It was a float before, so to
    both roundings: to the float, and to the shortest digits that name it.

    Examples
    --------
    >>> entries = ((Fraction("-1.00200"), Fraction(-1)),)
    >>> round(float(shared_half_units(entries, ((digits_of("-1.00200"), None),))[0][1]), 12)
    5e-06
    """
    rounded = [one for one in chain(*digits) if one is not None and one.is_rounded]
    behind = max((one.decimals for one in rounded), default=None)
    significant = max((one.significant for one in rounded), default=None)
    own = half_units(entries, digits)
    bits = FLOAT32_BITS if _is_single_precision(entries, digits) else FLOAT64_BITS
    return tuple(
        tuple(
            max(known, _shared(entry, behind, significant)) + spacing(entry, bits)
            for entry, known in zip(row, known_row, strict=True)
        )
        for row, known_row in zip(entries, own, strict=True)
    )


def exactly(rows: Sequence[Sequence[object]]) -> TypedDigits:
    """Return the digits of numbers of which every one is exact."""
    return tuple((None,) * len(row) for row in rows)


def _shared(entry: Fraction, behind: int | None, significant: int | None) -> Fraction:
    if not entry or behind is None or significant is None:
        return ZERO
    places = Fraction(1, 10**behind)
    exponent = _decimal_exponent(abs(entry))
    return max(places, Fraction(10) ** (exponent + 1 - significant)) / 2


def _decimal_exponent(size: Fraction) -> int:
    """Return the exponent of the leading decimal digit."""
    exponent = len(str(size.numerator)) - len(str(size.denominator))
    return exponent if Fraction(10) ** exponent <= size else exponent - 1


def _is_single_precision(entries: RationalMatrix, digits: TypedDigits) -> bool:
    """Recognise numbers that are all float32s, at least one of them printed to eight digits.

    A number of fewer digits may be the shortest spelling of one.
    """
    long = [
        (entry, one.significant if one is not None else None)
        for entry, one in zip(chain(*entries), chain(*digits), strict=True)
        if entry and (one is None or one.significant >= FLOAT32_DIGITS)
    ]
    return any(count is not None or _needs_digits(entry) for entry, count in long) and all(
        _is_float32(entry, count) for entry, count in long
    )


def _needs_digits(entry: Fraction) -> bool:
    """Tell a number that takes eight digits to print from a short one like 0.5."""
    return Fraction(short_text(entry, FLOAT32_DIGITS - 1)) != entry


def _is_float32(entry: Fraction, significant: int | None) -> bool:
    step = spacing(entry, FLOAT32_BITS)
    nearest = round(entry / step) * step
    if significant is None:
        return nearest == entry
    return short_text(nearest, significant) == short_text(entry, significant)
