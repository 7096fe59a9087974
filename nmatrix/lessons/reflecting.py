"""The lesson on reflected light: r, the half vector h, and what gates a highlight.

n is a normal, l the vector to the light, v the vector to the eye, p a position in camera space.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from nmatrix.lessons.notation import EQUALS, formula, words
from nmatrix.lessons.steps import equal, step
from nmatrix.lessons.symbols import generic_vector
from nmatrix.report import Step

if TYPE_CHECKING:
    import sympy as sp


def reflection() -> tuple[list[Step], str]:
    """Show the reflected vector, the half vector, and what gates a highlight."""
    import sympy as sp

    n, light, v = (generic_vector(name) for name in "nlv")
    square = n.dot(n)
    r = 2 * n.dot(light) / square * n - light
    unit_l, unit_v = sp.Matrix([0, 0, 1]), sp.Matrix([3, 0, 4]) / 5
    half = unit_l + unit_v
    long = sp.Matrix([0, 0, 5])
    below = sp.Matrix([0, 0, -1])
    steps = [
        step(
            formula(
                words("r = 2 (n · l) n / |n|² − l", r"r = \frac{2 (n \cdot l)}{|n|^2}\, n - l")
            ),
            "r is as long as l and leans to the other side of n by the same angle",
            proved=equal(r.dot(r), light.dot(light)) and equal(r.dot(n), light.dot(n)),
        ),
        step(
            formula(
                words("r · v", r"r \cdot v"),
                EQUALS,
                words(
                    "2 (n · l) (n · v) / |n|² − l · v",
                    r"\frac{2 (n \cdot l)(n \cdot v)}{|n|^2} - l \cdot v",
                ),
            ),
            "so a highlight needs three products; in any space, each measured by its metric",
            proved=equal(r.dot(v), 2 * n.dot(light) * n.dot(v) / square - light.dot(v)),
        ),
        step(
            formula(words("h = l / |l| + v / |v|", r"h = \frac{l}{|l|} + \frac{v}{|v|}")),
            "the half vector is a sum of unit vectors: it makes the same angle with both",
            proved=equal(half.dot(unit_l), half.dot(unit_v)),
        ),
        step(
            formula(
                words("(5 l + v) · l ≠ (5 l + v) · v", r"(5 l + v) \cdot l \neq (5 l + v) \cdot v")
            ),
            "a sum of vectors of different lengths leans to the longer one",
            proved=not equal((long + unit_v).dot(unit_l), (long + unit_v).dot(unit_v)),
        ),
        step(
            formula(words("n · l < 0,  r · v = 1", r"n \cdot l < 0,\; r \cdot v = 1")),
            "a light below the surface can be reflected into the eye: gate the highlight on n · l, "
            "not on r · v, and 0⁰ must not glow",
            proved=_glows_from_below(unit_l, below),
        ),
        step(
            formula(words("v = −p / |p|", r"v = -\frac{p}{|p|}")),
            "in camera space the eye is the origin, so the vector to it is minus the position",
            proved=equal(sp.zeros(3, 1) - v, -v),
        ),
    ]
    return steps, "Clamp r · v or n · h to [0, 1], raise it, and multiply by 0 where n · l ≤ 0."


def _glows_from_below(n: sp.Matrix, light: sp.Matrix) -> bool:
    reflected = 2 * n.dot(light) * n - light
    return bool(n.dot(light) < 0 and equal(reflected.dot(reflected), light.dot(light)))
