"""How far an entry of an answer may be off: by the digits it claims, and by what stands beside it.

Entries of one matrix differ in kind. A translation of 5,000 says nothing of how well the rotation
beside it is known, so an entry is held against the largest of its own kind, its *yardstick*: of
its column (the image of one axis, or of the origin), of the bottom row, of x, y and z.
"""

from __future__ import annotations

from fractions import Fraction

from nmatrix.lessons.check.question import Question
from nmatrix.linear.rational import ONE, RationalMatrix, RationalVector

RELATIVE = Fraction(5, 10_000)  # of the largest entry of all: three good digits
ONE_PERCENT = Fraction(1, 100)  # of the yardstick: where entries of another kind are far larger
COARSEST = Fraction(1, 10)  # of the yardstick: one digit that may be one off is no answer
NOT_ALL = Fraction(9, 10)  # of the yardstick: so that zeros are never right by rounding
NOISE = Fraction(1, 10**9)  # of the yardstick: what float64 leaves of a careful computation


def limits(value: RationalMatrix, places: RationalMatrix, question: Question) -> RationalMatrix:
    """Return how far each entry may be off.

    One unit of its last place (half a unit where that is much), or 5e-4 of the largest entry.

    Examples
    --------
    A translation of 5,000 with a half beside it, both typed with two decimals.

    >>> from nmatrix.lessons.check.question import Subject
    >>> from nmatrix.scene.shot import Shot
    >>> half, place = Fraction(1, 2), Fraction(1, 100)
    >>> moved = ((half, Fraction(5000)), (half, Fraction(0)))
    >>> [[float(x) for x in row] for row in limits(
    ...     moved, ((place, place), (place, place)), Question(Subject.WORLD, Shot()))]
    [[0.01, 2.5], [0.01, 2.5]]
    """
    if question.tolerance is not None:
        return tuple((question.tolerance,) * len(row) for row in value)
    least = RELATIVE * max(abs(entry) for row in value for entry in row)
    return tuple(
        tuple(
            max(
                min(place, COARSEST * yardstick),
                _half(place, yardstick),
                min(least, ONE_PERCENT * yardstick),
            )
            for place, yardstick in zip(places_of_row, row, strict=True)
        )
        for places_of_row, row in zip(places, _yardsticks(value, question), strict=True)
    )


def roundings(value: RationalMatrix, places: RationalMatrix, question: Question) -> RationalMatrix:
    """Return how far each entry may be off and still be the value, rounded to the digits typed."""
    return tuple(
        tuple(
            max(_half(place, yardstick), NOISE * yardstick)
            for place, yardstick in zip(places_of_row, row, strict=True)
        )
        for places_of_row, row in zip(places, _yardsticks(value, question), strict=True)
    )


def _half(place: Fraction, yardstick: Fraction) -> Fraction:
    return min(place / 2, NOT_ALL * yardstick)


def _yardsticks(value: RationalMatrix, question: Question) -> RationalMatrix:
    if question.is_vector:
        (row,) = value
        largest = _largest(row[:3], ONE)
        return ((largest,) * 3 + (min(largest, ONE),) * (len(row) - 3),)
    top, bottom = value[:3], value[3:]
    every = max(_largest(row, ONE) for row in value)
    columns = tuple(_largest(column, min(every, ONE)) for column in zip(*top, strict=True))
    return (columns,) * len(top) + tuple((_largest(row, ONE),) * len(row) for row in bottom)


def _largest(entries: RationalVector, of_zeros: Fraction) -> Fraction:
    return max(map(abs, entries)) or of_zeros
