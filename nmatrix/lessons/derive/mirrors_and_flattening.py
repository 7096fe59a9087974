"""The lessons on sides: what a mirror turns around, and what a flattening leaves without one."""

from __future__ import annotations

from typing import TYPE_CHECKING

from nmatrix.lessons.derive.steps import equal, step
from nmatrix.lessons.derive.symbols import cofactors, determinant
from nmatrix.lessons.notation import formula
from nmatrix.report import Step

if TYPE_CHECKING:
    import sympy as sp


def mirror() -> tuple[list[Step], str]:
    """Show what a mirror does to cofactors, normals and winding."""
    import sympy as sp

    A_ = sp.diag(-1, 1, 1)
    K = cofactors(A_)
    steps = [
        step(
            formula("A = ", A_, ",  det A = −1"),
            "a mirror in the plane x = 0",
            proved=equal(determinant(A_), sp.Integer(-1)),
        ),
        step(
            formula("A⁻ᵀ = ", A_, " = A"),
            "AᵀA = I, so the inverse transpose is A itself",
            proved=equal(A_.T * A_, sp.eye(3)),
        ),
        step(
            formula("C = ", K, " = −A⁻ᵀ"),
            "the cofactors carry the determinant's sign",
            proved=equal(K, -A_),
        ),
        *_on_one_normal(A_, K),
    ]
    return steps, (
        "Outward normals: sign(det A) · C n, which points where A⁻ᵀ n does. Flip the winding of "
        "the triangles, not the normals."
    )


def _on_one_normal(A_: sp.Matrix, K: sp.Matrix) -> list[Step]:
    """Carry the outward normal of a triangle, and the triangle itself."""
    import sympy as sp

    n, u, v = (sp.eye(3).col(i) for i in range(3))
    return [
        step(
            formula("C n = ", K * n, " ≠ ", A_ * n),
            "for n = (1, 0, 0), outward on the right, C n still points right: inwards now",
            proved=equal(K * n, n) and not equal(K * n, A_ * n),
        ),
        step(
            formula("(A u) × (A v) = C (u × v) = ", K * u.cross(v)),
            "the edges u = (0, 1, 0) and v = (0, 0, 1) of a triangle span n; their product moves "
            "by C: seen from outside the winding has flipped",
            proved=equal((A_ * u).cross(A_ * v), K * u.cross(v)),
        ),
        step(
            formula("sign(det A) · C n = ", -K * n),
            "with the sign the outward normal stays outward",
            proved=equal(-K * n, A_ * n),
        ),
    ]


def singular() -> tuple[list[Step], str]:
    """Show what is left of normals when space is flattened."""
    import sympy as sp

    A_ = sp.diag(1, 0, 1)
    K = cofactors(A_)
    n = sp.Matrix([sp.Rational(3, 5), sp.Rational(4, 5), 0])
    edge = sp.Matrix([1, 0, 0])
    steps = [
        step(
            formula("A = ", A_, ",  det A = 0"),
            "y is lost: nothing undoes that, there is no inverse",
            proved=equal(determinant(A_), sp.Integer(0)),
        ),
        step(
            formula("C = ", K),
            "the cofactors exist all the same",
            proved=equal(A_.T * K, sp.zeros(3, 3)),
        ),
        step(
            formula("C", n, " = ", K * n),
            "every normal that leaned to y becomes the plane's own normal, ±y: two-sided",
            proved=equal(K * n, sp.Matrix([0, sp.Rational(4, 5), 0])),
        ),
        step(
            formula("C", edge, " = ", K * edge),
            "a normal in the plane belongs to a patch that has become a line: undefined",
            proved=equal(K * edge, sp.zeros(3, 1)),
        ),
    ]
    return steps, "Rank 2 leaves the plane's normal without a side; rank 1 leaves none at all."
