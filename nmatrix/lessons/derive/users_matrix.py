"""The user's own matrix in the rule, in exact numbers: fractions stay fractions, 30° gives √3/2."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import TYPE_CHECKING

from nmatrix.lessons.derive.steps import determinant, equal, is_zero, normal_form, step
from nmatrix.lessons.notation import formula, written
from nmatrix.linear.angle import Angle
from nmatrix.report import Number, Step
from nmatrix.scene.world import World
from nmatrix.working.determinants import cofactors
from nmatrix.working.inverses import determinant_by_cofactors, inverse_transpose
from nmatrix.working.working import Matrix, Notation

if TYPE_CHECKING:
    import sympy as sp
TYPED = "your matrix, exactly as it was typed"
OF_UNIT_LENGTH = "your matrix, exactly; the quaternion was brought to length one"


def users_matrix(world: World) -> list[Step]:
    """Put a world's 3×3 block into the rule, in exact numbers, line by line as on paper."""
    import sympy as sp

    M = exact_matrix(world)
    A_ = M[:3, :3]
    A, named = tuple(map(tuple, A_.tolist())), Named(A_)
    by = Notation(
        lambda entry: written(named(sp.sympify(entry))),
        is_zero,
        tidy,
        agree=equal,
        spells_out=not named.angles,
    )
    if is_zero(determinant(A_)):
        C = cofactors(A, by=by)
        line, _ = determinant_by_cofactors(A, C.value, "A", by)
        found: list[Step] = [*C.steps, line, _no_inverse(A_, C.value)]
    else:
        carrier = inverse_transpose(A, by=by)
        found = [*carrier.steps, *_translation(M, carrier.value, named)]
    about = TYPED if world.quaternion is None else OF_UNIT_LENGTH
    return [replace(found[0], because=about), *named.steps(), *found[1:]]


def _no_inverse(A_: sp.Matrix, C: Matrix) -> Step:
    rank = A_.rank(iszerofunc=is_zero)
    left = "C is what is left" if rank == 2 else "C is zero as well"
    because = f"det A = 0 and the rank is {rank}: no inverse transpose; {left}"
    is_nothing = all(is_zero(entry) for row in C for entry in row)
    return step(formula("det A = 0"), because, proved=rank < 3 and is_nothing is (rank < 2))


class Named:
    """Cosines and sines that are no surds, written as c₁ and s₁: a matrix of them stays a page."""

    def __init__(self, A_: sp.Matrix) -> None:
        import sympy as sp

        self.angles = sorted({atom.args[0] for atom in A_.atoms(sp.sin, sp.cos)}, key=float)
        self.names = {
            function(angle): sp.Symbol(f"{letter}_{i}")
            for i, angle in enumerate(self.angles, start=1)
            for letter, function in (("c", sp.cos), ("s", sp.sin))
        }

    def __call__(self, expression: sp.Basic) -> sp.Basic:
        """Put the names into an expression."""
        return expression.xreplace(self.names)

    def steps(self) -> list[Step]:
        """Define each pair of names by its angle."""
        import sympy as sp

        return [self._pair(sp.cos(angle), sp.sin(angle)) for angle in self.angles]

    def _pair(self, cosine: sp.Expr, sine: sp.Expr) -> Step:
        c, s = self.names[cosine], self.names[sine]
        back = {c: cosine, s: sine}
        return step(
            formula(f"{_equation(c, cosine)},  {_equation(s, sine)}"),
            "no short roots: they keep a name",
            proved=bool((c**2 + s**2).xreplace(back).simplify() == 1),
        )


def _equation(name: sp.Symbol, value: sp.Expr) -> str:
    """Write `c₁ = cos(20°)`."""
    import sympy as sp

    degrees = _typed(sp.Rational(value.args[0] * 180 / sp.pi))
    return f"{written(name)} = {value.func.__name__}({degrees}°)"


def _typed(degrees: sp.Rational) -> str:
    """Write degrees as a short decimal, if they are one."""
    short = f"{float(degrees):g}"
    exact = Fraction(int(degrees.p), int(degrees.q))
    return short if Fraction(short) == exact else str(exact)


def _translation(M: sp.Matrix, carrier: Matrix, named: Named) -> list[Step]:
    """Show where the translation goes, if there is one: to the last row of M⁻ᵀ."""
    import sympy as sp

    A_, t = M[:3, :3], M[:3, 3]
    if not any(t):
        return []
    row = (-(sp.Matrix(carrier).T * t)).applyfunc(tidy).T
    return [
        step(
            formula("−(A⁻¹ t)ᵀ = ", named(row)),
            "your translation: the first three numbers of the last row of M⁻ᵀ, where normals "
            "never meet it",
            proved=equal(A_ * row.T + t, sp.zeros(3, 1)),
        )
    ]


def exact_matrix(world: World) -> sp.Matrix:
    """Build the 4×4 matrix of a world with SymPy's own sines and cosines."""
    import sympy as sp

    rows = world.exact_by(_turn)
    return sp.Matrix([[tidy(sp.sympify(entry)) for entry in row] for row in rows])


def _turn(degrees: Number) -> Angle:
    import sympy as sp

    radians = sp.pi * sp.Rational(*Fraction(degrees).as_integer_ratio()) / 180
    # An Angle is a sine and a cosine; the builders only multiply and add them.
    return Angle(sp.sin(radians), sp.cos(radians))


def tidy(expression: sp.Expr) -> sp.Expr:
    """Simplify an expression: no needless roots, sines and products."""
    import sympy as sp

    expression = sp.sympify(expression)
    if not expression.has(sp.sin, sp.cos):
        return sp.radsimp(sp.expand(expression))
    top, bottom = sp.fraction(expression)
    return normal_form(top) / normal_form(bottom)
