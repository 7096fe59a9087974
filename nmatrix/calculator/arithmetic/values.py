"""The calculator's values: a scalar, a vector or a matrix of numbers, and what is known of it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from enum import StrEnum
from fractions import Fraction
from typing import Any, TypeAlias, TypeVar

from nmatrix.calculator.arithmetic.meanings import Meaning
from nmatrix.calculator.arithmetic.numbers import Number, bits_of, enclosure, float64, shown
from nmatrix.calculator.arithmetic.symbolic import Symbolic
from nmatrix.errors import IllegalValueError, quantity
from nmatrix.linear.rational import RationalMatrix, RationalVector
from nmatrix.report import LARGEST_MATRIX, Shown
from nmatrix.surds import Surd

LARGEST_BITS = 4096  # of a numerator or denominator: four float64 of any size, multiplied
LARGEST = LARGEST_MATRIX  # rows and columns

Changed = TypeVar("Changed")
Nested: TypeAlias = Changed | tuple[Changed, ...] | tuple[tuple[Changed, ...], ...]
Entries: TypeAlias = Nested[Number] | bool


class ValueKind(StrEnum):
    """A value is a scalar, a vector or a matrix, or what a comparison tells."""

    TRUTH = "truth"
    SCALAR = "scalar"
    VECTOR = "vector"
    MATRIX = "matrix"


class Arithmetic(StrEnum):
    """Exact numbers and intervals, or float64 rounded after every product and sum."""

    EXACT = "exact"
    FLOAT = "float"


@dataclass(frozen=True)
class Value:
    """Entries of any kind of number, all but floats mixed, and what they mean.

    `meaning` is the map that a matrix is or the space and kind of a vector, where that is known.
    """

    entries: Entries
    meaning: Meaning | None = None

    @property
    def kind(self) -> ValueKind:
        """Scalar, vector or matrix, by the nesting of the entries."""
        if not isinstance(self.entries, tuple):
            return ValueKind.TRUTH if isinstance(self.entries, bool) else ValueKind.SCALAR
        return ValueKind.MATRIX if isinstance(self.entries[0], tuple) else ValueKind.VECTOR

    @property
    def shape(self) -> str:
        """The size in words."""
        if not isinstance(self.entries, tuple):
            return "yes or no" if isinstance(self.entries, bool) else "a number"
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
    def letters(self) -> list[str]:
        """The names without a value in its entries."""
        symbolic = (one for one in self.numbers if isinstance(one, Symbolic))
        return sorted({letter for one in symbolic for letter in one.letters})

    @property
    def shown(self) -> Nested[Shown]:
        """The entries as they may be printed: exact, or to the digits known.

        Raises
        ------
        NoAnswerError
            If not one digit of an entry is known.
        """
        return each(self.entries, shown)

    def __neg__(self) -> Value:
        return replace(self, entries=each(self.entries, lambda x: -x))

    def enclosed(self) -> Value:
        """Put every root between its bounds, where its exact form would grow too long."""
        return replace(self, entries=each(self.entries, enclosure))

    def kept_by(self, arithmetic: Arithmetic) -> Value:
        """Round the value to float64, or check that it can be written down.

        Raises
        ------
        IllegalValueError
            For a fraction of more than `LARGEST_BITS` bits.
        """
        if self.kind is ValueKind.TRUTH:
            return self
        if any(isinstance(x, Symbolic) for x in self.numbers):  # whose letters may be gone
            return replace(self, entries=each(self.entries, _tidied))
        if arithmetic is Arithmetic.FLOAT:
            return replace(self, entries=each(self.entries, float64))
        bits = max(map(bits_of, self.numbers))
        if bits > LARGEST_BITS:
            raise IllegalValueError(
                "its fraction",
                f"it takes {bits} bits, {LARGEST_BITS} are kept",
                f"try {quantity('float')}",
            )
        return self


def _tidied(x: Number) -> Number:
    return x.tidied() if isinstance(x, Symbolic) else x


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
        yield entries  # type: ignore[misc]  # a truth is asked for no numbers
        return
    for entry in entries:
        yield from _flat(entry)


def as_strings(entries: Entries) -> object:
    """Write every entry exactly, keeping the shape."""
    if not isinstance(entries, tuple):
        return str(entries)
    return [as_strings(entry) for entry in entries]
