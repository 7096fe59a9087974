"""The calculator's functions: their names, arguments, and the rules that a student would quote.

They are written once for every kind of number, so that fractions, intervals and rounded floats go
through the same sums in the same order: that of the formula, from left to right.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

from nmatrix.calculator.numbers import angle, degrees_of, is_zero, root, size
from nmatrix.calculator.values import Value, ValueKind
from nmatrix.errors import IllegalValueError, NoAnswerError
from nmatrix.linear import affine, rational
from nmatrix.linear.rational import RationalMatrix, RationalVector

SIZES = (2, 3, 4)  # of an identity
# Where cos² is rational, the angle is a rational number of degrees only here (Niven, 1956).
RATIONAL_ANGLES = {
    Fraction(0): 90,
    Fraction(1, 4): 60,
    Fraction(1, 2): 45,
    Fraction(3, 4): 30,
    Fraction(1): 0,
}

_WORDS = {
    ValueKind.SCALAR: "a number",
    ValueKind.VECTOR: "a vector",
    ValueKind.MATRIX: "a matrix",
}

Compute = Callable[..., Value]


@dataclass(frozen=True)
class Function:
    """One function: the kinds of its arguments, its rule in words, and its computation.

    A function that gathers takes three numbers in the place of a vector, too; one that turns takes
    degrees.
    """

    takes: tuple[ValueKind, ...]
    rule: str
    compute: Compute
    gathers: bool = False
    turns: bool = False

    @property
    def wanted(self) -> str:
        """The kinds of the arguments in words."""
        if self.gathers:
            return "three numbers or a vector"
        return " and ".join(_WORDS[kind] for kind in self.takes)


def _of_square(function: Callable[[RationalMatrix], RationalMatrix | Fraction]) -> Compute:
    def compute(A: Value) -> Value:
        _require_square(A)
        return Value(function(A.matrix))

    return compute


def _require_square(A: Value) -> None:
    if len(A.matrix) != len(A.matrix[0]):
        raise IllegalValueError(A.shape, "a square matrix is needed", "use 2×2, 3×3 or 4×4")


def _require_size(value: Value, size: int, what: str) -> None:
    if len(value.entries) != size:  # type: ignore[arg-type]  # a vector or a matrix has a length
        raise IllegalValueError(value.shape, f"{what} is needed", "check its size")


def _of_affine(function: Callable[[RationalMatrix], RationalMatrix | RationalVector]) -> Compute:
    def compute(M: Value) -> Value:
        _require_size(M, 4, "a 4×4 matrix")
        return Value(function(M.matrix))

    return compute


def _with_w(w: int) -> Compute:
    def compute(v: Value) -> Value:
        _require_size(v, 3, "a vector of 3")
        return Value((*v.vector, Fraction(w)))

    return compute


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


def _dot(a: Value, b: Value) -> Value:
    _same_size(a, b)
    return Value(rational.dot(a.vector, b.vector))


def _cross(a: Value, b: Value) -> Value:
    _require_size(a, 3, "a vector of 3")
    _require_size(b, 3, "a vector of 3")
    return Value(rational.cross(a.vector, b.vector))


def _angle(a: Value, b: Value) -> Value:
    _require_size(a, 3, "a vector of 3")
    _require_size(b, 3, "a vector of 3")
    squares = [rational.dot(v.vector, v.vector) for v in (a, b)]
    if any(is_zero(square) for square in squares):
        raise NoAnswerError("angle with the zero vector", "it has no direction", "use another")
    cosine = rational.dot(a.vector, b.vector)
    if a.exact and b.exact:
        sharp = RATIONAL_ANGLES.get(cosine**2 / (squares[0] * squares[1]))
        if sharp is not None:
            return Value(Fraction(sharp if cosine >= 0 else 180 - sharp))
    normal = rational.cross(a.vector, b.vector)
    return Value(degrees_of(root(rational.dot(normal, normal)), cosine))


def _same_size(a: Value, b: Value) -> None:
    if len(a.vector) != len(b.vector):
        raise IllegalValueError(f"{a.shape} and {b.shape}", "they differ in size", "match them")


def _identity(n: Value) -> Value:
    if n.scalar not in SIZES:
        raise IllegalValueError("its size", "it is 2, 3 or 4", "write identity(4)")
    return Value(rational.identity(SIZES[SIZES.index(n.scalar)]))


def _rotate(axis: str) -> Function:
    def compute(turn: Value) -> Value:
        return Value(rational.affine_matrix(affine.rotation_about(axis, angle(turn.scalar))))

    rule = f"a rotation about {axis.lower()}, in degrees"
    return Function((ValueKind.SCALAR,), rule, compute, turns=True)


def _builder(rule: str, make: Callable[[RationalVector], RationalMatrix]) -> Function:
    def compute(v: Value) -> Value:
        _require_size(v, 3, "three numbers")
        return Value(make(v.vector))

    return Function((ValueKind.VECTOR,), rule, compute, gathers=True)


def _trace_of(A: RationalMatrix) -> Fraction:
    return sum((A[i][i] for i in range(len(A))), Fraction(0))


def _rank(A: Value) -> Value:
    """Count the rows that elimination leaves, the largest pivot of each column first."""
    rows = [list(row) for row in A.matrix]
    found = 0
    for column in range(len(rows[0])):
        left = range(found, len(rows))
        pivot = max(left, key=lambda i: size(rows[i][column]), default=None)
        if pivot is None or is_zero(rows[pivot][column]):
            continue
        rows[found], rows[pivot] = rows[pivot], rows[found]
        head = rows[found]
        for i in range(found + 1, len(rows)):
            factor = rows[i][column] / head[column]
            rows[i] = [a - factor * b for a, b in zip(rows[i], head, strict=True)]
        found += 1
    return Value(Fraction(found))


_M, _V, _S = (ValueKind.MATRIX,), (ValueKind.VECTOR,), (ValueKind.SCALAR,)
_VV = (ValueKind.VECTOR, ValueKind.VECTOR)

FUNCTIONS: dict[str, Function] = {
    "inverse": Function(_M, "the adjugate over the determinant", _of_square(rational.inverse)),
    "transpose": Function(_M, "rows become columns", lambda A: Value(rational.transpose(A.matrix))),
    "inverse_transpose": Function(
        _M, "the cofactors over the determinant", _of_square(rational.inverse_transpose)
    ),
    "cofactor": Function(
        _M,
        "each entry is a signed determinant of what is left",
        _of_square(rational.cofactor_matrix),
    ),
    "adjugate": Function(_M, "the cofactors, transposed", _of_square(rational.adjugate)),
    "det": Function(_M, "a row times its cofactors", _of_square(rational.determinant)),
    "rank": Function(_M, "rows left after elimination", _rank),
    "trace": Function(_M, "the sum of the diagonal", _of_square(_trace_of)),
    "linear": Function(_M, "the 3×3 block", _of_affine(rational.linear_part)),
    "translation": Function(_M, "the last column", _of_affine(rational.translation)),
    "point": Function(_V, "w = 1: points move with the translation", _with_w(1)),
    "vector": Function(_V, "w = 0: vectors do not", _with_w(0)),
    "normalize": Function(_V, "divided by its length", _normalize),
    "length": Function(_V, "the root of v · v", _length),
    "dot": Function(_VV, "the sum of the products", _dot),
    "cross": Function(_VV, "perpendicular to both", _cross),
    "angle": Function(_VV, "arctan of |a×b| over a·b, in degrees", _angle),
    "identity": Function(_S, "ones on the diagonal", _identity),
    "rotate_x": _rotate("X"),
    "rotate_y": _rotate("Y"),
    "rotate_z": _rotate("Z"),
    "translate": _builder(
        "a translation", lambda v: rational.affine_matrix(rational.identity(3), v)
    ),
    "scale": _builder("a scale", lambda v: rational.affine_matrix(rational.diagonal(v))),
    "shear": _builder(
        "a shear xy, xz, yz", lambda v: rational.affine_matrix(affine.shear_matrix(v))
    ),
}
