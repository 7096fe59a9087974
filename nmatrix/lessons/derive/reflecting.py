"""The lesson on reflected light: r, the half vector h, and what gates a highlight.

n is a normal, l the vector to the light, v the vector to the eye, p a position in camera space.
"""

from __future__ import annotations

from nmatrix.lessons.derive.steps import equal, step
from nmatrix.lessons.derive.symbols import generic_matrix, generic_vector
from nmatrix.lessons.notation import formula, written
from nmatrix.report import Step


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
