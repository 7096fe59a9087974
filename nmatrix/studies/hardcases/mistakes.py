"""The mistakes that teaching material makes."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import Frame, Handedness, NormalRule
from nmatrix.linear.rational import rational_matrix
from nmatrix.linear.view import look_at
from nmatrix.spaces.transform import Transform
from nmatrix.studies.hardcases.affine import by_rule
from nmatrix.studies.hardcases.case import Case, Contestant, exactly, own
from nmatrix.studies.hardcases.normals import ours
from nmatrix.studies.hardcases.oracle import exact_rows, true_normal

Array = NDArray[Any]
X = (1.0, 0.0, 0.0)
MOVED = np.array([[2.0, 0, 0, 5], [0, 1, 0, 5], [0, 0, 1, 0], [0, 0, 0, 1]])
MIRRORED = np.diag([-1.0, 1, 1, 1])


def _rule_case(id_: str, title: str, rule: NormalRule, M: Array, reason: str) -> Case:
    A = M[:3, :3]
    return Case(
        id_,
        title,
        f"n = (1, 0, 0), rule “{rule}”",
        true_normal(exact_rows(A.tolist()), [Fraction(x) for x in X]),
        reason,
        (*ours(A, X), Contestant(rule.value, lambda: by_rule(rule, M, X))),
        is_direction=True,
    )


def _light_case() -> Case:
    V = rational_matrix(
        look_at((0, 0, 5), (0, 0, 0), (0, 1, 0), Handedness.RIGHT).camera_from_world
    )
    M = np.array([[1.0, 0, 0, 3], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
    floats = np.array([[float(x) for x in row] for row in V])
    return Case(
        "M4",
        "a lamp in the world, moved by V·M",
        "eye 0 0 5, lamp 1 2 3, object at 3 0 0",
        exactly(1, 2, -2),
        "M moves the object, not a lamp that stands in the world",
        (
            own("V p", lambda: Transform(Frame.CAMERA, Frame.WORLD, V).point((1, 2, 3))),
            Contestant("V M p", (floats @ M @ [1, 2, 3, 1])[:3].tolist),
        ),
    )


def _tilted() -> Case:
    eye, target = (3.0, 3.0, 3.0), (0.0, 0.0, 0.0)
    found = look_at(eye, target, (0, 1, 0), Handedness.RIGHT).camera_from_world
    R = np.array([[float(x) for x in row[:3]] for row in found[:3]])

    def eye_seen() -> list[float]:
        return [sum(float(a) * b for a, b in zip(row, (*eye, 1), strict=True)) for row in found[:3]]

    return Case(
        "M6",
        "a view that turns before it moves",
        "eye 3 3 3, target 0 0 0: the eye in camera space",
        exactly(0, 0, 0),
        "V = R · T(−eye): the eye must come out as the origin",
        (
            own("look_at", eye_seen),
            Contestant("T(−eye) · R", (R @ np.array(eye) - np.array(eye)).tolist),
        ),
    )


CASES: tuple[Case, ...] = (
    _rule_case(
        "M1",
        "a normal with w = 1",
        NormalRule.TRANSLATED,
        MOVED,
        "a normal has no place to be moved from",
    ),
    _light_case(),
    _rule_case(
        "M5",
        "cofactors of a mirror, unsigned",
        NormalRule.COFACTOR,
        MIRRORED,
        "cofactor = det · inverse transpose, and det is negative",
    ),
    _tilted(),
)
