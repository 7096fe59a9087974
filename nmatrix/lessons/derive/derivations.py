"""The lessons on the rule itself, step by step, each step built as one writes it on a board.

The rule is proved with the very functions that compute matrices, on polynomials in their
entries: what holds for these holds for every matrix.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from nmatrix.lessons.derive.notation import (
    A_INVERSE_T,
    A_T,
    EQUALS,
    IDENTITY,
    IMPLIES,
    NOT_EQUAL,
    C,
    N,
    formula,
    words,
)
from nmatrix.lessons.derive.steps import equal, step
from nmatrix.lessons.derive.symbols import (
    cofactors,
    determinant,
    generic_matrix,
    generic_vector,
    polynomials,
)
from nmatrix.lessons.derive.worst_angle import nothing_is_worse
from nmatrix.linear import rational
from nmatrix.report import Step

T_N = words("tᵀ n", r"t^{\mathsf T} n")


def rule() -> tuple[list[Step], str]:
    """Derive N = A⁻ᵀ from the one thing that a normal is: perpendicular to every tangent."""
    return [*_demand(), *_solution(), _worst_angle(), *nothing_is_worse()], (
        "Normals move by the inverse transpose of the 3×3 block: n′ = sign(det A) · C n, at "
        "length one; where det A = 0 it is C n, with either sign. A itself does only where "
        "AᵀA = s² I."
    )


def _demand() -> list[Step]:
    """Say what a normal is, how tangents move, and what that asks of N."""
    M, free, t, n, p, d = polynomials()
    moved_t, moved_n = rational.apply(M, t), rational.apply(free, n)
    far_end, near_end = rational.apply(M, _plus(p, t)), rational.apply(M, p)
    return [
        step(
            formula(words("t · n"), EQUALS, T_N, EQUALS, words("0")),
            "a normal is what is perpendicular to every tangent t of the surface",
            proved=rational.dot(t, n) == rational.product((t,), rational.transpose((n,)))[0][0],
        ),
        step(
            formula(
                words("t′", "t'"),
                EQUALS,
                words("A (p + t) + d − (A p + d)"),
                EQUALS,
                words("A t"),
            ),
            "a tangent is a difference of two points, so A moves it and the translation d cancels",
            proved=_minus(_plus(far_end, d), _plus(near_end, d)) == moved_t,
        ),
        step(
            formula(
                words("(A t)ᵀ (N n)", r"(A t)^{\mathsf T} (N n)"),
                EQUALS,
                words("tᵀ (Aᵀ N) n", r"t^{\mathsf T} (A^{\mathsf T} N)\, n"),
            ),
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
            formula(A_T, words(" N"), EQUALS, IDENTITY, IMPLIES, N, EQUALS, A_INVERSE_T),
            "that holds for all t and n with t · n = 0 if AᵀN is the identity",
            proved=rational.product(rational.transpose(M), K) == _times_identity(det),
        ),
        step(
            formula(A_INVERSE_T, EQUALS, words("C / det A", r"\frac{C}{\det A}")),
            "C, the cofactors, solves Aᵀ C = (det A) I without any division",
            proved=rational.product(rational.transpose(K), M) == _times_identity(det),
        ),
        step(
            formula(
                words("(C n) · (A t)", r"(C n) \cdot (A t)"),
                EQUALS,
                words("(det A) (n · t)", r"(\det A)\,(n \cdot t)"),
            ),
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
        formula(
            words("tan θ", r"\tan\theta"),
            EQUALS,
            words("|A n × N n| / (A n · N n)", r"\frac{|A n \times N n|}{A n \cdot N n}"),
            EQUALS,
            words("(κ − 1/κ) / 2", r"\frac{\kappa - 1/\kappa}{2}"),
        ),
        "with A itself a normal halfway between the directions stretched by κ and by 1 is off by θ",
        proved=equal(2 * bent.cross(right)[2], (k - 1 / k) * bent.dot(right)),
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
            formula(A_T, C, EQUALS, words("(det A) ", r"(\det A)\,"), IDENTITY),
            "each column of A times its own cofactors is det A, times another column's it is 0",
            proved=equal(M.T * K, det * sp.eye(3)),
        ),
        step(
            formula(
                words("(A u) × (A v)", r"(A u) \times (A v)"),
                EQUALS,
                words("C (u × v)", r"C\,(u \times v)"),
            ),
            "the cross product of two moved edges is the cofactors times the old one: C carries "
            "normals that come from the winding of a triangle",
            proved=equal((M * u).cross(M * v), K * u.cross(v)),
        ),
        step(
            formula(C, EQUALS, words("(det A) ", r"(\det A)\,"), A_INVERSE_T),
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
            formula(
                words("M"),
                EQUALS,
                M,
                words(",  M⁻ᵀ = ", r",\; M^{-\mathsf T} = "),
                inverse_transpose,
            ),
            "the translation does not vanish: it moves to the last row",
            proved=equal(M.T * inverse_transpose, sp.eye(4)),
        ),
        step(
            formula(words("M⁻ᵀ (n, w)", r"M^{-\mathsf T} \tbinom{n}{w}"), EQUALS, carried),
            "x, y, z are right for every w; the fourth component is junk: drop it, do not "
            "normalise it",
            proved=equal(carried[:3, :], sp.Matrix([x, y, z])),
        ),
        step(
            formula(words("M (n, 1)", r"M \tbinom{n}{1}"), EQUALS, moved, NOT_EQUAL, words("n")),
            "with M itself and w = 1 the translation bends the normal: w must be 0",
            proved=not equal(moved[:3, :], sp.Matrix([x, y, z])),
        ),
    ]
    return steps, "A translation has no effect on normals, once the 3×3 block (or w = 0) is used."
