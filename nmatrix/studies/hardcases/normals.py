"""Normals through maps that stretch, mirror, flatten, and leave the range of floats."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.linear.affine import rotation
from nmatrix.linear.angle import Angle
from nmatrix.linear.rational import RationalMatrix, diagonal, product, to_floats
from nmatrix.studies.hardcases.case import Case, Contestant, spelled
from nmatrix.studies.hardcases.oracle import exact_rows, true_normal
from nmatrix.studies.methods import METHODS, Method

Array = NDArray[Any]
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
    first, second = _rotation(25, 40, 15), _rotation(35, -20, 50)
    return np.array(to_floats(product(first, diagonal([Fraction(s) for s in scale]), second)))


def _rotation(*degrees: float | Fraction) -> RationalMatrix:
    return rotation([Angle.degrees(d) for d in degrees])


def _smallest(A: Array) -> Vector:
    """Return a normal close to the direction that A stretches most: N n all but cancels."""
    found: Vector = tuple((A.T @ np.array([0.3, 0.5, 0.81])).tolist())
    return found


NULL = np.array([[1.0, 0, 1], [0, 1, 1], [1, 1, 2]])
HARD = _turned(1, Fraction(1, 10**8), Fraction(1, 10**16))

_ROWS: tuple[tuple[str, str, Array, Vector, str], ...] = (
    (
        "N1",
        "a stretch by two",
        np.diag([2.0, 1, 1]),
        (1, 1, 0),
        "A n leans the wrong way: 36.87° at κ = 2",
    ),
    (
        "N2",
        "a shear by 10⁸",
        np.array([[1, 1e8, 0], [0, 1, 0], [0, 0, 1]]),
        (1, 0, 0),
        "its determinant is 1, and A n is 90° off",
    ),
    (
        "N3",
        "a mirror",
        np.diag([-1.0, 1, 1]),
        (1, 0, 0),
        "cofactors without the sign of det point inwards",
    ),
    (
        "N4",
        "a flattening",
        np.diag([1.0, 1, 0]),
        (0.6, 0, 0.8),
        "no inverse is left, and the plane's normal is",
    ),
    (
        "N5",
        "rank 2 in whole numbers",
        NULL,
        (1, 0, 0),
        "an inverse of whole numbers may not even raise",
    ),
    ("N6", "a silhouette", NULL, (1, -1, 0), "C n = 0: the patch is a line, and that must be said"),
    ("N7", "rank 1", np.outer([1.0, 2, 3], [4, 5, 6]), PLAIN, "no plane is left to be normal to"),
    (
        "N8",
        "tiny: 10⁻¹⁶⁰",
        Q * 1e-160,
        PLAIN,
        "products of entries are subnormal, and silently inexact",
    ),
    ("N8b", "tinier: 10⁻³⁰⁰", Q * 1e-300, PLAIN, "products of entries are zero"),
    ("N8c", "subnormal entries", np.rint(Q * 7) * 5e-324, PLAIN, "even the inverse overflows"),
    ("N9", "huge: 10³⁰⁰", Q * 1e300, PLAIN, "products of entries overflow to infinity"),
    (
        "N10",
        "sixty decades in one map",
        _turned(Fraction(1, 10**30), 1, 10**30),
        PLAIN,
        "one scale for the whole matrix does not fit",
    ),
    (
        "N11",
        "four hundred decades by rows",
        np.diag([1e-200, 1.0, 1e200]) @ Q,
        PLAIN,
        "only powers of two may balance it",
    ),
    (
        "N12",
        "κ = 10¹⁶ and a normal that cancels",
        HARD,
        _smallest(HARD),
        "N n cancels; plain cofactors lose more than an inverse",
    ),
    (
        "N13",
        "a turn by a billionth",
        np.array(to_floats(_rotation(0, 0, Fraction(1, 10**7)))),
        PLAIN,
        "A itself is right for turns, whatever the translation",
    ),
    ("N17", "a power of two", Q * 2.0**700, PLAIN, "the direction must not change by a bit"),
    (
        "N18",
        "numbers from a float32 file",
        Q.astype(np.float32).astype(float) * [1, 3, 1],
        PLAIN,
        "exact for the numbers that the file has",
    ),
)

CASES = tuple(normal_case(*row) for row in _ROWS)
