"""Angles as they are typed: their units, and the numbers that look as if they had forgotten it."""

from __future__ import annotations

from fractions import Fraction
from math import degrees, pi

import pytest
from hypothesis import given
from hypothesis import strategies as st

from nmatrix.errors import IllegalValueError
from nmatrix.linear.angle import Angle
from nmatrix.reading.angles import NEAR, angle, like_radians, of_pi, radians_remark

TYPED = {
    "30": 30, "-45.5": Fraction(-91, 2), "90deg": 90, "1/3deg": Fraction(1, 3), "90°": 90,
    "pi/2rad": 90, "-3pi/4rad": -135, "2pi/3rad": 120, "pirad": 180, "-pi/6rad": -30,
    "+pi/12rad": 15, "1.5pirad": 270, "2*pi/5rad": 72, "3/4pirad": 135, "π/3rad": 60,
    "−pi/2rad": -90, "pi/7rad": Fraction(180, 7),
    "0.25turn": 90, "1/3turn": 120, "-2turns": -720, " 90deg ": 90,
}  # fmt: skip


@pytest.mark.parametrize("text", TYPED)
def test_an_angle_is_read_in_its_unit(text: str) -> None:
    assert angle(text) == TYPED[text]


@given(st.floats(-1e6, 1e6).filter(lambda x: x == 0 or abs(x) > 1e-6))
def test_radians_are_the_nearest_degrees(radians: float) -> None:
    found = angle(f"{radians!r}rad")
    assert float(found) == pytest.approx(degrees(radians), rel=4e-16, abs=1e-300)
    assert Fraction(float(found)) == found


@given(st.integers(-48, 48))
def test_multiples_of_a_twelfth_of_pi_are_exact(twelfths: int) -> None:
    found = Angle.degrees(angle(f"{twelfths}pi/12rad"))
    assert found == Angle.degrees(15 * twelfths)
    assert angle(f"{of_pi(Fraction(twelfths, 12))}rad") == 15 * twelfths


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("pi/2", "a multiple of π is in radians; write pi/2rad"),
        ("-pi", "write -pirad"),
        ("pi/0rad", "nothing is divided by 0"),
        ("90grad", "it is not a number"),
        ("deg", "it is not a number"),
        ("rad", "it is not a number"),
        ("nanrad", "it is not a number"),
        ("infturn", "it is not a number"),
        ("1e400deg", "beyond the largest float64"),
        ("1_0deg", "it is not a number"),
        ("٣deg", "it is not a number"),
        ("", "it is not a number"),
        ("9" * 10**5 + "rad", "characters are too many"),
        ("pi" * 10**5 + "rad", "characters are too many"),
    ],
    ids=lambda text: text[:20],
)
def test_what_is_no_angle_is_refused_in_one_line(text: str, words: str) -> None:
    with pytest.raises(IllegalValueError, match=words) as caught:
        angle(text)
    assert len(str(caught.value)) < 300


LOOKS = ["0 1.5708 0", "1.571 0 0", "-0.7854", "0.785 3 0", "(0, 2.0944, 0)", "1.0472", "6.2830",
         "90deg 1.5708 0"]  # fmt: skip
LOOKS_NOT = ["0 3 0", "0.5 0 0", "0 0 0", "90 1.5708 0", "0 1.5708rad 0", "1.57", "30", "6.3",
             "6.2832", "0.26", "1 2 3", "pi/2rad 0 0", "0.0004"]  # fmt: skip


@pytest.mark.parametrize("text", LOOKS)
def test_numbers_that_look_like_radians_are_remarked(text: str) -> None:
    assert "looks like radians" in (radians_remark(text, "rotate") or "")


@pytest.mark.parametrize("text", LOOKS_NOT)
def test_other_numbers_are_not(text: str) -> None:
    assert radians_remark(text, "rotate") is None


@given(st.integers(-24, 24), st.floats(-6e-4, 6e-4))
def test_near_is_what_the_rule_says(twelfths: int, off: float) -> None:
    typed = twelfths * pi / 12 + off
    gap = abs(off)
    if abs(gap - float(NEAR)) < 1e-9 or abs(abs(typed) - 2 * pi) < 1e-9:
        return
    expected = twelfths != 0 and gap < float(NEAR) and abs(typed) < 2 * pi
    assert (like_radians([Fraction(typed)]) is not None) is expected


@pytest.mark.parametrize("text", LOOKS)
def test_what_the_remark_says_to_write_is_that_angle(text: str) -> None:
    remark = radians_remark(text, "rotate") or ""
    first, second = remark.split("written ")[1].removesuffix(".").split(" or ")
    assert abs(angle(first) - angle(second)) < NEAR * 180 / Fraction(pi)
    assert "." not in second
