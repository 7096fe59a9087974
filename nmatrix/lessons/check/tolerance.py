"""How far an entry of an answer may be off: by the digits it claims, and by what stands beside it.

Entries of one matrix differ in kind. A translation of 5,000 says nothing of how well the rotation
beside it is known, so an entry is held against the largest of its own kind, its *yardstick*: of
its column of the 3×3 block (the image of one axis), of the translation, of the bottom row, of x, y
and z.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from fractions import Fraction

from nmatrix.linear.rational import (
    ONE,
    RationalMatrix,
    RationalVector,
    linear_part,
    translation,
    transpose,
)

RELATIVE = Fraction(5, 10_000)  # of the yardstick: three good digits, whatever was rounded first
NOT_ALL = Fraction(9, 10)  # of the largest: a zero in its place is never right by rounding
A_TWENTIETH = Fraction(1, 20)  # of the largest entry: no last place of a direction is coarser
FEWEST = Fraction(1, 100)  # of a mistake, a whole number and a zero tell two decimals
CUT_OFF = Fraction(1, 1000)  # from three decimals on they may have been cut off, not rounded
NOISE = Fraction(1, 10**9)  # of the yardstick: what float64 leaves of a careful computation


class Written(Enum):
    """How an entry was written: with a point, or as a whole number or a fraction; zeros apart.

    In the bottom row every zero is a bare one: it tells a matrix from its transpose.
    """

    DECIMAL = "1.25"
    WHOLE = "2, 1/3"
    DECIMAL_ZERO = "0.0"
    BARE_ZERO = "0"

    @property
    def is_exact(self) -> bool:
        """Whether all digits are claimed, also those that were not typed."""
        return self in (Written.WHOLE, Written.BARE_ZERO)


@dataclass(frozen=True, eq=False)
class EntryDifference:
    """How far one entry of an answer is off, and what that is held against.

    `place` is one unit of the last decimal that counts, `largest` the largest entry of all.
    """

    difference: Fraction
    place: Fraction
    yardstick: Fraction
    largest: Fraction
    written: Written

    def is_near(self) -> bool:
        """Decide if the entry counts as right.

        Written with a point it may be off by half a unit of its last place, by a whole unit from
        three decimals on, or by 5e-4 of the largest of its kind; a whole number or a fraction
        claims all of its digits.

        Examples
        --------
        Two thirds, typed as 0.67, 0.66, 0.666 and 1.

        >>> [EntryDifference(off, place, Fraction(2, 3), Fraction(1), written).is_near()
        ...  for off, place, written in (
        ...     (Fraction(1, 300), Fraction(1, 100), Written.DECIMAL),
        ...     (Fraction(2, 300), Fraction(1, 100), Written.DECIMAL),
        ...     (Fraction(2, 3000), Fraction(1, 1000), Written.DECIMAL),
        ...     (Fraction(1, 3), Fraction(1), Written.WHOLE))]
        [True, False, True, False]
        """
        if self.written.is_exact:
            return self.difference <= NOISE * self.yardstick
        rounded = self.place if self.place <= CUT_OFF else self.place / 2
        if self.written is Written.DECIMAL_ZERO:
            rounded = min(rounded, FEWEST / 2)
        return self._is_within(max(rounded, RELATIVE * self.yardstick))

    def is_near_a_mistake(self) -> bool:
        """Decide if the entry counts as that of a mistake, which was made with rounded numbers."""
        allowance = RELATIVE * self.yardstick
        counted = min(self.place or FEWEST, FEWEST) / 2 + allowance
        return self.difference <= allowance or self._is_within(counted)

    def is_rounded(self) -> bool:
        """Decide if every digit that was typed is right."""
        if self.difference <= NOISE * self.yardstick:
            return True
        return not self.written.is_exact and self._is_within(self.place / 2)

    def lacks_digits(self) -> bool:
        """Decide if the number may be right, and was written with fewer digits than it takes."""
        counted = (self.place or FEWEST) / 2
        return self.written is not Written.DECIMAL and self._is_within(counted)

    def _is_within(self, most: Fraction) -> bool:
        """Decide if the entry is at most so far off, and no zero hides what matters.

        A bare 0 may not stand for the largest of its kind, and 0.00 not for the largest of all.
        """
        if self.written is Written.DECIMAL_ZERO:
            most = min(most, NOT_ALL * self.largest)
        elif self.written is Written.BARE_ZERO:
            most = min(most, NOT_ALL * self.yardstick)
        return self.difference <= most


def yardsticks(value: RationalMatrix, *, is_vector: bool) -> RationalMatrix:
    """Take the largest entry of each entry's kind; where all of a kind are zero, at most 1.

    Examples
    --------
    >>> [[int(x) for x in row] for row in yardsticks(((ONE * 3, ONE * 7, ONE),), is_vector=True)]
    [[7, 7, 7]]
    """
    if is_vector:
        (row,) = value
        largest = _largest(row[:3], ONE)
        return ((largest,) * 3 + (min(largest, ONE),) * (len(row) - 3),)
    every = min(max(_largest(row, ONE) for row in value), ONE)
    block = tuple(_largest(column, every) for column in transpose(linear_part(value)))
    if len(value) == 3:
        return (block,) * 3
    moved, bottom = _largest(translation(value), every), _largest(value[3][:3], every)
    return (*((*block, moved),) * 3, (bottom, bottom, bottom, max(abs(value[3][3]), every)))


def _largest(entries: RationalVector, of_zeros: Fraction) -> Fraction:
    return max(map(abs, entries)) or of_zeros
