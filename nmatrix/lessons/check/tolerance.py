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
    ZERO,
    RationalMatrix,
    RationalVector,
    linear_part,
    translation,
    transpose,
)

RELATIVE = Fraction(5, 10_000)  # of the largest entry of all: three good digits
ITS_OWN = Fraction(1, 400)  # of the yardstick: where entries of another kind are far larger
NOT_ALL = Fraction(9, 10)  # of the largest: a zero in its place is never right by rounding
A_TWENTIETH = Fraction(1, 20)  # of the largest entry: no last place of a direction is coarser
FEWEST = Fraction(1, 100)  # a whole number claims two decimals
NOISE = Fraction(1, 10**9)  # of the yardstick: what float64 leaves of a careful computation


class Zero(Enum):
    """Whether a zero was typed, and with how many decimals: some, or none.

    In the bottom row every zero is a bare one: it tells a matrix from its transpose.
    """

    NONE = 0
    ROUNDED = 1
    BARE = 2


@dataclass(frozen=True)
class EntryDifference:
    """How far one entry of an answer is off, and what that is held against.

    `place` is one unit of the last decimal that counts, `largest` the largest entry of all.
    """

    difference: Fraction
    place: Fraction
    yardstick: Fraction
    largest: Fraction
    zero: Zero

    def is_near(self) -> bool:
        """Decide if the entry counts as right.

        It may be off by half a unit of its last place, at least two decimals counted, and besides
        by 5e-4 of the largest of its kind, for what was rounded on the way; or by 5e-4 of the
        largest entry of all, unless that is much beside it.

        Examples
        --------
        A half beside a translation of 5,000, typed as 0.506 and as 0.51.

        >>> half, all_ = Fraction(1, 2), Fraction(5000)
        >>> [EntryDifference(off, place, half, all_, Zero.NONE).is_near()
        ...  for off, place in ((Fraction(1, 1000), Fraction(1, 1000)), (Fraction(1, 100),) * 2)]
        [True, False]
        """
        allowance = min(RELATIVE * self.largest, ITS_OWN * self.yardstick)
        return self.difference <= allowance or self.is_near_a_mistake()

    def is_near_a_mistake(self) -> bool:
        """Decide if the entry counts as that of a mistake: among its own kind alone."""
        allowance = RELATIVE * self.yardstick
        return self.difference <= allowance or self._is_half(min(self.place, FEWEST), allowance)

    def is_rounded(self) -> bool:
        """Decide if every digit that was typed is right."""
        return self.difference <= NOISE * self.yardstick or self._is_half(self.place)

    def _is_half(self, place: Fraction, allowance: Fraction = ZERO) -> bool:
        """Decide if the entry is at most half a unit off, and no zero hides what matters.

        0.00 is a rounded number, and a bare 0 is none: it may not stand for the largest of its
        kind, and 0.00 not for the largest of all.
        """
        hidden = {Zero.NONE: None, Zero.ROUNDED: self.largest, Zero.BARE: self.yardstick}[self.zero]
        most = place / 2 + allowance
        return self.difference <= (most if hidden is None else min(most, NOT_ALL * hidden))


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
