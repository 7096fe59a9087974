"""Plain cofactors of many 3×3 matrices, as fast as arrays go, and where they may fall short.

u is 2⁻⁵³, L the largest entry of A. A plain cofactor is off by at most 4u·L². |det A| > 2⁻¹⁰·L³
bounds that by 2¹⁴u·max|C|, because |det A| ≤ 3·L·max|C|, and puts the sign of the determinant
beyond doubt. Matrices that fail the question are *doubtful* and left to the certified level.
Decisions and results do not depend on the scale of A: entries whose cubes might leave the range of
floats are brought to L ≈ 1 first, and a matrix that has entries more than 2²⁰⁰ apart is doubtful.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import NormalMatrixKind
from nmatrix.linear.compensated import Scaled

Array = NDArray[Any]

STEEP = 2.0**-10  # of the determinant to the cube of the largest entry
SMALLEST, LARGEST = 2.0**-100, 2.0**100  # products of three entries, and their errors, stay normal
NEXT, AFTER = slice(1, 4), slice(2, 5)


@dataclass(frozen=True, eq=False)
class Workspace:
    """Scratch arrays for one chunk.

    Rows are held as (a₀ a₁ a₂ a₀ a₁), so that the cyclic neighbours of a row are slices of it and
    a cross product is three calls on three planes each.
    """

    rows: Array
    matrices: Array
    products: Array
    determinant: Array
    size: Array

    @classmethod
    def of(cls, count: int) -> Workspace:
        """Make room for so many matrices."""
        return cls(
            np.empty((3, 5, count)),
            np.empty((3, 3, count)),
            np.empty((3, count)),
            np.empty(count),
            np.empty(count),
        )

    def normal_matrices(
        self, A: Array, kind: NormalMatrixKind, out: Array | None = None
    ) -> tuple[Scaled, Array]:
        """Compute C/det A or sign(det A)·C of matrices (3, 3, n), and find the doubtful ones.

        The result lies in `out`, or in this workspace until the next call; what stands there for
        doubtful matrices means nothing.

        Examples
        --------
        >>> A = np.diag([-1.0, 2, 4])[:, :, None]
        >>> found, doubtful = Workspace.of(1).normal_matrices(A, NormalMatrixKind.ORIENTED)
        >>> found.mantissa[:, :, 0].diagonal().tolist(), doubtful.tolist()
        ([-8.0, 4.0, 2.0], [False])
        """
        space = self._first(A.shape[2])
        found = space.matrices if out is None else out
        np.copyto(space.rows[:, :3], A)
        power, doubtful = space._bring_into_range()
        doubtful |= space._write(kind, found)
        is_oriented = kind is NormalMatrixKind.ORIENTED
        return Scaled(found, 2 * power if is_oriented else -power), doubtful

    def _first(self, count: int) -> Workspace:
        """Return the part of it that so many matrices need."""
        if count == self.rows.shape[2]:
            return self
        return Workspace(
            self.rows[:, :, :count],
            self.matrices[:, :, :count],
            self.products[:, :count],
            self.determinant[:count],
            self.size[:count],
        )

    def _bring_into_range(self) -> tuple[Array, Array]:
        """Scale what lies outside of the safe range, and note the largest entries.

        Returns the powers of two taken out, and which matrices cannot be scaled without loss.
        """
        entries, largest = self.rows[:, :3], self.size
        sizes = np.abs(entries, out=self.matrices)
        np.maximum.reduce(sizes, axis=(0, 1), out=largest)
        none = np.zeros(largest.shape, bool)
        if largest.max() <= LARGEST and sizes.min() >= SMALLEST:
            return np.zeros(1, np.int32), none
        np.copyto(sizes, np.inf, where=sizes == 0)
        smallest = np.minimum.reduce(sizes, axis=(0, 1))
        outside = (largest > LARGEST) | (smallest < SMALLEST)
        if not outside.any():
            return np.zeros(1, np.int32), none
        apart = outside & (smallest < largest * (SMALLEST / LARGEST))
        mantissa, exponent = np.frexp(largest)
        power = np.where(outside, exponent, 0)
        np.copyto(largest, mantissa, where=outside)
        np.ldexp(entries, -power, out=entries)
        return power, apart

    def _write(self, kind: NormalMatrixKind, out: Array) -> Array:
        """Write C times its factor, 1/det A or its sign, and return which may not be good enough.

        The factor goes into the first row of C, and into the first row of A before the other rows
        of C are made of that.
        """
        rows, factor = self.rows, self.determinant
        rows[:, 3:] = rows[:, :2]
        self._cross(1, 2, out[0])
        np.multiply(rows[0, :3], out[0], out=self.products)
        np.add(self.products[0], self.products[1], out=factor)
        factor += self.products[2]
        doubtful = self._doubtful()
        if kind is NormalMatrixKind.ORIENTED:
            np.copysign(1.0, factor, out=factor)
        else:
            np.divide(1.0, factor, out=factor)
        out[0] *= factor
        rows[0] *= factor
        self._cross(2, 0, out[1])
        self._cross(0, 1, out[2])
        return doubtful

    def _cross(self, i: int, j: int, out: Array) -> None:
        """Write the cross product of rows i and j."""
        np.multiply(self.rows[i, NEXT], self.rows[j, AFTER], out=out)
        np.multiply(self.rows[i, AFTER], self.rows[j, NEXT], out=self.products)
        out -= self.products

    def _doubtful(self) -> Array:
        """Find where |det A| ≤ 2⁻¹⁰·L³."""
        largest, least = self.size, self.products[0]
        np.multiply(largest, largest, out=least)
        least *= largest
        least *= STEEP
        np.abs(self.determinant, out=largest)
        return np.asarray(~(largest > least))
