"""What the exact level promises (cofactors, signs, ranks, unit normals), each with its mutant.

The oracle is arithmetic on fractions by another formula, or 60 digits of mpmath. Each check is
run a second time on a wrong implementation, which it must refuse.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from itertools import permutations
from math import ulp

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import Matrix, any_matrix, bit_patterns, matrices, near_singular, vectors

from nmatrix.enums import NormalStatus
from nmatrix.linear.angle import angle_between
from nmatrix.linear.exact import LinearMap
from nmatrix.linear.rounding import nearest, normalize, unit
from nmatrix.linear.view import look_at


def leibniz(A: Matrix) -> Fraction:
    """The determinant by permutations: another formula than the one under test."""
    total = Fraction(0)
    for p in permutations(range(3)):
        sign = (-1) ** sum(p[i] > p[j] for i in range(3) for j in range(i + 1, 3))
        total += sign * Fraction(A[0][p[0]]) * Fraction(A[1][p[1]]) * Fraction(A[2][p[2]])
    return total


def minor(A: Matrix, i: int, j: int) -> Fraction:
    rows = [row for k, row in enumerate(A) if k != i]
    (a, b), (c, d) = ([x for k, x in enumerate(row) if k != j] for row in rows)
    return (-1) ** (i + j) * (Fraction(a) * Fraction(d) - Fraction(b) * Fraction(c))


def check_sign(A: Matrix, sign: Callable[[Matrix], int]) -> None:
    det = leibniz(A)
    assert sign(A) == (det > 0) - (det < 0)


@given(any_matrix)
@settings(max_examples=400, deadline=None)
def test_every_cofactor_is_exact(A: Matrix) -> None:
    found = LinearMap.of(A).cofactor_matrix
    assert all(found[i][j] == minor(A, i, j) for i in range(3) for j in range(3))


@given(any_matrix)
@settings(max_examples=400, deadline=None)
def test_the_sign_of_the_determinant_is_exact(A: Matrix) -> None:
    check_sign(A, lambda M: LinearMap.of(M).determinant_sign)


def test_floating_cofactors_are_not_exact() -> None:
    A = near_singular([[0.1, 0.7, -0.3], [0.9, -0.2, 0.4]], 2, 1, 3)
    naive = np.cross(A[0], A[1]).tolist()
    assert any(Fraction(naive[j]) != minor(A, 2, j) for j in range(3))
    found = LinearMap.of(A).cofactor_matrix
    assert all(found[2][j] == minor(A, 2, j) for j in range(3))


def test_a_floating_determinant_gets_signs_wrong() -> None:
    rng = np.random.default_rng(7)
    wrong = 0
    for _ in range(400):
        a, b = rng.normal(size=(2, 3)).tolist()
        A = near_singular([a, b], 2, -3, int(rng.integers(-2, 3)))
        try:
            check_sign(A, lambda M: int(np.sign(np.linalg.det(M))))
        except AssertionError:
            wrong += 1
    assert wrong > 20


@given(any_matrix)
@settings(max_examples=300, deadline=None)
def test_rank_is_that_of_exact_elimination(A: Matrix) -> None:
    from nmatrix.linear.rational import rank, rational_matrix

    assert LinearMap.of(A).rank == rank(rational_matrix(A))


@pytest.mark.parametrize("size", [1e-8, 1e-108, 1e-160, 1e-300, 5e-324, 1e160, 1e300])
def test_a_tiny_or_huge_uniform_scale_is_not_singular(size: float) -> None:
    found = LinearMap.of([[size, 0, 0], [0, size, 0], [0, 0, size]])
    assert (found.rank, found.determinant_sign) == (3, 1)
    assert found.normal((0.6, 0, 0.8)).direction == (0.6, 0.0, 0.8)


def true_unit(C: list[list[Fraction]], n: list[float], sign: int) -> list[mpmath.mpf]:
    v = [sum((c * Fraction(x) for c, x in zip(row, n, strict=True)), Fraction(0)) for row in C]
    big = [sign * mpmath.mpf(x.numerator) / mpmath.mpf(x.denominator) for x in v]
    length = mpmath.sqrt(sum(x * x for x in big))
    return [x / length for x in big]


def half_ulps(found: float, true: mpmath.mpf) -> mpmath.mpf:
    return abs(mpmath.mpf(found) - true) / (mpmath.mpf(ulp(found)) / 2)


def check_unit_normal(A: Matrix, n: list[float], method: Callable[..., list[float]]) -> None:
    C = [[minor(A, i, j) for j in range(3)] for i in range(3)]
    sign = -1 if leibniz(A) < 0 else 1
    with mpmath.workprec(400):
        for component, true in zip(method(A, n), true_unit(C, n, sign), strict=True):
            assert half_ulps(component, true) <= 1 + mpmath.mpf(10) ** -20


@given(any_matrix, vectors)
@settings(max_examples=300, deadline=None)
def test_every_component_of_a_unit_normal_is_correctly_rounded(A: Matrix, n: list[float]) -> None:
    found = LinearMap.of(A).normal(n)
    if found.direction is None:
        return
    with mpmath.workprec(9000):  # sums of numbers from 2⁻¹⁰⁷⁴ to 2¹⁰²⁴, cubed
        check_unit_normal(A, n, lambda M, v: list(LinearMap.of(M).normal(v).direction or ()))


def unsigned(A: Matrix, n: list[float]) -> list[float]:
    found = LinearMap.of(A)
    return list(unit([sum(c * int(x) for c, x in zip(r, n, strict=True)) for r in found.cofactors]))


def test_the_check_refuses_cofactors_without_their_sign() -> None:
    mirror, n = [[-1.0, 0, 0], [0, 1.0, 0], [0, 0, 2.0]], [1.0, 2.0, 3.0]
    check_unit_normal(mirror, n, lambda M, v: list(LinearMap.of(M).normal(v).direction or ()))
    with pytest.raises(AssertionError):
        check_unit_normal(mirror, n, unsigned)


def test_the_check_refuses_numpy() -> None:
    A = near_singular([[0.1, 0.7, -0.3], [0.9, -0.2, 0.4]], 2, 1, 3)
    with pytest.raises(AssertionError):
        check_unit_normal(
            A,
            [1.0, 1.0, 1.0],
            lambda M, v: normalize((np.linalg.inv(M).T @ v).tolist()),  # type: ignore[arg-type]
        )


@given(matrices)
@settings(max_examples=200, deadline=None)
def test_columns_of_the_normal_matrix_are_within_its_bound(A: Matrix) -> None:
    """A column is where an axis goes; the truth is its signed minors, by the textbook."""
    sense = -1 if leibniz(A) < 0 else 1
    for j in range(3):
        column = [sense * minor(A, i, j) for i in range(3)]
        found = LinearMap.of(A).normal([float(i == j) for i in range(3)]).direction
        assert (found is None) == (not any(column))
        if found is not None:
            with mpmath.workprec(400):
                c = [mpmath.mpf(x.numerator) / x.denominator for x in column]
                length = mpmath.sqrt(sum(x * x for x in c))
                error = sum(
                    (mpmath.mpf(f) - x / length) ** 2 for f, x in zip(found, c, strict=True)
                )
                assert mpmath.sqrt(error) <= 3.4e-16


def test_columns_of_a_numpy_inverse_pass_that_bound() -> None:
    rng = np.random.default_rng(2)
    A = np.outer([1, 2, 3], [4, 5, 6]) + 1e-9 * rng.normal(size=(3, 3))
    column = [row[0] for row in LinearMap.of(A.tolist()).cofactors]
    numpy_column = np.linalg.inv(A).T[:, 0].tolist()
    assert angle_between(numpy_column, unit(column)) > 3.4e-16


FLAT = [[1.0, 0, 1], [0, 1, 1], [1, 1, 2]]


def test_rank_two_keeps_the_planes_normal_on_the_cofactor_side() -> None:
    found = LinearMap.of(FLAT).normal((1, 0, 0))
    assert found.status is NormalStatus.TWO_SIDED
    third = 3**-0.5
    assert found.direction == pytest.approx((third, third, -third), abs=1e-15)


@pytest.mark.parametrize(
    ("A", "n", "word"),
    [
        (FLAT, (1, -1, 0), "silhouette"),
        ([[4.0, 5, 6], [8, 10, 12], [12, 15, 18]], (1, 2, 3), "rank 1"),
        ([[0.0] * 3] * 3, (1, 0, 0), "rank 0"),
        ([[1.0, 0, 0], [0, 1, 0], [0, 0, 1]], (0, 0, 0), "zero vector"),
    ],
)
def test_what_has_no_normal_says_why(A: Matrix, n: tuple[float, ...], word: str) -> None:
    found = LinearMap.of(A).normal(n)
    assert found.status is NormalStatus.UNDEFINED
    assert found.direction is None
    assert word in found.reason


@given(
    st.lists(
        st.lists(st.floats(-8, 8).map(lambda x: round(x * 64) / 64), min_size=3, max_size=3),
        min_size=3,
        max_size=3,
    ),
    st.integers(-900, 900),
)
@settings(max_examples=200, deadline=None)
def test_powers_of_two_leave_unit_normals_bit_identical(A: Matrix, k: int) -> None:
    scaled = [[x * 2.0**k for x in row] for row in A]
    n = (0.25, -1.5, 3.0)
    assert LinearMap.of(A).normal(n) == LinearMap.of(scaled).normal(n)


def test_plain_products_are_not_scale_free() -> None:
    turned = np.array([[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]])
    tiny = turned * 2.0**-540
    plain = np.array([np.cross(tiny[1], tiny[2]), np.cross(tiny[2], tiny[0])])
    assert not np.array_equal(plain * 2.0**540 * 2.0**540, np.cross(turned[1], turned[2]))
    n = (0.25, -1.5, 3.0)
    assert LinearMap.of(turned.tolist()).normal(n) == LinearMap.of(tiny.tolist()).normal(n)


@given(any_matrix, vectors)
@settings(max_examples=200, deadline=None)
def test_swapping_two_columns_of_a_and_of_n_keeps_the_normal(A: Matrix, n: list[float]) -> None:
    swapped = [[row[1], row[0], row[2]] for row in A]
    one, other = LinearMap.of(A), LinearMap.of(swapped)
    assert one.determinant_sign == -other.determinant_sign
    if one.determinant_sign:
        assert one.normal(n).direction == other.normal([n[1], n[0], n[2]]).direction


@given(vectors.filter(any))
@settings(max_examples=300, deadline=None)
def test_normalising_any_finite_vector(v: list[float]) -> None:
    found = normalize(v)
    with mpmath.workprec(3000):
        length = mpmath.sqrt(sum(mpmath.mpf(x) ** 2 for x in v))
        error = mpmath.sqrt(
            sum((mpmath.mpf(f) - x / length) ** 2 for f, x in zip(found, v, strict=True))
        )
        assert error <= 1.2e-16
        assert abs(mpmath.sqrt(sum(mpmath.mpf(f) ** 2 for f in found)) - 1) <= 4.5e-16


def test_the_usual_normalisation_fails_on_the_same_vectors() -> None:
    v = np.array([3.0, 4.0, 12.0]) * 1e-160
    naive = v / np.linalg.norm(v)
    assert abs(np.sqrt((naive**2).sum()) - 1) > 1e-6
    assert normalize(v.tolist()) == pytest.approx((3 / 13, 4 / 13, 12 / 13), rel=1e-15)


def check_angle(a: list[float], b: list[float], method: Callable[..., float]) -> None:
    with mpmath.workprec(9000):
        p, q = ([mpmath.mpf(x) for x in v] for v in (a, b))
        cross = [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
        dot = sum(x * y for x, y in zip(p, q, strict=True))
        true = mpmath.atan2(mpmath.sqrt(sum(c * c for c in cross)), dot)
        if 0 < true < mpmath.mpf("2.3e-308"):
            return
        assert abs(mpmath.mpf(method(a, b)) - true) <= true * mpmath.mpf("1e-15")


@given(vectors.filter(any), vectors.filter(any))
@settings(max_examples=150, deadline=None)
def test_angles_are_right_to_a_relative_error(a: list[float], b: list[float]) -> None:
    check_angle(a, b, angle_between)


@pytest.mark.parametrize("t", [1e-200, 1e-100, 1e-14, 1e-9, 1e-3])
def test_small_angles_between_slanted_vectors(t: float) -> None:
    a, b = [1.0, 2.0, 3.0], [1.0 + 2 * t, 2.0 - t, 3.0]
    check_angle(a, b, angle_between)


def test_acos_loses_small_angles() -> None:
    def by_acos(a: list[float], b: list[float]) -> float:
        u, v = np.array(normalize(a)), np.array(normalize(b))
        return float(np.arccos(np.clip(u @ v, -1, 1)))

    with pytest.raises(AssertionError):
        check_angle([1.0, 0, 0], [1.0, 1e-9, 0], by_acos)


points = st.lists(st.one_of(bit_patterns, st.floats(-100, 100)), min_size=3, max_size=3)


def orthonormality(rows: tuple[tuple[float, ...], ...]) -> float:
    R = [[Fraction(x) for x in row[:3]] for row in rows[:3]]
    gram = [[sum(a * b for a, b in zip(p, q, strict=True)) for q in R] for p in R]
    return max(abs(float(gram[i][j] - (i == j))) for i in range(3) for j in range(3))


@given(points, points, points.filter(any))
@settings(max_examples=300, deadline=None)
def test_look_at_is_orthonormal_wherever_the_camera_is(
    eye: list[float], target: list[float], up: list[float]
) -> None:
    if eye == target:
        return
    found = look_at(eye, target, up)
    assert orthonormality(found.camera_from_world) <= 1e-15


@pytest.mark.parametrize("eps", [1e-2, 1e-8, 1e-12, 1e-16])
def test_look_at_with_up_almost_along_the_view(eps: float) -> None:
    found = look_at((0, 0, 0), (1, 2, 3), (1 + eps, 2 - 3 * eps, 3))
    assert orthonormality(found.camera_from_world) <= 1e-15


def test_floating_cross_products_lose_the_frame() -> None:
    forward = np.array([1.0, 2.0, 3.0])
    right = np.cross(forward, forward * (1 + 1e-13) + [0, 1e-14, 0])
    upward = np.cross(right, forward)
    R = np.array([v / np.linalg.norm(v) for v in (right, upward, forward)])
    assert np.abs(R @ R.T - np.eye(3)).max() > 1e-15


def test_up_along_the_view_is_deterministic_and_said() -> None:
    first, second = (look_at((0, 0, 0), (0, 1, 0), (0, 1, 0)) for _ in range(2))
    assert first == second
    assert first.stand_in == (0, 0, 1)
    assert [-x for x in first.camera_from_world[2][:3]] == [0, 1, 0]


@pytest.mark.parametrize(
    ("ahead", "up", "stand_in"),
    [
        ((0, -1, 0), (0, 1, 0), (0, 0, -1)),  # straight down
        ((0, 1, 0), (0, 1, 0), (0, 0, 1)),  # straight up
        ((0, 0, -1), (0, 0, 1), (0, 1, 0)),  # straight down where z is up
        ((0, 0, 1), (0, 0, 1), (0, -1, 0)),
    ],
)
def test_a_view_along_up_is_the_limit_of_a_tilted_camera(
    ahead: tuple[int, ...], up: tuple[int, ...], stand_in: tuple[int, ...]
) -> None:
    found = look_at((0, 0, 0), ahead, up)
    assert found.stand_in == stand_in
    assert found.camera_from_world[0][:3] == (1, 0, 0)
    assert found.camera_from_world[1][:3] == stand_in
    assert found.camera_from_world == look_at((0, 0, 0), ahead, stand_in).camera_from_world
    sense = -sum(a * u for a, u in zip(ahead, up, strict=True)) / 1e9
    nearly = [a + sense * s for a, s in zip(ahead, stand_in, strict=True)]
    tilted = look_at((0, 0, 0), nearly, up)
    for row, near in zip(found.camera_from_world, tilted.camera_from_world, strict=True):
        assert [float(x) for x in row] == pytest.approx([float(x) for x in near], abs=2e-9)


@given(points.filter(any))
def test_any_view_along_up_has_a_frame_and_its_stand_in_gives_the_same(ahead: list[float]) -> None:
    found = look_at((0, 0, 0), ahead, ahead)
    assert found.stand_in is not None
    assert orthonormality(found.camera_from_world) <= 1e-15
    assert look_at((0, 0, 0), ahead, found.stand_in).camera_from_world == found.camera_from_world
    assert found.camera_from_world[0][0] >= 0


def test_nearest_is_half_even() -> None:
    assert nearest(Fraction(2**54 + 2, 2)) == 2.0**53
    assert nearest(Fraction(2**54 + 6, 2)) == 2.0**53 + 4
