"""Normals by the rules that people use, and maps that have no normal matrix at all."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import NormalRule
from nmatrix.linear.angle import Angle
from nmatrix.linear.compensated import cofactors
from nmatrix.linear.projection import perspective
from nmatrix.linear.rational import rational_matrix, to_floats
from nmatrix.linear.rules import normal_transform
from nmatrix.reading.literal import as_affine
from nmatrix.reading.matrix import matrix_literal
from nmatrix.studies.hardcases.case import Case, Contestant, exactly, own, spelled
from nmatrix.studies.hardcases.normals import contestant, ours
from nmatrix.studies.methods import method

Array = NDArray[Any]
X: tuple[float, ...] = (1.0, 0.0, 0.0)


def _moved(*by: float) -> Array:
    M = np.diag([2.0, 1, 1, 1])
    M[: len(by), 3] = by
    return M


def _by(rule: NormalRule, M: Array) -> tuple[Contestant, ...]:
    """Carry the normal (1, 0, 0) in our ways and by a rule, and normalise it."""
    found = normal_transform(rule, rational_matrix(M.tolist()))
    assert found is not None  # the cases are invertible
    carried = (np.array(to_floats(found.matrix)) @ [*X, found.w])[: found.components]
    unit = (carried / np.linalg.norm(carried))[:3]
    return (*ours(M[:3, :3], X), Contestant(rule.value, unit.tolist))


def _four_components(id_: str, by: float, reason: str) -> Case:
    """Make a case in which w is taken into the length."""
    return Case(
        id_,
        f"normalising four components, moved by {by:g}",
        f"scale 2 1 1, translate {by:g} 0 0, n = (1, 0, 0)",
        exactly(1, 0, 0),
        reason,
        _by(NormalRule.FOUR_COMPONENT, _moved(by)),
    )


def _projective() -> Case:
    """P·V·M is not affine: it has no normal matrix, and must be refused as a world matrix."""
    P = np.array(to_floats(perspective(Angle.degrees(30), 1.0, 0.1, 100.0)))
    PVM = P @ _moved(1.0)

    def ours_reads() -> tuple[float, ...]:
        return as_affine(matrix_literal(spelled(PVM.tolist()))).rows[0]

    def block() -> list[float]:
        found: list[float] = (np.linalg.inv(PVM).T[:3, :3] @ [1.0, 1.0, 1.0]).tolist()
        return found

    return Case(
        "N15",
        "the inverse transpose of P·V·M",
        "perspective 60°, scale 2 1 1, translate 1 0 0",
        None,
        "a projective map keeps no right angles: its last row is not 0 0 0 1",
        (own("reading it as a world matrix", ours_reads), Contestant("inv(PVM).T[:3, :3]", block)),
    )


def _not_finite() -> Case:
    """Make a case of an entry that is NaN, and must be refused by name."""
    A = np.diag([1.0, float("nan"), 1.0])
    return Case(
        "N16",
        "an entry that is not a number",
        "A = diag(1, nan, 1)",
        None,
        "whatever is computed from it is nothing, and must not be drawn",
        (
            own("reading it", lambda: matrix_literal(spelled(A.tolist())).rows[1]),
            contestant(method("inverse"), A, (1, 1, 0)),
        ),
    )


def _golden_minor() -> Case:
    """Make a case of a 2×2 determinant of float32 numbers that cancels to a thousandth."""
    a, b, c, d = (np.float32(x) for x in (33962.035, -30438.8, 41563.4, -24871.969))
    A = np.zeros((3, 3, 1))
    A[0, 0], A[0, 1], A[1, 0], A[1, 1], A[2, 2] = a, b, c, d, 1
    true = Fraction(float(a)) * Fraction(float(d)) - Fraction(float(b)) * Fraction(float(c))
    return Case(
        "N19",
        "one minor in float32",
        f"{a:g}·{d:g} − {b:g}·{c:g}",
        (true,),
        "both products agree in seven digits; float32 has no more",
        (
            own("compensated", lambda: (float(cofactors(A).mantissa[2, 2, 0]),)),
            Contestant("float32", lambda: (float(a * d - b * c),)),
        ),
    )


CASES: tuple[Case, ...] = (
    Case(
        "M1",
        "a normal with w = 1",
        f"n = (1, 0, 0), rule “{NormalRule.TRANSLATED}”",
        exactly(1, 0, 0),
        "a normal has no place to be moved from",
        _by(NormalRule.TRANSLATED, _moved(5.0, 5.0)),
        is_direction=True,
    ),
    Case(
        "M5",
        "cofactors of a mirror, unsigned",
        f"n = (1, 0, 0), rule “{NormalRule.COFACTOR}”",
        exactly(-1, 0, 0),
        "cofactor = det · inverse transpose, and det is negative",
        _by(NormalRule.COFACTOR, np.diag([-1.0, 1, 1, 1])),
        is_direction=True,
    ),
    _four_components("N14", 5.0, "w carries −(A⁻¹t)·n, which is no part of a length"),
    _projective(),
    _not_finite(),
    _golden_minor(),
    _four_components("M2", 1e6, "what is left of the normal is a millionth: the picture is black"),
)
