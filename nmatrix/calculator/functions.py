"""The calculator's functions: their names, arguments, and the rules that a student would quote.

A root, a sine or an angle that is not rational is carried to 2⁻¹³⁰ and marked as not exact.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from math import isqrt

from nmatrix.calculator.values import Value, ValueKind
from nmatrix.errors import IllegalValueError, NoAnswerError
from nmatrix.linear import affine, rational, rounding
from nmatrix.linear.angle import DEGREES, Angle, exact_angle_between

ROOT_BITS = 280
EXACT_TURNS = 90  # degrees: only quarter turns have a rational sine and cosine together
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

    A function that gathers takes three numbers in the place of a vector, too.
    """

    takes: tuple[ValueKind, ...]
    rule: str
    compute: Compute
    gathers: bool = False

    @property
    def wanted(self) -> str:
        """The kinds of the arguments in words."""
        if self.gathers:
            return "three numbers or a vector"
        return " and ".join(_WORDS[kind] for kind in self.takes)


def exact_root(square: Fraction) -> Value:
    """Take a square root: exact if it is rational, else right to 2⁻¹³⁰ of itself.

    Examples
    --------
    >>> exact_root(Fraction(9, 4)).entries
    Fraction(3, 2)
    """
    product = square.numerator * square.denominator
    whole = isqrt(product)
    if whole * whole == product:
        return Value(Fraction(whole, square.denominator))
    scaled = isqrt(product << (2 * ROOT_BITS))
    return Value(Fraction(scaled, square.denominator << ROOT_BITS), exact=False)


def _of_square(
    function: Callable[[rational.RationalMatrix], rational.RationalMatrix | Fraction],
) -> Compute:
    def compute(A: Value) -> Value:
        _require_square(A)
        return Value(function(A.matrix), A.exact)

    return compute


def _require_square(A: Value) -> None:
    if len(A.matrix) != len(A.matrix[0]):
        raise IllegalValueError(A.shape, "a square matrix is needed", "use 2×2, 3×3 or 4×4")


def _require_size(value: Value, size: int, what: str) -> None:
    if len(value.entries) != size:  # type: ignore[arg-type]  # a vector or a matrix has a length
        raise IllegalValueError(value.shape, f"{what} is needed", "check its size")


def _of_affine(
    function: Callable[
        [rational.RationalMatrix], rational.RationalMatrix | rational.RationalVector
    ],
) -> Compute:
    def compute(M: Value) -> Value:
        _require_size(M, 4, "a 4×4 matrix")
        return Value(function(M.matrix), M.exact)

    return compute


def _with_w(w: int) -> Compute:
    def compute(v: Value) -> Value:
        _require_size(v, 3, "a vector of 3")
        return Value((*v.vector, Fraction(w)), v.exact)

    return compute


def _normalize(v: Value) -> Value:
    components = v.vector
    if len(components) == 4 and components[3] != 0:
        raise IllegalValueError(
            "normalize of four components",
            "w is not 0: it would count as length and shorten the direction",
            "normalise the three of a direction, or write vector(v), whose w is 0",
        )
    square = rational.dot(components, components)
    if square == 0:
        raise NoAnswerError("normalize of the zero vector", "it has no direction", "use another")
    length = exact_root(square)
    unit = tuple(component / length.scalar for component in components)
    return Value(unit, v.exact and length.exact)


def _length(v: Value) -> Value:
    root = exact_root(rational.dot(v.vector, v.vector))
    return Value(root.entries, root.exact and v.exact)


def _dot(a: Value, b: Value) -> Value:
    _same_size(a, b)
    return Value(rational.dot(a.vector, b.vector), a.exact and b.exact)


def _cross(a: Value, b: Value) -> Value:
    _require_size(a, 3, "a vector of 3")
    _require_size(b, 3, "a vector of 3")
    return Value(rational.cross(a.vector, b.vector), a.exact and b.exact)


def _angle(a: Value, b: Value) -> Value:
    _require_size(a, 3, "a vector of 3")
    _require_size(b, 3, "a vector of 3")
    p, q = rounding.integers(a.vector)[0], rounding.integers(b.vector)[0]
    if not any(p) or not any(q):
        raise NoAnswerError("angle with the zero vector", "it has no direction", "use another")
    cosine = rational.dot(a.vector, b.vector)
    square = cosine**2 / (rational.dot(a.vector, a.vector) * rational.dot(b.vector, b.vector))
    if square in RATIONAL_ANGLES:
        sharp = RATIONAL_ANGLES[square]
        return Value(Fraction(sharp if cosine >= 0 else 180 - sharp), a.exact and b.exact)
    return Value(exact_angle_between(p, q) * DEGREES, exact=False)


def _same_size(a: Value, b: Value) -> None:
    if len(a.vector) != len(b.vector):
        raise IllegalValueError(f"{a.shape} and {b.shape}", "they differ in size", "match them")


def _identity(n: Value) -> Value:
    if n.scalar not in (2, 3, 4):
        raise IllegalValueError("its size", "it is 2, 3 or 4", "write identity(4)")
    return Value(rational.identity(int(n.scalar)))


def _rotate(axis: str) -> Compute:
    def compute(turn: Value) -> Value:
        turned = affine.rotation_about(axis, Angle.degrees(turn.scalar))
        exact = turn.exact and turn.scalar % EXACT_TURNS == 0
        return Value(rational.affine_matrix(turned), exact)

    return compute


def _builder(
    rule: str, make: Callable[[rational.RationalVector], rational.RationalMatrix]
) -> Function:
    def compute(v: Value) -> Value:
        _require_size(v, 3, "three numbers")
        return Value(make(v.vector), v.exact)

    return Function((ValueKind.VECTOR,), rule, compute, gathers=True)


def _trace_of(A: rational.RationalMatrix) -> Fraction:
    return sum((A[i][i] for i in range(len(A))), Fraction(0))


def _rank(A: Value) -> Value:
    if not A.exact:
        raise NoAnswerError(
            "rank of a matrix with roots or sines",
            "it is known to 130 bits only, and a rank must be exact",
            "use rational entries",
        )
    return Value(Fraction(rational.rank(A.matrix)))


_M, _V, _S = (ValueKind.MATRIX,), (ValueKind.VECTOR,), (ValueKind.SCALAR,)
_VV = (ValueKind.VECTOR, ValueKind.VECTOR)

FUNCTIONS: dict[str, Function] = {
    "inverse": Function(_M, "the adjugate over the determinant", _of_square(rational.inverse)),
    "transpose": Function(
        _M, "rows become columns", lambda A: Value(rational.transpose(A.matrix), A.exact)
    ),
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
    "rotate_x": Function(_S, "a rotation about x, in degrees", _rotate("X")),
    "rotate_y": Function(_S, "a rotation about y, in degrees", _rotate("Y")),
    "rotate_z": Function(_S, "a rotation about z, in degrees", _rotate("Z")),
    "translate": _builder("a translation", affine.translation_matrix),
    "scale": _builder("a scale", lambda v: rational.affine_matrix(rational.diagonal(v))),
    "shear": _builder(
        "a shear xy, xz, yz", lambda v: rational.affine_matrix(affine.shear_matrix(v))
    ),
}
