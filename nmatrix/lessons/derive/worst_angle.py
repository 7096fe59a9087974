"""The bound on what A itself does to normals, proved link by link.

A has the singular values σ₁ ≥ σ₂ ≥ σ₃ and κ = σ₁/σ₃; θ is the angle between A n and A⁻ᵀ n.
"""

from __future__ import annotations

from nmatrix.lessons.derive.notation import EQUALS, formula, words
from nmatrix.lessons.derive.steps import equal, step
from nmatrix.lessons.derive.symbols import generic_vector, polynomials
from nmatrix.linear import rational
from nmatrix.report import Step


def nothing_is_worse() -> list[Step]:
    """Prove tan θ ≤ (κ − 1/κ)/2 for every normal."""
    return [_product(), _by_lengths(), _between(), _together()]


def _product() -> Step:
    M, _, _, n, _, _ = polynomials()
    K, det = rational.cofactor_matrix(M), rational.determinant(M)
    carried = rational.dot(rational.apply(M, n), rational.apply(K, n))
    return step(
        formula(
            words("(A n) · (A⁻ᵀ n)", r"(A n) \cdot (A^{-\mathsf T} n)"),
            EQUALS,
            words("|n|² = 1", "|n|^2 = 1"),
        ),
        "of a unit normal the two answers have the product 1, whatever A is",
        proved=carried == det * rational.dot(n, n),
    )


def _by_lengths() -> Step:
    a, b = generic_vector("a"), generic_vector("b")
    return step(
        formula(
            words(
                "tan² θ = |A n|² |A⁻ᵀ n|² − 1",
                r"\tan^2\theta = |A n|^2\,|A^{-\mathsf T} n|^2 - 1",
            )
        ),
        "so the angle depends on their lengths alone, by |a × b|² = |a|² |b|² − (a · b)²",
        proved=equal(a.cross(b).dot(a.cross(b)), a.dot(a) * b.dot(b) - a.dot(b) ** 2),
    )


def _between() -> Step:
    import sympy as sp

    first, some, third = sp.symbols("sigma_1 sigma sigma_3", positive=True)
    gap = first**2 + third**2 - some**2 - first**2 * third**2 / some**2
    return step(
        formula(
            words(
                "σ² + (σ₁² σ₃²) / σ² ≤ σ₁² + σ₃²",
                r"\sigma^2 + \frac{\sigma_1^2 \sigma_3^2}{\sigma^2} \le \sigma_1^2 + \sigma_3^2",
            )
        ),
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
        formula(
            words(
                "|A n| |A⁻ᵀ n| ≤ (κ + 1/κ) / 2,  tan θ ≤ (κ − 1/κ) / 2",
                r"|A n|\,|A^{-\mathsf T} n| \le \frac{\kappa + 1/\kappa}{2},\;"
                r" \tan\theta \le \frac{\kappa - 1/\kappa}{2}",
            )
        ),
        "weigh that by n² along each axis of A and add: |A n|² + σ₁² σ₃² |A⁻ᵀ n|² ≤ σ₁² + σ₃², and "
        "the left is at least 2 σ₁ σ₃ |A n| |A⁻ᵀ n|; with κ = σ₁/σ₃ nothing is worse than half "
        "way; κ = 2 gives tan θ = 3/4, the triangle of 3, 4 and 5",
        proved=equal(half_sum**2 - 1, half_difference**2) and is_345,
    )
