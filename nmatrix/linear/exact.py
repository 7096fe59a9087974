"""The exact level of the accuracy ladder: the normal matrix of a 3×3 block, decided on integers.

A is the block, d its common denominator, so d·A is an integer matrix; C its cofactor matrix.
The normal of a transformed surface is sign(det A) · C · n, at length one.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

from nmatrix.enums import NormalStatus
from nmatrix.errors import NoAnswerError
from nmatrix.linear.angle import DEGREES, PI, exact_angle_between
from nmatrix.linear.rational import RationalMatrix
from nmatrix.linear.rounding import integers, nearest, unit

Integers = tuple[tuple[int, ...], ...]


@dataclass(frozen=True)
class Normal:
    """What became of one normal: its unit direction, or why it has none."""

    direction: tuple[float, ...] | None
    status: NormalStatus
    reason: str


@dataclass(frozen=True)
class LinearMap:
    """A 3×3 block as integers over one denominator; everything asked of it is exact."""

    entries: Integers
    denominator: int

    @classmethod
    def of(cls, rows: Iterable[Iterable[float | Fraction]]) -> LinearMap:
        """Make the map of nine floats or fractions, exactly.

        Examples
        --------
        >>> LinearMap.of([[2, 0, 0], [0, 1, 0], [0, 0, 0.5]]).determinant
        Fraction(1, 1)
        """
        flat, denominator = integers(entry for row in rows for entry in row)
        return cls((tuple(flat[0:3]), tuple(flat[3:6]), tuple(flat[6:9])), denominator)

    @cached_property
    def cofactors(self) -> Integers:
        """Return the cofactor matrix of the integer entries: det(A) A⁻ᵀ, for singular A too."""
        a, b, c = self.entries
        return (
            (b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]),
            (c[1] * a[2] - c[2] * a[1], c[2] * a[0] - c[0] * a[2], c[0] * a[1] - c[1] * a[0]),
            (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]),
        )

    @cached_property
    def integer_determinant(self) -> int:
        """Return the determinant of the integer entries."""
        return sum(x * c for x, c in zip(self.entries[0], self.cofactors[0], strict=True))

    @cached_property
    def gram(self) -> Integers:
        """AᵀA of the integer entries: lengths and angles of the columns of A."""
        columns = list(zip(*self.entries, strict=True))
        return tuple(
            tuple(sum(x * y for x, y in zip(p, q, strict=True)) for q in columns) for p in columns
        )

    @property
    def determinant(self) -> Fraction:
        """Return det A exactly."""
        return Fraction(self.integer_determinant, self.denominator**3)

    @property
    def determinant_sign(self) -> int:
        """Return −1, 0 or 1: a mirror, a flattening, or neither. Never decided by a rounded det."""
        det = self.integer_determinant
        return (det > 0) - (det < 0)

    @cached_property
    def rank(self) -> int:
        """The rank: 3 if det ≠ 0, else 2 if a cofactor ≠ 0, else 1 if an entry ≠ 0, else 0."""
        if self.integer_determinant:
            return 3
        if any(map(any, self.cofactors)):
            return 2
        return int(any(map(any, self.entries)))

    @property
    def cofactor_matrix(self) -> RationalMatrix:
        """Return C exactly."""
        square = self.denominator**2
        return tuple(tuple(Fraction(c, square) for c in row) for row in self.cofactors)

    @property
    def inverse_transpose(self) -> RationalMatrix:
        """Return A⁻ᵀ = C / det A exactly, the matrix that transforms normals.

        Raises
        ------
        NoAnswerError
            If A is singular.

        Examples
        --------
        >>> [str(row[i]) for i, row in enumerate(LinearMap.of(
        ...     [[1, 0, 0], [0, 2, 0], [0, 0, 1]]).inverse_transpose)]
        ['1', '1/2', '1']
        """
        det = self.integer_determinant
        if det == 0:
            raise NoAnswerError(
                f"a linear part of rank {self.rank}",
                "its determinant is exactly 0, so it has no inverse transpose",
                "use the cofactor matrix, which exists for every matrix",
            )
        return tuple(
            tuple(Fraction(c * self.denominator, det) for c in row) for row in self.cofactors
        )

    @property
    def normal_matrix(self) -> RationalMatrix | None:
        """Return A⁻ᵀ exactly, or None where A is singular and has none."""
        return self.inverse_transpose if self.integer_determinant else None

    def normal(self, normal_object: Sequence[float | Fraction]) -> Normal:
        """Transform one normal to length one; every component is correctly rounded.

        A surface keeps its outward side, so the cofactors take the sign of the determinant; a
        map of rank 2 leaves a plane whose two sides are alike, and the direction is +C n.

        Parameters
        ----------
        normal_object
            Three components in the space that the map comes from; any length but zero.

        Examples
        --------
        >>> LinearMap.of([[1, 0, 0], [0, 2, 0], [0, 0, 1]]).normal((1, 2, 0)).direction
        (0.7071067811865476, 0.7071067811865476, 0.0)
        """
        n, _ = integers(normal_object)
        if not any(n):
            return _undefined("the normal is the zero vector")
        transformed = _apply(self.cofactors, n)
        if not any(transformed):
            return _undefined(self._why_no_normal())
        det = self.integer_determinant
        if det < 0:
            transformed = [-component for component in transformed]
        return Normal(
            unit(transformed),
            NormalStatus.OK if det else NormalStatus.TWO_SIDED,
            "" if det else "the map flattens space to a plane, and its two sides are alike",
        )

    def angle_without_deg(self, normal_object: Sequence[float | Fraction]) -> float | None:
        """Measure how far A n is off the right normal, in degrees, correctly rounded.

        Examples
        --------
        >>> LinearMap.of([[1, 0, 0], [0, -1, 0], [0, 0, 1]]).angle_without_deg((1, 1, 0))
        0.0
        """
        n, _ = integers(normal_object)
        return self.angle_off_deg(n, _apply(self.entries, n))

    def angle_off_deg(
        self, normal_object: Sequence[float | Fraction], image: Sequence[Fraction | int]
    ) -> float | None:
        """Measure how far an image of a normal is off the right one, in degrees.

        It is correctly rounded. None where one of them has no direction; a plane with two sides is
        off by 90° at most.

        Examples
        --------
        >>> LinearMap.of([[-1, 0, 0], [0, 1, 0], [0, 0, 1]]).angle_off_deg((1, 0, 0), (1, 0, 0))
        180.0
        """
        n, _ = integers(normal_object)
        given, transformed = integers(image)[0], _apply(self.cofactors, n)
        if not any(given) or not any(transformed):
            return None
        if self.integer_determinant < 0:
            transformed = [-component for component in transformed]
        error = exact_angle_between(given, transformed)
        return nearest((error if self.integer_determinant else min(error, PI - error)) * DEGREES)

    def _why_no_normal(self) -> str:
        if self.rank == 2:
            return (
                "a silhouette: the map flattens space to a plane, and seen along the direction "
                "that vanishes this patch collapses to a line"
            )
        return f"the map has rank {self.rank}: it leaves no surface, so there is no normal"


def _apply(matrix: Integers, v: Sequence[int]) -> list[int]:
    return [row[0] * v[0] + row[1] * v[1] + row[2] * v[2] for row in matrix]


def _undefined(reason: str) -> Normal:
    return Normal(None, NormalStatus.UNDEFINED, reason)
