"""Views along up, and eyes far away."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import numpy as np

from nmatrix.enums import Convention, Frame, Handedness, Space
from nmatrix.linear import rational
from nmatrix.linear.affine import compose, rotation
from nmatrix.linear.angle import Angle
from nmatrix.linear.rational import rational_vector, to_floats
from nmatrix.linear.view import first_person, look_at
from nmatrix.spaces.exact_maps import ExactMaps, WorldLight
from nmatrix.spaces.transform import Transform
from nmatrix.studies.hardcases.case import Case, Contestant, exactly, own
from nmatrix.studies.hardcases.oracle import solve

Vector = tuple[float, float, float]

UPRIGHT: Vector = (0.0, 1.0, 0.0)


def _frame_error(camera_from_world: Sequence[Sequence[float]]) -> list[float]:
    R = [[Fraction(x) for x in row[:3]] for row in camera_from_world[:3]]
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
    eye = (0.0, 0.0, 0.0)
    return Case(
        id_,
        title,
        f"eye 0 0 0, target {target}, up {up}",
        exactly(0),
        reason,
        (
            own(
                "look_at",
                lambda: _frame_error(look_at(eye, target, up, Handedness.RIGHT).camera_from_world),
            ),
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
            own(
                "look_at",
                lambda: look_at(here, here, UPRIGHT, Handedness.RIGHT).camera_from_world[0],
            ),
            Contestant("two cross products", lambda: _crossed(here, here, UPRIGHT)[0]),
        ),
    )


def _eye_case(id_: str, far: float) -> Case:
    turn = rational.linear_part(
        rational.rational_matrix(
            to_floats(compose(rotation([Angle.degrees(d) for d in (20, 30, 40)]), (1, 1, 1)))
        )
    )
    M = rational.affine_matrix(turn, rational_vector((far, far, far)))
    eye = tuple(far + x for x in (3.0, -2.0, 1.0))
    place = Transform(Frame.WORLD, Frame.OBJECT, M)
    V = rational.rational_matrix(
        look_at(eye, (far, far, far), UPRIGHT, Handedness.RIGHT).camera_from_world
    )
    camera = Transform(Frame.CAMERA, Frame.WORLD, V)
    maps = ExactMaps(
        place,
        camera,
        rational.identity(4),
        rational_vector(eye),
        WorldLight(rational_vector((0, -1, 0)), None),
    )
    away = [Fraction(e) - Fraction(far) for e in eye]
    true = solve(turn, away)

    def by_inverse() -> list[float]:
        return list(map(float, maps.eye_in(Space.OBJECT)))

    def course() -> list[float]:
        product = np.array(camera.matrix) @ np.array(place.matrix)
        found: list[float] = np.linalg.inv(product)[:3, 3].tolist()
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
        return list(
            to_floats(
                first_person(
                    (0, 0, 0), Angle.degrees(90), turn, Angle.degrees(0), Convention.STANDARD
                )
            )[0][:3]
        )

    def crossed() -> list[float]:
        return _crossed((0, 0, 0), (0.0, 1.0, 0.0), UPRIGHT)[0]

    true = exactly(turn.cosine, 0, -turn.sine)
    return Case(
        "E4",
        "looking straight up",
        "elevation 90, angle 30",
        true,
        "the azimuth knows what a cross product has lost",
        (own("first_person", ours), Contestant("two cross products", crossed)),
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
)
