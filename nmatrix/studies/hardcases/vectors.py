"""V1 to V4, E1 to E7, D1 to D7: vectors and angles, views and eyes, projections and depth."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import acos, atan2, pi, sqrt, tan

import numpy as np

from nmatrix.enums import DepthBuffer, Frame, Handedness
from nmatrix.linear import rational
from nmatrix.linear.affine import compose, rotation
from nmatrix.linear.angle import Angle
from nmatrix.linear.projection import DEFAULT_CLIP_SPACE, perspective
from nmatrix.linear.rational import rational_vector, to_floats
from nmatrix.linear.vectors import angle_between, normalize
from nmatrix.linear.view import look_at
from nmatrix.raster.normals import unit
from nmatrix.raster.visibility import depth_code
from nmatrix.spaces.stage import Light, Stage
from nmatrix.spaces.transform import Transform
from nmatrix.studies.hardcases.case import Case, Contestant, exactly

Vector = tuple[float, float, float]

UPRIGHT: Vector = (0.0, 1.0, 0.0)
EASY: Vector = (3.0, 4.0, 12.0)


def _ours(name: str, compute: object) -> Contestant:
    return Contestant(name, compute, is_ours=True)  # type: ignore[arg-type]  # a function without arguments


def _length_case(id_: str, scale: float) -> Case:
    v = tuple(x * scale for x in EASY)
    true = exactly(*(Fraction(x) for x in v))
    return Case(
        id_,
        f"a vector of size {scale:g}",
        f"(3, 4, 12) · {scale:g}",
        true,
        "its square leaves the floats, its direction does not",
        (
            _ours("normalize", lambda: normalize(v)),
            Contestant("v / np.linalg.norm(v)", lambda: _by_norm(v)),
        ),
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
        (
            _ours("normalize", lambda: [sqrt(sum(x * x for x in normalize(v)))]),
            Contestant("v / np.linalg.norm(v)", lambda: [sqrt(sum(x * x for x in _by_norm(v)))]),
        ),
    )


def _arctangent(x: Fraction) -> Fraction:
    """Return atan x for a small x, by its series."""
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
            _ours("angle_between", lambda: [angle_between(a, b)]),
            Contestant("acos(a·b)", lambda: [acos(min(1.0, 1.0 / sqrt(1.0 + size * size)))]),
        ),
    )


def _slanted_angle() -> Case:
    """V3 for a pair off the axes, where the half-angle form is only absolutely accurate."""
    size = 2.0**-46
    a = (1.0, 2.0, 3.0)
    b = (1.0 + 2 * size, 2.0 - size, 3.0)  # a + size · (2, −1, 0), and (2, −1, 0) ⟂ a
    true = _arctangent(_root(Fraction(5, 14)) * Fraction(size))

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
            _ours("angle_between", lambda: [angle_between(a, b)]),
            Contestant("2 atan2(|p−q|, |p+q|)", halves),
        ),
    )


def _root(x: Fraction) -> Fraction:
    """Return √x to 100 bits."""
    from math import isqrt

    return Fraction(isqrt(int(x * (1 << 200))), 1 << 100)


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
            _ours("unit, with a shortest length", ours),
            Contestant("v / np.linalg.norm(v)", lambda: _by_norm(middle[0])),
        ),
    )


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
            _ours(
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
            _ours(
                "look_at",
                lambda: look_at(here, here, UPRIGHT, Handedness.RIGHT).camera_from_world[0],
            ),
            Contestant("two cross products", lambda: _crossed(here, here, UPRIGHT)[0]),
        ),
    )


def _eye_case(id_: str, far: float) -> Case:
    turn = rational.linear(
        rational.rational(
            to_floats(compose(rotation([Angle.degrees(d) for d in (20, 30, 40)]), (1, 1, 1)))
        )
    )
    M = rational.affine(turn, rational_vector((far, far, far)))
    eye = tuple(far + x for x in (3.0, -2.0, 1.0))
    place = Transform(Frame.WORLD, Frame.OBJECT, M)
    V = rational.rational(
        look_at(eye, (far, far, far), UPRIGHT, Handedness.RIGHT).camera_from_world
    )
    camera = Transform(Frame.CAMERA, Frame.WORLD, V)
    stage = Stage(
        place,
        camera,
        rational.identity(4),
        rational_vector(eye),
        Light(rational_vector((0, -1, 0)), None),
    )
    true = place.inverse().exact_point(rational_vector(eye))

    def by_inverse() -> list[float]:
        from nmatrix.enums import Space

        return list(map(float, stage.eye_in(Space.OBJECT)))

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
        (_ours("subtract, then solve", by_inverse), Contestant("(MV)⁻¹ · (0, 0, 0, 1)", course)),
    )


def _no_direction() -> Case:
    return Case(
        "E7",
        "a light that travels nowhere",
        "direction 0 0 0",
        None,
        "it has no direction, and must say so",
        (
            _ours("normalize", lambda: normalize((0.0, 0.0, 0.0))),
            Contestant("v / np.linalg.norm(v)", lambda: _by_norm((0, 0, 0))),
        ),
    )


def _field_case() -> Case:
    half = Angle.degrees(90)
    return Case(
        "D1",
        "a field of view of 180°",
        "fov 180",
        None,
        "the picture would be infinitely wide",
        (
            _ours("perspective", lambda: perspective(half, 1.0, 0.1, 100.0, DEFAULT_CLIP_SPACE)[0]),
            Contestant("1 / tan(fov/2)", lambda: [1 / tan(pi / 2)]),
        ),
    )


def _depth_row(
    id_: str, title: str, far: float, true: tuple[Fraction, ...] | None, reason: str
) -> Case:
    near = 0.1

    def naive() -> list[float]:
        n, f = np.float64(near), np.float64(far)
        return [float((f + n) / (n - f)), float(2 * f * n / (n - f))]

    return Case(
        id_,
        title,
        f"near {near}, far {far:g}",
        true,
        reason,
        (
            _ours(
                "perspective",
                lambda: perspective(Angle.degrees(30), 1.0, near, far, DEFAULT_CLIP_SPACE)[2][2:],
            ),
            Contestant("(f+n)/(n−f)", naive),
        ),
    )


def _told_apart(id_: str, distance: float, gap: float) -> Case:
    """Ask of two surfaces on a line of sight whether a depth buffer knows the nearer one."""
    near, far = 0.1, 1e5
    z = np.array([distance, distance * (1 + gap)])

    def standard(buffer: DepthBuffer) -> list[float]:
        codes = depth_code(far / (far - near) * (1 - near / z), buffer)
        return [float(codes[1] > codes[0])]

    def backwards() -> list[float]:
        codes = depth_code(near / (far - near) * (far / z - 1), DepthBuffer.FLOAT32)
        return [float(codes[1] < codes[0])]

    return Case(
        id_,
        f"two surfaces {gap:g} apart at {distance:g}",
        f"near {near}, far {far:g}",
        exactly(1),
        "reversed depth has its fine steps where perspective needs them",
        (
            _ours("reversed float32", backwards),
            Contestant("float32", lambda: standard(DepthBuffer.FLOAT32)),
            Contestant("24 bits", lambda: standard(DepthBuffer.UNORM24)),
        ),
    )


def _orbit() -> Case:
    """E4: straight up, where up × forward is zero; right follows from the azimuth."""
    from nmatrix.enums import Convention
    from nmatrix.linear.view import first_person

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
        (_ours("first_person", ours), Contestant("two cross products", crossed)),
    )


CASES: tuple[Case, ...] = (
    _length_case("V1", 1e-320 * 4),
    _length_case("V1b", 1e200),
    _length_error("V1c", 1e-160),
    Case("V2", "the zero vector", "(0, 0, 0)", None, "no direction", _no_direction().contestants),
    _angle_case("V3", 1e-9),
    _slanted_angle(),
    _interpolated(),
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
    _no_direction(),
    _field_case(),
    _depth_row("D3", "near = far", 0.1, None, "there is no depth between them"),
    _depth_row(
        "D4",
        "far = inf",
        float("inf"),
        exactly(-1, -2 * Fraction(0.1)),
        "the limit exists, the quotient does not",
    ),
    _told_apart("D6", 9e4, 1e-6),
    _told_apart("D7", 1e3, 1e-6),
)
