"""The lessons on light and eye: how they move, what a space measures, what light is reflected.

A is the 3×3 block of the world matrix, l the vector towards a light, n a normal, e the eye, t the
translation; B the 3×3 block of `space_from_world`; r is l mirrored by n, h the half vector, v the
vector to the eye, p a position in camera space.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from nmatrix.lessons.derive.steps import (
    cofactors,
    determinant,
    equal,
    generic_matrix,
    generic_vector,
    polynomials,
    step,
)
from nmatrix.lessons.notation import formula, written
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
            formula("(A⁻ᵀ n) · l = n · (A⁻¹ l)"),
            "the product of a normal and a direction is the same in both spaces, if the normal "
            "moves by the inverse transpose and the direction by the inverse",
            proved=dot(world, light) == dot(n, moved),
        ),
        step(
            formula("cos θ = (n · (A⁻¹ l)) / (|A⁻ᵀ n| |l|)"),
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
            formula("A = ", quarter, ",  n = ", n, ",  l = ", light),
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
    """Put a cosine into closed form."""
    import sympy as sp

    closed = sp.Rational(*swap) / sp.sqrt(2) if swap else sp.Integer(top) / sp.sqrt(under)
    text = f"{swap[0]} / ({swap[1]} √2)" if swap else f"{top} / √{under}"
    is_other = other is None or not equal(cosine**2, other**2)
    return step(
        formula(f"cos θ = {text} = {sp.N(closed, 4)}"),
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
            formula("Vᵀ V = I  ⇒  V⁻ᵀ = V"),
            "a view that turns and mirrors is its own inverse transpose: there both rules agree",
            proved=all(equal(one.T * one, sp.eye(3), (c, s)) for one in (R, mirrored)),
        ),
        step(
            formula("V = 2 R  ⇒  V⁻ᵀ l ≠ V l"),
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
            formula("A x + t = e,  A x = e − t"),
            "the eye x of object space is the point that the world matrix takes to the eye e",
            proved=equal(M * x + t, e),
        ),
        step(
            formula("(V M)⁻¹ (0, 0, 0, 1) = A⁻¹ (e − t)"),
            "the course's formula is the same point: the eye is the origin of camera space",
            proved=equal(course, x),
        ),
        step(
            formula("fl(10¹⁶ + 3) − 10¹⁶ = 4"),
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
    """Compute (V M)⁻¹ (0, 0, 0, 1) for a view that only moves: V = T(−e)."""
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
            formula("u · v = (B u)ᵀ (B⁻ᵀ B⁻¹) (B v)"),
            "vectors that were moved by B keep their products if B⁻ᵀ B⁻¹ measures them",
            proved=equal((K.T * (B * u)).dot(K.T * (B * v)), det**2 * u.dot(v)),
        ),
        step(
            formula("|n|² = |Bᵀ (B⁻ᵀ n)|²"),
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
            formula("B = ", half, ",  a = ", a, ",  b = ", b),
            "take a stretch by two, and two vectors that are perpendicular",
            proved=a.dot(b) == 0,
        ),
        step(
            formula("(B a) · (B b) = −3 ≠ a · b = 0"),
            "read off the coordinates of the space they are not",
            proved=moved_a.dot(moved_b) == -3,
        ),
        step(
            formula("|B b|² = 5 ≠ |b|² = 2"),
            "lengths change too: a cosine made of them is wrong without the metric",
            proved=moved_b.dot(moved_b) == 5 and b.dot(b) == 2,
        ),
    ]


def reflection() -> tuple[list[Step], str]:
    """Show the reflected vector, the half vector, and what gates a highlight."""
    return (
        [*_reflected(), *_half_vector(), _gate(), _towards_the_eye()],
        "Clamp r · v or n · h to [0, 1], raise it, and multiply by 0 where n · l ≤ 0.",
    )


def _reflected() -> list[Step]:
    n, light, v = (generic_vector(name) for name in "nlv")
    square = n.dot(n)
    r = 2 * n.dot(light) / square * n - light
    return [
        step(
            formula("r = 2 (n · l) n / |n|² − l"),
            "r is as long as l and leans to the other side of n by the same angle",
            proved=equal(r.dot(r), light.dot(light)) and equal(r.dot(n), light.dot(n)),
        ),
        step(
            formula("r · v = 2 (n · l) (n · v) / |n|² − l · v"),
            "so a highlight needs these products: n · l and n · v are the same in every space, "
            "l · v and |n|² are measured by the metric",
            proved=equal(r.dot(v), 2 * n.dot(light) * n.dot(v) / square - light.dot(v)),
        ),
    ]


def _half_vector() -> list[Step]:
    import sympy as sp

    light, v = sp.Matrix([0, 0, 1]), sp.Matrix([3, 0, 4]) / 5
    half, leaning = light + v, 5 * light + v
    return [
        step(
            formula("h = l / |l| + v / |v|"),
            "the half vector is a sum of unit vectors: it makes the same angle with both",
            proved=equal(half.dot(light), half.dot(v)),
        ),
        step(
            formula("(5 l + v) · l ≠ (5 l + v) · v"),
            "a sum of vectors of different lengths leans to the longer one",
            proved=not equal(leaning.dot(light), leaning.dot(v)),
        ),
    ]


def _gate() -> Step:
    """Show a light behind the surface whose reflection still reaches an eye in front of it."""
    import sympy as sp

    n, light, v = sp.Matrix([0, 0, 1]), sp.Matrix([3, 0, -4]) / 5, sp.Matrix([-12, 0, 5]) / 13
    r = 2 * n.dot(light) * n - light
    products = [n.dot(light), n.dot(v), light.dot(v), r.dot(v)]
    names = ("n · l", "n · v", "l · v", "r · v")
    values = (f"{name} = {written(value)}" for name, value in zip(names, products, strict=True))
    return step(
        formula(",  ".join(values)),
        "for n = (0, 0, 1), l = (3/5, 0, −4/5), v = (−12/13, 0, 5/13): l is behind the surface, "
        "v before it, and r · v is positive all the same: gate the highlight on n · l, not on "
        "r · v; 0⁰ must not glow",
        proved=products[0] < 0 < products[1] and products[3] > 0,
    )


def _towards_the_eye() -> Step:
    R, e, x = generic_matrix("r"), generic_vector("e"), generic_vector("x")
    p = R * x - R * e  # V = R · T(−e) takes x to p, and the eye e to the origin
    return step(
        formula("v = −p / |p|"),
        "in camera space the eye is the origin, so the vector to it is minus the position",
        proved=equal(R * (e - x), -p),
    )
