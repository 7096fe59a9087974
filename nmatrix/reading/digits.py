"""How well typed numbers are known: a decimal to half a unit of its last digit, others exactly.

`0.70711` may stand for anything that rounds to it; `2`, `1/3` and `0.5` are what they say. Numbers
of single precision, printed in full, are known to half a unit of float32.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from fractions import Fraction
from itertools import chain

from nmatrix.linear.rational import DOUBLE, SINGLE, ZERO, RationalMatrix
from nmatrix.linear.rounding import short_text, spacing

ENOUGH = 3  # digits, behind the point or significant, from which on a decimal counts as rounded
SMALLEST_SINGLE, LARGEST_SINGLE = Fraction(1, 2**126), Fraction(2**128 - 2**104)
FLOAT32_DIGITS = 8  # single precision is printed with so many digits or more

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
    def has_point(self) -> bool:
        """Whether digits behind a point were typed, or an exponent that stands for them."""
        return bool(self.behind) or self.exponent < 0

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


def half_units(
    entries: RationalMatrix, digits: TypedDigits, *, exact: bool = False
) -> RationalMatrix:
    """Return half the last unit of each entry that was rounded, and 0 for what is exact.

    `exact` decimals are the very floats, if they are no float32s.

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
                one.last_place / 2 if one is not None and one.is_rounded and not exact else ZERO,
                spacing(entry, SINGLE) / 2 if single else ZERO,
            )
            for entry, one in zip(row, typed, strict=True)
        )
        for row, typed in zip(entries, digits, strict=True)
    )


def shared_half_units(
    entries: RationalMatrix, digits: TypedDigits, *, exact: bool = False
) -> RationalMatrix:
    """Return half the last unit of each entry if all were written in one precision.

    A program that writes six digits writes 1.0000002 as 1. So if most of the rounded entries have
    equally many significant digits, every entry is taken as rounded to so many; if most have
    equally many behind the point, to those; and all of them to a float.

    Examples
    --------
    >>> entries = ((Fraction("-1.00200"), Fraction(-1)),)
    >>> round(float(shared_half_units(entries, ((digits_of("-1.00200"), None),))[0][1]), 15)
    5e-06
    """
    typed = [one for one in chain(*digits) if one is not None]
    rounded = [] if exact else [one for one in typed if one.is_rounded]
    significant = max((one.significant for one in rounded), default=0)
    behind = max((one.decimals for one in typed), default=0)
    by_size = sum(one.significant == significant for one in rounded)
    by_place = sum(one.decimals == behind for one in rounded)

    def shared(entry: Fraction) -> Fraction:
        if not entry or not rounded:
            return ZERO
        if significant >= ENOUGH and by_size >= by_place:
            return Fraction(10) ** (_decimal_exponent(abs(entry)) + 1 - significant) / 2
        return Fraction(1, 2 * 10**behind)

    own, bits = half_units(entries, digits, exact=exact), bits_of(entries, digits)
    # A float64 was rounded once to be one, and again to be written; a float32 is what was written.
    return tuple(
        tuple(
            spacing(entry, bits) / 2 + (max(known, shared(entry)) if bits == DOUBLE else ZERO)
            for entry, known in zip(row, known_row, strict=True)
        )
        for row, known_row in zip(entries, own, strict=True)
    )


def bits_of(entries: RationalMatrix, digits: TypedDigits) -> int:
    """Return the bits of the floats that the numbers are."""
    return SINGLE if _is_single_precision(entries, digits) else DOUBLE


def _decimal_exponent(size: Fraction) -> int:
    """Return the exponent of the leading decimal digit."""
    exponent = len(str(size.numerator)) - len(str(size.denominator))
    return exponent if Fraction(10) ** exponent <= size else exponent - 1


def _is_single_precision(entries: RationalMatrix, digits: TypedDigits) -> bool:
    """Recognise numbers that are all float32s, at least one of them printed to eight digits.

    A number of fewer digits may be the shortest spelling of one. Where all have equally many digits
    behind the point, zeros too, it is these that were chosen, and a float32 among them is chance.
    """
    typed = [
        (entry, one)
        for entry, one in zip(chain(*entries), chain(*digits), strict=True)
        if one is not None and entry
    ]
    places = {one.behind for one in chain(*digits) if one is not None and one.behind}
    counts = {one.significant for one in chain(*digits) if one is not None and one.behind}
    if len(places) == 1 and 0 in counts and len(counts) > 2:
        return False
    long = [(entry, one) for entry, one in typed if one.significant >= FLOAT32_DIGITS]
    return bool(long) and all(_is_float32(entry, one.significant) for entry, one in long)


def _is_float32(entry: Fraction, significant: int) -> bool:
    step = spacing(entry, SINGLE)
    nearest = round(entry / step) * step
    if not SMALLEST_SINGLE <= abs(nearest) <= LARGEST_SINGLE:
        return False
    return short_text(nearest, significant) == short_text(entry, significant)
