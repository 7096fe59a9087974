"""Exact numbers and formulas as one writes them by hand, and answers as one types them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction

from nmatrix.linear.rational import RationalMatrix
from nmatrix.report import Formula, Number
from nmatrix.working import working

LARGEST_BOTTOM = 1000  # of a fraction that is written as one


def formula(*parts: object) -> Formula:
    """Put words, numbers and matrices side by side.

    A matrix is rows of numbers or SymPy's; whatever is no text and no matrix is a number or an
    expression.

    Examples
    --------
    >>> formula("n = ", ((Fraction(1, 2), Fraction(-1)),)).parts
    ('n = ', (('1/2', '−1'),))
    """
    return Formula(tuple(part if isinstance(part, str) else _part(part) for part in parts))


def _part(part: object) -> str | tuple[tuple[str, ...], ...]:
    rows = part.tolist() if hasattr(part, "tolist") else part
    if not isinstance(rows, Sequence):
        return written(rows)
    return tuple(tuple(map(written, row)) for row in rows)


def written(value: object) -> str:
    """Write a number or an expression; a fraction with a large denominator in four digits.

    Examples
    --------
    >>> written(Fraction(-1, 2)), written(Fraction(1, 3001))
    ('−1/2', '0.0003')
    """
    if isinstance(value, Fraction) and value.denominator > LARGEST_BOTTOM:
        return f"{float(value):.4f}".replace("-", "−")
    return working.written(value)


def in_parentheses(values: Iterable[Number]) -> str:
    """Write a point or a vector in a sentence.

    Examples
    --------
    >>> in_parentheses((1, Fraction(-1, 2), 0))
    '(1, −1/2, 0)'
    """
    return f"({', '.join(written(Fraction(value)) for value in values)})"


def typed(rows: RationalMatrix) -> str:
    """Type numbers as a student might, exactly where they are short.

    Examples
    --------
    >>> typed(((Fraction(1, 2), Fraction(-1)), (Fraction(0), Fraction(3))))
    '1/2 -1; 0 3'
    """
    return "; ".join(" ".join(map(_typed, row)) for row in rows)


def _typed(value: Fraction) -> str:
    return str(value) if value.denominator <= LARGEST_BOTTOM else f"{float(value):.9f}"


def column(values: Sequence[Fraction]) -> RationalMatrix:
    """Stand a vector upright, as a matrix of one column."""
    return tuple((value,) for value in values)
