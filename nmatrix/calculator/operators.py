"""The five binary operators, each with its rule in words."""

from __future__ import annotations

from collections.abc import Callable

from nmatrix.calculator.numbers import is_zero
from nmatrix.calculator.values import Entries, Value, ValueKind, each
from nmatrix.errors import IllegalValueError, NoAnswerError
from nmatrix.linear import rational

Computed = tuple[Entries, str]


def _add(a: Value, b: Value) -> Computed:
    if a.shape != b.shape:
        raise IllegalValueError(f"{a.shape} and {b.shape}", "a sum needs equal sizes", "match them")
    return _together(a.entries, b.entries), "entry by entry"


def _subtract(a: Value, b: Value) -> Computed:
    return _add(a, -b)


def _together(a: Entries, b: Entries) -> Entries:
    if isinstance(a, tuple) and isinstance(b, tuple):
        return tuple(_together(x, y) for x, y in zip(a, b, strict=True))  # type: ignore[return-value]  # same shape
    return a + b  # type: ignore[operator]  # numbers that meet can be added


def _times(a: Value, b: Value) -> Computed:
    if a.kind is ValueKind.SCALAR:
        return each(b.entries, lambda x: a.scalar * x), "every entry times the number"
    if b.kind is ValueKind.SCALAR:
        return each(a.entries, lambda x: x * b.scalar), "every entry times the number"
    raise IllegalValueError(
        f"{a.shape} * {b.shape}", "* is for numbers", "use @, dot(a, b) or cross(a, b)"
    )


def _over(a: Value, b: Value) -> Computed:
    if b.kind is not ValueKind.SCALAR:
        raise IllegalValueError(f"division by {b.shape}", "only numbers divide", "use inverse(…)")
    if is_zero(b.scalar):
        raise NoAnswerError("a division by 0", "nothing times 0 gives it", "check the divisor")
    return each(a.entries, lambda x: x / b.scalar), "every entry over the number"


def _matrix_product(a: Value, b: Value) -> Computed:
    if a.kind is not ValueKind.MATRIX or b.kind is ValueKind.SCALAR:
        raise IllegalValueError(
            f"{a.shape} @ {b.shape}", "a matrix stands on the left", "swap them"
        )
    width, height = len(a.matrix[0]), len(b.entries)  # type: ignore[arg-type]  # not a scalar
    if width == 4 and b.kind is ValueKind.VECTOR and height == 3:
        raise IllegalValueError(
            f"{a.shape} @ {b.shape}",
            "w is missing: a point has w = 1, a vector w = 0",
            "write point(v) or vector(v)",
        )
    if width != height:
        raise IllegalValueError(f"{a.shape} @ {b.shape}", "the inner sizes differ", "match them")
    if b.kind is ValueKind.VECTOR:
        return rational.apply(a.matrix, b.vector), "each row dot the vector"
    return rational.product(a.matrix, b.matrix), "rows times columns"


BINARY: dict[str, Callable[[Value, Value], Computed]] = {
    "+": _add,
    "-": _subtract,
    "*": _times,
    "/": _over,
    "@": _matrix_product,
}
