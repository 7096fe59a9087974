"""A number for people: 1/3 and √3/2 where it is that, its decimals, or both.

What counts as short enough is said in `nmatrix.surds`; here it is written, as one line of text or
as the formula that every notation prints.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from fractions import Fraction

from nmatrix.enums import Numbers
from nmatrix.formula import Name, Node, Numeral, Power, Quotient, Root, Row, Sign
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
    exact = short_number(value) if options.numbers is Numbers.EXACT else None
    return significant(value, options.digits) if exact is None else _line(exact)


def formula_of(value: Shown, options: OutputOptions) -> Node:
    """Write a number as a formula.

    Examples
    --------
    >>> formula_of(1 / 3, OutputOptions(numbers=Numbers.EXACT))
    Quotient(top=Numeral(text='1'), bottom=Numeral(text='3'))
    """
    if options.numbers is Numbers.BOTH:
        sign = relation([value], options.digits)
        ways = [formula_of(value, one) for one in exact_and_decimal(options)]
        return ways[0] if sign is None else Row((ways[0], Sign(sign), ways[1]))
    exact = short_number(value) if options.numbers is Numbers.EXACT else None
    return _decimal(significant(value, options.digits)) if exact is None else _formula(exact)


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


def _decimal(text: str) -> Node:
    if text.endswith("inf"):
        return Name("∞") if text == "inf" else Row((Sign("−"), Name("∞")))
    mantissa, mark, exponent = text.partition("e")
    if not mark:
        return Numeral(text)
    power = Power(Numeral("10"), str(int(exponent)).replace("-", "−"))
    return Row((Numeral(mantissa), Sign("×"), power))


def _formula(exact: Fraction | Surd) -> Node:
    if isinstance(exact, Fraction):
        tops, bottom = [(1, exact.numerator)], exact.denominator
    else:
        tops, bottom = exact.over_one_denominator
    if bottom == 1 and len(tops) == 1 and tops[0][0] == 1:
        return Numeral(str(tops[0][1]))
    if len(tops) == 1:  # the minus of −√3/2 stands before the bar
        (under, before) = tops[0]
        over = _over(_term(under, abs(before)), bottom)
        return Row((Sign("−"), over)) if before < 0 else over
    items: list[Node] = []
    for under, before in tops:
        if items or before < 0:
            items.append(Sign("−" if before < 0 else "+"))
        items.append(_term(under, abs(before)))
    return _over(Row(tuple(items)), bottom)


def _over(top: Node, bottom: int) -> Node:
    return top if bottom == 1 else Quotient(top, Numeral(str(bottom)))


def _term(under: int, before: int) -> Node:
    if under == 1:
        return Numeral(str(before))
    root = Root(Numeral(str(under)))
    return root if before == 1 else Row((Numeral(str(before)), root))
