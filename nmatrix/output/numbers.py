"""The numbers of a report's data: which they are, under which dotted keys, and as characters."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import isfinite
from typing import TypeGuard

from nmatrix.enums import Layout
from nmatrix.linear.rational import transpose
from nmatrix.linear.rounding import short_text
from nmatrix.report import LARGEST_MATRIX, Shown, ShownMatrix, ShownVector, Step, Value
from nmatrix.surds import Surd

ROUND_TRIP = 17  # digits that every float64 is read back from


def is_number(value: object) -> TypeGuard[Shown]:
    """Recognise a number; a bool is none.

    Examples
    --------
    >>> is_number(1), is_number(True)
    (True, False)
    """
    return isinstance(value, (int, float, Fraction, Surd)) and not isinstance(value, bool)


def is_list(value: object) -> TypeGuard[Sequence[Value]]:
    """Recognise a sequence other than a string."""
    return isinstance(value, Sequence) and not isinstance(value, str)


def is_vector(value: object) -> TypeGuard[ShownVector]:
    """Recognise a list of at least one number, and of nothing else."""
    return is_list(value) and len(value) > 0 and all(is_number(entry) for entry in value)


def is_matrix(value: object) -> TypeGuard[ShownMatrix]:
    """Recognise a matrix: 1 to 8 rows of equally many numbers, 1 to 8 of them.

    Examples
    --------
    >>> is_matrix(((1, 0), (0, 1))), is_matrix(((1, 0), (0,)))
    (True, False)
    """
    if not (is_list(value) and 1 <= len(value) <= LARGEST_MATRIX):
        return False
    sizes = {len(row) if is_vector(row) else 0 for row in value}
    return len(sizes) == 1 and 1 <= sizes.pop() <= LARGEST_MATRIX


def arranged(matrix: ShownMatrix, layout: Layout) -> ShownMatrix:
    """Order the entries as a layout wants them: the rows to write down one after the other."""
    return transpose(matrix) if layout is Layout.COLUMN_MAJOR else matrix


@dataclass(frozen=True)
class Leaf:
    """A value of the data that holds no keys of its own: a scalar, a vector or a matrix."""

    key: str
    value: bool | str | Shown | ShownVector | ShownMatrix | None


def members(step: Step) -> dict[str, Value]:
    """Spread a step of a derivation over the keys that it has in the data.

    Examples
    --------
    >>> from nmatrix.report import Formula
    >>> members(Step(Formula(("A = I",)), "nothing moves", verified=True))["latex"]
    'A = I'
    """
    from nmatrix.output.drawing import draw_formula
    from nmatrix.output.formulas.latex import latex

    return {
        "text": draw_formula(step.formula),
        "latex": latex(step.formula.tree),
        "because": step.because,
        "verified": step.verified,
    }


def leaves(data: Mapping[str, Value], prefix: str = "") -> Iterator[Leaf]:
    """Walk through the data in order; inner keys and positions are joined by dots.

    Examples
    --------
    >>> [leaf.key for leaf in leaves({"spaces": [{"eye": (0, 0, 5)}], "rank": 3})]
    ['spaces.0.eye', 'rank']
    """
    for name, value in data.items():
        yield from _leaves_of(f"{prefix}{name}", value)


def _leaves_of(key: str, value: Value) -> Iterator[Leaf]:
    if isinstance(value, Step):
        value = members(value)
    if isinstance(value, Mapping):
        yield from leaves(value, f"{key}.")
    elif is_matrix(value) or is_vector(value):
        yield Leaf(key, value)
    elif is_list(value):
        yield from leaves({str(place): entry for place, entry in enumerate(value)}, f"{key}.")
    elif value is None or isinstance(value, (bool, str, int, float, Fraction, Surd)):
        yield Leaf(key, value)


def float_or_none(value: Shown) -> float | None:
    """Round a number to the nearest float64; None outside its range; −0 becomes 0.

    Examples
    --------
    >>> float_or_none(Fraction(1, 3)), float_or_none(-0.0), float_or_none(Fraction(10) ** 400)
    (0.3333333333333333, 0.0, None)
    """
    try:
        found = float(value)
    except OverflowError:
        return None
    return found + 0.0 if isfinite(found) else None


def round_trip_text(value: Shown) -> str | None:
    """Write the shortest text that reads back as the same float64; None outside its range.

    Examples
    --------
    >>> round_trip_text(0.1), round_trip_text(Fraction(1, 4)), round_trip_text(7)
    ('0.1', '0.25', '7')
    """
    rounded = float_or_none(value)
    if rounded is None:
        return None
    return str(int(value)) if isinstance(value, int) else float.__repr__(rounded)


def significant(value: Shown, digits: int) -> str:
    """Write so many significant digits, correctly rounded, without trailing zeros.

    Integers that count something stay whole; fractions are rounded from their integers, so that
    a value beyond every float is still shown. Digits that single out a float single out the one
    that machines read.

    Examples
    --------
    >>> significant(2 / 3, 4), significant(-0.0, 6), significant(Fraction(10) ** 600, 6)
    ('0.6667', '0', '1e+600')
    """
    if isinstance(value, Surd):
        value = Fraction(sum(value.between()) / 2)
    if isinstance(value, Fraction):
        text, rounded = short_text(value, digits), float_or_none(value)
        if digits < ROUND_TRIP or not rounded or float(text) == rounded:
            return text
        return short_text(Fraction(rounded), digits)  # the value is halfway between two floats
    if isinstance(value, int):
        return str(int(value)) if abs(value) < 10**15 else short_text(Fraction(value), digits)
    return f"{float(value) + 0.0:.{digits}g}"
