"""One rounding at the end: exact integers and rationals to the nearest float64, or to decimals.

u is 2⁻⁵³; a result that is correctly rounded is within half a unit in the last place.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from math import isfinite, isqrt, lcm

from nmatrix.errors import IllegalValueError, NoAnswerError

DECIMALS_PER_BIT = 0.30103  # log10(2)
FIXED_FROM = -4  # as in C's %g: smaller exponents are written as 1e-05
ROOT_BITS = 66  # bits of the integer root: 53 to keep, one for the rounding, twelve to spare


def nearest(value: Fraction) -> float:
    """Round an exact value to the nearest float64.

    Division of Python integers is correctly rounded, so this is too.

    Raises
    ------
    IllegalValueError
        If the value is beyond the largest float64.

    Examples
    --------
    >>> nearest(Fraction(1, 3))
    0.3333333333333333
    """
    try:
        return value.numerator / value.denominator
    except OverflowError:
        raise IllegalValueError(
            f"a result near 1e{_decimal_exponent(value)}",
            "it is beyond the largest float64, 1.8e308",
            "use smaller numbers",
        ) from None


def spacing(value: Fraction, bits: int = 53) -> Fraction:
    """Return the gap between a value and the next larger float of so many bits; 0 for 0.

    Examples
    --------
    >>> spacing(Fraction(1), 24) == Fraction(1, 2**23), spacing(Fraction(3, 4)) == 2**-53
    (True, True)
    """
    if not value:
        return Fraction(0)
    size = abs(value)
    exponent = size.numerator.bit_length() - size.denominator.bit_length()
    if size < Fraction(2) ** exponent:
        exponent -= 1
    return Fraction(2) ** (exponent + 1 - bits)


def _decimal_exponent(value: Fraction) -> int:
    bits = abs(value.numerator).bit_length() - value.denominator.bit_length()
    return round(bits * DECIMALS_PER_BIT)


def over_root(numerator: int, square: int) -> float:
    """Compute `numerator / √square` correctly rounded, for integers and `square` > 0.

    The square of the quotient is rational; its integer root carries more bits than a float and a
    last bit that says whether anything was cut off, so one rounding decides.

    Examples
    --------
    >>> over_root(1, 2), over_root(-3, 9)
    (0.7071067811865476, -1.0)
    """
    if numerator == 0:
        return 0.0
    top = numerator * numerator
    shift = ROOT_BITS - (top.bit_length() - square.bit_length()) // 2
    if shift >= 0:
        quotient, rest = divmod(top << (2 * shift), square)
    else:
        quotient, rest = divmod(top, square << (-2 * shift))
    root = isqrt(quotient)
    root = 2 * root + (root * root != quotient or rest != 0)
    size = root / (1 << (shift + 1)) if shift >= 0 else nearest(Fraction(root << (-shift - 1)))
    return size if numerator > 0 else -size


def over_root_of_any_size(numerator: int, square: int) -> Fraction:
    """Compute `numerator / √square` as `over_root`; beyond all float64s it is known to 160 bits.

    Examples
    --------
    >>> over_root_of_any_size(10**400, 4) == 5 * 10**399
    True
    """
    try:
        return Fraction(over_root(numerator, square))
    except IllegalValueError:
        return numerator * inverse_root(Fraction(square))


def root(value: Fraction) -> float:
    """Compute √value correctly rounded.

    Raises
    ------
    IllegalValueError
        If the root is beyond the largest float64.

    Examples
    --------
    >>> root(Fraction(9, 4))
    1.5
    """
    return over_root(value.numerator, value.numerator * value.denominator) if value else 0.0


def nth_root(value: Fraction, degree: int) -> float:
    """Compute the root of any degree of a positive value, correctly rounded.

    As with a square root, an integer root with bits to spare and one last bit that says whether
    anything was cut off are enough for one rounding to decide.

    Examples
    --------
    >>> nth_root(Fraction(10**36), 6), nth_root(Fraction(1, 8), 3)
    (1000000.0, 0.5)
    """
    size = value.numerator.bit_length() - value.denominator.bit_length()
    shift = ROOT_BITS - size // degree
    scaled = value * Fraction(2) ** (degree * shift)
    whole, rest = divmod(scaled.numerator, scaled.denominator)
    found = _integer_root(whole, degree)
    found = 2 * found + (found**degree != whole or rest != 0)
    return nearest(Fraction(found) / Fraction(2) ** (shift + 1))


def _integer_root(n: int, degree: int) -> int:
    """Return the largest integer whose power is not above n, by Newton's iteration from above."""
    x = 1 << -(-n.bit_length() // degree)
    while True:
        lower = ((degree - 1) * x + n // x ** (degree - 1)) // degree
        if lower >= x:
            return x
        x = lower


def short_text(value: Fraction, digits: int) -> str:
    """Write a number in so many significant digits, correctly rounded, without trailing zeros.

    It is rounded from its integers, so that a value beyond every float is written as well.

    Examples
    --------
    >>> short_text(Fraction(2, 3), 3), short_text(Fraction(10) ** 400, 3)
    ('0.667', '1e+400')
    """
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


def integers(values: Iterable[Fraction | float]) -> tuple[list[int], int]:
    """Bring values to integers over one common denominator.

    Examples
    --------
    >>> integers([0.5, 0.75])
    ([2, 3], 4)
    """
    ratios = [value.as_integer_ratio() for value in values]
    common = lcm(*(bottom for _, bottom in ratios))
    return [top * (common // bottom) for top, bottom in ratios], common


def unit(direction: Sequence[int]) -> tuple[float, ...]:
    """Normalise a non-zero integer vector, every component correctly rounded.

    Examples
    --------
    >>> unit([3, 4, 0])
    (0.6, 0.8, 0.0)
    """
    square = sum(component * component for component in direction)
    return tuple(over_root(component, square) for component in direction)


def normalize(vector: Sequence[float]) -> tuple[float, ...]:
    """Normalise a vector, every component correctly rounded.

    The components are integers over one power of two, so nothing over- or underflows, from
    5e-324 to 1.7e308.

    Raises
    ------
    NoAnswerError, IllegalValueError
        As `direction`.

    Examples
    --------
    >>> normalize((3e-320, 4e-320, 0.0))
    (0.6, 0.8, 0.0)
    """
    return unit(direction(vector))


def direction(vector: Sequence[float]) -> list[int]:
    """Bring a vector to integers that point where it does.

    Raises
    ------
    NoAnswerError
        For the zero vector.
    IllegalValueError
        For a component that is not finite.

    Examples
    --------
    >>> direction((0.5, 0.25, 0))
    [2, 1, 0]
    """
    if not all(map(isfinite, vector)):
        raise IllegalValueError(
            f"vector ({' '.join(map(str, vector))})",
            "a component is not a finite number",
            "use finite components",
        )
    components, _ = integers(vector)
    if not any(components):
        raise NoAnswerError(
            f"vector ({' '.join('0' for _ in components)})",
            "it has length zero and no direction",
            "give one non-zero component",
        )
    return components


def quotient(top: int, bottom: int, bits: int) -> Fraction:
    """Divide two integers, rounded to so many significant bits; halfway between two it goes up.

    Examples
    --------
    >>> quotient(1, 3, 2), quotient(-3, 1, 2)
    (Fraction(3, 8), Fraction(-3, 1))
    """
    shift = bits - top.bit_length() + bottom.bit_length()
    if shift >= 0:
        return Fraction(((top << (shift + 1)) // bottom + 1) >> 1, 1 << shift)
    return Fraction(((2 * top) // (bottom << -shift) + 1 >> 1) << -shift)


def inverse_root(square: Fraction) -> Fraction:
    """Return 1/√x of a positive fraction: exact where the root is rational, else to 160 bits.

    Examples
    --------
    >>> inverse_root(Fraction(9, 4))
    Fraction(2, 3)
    """
    top, bottom = isqrt(square.numerator), isqrt(square.denominator)
    if (top * top, bottom * bottom) == (square.numerator, square.denominator):
        return Fraction(bottom, top)
    bits = 160 + max(0, square.numerator.bit_length() - square.denominator.bit_length())
    return Fraction(isqrt((square.denominator << (2 * bits)) // square.numerator), 1 << bits)
