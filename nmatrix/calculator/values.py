"""The calculator's values: a scalar, a vector or a matrix of exact fractions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction

from nmatrix.errors import IllegalValueError, quantity
from nmatrix.linear.rational import RationalMatrix, RationalVector
from nmatrix.linear.rounding import nearest

LARGEST_BITS = 4096  # of a numerator or denominator: four float64 of any size, multiplied
KEPT_BITS = 320  # of an irrational value, more than twice the accuracy of its root or sine

Entries = Fraction | RationalVector | RationalMatrix


class ValueKind(StrEnum):
    """A value is a scalar, a vector or a matrix."""

    SCALAR = "scalar"
    VECTOR = "vector"
    MATRIX = "matrix"


class Arithmetic(StrEnum):
    """Exact fractions, or float64 rounded after every operation."""

    EXACT = "exact"
    FLOAT = "float"


@dataclass(frozen=True)
class Value:
    """Entries; `exact` is false where a root or a sine in them was rounded."""

    entries: Entries
    exact: bool = True

    @property
    def kind(self) -> ValueKind:
        """Scalar, vector or matrix, by the nesting of the entries."""
        if isinstance(self.entries, Fraction):
            return ValueKind.SCALAR
        return ValueKind.MATRIX if isinstance(self.entries[0], tuple) else ValueKind.VECTOR

    @property
    def shape(self) -> str:
        """The size in words."""
        if isinstance(self.entries, Fraction):
            return "a number"
        if isinstance(self.entries[0], tuple):
            return f"a {len(self.entries)}×{len(self.entries[0])} matrix"
        return f"a vector of {len(self.entries)}"

    @property
    def scalar(self) -> Fraction:
        """The number of a scalar."""
        assert isinstance(self.entries, Fraction)  # callers check the kind
        return self.entries

    @property
    def vector(self) -> RationalVector:
        """The components of a vector."""
        assert self.kind is ValueKind.VECTOR  # callers check the kind
        return self.entries  # type: ignore[return-value]  # the assertion says so

    @property
    def matrix(self) -> RationalMatrix:
        """The rows of a matrix."""
        assert self.kind is ValueKind.MATRIX  # callers check the kind
        return self.entries  # type: ignore[return-value]  # the assertion says so

    def __neg__(self) -> Value:
        return Value(each(self.entries, lambda x: -x), self.exact)

    def kept_by(self, arithmetic: Arithmetic) -> Value:
        """Round the value as the arithmetic does before the next operation.

        Raises
        ------
        IllegalValueError
            For a number beyond float64, or a fraction of more than `LARGEST_BITS` bits.
        """
        if arithmetic is Arithmetic.FLOAT:
            return Value(each(self.entries, lambda x: Fraction(nearest(x))), self.exact)
        kept = self if self.exact else Value(each(self.entries, _significant), exact=False)
        each(kept.entries, _checked_size)
        return kept


def _significant(x: Fraction) -> Fraction:
    """Round x to `KEPT_BITS` bits, so that irrational values do not grow with every step."""
    if _bits(x) <= 2 * KEPT_BITS:
        return x
    shift = KEPT_BITS - x.numerator.bit_length() + x.denominator.bit_length()
    return Fraction(round(x * Fraction(2) ** shift)) / Fraction(2) ** shift


def _checked_size(x: Fraction) -> Fraction:
    if _bits(x) > LARGEST_BITS:
        raise IllegalValueError(
            "its fraction",
            f"it takes {_bits(x)} bits, {LARGEST_BITS} are kept",
            f"try {quantity('float')}",
        )
    return x


def _bits(x: Fraction) -> int:
    return max(x.numerator.bit_length(), x.denominator.bit_length())


def each(entries: Entries, change: Callable[[Fraction], Fraction]) -> Entries:
    """Apply a function to every entry, keeping the shape.

    Examples
    --------
    >>> each((Fraction(1), Fraction(2)), lambda x: -x)
    (Fraction(-1, 1), Fraction(-2, 1))
    """
    if isinstance(entries, Fraction):
        return change(entries)
    return tuple(each(entry, change) for entry in entries)  # type: ignore[return-value]  # same shape


def as_strings(entries: Entries) -> object:
    """Write every entry as a fraction, keeping the shape."""
    if isinstance(entries, Fraction):
        return str(entries)
    return [as_strings(entry) for entry in entries]
