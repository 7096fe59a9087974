"""Functions of matrices: what undoes one, its determinant and cofactors, its rank, its parts."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from nmatrix.calculator.functions.function import (
    Function,
    matrix,
    require_size,
    require_square,
    scalar,
)
from nmatrix.calculator.numbers import is_zero, size
from nmatrix.calculator.values import LARGEST, Value
from nmatrix.errors import IllegalValueError
from nmatrix.linear import rational
from nmatrix.linear.rational import RationalMatrix, RationalVector


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
        require_size(M, 4, "a 4×4 matrix")
        return Value(function(M.matrix))

    return compute


def _identity(n: Value) -> Value:
    sizes = {Fraction(n): n for n in range(2, LARGEST + 1)}
    if n.scalar not in sizes:
        raise IllegalValueError("its size", f"it is 2 to {LARGEST}", "write identity(4)")
    return Value(rational.identity(sizes[n.scalar]))


def _trace_of(A: RationalMatrix) -> Fraction:
    return sum((A[i][i] for i in range(1, len(A))), A[0][0])


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


FUNCTIONS: dict[str, Function] = {
    "inverse": Function(
        (matrix(),),
        "the matrix that undoes A",
        "the adjugate over the determinant",
        "A⁻¹ = adj(A) / det(A)",
        "inverse([2 1; 1 1])",
        _of_square(rational.inverse),
    ),
    "transpose": Function(
        (matrix(),),
        "the matrix with its rows as columns",
        "rows become columns",
        "(Aᵀ)ᵢⱼ = Aⱼᵢ",
        "transpose([1 2; 3 4])",
        lambda A: Value(rational.transpose(A.matrix)),
    ),
    "inverse_transpose": Function(
        (matrix(),),
        "the matrix that carries normals where A carries points",
        "the cofactors over the determinant",
        "A⁻ᵀ = C / det(A)",
        "inverse_transpose([1 0 0; 0 2 0; 0 0 1])",
        _of_square(rational.inverse_transpose),
    ),
    "cofactor": Function(
        (matrix(),),
        "the matrix of cofactors, which carries normals of singular A too",
        "each entry is a signed determinant of what is left",
        "Cᵢⱼ = (−1)ⁱ⁺ʲ det(A without row i and column j)",
        "cofactor([1 0 0; 0 2 0; 0 0 1])",
        _of_square(rational.cofactor_matrix),
    ),
    "adjugate": Function(
        (matrix(),),
        "the cofactors, transposed",
        "the cofactors, transposed",
        "adj(A) = Cᵀ = det(A) A⁻¹",
        "adjugate([2 1; 1 1])",
        _of_square(rational.adjugate),
    ),
    "det": Function(
        (matrix(),),
        "the determinant: the factor by which A changes areas or volumes, with its sign",
        "a row times its cofactors",
        "det(A) = A₁₁C₁₁ + A₁₂C₁₂ + …",
        "det([2 1; 1 3])",
        _of_square(rational.determinant),
    ),
    "rank": Function(
        (matrix(),),
        "the number of independent rows",
        "rows left after elimination",
        "rank(A) = number of pivots",
        "rank([1 2; 2 4])",
        _rank,
    ),
    "trace": Function(
        (matrix(),),
        "the sum of the diagonal",
        "the sum of the diagonal",
        "tr(A) = A₁₁ + A₂₂ + …",
        "trace([2 1; 1 3])",
        _of_square(_trace_of),
    ),
    "linear": Function(
        (matrix("M"),),
        "the 3×3 block of a 4×4 matrix, which turns, scales and shears",
        "the 3×3 block",
        "A of M = [A t; 0 1]",
        "linear(translate(1, 2, 3))",
        _of_affine(rational.linear_part),
    ),
    "translation": Function(
        (matrix("M"),),
        "the translation of a 4×4 matrix",
        "the last column",
        "t of M = [A t; 0 1]",
        "translation(translate(1, 2, 3))",
        _of_affine(rational.translation),
    ),
    "identity": Function(
        (scalar("n"),),
        "the matrix that changes nothing",
        "ones on the diagonal",
        "I v = v",
        "identity(3)",
        _identity,
    ),
}
