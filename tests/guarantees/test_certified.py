"""What the certified level promises, against exact arithmetic: bounds, signs, zeros, scales.

Each check is run a second time on a wrong implementation, which it must refuse.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from itertools import product

import numpy as np
import pytest

import nmatrix
from nmatrix.enums import Level
from nmatrix.linear import compensated
from nmatrix.linear.angle import exact_angle_between
from nmatrix.linear.certified import STATUSES, Normals, certified_normals, determinants
from nmatrix.linear.compensated import AFTER, NEXT, UNIT, cofactors, two_product
from nmatrix.linear.exact import LinearMap
from nmatrix.linear.rounding import integers, nearest

Array = np.ndarray


def rotations(rng: np.random.Generator, count: int) -> Array:
    return np.linalg.qr(rng.normal(size=(count, 3, 3)))[0]


def conditioned(rng: np.random.Generator, count: int, kappa: float) -> tuple[Array, Array]:
    """Matrices with singular values 1, κ^-½, 1/κ, and normals that all but cancel in N n."""
    U, V = rotations(rng, count), rotations(rng, count)
    A = U * np.array([1, kappa**-0.5, 1 / kappa]) @ V
    return A, V[:, 0] + 1e-9 * rng.normal(size=(count, 3))


def near_singular(rng: np.random.Generator, count: int) -> Array:
    A = rng.normal(size=(count, 3, 3))
    A[:, 2] = 2 * A[:, 0] - A[:, 1]
    A[:, 2, 0] += rng.integers(-2, 3, count) * np.spacing(A[:, 2, 0])
    return A


def bit_patterns(rng: np.random.Generator, count: int) -> Array:
    found = rng.integers(0, 2**64, size=(count, 3, 3), dtype=np.uint64).view(np.float64)
    return np.where(np.isfinite(found), found, 0.0)


def families(count: int, seed: int = 5) -> dict[str, Array]:
    rng = np.random.default_rng(seed)
    scales = 2.0 ** rng.integers(-500, 500, size=(count, 1, 1))
    return {
        "ordinary": rng.normal(size=(count, 3, 3)),
        "near singular": near_singular(rng, count),
        "near singular, any scale": near_singular(rng, count) * scales,
        "bit patterns": bit_patterns(rng, count),
        "subnormal": rng.integers(-9, 10, size=(count, 3, 3)) * 5e-324,
        "small integers": rng.integers(-2, 3, size=(count, 3, 3)).astype(float),
        "κ = 1e12": conditioned(rng, count, 1e12)[0],
    }


def true_cofactor(A: Array, i: int, j: int) -> Fraction:
    r, s, k, m = NEXT[i], AFTER[i], NEXT[j], AFTER[j]
    F = Fraction
    return F(A[r, k]) * F(A[s, m]) - F(A[r, m]) * F(A[s, k])


def check_cofactors(matrices: Array, compute: Callable[[Array], compensated.Scaled]) -> float:
    """Check signs and zeros, and return the worst relative error in units of u."""
    turned = np.ascontiguousarray(matrices.transpose(1, 2, 0))
    mantissa, exponent = compute(turned)
    exponent, worst = np.broadcast_to(exponent, mantissa.shape), 0.0
    for t, i, j in product(range(len(matrices)), range(3), range(3)):
        true = true_cofactor(matrices[t], i, j)
        power = Fraction(2) ** int(exponent[i, j, t])
        value = Fraction(float(mantissa[i, j, t])) * power
        assert (value > 0) - (value < 0) == (true > 0) - (true < 0)
        if true:
            worst = max(worst, float(abs(value - true) / abs(true) / Fraction(UNIT)))
    return worst


@pytest.mark.parametrize("name", families(1))
def test_every_cofactor_is_within_two_units_with_its_sign(name: str) -> None:
    assert check_cofactors(families(120)[name], cofactors) <= 2.0


def plain(A: Array) -> compensated.Scaled:
    out = np.empty_like(A)
    for i, j in product(range(3), range(3)):
        r, s, k, m = NEXT[i], AFTER[i], NEXT[j], AFTER[j]
        out[i, j] = A[r, k] * A[s, m] - A[r, m] * A[s, k]
    return compensated.Scaled(out, np.zeros(A.shape, np.int32))


def one_scale(A: Array) -> compensated.Scaled:
    """One power of two for a whole matrix: not enough where exponents differ."""
    size = np.frexp(np.abs(A).max(axis=(0, 1)))[1]
    space = compensated.Workspace.of(A.shape[2])
    np.copyto(space.entries.block, np.ldexp(A, -size))
    found = space.cofactors()
    return compensated.Scaled(found, np.broadcast_to(2 * size, A.shape))


@pytest.mark.parametrize(
    ("name", "mutant"), [("near singular", plain), ("bit patterns", one_scale)]
)
def test_plain_cofactors_and_one_scale_are_refused(name: str, mutant: Callable) -> None:
    with np.errstate(all="ignore"), pytest.raises((AssertionError, OverflowError, ValueError)):
        assert check_cofactors(families(120)[name], mutant) <= 2.0


def test_the_bound_holds_exhaustively_at_a_toy_precision() -> None:
    """Every pair of products of 4-bit numbers, in integers: the same sums, rounded to 4 bits."""
    assert toy_worst(bits=4) <= 2.0
    assert toy_worst(bits=4, compensated_sum=False) > 100


def toy_round(value: int, bits: int) -> int:
    """Round an integer to so many significant bits, ties to even."""
    drop = max(0, abs(value).bit_length() - bits)
    whole, rest = divmod(abs(value), 1 << drop)
    half = 1 << (drop - 1) if drop else 0
    up = drop and (rest > half or (rest == half and whole & 1))
    return (whole + bool(up) << drop) * (1 if value >= 0 else -1)


def toy_worst(*, bits: int, compensated_sum: bool = True) -> float:
    """Return the worst error of a·d − b·c in units in the last place, over all significands."""
    worst = 0.0
    numbers = range(1 << (bits - 1), 1 << bits)
    for a, d, b, c in product(numbers, repeat=4):
        for shift in (0, 1, 2):
            p, q = a * d << 2, b * c << shift
            if p == q:
                continue
            p_high, q_high = toy_round(p, bits), toy_round(q, bits)
            found = toy_round(p_high - q_high, bits)
            if compensated_sum:
                found = toy_round(found + toy_round((p - p_high) - (q - q_high), bits), bits)
            worst = max(worst, abs(found - (p - q)) / abs(p - q) * 2**bits)
    return worst


def true_angle(linear_map: LinearMap, normal: Array, found: Array) -> float:
    sign = -1 if linear_map.integer_determinant < 0 else 1
    n = [Fraction(x) for x in normal.tolist()]
    carried = [
        sign * sum(c * x for c, x in zip(row, n, strict=True)) for row in linear_map.cofactors
    ]
    return nearest(exact_angle_between(integers(carried)[0], integers(found.tolist())[0]))


def check_normals(A: Array, n: Array, compute: Callable = certified_normals) -> None:
    with np.errstate(all="ignore"):
        found = compute(np.ascontiguousarray(A.transpose(1, 2, 0)), np.ascontiguousarray(n.T))
    assert np.isfinite(found.directions).all()
    assert (found.bound_rad <= 1e-14).all()
    for i, matrix in enumerate(A.tolist()):
        linear_map = LinearMap.of(matrix)
        exact = linear_map.normal(n[i].tolist())
        assert STATUSES[found.status[i]] is exact.status
        if exact.direction is None:
            assert not found.directions[:, i].any()
        else:
            assert true_angle(linear_map, n[i], found.directions[:, i]) <= found.bound_rad[i]


def directed(count: int, seed: int) -> list[tuple[Array, Array]]:
    rng = np.random.default_rng(seed)
    cases = [(A, rng.normal(size=(count, 3))) for A in families(count, seed).values()]
    cases += [conditioned(rng, count, kappa) for kappa in (1e4, 1e8, 1e12, 1e16)]
    flat = rng.integers(-2, 3, size=(count, 3, 3)).astype(float)
    return [*cases, (flat, rng.integers(-1, 2, size=(count, 3)).astype(float))]


def test_the_reported_bound_covers_the_true_angle() -> None:
    for A, n in directed(40, 7):
        check_normals(A, n)


@pytest.mark.slow
def test_the_bound_covers_a_hundred_thousand_directed_cases() -> None:
    for seed in range(9):
        for A, n in directed(1000, seed):
            check_normals(A, n)


def dropped_sign(A: Array, n: Array) -> Normals:
    found = certified_normals(A, n)
    found.directions[:] *= np.where(np.linalg.det(A.transpose(2, 0, 1)) < 0, -1.0, 1.0)
    return found


def optimistic(A: Array, n: Array) -> Normals:
    """Trust plain sums everywhere, and claim the bound."""
    carried = (cofactors(A).mantissa * n).sum(axis=1)
    unit = carried / np.sqrt((carried * carried).sum(axis=0))
    found = certified_normals(A, n)
    found.directions[:] = unit * np.where(np.linalg.det(A.transpose(2, 0, 1)) < 0, -1.0, 1.0)
    return found


@pytest.mark.parametrize("mutant", [dropped_sign, optimistic])
def test_wrong_signs_and_optimistic_bounds_are_refused(mutant: Callable) -> None:
    A, n = conditioned(np.random.default_rng(3), 40, 1e8)
    A[::2] *= -1  # mirrors
    with np.errstate(all="ignore"), pytest.raises(AssertionError):
        check_normals(A, n, mutant)


def test_determinants_are_correctly_rounded() -> None:
    for A in families(150).values():
        with np.errstate(all="ignore"):
            found = determinants(np.ascontiguousarray(A.transpose(1, 2, 0)))
        for i, matrix in enumerate(A.tolist()):
            power = Fraction(2) ** int(found.exponent[i])
            true = LinearMap.of(matrix).determinant / power  # near 1, as is the mantissa
            assert float(found.mantissa[i]) == nearest(true)


@pytest.mark.parametrize("power", [-900, -300, -3, 7, 400, 900])
def test_a_power_of_two_changes_no_bit_of_a_normal(power: int) -> None:
    rng = np.random.default_rng(2)
    A, n = rng.normal(size=(3, 3, 50)), rng.normal(size=(3, 50))
    once, again = certified_normals(A, n), certified_normals(np.ldexp(A, power), n)
    assert (once.directions == again.directions).all()


def oriented(A: Array, level: Level) -> Array:
    return nmatrix.normal_matrix(A, kind="oriented", level=level)


def test_swapped_columns_flip_the_sign_of_the_cofactors() -> None:
    rng = np.random.default_rng(4)
    A = rng.normal(size=(60, 3, 3))
    swapped = A[:, :, [1, 0, 2]]
    once, again = (oriented(one, Level.CERTIFIED) for one in (A, swapped))
    # sign(det) turns with the cofactors, so outward normal matrices only permute
    assert (once[:, :, [1, 0, 2]] == again).all()


@pytest.mark.parametrize("level", [Level.CERTIFIED, Level.GUARDED, Level.EXACT])
def test_levels_agree_in_direction(level: Level) -> None:
    A = families(200)["ordinary"]
    exact = oriented(A, Level.EXACT)
    found = oriented(A, level)
    assert np.abs(found / exact - 1).max() < (1e-9 if level is Level.GUARDED else 4e-16)


def test_the_guarded_level_is_never_worse_than_four_times_an_inverse() -> None:
    rng = np.random.default_rng(8)
    for kappa in (1e1, 1e4, 1e8, 1e12):
        A, _ = conditioned(rng, 150, kappa)
        exact = oriented(A, Level.EXACT)
        guarded = oriented(A, Level.GUARDED)
        with np.errstate(all="ignore"):
            inverse = np.linalg.inv(A).transpose(0, 2, 1)
        ours, theirs = (worst_column_angle(one, exact) for one in (guarded, inverse))
        assert ours <= 4 * theirs + 4 * UNIT


def worst_column_angle(found: Array, exact: Array) -> float:
    """Return the worst angle between columns as lines."""
    a, b = (one / np.linalg.norm(one, axis=1, keepdims=True) for one in (found, exact))
    return float(np.linalg.norm(np.cross(a, b, axis=1), axis=1).max())


def test_without_its_guard_plain_cofactors_would_be_worse(monkeypatch) -> None:
    monkeypatch.setattr("nmatrix.linear.plain.STEEP", 0.0)
    A = near_singular(np.random.default_rng(1), 400)
    exact = oriented(A, Level.EXACT)
    found = oriented(A, Level.GUARDED)
    assert (np.sign(found) != np.sign(exact)).any()


def test_float32_products_are_exact_in_float64() -> None:
    A = families(100)["near singular"].astype(np.float32)
    found = oriented(A, Level.CERTIFIED)
    assert found.dtype == np.float32
    exact = oriented(A.astype(np.float64), Level.EXACT)
    assert np.abs(found - exact).max() <= np.abs(exact).max() * 2.0**-24


def test_products_are_exact() -> None:
    rng = np.random.default_rng(6)
    for a, b in rng.normal(size=(200, 2)).tolist():
        high, low = two_product(np.float64(a), np.float64(b))
        assert Fraction(float(high)) + Fraction(float(low)) == Fraction(a) * Fraction(b)
