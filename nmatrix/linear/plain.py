"""Plain cofactors of many 3×3 matrices, as fast as arrays go, and where they may fall short.

A plain cofactor loses about u·L²/‖C‖, where L is the largest entry: no more than an inverse loses,
unless the cofactors are much smaller than the products they are made of. |det A| ≥ 2⁻¹⁰·L³ excludes
that at the price of one maximum, because |det A| ≤ 3·L·max|C|, so that max|C| ≥ L²/3072. It also
puts the sign of the determinant beyond doubt. What fails the question is looked at again.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]

STEEP = 2.0**-10  # of the determinant to the cube of the largest entry
SMALLEST, LARGEST = 2.0**-150, 2.0**150  # cubes of entries, and determinants, stay normal
NEXT, AFTER = slice(1, 4), slice(2, 5)


@dataclass(frozen=True, eq=False)
class Workspace:
    """Planes that stay in the cache: a chunk's matrices and what is made of them on the way.

    Rows are held as (a₀ a₁ a₂ a₀ a₁), so that the cyclic neighbours of a row are slices of it and
    a cross product is three calls on three planes each.
    """

    rows: Array
    cofactors: Array
    products: Array
    determinant: Array
    size: Array

    @classmethod
    def of(cls, count: int) -> Workspace:
        """Return room for so many matrices."""
        return cls(
            np.empty((3, 5, count)),
            np.empty((3, 3, count)),
            np.empty((3, count)),
            np.empty(count),
            np.empty(count),
        )

    def write(self, A: Array, out: Array) -> Array:
        """Write sign(det A)·C of matrices (3, 3, n); return the indices of those to look at again.

        Planes of float64 are written where they belong, anything else is turned or rounded at the
        end.
        """
        space = self._first(A.shape[2])
        in_place = out.dtype == np.float64 and out.strides[2] == out.itemsize
        found = out if in_place else space.cofactors
        np.copyto(space.rows[:, :3], A)
        doubtful = space._outward(found)
        if not in_place:
            np.copyto(out, found, casting="same_kind")
        return np.flatnonzero(doubtful)

    def _first(self, count: int) -> Workspace:
        """Return the part of it that so many matrices need."""
        if count == self.rows.shape[2]:
            return self
        return Workspace(
            self.rows[:, :, :count],
            self.cofactors[:, :, :count],
            self.products[:, :count],
            self.determinant[:count],
            self.size[:count],
        )

    def _outward(self, out: Array) -> Array:
        """Write sign(det A)·C, and return which may not be good enough.

        The sign goes into the first row of C, and into the first row of A before the other rows
        of C are made of that.
        """
        rows, determinant = self.rows, self.determinant
        rows[:, 3:] = rows[:, :2]
        with np.errstate(over="ignore", invalid="ignore", under="ignore"):
            self._cross(1, 2, out[0])
            np.multiply(rows[0, :3], out[0], out=self.products)
            np.add(self.products[0], self.products[1], out=determinant)
            determinant += self.products[2]
            doubtful = self._doubtful()
            np.copysign(1.0, determinant, out=determinant)
            out[0] *= determinant
            rows[0] *= determinant
            self._cross(2, 0, out[1])
            self._cross(0, 1, out[2])
        return doubtful

    def _cross(self, i: int, j: int, out: Array) -> None:
        """Write the cross product of rows i and j."""
        np.multiply(self.rows[i, NEXT], self.rows[j, AFTER], out=out)
        np.multiply(self.rows[i, AFTER], self.rows[j, NEXT], out=self.products)
        out -= self.products

    def _doubtful(self) -> Array:
        """Return where |det A| < 2⁻¹⁰·L³, or everywhere if an entry leaves the safe range."""
        largest, scratch = self.size, self.products[0]
        _largest(self.rows[:, :3], largest, scratch)
        if not (largest.max() < LARGEST and largest.min() > SMALLEST):
            return np.ones(largest.shape, bool)
        np.multiply(largest, largest, out=scratch)
        scratch *= largest
        scratch *= STEEP
        np.abs(self.determinant, out=largest)
        return np.asarray(largest < scratch)


def _largest(planes: Array, out: Array, scratch: Array) -> None:
    """Write the largest size of an entry, for each matrix."""
    np.maximum.reduce(planes, axis=(0, 1), out=out)
    np.minimum.reduce(planes, axis=(0, 1), out=scratch)
    np.negative(scratch, out=scratch)
    np.maximum(out, scratch, out=out)
