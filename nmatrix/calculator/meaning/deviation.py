"""How wrong it would be: what a matrix does to lengths and angles, as far as that is known."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from nmatrix.calculator.arithmetic.numbers import (
    Number,
    degrees_of,
    enclosure,
    is_negative,
    is_zero,
    root,
    shown,
    size,
)
from nmatrix.calculator.arithmetic.symbolic import Symbolic
from nmatrix.calculator.meaning.operands import Operand
from nmatrix.errors import NMatrixError
from nmatrix.linear import rational
from nmatrix.linear.rational import RationalMatrix
from nmatrix.linear.rounding import short_text
from nmatrix.surds import TooManyRootsError

ROUNDING = Fraction(1, 10**12)  # by which the columns of a rotation in float64 may miss 1 and 0


def orthonormal(A: RationalMatrix) -> bool:
    """Tell if a matrix is its own inverse transpose, as far as its numbers are known."""
    product = rational.product(_enclosed(A), rational.transpose(_enclosed(A)))
    one = rational.identity(len(A))
    return all(
        _vanishes(x - y)
        for row, other in zip(product, one, strict=True)
        for x, y in zip(row, other, strict=True)
    )


def _vanishes(x: Number) -> bool:
    return x == 0 if isinstance(x, Symbolic) else size(x) <= ROUNDING


def mirrors(A: RationalMatrix) -> bool:
    """Tell if the determinant of a square matrix is below 0, as far as its numbers are known."""
    return is_below_0(rational.determinant(_enclosed(A)))


def _enclosed(A: RationalMatrix) -> RationalMatrix:
    """Put roots between their bounds, so that products of many stay short."""
    return tuple(tuple(map(enclosure, row)) for row in A)  # type: ignore[arg-type]  # numbers


def degrees_off(a: Operand, b: Operand, right: Callable[[RationalMatrix], RationalMatrix]) -> str:
    """Measure by how many degrees a matrix carries a vector away from where the right one does.

    `right` makes the right matrix of the wrong one. The text is empty where too little is known.
    """
    A, v = rational.linear_part(a.value.matrix), b.value.vector
    if right is rational.inverse_transpose and orthonormal(A):
        why = f"{a.name} only turns and mirrors" if mirrors(A) else f"{a.name} is rigid"
        return f": 0° off here, since {why}"
    try:
        found, wanted = rational.apply(A, v), rational.apply(right(A), v)
        across = rational.cross(found, wanted)
        sine, cosine = root(rational.dot(across, across)), rational.dot(found, wanted)
        if is_zero(sine) and is_zero(cosine):
            return ""  # one of the two vanishes
        degrees = shown(degrees_of(sine, cosine))
    except (NMatrixError, TooManyRootsError):  # too little is known
        return ""
    return f": {short_text(Fraction(float(degrees)), 4)}° off here"


def is_below_0(number: Number) -> bool:
    """Tell if a number is known to be below 0."""
    try:
        return is_negative(number)
    except NMatrixError:  # too little is known
        return False
