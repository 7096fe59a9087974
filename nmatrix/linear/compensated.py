"""Cofactors of many 3×3 matrices in float64, each within 2u of the true one, whatever κ is.

A cofactor is a d − b c. Both products are split into what floats hold and the error of that, which
floats hold too; (p − q) + (p′ − q′) then loses 2u at the most and has the right sign and the right
zeros (Cornea, Harrison and Tang; the bound is Jeannerod's). It holds where no product leaves the
normal range. Matrices with entries outside of a safe window are taken apart first: mantissas in
[½, 1) and exponents, so that any finite input is served.

Arrays are structures of arrays, (3, 3, N): one plane for each entry.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]

UNIT = 2.0**-53
SPLITTER = 2.0**27 + 1
SMALLEST, LARGEST = 2.0**-240, 2.0**240  # products and their errors stay normal in between
FAR_APART = 400  # exponents that differ by more do not meet in a float64
NEXT, AFTER = (1, 2, 0), (2, 0, 1)


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


def minor_products(A: Array, i: int, j: int) -> tuple[Expansion, Expansion]:
    """Return the two products whose difference is cofactor (i, j), exactly."""
    r, s, k, m = NEXT[i], AFTER[i], NEXT[j], AFTER[j]
    return two_product(A[r, k], A[s, m]), two_product(A[r, m], A[s, k])


def cofactors_in_window(A: Array, out: Array | None = None) -> Array:
    """Return the cofactors (3, 3, N) of matrices whose entries are 0 or within the window."""
    found = np.empty_like(A) if out is None else out
    halves = _halves(A)
    for i in range(3):
        for j in range(3):
            _difference(A, halves, (i, j), found[i, j])
    return found


def _difference(A: Array, halves: tuple[Array, Array], at: tuple[int, int], out: Array) -> None:
    """Write one cofactor; every entry was split once, for all the products that it is in."""
    i, j = at
    r, s, k, m = NEXT[i], AFTER[i], NEXT[j], AFTER[j]
    np.multiply(A[r, k], A[s, m], out=out)
    other = A[r, m] * A[s, k]
    error = _error(halves, (r, k), (s, m), out)
    error -= _error(halves, (r, m), (s, k), other)
    out -= other
    out += error


def _error(
    halves: tuple[Array, Array], a: tuple[int, int], b: tuple[int, int], product: Array
) -> Array:
    """Return the exact error of a product of two entries."""
    high, low = halves
    error = high[a] * high[b]
    error -= product
    error += high[a] * low[b]
    error += low[a] * high[b]
    error += low[a] * low[b]
    return np.asarray(error)


def outside_window(A: Array) -> Array:
    """Find the matrices (3, 3, N) that have an entry neither 0 nor within the window."""
    size = np.abs(A)
    largest = size.max(axis=(0, 1))
    size[size == 0] = 1.0
    return np.asarray((largest > LARGEST) | (size.min(axis=(0, 1)) < SMALLEST))


def cofactors(A: Array) -> Scaled:
    """Return the cofactors of any finite matrices (3, 3, N): within 2u, signs and zeros exact.

    Examples
    --------
    >>> found = cofactors(np.diag([2.0**600, 2.0**600, 1])[:, :, None])
    >>> float(found.mantissa[2, 2, 0]), int(found.exponent[2, 2, 0])  # 2¹²⁰⁰, beyond every float
    (0.25, 1202)
    """
    found = Scaled(np.empty_like(A), np.zeros(A.shape, np.int32))
    outside = outside_window(A)
    if not outside.any():
        cofactors_in_window(A, found.mantissa)
        return found
    inside = np.flatnonzero(~outside)
    found.mantissa[:, :, inside] = cofactors_in_window(np.ascontiguousarray(A[:, :, inside]))
    rest = np.flatnonzero(outside)
    mantissa, exponent = _cofactors_of_any(np.ascontiguousarray(A[:, :, rest]))
    found.mantissa[:, :, rest], found.exponent[:, :, rest] = mantissa, exponent
    return found


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
