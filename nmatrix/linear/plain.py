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
from nmatrix.linear.compensated import AS_IT_IS, Cyclic, Scaled, Scratch

Array = NDArray[Any]

STEEP = 2.0**-10  # of the determinant to the cube of the largest entry
SMALLEST, LARGEST = 2.0**-100, 2.0**100  # products of three entries, and their errors, stay normal
CHUNK = 3 << 11  # matrices whose scratch takes 2.7 MB


@dataclass(frozen=True, eq=False)
class Workspace(Scratch):
    """Scratch for plain cofactors, with the entries held cyclic."""

    entries: Cyclic
    products: Array
    sizes: Array
    largest: Array
    determinant: Array
    least: Array

    @classmethod
    def of(cls, count: int) -> Workspace:
        """Make room for so many matrices."""
        lines = (np.empty(count) for _ in range(3))
        return cls(Cyclic.of(count), np.empty((2, 3, 3, count)), np.empty((3, 3, count)), *lines)

    def normal_matrices(
        self, A: Array, kind: NormalMatrixKind, out: Array | None = None
    ) -> tuple[Scaled, Array]:
        """Compute C/det A or sign(det A)·C of matrices (3, 3, n), and find the doubtful ones.

        The result lies in `out`, or in this workspace until the next call, and no zero is negative;
        what stands there for doubtful matrices means nothing.

        Examples
        --------
        >>> A = np.diag([-1.0, 2, 4])[:, :, None]
        >>> found, doubtful = Workspace.of(1).normal_matrices(A, NormalMatrixKind.ORIENTED)
        >>> found.mantissa[:, :, 0].diagonal().tolist(), doubtful.tolist()
        ([-8.0, 4.0, 2.0], [False])
        """
        found = self.sizes if out is None else out
        np.copyto(self.entries.block, A)
        power, apart, has_zeros = self._bring_into_range()
        doubtful = self._write(kind, found)
        if apart is not None:
            doubtful |= apart
        could_be_negative = found if has_zeros else found[0]
        could_be_negative += 0.0
        return Scaled(found, 2 * power if kind is NormalMatrixKind.ORIENTED else -power), doubtful

    def _bring_into_range(self) -> tuple[Array, Array | None, bool]:
        """Scale what lies outside of the safe range, and note the largest entries.

        Returns the powers of two taken out, the matrices that cannot be scaled without loss, and
        if there are zeros.
        """
        entries, sizes, largest = self.entries.block, self.sizes, self.largest
        np.abs(entries, out=sizes)
        np.maximum.reduce(sizes, axis=(0, 1), out=largest)
        least = sizes.min()
        if least >= SMALLEST and largest.max() <= LARGEST:
            return AS_IT_IS, None, False
        np.copyto(sizes, np.inf, where=sizes == 0)
        smallest = np.minimum.reduce(sizes, axis=(0, 1))
        outside = (largest > LARGEST) | (smallest < SMALLEST)
        if not outside.any():
            return AS_IT_IS, None, True
        apart = outside & (smallest < largest * (SMALLEST / LARGEST))
        mantissa, exponent = np.frexp(largest)
        power = np.where(outside, exponent, 0)
        np.copyto(largest, mantissa, where=outside)
        np.ldexp(entries, -power, out=entries)
        return power, apart, True

    def _write(self, kind: NormalMatrixKind, out: Array) -> Array:
        """Write C times its factor, 1/det A or its sign, and find where it may not be good enough.

        The factor goes into the first row of C, and into the first row of A before the other rows
        of C are made of that.
        """
        rows, factor = self.entries.planes, self.determinant
        rows[:3, 3:] = rows[:3, :2]
        self._cross(slice(0, 1), out)
        terms = np.multiply(rows[0, :3], out[0], out=self.products[0, 0])
        np.add(terms[0], terms[1], out=factor)
        factor += terms[2]
        doubtful = self._doubtful()
        if kind is NormalMatrixKind.ORIENTED:
            np.copysign(1.0, factor, out=factor)
        else:
            np.divide(1.0, factor, out=factor)
        out[0] *= factor
        np.multiply(rows[0], factor, out=rows[3])
        rows[4] = rows[1]
        self._cross(slice(1, 3), out)
        return doubtful

    def _cross(self, rows: slice, out: Array) -> None:
        """Write rows of C, each the cross product of the two rows of A that follow."""
        first, second = self.entries.first[:, rows], self.entries.second[:, rows]
        products = np.multiply(first, second, out=self.products[:, rows])
        np.subtract(products[0], products[1], out=out[rows])

    def _doubtful(self) -> Array:
        """Find where |det A| ≤ 2⁻¹⁰·L³."""
        largest, least = self.largest, self.least
        np.multiply(largest, largest, out=least)
        least *= largest
        least *= STEEP
        np.abs(self.determinant, out=largest)
        return np.asarray(~(largest > least))
