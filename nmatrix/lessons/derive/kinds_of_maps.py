"""The lessons on kinds of maps: rotation, scales, shear, mirror, and what flattens space."""

from __future__ import annotations

from typing import TYPE_CHECKING

from nmatrix.lessons.derive.steps import cofactors, determinant, equal, step
from nmatrix.lessons.notation import formula
from nmatrix.report import Step

if TYPE_CHECKING:
    import sympy as sp


def rotation() -> tuple[list[Step], str]:
    """Show that a rotation is its own inverse transpose."""
    import sympy as sp

    c, s = sp.symbols("c s", real=True)
    R = sp.Matrix([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    circle = (c, s)
    steps = [
        step(
            formula("R = ", R, ",  c² + s² = 1"),
            "a rotation by θ about z, with c = cos θ and s = sin θ",
            proved=equal(determinant(R), sp.Integer(1), circle),
        ),
        step(
            formula("Rᵀ R = I"),
            "its columns have length one and are perpendicular",
            proved=equal(R.T * R, sp.eye(3), circle),
        ),
        step(
            formula("R⁻ᵀ = (Rᵀ)ᵀ = R"),
            "so the inverse is the transpose, and transposing twice changes nothing",
            proved=equal(cofactors(R), R, circle),
        ),
    ]
    return steps, (
        "R itself carries normals. A test on rotated objects can therefore never tell A from "
        "A⁻ᵀ: the hidden bias."
    )


def uniform() -> tuple[list[Step], str]:
    """Show that a uniform scale changes lengths only."""
    import sympy as sp

    k = sp.Symbol("k", nonzero=True)
    A_ = k * sp.eye(3)
    return [
        step(
            formula("A = ", A_, ",  A⁻ᵀ = ", sp.eye(3) / k),
            "the inverse transpose divides where A multiplies",
            proved=equal(A_.T * (sp.eye(3) / k), sp.eye(3)),
        ),
        step(
            formula("A = k² · A⁻ᵀ"),
            "both are multiples of the identity: the direction is the same, normalise the length",
            proved=equal(A_, k**2 * (sp.eye(3) / k)),
        ),
    ], "A uniform scale needs no inverse transpose, only a normalisation."


def nonuniform() -> tuple[list[Step], str]:
    """Show how a non-uniform scale bends normals, with numbers."""
    import sympy as sp

    a, b, c = sp.symbols("a b c", nonzero=True)
    S, inverse = sp.diag(a, b, c), sp.diag(1 / a, 1 / b, 1 / c)
    steps = [
        step(
            formula("A = ", S, ",  A⁻ᵀ = ", inverse),
            "a diagonal matrix is its own transpose, and its inverse divides",
            proved=equal(S.T * inverse, sp.eye(3)),
        ),
        *_on_one_normal(
            sp.diag(1, 2, 1), sp.Matrix([1, 1, 0]), sp.Matrix([1, -1, 0]), sp.Rational(3, 4)
        ),
        *_on_tangents_and_lengths(),
    ]
    return steps, (
        "Stretching y by 2 makes the slope steeper, so its normal leans away from y: the inverse "
        "transpose divides by 2 where A multiplies. A itself is 36.87° off in this example."
    )


def _on_tangents_and_lengths() -> list[Step]:
    """Show that tangents do not move with normals, and that lengths bend what lies between."""
    import sympy as sp

    stretched = sp.diag(1, sp.Rational(1, 2), 1)  # the inverse transpose of a stretch by 2
    t, n = sp.Matrix([1, -1, 0]), sp.Matrix([1, 1, 0])
    wrong = (stretched * t).dot(stretched * n)
    long, short = sp.Matrix([2, 0, 0]), sp.Matrix([0, 1, 0])
    between = (long + short) / 2
    return [
        step(
            formula("(A⁻ᵀ t) · (A⁻ᵀ n) = ", wrong, " ≠ 0"),
            "tangents and bitangents are vectors and move by A: by the normals' rule they are no "
            "longer perpendicular to them",
            proved=wrong != 0,
        ),
        step(
            formula("1/2 · ", long, " + 1/2 · ", short, " = ", between),
            "half way between normals of lengths 2 and 1 lies a vector that leans to the longer "
            "one: normalise before and after interpolation",
            proved=equal(between, long / 2 + short / 2) and between[0] != between[1],
        ),
    ]


def shear() -> tuple[list[Step], str]:
    """Show that a shear needs the inverse transpose although its determinant is 1."""
    import sympy as sp

    h = sp.Symbol("h")
    H = sp.Matrix([[1, h, 0], [0, 1, 0], [0, 0, 1]])
    K = cofactors(H)
    steps = [
        step(
            formula("A = ", H, ",  det A = 1"),
            "a shear keeps volume",
            proved=equal(determinant(H), sp.Integer(1)),
        ),
        step(
            formula("A⁻ᵀ = ", K),
            "its inverse transpose shears y along x, and with the other sign",
            proved=equal(H.T * K, sp.eye(3)),
        ),
        *_on_one_normal(H.subs(h, 1), sp.Matrix([1, 0, 0]), sp.Matrix([0, 1, 0]), sp.Integer(1)),
    ]
    return steps, "det A = 1 proves nothing: only AᵀA = s² I lets A itself carry normals."


def _on_one_normal(A_: sp.Matrix, n: sp.Matrix, t: sp.Matrix, tangent: sp.Expr) -> list[Step]:
    """Carry one normal both ways, measure both against the moved tangent, then each other."""
    wrong, right = A_ * n, cofactors(A_) * n / determinant(A_)
    wrong_dot, right_dot = (A_ * t).dot(wrong), (A_ * t).dot(right)
    return [
        step(
            formula("A = ", A_, ",  n = ", n, ",  t = ", t, ",  t · n = 0"),
            "take one such matrix, a normal, and a tangent perpendicular to it",
            proved=t.dot(n) == 0,
        ),
        step(
            formula("(A t) · (A n) = ", wrong_dot, " ≠ 0"),
            "moved by A the normal is no longer perpendicular to the moved tangent",
            proved=wrong_dot != 0,
        ),
        step(
            formula("A⁻ᵀ n = ", right, ",  (A t) · (A⁻ᵀ n) = ", right_dot),
            "moved by the inverse transpose it is",
            proved=right_dot == 0,
        ),
        _angle_between(wrong, right, tangent),
    ]


def _angle_between(wrong: sp.Matrix, right: sp.Matrix, tangent: sp.Expr) -> Step:
    """Prove tan θ = |a × b| / (a · b) to be the number that is claimed."""
    return step(
        formula("tan θ = ", tangent),
        "θ is the angle between the two",
        proved=equal(wrong.cross(right).norm() / wrong.dot(right), tangent),
    )


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
        *_on_one_triangle(A_, K),
    ]
    return steps, (
        "Outward normals: sign(det A) · C n, which points where A⁻ᵀ n does. Flip the winding of "
        "the triangles, not the normals."
    )


def _on_one_triangle(A_: sp.Matrix, K: sp.Matrix) -> list[Step]:
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
