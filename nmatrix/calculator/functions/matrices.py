"""Functions of matrices: what undoes one, its determinant and cofactors, its parts, its powers."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import cache

from nmatrix.calculator.arithmetic.numbers import Float64, is_zero
from nmatrix.calculator.arithmetic.operators import power
from nmatrix.calculator.arithmetic.values import LARGEST, Arithmetic, Value, ValueKind
from nmatrix.calculator.functions.function import (
    Function,
    NoAnswerForArgumentError,
    Parameter,
    matrix,
    require_map,
    require_size,
    require_square,
    scalar,
    vector,
    whole,
)
from nmatrix.linear import rational
from nmatrix.linear.rational import ZERO, RationalMatrix, RationalVector

HIGHEST = 9999  # power, as after ^


def _of_square(
    function: Callable[[RationalMatrix], RationalMatrix | Fraction],
) -> Callable[..., Value]:
    def compute(A: Value) -> Value:
        require_square(A)
        return Value(function(A.matrix))

    return compute


def _of_affine(
    function: Callable[[RationalMatrix], RationalMatrix | RationalVector],
) -> Callable[..., Value]:
    def compute(M: Value) -> Value:
        require_square(M)
        require_size(M, 4, "a 4×4 matrix")
        return Value(function(M.matrix))

    return compute


def _identity(n: Value) -> Value:
    return Value(rational.identity(whole(n, LARGEST, "the size", least=1)))


def determinants(rows: Sequence[RationalVector]) -> Callable[[tuple[int, ...]], Fraction]:
    """Make a function of columns: the determinant of the last rows, as many, in those columns.

    It is expanded by its first row, and each smaller one is computed once.
    """

    @cache
    def of(columns: tuple[int, ...]) -> Fraction:
        if len(columns) <= 2:
            return rational.determinant(
                tuple(tuple(row[j] for j in columns) for row in rows[len(rows) - len(columns) :])
            )
        first = rows[len(rows) - len(columns)]
        terms = (
            (-1) ** k * first[j] * of(columns[:k] + columns[k + 1 :])
            for k, j in enumerate(columns)
            if first[j]
        )
        return sum(terms, ZERO)

    return of


def determinant(A: RationalMatrix) -> Fraction:
    """Compute a determinant of any size, by its first row."""
    return determinants(A)(tuple(range(len(A))))


def cofactors(A: RationalMatrix) -> RationalMatrix:
    """Compute the cofactor matrix of any size."""
    n = len(A)
    if n <= 4:
        return rational.cofactor_matrix(A)
    found = []
    for i in range(n):
        of = determinants((*A[:i], *A[i + 1 :]))
        others = [tuple(k for k in range(n) if k != j) for j in range(n)]
        found.append(tuple((-1) ** (i + j) * of(columns) for j, columns in enumerate(others)))
    return tuple(found)


def inverted(A: Value) -> RationalMatrix:
    """Invert a square matrix: the adjugate over the determinant.

    Raises
    ------
    NoAnswerError
        If it is singular.
    """
    require_square(A)
    if rational.is_affine(A.matrix):
        block = inverted(Value(rational.linear_part(A.matrix)))
        offset = rational.apply(block, rational.translation(A.matrix))
        return rational.affine_matrix(block, tuple(-entry for entry in offset))
    over = determinant(A.matrix)
    if is_zero(over):
        raise NoAnswerForArgumentError(
            A,
            "a singular matrix (determinant 0)",
            "it flattens space, so nothing undoes it",
            "ask for the cofactor matrix, which always exists",
        )
    return rational.scaled(rational.transpose(cofactors(A.matrix)), 1 / over)


def _power(base: Value, exponent: Value) -> Value:
    is_float = any(isinstance(x, Float64) for x in base.numbers)
    arithmetic = Arithmetic.FLOAT if is_float else Arithmetic.EXACT
    k = whole(exponent, HIGHEST, "the exponent")
    if base.kind is ValueKind.MATRIX and k < 0:
        base = Value(inverted(base))
    return power(base, k, arithmetic)


def block_of(M: Value) -> Value:
    """Take the 3×3 block of a 4×4 matrix, or the 3×3 matrix that it is."""
    require_map(M)
    return Value(rational.linear_part(M.matrix))


def _normal_matrix(M: Value) -> Value:
    block = block_of(M)
    if is_zero(determinant(block.matrix)):
        why = "its determinant is 0, so it has no inverse transpose"
        step = "use the cofactor matrix, which exists for every matrix"
        raise NoAnswerForArgumentError(M, "a singular 3×3 block", why, step)
    return Value(rational.transpose(inverted(block)))


def _transform_plane(M: Value, plane: Value) -> Value:
    require_size(M, 4, "a 4×4 matrix")
    require_square(M)
    require_size(plane, 4, "a plane a, b, c, d of a x + b y + c z + d = 0")
    if all(map(is_zero, plane.vector[:3])):
        why = "its a, b, c are 0: no direction stands on it"
        raise NoAnswerForArgumentError(plane, "no plane", why, "give it a normal a, b, c")
    return Value(rational.apply(rational.transpose(inverted(M)), plane.vector))


def _trace_of(A: RationalMatrix) -> Fraction:
    return sum((A[i][i] for i in range(1, len(A))), A[0][0])


FUNCTIONS: dict[str, Function] = {
    "inverse": Function(
        (matrix(),),
        "the matrix that undoes A",
        "the adjugate over the determinant",
        "A⁻¹ = adj(A) / det(A)",
        "inverse([2 1; 1 1])",
        "[1 -1; -1 2]",
        lambda A: Value(inverted(A)),
    ),
    "transpose": Function(
        (matrix(),),
        "the matrix with its rows as columns",
        "rows become columns",
        "(Aᵀ)ᵢⱼ = Aⱼᵢ",
        "transpose([1 2; 3 4])",
        "[1 3; 2 4]",
        lambda A: Value(rational.transpose(A.matrix)),
    ),
    "inverse_transpose": Function(
        (matrix(),),
        "the matrix that carries normals where A carries points",
        "the cofactors over the determinant",
        "A⁻ᵀ = C / det(A)",
        "inverse_transpose([1 0 0; 0 2 0; 0 0 1])",
        "[1 0 0; 0 1/2 0; 0 0 1]",
        lambda A: Value(rational.transpose(inverted(A))),
    ),
    "cofactor": Function(
        (matrix(),),
        "the matrix of cofactors, which carries normals of singular A too",
        "each entry is a signed determinant of what is left",
        "Cᵢⱼ = (−1)ⁱ⁺ʲ det(A without row i and column j)",
        "cofactor([1 0 0; 0 2 0; 0 0 1])",
        "[2 0 0; 0 1 0; 0 0 2]",
        _of_square(cofactors),
    ),
    "adjugate": Function(
        (matrix(),),
        "the cofactors, transposed",
        "the cofactors, transposed",
        "adj(A) = Cᵀ = det(A) A⁻¹",
        "adjugate([2 1; 1 1])",
        "[1 -1; -1 2]",
        _of_square(lambda A: rational.transpose(cofactors(A))),
    ),
    "det": Function(
        (matrix(),),
        "the determinant: the factor by which A changes areas or volumes, with its sign",
        "a row times its cofactors",
        "det(A) = A₁₁C₁₁ + A₁₂C₁₂ + …",
        "det([2 1; 1 3])",
        "5",
        _of_square(determinant),
    ),
    "trace": Function(
        (matrix(),),
        "the sum of the diagonal",
        "the sum of the diagonal",
        "tr(A) = A₁₁ + A₂₂ + …",
        "trace([2 1; 1 3])",
        "5",
        _of_square(_trace_of),
    ),
    "linear": Function(
        (matrix("M"),),
        "the 3×3 block of a 4×4 matrix, which turns, scales and shears",
        "the 3×3 block",
        "A of M = [A t; 0 1]",
        "linear(translate(1, 2, 3))",
        "identity(3)",
        _of_affine(rational.linear_part),
    ),
    "translation": Function(
        (matrix("M"),),
        "the translation of a 4×4 matrix",
        "the last column",
        "t of M = [A t; 0 1]",
        "translation(translate(1, 2, 3))",
        "[1, 2, 3]",
        _of_affine(rational.translation),
    ),
    "identity": Function(
        (scalar("n"),),
        "the matrix that changes nothing",
        "ones on the diagonal",
        "I v = v",
        "identity(3)",
        "[1 0 0; 0 1 0; 0 0 1]",
        _identity,
    ),
    "power": Function(
        (Parameter("A", (ValueKind.MATRIX, ValueKind.SCALAR)), scalar("k")),
        "a square matrix, or a number, multiplied so many times with itself; below 0 its inverse",
        "multiplied by itself",
        "Aᵏ = A A … A",
        "power([1 1; 0 1], 5)",
        "[1 5; 0 1]",
        _power,
    ),
    "normal_matrix": Function(
        (matrix("M"),),
        "the 3×3 matrix that carries normals where M carries points",
        "the inverse transpose of the 3×3 block",
        "N = A⁻ᵀ, where M = [A t; 0 1]",
        "normal_matrix(scale(1, 2, 1))",
        "[1 0 0; 0 1/2 0; 0 0 1]",
        _normal_matrix,
    ),
    "transform_plane": Function(
        (matrix("M"), vector("plane")),
        "the plane a x + b y + c z + d = 0, as a, b, c, d, where M has moved it",
        "a plane is a covector: it moves by the inverse transpose",
        "π′ = M⁻ᵀ π, so that π′ · (M p) = π · p",
        "transform_plane(translate(0, 5, 0), [0, 1, 0, -2])",
        "[0, 1, 0, -7]",
        _transform_plane,
    ),
}
