"""The generic matrices and vectors that the lessons argue about.

A is any 3×3 matrix, n a normal, t, u, v tangents; C the cofactors of A.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from nmatrix.linear import rational

if TYPE_CHECKING:
    import sympy as sp


def generic_matrix(name: str = "a") -> sp.Matrix:
    """Return a 3×3 matrix of nine symbols."""
    import sympy as sp

    return sp.Matrix(3, 3, lambda i, j: sp.Symbol(f"{name}{i + 1}{j + 1}"))


def generic_vector(name: str) -> sp.Matrix:
    """Return a column of three symbols."""
    import sympy as sp

    return sp.Matrix([sp.Symbol(f"{name}{axis}") for axis in "xyz"])


def cofactors(A: sp.Matrix) -> sp.Matrix:
    """Return the cofactor matrix, by the very function that computes with fractions."""
    import sympy as sp

    return sp.Matrix(rational.cofactor_matrix(_rows(A)))


def determinant(A: sp.Matrix) -> sp.Expr:
    """Return det A, by the very function that computes with fractions."""
    return rational.determinant(_rows(A))


def _rows(A: sp.Matrix) -> tuple[tuple[Any, ...], ...]:
    return tuple(map(tuple, A.tolist()))


def polynomials() -> list[Any]:
    """Return two matrices and four vectors whose entries are free variables of one ring.

    Polynomials are kept in one canonical form, so an identity holds exactly if both sides are
    equal; no simplification has to find it.
    """
    from sympy import QQ, ring

    _, *entries = ring("a:9,b:9,t:3,n:3,p:3,d:3", QQ)
    matrices = [tuple(tuple(entries[k + 3 * i : k + 3 * i + 3]) for i in range(3)) for k in (0, 9)]
    return [*matrices, *(tuple(entries[k : k + 3]) for k in range(18, 30, 3))]
