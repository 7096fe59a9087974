"""A number for people: 1/3 and √3/2 where it is that, its decimals, or both.

What counts as short enough is said in `nmatrix.surds`; documents write it as a formula.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from fractions import Fraction

from nmatrix.enums import Numbers
from nmatrix.output.numbers import significant
from nmatrix.output.write import OutputOptions
from nmatrix.report import Shown
from nmatrix.surds import Surd, short_number

NEAR, SAME = "≈", "="


def written(value: Shown, options: OutputOptions) -> str:
    """Write a number on one line.

    Examples
    --------
    >>> [written(3**0.5 / 2, OutputOptions(numbers=one)) for one in Numbers]
    ['√3/2', '0.866025', '√3/2 ≈ 0.866025']
    """
    if options.numbers is Numbers.BOTH:
        sign = relation([value], options.digits)
        ways = [written(value, one) for one in exact_and_decimal(options)]
        return ways[0] if sign is None else f"{ways[0]} {sign} {ways[1]}"
    exact = short_form(value, options)
    return significant(value, options.digits) if exact is None else _line(exact)


def short_form(value: Shown, options: OutputOptions) -> Fraction | Surd | None:
    """Find the short exact number that a value is, if such numbers are wanted."""
    return short_number(value) if options.numbers is Numbers.EXACT else None


def exact_and_decimal(options: OutputOptions) -> tuple[OutputOptions, OutputOptions]:
    """Part the options of both ways into those of each."""
    return replace(options, numbers=Numbers.EXACT), replace(options, numbers=Numbers.DECIMAL)


def relation(values: Iterable[Shown], digits: int) -> str | None:
    """Find the sign between numbers and their decimals: ≈, = if nothing is lost, None if alike.

    Examples
    --------
    >>> relation([0.5, 1 / 3], 6), relation([0.5, 2], 6), relation([2, 0.123456789], 6)
    ('≈', '=', None)
    """
    pairs = [(short_number(one), significant(one, digits)) for one in values]
    told = [(exact, text) for exact, text in pairs if exact is not None and _line(exact) != text]
    if not told:
        return None
    return SAME if all(exact == Fraction(text) for exact, text in told) else NEAR


def _line(exact: Fraction | Surd) -> str:
    """Write it without blanks, which part the numbers of a row, and with a decimal's minus."""
    return str(exact).replace("−", "-").replace(" ", "")
