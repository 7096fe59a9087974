"""What a step of a proof is made of: the symbols it argues about, and SymPy's verdict on its claim.

A is any 3×3 matrix, n a normal, t, u, v tangents; C the cofactors of A.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from nmatrix.linear import rational
from nmatrix.report import Formula, Step

if TYPE_CHECKING:
    import sympy as sp


def generic_matrix(name: str = "a") -> sp.Matrix:
    """Make a 3×3 matrix of nine symbols."""
    import sympy as sp

    return sp.Matrix(3, 3, lambda i, j: sp.Symbol(f"{name}{i + 1}{j + 1}"))


def generic_vector(name: str) -> sp.Matrix:
    """Make a column of three symbols."""
    import sympy as sp

    return sp.Matrix([sp.Symbol(f"{name}{axis}") for axis in "xyz"])


def cofactors(A: sp.Matrix) -> sp.Matrix:
    """Build the cofactor matrix, by the very function that computes with fractions."""
    import sympy as sp

    return sp.Matrix(rational.cofactor_matrix(_rows(A)))


def determinant(A: sp.Matrix) -> sp.Expr:
    """Compute det A, by the very function that computes with fractions."""
    return rational.determinant(_rows(A))


def _rows(A: sp.Matrix) -> tuple[tuple[Any, ...], ...]:
    return tuple(map(tuple, A.tolist()))


def polynomials() -> list[Any]:
    """Make two matrices and four vectors whose entries are free variables of one ring.

    Polynomials are kept in one canonical form, so an identity holds exactly if both sides are
    equal; no simplification has to find it.
    """
    from sympy import QQ, ring

    _, *entries = ring("a:9,b:9,t:3,n:3,p:3,d:3", QQ)
    matrices = [tuple(tuple(entries[k + 3 * i : k + 3 * i + 3]) for i in range(3)) for k in (0, 9)]
    return [*matrices, *(tuple(entries[k : k + 3]) for k in range(18, 30, 3))]


def equal(left: sp.Basic, right: sp.Basic, unit_circle: Sequence[sp.Symbol] = ()) -> bool:
    """Decide if two expressions or matrices are equal as polynomials and surds.

    `unit_circle` holds a pair c, s with c² + s² = 1; the sine and cosine of one angle are such a
    pair by themselves.
    """
    difference = left - right
    entries: Iterable[sp.Expr] = list(difference) if hasattr(difference, "tolist") else [difference]
    return all(is_zero(entry, unit_circle) for entry in entries)


def is_zero(expression: sp.Expr, unit_circle: Sequence[sp.Symbol] = ()) -> bool:
    """Decide if an expression in surds, sines and cosines is zero: if its numerator is."""
    import sympy as sp

    top = sp.fraction(sp.together(expression))[0]
    return bool(normal_form(top, unit_circle) == 0)


def normal_form(polynomial: sp.Expr, unit_circle: Sequence[sp.Symbol] = ()) -> sp.Expr:
    """Reduce a polynomial in sines and cosines modulo c² + s² = 1 for every angle in it.

    One division with remainder for each angle; a search for a trigonometric simplification does
    not end for the sines and cosines of several angles.
    """
    import sympy as sp

    angles = sorted({atom.args[0] for atom in polynomial.atoms(sp.sin, sp.cos)}, key=str)
    named = {angle: (sp.Dummy(real=True), sp.Dummy(real=True)) for angle in angles}
    there = {
        f(a): x for a, pair in named.items() for f, x in zip((sp.cos, sp.sin), pair, strict=True)
    }
    found = sp.expand(polynomial.xreplace(there))
    for c, s in (*([unit_circle] if unit_circle else []), *named.values()):
        found = sp.expand(sp.rem(found, c**2 + s**2 - 1, c)) if found.has(c) else found
    back = {x: value for value, x in there.items()}
    return (sp.radsimp(found) if found.is_number else found).xreplace(back)


def step(shown: Formula, because: str, *, proved: bool) -> Step:
    """Put a formula, its reason and the verdict of its proof together."""
    return Step(shown, because, bool(proved))
