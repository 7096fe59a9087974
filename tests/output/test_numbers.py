from __future__ import annotations

from decimal import ROUND_HALF_EVEN, Context, Decimal
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from nmatrix.output.numbers import float_or_none, machine, significant

FLOATS = st.floats(allow_nan=False, allow_infinity=False)
FRACTIONS = st.builds(
    lambda top, bottom, exponent: Fraction(top, bottom) * Fraction(10) ** exponent,
    st.integers(-(10**30), 10**30),
    st.integers(1, 10**30),
    st.integers(-700, 700),
)


@given(FLOATS)
def test_machine_numbers_read_back_to_the_same_bits(value: float) -> None:
    written = machine(value)
    assert written is not None
    assert float(written).hex() == (value + 0.0).hex()


@given(FLOATS)
def test_machine_numbers_are_the_shortest_that_do(value: float) -> None:
    written = machine(value)
    digits = len(Decimal(written or "").normalize().as_tuple().digits)
    shorter = f"{value:.{max(digits - 2, 0)}e}" if digits > 1 else "nan"
    assert float(shorter) != value


@given(FRACTIONS)
def test_a_fraction_is_rounded_once(value: Fraction) -> None:
    written = machine(value)
    if written is None:
        assert abs(value) >= Fraction(2) ** 1024 - Fraction(2) ** 970
    else:
        below = abs(Fraction(float(written)) - value)
        ulp = Fraction(2) ** -1074
        size = abs(value)
        if size:
            exponent = max(-1074, _floor_log2(size) - 52)
            ulp = Fraction(2) ** exponent
        assert below <= ulp / 2


def _floor_log2(size: Fraction) -> int:
    guess = size.numerator.bit_length() - size.denominator.bit_length()
    return guess if Fraction(2) ** guess <= size else guess - 1


@given(FRACTIONS, st.integers(1, 20))
def test_people_see_the_correctly_rounded_decimal(value: Fraction, digits: int) -> None:
    context = Context(prec=digits, rounding=ROUND_HALF_EVEN, Emin=-9999, Emax=9999)
    expected = context.divide(Decimal(value.numerator), Decimal(value.denominator))
    assert Decimal(significant(value, digits)) == expected


@given(FLOATS, st.integers(1, 17))
def test_floats_and_their_fractions_look_alike(value: float, digits: int) -> None:
    assert significant(value, digits) == significant(Fraction(value), digits)


@pytest.mark.parametrize(
    ("value", "shown"),
    [
        (0.0, "0"),
        (-0.0, "0"),
        (1.0, "1"),
        (100000.0, "100000"),
        (1e6, "1e+06"),
        (1e-5, "1e-05"),
        (0.0001, "0.0001"),
        (Fraction(10) ** 600, "1e+600"),
        (-Fraction(1, 3) / 10**600, "-3.33333e-601"),
        (Fraction(9999999, 10), "1e+06"),
        (Fraction(9999995, 10**7), "1"),
        (1234567, "1234567"),
        (6.1e-17, "6.1e-17"),
    ],
)
def test_six_digits(value: float | Fraction, shown: str) -> None:
    assert significant(value, 6) == shown


@pytest.mark.parametrize("value", [Fraction(10) ** 400, 10**400, float("inf"), float("nan")])
def test_what_no_float_can_hold_has_no_machine_text(value: Fraction | float) -> None:
    assert float_or_none(value) is None
    assert machine(value) is None


def test_minus_zero_is_zero() -> None:
    assert machine(-0.0) == "0.0"
