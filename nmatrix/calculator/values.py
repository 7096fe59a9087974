"""The calculator's values: a scalar, a vector or a matrix of numbers of one arithmetic."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction
from typing import Any, TypeAlias, TypeVar

from nmatrix.calculator.numbers import Number, bits_of, float64, shown
from nmatrix.errors import IllegalValueError, quantity
from nmatrix.linear.rational import RationalMatrix, RationalVector
from nmatrix.report import Shown
from nmatrix.surds import Surd

LARGEST_BITS = 4096  # of a numerator or denominator: four float64 of any size, multiplied

Changed = TypeVar("Changed")
Nested: TypeAlias = Changed | tuple[Changed, ...] | tuple[tuple[Changed, ...], ...]
Entries: TypeAlias = Nested[Number]


class ValueKind(StrEnum):
    """A value is a scalar, a vector or a matrix."""

    SCALAR = "scalar"
    VECTOR = "vector"
    MATRIX = "matrix"


class Arithmetic(StrEnum):
    """Exact fractions and intervals, or float64 rounded after every product and sum."""

    EXACT = "exact"
    FLOAT = "float"


@dataclass(frozen=True)
class Value:
    """Entries of any kind of number, all but floats mixed."""

    entries: Entries

    @property
    def kind(self) -> ValueKind:
        """Scalar, vector or matrix, by the nesting of the entries."""
        if not isinstance(self.entries, tuple):
            return ValueKind.SCALAR
        return ValueKind.MATRIX if isinstance(self.entries[0], tuple) else ValueKind.VECTOR

    @property
    def shape(self) -> str:
        """The size in words."""
        if not isinstance(self.entries, tuple):
            return "a number"
        if isinstance(self.entries[0], tuple):
            return f"a {len(self.entries)}×{len(self.entries[0])} matrix"
        return f"a vector of {len(self.entries)}"

    @property
    def scalar(self) -> Fraction:
        """The number of a scalar."""
        assert self.kind is ValueKind.SCALAR  # callers check the kind
        return self.entries  # type: ignore[return-value]  # or another number with its operators

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

    @property
    def numbers(self) -> Iterator[Number]:
        """The entries in one row."""
        return _flat(self.entries)

    @property
    def exact(self) -> bool:
        """Whether every entry is a fraction or a sum of roots: none was rounded."""
        return all(isinstance(entry, (Fraction, Surd)) for entry in self.numbers)

    @property
    def shown(self) -> Nested[Shown]:
        """The entries as they may be printed: fractions and floats, to the digits known."""
        return each(self.entries, shown)

    def __neg__(self) -> Value:
        return Value(each(self.entries, lambda x: -x))

    def kept_by(self, arithmetic: Arithmetic) -> Value:
        """Round the value to float64, or check that it can be written down.

        Raises
        ------
        IllegalValueError
            For a fraction of more than `LARGEST_BITS` bits.
        """
        kept = Value(each(self.entries, float64)) if arithmetic is Arithmetic.FLOAT else self
        bits = max(map(bits_of, kept.numbers))
        if bits > LARGEST_BITS:
            raise IllegalValueError(
                "its fraction",
                f"it takes {bits} bits, {LARGEST_BITS} are kept",
                f"try {quantity('float')}",
            )
        return kept


def each(entries: Entries, change: Callable[[Any], Changed]) -> Nested[Changed]:
    """Apply a function to every entry, keeping the shape.

    Examples
    --------
    >>> each((Fraction(1), Fraction(2)), lambda x: -x)
    (Fraction(-1, 1), Fraction(-2, 1))
    """
    if not isinstance(entries, tuple):
        return change(entries)
    return tuple(each(entry, change) for entry in entries)  # type: ignore[return-value]  # same shape


def _flat(entries: Entries) -> Iterator[Number]:
    if not isinstance(entries, tuple):
        yield entries
        return
    for entry in entries:
        yield from _flat(entry)


def as_strings(entries: Entries) -> object:
    """Write every entry as a fraction, keeping the shape."""
    if not isinstance(entries, tuple):
        return str(entries)
    return [as_strings(entry) for entry in entries]
