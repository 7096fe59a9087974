"""Short exact numbers: only what a float is nearest to, in every format for people, read again."""

from __future__ import annotations

import re
from decimal import Decimal, localcontext
from fractions import Fraction
from math import gcd, inf, nextafter
from pathlib import Path

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from nmatrix.calculator.evaluate import calculate
from nmatrix.enums import PARTICULAR_FORMATS, Format, Numbers
from nmatrix.lessons.derive.lesson import derive
from nmatrix.output import OutputOptions, write
from nmatrix.output.assignments import PROGRAMS
from nmatrix.output.exact import written
from nmatrix.output.symbols import LETTERS, label
from nmatrix.output.write import Charset
from nmatrix.report import Brief, Framed, Quantity, Report, Table
from nmatrix.surds import LONGEST, Surd, root, short_number

CONVENTIONS = Path(__file__).parents[2] / "docs" / "conventions.md"
MACHINE = (Format.JSON, Format.CSV, *PROGRAMS)
PEOPLE = [one for one in Format if one not in (*MACHINE, *PARTICULAR_FORMATS)]
EXACT = OutputOptions(numbers=Numbers.EXACT)
TOPS, BOTTOMS, UNDER = (
    st.integers(-999, 999),
    st.integers(1, 1000),
    st.sampled_from([2, 3, 5, 6, 7]),
)


def nearest(before: Fraction, under: int) -> float:
    """The float64 nearest to a root times a fraction, by decimals of a hundred digits."""
    with localcontext() as context:
        context.prec = 100
        exact = Decimal(under).sqrt() * before.numerator / before.denominator
    return float(exact)  # Python rounds decimals correctly


def value_of(exact: Fraction | Surd) -> float:
    """The float64 nearest to an exact number of one term."""
    if isinstance(exact, Fraction):
        return exact.numerator / exact.denominator
    ((under, before),) = exact.terms
    return nearest(before, under)


@given(TOPS, BOTTOMS)
def test_the_float_of_a_fraction_is_that_fraction(top: int, bottom: int) -> None:
    assert short_number(top / bottom) == Fraction(top, bottom)


@given(st.integers(1, 37), st.integers(1, 20), UNDER, st.booleans())
def test_the_float_of_a_root_is_that_root(
    top: int, bottom: int, under: int, is_negative: bool
) -> None:
    before = Fraction(-top if is_negative else top, bottom)
    found = short_number(nearest(before, under))
    assert found == before * root(under)
    assert gcd(top, bottom) > 1 or str(abs(found)).startswith((f"{top}√", "√"))


@given(st.one_of(TOPS, BOTTOMS), BOTTOMS, UNDER, st.integers(1, 3))
@example(1, 3, 2, 1)
def test_the_floats_beside_a_short_number_are_not_it(
    top: int, bottom: int, under: int, steps: int
) -> None:
    for value in (top / bottom, nearest(Fraction(top, bottom), under)):
        for towards in (-inf, inf):
            beside = value
            for _ in range(steps):
                beside = nextafter(beside, towards)
            found = short_number(beside)
            assert found is None or value_of(found) == beside != value


@given(st.floats(0.01, 100))
def test_what_is_written_exactly_is_read_as_the_very_float(value: float) -> None:
    found = short_number(value)
    assert found is None or (value_of(found) == value and len(str(found)) <= LONGEST)


@pytest.mark.parametrize("text", ["0.333333", "0.866025", "0.7071", "1.41421", "1e-05"])
def test_a_decimal_that_was_rounded_stays_one(text: str) -> None:
    assert written(float(text), EXACT) == text


def both(format_: Format, numbers: Numbers, charset: Charset = Charset.UNICODE) -> str:
    values = ((3**0.5 / 2, -0.5), (1 / 3, 0.123456789))
    blocks = (
        Quantity("value", values, "what comes out"),
        Quantity("determinant", 2**0.5),
        Table(("n", "of"), ((1 / 7, "a"),)),
    )
    report = Report("world", {"value": values}, blocks, numbers=numbers)
    return write(report, OutputOptions(format_, charset=charset))


SHOWN = {
    Format.TEXT: ("√3/2", "1/3", "√2", "1/7"),
    Format.LATEX: (r"\frac{\sqrt{3}}{2}", r"\frac{1}{3}", r"\sqrt{2}", r"\frac{1}{7}"),
    Format.MARKDOWN: (r"\frac{\sqrt{3}}{2}", r"\frac{1}{3}", r"\sqrt{2}", r"\frac{1}{7}"),
    Format.TYPST: ("frac(sqrt(3), 2)", "frac(1, 3)", "sqrt(2)", "frac(1, 7)"),
    Format.MATHML: (
        "<mfrac><msqrt><mn>3</mn></msqrt><mn>2</mn></mfrac>",
        "<mfrac><mn>1</mn><mn>3</mn></mfrac>",
        "<msqrt><mn>2</mn></msqrt>",
        "<mfrac><mn>1</mn><mn>7</mn></mfrac>",
    ),
}
DECIMALS = ("0.866025", "0.333333", "1.41421", "0.142857")


@pytest.mark.parametrize("format_", PEOPLE)
def test_every_format_for_people_obeys_the_numbers_of_a_report(format_: Format) -> None:
    for numbers in Numbers:
        text = both(format_, numbers)
        assert all((one in text) is (numbers is not Numbers.DECIMAL) for one in SHOWN[format_])
        assert all((one in text) is (numbers is not Numbers.EXACT) for one in DECIMALS)
        assert "0.123457" in text  # which is no short number


@pytest.mark.parametrize("format_", MACHINE)
def test_programs_are_given_the_same_floats_however_people_read_them(format_: Format) -> None:
    assert len({both(format_, numbers) for numbers in Numbers}) == 1


def test_what_is_asked_for_wins_over_the_report() -> None:
    report = Report("calc", {}, (Quantity("value", Fraction(1, 3)),), numbers=Numbers.EXACT)
    shown = {one: write(report, OutputOptions(numbers=one)).split()[1:] for one in Numbers}
    assert shown[Numbers.EXACT] == ["1/3"]
    assert shown[Numbers.DECIMAL] == ["0.333333"]
    assert shown[Numbers.BOTH] == ["1/3", "≈", "0.333333"]
    assert write(report, OutputOptions()) == write(report, EXACT)


def test_derivations_are_exact_by_themselves_and_answers_of_floats_are_not() -> None:
    assert derive("mirror").numbers is Numbers.EXACT
    assert Report("world", {}, ()).numbers is Numbers.DECIMAL


NEAR_A_THIRD = Fraction(1 / 3)  # a float, 1.85e-17 off


def test_a_fraction_that_was_typed_is_never_taken_for_a_shorter_one_beside_it() -> None:
    blocks = (Quantity("value", NEAR_A_THIRD),)
    typed = Report("calc", {}, blocks, numbers=Numbers.EXACT)
    assert write(typed, OutputOptions()).split() == ["value", "0.333333"]
    of_floats = Report("world", {}, blocks)
    assert write(of_floats, EXACT).split() == ["value", "1/3"]


def test_every_fraction_of_an_answer_stands_for_its_float() -> None:
    quantity = Quantity("value", ((NEAR_A_THIRD, 2), (Fraction(10) ** 400, Fraction(0))))
    table = Table(("n",), ((NEAR_A_THIRD,), ("a word",)))
    blocks = (quantity, Framed((table,)))
    found = Report("world", {"a": {"b": [NEAR_A_THIRD]}}, blocks, brief=Brief(blocks)).in_floats()
    assert found.data == {"a": {"b": (1 / 3,)}}
    for shown in (found.blocks, found.brief.blocks if found.brief else ()):
        assert shown[0].value == ((1 / 3, 2), (Fraction(10) ** 400, 0.0))  # type: ignore[union-attr]
        assert shown[1].blocks[0].rows == ((1 / 3,), ("a word",))  # type: ignore[union-attr]


@pytest.mark.parametrize("numbers", Numbers)
def test_text_in_ascii_spells_roots_and_signs(numbers: Numbers) -> None:
    text = both(Format.TEXT, numbers, Charset.ASCII)
    assert text.isascii()
    assert ("sqrt(3)/2" in text) is (numbers is not Numbers.DECIMAL)
    assert (" ~ " in text) is (numbers is Numbers.BOTH)


def test_typst_compiles_fractions_roots_letters_and_eight_columns(tmp_path: Path) -> None:
    typst = pytest.importorskip("typst")
    corners = tuple(tuple(root(1 + 8 * r + c) / 3 for c in range(8)) for r in range(4))
    blocks = tuple(Quantity(key, corners, "corners") for key in (*LETTERS, "corners"))
    for numbers in Numbers:
        text = write(Report("calc", {}, blocks), OutputOptions(Format.TYPST, numbers=numbers))
        source = tmp_path / "exact.typ"
        source.write_text(text, encoding="utf-8")
        assert typst.compile(str(source)).startswith(b"%PDF")


def test_points_and_the_ends_of_whole_numbers_stand_in_one_column() -> None:
    values = ((3**0.5 / 2, 1.0), (-0.25, 10.0), (0.123456, -1 / 3))
    lines = write(Report("world", {}, (Quantity("v", values),)), EXACT).splitlines()[1:]
    ends = {
        line.index(entry) + len(entry)
        for line, entry in zip(lines, ("√3/2", "-1/4", "0"), strict=True)
    }
    assert len(ends) == 1


@pytest.mark.parametrize("key", LETTERS)
def test_a_quantity_has_one_letter_in_every_notation_and_in_the_documentation(key: str) -> None:
    assert f"| {LETTERS[key]} | `{key}` |" in CONVENTIONS.read_text(encoding="utf-8")
    values = ((1.0, 2.0), (3.0, 4.0))
    report = Report("world", {}, (Quantity(key, values),))
    names = {one: write(report, OutputOptions(one)) for one in PEOPLE}
    assert label(key, "")[1] == ""
    assert (
        names[Format.MARKDOWN].split("$$")[1] == names[Format.LATEX].split("\\[")[1].split("\\]")[0]
    )
    assert r"\text{" not in names[Format.LATEX]
    assert "<mtext>" not in names[Format.MATHML]
    assert not re.search(r'(?<!op\()"\w', names[Format.TYPST])


@given(st.lists(st.tuples(TOPS, BOTTOMS, st.integers(1, 30)), min_size=1, max_size=3))
def test_sums_products_and_quotients_of_roots_are_exact(terms: list[tuple[int, int, int]]) -> None:
    """Against decimals of a hundred digits; what cancels is the fraction 0."""
    total: Fraction | Surd = Fraction(0)
    with localcontext() as context:
        context.prec = 100
        decimal = Decimal(0)
        for top, bottom, under in terms:
            total = total + Fraction(top, bottom) * root(under)
            decimal += Decimal(under).sqrt() * top / bottom
        square, inverse = (
            decimal * decimal,
            1 / decimal if abs(decimal) > Decimal("1e-60") else None,
        )
        assert float(total) == pytest.approx(float(decimal), rel=1e-15, abs=1e-60)
        assert float(total * total) == pytest.approx(float(square), rel=1e-15, abs=1e-100)
    assert total - total == 0
    if inverse is None:
        assert total == 0
    else:
        assert float(1 / total) == pytest.approx(float(inverse), rel=1e-15)
        assert total * (1 / total) == 1


def test_the_calculator_keeps_a_root_that_others_round() -> None:
    value = calculate("rotate_z(30)", {}).value
    assert written(value.matrix[0][0], EXACT) == "√3/2"  # type: ignore[arg-type]
