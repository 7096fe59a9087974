"""How far an entry of an answer may be off: by the digits it claims, and by what stands beside it.

Entries of one matrix differ in kind. A translation of 5,000 says nothing of how well the rotation
beside it is known, so an entry is held against the largest of its own kind, its *yardstick*: of
its column (the image of one axis, or of the origin), of the bottom row, of x, y and z.
"""

from __future__ import annotations

from fractions import Fraction

from nmatrix.linear.rational import ONE, RationalMatrix, RationalVector

RELATIVE = Fraction(5, 10_000)  # of the largest entry of all: three good digits
ONE_PERCENT = Fraction(1, 100)  # of the yardstick: where entries of another kind are far larger
COARSEST = Fraction(1, 10)  # of the yardstick: one digit that may be one off is no answer
NOT_ALL = Fraction(9, 10)  # of the yardstick: so that zeros are never right by rounding
A_TWENTIETH = Fraction(1, 20)  # of the largest entry: 3 degrees, where length is free
NOISE = Fraction(1, 10**9)  # of the yardstick: what float64 leaves of a careful computation


def is_near(off: Fraction, place: Fraction, yardstick: Fraction, largest: Fraction) -> bool:
    """Return whether an entry that is so far off counts as right.

    It may be off by one unit of its last place (by half a unit, where one is much beside the
    yardstick), or by 5e-4 of the largest entry of all.

    Examples
    --------
    An entry beside a translation of 5,000: 0.51 for 0.5, and 0.6 for it.

    >>> half, place = Fraction(1, 2), Fraction(1, 100)
    >>> [is_near(off, place, half, Fraction(5000)) for off in (Fraction(1, 100), Fraction(1, 10))]
    [True, False]
    """
    if off <= place and (off <= COARSEST * yardstick or is_rounding(off, place, yardstick)):
        return True
    return off <= RELATIVE * largest and off <= ONE_PERCENT * yardstick


def is_rounding(off: Fraction, place: Fraction, yardstick: Fraction) -> bool:
    """Return whether every digit of an entry that is so far off is right."""
    return off <= max(min(place / 2, NOT_ALL * yardstick), NOISE * yardstick)


def coarsest_of_free_length(value: RationalMatrix) -> Fraction:
    """Return the coarsest last place of an answer that may be as long as one likes.

    Digits are claimed by the longest: in (0.01, 0, 0) two decimals tell nearly nothing of where it
    points.
    """
    return A_TWENTIETH * max(abs(entry) for row in value for entry in row)


def yardsticks(value: RationalMatrix, *, is_vector: bool) -> RationalMatrix:
    """Return the largest entry of each entry's kind; where all of a kind are zero, at most 1.

    Examples
    --------
    >>> moved = ((Fraction(1, 2), Fraction(5000)), (Fraction(1, 4), Fraction(0)))
    >>> [[float(x) for x in row] for row in yardsticks(moved, is_vector=False)]
    [[0.5, 5000.0], [0.5, 5000.0]]
    """
    if is_vector:
        (row,) = value
        largest = _largest(row[:3], ONE)
        return ((largest,) * 3 + (min(largest, ONE),) * (len(row) - 3),)
    top, bottom = value[:3], value[3:]
    every = max(_largest(row, ONE) for row in value)
    columns = tuple(_largest(column, min(every, ONE)) for column in zip(*top, strict=True))
    return (columns,) * len(top) + tuple((_largest(row, ONE),) * len(row) for row in bottom)


def _largest(entries: RationalVector, of_zeros: Fraction) -> Fraction:
    return max(map(abs, entries)) or of_zeros
