"""One rounding of a map that keeps what is exact about it: rank, mirror, and what vanishes.

A turned and sheared map with a scale of 0 has the determinant 0. Rounded entry by entry it has one
of about 1e-17, and half of the time it is below 0: a flat body would be called mirrored.
"""

from __future__ import annotations

from fractions import Fraction

from nmatrix.linear.exact import LinearMap
from nmatrix.linear.rational import (
    ZERO,
    RationalMatrix,
    affine_matrix,
    linear_part,
    rank,
    rational_matrix,
    rounded_for_display,
    translation,
)
from nmatrix.linear.rounding import quotient

FACTOR_BITS = 128  # of the factors of a block that has grown too long
LONGEST = 1024  # bits of the entries that stay as they are: some turned parents above each other
PLACES = [(i, j) for i in range(3) for j in range(3)]
FAINTEST = Fraction(1, 1 << 2300)  # of the largest entry: float64 spans 2098 bits


def rounded_keeping_rank(A: RationalMatrix) -> RationalMatrix:
    """Round an affine matrix to floats, but not its 3×3 block where that would change its kind.

    The block stays exact if rounding would change its rank, the sign of its determinant or the
    directions that it takes to zero, on which the rank of its products depends; and an entry
    beyond the largest float64 stays what it is. So ranks multiply down a hierarchy as they do in
    exact numbers, and signs do, too. Where the fractions of a block grow beyond `LONGEST` bits,
    it is shortened to a near one of the same rank and sign.

    Examples
    --------
    >>> third = Fraction(1, 3)
    >>> flat = affine_matrix(((third, 2 * third, third), (third, 2 * third, 0), (third,) * 3))
    >>> [float(entry) for entry in rounded_keeping_rank(flat)[0]]
    [0.3333333333333333, 0.6666666666666666, 0.3333333333333333, 0.0]
    """
    rounded = rounded_for_display(A)
    block = LinearMap.of(linear_part(A))
    if _alike(block, LinearMap.of(linear_part(rounded))):
        return rounded
    longest = max(entry.bit_length() for row in block.entries for entry in row)
    kept = linear_part(A) if longest <= LONGEST else _shortened(block)
    return affine_matrix(kept, translation(rounded))


def _alike(block: LinearMap, rounded: LinearMap) -> bool:
    if block.determinant_sign != rounded.determinant_sign:
        return False
    if block.determinant_sign:
        return True
    both = rational_matrix((*block.entries, *rounded.entries))
    return block.rank == rounded.rank == rank(both)


def _shortened(block: LinearMap) -> RationalMatrix:
    """Round the factors of a block: the pivot · column · row that elimination splits it into.

    The largest entry left is the pivot. As a column is 1 in its pivot's row and 0 in the rows of
    those before, the pivots alone decide rank and sign, and rounding keeps theirs.
    """
    rest, bottom = block.entries, block.denominator
    found: list[RationalMatrix] = []
    least = ZERO
    while any(map(any, rest)):
        i, j = max(PLACES, key=lambda at: abs(rest[at[0]][at[1]]))
        pivot, row, column = rest[i][j], rest[i], [one[j] for one in rest]
        size = quotient(pivot, bottom, FACTOR_BITS)
        least = least or abs(size) * FAINTEST
        if abs(size) < least:
            size = least if size > 0 else -least
        across = [quotient(entry, pivot, FACTOR_BITS) for entry in row]
        down = [size * quotient(entry, pivot, FACTOR_BITS) for entry in column]
        found.append(tuple(tuple(d * a for a in across) for d in down))
        rest = tuple(
            tuple(pivot * entry - c * r for entry, r in zip(one, row, strict=True))
            for one, c in zip(rest, column, strict=True)
        )
        bottom *= pivot
    return tuple(tuple(sum((one[i][j] for one in found), ZERO) for j in range(3)) for i in range(3))
