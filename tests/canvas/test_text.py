"""Text as it is set: superscripts are smaller and raised, and what is measured is what is drawn."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from nmatrix.canvas.text import fitting, plain, runs, width, wrapped

WORDS = st.lists(st.text("abcdefgh", min_size=1, max_size=9), min_size=1, max_size=12)


def test_a_superscript_is_two_thirds_as_large_and_stands_higher() -> None:
    base, above, letter = runs("A^{−T}*n*")
    assert (base.scale, base.shift) == (1.0, 0.0)
    assert above.scale == 0.68
    assert above.shift > 0
    assert letter.oblique
    assert width("A^{−T}", 100) == pytest.approx(width("A", 100) + 0.68 * width("−T", 100))


@given(WORDS, st.floats(60, 400))
def test_wrapped_lines_fit_and_lose_no_word(words: list[str], room: float) -> None:
    text = " ".join(words)
    lines = wrapped(text, 22, room)
    assert " ".join(lines) == text
    assert all(width(one, 22) <= room or " " not in one for one in lines)


def test_a_title_takes_the_largest_size_that_fits() -> None:
    text = "a title of some length"
    for size in (36, 40, 44):
        room = width(text, size, bold=True)
        assert fitting(text, range(36, 45), room, bold=True) == size
    assert fitting(text, range(36, 45), 1, bold=True) == 36


def test_a_terminal_gets_characters() -> None:
    assert plain("M^{−1}*l* + x_{2}") == "M⁻¹l + x2"
