"""Normals through maps that stretch, mirror, flatten, and leave the range of floats."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.linear.affine import compose, rotation
from nmatrix.linear.angle import Angle
from nmatrix.linear.rational import linear_part, product, to_floats
from nmatrix.studies.hardcases.case import Case, Contestant, spelled
from nmatrix.studies.hardcases.oracle import exact_rows, true_normal
from nmatrix.studies.methods import METHODS, Method

Array = NDArray[Any]
Matrix = tuple[tuple[float, ...], ...]
Vector = tuple[float, ...]

# A rotation with short exact entries, (2, 3, 6)/7 and its like: products of it cancel nowhere.
Q = np.array([[2.0, 3, 6], [3, -6, 2], [6, 2, -3]]) / 7
PLAIN: Vector = (1.0, 2.0, 3.0)


def normal_case(id_: str, title: str, A: Array, n: Vector, reason: str) -> Case:
    """Make a case whose answer is the exact normal for the floats given."""
    return Case(
        id_,
        title,
        f"A = {spelled(A.tolist())}, n = ({spelled([n]).replace(' ', ', ')})",
        true_normal(exact_rows(A.tolist()), [Fraction(x) for x in n]),
        reason,
        tuple(contestant(one, A, n) for one in METHODS),
        is_direction=True,
    )


def contestant(one: Method, A: Array, n: Vector) -> Contestant:
    """Make a contestant of a method on one matrix and normal; ours says None for no normal."""

    def compute() -> Vector | None:
        found = tuple(one.normals(A[None], np.array([n]))[0].tolist())
        return None if one.is_ours and not any(found) else found

    return Contestant(one.name, compute, is_ours=one.is_ours)


def ours(A: Array, n: Vector) -> tuple[Contestant, ...]:
    """Return nmatrix's own ways to carry a normal."""
    return tuple(contestant(one, A, n) for one in METHODS if one.is_ours)


def _turned(*scale: float | Fraction) -> Array:
    """Return rotation · scale · another rotation, rounded once: no axis stays where it is."""
    first = rotation([Angle.degrees(25), Angle.degrees(40), Angle.degrees(15)])
    block = compose(first, scale)
    second = compose(
        rotation([Angle.degrees(35), Angle.degrees(-20), Angle.degrees(50)]), (1, 1, 1)
    )
    return np.array(to_floats(linear_part(product(block, second))))


def _smallest(A: Array) -> Vector:
    """Return a normal close to the direction that A stretches most: N n all but cancels."""
    found: Vector = tuple((A.T @ np.array([0.3, 0.5, 0.81])).tolist())
    return found


NULL = np.array([[1.0, 0, 1], [0, 1, 1], [1, 1, 2]])
HARD = _turned(1, Fraction(1, 10**8), Fraction(1, 10**16))

CASES: tuple[Case, ...] = (
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
    normal_case("N9", "huge: 10³⁰⁰", Q * 1e300, PLAIN, "products of entries overflow to infinity"),
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
