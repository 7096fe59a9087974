"""Eye in object space, projections and depth steps: their promises, each with its mutant."""

from __future__ import annotations

from fractions import Fraction
from math import inf

import numpy as np
import pytest

from nmatrix.enums import Convention, DepthRange, Frame, Space
from nmatrix.errors import IllegalValueError, NMatrixError, NoAnswerError
from nmatrix.linear import rational
from nmatrix.linear.affine import compose, rotation
from nmatrix.linear.angle import Angle
from nmatrix.linear.classify import classify
from nmatrix.linear.depthstep import perspective_steps
from nmatrix.linear.projection import ClipSpace, Window, frustum, orthographic, perspective
from nmatrix.scene.camera import View
from nmatrix.scene.lens import Lens
from nmatrix.scene.setup import Setup
from nmatrix.scene.world import World
from nmatrix.spaces.light_and_eye import eye_in
from nmatrix.spaces.transform import Transform


@pytest.mark.parametrize("distance", [1e2, 1e8, 1e12, 1e15])
def test_the_eye_in_object_space_survives_any_translation(distance: float) -> None:
    world = World(translate=(distance, distance, -distance), rotate_degrees=(10, 20, 30))
    eye = (distance + 3, distance - 1, -distance + 2)
    seen = eye_in(Setup(world, View(eye=eye, target=(0, 0, 0))).maps, Space.OBJECT)
    M = world.world_from_object
    difference = [Fraction(e) - row[3] for e, row in zip(eye, M, strict=False)]
    true = rational.apply(rational.inverse(rational.linear_part(M)), difference)
    assert seen.eye == true
    if distance >= 1e8:
        assert seen.relative_difference > 1e-12, "the course's formula must lose digits here"


@pytest.mark.parametrize("depth", list(DepthRange))
def test_infinite_far_is_the_limit(depth: DepthRange) -> None:
    half = Angle.degrees(30)
    limit = perspective(half, 1.5, 0.1, inf, ClipSpace(depth))
    distant = perspective(half, 1.5, 0.1, 1e30, ClipSpace(depth))
    for row, other in zip(limit, distant, strict=True):
        assert row == pytest.approx(other, rel=1e-15, abs=1e-29)


def test_putting_infinity_into_the_formula_gives_nan() -> None:
    n, f = 0.1, np.float64(inf)
    with np.errstate(all="ignore"):
        assert np.isnan((f + n) / (f - n))


@pytest.mark.parametrize(
    ("options", "error"),
    [
        ({"fov_degrees": 0.0}, IllegalValueError),
        ({"fov_degrees": 180.0}, IllegalValueError),
        ({"fov_degrees": 180.1}, IllegalValueError),
        ({"fov_degrees": -1.0}, IllegalValueError),
        ({"near": 0.0}, IllegalValueError),
        ({"near": -1.0}, IllegalValueError),
        ({"near": 2.0, "far": 1.0}, IllegalValueError),
        ({"near": 1.0, "far": 1.0}, NoAnswerError),
        ({"aspect": 0.0}, IllegalValueError),
        ({"ortho": Window(-1, 1, -1, 1), "far": inf}, IllegalValueError),
        ({"ortho": Window(1, 1, -1, 1)}, NoAnswerError),
        ({"frustum": Window(-1, 1, 2, 2)}, NoAnswerError),
    ],
)
def test_illegal_lenses_are_refused(options: dict, error: type[NMatrixError]) -> None:
    with pytest.raises(error) as caught:
        _ = Lens(**options).clip_from_camera
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("fov", [1e-300, 1e-9, 45.0, 179.99999999999997])
def test_extreme_fields_stay_finite(fov: float) -> None:
    P = Lens(fov_degrees=fov).clip_from_camera
    assert P[1][1] > 0


def test_ninety_degrees_and_sixty_are_exact() -> None:
    assert Lens(fov_degrees=90).clip_from_camera[1][1] == 1
    assert Angle.degrees(60).cosine == Fraction(1, 2)
    assert Angle.degrees(90 * 10**6).sine == 0


def worst_step(depth: DepthRange) -> float:
    steps = perspective_steps(0.1, inf, depth)
    return max(step.float32 / step.distance for step in steps if step.float32 is not None)


def test_reversed_depth_resolves_every_distance_alike() -> None:
    assert worst_step(DepthRange.REVERSED) <= 2.4e-7
    assert worst_step(DepthRange.ZERO_TO_ONE) > 1e-3
    assert worst_step(DepthRange.MINUS_ONE_TO_ONE) > 1e-3


def test_a_float32_buffer_agrees_with_the_table() -> None:
    near, z = np.float32(0.1), np.float32(1000.0)
    steps = perspective_steps(0.1, inf, DepthRange.REVERSED)
    step = next(s for s in steps if s.distance > 900)
    assert near / z != near / np.float32(z + 2 * float(step.float32))


@pytest.mark.parametrize("corner", [(-1, -1), (1, 1)])
def test_frustum_and_box_map_their_corners_to_the_cube(corner: tuple[int, int]) -> None:
    window = Window(-2, 3, -1, 4)
    x = window.left if corner[0] < 0 else window.right
    y = window.bottom if corner[1] < 0 else window.top
    for P in (frustum(window, 1, 9), orthographic(window, 1, 9)):
        clip = rational.apply(rational.rational_matrix(P), rational.rational_vector((x, y, -1, 1)))
        assert [float(c / clip[3]) for c in clip[:2]] == pytest.approx(corner, abs=1e-15)


@pytest.mark.parametrize("order", ["XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX"])
def test_small_letters_are_the_reversed_capitals(order: str) -> None:
    turns = [Angle.degrees(x) for x in (10, 20, 30)]
    assert rotation(turns, order) == rotation(turns, order[::-1].lower())


def test_polimi_exchanges_and_mirrors_its_angles() -> None:
    polimi = World(rotate_degrees=(10, 20, 30), convention=Convention.POLIMI).exact
    plain = World(rotate_degrees=(20, -10, -30)).exact
    assert polimi == plain


def test_a_rotation_is_one_to_rounding_and_says_so() -> None:
    built = classify(World(rotate_degrees=(30, 40, 50)).world_from_object)
    assert (built.kind.value, built.kind_exact) == ("rotation", False)
    exact = classify(World(rotate_degrees=(90, 180, -90)).world_from_object)
    assert (exact.kind.value, exact.kind_exact) == ("rotation", True)


@pytest.mark.parametrize(
    ("world", "kind"),
    [
        (World(), "identity"),
        (World(translate=(1e-13, 0, 0)), "translation"),
        (World(translate=(1, 0, 0), rotate_degrees=(0, 30, 0)), "rigid"),
        (World(scale=(2, 2, 2), rotate_degrees=(0, 30, 0)), "similarity"),
        (World(scale=(-3, 3, 3)), "similarity"),
        (World(scale=(1, 2, 1), rotate_degrees=(0, 30, 0)), "non-uniform-scale"),
        (World(shear=(1, 0, 0)), "shear"),
        (World(scale=(1, 0, 1)), "singular"),
        (World(scale=(1e-200, 1e-200, 1e-200)), "similarity"),
    ],
)
def test_kinds(world: World, kind: str) -> None:
    assert classify(world.world_from_object).kind.value == kind


@pytest.mark.parametrize("kappa", [1 + 1e-9, 2.0, 1e4, 1e9, 1e150])
def test_the_worst_angle_is_its_closed_form(kappa: float) -> None:
    import mpmath

    turned = rotation([Angle.degrees(x) for x in (90, 0, 180)])
    found = classify(compose(turned, scale=(kappa, 1, 1))).worst_angle_deg
    with mpmath.workprec(3000):
        k = mpmath.mpf(kappa)
        true = mpmath.degrees(mpmath.atan((k - 1 / k) / 2))
        assert abs(mpmath.mpf(found) - true) <= true * mpmath.mpf("1e-12")


@pytest.mark.parametrize("gap", [1e-3, 1e-9, 2.0**-52])
def test_condition_numbers_are_those_of_a_hundred_digits(gap: float) -> None:
    import mpmath

    rows = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [5.0, 7.0, 9.0 + 9 * gap]]
    found = classify(rows).condition
    with mpmath.workdps(120):
        singular = mpmath.svd_r(mpmath.matrix(rows), compute_uv=False)
        true = singular[0] / singular[2]
        ours = mpmath.mpf(found.numerator) / found.denominator
        assert abs(ours / true - 1) < mpmath.mpf("1e-12")
    if gap < 1e-12:
        assert abs(np.linalg.cond(np.array(rows)) / float(true) - 1) > 1e-6


def test_frames_that_do_not_meet_are_refused() -> None:
    I4 = rational.identity(4)
    camera = Transform(Frame.CAMERA, Frame.WORLD, I4)
    world = Transform(Frame.WORLD, Frame.OBJECT, I4)
    assert (camera @ world).name == "camera_from_object"
    with pytest.raises(IllegalValueError, match=r"world_from_object @ camera_from_world"):
        _ = world @ camera
