"""Lengths, angles, and vectors without a direction."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from math import acos, atan2, sqrt

import numpy as np

from nmatrix.linear.angle import angle_between
from nmatrix.linear.rounding import normalize
from nmatrix.raster.shading.normals import unit
from nmatrix.studies.hardcases.case import Case, Contestant, exactly, own
from nmatrix.studies.hardcases.oracle import root

Vector = tuple[float, float, float]

EASY: Vector = (3.0, 4.0, 12.0)
BY_NORM = "v / np.linalg.norm(v)"


def _normalising(
    v: Sequence[float], asked: Callable[[Sequence[float]], Sequence[float]] = tuple
) -> tuple[Contestant, ...]:
    """Normalise a vector in both ways, and take from the result what is asked of it."""
    return (
        own("normalize", lambda: asked(normalize(v))),
        Contestant(BY_NORM, lambda: asked(_by_norm(v))),
    )


def _zero_vector(id_: str, title: str) -> Case:
    return Case(
        id_,
        title,
        "(0, 0, 0)",
        None,
        "it has no direction, and must say so",
        _normalising((0.0, 0.0, 0.0)),
    )


def _length_case(id_: str, scale: float) -> Case:
    v = tuple(x * scale for x in EASY)
    return Case(
        id_,
        f"a vector of size {scale:.0e}",
        f"(3, 4, 12) · {scale!r}",
        exactly(*v),
        "its square leaves the floats, its direction does not",
        _normalising(v),
        is_direction=True,
    )


def _by_norm(v: Sequence[float]) -> list[float]:
    found: list[float] = (np.array(v) / np.linalg.norm(v)).tolist()
    return found


def _length_error(id_: str, scale: float) -> Case:
    v = tuple(x * scale for x in EASY)
    return Case(
        id_,
        f"the length of a unit vector, from size {scale:g}",
        f"(3, 4, 12) · {scale:g}",
        exactly(1),
        "subnormal squares are inexact without a sign of it",
        _normalising(v, lambda unit: [sqrt(sum(x * x for x in unit))]),
    )


def _arctangent(x: Fraction) -> Fraction:
    """Compute atan x for a small x by its series."""
    return x - x**3 / 3 + x**5 / 5


def _angle_case(id_: str, size: float) -> Case:
    a, b = (1.0, 0.0, 0.0), (1.0, size, 0.0)
    return Case(
        id_,
        f"an angle of {size:g}",
        f"(1, 0, 0) and (1, {size:g}, 0)",
        (_arctangent(Fraction(size)),),
        "the cosine of a small angle is 1 in floats",
        (
            own("angle_between", lambda: [angle_between(a, b)]),
            Contestant("acos(a·b)", lambda: [acos(min(1.0, 1.0 / sqrt(1.0 + size * size)))]),
        ),
    )


def _slanted_angle() -> Case:
    """Make a case of vectors off the axes, where half-angle forms are only absolutely accurate."""
    size = 2.0**-46
    a = (1.0, 2.0, 3.0)
    b = (1.0 + 2 * size, 2.0 - size, 3.0)  # a + size · (2, −1, 0), and (2, −1, 0) ⟂ a
    true = _arctangent(root(Fraction(5, 14)) * Fraction(size))

    def halves() -> list[float]:
        p, q = np.array(_by_norm(a)), np.array(_by_norm(b))
        return [2 * atan2(float(np.linalg.norm(p - q)), float(np.linalg.norm(p + q)))]

    return Case(
        "V3b",
        "a tiny angle off the axes",
        f"(1, 2, 3) and itself + {size:.3g}·(2, −1, 0)",
        (true,),
        "normalising first loses the angle's own digits",
        (
            own("angle_between", lambda: [angle_between(a, b)]),
            Contestant("2 atan2(|p−q|, |p+q|)", halves),
        ),
    )


def _interpolated() -> Case:
    middle = np.array([[0.5 * (1.0 - 1.0), 0.5e-17, 0.0]])

    def ours() -> list[float] | None:
        found: list[float] = unit(middle, 1e-12)[0].tolist()
        return found if any(found) else None

    return Case(
        "V4",
        "half way between opposite normals",
        "(1, 0, 0) and (−1, 10⁻¹⁷, 0), half of each",
        None,
        "what is left is rounding, and normalising makes a direction of it",
        (
            own("unit, with a shortest length", ours),
            Contestant(BY_NORM, lambda: _by_norm(middle[0])),
        ),
    )


CASES: tuple[Case, ...] = (
    _length_case("V1", 1e-320 * 4),
    _length_case("V1b", 1e200),
    _length_error("V1c", 1e-160),
    _zero_vector("V2", "the zero vector"),
    _angle_case("V3", 1e-9),
    _slanted_angle(),
    _interpolated(),
    _zero_vector("E7", "a light that travels nowhere"),
)
