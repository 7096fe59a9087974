"""N1 to N19: normals through maps that stretch, mirror, flatten, and leave the range of floats."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import NormalRule
from nmatrix.linear.affine import compose, rotation
from nmatrix.linear.angle import Angle
from nmatrix.linear.compensated import cofactors
from nmatrix.linear.exact import LinearMap
from nmatrix.linear.methods import METHODS, Method
from nmatrix.linear.rational import identity, rational, to_floats
from nmatrix.linear.rules import carrier
from nmatrix.studies.hardcases.case import Case, Contestant, exactly

Array = NDArray[Any]
Matrix = tuple[tuple[float, ...], ...]
Vector = tuple[float, ...]

# A rotation with short exact entries, (2, 3, 6)/7 and its like: products of it cancel nowhere.
Q = np.array([[2.0, 3, 6], [3, -6, 2], [6, 2, -3]]) / 7
PLAIN: Vector = (1.0, 2.0, 3.0)


def normal_case(id_: str, title: str, A: Array, n: Vector, reason: str) -> Case:
    """Return a case whose answer is the exact normal of the floats given."""
    linear_map = LinearMap.of(A.tolist())
    found = linear_map.normal(n)
    true = None
    if found.direction is not None:
        sign = -1 if linear_map.integer_determinant < 0 else 1
        given = [Fraction(x) for x in n]
        true = tuple(
            Fraction(sign * sum(c * x for c, x in zip(row, given, strict=True)))
            for row in linear_map.cofactors
        )
    contestants = tuple(_contestant(one, A, n) for one in METHODS)
    given_text = f"A = {_shown(A)}, n = ({', '.join(f'{x:g}' for x in n)})"
    return Case(id_, title, given_text, true, reason, contestants, is_direction=True)


def _contestant(one: Method, A: Array, n: Vector) -> Contestant:
    def compute() -> Vector | None:
        found = tuple(one.normals(A[None], np.array([n]))[0].tolist())
        return None if one.is_ours and not any(found) else found

    # The guarded level promises an inverse's error, not the exact answer: it stands as a peer.
    return Contestant(one.name, compute, is_ours=one.is_ours and one.name != "guarded")


def _shown(A: Array) -> str:
    return "; ".join(" ".join(f"{x:.6g}" for x in row) for row in A.tolist())


def _turned(*scale: float | Fraction) -> Array:
    """Return turn · scale · another turn, rounded once: axes that are nobody's."""
    first = rotation([Angle.degrees(25), Angle.degrees(40), Angle.degrees(15)])
    block = compose(first, scale)
    second = compose(
        rotation([Angle.degrees(35), Angle.degrees(-20), Angle.degrees(50)]), (1, 1, 1)
    )
    from nmatrix.linear.rational import linear, product

    return np.array(to_floats(linear(product(block, second))))


def _smallest(A: Array) -> Vector:
    """Return a normal close to the direction that A stretches most: N n all but cancels."""
    found: Vector = tuple((A.T @ np.array([0.3, 0.5, 0.81])).tolist())
    return found


NULL = np.array([[1.0, 0, 1], [0, 1, 1], [1, 1, 2]])
HARD = _turned(1, Fraction(1, 10**8), Fraction(1, 10**16))

NORMALS: tuple[Case, ...] = (
    normal_case(
        "N1",
        "a stretch by two",
        np.diag([2.0, 1, 1]),
        (1, 1, 0),
        "A n leans the wrong way: 36.87° at κ = 2",
    ),
    normal_case(
        "N2",
        "a shear by 10⁸",
        np.array([[1, 1e8, 0], [0, 1, 0], [0, 0, 1]]),
        (1, 0, 0),
        "its determinant is 1, and A n is 90° off",
    ),
    normal_case(
        "N3",
        "a mirror",
        np.diag([-1.0, 1, 1]),
        (1, 0, 0),
        "cofactors without the sign of det point inwards",
    ),
    normal_case(
        "N4",
        "a flattening",
        np.diag([1.0, 1, 0]),
        (0.6, 0, 0.8),
        "no inverse is left, and the plane's normal is",
    ),
    normal_case(
        "N5",
        "rank 2 in whole numbers",
        NULL,
        (1, 0, 0),
        "an inverse of whole numbers may not even raise",
    ),
    normal_case(
        "N6",
        "a silhouette",
        NULL,
        (1, -1, 0),
        "C n = 0: the patch is a line, and that must be said",
    ),
    normal_case(
        "N7", "rank 1", np.outer([1.0, 2, 3], [4, 5, 6]), PLAIN, "no plane is left to be normal to"
    ),
    normal_case(
        "N8",
        "tiny: 10⁻¹⁶⁰",
        Q * 1e-160,
        PLAIN,
        "products of entries are subnormal, and silently inexact",
    ),
    normal_case("N8b", "tinier: 10⁻³⁰⁰", Q * 1e-300, PLAIN, "products of entries are zero"),
    normal_case(
        "N8c", "subnormal entries", np.rint(Q * 7) * 5e-324, PLAIN, "even the inverse overflows"
    ),
    normal_case("N9", "huge: 10³⁰⁰", Q * 1e300, PLAIN, "products of entries overflow"),
    normal_case(
        "N10",
        "sixty decades in one map",
        _turned(Fraction(1, 10**30), 1, 10**30),
        PLAIN,
        "one scale for the whole matrix does not fit",
    ),
    normal_case(
        "N11",
        "four hundred decades by rows",
        np.diag([1e-200, 1.0, 1e200]) @ Q,
        PLAIN,
        "only powers of two may balance it",
    ),
    normal_case(
        "N12",
        "κ = 10¹⁶ and a normal that cancels",
        HARD,
        _smallest(HARD),
        "N n cancels; plain cofactors lose more than an inverse",
    ),
    normal_case(
        "N13",
        "a turn by a billionth",
        np.array(
            to_floats(
                rotation([Angle.degrees(0), Angle.degrees(0), Angle.degrees(Fraction(1, 10**7))])
            )
        ),
        PLAIN,
        "A itself is right for turns, whatever the translation",
    ),
    normal_case(
        "N17", "a power of two", Q * 2.0**700, PLAIN, "the direction must not change by a bit"
    ),
    normal_case(
        "N18",
        "numbers from a float32 file",
        Q.astype(np.float32).astype(float) * [1, 3, 1],
        PLAIN,
        "exact for the numbers that the file has",
    ),
)


def _four_components() -> Case:
    """N14: a normalise over four components takes w into the length."""
    M = rational(to_floats(compose(identity(3), (2, 1, 1), translate=(5, 0, 0))))

    def four() -> Vector:
        found = carrier(NormalRule.FOUR_COMPONENT, M)
        assert found is not None  # M is invertible
        moved = [
            float(sum(a * b for a, b in zip(row, (1, 0, 0, 0), strict=True)))
            for row in found.matrix
        ]
        long = sum(x * x for x in moved) ** 0.5
        return (moved[0] / long, moved[1] / long, moved[2] / long)

    ours = Contestant(
        "exact",
        lambda: LinearMap.of(np.diag([2.0, 1, 1]).tolist()).normal((1, 0, 0)).direction,
        is_ours=True,
    )
    return Case(
        "N14",
        "a translation in a 4×4 inverse transpose",
        "scale 2 1 1, translate 5 0 0, n = (1, 0, 0)",
        exactly(1, 0, 0),
        "w carries −(A⁻¹t)·n, which is no part of a length",
        (ours, Contestant("four-component-normalise", four)),
    )


def _golden_minor() -> Case:
    """N19: a 2×2 determinant in float32 numbers that cancels to a thousandth."""
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
            Contestant(
                "compensated", lambda: (float(cofactors(A).mantissa[2, 2, 0]),), is_ours=True
            ),
            Contestant("float32", lambda: (float(a * d - b * c),)),
        ),
    )


def _not_finite() -> Case:
    """N16: one number that is none; the answer must name it."""
    A = np.diag([1.0, float("nan"), 1.0])

    def ours() -> Vector:
        from nmatrix.linear.vectors import normalize

        return normalize((1.0, float(A[1, 1]), 0.0))

    return Case(
        "N16",
        "an entry that is not a number",
        "A = diag(1, nan, 1)",
        None,
        "whatever is computed from it is nothing, and must not be drawn",
        (Contestant("exact", ours, is_ours=True), _contestant(METHODS[3], A, (1, 1, 0))),
    )


CASES: tuple[Case, ...] = (*NORMALS, _four_components(), _not_finite(), _golden_minor())
