"""One step of a proof: what is claimed, why, and SymPy's verdict on the claim itself."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from nmatrix.report import Formula, Step

if TYPE_CHECKING:
    import sympy as sp


def equal(left: sp.Basic, right: sp.Basic, unit_circle: Sequence[sp.Symbol] = ()) -> bool:
    """Decide if two expressions or matrices are equal as polynomials and surds.

    `unit_circle` holds a pair c, s with c² + s² = 1; the sine and cosine of one angle are such a
    pair by themselves.
    """
    difference = left - right
    entries: Iterable[sp.Expr] = list(difference) if hasattr(difference, "tolist") else [difference]
    pairs = [(unit_circle[0], unit_circle[1])] if unit_circle else []
    return all(reduced(entry, pairs) == 0 for entry in entries)


def reduced(expression: sp.Expr, pairs: Sequence[tuple[sp.Symbol, sp.Symbol]] = ()) -> sp.Expr:
    """Bring the numerator into its normal form; it is 0 exactly if the expression is 0."""
    import sympy as sp

    top = sp.fraction(sp.together(expression))[0]
    return normal_form(top, pairs)


def is_zero(expression: sp.Expr) -> bool:
    """Decide if an expression in surds, sines and cosines is zero."""
    return bool(reduced(expression) == 0)


def normal_form(polynomial: sp.Expr, pairs: Sequence[tuple[sp.Symbol, sp.Symbol]] = ()) -> sp.Expr:
    """Reduce a polynomial in sines and cosines modulo c² + s² = 1 for every angle in it.

    One division with remainder for each angle; a search for a trigonometric simplification does
    not end for the sines and cosines of several angles.
    """
    import sympy as sp

    angles = sorted({atom.args[0] for atom in polynomial.atoms(sp.sin, sp.cos)}, key=str)
    named = {angle: (sp.Dummy(real=True), sp.Dummy(real=True)) for angle in angles}
    there = {
        f(a): x for a, pair in named.items() for f, x in zip((sp.cos, sp.sin), pair, strict=True)
    }
    found = sp.expand(polynomial.xreplace(there))
    for c, s in (*pairs, *named.values()):
        found = sp.expand(sp.rem(found, c**2 + s**2 - 1, c)) if found.has(c) else found
    back = {x: value for value, x in there.items()}
    return (sp.radsimp(found) if found.is_number else found).xreplace(back)


def step(shown: Formula, because: str, *, proved: bool) -> Step:
    """Put a formula, its reason and the verdict of its proof together."""
    return Step(shown, because, bool(proved))
