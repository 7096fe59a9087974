"""`derive`: choose lessons, put the user's own matrix in, and write the report."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import TYPE_CHECKING

from nmatrix.lessons import derivations, examples, lighting, reflecting, sides
from nmatrix.lessons.cases import TITLES, chosen
from nmatrix.lessons.notation import A_INVERSE_T, DET, EQUALS, A, C, formula, words
from nmatrix.lessons.steps import equal, is_zero, normal_form, step
from nmatrix.lessons.symbols import cofactors, determinant
from nmatrix.linear.angle import Angle
from nmatrix.report import Block, Heading, Number, Report, Step, Value, Verdict
from nmatrix.scene.world import World

if TYPE_CHECKING:
    import sympy as sp

Lesson = Callable[[], tuple[list[Step], str]]

LESSONS: dict[str, Lesson] = {
    "rule": derivations.rule,
    "cofactor": derivations.cofactor,
    "translation": derivations.translation,
    "rotation": examples.rotation,
    "uniform": examples.uniform,
    "nonuniform": examples.nonuniform,
    "shear": examples.shear,
    "mirror": sides.mirror,
    "singular": sides.singular,
    "lightdirection": lighting.lightdirection,
    "eye": lighting.eye,
    "metric": lighting.metric,
    "reflection": reflecting.reflection,
}


def derive(case: str, world: World | None = None) -> Report:
    """Return the lessons that a word stands for, every step proved.

    With a world, its own matrix follows the first lesson in exact numbers: fractions stay
    fractions, and 30° gives √3/2.

    Raises
    ------
    IllegalValueError
        If no case has this name.

    Examples
    --------
    >>> found = derive("mirror")
    >>> all(step["verified"] for step in found.data["cases"][0]["steps"])
    True
    """
    own = [] if world is None else own_matrix(world)
    cases: list[Value] = []
    blocks: list[Block] = []
    for i, name in enumerate(chosen(case)):
        steps, conclusion = LESSONS[name]()
        steps += own if i == 0 else []
        cases.append(_data(name, steps, conclusion))
        blocks += [Heading(TITLES[name]), *steps, Verdict(conclusion)]
    return Report("derive", {"cases": cases}, tuple(blocks))


def own_matrix(world: World) -> list[Step]:
    """Put a world's 3×3 block into the rule, in exact numbers."""
    import sympy as sp

    A_ = exact_block(world)
    K, det = cofactors(A_).applyfunc(tidy), tidy(determinant(A_))
    steps = [
        step(
            formula(A, EQUALS, A_, words(",  "), DET, EQUALS, det),
            "your matrix, exactly as it was typed",
            proved=equal(determinant(A_), det),
        ),
        step(
            formula(C, EQUALS, K),
            "its cofactors",
            proved=equal(A_.T * K, det * sp.eye(3)),
        ),
    ]
    if det == 0:
        rank = A_.rank(iszerofunc=is_zero)
        because = f"det A = 0 and the rank is {rank}: no inverse transpose; C is what is left"
        return [*steps, step(formula(DET, EQUALS, det), because, proved=rank < 3)]
    normal_matrix = (K / det).applyfunc(tidy)
    return [
        *steps,
        step(
            formula(A_INVERSE_T, EQUALS, normal_matrix),
            "your normal matrix: the cofactors over the determinant",
            proved=equal(A_.T * normal_matrix, sp.eye(3)),
        ),
    ]


def exact_block(world: World) -> sp.Matrix:
    """Return the 3×3 block of a world with SymPy's own sines and cosines."""
    import sympy as sp

    rows = world.exact_by(_turn)
    return sp.Matrix([[tidy(sp.sympify(entry)) for entry in row[:3]] for row in rows[:3]])


def _turn(degrees: Number) -> Angle:
    import sympy as sp

    radians = sp.pi * sp.Rational(*Fraction(degrees).as_integer_ratio()) / 180
    # An Angle is a sine and a cosine; the builders only multiply and add them.
    return Angle(sp.sin(radians), sp.cos(radians))


def tidy(expression: sp.Expr) -> sp.Expr:
    """Return an expression without needless roots, sines and products."""
    import sympy as sp

    if not expression.has(sp.sin, sp.cos):
        return sp.radsimp(sp.expand(expression))
    top, bottom = sp.fraction(expression)
    return normal_form(top) / normal_form(bottom)


def _data(name: str, steps: list[Step], conclusion: str) -> dict[str, Value]:
    return {
        "case": name,
        "title": TITLES[name],
        "steps": [
            {
                "text": one.formula.text,
                "latex": one.formula.latex,
                "because": one.because,
                "verified": one.verified,
            }
            for one in steps
        ],
        "conclusion": conclusion,
    }
