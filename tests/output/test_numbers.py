from __future__ import annotations

from decimal import ROUND_HALF_EVEN, Context, Decimal
from fractions import Fraction
from math import inf, nextafter

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from nmatrix.output.numbers import ROUND_TRIP, float_or_none, round_trip_text, significant

FLOATS = st.floats(allow_nan=False, allow_infinity=False)
FRACTIONS = st.builds(
    lambda top, bottom, exponent: Fraction(top, bottom) * Fraction(10) ** exponent,
    st.integers(-(10**30), 10**30),
    st.integers(1, 10**30),
    st.integers(-700, 700),
)


@given(FLOATS)
def test_machine_numbers_read_back_to_the_same_bits(value: float) -> None:
    written = round_trip_text(value)
    assert written is not None
    assert float(written).hex() == (value + 0.0).hex()


@given(FLOATS)
def test_machine_numbers_are_the_shortest_that_do(value: float) -> None:
    written = round_trip_text(value)
    digits = len(Decimal(written or "").normalize().as_tuple().digits)
    shorter = f"{value:.{max(digits - 2, 0)}e}" if digits > 1 else "nan"
    assert float(shorter) != value


@given(FRACTIONS)
def test_a_fraction_is_rounded_once(value: Fraction) -> None:
    written = round_trip_text(value)
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


@given(FRACTIONS, st.integers(ROUND_TRIP, 40))
def test_text_of_seventeen_digits_reads_back_as_the_float_of_machines(
    value: Fraction, digits: int
) -> None:
    rounded = float_or_none(value)
    assume(rounded)
    assert float(significant(value, digits)) == rounded


@pytest.mark.parametrize("below", [2.209278197011611, -8.626903632435097, 1e-300, 3e300])
@pytest.mark.parametrize("side", [1, -1])
def test_a_value_halfway_between_two_floats_is_written_as_the_float_of_machines(
    below: float, side: int
) -> None:
    """The 17 digits of such a value are as near to its other neighbour."""
    halfway = (Fraction(below) + Fraction(nextafter(below, inf))) / 2
    value = halfway * (1 + side * Fraction(1, 1 << 90))
    assert float(significant(value, ROUND_TRIP)) == float(value)


@given(FRACTIONS, st.integers(1, ROUND_TRIP - 1))
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
    assert round_trip_text(value) is None


def test_minus_zero_is_zero() -> None:
    assert round_trip_text(-0.0) == "0.0"
