"""Functions of vectors: lengths, angles, products."""

from __future__ import annotations

from fractions import Fraction

from nmatrix.calculator.functions.function import Function, require_size, vector
from nmatrix.calculator.numbers import degrees_of, is_zero, root
from nmatrix.calculator.operators import cross, dot
from nmatrix.calculator.values import Value
from nmatrix.errors import IllegalValueError, NoAnswerError
from nmatrix.linear import rational

# Where cos² is rational, the angle is a rational number of degrees only here (Niven, 1956).
RATIONAL_ANGLES = {
    Fraction(0): 90,
    Fraction(1, 4): 60,
    Fraction(1, 2): 45,
    Fraction(3, 4): 30,
    Fraction(1): 0,
}


def _normalize(v: Value) -> Value:
    components = v.vector
    if len(components) == 4 and not is_zero(components[3]):
        raise IllegalValueError(
            "normalize of four components",
            "w is not 0: it would count as length and shorten the direction",
            "normalise the three of a direction, or write vector(v), whose w is 0",
        )
    square = rational.dot(components, components)
    if is_zero(square):
        raise NoAnswerError("normalize of the zero vector", "it has no direction", "use another")
    length = Value(root(square)).scalar
    return Value(tuple(component / length for component in components))


def _length(v: Value) -> Value:
    return Value(root(rational.dot(v.vector, v.vector)))


def _angle(a: Value, b: Value) -> Value:
    require_size(a, 3, "a vector of 3")
    require_size(b, 3, "a vector of 3")
    squares = [rational.dot(v.vector, v.vector) for v in (a, b)]
    if any(is_zero(square) for square in squares):
        raise NoAnswerError("angle with the zero vector", "it has no direction", "use another")
    cosine = rational.dot(a.vector, b.vector)
    if a.exact and b.exact:
        sharp = RATIONAL_ANGLES.get(cosine * cosine / (squares[0] * squares[1]))
        if sharp is not None:
            return Value(Fraction(sharp if cosine >= 0 else 180 - sharp))
    normal = rational.cross(a.vector, b.vector)
    return Value(degrees_of(root(rational.dot(normal, normal)), cosine))


FUNCTIONS: dict[str, Function] = {
    "normalize": Function(
        (vector(),),
        "the vector of length 1 in the same direction",
        "divided by its length",
        "v / |v|",
        "normalize([1, 1, 0])",
        _normalize,
    ),
    "length": Function(
        (vector(),),
        "the length of a vector",
        "the root of v · v",
        "|v| = √(v · v)",
        "length([3, 4, 0])",
        _length,
    ),
    "dot": Function(
        (vector("a"), vector("b")),
        "the scalar product",
        "the sum of the products",
        "a · b = a₁b₁ + a₂b₂ + a₃b₃",
        "dot([1, 2, 3], [1, 0, 1])",
        lambda a, b: Value(dot(a, b)),
    ),
    "cross": Function(
        (vector("a"), vector("b")),
        "the vector that stands on both, as long as their parallelogram is large",
        "perpendicular to both",
        "a × b = (a₂b₃ − a₃b₂, a₃b₁ − a₁b₃, a₁b₂ − a₂b₁)",
        "cross([1, 0, 0], [0, 1, 0])",
        lambda a, b: Value(cross(a, b)),
    ),
    "angle": Function(
        (vector("a"), vector("b")),
        "the angle between two vectors, in degrees",
        "arctan of |a×b| over a·b, in degrees",
        "tan θ = |a × b| / (a · b)",
        "angle([1, 0, 0], [1, 1, 0])",
        _angle,
    ),
}
