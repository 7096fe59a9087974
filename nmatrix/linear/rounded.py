"""Matrices that were rounded before they came here, and what they may have been.

A is the 3×3 block, h the half units: what was rounded is any matrix X with |X − A| < h, entry by
entry. If a rotation is among these, A is one to the digits given. Whether one is there is decided
by finding it, and what the search finds is checked in exact fractions: a wrong yes is impossible.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import chain
from math import hypot, sqrt

from nmatrix.linear.affine import rotation_from_quaternion
from nmatrix.linear.decompose import quaternion_of
from nmatrix.linear.rational import (
    RationalMatrix,
    RationalVector,
    RoundedMatrix,
    Rows,
    affine_matrix,
    cross,
    determinant,
    dot,
    identity,
    linear_part,
    rational_matrix,
    scaled,
    solve,
    to_floats,
    translation,
    transpose,
)

STEPS = 100  # of the search; most end after three
EXACT = Fraction(1, 10**12)  # of the largest entry: an entry without half units may be so far off
SETTLED = 1e-15  # a rotation in float64 is known to that
# By how much an entry's weight changes in one step, at most, once it is so many half units off.
LEAST, MOST = 0.2, 5.0

AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))

# How the three factors of a turned scale may grow: not at all, all alike, each by itself.
Three = tuple[float, ...]
Tie = tuple[tuple[int, ...], ...]
UNIT: Tie = ((), (), ())
UNIFORM: Tie = ((1,), (1,), (1,))
EACH: Tie = ((1, 0, 0), (0, 1, 0), (0, 0, 1))


def meant(rows: RationalMatrix) -> RationalMatrix:
    """Find the map that a rounded affine matrix stands for: the most special in its half units.

    That is the identity, a rotation, a rotation times one factor or times three, with or without a
    mirror; if none of them rounds to these digits, and for a matrix that is exact, it is the matrix
    itself.

    Examples
    --------
    >>> typed = tuple(tuple(map(Fraction, row)) for row in (
    ...     ("0.6", "-0.801", 0), ("0.801", "0.6", 0), (0, 0, 1)))
    >>> known = tuple(tuple(Fraction(entry.denominator > 5, 500) for entry in row) for row in typed)
    >>> [round(float(entry), 12) for entry in meant(RoundedMatrix.of(typed, known))[0]]
    [0.6, -0.8, 0.0]
    """
    if not isinstance(rows, RoundedMatrix):
        return rows
    block, known = linear_part(rows), linear_part(rows.half_units)
    size = max(abs(entry) for row in block for entry in row)
    # Brought near 1, so that no float overflows on the way; the identity is sought as it stands.
    unit = Fraction(2) ** (size.numerator.bit_length() - size.denominator.bit_length())
    found = _Box(scaled(block, 1 / unit), scaled(known, 1 / unit), unit).most_special()
    if found is None:
        return tuple(rows)
    found = scaled(found, unit)
    return affine_matrix(found, translation(rows)) if len(rows) == 4 else found


@dataclass(frozen=True, eq=False)
class _Box:
    """All 3×3 matrices within half units of one."""

    centre: RationalMatrix
    half_units: RationalMatrix
    unit: Fraction

    @cached_property
    def slack(self) -> Fraction:
        """How far an exact entry may be off: what building a matrix in floats costs."""
        return EXACT * max(abs(entry) for row in self.centre for entry in row)

    @cached_property
    def reach(self) -> RationalVector:
        """The half unit of each entry, row after row, and the slack of those that are exact."""
        return tuple(max(half, self.slack) for half in chain(*self.half_units))

    def most_special(self) -> RationalMatrix | None:
        """Return the most special map that is found inside."""
        if not self._may_be_orthogonal():
            return None
        one = scaled(identity(3), 1 / self.unit)
        if self.holds(one):
            return one
        near_one = Fraction(1, 4) <= self.unit <= 4  # where the entries of a rotation may be
        for tie in (UNIT, UNIFORM, EACH) if near_one else (UNIFORM, EACH):
            found = self._nearest(tie)
            if found is not None:
                return found
        return None

    def holds(self, rows: RationalMatrix) -> bool:
        """Decide exactly if a matrix lies strictly within the half units."""
        return all(abs(off) < 1 for off in self._off(rows))

    def _off(self, rows: RationalMatrix) -> list[Fraction]:
        """Measure how far each entry is off, in its half units."""
        entries = zip(chain(*self.centre), chain(*rows), self.reach, strict=True)
        return [(middle - entry) / reach for middle, entry, reach in entries]

    def _may_be_orthogonal(self) -> bool:
        """Rule out columns whose products are farther from 0 than the half units reach."""
        columns, known = transpose(self.centre), transpose(self.half_units)
        sizes = [tuple(map(abs, column)) for column in columns]
        for i, j in ((0, 1), (0, 2), (1, 2)):
            moved = dot(sizes[i], known[j]) + dot(known[i], sizes[j]) + dot(known[i], known[j])
            if abs(dot(columns[i], columns[j])) > moved + EXACT * dot(sizes[i], sizes[j]):
                return False
        return bool(determinant(self.centre))

    def _nearest(self, tie: Tie) -> RationalMatrix | None:
        """Search for a turned (and mirrored) scale inside, its three factors tied.

        Each step goes to the least sum of squares of what the entries are off, in half units;
        those that are far off weigh more the next time (Lawson's iteration), so that it ends where
        the worst entry is as near as it can be.
        """
        turned = _nearest_orthogonal(to_floats(self.centre))
        factors: Three = (float(1 / self.unit),) * 3 if tie is UNIT else (1.0,) * 3
        weights = [1.0] * 9
        for _ in range(STEPS):
            if turned is None or min(factors) <= 0:
                return None
            found = _exact(turned, factors)
            off = self._off(found)
            if all(abs(one) < 1 for one in off):
                return found
            weights = [w * _weight(x) for w, x in zip(weights, off, strict=True)]
            turn, growth = self._step(turned, factors, tie, list(zip(weights, off, strict=True)))
            turned = _nearest_orthogonal(_turned(turned, turn))
            factors = tuple(s + d for s, d in zip(factors, growth, strict=True))
        return None

    def _step(
        self, turned: Rows, factors: Three, tie: Tie, pulls: Sequence[tuple[float, Fraction]]
    ) -> tuple[Three, Three]:
        """Solve for the small turn, and the growth of the factors, that bring the entries nearest.

        `pulls` are the weight of each entry and how far it is off.
        """
        columns = transpose(turned)
        slopes = [
            [cross(axis, columns[j])[i] * factors[j] for axis in AXES]
            + [turned[i][j] * t for t in tie[j]]
            for i in range(3)
            for j in range(3)
        ]
        weighted = [
            [Fraction(weight * slope) / reach for slope in row]
            for row, (weight, _), reach in zip(slopes, pulls, self.reach, strict=True)
        ]
        aims = [Fraction(weight) * off for weight, off in pulls]
        across = transpose(weighted)
        normal = tuple(tuple(dot(p, q) for q in across) for p in across)
        found = tuple(float(x) for x in solve(normal, tuple(dot(p, aims) for p in across)))
        return found[:3], tuple(_dot(row, found[3:]) for row in tie)


def _nearest_orthogonal(X: Rows) -> Rows | None:
    """Return the orthogonal matrix nearest to X with its columns at length one, if X has rank 3."""
    sizes = [hypot(*(row[j] for row in X)) for j in range(3)]
    if min(sizes) == 0:
        return None
    Q = tuple(tuple(row[j] / sizes[j] for j in range(3)) for row in X)
    for _ in range(STEPS):  # Newton's iteration: Q ← (Q + Q⁻ᵀ)/2, which squares the error
        cofactors = cross(Q[1], Q[2]), cross(Q[2], Q[0]), cross(Q[0], Q[1])
        det = _dot(Q[0], cofactors[0])
        if abs(det) < SETTLED:
            return None
        better = tuple(
            tuple((q + c / det) / 2 for q, c in zip(row, other, strict=True))
            for row, other in zip(Q, cofactors, strict=True)
        )
        if max(abs(p - q) for p, q in zip(chain(*better), chain(*Q), strict=True)) < SETTLED:
            return better
        Q = better
    return Q


def _exact(turned: Rows, factors: Three) -> RationalMatrix:
    """Return an exact rotation, or mirror, near a float one, times exact factors."""
    sign = 1 if _dot(turned[0], cross(turned[1], turned[2])) > 0 else -1
    proper = rational_matrix(tuple(sign * x for x in row) for row in turned)
    R = rotation_from_quaternion(quaternion_of(proper))
    stretch = [sign * Fraction(factor) for factor in factors]
    return tuple(tuple(entry * s for entry, s in zip(row, stretch, strict=True)) for row in R)


def _weight(off: Fraction) -> float:
    """Return how much more an entry counts once it was so many half units off: its damped size."""
    return sqrt(min(max(abs(float(off)), LEAST), MOST))


def _turned(Q: Rows, turn: Three) -> Rows:
    moved = [
        tuple(q + d for q, d in zip(column, cross(turn, column), strict=True))
        for column in transpose(Q)
    ]
    return transpose(moved)


def _dot(a: Sequence[float], b: Sequence[float]) -> float:
    return sum(x * y for x, y in zip(a, b, strict=True))
