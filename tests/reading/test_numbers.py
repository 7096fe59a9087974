"""Numbers by the contract: nearest float64, or one line that says why not."""

from __future__ import annotations

import re
from decimal import Decimal
from fractions import Fraction

import pytest
from counted import at_most
from hypothesis import given
from hypothesis import strategies as st

from nmatrix.errors import IllegalValueError
from nmatrix.reading import numbers as reading
from nmatrix.reading.numbers import fraction, fractions, number, number_or_infinity, numbers

GRAMMAR = re.compile(r"[+-]?([0-9]+(\.[0-9]+)?|\.[0-9]+)([eE][+-]?[0-9]+)?|[+-]?[0-9]+/[+-]?[0-9]+")


@given(st.from_regex(GRAMMAR, fullmatch=True))
def test_what_the_grammar_allows_is_the_nearest_float(text: str) -> None:
    try:
        found = number(text)
    except IllegalValueError as refusal:
        assert any(reason in str(refusal) for reason in ("beyond", "below", "divided by 0"))
        return
    if "/" in text:
        top, bottom = map(int, text.split("/"))
        assert found == float(Fraction(top, bottom))
    else:
        assert found == float(text)


@given(st.text(alphabet="0123456789+-.eE/_ ,xnaif٣−", max_size=8))
def test_what_the_grammar_forbids_is_refused(text: str) -> None:
    if GRAMMAR.fullmatch(text.strip().replace("−", "-")):
        return
    with pytest.raises(IllegalValueError, match=r"\A[^\n]*\Z"):
        number(text)


@given(st.decimals(allow_nan=False, allow_infinity=False, min_value=-(10**9), max_value=10**9))
def test_fractions_keep_every_digit(value: Decimal) -> None:
    text = f"{value:f}"
    assert fraction(text) == Fraction(value)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1/3", 1 / 3),
        ("-2/-4", 0.5),
        ("−2.5e-1", -0.25),
        (".5", 0.5),
        ("+1E+2", 100.0),
        ("5e-324", 5e-324),
        ("4.9e-324", 5e-324),
        ("1.7976931348623157e308", 1.7976931348623157e308),
        ("0e99999999999", 0.0),
        ("9007199254740993/1", 9007199254740992.0),
    ],
)
def test_values(text: str, value: float) -> None:
    assert number(text) == value


def test_minus_zero_is_zero() -> None:
    assert number("-0.0").hex() == "0x0.0p+0"


@pytest.mark.parametrize(
    "text", ["1.", "1_0", "nan", "inf", "0x1", "1e", "", " ", "1/0", "½", "1 2"]
)
def test_not_numbers(text: str) -> None:
    with pytest.raises(IllegalValueError):
        number(text)


@pytest.mark.parametrize("text", ["1e400", "-1e309", "1e-400", "3e-324", "1/" + "9" * 400])
def test_beyond_float64(text: str) -> None:
    with pytest.raises(IllegalValueError, match="float64"):
        number(text)


@pytest.mark.parametrize(
    "text", ["1e20000000", "1e-20000000", "1" * 10**6, "1/" + "3" * 10**6, "0." + "0" * 10**6 + "1"]
)
def test_giants_are_refused_in_one_line_before_any_integer_is_made(text: str, monkeypatch) -> None:
    made: list[tuple] = []
    for kind in ("Fraction", "int"):
        monkeypatch.setattr(reading, kind, lambda *parts: made.append(parts), raising=False)
    with pytest.raises(IllegalValueError) as caught, at_most(50):
        fraction(text)
    assert not made
    assert len(str(caught.value)) < 200


@pytest.mark.parametrize("text", ["-3 0 -1.5", "-3,0,-1.5", " -3 , 0\t-1.5 ", "-3,0 -3/2"])
def test_three_numbers(text: str) -> None:
    assert numbers(text, 3, "--translate") == (-3.0, 0.0, -1.5)
    assert fractions(text, 3, "--translate")[2] == Fraction(-3, 2)


@pytest.mark.parametrize(("text", "got"), [("1 2", 2), ("", 0), ("1 2 3 4", 4)])
def test_a_wrong_count_names_the_option_and_both_counts(text: str, got: int) -> None:
    with pytest.raises(IllegalValueError, match=f"--eye .*takes 3 numbers, got {got}"):
        numbers(text, 3, "--eye")


@pytest.mark.parametrize("text", ["1,,2", "1,2,", ",1,2"])
def test_no_number_may_be_missing_between_commas(text: str) -> None:
    with pytest.raises(IllegalValueError):
        numbers(text, 3, "--eye")


def test_only_the_far_plane_may_be_infinite() -> None:
    assert number_or_infinity("inf") == float("inf")
    for text in ("-inf", "Infinity", "INF", "nan"):
        with pytest.raises(IllegalValueError):
            number_or_infinity(text)
