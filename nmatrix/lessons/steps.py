"""One step of a proof: what is claimed, why, and SymPy's verdict on the claim itself."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from nmatrix.report import Formula, Step

if TYPE_CHECKING:
    import sympy as sp


def equal(left: sp.Basic, right: sp.Basic, unit_circle: Sequence[sp.Symbol] = ()) -> bool:
    """Return whether two expressions or matrices are equal as polynomials and surds.

    Both sides are expanded; `unit_circle` holds pairs c, s with c² + s² = 1.
    """
    import sympy as sp

    difference = left - right
    entries: Iterable[sp.Expr] = list(difference) if hasattr(difference, "tolist") else [difference]
    for entry in entries:
        expanded = sp.expand(entry)
        if unit_circle:
            c, s = unit_circle
            expanded = sp.expand(expanded.subs(c**2, 1 - s**2))
        if expanded != 0 and sp.simplify(expanded) != 0:
            return False
    return True


def step(shown: Formula, because: str, *, proved: bool) -> Step:
    """Return a step with the verdict of its proof."""
    return Step(shown, because, bool(proved))
