"""The lessons on the rule itself, step by step, each step built as one writes it on a board.

The rule is proved with the very functions that compute matrices, on polynomials in their
entries: what holds for these holds for every matrix.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from nmatrix.lessons.derive.steps import (
    cofactors,
    determinant,
    equal,
    generic_matrix,
    generic_vector,
    polynomials,
    step,
)
from nmatrix.lessons.notation import formula
from nmatrix.linear import rational
from nmatrix.report import Step


def rule() -> tuple[list[Step], str]:
    """Derive N = A⁻ᵀ from the one thing that a normal is: perpendicular to every tangent."""
    return [*_demand(), *_solution(), _worst_angle(), *worst_angle_bound()], (
        "Normals move by the inverse transpose of the 3×3 block: n′ = sign(det A) · C n, at "
        "length one; where det A = 0 it is C n, with either sign. A itself does only where "
        "AᵀA = s² I."
    )


def _demand() -> list[Step]:
    """Define a normal, move its tangents, and state what that asks of N."""
    M, free, t, n, p, d = polynomials()
    moved_t, moved_n = rational.apply(M, t), rational.apply(free, n)
    far_end, near_end = rational.apply(M, _plus(p, t)), rational.apply(M, p)
    return [
        step(
            formula("t · n = tᵀ n = 0"),
            "a normal is what is perpendicular to every tangent t of the surface",
            proved=rational.dot(t, n) == rational.product((t,), rational.transpose((n,)))[0][0],
        ),
        step(
            formula("t′ = A (p + t) + d − (A p + d) = A t"),
            "a tangent is a difference of two points, so A moves it and the translation d cancels",
            proved=_minus(_plus(far_end, d), _plus(near_end, d)) == moved_t,
        ),
        step(
            formula("(A t)ᵀ (N n) = tᵀ (Aᵀ N) n"),
            "this product must be 0: the new normal N n is to be perpendicular to every new "
            "tangent A t",
            proved=rational.dot(moved_t, moved_n)
            == rational.dot(t, rational.apply(rational.product(rational.transpose(M), free), n)),
        ),
    ]


def _solution() -> list[Step]:
    """Solve AᵀN = 1 by cofactors."""
    M, _, t, n, _, _ = polynomials()
    K, det = rational.cofactor_matrix(M), rational.determinant(M)
    perpendicular = rational.dot(rational.apply(K, n), rational.apply(M, t))
    return [
        step(
            formula("Aᵀ N = I  ⇒  N = A⁻ᵀ"),
            "that holds for all t and n with t · n = 0 if AᵀN is the identity",
            proved=rational.product(rational.transpose(M), K) == _times_identity(det),
        ),
        step(
            formula("A⁻ᵀ = C / det A"),
            "C, the cofactors, solves Aᵀ C = (det A) I without any division",
            proved=rational.product(rational.transpose(K), M) == _times_identity(det),
        ),
        step(
            formula("(C n) · (A t) = (det A) (n · t)"),
            "so C n is perpendicular too; only the sign of det A decides which side is outside",
            proved=perpendicular == det * rational.dot(n, t),
        ),
    ]


def _worst_angle() -> Step:
    """Measure how wrong A itself is, for stretches κ and 1."""
    import sympy as sp

    k = sp.Symbol("kappa", positive=True)
    bent, right = sp.Matrix([k, 1, 0]), sp.Matrix([1 / k, 1, 0])
    return step(
        formula("tan θ = |A n × N n| / (A n · N n) = (κ − 1/κ) / 2"),
        "with A itself a normal halfway between the directions stretched by κ and by 1 is off by θ",
        proved=equal(2 * bent.cross(right)[2], (k - 1 / k) * bent.dot(right)),
    )


def worst_angle_bound() -> list[Step]:
    """Prove tan θ ≤ (κ − 1/κ)/2 for every normal.

    A has the singular values σ₁ ≥ σ₂ ≥ σ₃ and κ = σ₁/σ₃; θ is the angle between A n and A⁻ᵀ n.
    """
    return [_product(), _by_lengths(), _between(), _together()]


def _product() -> Step:
    M, _, _, n, _, _ = polynomials()
    K, det = rational.cofactor_matrix(M), rational.determinant(M)
    carried = rational.dot(rational.apply(M, n), rational.apply(K, n))
    return step(
        formula("(A n) · (A⁻ᵀ n) = |n|² = 1"),
        "of a unit normal the two answers have the product 1, whatever A is",
        proved=carried == det * rational.dot(n, n),
    )


def _by_lengths() -> Step:
    a, b = generic_vector("a"), generic_vector("b")
    return step(
        formula("tan² θ = |A n|² |A⁻ᵀ n|² − 1"),
        "so the angle depends on their lengths alone, by |a × b|² = |a|² |b|² − (a · b)²",
        proved=equal(a.cross(b).dot(a.cross(b)), a.dot(a) * b.dot(b) - a.dot(b) ** 2),
    )


def _between() -> Step:
    import sympy as sp

    first, some, third = sp.symbols("sigma_1 sigma sigma_3", positive=True)
    gap = first**2 + third**2 - some**2 - first**2 * third**2 / some**2
    return step(
        formula("σ² + (σ₁² σ₃²) / σ² ≤ σ₁² + σ₃²"),
        "for every stretch σ from the least, σ₃, to the greatest, σ₁: (σ₁² − σ²)(σ² − σ₃²) is not "
        "negative",
        proved=equal(gap * some**2, (first**2 - some**2) * (some**2 - third**2)),
    )


def _together() -> Step:
    import sympy as sp

    k = sp.Symbol("kappa", positive=True)
    half_sum, half_difference = (k + 1 / k) / 2, (k - 1 / k) / 2
    is_345 = equal(half_difference.subs(k, 2), sp.Rational(3, 4))
    return step(
        formula("|A n| |A⁻ᵀ n| ≤ (κ + 1/κ) / 2,  tan θ ≤ (κ − 1/κ) / 2"),
        "weigh that by n² along each axis of A and add: |A n|² + σ₁² σ₃² |A⁻ᵀ n|² ≤ σ₁² + σ₃², and "
        "the left is at least 2 σ₁ σ₃ |A n| |A⁻ᵀ n|; with κ = σ₁/σ₃ nothing is worse than half "
        "way; κ = 2 gives tan θ = 3/4, the triangle of 3, 4 and 5",
        proved=equal(half_sum**2 - 1, half_difference**2) and is_345,
    )


def _plus(a: Sequence[Any], b: Sequence[Any]) -> tuple[Any, ...]:
    return tuple(x + y for x, y in zip(a, b, strict=True))


def _minus(a: Sequence[Any], b: Sequence[Any]) -> tuple[Any, ...]:
    return tuple(x - y for x, y in zip(a, b, strict=True))


def _times_identity(factor: Any) -> tuple[tuple[Any, ...], ...]:  # noqa: ANN401 - a polynomial
    return tuple(tuple(factor * int(i == j) for j in range(3)) for i in range(3))


def cofactor() -> tuple[list[Step], str]:
    """Show what the cofactor matrix is, and the sign by which it differs."""
    M, u, v = generic_matrix(), generic_vector("u"), generic_vector("v")
    K, det = cofactors(M), determinant(M)
    import sympy as sp

    steps = [
        step(
            formula("AᵀC = (det A) I"),
            "each column of A times its own cofactors is det A, times another column's it is 0",
            proved=equal(M.T * K, det * sp.eye(3)),
        ),
        step(
            formula("(A u) × (A v) = C (u × v)"),
            "the cross product of two moved edges is the cofactors times the old one: C carries "
            "normals that come from the winding of a triangle",
            proved=equal((M * u).cross(M * v), K * u.cross(v)),
        ),
        step(
            formula("C = (det A) A⁻ᵀ"),
            "it is the inverse transpose times a number, which is negative for a mirror",
            proved=equal(K.T * M, det * sp.eye(3)),
        ),
    ]
    return steps, (
        "C exists for every matrix. For outward normals multiply by sign(det A); C alone turns "
        "them inside out in a mirror."
    )


def translation() -> tuple[list[Step], str]:
    """Show where a translation hides in the 4×4 inverse transpose."""
    import sympy as sp

    x, y, z, w = sp.symbols("n_x n_y n_z w")
    M = sp.eye(4)
    M[0, 3] = 5
    inverse_transpose = sp.eye(4)
    inverse_transpose[3, 0] = -5
    carried = inverse_transpose * sp.Matrix([x, y, z, w])
    moved = M * sp.Matrix([x, y, z, 1])
    steps = [
        step(
            formula("M = ", M, ",  M⁻ᵀ = ", inverse_transpose),
            "the translation does not vanish: it moves to the last row",
            proved=equal(M.T * inverse_transpose, sp.eye(4)),
        ),
        step(
            formula("M⁻ᵀ (n, w) = ", carried),
            "x, y, z are right for every w; the fourth component is junk: drop it, do not "
            "normalise it",
            proved=equal(carried[:3, :], sp.Matrix([x, y, z])),
        ),
        step(
            formula("M (n, 1) = ", moved, " ≠ n"),
            "with M itself and w = 1 the translation bends the normal: w must be 0",
            proved=not equal(moved[:3, :], sp.Matrix([x, y, z])),
        ),
    ]
    return steps, "A translation has no effect on normals, once the 3×3 block (or w = 0) is used."
