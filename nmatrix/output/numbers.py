"""The one place where a number becomes characters: rounded for people, round-trip for machines."""

from __future__ import annotations

from fractions import Fraction
from math import isfinite

from nmatrix.report import Number

DECIMALS_PER_BIT = 0.30103  # log10(2)
FIXED_FROM = -4  # as in C's %g: smaller exponents are written as 1e-05


def float_or_none(value: Number) -> float | None:
    """Return the float64 nearest to a number, or None outside the float64 range; −0 becomes 0.

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


def machine(value: Number) -> str | None:
    """Return the shortest text that reads back as the same float64; None outside its range.

    Examples
    --------
    >>> machine(0.1), machine(Fraction(1, 4)), machine(7)
    ('0.1', '0.25', '7')
    """
    rounded = float_or_none(value)
    if rounded is None:
        return None
    return str(int(value)) if isinstance(value, int) else float.__repr__(rounded)


def significant(value: Number, digits: int) -> str:
    """Return a number in so many significant digits, correctly rounded, without idle zeros.

    Integers that count something stay whole; fractions are rounded from their integers, so that
    a value beyond every float is still shown.

    Examples
    --------
    >>> significant(2 / 3, 4), significant(-0.0, 6), significant(Fraction(10) ** 600, 6)
    ('0.6667', '0', '1e+600')
    """
    if isinstance(value, Fraction):
        return _from_integers(value, digits)
    if isinstance(value, int):
        return str(int(value)) if abs(value) < 10**15 else _from_integers(Fraction(value), digits)
    return f"{float(value) + 0.0:.{digits}g}"


def _from_integers(value: Fraction, digits: int) -> str:
    if not value:
        return "0"
    sign = "-" if value < 0 else ""
    exponent, mantissa = _scientific(abs(value), digits)
    return sign + _laid_out(mantissa, exponent, digits)


def _scientific(size: Fraction, digits: int) -> tuple[int, str]:
    """Return e and the decimal digits m of m₀.m₁m₂… × 10ᵉ, rounded half to even."""
    bits = size.numerator.bit_length() - size.denominator.bit_length()
    exponent = int(bits * DECIMALS_PER_BIT)
    while size >= _power(exponent + 1):
        exponent += 1
    while size < _power(exponent):
        exponent -= 1
    whole = round(size * _power(digits - 1 - exponent))
    if whole == 10**digits:
        return exponent + 1, "1"
    return exponent, str(whole).rstrip("0")


def _power(exponent: int) -> Fraction:
    return Fraction(10**exponent) if exponent >= 0 else Fraction(1, 10**-exponent)


def _laid_out(mantissa: str, exponent: int, digits: int) -> str:
    if FIXED_FROM <= exponent < 0:
        return "0." + "0" * (-exponent - 1) + mantissa
    if not 0 <= exponent < digits:
        point = "." if len(mantissa) > 1 else ""
        return f"{mantissa[0]}{point}{mantissa[1:]}e{exponent:+03d}"
    padded = mantissa.ljust(exponent + 1, "0")
    whole, rest = padded[: exponent + 1], padded[exponent + 1 :]
    return f"{whole}.{rest}" if rest else whole
