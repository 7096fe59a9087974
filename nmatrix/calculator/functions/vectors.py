"""Functions of vectors: lengths, angles, products, ways between two."""

from __future__ import annotations

from fractions import Fraction

from nmatrix.calculator.arithmetic.numbers import (
    Interval,
    Number,
    angle,
    bounds,
    degrees_of,
    exact_degrees,
    is_negative,
    is_zero,
    root,
)
from nmatrix.calculator.arithmetic.operators import cross, dot, together
from nmatrix.calculator.arithmetic.values import Value, ValueKind, each
from nmatrix.calculator.functions.function import (
    ArgumentError,
    Function,
    NoAnswerForArgumentError,
    Parameter,
    require_alike,
    require_size,
    scalar,
    vector,
    zero_vector,
)
from nmatrix.linear import rational
from nmatrix.linear.affine import cross_matrix
from nmatrix.linear.rational import ZERO, RationalVector

HALF = Fraction(1, 2)
_NUMBERS = (ValueKind.SCALAR, ValueKind.VECTOR, ValueKind.MATRIX)


def length_of(v: RationalVector) -> Fraction:
    """Compute |v|."""
    return Value(root(rational.dot(v, v))).scalar


def normalized(v: Value, what: str) -> RationalVector:
    """Divide a vector by its length.

    Raises
    ------
    NoAnswerError
        If it is zero.
    """
    if is_zero(rational.dot(v.vector, v.vector)):
        raise zero_vector(v, what)
    length = length_of(v.vector)
    return tuple(component / length for component in v.vector)


def _normalize(v: Value) -> Value:
    if len(v.vector) == 4 and not is_zero(v.vector[3]):
        raise ArgumentError(
            v,
            "normalize of four components",
            "w is not 0: it would count as length and shorten the direction",
            "normalise the three of a direction, or write vector(v), whose w is 0",
        )
    return Value(normalized(v, "normalize of the zero vector"))


def _norm(v: Value) -> Value:
    return Value(length_of(tuple(v.numbers)))  # type: ignore[arg-type]  # its numbers in one row


def _angle(a: Value, b: Value) -> Value:
    one, other = _directions(a, b)
    squares = [rational.dot(v, v) for v in (one, other)]
    for v, square in zip((a, b), squares, strict=True):
        if is_zero(square):
            raise zero_vector(v, "angle with the zero vector")
    cosine = rational.dot(one, other)
    normal = rational.cross(one, other)
    sine_square = rational.dot(normal, normal)
    sharp = exact_degrees(sine_square, cosine * cosine)
    if sharp is not None:
        return Value(180 - sharp if cosine < 0 else sharp)
    return Value(degrees_of(root(sine_square), cosine))


def _directions(a: Value, b: Value) -> list[RationalVector]:
    """Take two directions of the plane or of space; a w is dropped where it is 0."""
    require_alike(a, b)
    found = []
    for v in (a, b):
        require_size(v, (2, 3, 4), "a vector of 2 or 3")
        if len(v.vector) == 4 and not is_zero(v.vector[3]):
            why = "w is not 0, so it is no direction"
            raise ArgumentError(v, "angle with a vector of 4", why, "write .xyz behind it")
        found.append((*v.vector, ZERO)[:3])
    return found


def _outer(a: Value, b: Value) -> Value:
    return Value(tuple(tuple(x * y for y in b.vector) for x in a.vector))


def _cross_matrix(v: Value) -> Value:
    require_size(v, 3, "a vector of 3")
    return Value(cross_matrix(v.vector))


def _reflect(v: Value, normal: Value) -> Value:
    require_alike(v, normal)
    square = rational.dot(normal.vector, normal.vector)
    if is_zero(square):
        raise zero_vector(normal, "reflect at the zero vector")
    along = 2 * rational.dot(v.vector, normal.vector) / square
    pairs = zip(v.vector, normal.vector, strict=True)
    return Value(tuple(x - along * n for x, n in pairs))


def _lerp(a: Value, b: Value, t: Value) -> Value:
    require_alike(a, b)
    back = 1 - t.scalar
    start, end = each(a.entries, lambda x: back * x), each(b.entries, lambda x: t.scalar * x)
    return Value(together(start, end))


def _slerp(a: Value, b: Value, t: Value) -> Value:
    require_alike(a, b)
    start, end = (normalized(v, "slerp with the zero vector") for v in (a, b))
    if len(start) == 4 and is_negative_or_open(rational.dot(start, end)):
        end = tuple(-x for x in end)  # the same turn, the shorter way
    added = tuple(x + y for x, y in zip(start, end, strict=True))
    if all(map(_is_known_zero, added)):
        why = "every great circle through them is as short"
        raise NoAnswerForArgumentError(b, "slerp between opposite ways", why, "name a way between")
    if t.scalar == HALF:
        return Value(normalized(Value(added), "slerp between opposite ways"))
    apart = tuple(x - y for x, y in zip(end, start, strict=True))
    if all(map(_is_known_zero, apart)):
        return Value(start)
    # |end − start| = 2 sin(Ω/2) and |start + end| = 2 cos(Ω/2): no digit cancels.
    squares = rational.dot(apart, apart), rational.dot(added, added)
    sharp = exact_degrees(*squares)
    whole = 2 * Value(degrees_of(*map(root, squares)) if sharp is None else sharp).scalar
    over = Value(root(squares[0] * squares[1])).scalar / 2
    back, on = (angle(part * whole).sine / over for part in (1 - t.scalar, t.scalar))
    return Value(tuple(back * x + on * y for x, y in zip(start, end, strict=True)))


def is_negative_or_open(x: Number) -> bool:
    """Tell whether a number is below 0; of one that may be 0 either answer is right."""
    return bounds(x)[1] <= 0 if isinstance(x, Interval) else is_negative(x)


def _is_known_zero(x: Number) -> bool:
    return not isinstance(x, Interval) and is_zero(x)


FUNCTIONS: dict[str, Function] = {
    "normalize": Function(
        (vector(),),
        "the vector of length 1 in the same direction",
        "divided by its length",
        "v / |v|",
        "normalize([1, 1, 0])",
        "[√2/2, √2/2, 0]",
        _normalize,
    ),
    "length": Function(
        (vector(),),
        "the length of a vector",
        "the root of v · v",
        "|v| = √(v · v)",
        "length([3, 4, 0])",
        "5",
        lambda v: Value(length_of(v.vector)),
    ),
    "norm": Function(
        (Parameter("v", (ValueKind.VECTOR, ValueKind.MATRIX)),),
        "the length of a vector, or the Frobenius norm of a matrix",
        "the root of the sum of all squares",
        "‖A‖ = √(Σ Aᵢⱼ²)",
        "norm([1 1; 1 1])",
        "2",
        _norm,
    ),
    "dot": Function(
        (vector("a"), vector("b")),
        "the scalar product",
        "the sum of the products",
        "a · b = a₁b₁ + a₂b₂ + a₃b₃",
        "dot([1, 2, 3], [1, 0, 1])",
        "4",
        lambda a, b: Value(dot(a, b)),
    ),
    "cross": Function(
        (vector("a"), vector("b")),
        "the vector that stands on both, as long as their parallelogram is large",
        "perpendicular to both",
        "a × b = (a₂b₃ − a₃b₂, a₃b₁ − a₁b₃, a₁b₂ − a₂b₁)",
        "cross([1, 0, 0], [0, 1, 0])",
        "[0, 0, 1]",
        lambda a, b: Value(cross(a, b)),
    ),
    "cross_matrix": Function(
        (vector("a"),),
        "the matrix that takes v to a × v",
        "a cross product is linear in v",
        "[a]× v = a × v",
        "cross_matrix([1, 2, 3])",
        "[0 -3 2; 3 0 -1; -2 1 0]",
        _cross_matrix,
    ),
    "outer": Function(
        (vector("a"), vector("b")),
        "the matrix of all products of an entry of a with one of b",
        "a column times a row",
        "(a bᵀ)ᵢⱼ = aᵢ bⱼ",
        "outer([1, 2], [3, 4])",
        "[3 4; 6 8]",
        _outer,
    ),
    "angle": Function(
        (vector("a"), vector("b")),
        "the angle between two vectors, in degrees",
        "arctan of |a×b| over a·b, in degrees",
        "tan θ = |a × b| / (a · b)",
        "angle([1, 0, 0], [1, 1, 0])",
        "45",
        _angle,
    ),
    "reflect": Function(
        (vector("v"), vector("normal")),
        "the direction v after a mirror with this normal, of any length",
        "the part along the normal is turned round",
        "v − 2 (v · n) / (n · n) n",
        "reflect([1, -1, 0], [0, 2, 0])",
        "[1, 1, 0]",
        _reflect,
    ),
    "lerp": Function(
        (Parameter("a", _NUMBERS), Parameter("b", _NUMBERS), scalar("t")),
        "the straight way from a, where t is 0, to b, where t is 1",
        "so much of one and the rest of the other",
        "(1 − t) a + t b",
        "lerp([0, 4], [2, 0], 1/4)",
        "[1/2, 3]",
        _lerp,
    ),
    "slerp": Function(
        (vector("a"), vector("b"), scalar("t")),
        "the way at even speed from the direction a to b over the unit sphere; four numbers are a "
        "quaternion, whose sign is free, and go the shorter way",
        "so much of the angle between them",
        "(sin((1 − t)Ω) a + sin(tΩ) b) / sin Ω",
        "slerp([1, 0], [0, 1], 1/3)",
        "[√3/2, 1/2]",
        _slerp,
    ),
}
