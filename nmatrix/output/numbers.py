"""Numbers as characters: rounded for people, round-trip for machines."""

from __future__ import annotations

from fractions import Fraction
from math import isfinite

from nmatrix.linear.rounding import short_text
from nmatrix.report import Number


def float_or_none(value: Number) -> float | None:
    """Round a number to the nearest float64; None outside its range; −0 becomes 0.

    Examples
    --------
    >>> float_or_none(Fraction(1, 3)), float_or_none(-0.0), float_or_none(Fraction(10) ** 400)
    (0.3333333333333333, 0.0, None)
    """
    try:
        found = float(value)
    except OverflowError:
        return None
    return found + 0.0 if isfinite(found) else None


def round_trip_text(value: Number) -> str | None:
    """Write the shortest text that reads back as the same float64; None outside its range.

    Examples
    --------
    >>> round_trip_text(0.1), round_trip_text(Fraction(1, 4)), round_trip_text(7)
    ('0.1', '0.25', '7')
    """
    rounded = float_or_none(value)
    if rounded is None:
        return None
    return str(int(value)) if isinstance(value, int) else float.__repr__(rounded)


def significant(value: Number, digits: int) -> str:
    """Write so many significant digits, correctly rounded, without trailing zeros.

    Integers that count something stay whole; fractions are rounded from their integers, so that
    a value beyond every float is still shown.

    Examples
    --------
    >>> significant(2 / 3, 4), significant(-0.0, 6), significant(Fraction(10) ** 600, 6)
    ('0.6667', '0', '1e+600')
    """
    if isinstance(value, Fraction):
        return short_text(value, digits)
    if isinstance(value, int):
        return str(int(value)) if abs(value) < 10**15 else short_text(Fraction(value), digits)
    return f"{float(value) + 0.0:.{digits}g}"
