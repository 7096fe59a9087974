"""Views along up, eyes far away, and matrices in the wrong order."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import numpy as np

from nmatrix.enums import Convention, Handedness, Space
from nmatrix.linear.angle import Angle
from nmatrix.linear.rational import linear_part, to_floats
from nmatrix.linear.view import first_person, look_at
from nmatrix.scene.camera import View
from nmatrix.scene.setup import Setup
from nmatrix.scene.world import World
from nmatrix.studies.hardcases.case import Case, Contestant, exactly, own
from nmatrix.studies.hardcases.oracle import exact_rows, solve

Vector = tuple[float, float, float]
Rows = Sequence[Sequence[float]]

ORIGIN: Vector = (0.0, 0.0, 0.0)
UPRIGHT: Vector = (0.0, 1.0, 0.0)


def _looking(eye: Vector, target: Vector, up: Vector = UPRIGHT) -> Rows:
    return to_floats(look_at(eye, target, up, Handedness.RIGHT).camera_from_world)


def _frame_error(camera_from_world: Rows) -> list[float]:
    """Find the largest entry of R Rᵀ − 1, which is 0 for a rotation."""
    R = exact_rows(row[:3] for row in camera_from_world[:3])
    return [
        max(
            abs(float(sum(a * b for a, b in zip(R[i], R[j], strict=True)) - (i == j)))
            for i in range(3)
            for j in range(3)
        )
    ]


def _crossed(eye: Vector, target: Vector, up: Vector) -> list[list[float]]:
    """Build a view as tutorials do: two cross products of floats."""
    forward = np.array(target) - np.array(eye)
    forward = forward / np.linalg.norm(forward)
    right = np.cross(forward, up)
    right = right / np.linalg.norm(right)
    rows: list[list[float]] = [
        right.tolist(),
        np.cross(right, forward).tolist(),
        (-forward).tolist(),
    ]
    return rows


def _view_case(id_: str, title: str, target: Vector, up: Vector, reason: str) -> Case:
    eye = ORIGIN
    return Case(
        id_,
        title,
        f"eye 0 0 0, target {target}, up {up}",
        exactly(0),
        reason,
        (
            own("look_at", lambda: _frame_error(_looking(eye, target, up))),
            Contestant("two cross products", lambda: _frame_error(_crossed(eye, target, up))),
        ),
    )


def _no_view() -> Case:
    here = (1.0, 2.0, 3.0)
    return Case(
        "E3",
        "an eye at its target",
        "eye = target = 1 2 3",
        None,
        "there is no direction to look in",
        (
            own("look_at", lambda: _looking(here, here)[0]),
            Contestant("two cross products", lambda: _crossed(here, here, UPRIGHT)[0]),
        ),
    )


def _eye_case(id_: str, far: float) -> Case:
    eye = (far + 3.0, far - 2.0, far + 1.0)
    place = World((far, far, far), rotate_degrees=(20, 30, 40))
    maps = Setup(place, View(eye, target=(far, far, far))).maps
    away = [Fraction(e) - Fraction(far) for e in eye]
    true = solve(linear_part(maps.world_from_object.exact), away)

    def by_inverse() -> list[float]:
        return list(map(float, maps.eye_in(Space.OBJECT)))

    def course() -> list[float]:
        V, M = maps.camera_from_world.matrix, maps.world_from_object.matrix
        found: list[float] = np.linalg.inv(np.array(V) @ np.array(M))[:3, 3].tolist()
        return found

    return Case(
        id_,
        f"the eye of an object at {far:g}",
        f"A x = eye − t, |t| = {far:g}",
        true,
        "the product V·M has lost what the difference still knows",
        (own("subtract, then solve", by_inverse), Contestant("(MV)⁻¹ · (0, 0, 0, 1)", course)),
    )


def _orbit() -> Case:
    """Look straight up, where up × forward is zero; the azimuth still gives right."""
    turn = Angle.degrees(30)

    def ours() -> list[float]:
        up, level = Angle.degrees(90), Angle.degrees(0)
        return list(to_floats(first_person(ORIGIN, up, turn, level, Convention.STANDARD))[0][:3])

    def crossed() -> list[float]:
        return _crossed(ORIGIN, UPRIGHT, UPRIGHT)[0]

    true = exactly(turn.cosine, 0, -turn.sine)
    return Case(
        "E4",
        "looking straight up",
        "elevation 90, angle 30",
        true,
        "the azimuth knows what a cross product has lost",
        (own("first_person", ours), Contestant("two cross products", crossed)),
    )


def _lamp() -> Case:
    eye: Vector = (0.0, 0.0, 5.0)
    V = np.array(_looking(eye, ORIGIN))
    M = np.array([[1.0, 0, 0, 3], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
    maps = Setup(view=View(eye)).maps
    return Case(
        "M4",
        "a lamp in the world, moved by V·M",
        "eye 0 0 5, lamp 1 2 3, object at 3 0 0",
        exactly(1, 2, -2),
        "M moves the object, not a lamp that stands in the world",
        (
            own("V p", lambda: maps.camera_from_world.point((1, 2, 3))),
            Contestant("V M p", (V @ M @ [1, 2, 3, 1])[:3].tolist),
        ),
    )


def _tilted() -> Case:
    eye: Vector = (3.0, 3.0, 3.0)
    V = _looking(eye, ORIGIN)
    R = np.array(V)[:3, :3]

    def eye_seen() -> list[float]:
        return [sum(a * b for a, b in zip(row, (*eye, 1), strict=True)) for row in V[:3]]

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
    _view_case("E1", "up along the view", (0.0, 1.0, 0.0), UPRIGHT, "the cross product is zero"),
    _view_case(
        "E2",
        "up almost along the view",
        (0.3, 0.5, 0.7),
        (0.3 + 1e-12, 0.5, 0.7 - 1e-12),
        "the cross product cancels",
    ),
    _no_view(),
    _orbit(),
    _eye_case("E5", 1e8),
    _eye_case("E6", 1e15),
    _lamp(),
    _tilted(),
)
