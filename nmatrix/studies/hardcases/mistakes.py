"""M1 to M6: the mistakes that teaching material makes."""

from __future__ import annotations

from fractions import Fraction

import numpy as np

from nmatrix.enums import Frame, Handedness, NormalRule
from nmatrix.linear.exact import LinearMap
from nmatrix.linear.rational import rational, rational_vector
from nmatrix.linear.rules import carrier
from nmatrix.linear.view import look_at
from nmatrix.spaces.transform import Transform
from nmatrix.studies.hardcases.case import Case, Contestant, exactly, own


def _case(
    id_: str,
    title: str,
    given: str,
    expected: tuple[Fraction, ...],
    reason: str,
    *answers: Contestant,
) -> Case:
    return Case(id_, title, given, expected, reason, answers)


def _rule_case(id_: str, title: str, rule: NormalRule, M: list[list[float]], reason: str) -> Case:
    n = (1.0, 0.0, 0.0)
    exact = rational(M)
    true = LinearMap.of([row[:3] for row in M[:3]]).normal(n).direction
    assert true is not None  # the cases are chosen so

    def by_rule() -> list[float]:
        found = carrier(rule, exact)
        assert found is not None  # nothing here is singular
        return [
            float(sum(a * b for a, b in zip(r, (1, 0, 0, found.w), strict=True)))
            for r in found.matrix[:3]
        ]

    right = own("exact", lambda: true)
    case = _case(
        id_,
        title,
        f"n = (1, 0, 0), rule “{rule}”",
        exactly(*true),
        reason,
        right,
        Contestant(rule.value, by_rule),
    )
    return Case(
        case.id,
        case.title,
        case.given,
        case.expected,
        case.reason,
        case.contestants,
        is_direction=True,
    )


SQUEEZED = np.diag([1.0, 0.25, 1.0])
TO_LIGHT = np.array([0.3, 0.9, 0.2])


def _lambert(rule: str) -> list[float]:
    """Return n·l for the object normal (1, 1, 0)/√2, by the exact rule or the course's."""
    n = np.array([1.0, 1.0, 0.0]) / np.sqrt(2.0)
    if rule == "transposed":
        moved = SQUEEZED.T @ TO_LIGHT
        return [float(n @ moved / np.linalg.norm(moved))]
    world = n / np.diag(SQUEEZED)
    return [float(world @ TO_LIGHT / np.linalg.norm(world) / np.linalg.norm(TO_LIGHT))]


def _true_lambert() -> tuple[Fraction, ...]:
    """Return (n·l)/(|A⁻ᵀn| |l|) with the root to 100 bits: (0.3 + 4·0.9)/√(17 · 0.94)."""
    from math import isqrt

    light = [Fraction(x) for x in TO_LIGHT.tolist()]
    square = 17 * sum(x * x for x in light)
    return ((light[0] + 4 * light[1]) / Fraction(isqrt(int(square * (1 << 200))), 1 << 100),)


def _lamp_case() -> Case:
    V = rational(look_at((0, 0, 5), (0, 0, 0), (0, 1, 0), Handedness.RIGHT).camera_from_world)
    M = np.array([[1.0, 0, 0, 3], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
    p = rational_vector((1, 2, 3))
    true = tuple(sum(a * b for a, b in zip(row[:3], p, strict=True)) + row[3] for row in V[:3])
    floats = np.array([[float(x) for x in row] for row in V])
    return _case(
        "M4",
        "a lamp in the world, moved by V·M",
        "lamp 1 2 3, object at 3 0 0",
        true,
        "M moves the object, not a lamp that stands in the world",
        own("V p", lambda: Transform(Frame.CAMERA, Frame.WORLD, V).point((1, 2, 3))),
        Contestant("V M p", (floats @ M @ [1, 2, 3, 1])[:3].tolist),
    )


def _tilted() -> Case:
    eye, target = (3.0, 3.0, 3.0), (0.0, 0.0, 0.0)
    found = look_at(eye, target, (0, 1, 0), Handedness.RIGHT).camera_from_world
    R = np.array([[float(x) for x in row[:3]] for row in found[:3]])
    return _case(
        "M6",
        "a view that turns before it moves",
        "eye 3 3 3, target 0 0 0: the eye in camera space",
        exactly(0, 0, 0),
        "V = R · T(−eye): the eye must come out as the origin",
        own(
            "look_at",
            lambda: [
                sum(float(a) * b for a, b in zip(row, (*eye, 1), strict=True)) for row in found[:3]
            ],
        ),
        Contestant("T(−eye) · R", (R @ np.array(eye) - np.array(eye)).tolist),
    )


MOVED: list[list[float]] = [[2.0, 0, 0, 5], [0, 1, 0, 5], [0, 0, 1, 0], [0, 0, 0, 1]]
MIRRORED: list[list[float]] = [[-1.0, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]

CASES: tuple[Case, ...] = (
    _rule_case(
        "M1",
        "a normal with w = 1",
        NormalRule.TRANSLATED,
        MOVED,
        "a normal has no place to be moved from",
    ),
    _case(
        "M3",
        "light by the course's Mᵀ",
        "scale 1 ¼ 1, n = (1, 1, 0)/√2, l = (0.3, 0.9, 0.2)",
        _true_lambert(),
        "a direction is a vector, and Mᵀ moves covectors",
        own("exact", lambda: _lambert("exact")),
        Contestant("Mᵀ l", lambda: _lambert("transposed")),
    ),
    _lamp_case(),
    _rule_case(
        "M5",
        "cofactors of a mirror, unsigned",
        NormalRule.COFACTOR,
        MIRRORED,
        "cofactor = det · inverse transpose, and det is negative",
    ),
    _tilted(),
)
