"""Cofactors of many 3×3 matrices in float64, each within 2u of the true one, whatever κ is.

A cofactor is a d − b c. Both products are split into what floats hold and the error of that, which
floats hold too; (p − q) + (p′ − q′) then loses 2u at the most and has the right sign and the right
zeros (Cornea, Harrison and Tang; the bound is Jeannerod's). It holds where no product leaves the
normal range. Matrices with entries outside of a safe window are taken apart first: mantissas in
[½, 1) and exponents, so that any finite input is served.

Arrays are structures of arrays, (3, 3, N): one plane for each entry.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields
from functools import lru_cache
from threading import get_ident
from typing import Any, NamedTuple, Self

import numpy as np
from numpy.lib.stride_tricks import as_strided
from numpy.typing import NDArray

Array = NDArray[Any]

UNIT = 2.0**-53
SPLITTER = 2.0**27 + 1
SMALLEST, LARGEST = 2.0**-240, 2.0**240  # products and their errors stay normal in between
FAR_APART = 400  # exponents that differ by more do not meet in a float64
LINE = 1 << 10  # matrices that have scratch of their own size
CHUNK = 5 << 10  # matrices whose scratch takes 5.3 MB
NEXT, AFTER = (1, 2, 0), (2, 0, 1)
AS_IT_IS = np.zeros((1, 1, 1), np.int32)  # the exponent of numbers that floats hold


class Scaled(NamedTuple):
    """Numbers as mantissa · 2^exponent; the mantissas are ordinary floats of any size near one."""

    mantissa: Array
    exponent: Array


class Expansion(NamedTuple):
    """A number as the sum of a float and a much smaller one."""

    high: Array
    low: Array


def two_product(a: Array, b: Array) -> Expansion:
    """Return a·b exactly (Dekker), for factors whose product and its error stay normal.

    Examples
    --------
    >>> high, low = two_product(np.float64(1 + 2**-30), np.float64(1 + 2**-30))
    >>> high == 1 + 2**-29, low == 2**-60
    (np.True_, np.True_)
    """
    product = a * b
    a_high, a_low = _halves(a)
    b_high, b_low = _halves(b)
    error = a_high * b_high - product
    error += a_high * b_low
    error += a_low * b_high
    error += a_low * b_low
    return Expansion(product, error)


def two_sum(a: Array, b: Array) -> Expansion:
    """Return a + b exactly (Knuth)."""
    total = a + b
    other = total - a
    return Expansion(total, (a - (total - other)) + (b - other))


def _halves(a: Array) -> tuple[Array, Array]:
    """Split floats into two that multiply without rounding."""
    big = SPLITTER * a
    high = big - (big - a)
    return high, a - high


def minor_products(A: Array, rows: Sequence[int], j: int) -> tuple[Expansion, Expansion]:
    """Compute the two products whose difference is cofactor (i, j), exactly, for all rows i."""
    r, s = [NEXT[i] for i in rows], [AFTER[i] for i in rows]
    k, m = NEXT[j], AFTER[j]
    return two_product(A[r, k], A[s, m]), two_product(A[r, m], A[s, k])


@dataclass(frozen=True, eq=False)
class Scratch(ABC):
    """Arrays for the matrices of one chunk, along the last axes, that are used again and again."""

    @classmethod
    @abstractmethod
    def of(cls, count: int) -> Self:
        """Make room for so many matrices."""

    @classmethod
    def taken(cls, count: int, chunk: int) -> Self:
        """Take those of this thread: for a few matrices their own, else of a part of a chunk."""
        made = count if count <= LINE else max(count, chunk)
        while made >= 2 * count:
            made //= 2
        whole: Self = _made(cls.of, made, get_ident())
        return whole if made == count else whole.cut(count)

    def cut(self, count: int) -> Self:
        """Take the part that so many matrices need."""
        parts = (getattr(self, one.name) for one in fields(self))
        return type(self)(
            *(one.cut(count) if isinstance(one, Scratch) else one[..., :count] for one in parts)
        )


@lru_cache(maxsize=8)
def _made(of: Callable[[int], Any], count: int, _thread: int) -> Any:  # noqa: ANN401  of any kind
    return of(count)


@dataclass(frozen=True, eq=False)
class Cyclic(Scratch):
    """Matrices whose rows and columns go on from the start, as 0 1 2 0 1.

    Cofactor (i, j) is A[i+1, j+1] A[i+2, j+2] − A[i+1, j+2] A[i+2, j+1], so the factors of the two
    products of all nine cofactors are windows of it, `first` and `second` (2, 3, 3, N).
    """

    planes: Array
    block: Array
    first: Array
    second: Array

    @classmethod
    def of(cls, count: int) -> Cyclic:
        """Make room for so many matrices."""
        planes = np.empty((5, 5, count))
        i, j, k = planes.strides
        shape = (2, 3, 3, count)
        first = as_strided(planes[1:, 1:], shape, (j, i, j, k))
        second = as_strided(planes[2:, 2:], shape, (-j, i, j, k))
        return cls(planes, planes[:3, :3], first, second)

    def close(self) -> None:
        """Copy the first rows and columns of the block to where they come again."""
        self.planes[:3, 3:] = self.planes[:3, :2]
        self.planes[3:] = self.planes[:2]


@dataclass(frozen=True, eq=False)
class Workspace(Scratch):
    """Scratch for the cofactors of a chunk of matrices.

    The entries and their halves are held cyclic, so each step is one call for all nine cofactors.
    """

    entries: Cyclic
    highs: Cyclic
    lows: Cyclic
    products: Array
    errors: Array
    terms: Array

    @classmethod
    def of(cls, count: int) -> Workspace:
        """Make room for so many matrices."""
        entries, highs, lows = (Cyclic.of(count) for _ in range(3))
        products, errors, terms = (np.empty((2, 3, 3, count)) for _ in range(3))
        return cls(entries, highs, lows, products, errors, terms)

    def cofactors(self) -> Array:
        """Compute the cofactors (3, 3, N) of the entries, if these are 0 or within the window.

        They lie in this workspace until the next call.
        """
        A, high, low = self.entries.block, self.highs.block, self.lows.block
        np.multiply(A, SPLITTER, out=high)
        np.subtract(high, A, out=low)
        np.subtract(high, low, out=high)
        np.subtract(A, high, out=low)
        for cyclic in (self.entries, self.highs, self.lows):
            cyclic.close()
        (a, d), (a_high, d_high), (a_low, d_low) = (
            (one.first, one.second) for one in (self.entries, self.highs, self.lows)
        )
        product = np.multiply(a, d, out=self.products)
        error = np.multiply(a_high, d_high, out=self.errors)
        error -= product
        for one, other in ((a_high, d_low), (a_low, d_high), (a_low, d_low)):
            error += np.multiply(one, other, out=self.terms)
        found: Array = self.products[0]
        rest: Array = self.errors[0]
        found -= self.products[1]
        rest -= self.errors[1]
        found += rest
        return found


def outside_window(size: Array) -> Array:
    """Find the matrices that have an entry neither 0 nor within the window, by all the sizes.

    The zeros among the sizes may be overwritten.
    """
    if size.max(initial=0.0) <= LARGEST and size.min(initial=LARGEST) >= SMALLEST:
        return np.zeros(size.shape[2], bool)
    largest = size.max(axis=(0, 1))
    np.copyto(size, LARGEST, where=size == 0)
    return np.asarray((largest > LARGEST) | (size.min(axis=(0, 1)) < SMALLEST))


def cofactors(A: Array) -> Scaled:
    """Compute the cofactors of any finite matrices (3, 3, N): within 2u, signs and zeros exact.

    They lie in memory that the next call in this thread uses again.

    Examples
    --------
    >>> found = cofactors(np.diag([2.0**600, 2.0**600, 1])[:, :, None])
    >>> float(found.mantissa[2, 2, 0]), int(found.exponent[2, 2, 0])  # 2¹²⁰⁰, beyond every float
    (0.25, 1202)
    """
    space = Workspace.taken(A.shape[2], CHUNK)
    np.copyto(space.entries.block, A)
    outside = outside_window(np.abs(A, out=space.terms[0]))
    if not outside.any():
        return Scaled(space.cofactors(), AS_IT_IS)
    rest = np.flatnonzero(outside)
    space.entries.block[:, :, rest] = 0.0
    found = space.cofactors()
    exponent = np.zeros(A.shape, np.int32)
    found[:, :, rest], exponent[:, :, rest] = _cofactors_of_any(A[:, :, rest])
    return Scaled(found, exponent)


def _cofactors_of_any(A: Array) -> Scaled:
    """Return the cofactors by mantissas and exponents, each minor at its own scale."""
    parts = np.frexp(A)
    found = Scaled(np.empty_like(A), np.zeros(A.shape, np.int32))
    for i in range(3):
        for j in range(3):
            value, scale = _scaled_difference(Scaled(*parts), i, j)
            found.mantissa[i, j], found.exponent[i, j] = value, scale
    return found


def _scaled_difference(A: Scaled, i: int, j: int) -> tuple[Array, Array]:
    """Return a·d − b·c and its exponent; the smaller product is brought to the larger one's scale.

    A product that is more than 2⁴⁰⁰ smaller can only turn the last bit, and is kept as that small.
    """
    r, s, k, m = NEXT[i], AFTER[i], NEXT[j], AFTER[j]
    (a, d), (b, c) = ((A.mantissa[r, k], A.mantissa[s, m]), (A.mantissa[r, m], A.mantissa[s, k]))
    first = A.exponent[r, k] + A.exponent[s, m]
    second = A.exponent[r, m] + A.exponent[s, k]
    first = np.where(a * d == 0, second, first)
    second = np.where(b * c == 0, first, second)
    scale = np.maximum(first, second)
    p = two_product(np.ldexp(a, np.maximum(first - scale, -FAR_APART)), d)
    q = two_product(np.ldexp(b, np.maximum(second - scale, -FAR_APART)), c)
    return (p.high - q.high) + (p.low - q.low), scale
