"""The operators, each with its rule in words; powers, comparisons, and parts by their places."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction

from nmatrix.calculator.arithmetic.numbers import Number, is_zero, shown, size
from nmatrix.calculator.arithmetic.symbolic import Symbolic
from nmatrix.calculator.arithmetic.values import Arithmetic, Entries, Value, ValueKind, each
from nmatrix.errors import IllegalValueError, NoAnswerError
from nmatrix.linear import rational
from nmatrix.linear.rounding import short_text

Computed = tuple[Entries, str]
ALIKE = Fraction(5, 10**7)  # of the larger number: six digits are the same


def _add(a: Value, b: Value) -> Computed:
    if a.shape != b.shape:
        raise IllegalValueError(f"{a.shape} and {b.shape}", "a sum needs equal sizes", "match them")
    return together(a.entries, b.entries), "entry by entry"


def _subtract(a: Value, b: Value) -> Computed:
    return _add(a, -b)


def together(a: Entries, b: Entries) -> Entries:
    """Add two values of one shape, entry by entry."""
    if isinstance(a, tuple) and isinstance(b, tuple):
        return tuple(together(x, y) for x, y in zip(a, b, strict=True))  # type: ignore[return-value]  # same shape
    return a + b  # type: ignore[operator,return-value]  # numbers that meet


def _times(a: Value, b: Value) -> Computed:
    if a.kind is ValueKind.SCALAR:
        return each(b.entries, lambda x: a.scalar * x), "every entry times the number"
    if b.kind is ValueKind.SCALAR:
        return each(a.entries, lambda x: x * b.scalar), "every entry times the number"
    if a.kind is b.kind is ValueKind.VECTOR:
        raise IllegalValueError(
            f"{a.shape} * {b.shape}",
            "two vectors have several products",
            "write dot(a, b), cross(a, b) or outer(a, b)",
        )
    raise IllegalValueError(
        f"{a.shape} * {b.shape}", "* is for numbers", "write @ between matrices and vectors"
    )


def _over(a: Value, b: Value) -> Computed:
    if b.kind is not ValueKind.SCALAR:
        raise IllegalValueError(f"division by {b.shape}", "only numbers divide", "use inverse(…)")
    if is_zero(b.scalar):
        raise NoAnswerError("a division by 0", "nothing times 0 gives it", "check the divisor")
    return each(a.entries, lambda x: x / b.scalar), "every entry over the number"


def _matrix_product(a: Value, b: Value) -> Computed:
    if a.kind is not ValueKind.MATRIX or b.kind is ValueKind.SCALAR:
        if ValueKind.SCALAR in (a.kind, b.kind):
            raise IllegalValueError(
                f"{a.shape} @ {b.shape}", "@ is for matrices", "write * instead"
            )
        raise IllegalValueError(
            f"{a.shape} @ {b.shape}", "a matrix stands on the left", "swap them, or write dot(a, b)"
        )
    width, height = len(a.matrix[0]), len(b.entries)  # type: ignore[arg-type]  # not a scalar
    if width == 4 and b.kind is ValueKind.VECTOR and height == 3:
        raise IllegalValueError(
            f"{a.shape} @ {b.shape}",
            "w is missing: a point has w = 1, a direction w = 0",
            "write point(v) or vector(v)",
        )
    if width == 3 and b.kind is ValueKind.VECTOR and height == 4:
        raise IllegalValueError(
            f"{a.shape} @ {b.shape}", "the vector has a w", "write .xyz behind the vector"
        )
    if width != height:
        why = f"{width} columns meet {height} rows" if height > 1 else f"{width} columns meet 1 row"
        raise IllegalValueError(f"{a.shape} @ {b.shape}", why, "match them, or transpose one")
    if b.kind is ValueKind.VECTOR:
        return rational.apply(a.matrix, b.vector), "each row dot the vector"
    return rational.product(a.matrix, b.matrix), "rows times columns"


def _dotted(a: Value, b: Value) -> Computed:
    """Compute a · b as mathematics means it: of numbers, of vectors, of matrices."""
    if ValueKind.SCALAR in (a.kind, b.kind):
        return _times(a, b)
    if a.kind is b.kind is ValueKind.VECTOR:
        return dot(a, b), "the sum of the products"
    return _matrix_product(a, b)


def _crossed(a: Value, b: Value) -> Computed:
    """Compute a × b: of numbers their product, of vectors what stands on both."""
    if a.kind is b.kind is ValueKind.VECTOR:
        return cross(a, b), "perpendicular to both"
    return _times(a, b)


def dot(a: Value, b: Value) -> Entries:
    """Compute a · b of two vectors of one size."""
    if len(a.vector) != len(b.vector):
        raise IllegalValueError(f"{a.shape} and {b.shape}", "they differ in size", "match them")
    return rational.dot(a.vector, b.vector)


def cross(a: Value, b: Value) -> Entries:
    """Compute a × b of two vectors of three."""
    for one in (a, b):
        if len(one.vector) != 3:
            why = "a cross product is of two vectors of 3"
            raise IllegalValueError(one.shape, why, "write .xyz behind a vector of 4")
    return rational.cross(a.vector, b.vector)


BINARY: dict[str, Callable[[Value, Value], Computed]] = {
    "+": _add,
    "-": _subtract,
    "*": _times,
    "/": _over,
    "@": _matrix_product,
    "·": _dotted,
    "×": _crossed,
}


def binary(sign: str, a: Value, b: Value) -> tuple[Value, str]:
    """Compute a sum, a difference, a product or a quotient, and quote its rule.

    Raises
    ------
    IllegalValueError
        For sizes and kinds that do not go together.
    NoAnswerError
        For a division by 0.
    """
    if ValueKind.TRUTH in (a.kind, b.kind):
        raise IllegalValueError(
            "a comparison", f"{sign} is for numbers", "compare last: (a + b) == c"
        )
    entries, rule = BINARY[sign](a, b)
    return Value(entries), rule


def power(base: Value, exponent: int, arithmetic: Arithmetic) -> Value:
    """Multiply a number or a square matrix so many times with itself, by repeated squaring.

    Raises
    ------
    IllegalValueError
        For a vector, a matrix that is not square, or numbers that grow too long.
    NoAnswerError
        For a power below 0 of the number 0; matrices come here inverted.
    """
    if base.kind is ValueKind.SCALAR:
        one = Value(Fraction(1)).kept_by(arithmetic)
        if exponent < 0:
            base = Value(_over(one, base)[0])
    elif base.kind is ValueKind.MATRIX and len(base.matrix) == len(base.matrix[0]):
        one = Value(rational.identity(len(base.matrix))).kept_by(arithmetic)
    else:
        why = "powers are of numbers and square matrices"
        raise IllegalValueError(base.shape, why, "write dot(v, v) for the square of a length")
    times = _times if base.kind is ValueKind.SCALAR else _matrix_product
    found, left = one, abs(exponent)
    square = base
    while left:
        if left % 2:
            found = Value(times(found, square)[0]).kept_by(arithmetic)
        left //= 2
        if left:
            square = Value(times(square, square)[0]).kept_by(arithmetic)
    return found


def equal(a: Value, b: Value) -> bool:
    """Decide if two values are the same, exactly.

    Raises
    ------
    IllegalValueError
        For two kinds or sizes.
    NoAnswerError
        Where what is known of an irrational leaves both possible.
    """
    return all(is_zero(one) for one in _differences(a, b))


def nearly_equal(a: Value, b: Value) -> tuple[bool, str]:
    """Tell if two values are the same to six digits of the largest entry, and how far they are off.

    Raises
    ------
    IllegalValueError
        For two kinds or sizes.
    """
    for one in (*a.numbers, *b.numbers):
        if isinstance(one, Symbolic):
            raise one.unknown
    largest = max(size(x) for value in (a, b) for x in value.numbers)
    off = max(size(one) for one in _differences(a, b))
    told = f"The largest difference is {short_text(Fraction(off), 3)}."
    return off <= ALIKE * largest, told


def _differences(a: Value, b: Value) -> list[Number]:
    if a.shape != b.shape or a.kind is ValueKind.TRUTH:
        what = f"{a.shape} and {b.shape}"
        raise IllegalValueError(what, "only things of one size compare", "match them")
    return [x - y for x, y in zip(a.numbers, b.numbers, strict=True)]  # type: ignore[operator,misc]  # numbers that meet


def part(value: Value, places: Sequence[Value | None]) -> Value:
    """Take an entry, a row or a column; None is all of a direction, places count from 0.

    Raises
    ------
    IllegalValueError
        For a place that is no whole number, or beyond the last one.
    """
    if value.kind is ValueKind.MATRIX:
        rows, columns = value.matrix, range(len(value.matrix[0]))
        chosen = [rows[i] for i in _range(places[0], len(rows))]
        across = _range(places[1], len(columns)) if len(places) > 1 else columns
        found = tuple(tuple(row[j] for j in across) for row in chosen)
        one_row = places[0] is not None
        one_column = len(places) > 1 and places[1] is not None
        if one_row and one_column:
            return Value(found[0][0])
        if one_row or one_column:
            return Value(tuple(entry for row in found for entry in row))
        return Value(found)
    if value.kind is ValueKind.VECTOR and len(places) == 1:
        entries = tuple(value.vector[i] for i in _range(places[0], len(value.vector)))
        return Value(entries if places[0] is None else entries[0])
    raise IllegalValueError(value.shape, "it has no such places", "write v[0] or A[0, 1]")


def _range(place: Value | None, count: int) -> range:
    if place is None:
        return range(count)
    number = shown(place.scalar) if place.kind is ValueKind.SCALAR else None
    if isinstance(number, (Fraction, float)) and number == int(number) and 0 <= number < count:
        return range(int(number), int(number) + 1)
    what = "a place" if number is None else f"the place {number}"
    raise IllegalValueError(what, f"places are 0 to {count - 1}", "count from 0")
