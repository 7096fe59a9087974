"""The lessons on light and eye: how a direction moves, where the eye is, what a space measures.

A is the 3×3 block of the world matrix, l the vector towards a light, n a normal, e the eye, t the
translation; B the 3×3 block of `space_from_world`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from nmatrix.lessons.derive.notation import EQUALS, IDENTITY, IMPLIES, NOT_EQUAL, A, formula, words
from nmatrix.lessons.derive.steps import equal, step
from nmatrix.lessons.derive.symbols import (
    cofactors,
    determinant,
    generic_matrix,
    generic_vector,
    polynomials,
)
from nmatrix.linear.rational import adjugate, apply, cofactor_matrix, dot, product, transpose
from nmatrix.report import Step

if TYPE_CHECKING:
    import sympy as sp


def lightdirection() -> tuple[list[Step], str]:
    """Show by which rule a light direction reaches object space, and what the others shade."""
    return [*_the_rule(), *_in_numbers(), *_in_camera_space()], (
        "A light direction is a vector: into object space it moves by A⁻¹, and Lambert's cosine "
        "is n · l over the length of A⁻ᵀ n. The course's Mᵀ l is the rule for normals; it is right "
        "for rotations and mirrors, and up to length for a uniform scale."
    )


def _the_rule() -> list[Step]:
    M, _, light, n, _, _ = polynomials()
    world, moved = apply(cofactor_matrix(M), n), apply(adjugate(M), light)  # both times det A
    measured = apply(adjugate(product(transpose(M), M)), n)  # (AᵀA)⁻¹ n, times det A twice
    return [
        step(
            formula(
                words("(A⁻ᵀ n) · l", r"(A^{-\mathsf T} n) \cdot l"),
                EQUALS,
                words("n · (A⁻¹ l)", r"n \cdot (A^{-1} l)"),
            ),
            "the product of a normal and a direction is the same in both spaces, if the normal "
            "moves by the inverse transpose and the direction by the inverse",
            proved=dot(world, light) == dot(n, moved),
        ),
        step(
            formula(
                words("cos θ", r"\cos\theta"),
                EQUALS,
                words(
                    "(n · (A⁻¹ l)) / (|A⁻ᵀ n| |l|)",
                    r"\frac{n \cdot (A^{-1} l)}{|A^{-\mathsf T} n|\,|l|}",
                ),
            ),
            "so the exact cosine needs one more length, that of A⁻ᵀ n, whose square is "
            "nᵀ (AᵀA)⁻¹ n: the metric",
            proved=dot(world, world) == dot(n, measured),
        ),
    ]


def _in_numbers() -> list[Step]:
    """Compare the three rules on one normal and one light."""
    import sympy as sp

    quarter = sp.diag(1, sp.Rational(1, 4), 1)
    n, light = sp.Matrix([1, 1, 0]) / sp.sqrt(2), sp.Matrix([3, 9, 2]) / 10
    world = quarter.inv().T * n
    exact = world.dot(light) / (world.norm() * light.norm())
    by_transpose = _cosine(n, quarter.T * light)
    by_inverse = _cosine(n, quarter.inv() * light)
    return [
        step(
            formula(A, EQUALS, quarter, words(",  n = "), n, words(",  l = "), light),
            "a flattened object, a normal half way up, and l, which points to a light above",
            proved=n.dot(n) == 1,
        ),
        _shade("exact: over both lengths", exact, 39, 1598),
        _shade("by Aᵀ l, the course's rule: another shade, and darkness where A n turns away",
               by_transpose, 39, 2618, other=exact, swap=(21, 17)),
        _shade("by A⁻¹ l, normalised: dark where it should be, and yet another shade",
               by_inverse, 39, 2618, other=exact),
    ]  # fmt: skip


def _shade(
    because: str,
    cosine: sp.Expr,
    top: int,
    under: int,
    *,
    other: sp.Expr | None = None,
    swap: tuple[int, int] | None = None,
) -> Step:
    """Return a step with a cosine in closed form."""
    import sympy as sp

    closed = sp.Rational(*swap) / sp.sqrt(2) if swap else sp.Integer(top) / sp.sqrt(under)
    text = f"{swap[0]} / ({swap[1]} √2)" if swap else f"{top} / √{under}"
    latex = (
        rf"\frac{{{swap[0]}}}{{{swap[1]}\sqrt 2}}"
        if swap
        else rf"\frac{{{top}}}{{\sqrt{{{under}}}}}"
    )
    about = words(f" = {sp.N(closed, 4)}")
    is_other = other is None or not equal(cosine**2, other**2)
    return step(
        formula(words("cos θ", r"\cos\theta"), EQUALS, words(text, latex), about),
        because,
        proved=equal(cosine**2, closed**2) and cosine.is_positive is True and is_other,
    )


def _cosine(a: sp.Matrix, b: sp.Matrix) -> sp.Expr:
    return a.dot(b) / (a.norm() * b.norm())


def _in_camera_space() -> list[Step]:
    import sympy as sp

    c, s = sp.symbols("c s", real=True)
    R = sp.Matrix([[c, 0, s], [0, 1, 0], [-s, 0, c]])
    mirrored, scaled = sp.diag(-1, 1, 1) * R, 2 * R
    return [
        step(
            formula(
                words("Vᵀ V", r"V^{\mathsf T} V"),
                EQUALS,
                IDENTITY,
                IMPLIES,
                words("V⁻ᵀ = V", r"V^{-\mathsf T} = V"),
            ),
            "a view that turns and mirrors is its own inverse transpose: there both rules agree",
            proved=all(equal(one.T * one, sp.eye(3), (c, s)) for one in (R, mirrored)),
        ),
        step(
            formula(
                words("V = 2 R", "V = 2 R"),
                IMPLIES,
                words("V⁻ᵀ l ≠ V l", r"V^{-\mathsf T} l \neq V l"),
            ),
            "a view that scales is not: a direction still moves by V, and only a normal by V⁻ᵀ",
            proved=not equal(scaled.T * scaled, sp.eye(3), (c, s)),
        ),
    ]


def eye() -> tuple[list[Step], str]:
    """Show where the eye is in object space, and why subtracting comes first."""
    M, e, t = generic_matrix(), generic_vector("e"), generic_vector("t")
    K, det = cofactors(M), determinant(M)
    x = K.T * (e - t) / det
    course = _by_product(M, e, t)
    far = 1e16
    steps = [
        step(
            formula(words("A x + t = e"), words(",  "), words("A x = e − t")),
            "the eye x of object space is the point that the world matrix takes to the eye e",
            proved=equal(M * x + t, e),
        ),
        step(
            formula(
                words("(V M)⁻¹ (0, 0, 0, 1)", r"(V M)^{-1} (0, 0, 0, 1)"),
                EQUALS,
                words("A⁻¹ (e − t)", r"A^{-1} (e - t)"),
            ),
            "the course's formula is the same point: the eye is the origin of camera space",
            proved=equal(course, x),
        ),
        step(
            formula(words("fl(10¹⁶ + 3) − 10¹⁶ = 4", r"\mathrm{fl}(10^{16} + 3) - 10^{16} = 4")),
            "in float64 it is not (fl rounds): V·M adds and cancels numbers of the size of t, so "
            "its last digits are lost before the inverse looks; e − t, subtracted first, is "
            "rounded once",
            proved=(far + 3) - far == 4,
        ),
    ]
    return steps, (
        "Subtract first, then solve A x = e − t. nmatrix eye object shows both, and how many "
        "digits the product costs."
    )


def _by_product(A_: sp.Matrix, e: sp.Matrix, t: sp.Matrix) -> sp.Matrix:
    """Return (V M)⁻¹ (0, 0, 0, 1) for a view that only moves: V = T(−e)."""
    K, det = cofactors(A_), determinant(A_)
    moved = t - e  # the last column of V·M
    return -K.T * moved / det


def metric() -> tuple[list[Step], str]:
    """Show how lengths and angles are measured in a space that is not rigid."""
    return [*_measured(), *_read_off()], (
        "Apply the metric by its factors, |v| = |B⁻¹ v| and |n| = |Bᵀ n|: then every space shades "
        "alike. In object space B⁻¹ is A, so AᵀA measures vectors. Formed, it would square κ."
    )


def _measured() -> list[Step]:
    """Show what measures vectors, and what measures normals."""
    B = generic_matrix("b")
    u, v, n = (generic_vector(name) for name in "uvn")
    K, det = cofactors(B), determinant(B)
    return [
        step(
            formula(
                words("u · v", r"u \cdot v"),
                EQUALS,
                words("(B u)ᵀ (B⁻ᵀ B⁻¹) (B v)", r"(B u)^{\mathsf T} (B^{-\mathsf T} B^{-1}) (B v)"),
            ),
            "vectors that were moved by B keep their products if B⁻ᵀ B⁻¹ measures them",
            proved=equal((K.T * (B * u)).dot(K.T * (B * v)), det**2 * u.dot(v)),
        ),
        step(
            formula(words("|n|² = |Bᵀ (B⁻ᵀ n)|²", r"|n|^2 = |B^{\mathsf T} (B^{-\mathsf T} n)|^2")),
            "normals moved by B⁻ᵀ keep theirs if B Bᵀ does: apply Bᵀ and take the length",
            proved=equal((B.T * (K * n)).dot(B.T * (K * n)), det**2 * n.dot(n)),
        ),
    ]


def _read_off() -> list[Step]:
    """Show in numbers what coordinates alone say."""
    import sympy as sp

    half = sp.diag(1, 2, 1)
    a, b = sp.Matrix([1, -1, 0]), sp.Matrix([1, 1, 0])
    moved_a, moved_b = half * a, half * b
    return [
        step(
            formula(words("B = "), half, words(",  a = "), a, words(",  b = "), b),
            "take a stretch by two, and two vectors that are perpendicular",
            proved=a.dot(b) == 0,
        ),
        step(
            formula(words("(B a) · (B b) = −3"), NOT_EQUAL, words("a · b = 0")),
            "read off the coordinates of the space they are not",
            proved=moved_a.dot(moved_b) == -3,
        ),
        step(
            formula(words("|B b|² = 5", "|B b|^2 = 5"), NOT_EQUAL, words("|b|² = 2", "|b|^2 = 2")),
            "lengths change too: a cosine made of them is wrong without the metric",
            proved=moved_b.dot(moved_b) == 5 and b.dot(b) == 2,
        ),
    ]
