"""The fourth coordinate: what knows its kind leaves it out, and matrices of four columns get it."""

from __future__ import annotations

from fractions import Fraction

from nmatrix.calculator.arithmetic.meanings import Kind, Located, Map
from nmatrix.calculator.arithmetic.numbers import is_zero
from nmatrix.calculator.arithmetic.values import Value, ValueKind
from nmatrix.enums import Frame

_W = {Kind.POINT: 1, Kind.DIRECTION: 0, Kind.NORMAL: 0}
_SHAPES = {Map: ValueKind.MATRIX, Located: ValueKind.VECTOR}


def w_of(value: Value) -> Fraction | None:
    """Tell the w that a vector left out; None where it has left out none, or its kind is unknown.

    Examples
    --------
    >>> w_of(Value((Fraction(1),) * 3, Located(Frame.WORLD, Kind.POINT)))
    Fraction(1, 1)
    """
    meaning = value.meaning
    if not isinstance(meaning, Located) or meaning.kind not in _W or len(value.vector) != 3:
        return None
    if meaning.space is Frame.CLIP:
        return None  # its w was cut off, and is none that the kind could tell
    return Fraction(_W[meaning.kind])


def with_w(A: Value, v: Value) -> Value:
    """Write the w of a vector behind it, where the matrix on its left has four columns."""
    w = w_of(v)
    if w is None or A.kind is not ValueKind.MATRIX or len(A.matrix[0]) != 4:
        return v
    return Value((*v.vector, w), v.meaning)


def understood(v: Value, other: Value) -> Value:
    """Read a literal of four beside a thing without w: a point if its w is 1, a direction if 0.

    Examples
    --------
    >>> p = Value((1, 2, 3), Located(Frame.WORLD, Kind.POINT))
    >>> print(understood(Value((4, 5, 6, 1)), p).meaning)
    point
    """
    is_literal = v.meaning is None and v.kind is ValueKind.VECTOR and len(v.vector) == 4
    if not is_literal or w_of(other) is None:
        return v
    *place, w = v.vector
    for kind in (Kind.POINT, Kind.DIRECTION):
        if w == _W[kind]:
            return Value(tuple(place), Located(None, kind))
    return v


def settled(value: Value) -> Value:
    """Leave out the w of a result whose kind tells it, after the division that it asks for.

    In clip space w stays. What came from a matrix of which nothing is known may be anywhere, so
    there nothing is divided.

    Raises
    ------
    NoAnswerError
        Where what is known of w leaves open if it is 0.

    Examples
    --------
    >>> settled(Value((6, 4, 2, 2), Located(Frame.WORLD, Kind.POINT))).entries
    (3.0, 2.0, 1.0)
    """
    meaning = value.meaning
    if meaning is not None and value.kind is not _SHAPES[type(meaning)]:
        return Value(value.entries)
    if not isinstance(meaning, Located) or len(value.vector) != 4 or meaning.space is Frame.CLIP:
        return value
    *place, w = value.vector
    if meaning.kind in (Kind.NORMAL, Kind.VECTOR):
        return Value(tuple(place), meaning)
    if is_zero(w):
        return Value(tuple(place), Located(meaning.space, Kind.DIRECTION))
    if meaning.space is None and w != 1:
        return Value(value.entries)
    return Value(tuple(x / w for x in place), Located(meaning.space, Kind.POINT))
