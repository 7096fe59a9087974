"""Arrays of matrices and normals (G21): every level, float type, size and overlap, any exponents.

The oracle is arithmetic on fractions by another formula than the ones under test.
"""

from __future__ import annotations

import inspect
import tracemalloc
from collections.abc import Callable
from contextlib import suppress
from decimal import Decimal
from fractions import Fraction
from itertools import product
from typing import Any

import mpmath
import numpy as np
import pytest
from numpy.typing import NDArray

import nmatrix
from nmatrix.enums import Level, NormalMatrixKind, NormalStatus
from nmatrix.errors import IllegalValueError, NoAnswerError
from nmatrix.linear import batched, compensated, plain
from nmatrix.linear.exact import LinearMap
from nmatrix.studies.hardcases.families import NORMAL_FAMILIES

Array = NDArray[Any]
Matrix = list[list[Fraction]]
ORIENTED, INVERSE = NormalMatrixKind.ORIENTED, NormalMatrixKind.INVERSE_TRANSPOSE
U = Fraction(1, 2**53)
FLOATS = (np.float32, np.float64)
RELATIVE = {  # of every entry, before the rounding to the type of the output
    (ORIENTED, Level.EXACT): U,
    (ORIENTED, Level.CERTIFIED): 2 * U,
    (INVERSE, Level.EXACT): U,
    (INVERSE, Level.CERTIFIED): 4 * U,
}
PLAIN = Fraction(1, 2**36)  # what the guarded level promises, of the largest entry or in radians


@pytest.fixture
def _small_chunks(monkeypatch: pytest.MonkeyPatch) -> None:
    for module, name, size in (
        (compensated, "CHUNK", 16),
        (plain, "CHUNK", 16),
        (batched, "PAIRS_CHUNK", 16),
        (batched, "LONG_CHUNK", 32),
        (batched, "ENOUGH", 5),
    ):
        monkeypatch.setattr(module, name, size)


def of_type(dtype: type, values: Any) -> Array:
    """Values in a type; what it does not hold becomes 1."""
    with np.errstate(all="ignore"):
        found = np.array(values, dtype)
    found[~np.isfinite(found)] = 1
    return found


def any_bits(rng: np.random.Generator, shape: tuple[int, ...], dtype: type) -> Array:
    size = np.dtype(dtype).itemsize
    found = rng.integers(0, 2 ** (8 * size), size=shape, dtype=f"u{size}").view(dtype)
    return np.where(np.isfinite(found), found, dtype(1))


def families(dtype: type, count: int, seed: int = 1) -> dict[str, Array]:
    """Matrices that are hard in different ways, all of one float type."""
    rng = np.random.default_rng(seed)
    ordinary = rng.normal(size=(count, 3, 3))
    top = np.finfo(dtype).maxexp - 4
    ladders = rng.choice([-1.0, 1.0], (count, 3, 3)) * 2.0 ** rng.integers(-top, top, (count, 3, 3))
    near = ordinary.copy()
    near[:, 2] = 2 * near[:, 0] - near[:, 1] + rng.integers(-1, 2, (count, 3)) * 2.0**-52
    flat = rng.integers(-2, 3, (count, 3, 3)) * np.array([1.0, 1.0, 0.0])
    corners = np.zeros((count, 3, 3))
    corners[:, range(3), range(3)] = 2.0 ** rng.integers(-top, top, (count, 3))
    upper = np.triu(2.0 ** rng.integers(-top, 0, (count, 3, 3)))
    upper[:, range(3), range(3)] = 1.0  # far from singular, and a cofactor that only a scale holds
    upper[::2, 0, 2] = 0.0
    found = {
        "ordinary": ordinary,
        "any scale": ordinary * 2.0 ** rng.integers(-top, top, (count, 1, 1)),
        "near singular": near,
        "flat": flat,
        "small integers": rng.integers(-2, 3, (count, 3, 3)).astype(float),
        "ladders": ladders,
        "corners": corners,
        "upper": upper,
    }
    found = {name: of_type(dtype, matrices) for name, matrices in found.items()}
    return {**found, "any bits": any_bits(rng, (count, 3, 3), dtype)}


NAMES = tuple(families(np.float64, 1))


def minors(A: Array) -> Matrix:
    """Cofactors by the textbook: strike out a row and a column."""
    F = [[Fraction(float(x)) for x in row] for row in A]
    found = []
    for i in range(3):
        rows = [row for k, row in enumerate(F) if k != i]
        kept = [[[x for m, x in enumerate(row) if m != j] for row in rows] for j in range(3)]
        found.append([(-1) ** (i + j) * (a * d - b * c) for j, ((a, b), (c, d)) in enumerate(kept)])
    return found


def determinant(A: Array) -> Fraction:
    return sum(
        (Fraction(float(a)) * c for a, c in zip(A[0], minors(A)[0], strict=True)), Fraction(0)
    )


def log2(x: Fraction) -> int:
    """The exponent e of 2ᵉ ≤ |x| < 2ᵉ⁺¹."""
    e = abs(x.numerator).bit_length() - x.denominator.bit_length()
    return e - (abs(x) < Fraction(2) ** e)


def check_entries(found: Array, true: Matrix, relative: Fraction, absolute: Fraction) -> None:
    """Each entry is within a part of its own size and an absolute error, and one rounding."""
    limits = np.finfo(found.dtype)
    least = Fraction(float(limits.smallest_subnormal))
    if found.dtype != np.float64:
        relative += (1 + relative) * Fraction(float(limits.eps)) / 2
    for x, y in zip(found.ravel(), flat(true), strict=True):
        subnormal = abs(y) < Fraction(float(limits.tiny))
        assert abs(Fraction(float(x)) - y) <= relative * abs(y) + absolute + subnormal * least
        assert absolute or subnormal or np.sign(float(x)) == (y > 0) - (y < 0)


def flat(matrix: Matrix) -> list[Fraction]:
    return [x for row in matrix for x in row]


def check_oriented(A: Array, found: Array, level: Level) -> None:
    sign = -1 if determinant(A) < 0 else 1
    true = [[sign * c for c in row] for row in minors(A)]
    nonzero = [abs(c) for c in flat(true) if c]
    if not nonzero:
        assert not found.any()
        return
    limits = np.finfo(found.dtype)
    most, least = max(nonzero), log2(Fraction(float(limits.smallest_subnormal)))
    k = log2(Fraction(float(np.abs(found).max())) / most * Fraction(1025, 1024))
    fits = min(nonzero) >= 2 * float(limits.tiny) and most <= float(limits.max) / 2
    assert k == 0 or not fits  # as it is, wherever the type holds it
    scaled = [[c * Fraction(2) ** k for c in row] for row in true]
    if level is Level.GUARDED:
        check_entries(found, scaled, Fraction(0), PLAIN * max(map(abs, flat(scaled))))
    else:
        check_entries(found, scaled, RELATIVE[ORIENTED, level], Fraction(0))
    for x, c in zip(found.ravel(), flat(true), strict=True):
        cancels = level is Level.GUARDED and abs(c) > PLAIN * most  # plain cofactors may
        assert x or not c or cancels or log2(c) <= log2(most) - (limits.maxexp - 1) + least


def check_inverse(A: Array, found: Array, level: Level) -> None:
    det = determinant(A)
    true = [[c / det for c in row] for row in minors(A)]
    if level is Level.GUARDED:
        check_entries(found, true, Fraction(0), PLAIN * max(map(abs, flat(true))))
    else:
        check_entries(found, true, RELATIVE[INVERSE, level], Fraction(0))


@pytest.mark.usefixtures("_small_chunks")
@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("dtype", (np.float16, *FLOATS))
@pytest.mark.parametrize("level", Level)
def test_oriented_matrices_keep_signs_and_entries_at_any_exponents(
    level: Level, dtype: type, name: str
) -> None:
    A = families(dtype, 40)[name]
    found = nmatrix.normal_matrix(A, kind=ORIENTED, level=level)
    assert found.dtype == dtype
    for matrix, one in zip(A, found, strict=True):
        check_oriented(matrix, one, level)


@pytest.mark.parametrize("level", Level)
@pytest.mark.parametrize(
    ("dtype", "scales"),
    ((np.float16, (1.5 * 2.0**15, 1, 2.0**-24)), (np.float64, (1.5 * 2.0**1023, 1, 2.0**-1074))),
)
def test_the_whole_range_of_a_type_is_used_before_an_entry_is_lost(
    level: Level, dtype: type, scales: tuple[float, ...]
) -> None:
    A = np.diag(scales).astype(dtype)
    found = nmatrix.normal_matrix(A, kind=ORIENTED, level=level)
    assert (found.diagonal() > 0).all()
    assert found[2, 2] > np.finfo(dtype).max / 4


def test_exact_entries_that_come_out_subnormal_are_rounded_once() -> None:
    """A bit or two below the normal numbers, where two roundings differ most often."""
    rng = np.random.default_rng(8)
    subnormal = 0
    for _ in range(300):
        A = np.tril(rng.uniform(1, 2, (3, 3)))
        A[0, 0], A[2, 2] = np.ldexp(A[0, 0], 1023), np.ldexp(A[2, 2], rng.integers(-1027, -1023))
        found = nmatrix.normal_matrix(A, kind=ORIENTED)
        k = log2(Fraction(found[2, 2]) / minors(A)[2][2] * Fraction(1025, 1024))
        assert found.ravel().tolist() == [float(c * Fraction(2) ** k) for c in flat(minors(A))]
        subnormal += 0 < found[0, 0] < np.finfo(float).tiny
    assert subnormal > 200


@pytest.mark.usefixtures("_small_chunks")
@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("dtype", (np.float16, *FLOATS))
@pytest.mark.parametrize("level", Level)
def test_inverse_transposes_are_right_or_refused_with_their_index(
    level: Level, dtype: type, name: str
) -> None:
    A = families(dtype, 40)[name]
    largest = Fraction(float(np.finfo(dtype).max))
    kept = []
    for i, matrix in enumerate(A):
        det = determinant(matrix)
        if det == 0:
            with pytest.raises(NoAnswerError, match=r"A\[1\]: its determinant is exactly 0"):
                nmatrix.normal_matrix([np.eye(3), matrix], level=level)
        elif max(map(abs, flat(minors(matrix)))) / abs(det) >= largest:
            with pytest.raises(IllegalValueError, match=r"A\[0\]: its inverse transpose has"):
                nmatrix.normal_matrix(matrix[None], level=level)
        else:
            kept.append(i)
    found = nmatrix.normal_matrix(A[kept], level=level)
    for matrix, one in zip(A[kept], found, strict=True):
        check_inverse(matrix, one, level)


Overlap = Callable[[Array], tuple[Array, Array]]
OVERLAPS: dict[str, Overlap] = {
    "itself": lambda Y: (Y, Y),
    "reversed": lambda Y: (Y, Y[::-1]),
    "up by one": lambda Y: (Y[:-1], Y[1:]),
    "down by one": lambda Y: (Y[1:], Y[:-1]),
    "transposed": lambda Y: (Y, Y.swapaxes(-1, -2) if Y.ndim > 2 else Y[:, ::-1]),
    "every other": lambda Y: (Y[::2], Y[: (len(Y) + 1) // 2]),
    "half of its bytes": lambda Y: (Y, Y.view(f"f{Y.itemsize // 2}")[..., ::2]),
}


@pytest.mark.usefixtures("_small_chunks")
@pytest.mark.parametrize("count", [1, 15, 16, 17, 100])
@pytest.mark.parametrize("dtype", FLOATS)
@pytest.mark.parametrize("level", Level)
def test_the_output_may_overlap_the_input_in_any_way(level: Level, dtype: type, count: int) -> None:
    few = families(dtype, count)
    mixed = np.concatenate([few["ordinary"], few["near singular"], few["any scale"]])[::3].copy()
    for overlap, kind in product(OVERLAPS.values(), (ORIENTED, INVERSE)):
        given, out = overlap(mixed.copy() if kind is ORIENTED else few["ordinary"].copy())
        apart = nmatrix.normal_matrix(given.copy(), kind=kind, level=level, out=np.empty_like(out))
        assert nmatrix.normal_matrix(given, kind=kind, level=level, out=out) is out
        assert np.array_equal(out, apart)


@pytest.mark.usefixtures("_small_chunks")
@pytest.mark.parametrize("count", [1, 15, 16, 17, 100])
@pytest.mark.parametrize("dtype", FLOATS)
@pytest.mark.parametrize("level", Level)
def test_normals_may_be_written_over_themselves(level: Level, dtype: type, count: int) -> None:
    A = families(dtype, count)["ordinary"]
    n = of_type(dtype, np.random.default_rng(3).normal(size=(count, 3)) * [1, 1, 1e-3])
    for overlap, is_one in product(OVERLAPS.values(), (True, False)):
        given, out = overlap(n.copy())
        maps = A[0] if is_one else A[: len(given)]
        apart = nmatrix.transform_normals(maps, given.copy(), level=level, out=np.empty_like(out))
        assert nmatrix.transform_normals(maps, given, level=level, out=out) is out
        assert np.array_equal(out, apart)
    maps = A.copy()
    apart = nmatrix.transform_normals(A, n, level=level)
    assert np.array_equal(nmatrix.transform_normals(maps, n, level=level, out=maps[:, 1]), apart)


def test_real_chunks_are_crossed_in_place() -> None:
    A = np.random.default_rng(5).normal(size=(12_000, 3, 3))
    A[::100] = [[1, 1, 1], [1, 1 + 1e-12, 1], [1, 1, 1 + 1e-12]]
    for level, overlap in product((Level.CERTIFIED, Level.GUARDED), OVERLAPS.values()):
        given, out = overlap(A.copy())
        apart = nmatrix.normal_matrix(given, kind=ORIENTED, level=level, out=np.empty_like(out))
        nmatrix.normal_matrix(given, kind=ORIENTED, level=level, out=out)
        assert np.array_equal(out, apart)


def check_normals(A: Array, n: Array, found: nmatrix.TransformedNormals, limit: float) -> None:
    """Statuses are exact, and every true angle is within its bound, and that within the limit."""
    assert (found.bound_rad <= limit).all()
    assert np.isfinite(found.normals).all()
    for i, (matrix, normal) in enumerate(zip(A, n, strict=True)):
        C, det = minors(matrix), determinant(matrix)
        v = [Fraction(float(x)) for x in normal]
        true = [sum((c * x for c, x in zip(row, v, strict=True)), Fraction(0)) for row in C]
        if not any(true):
            assert found.status[i] == NormalStatus.UNDEFINED
            assert not found.normals[i].any()
            continue
        assert found.status[i] == (NormalStatus.OK if det else NormalStatus.TWO_SIDED)
        assert angle(found.normals[i], true, -1 if det < 0 else 1) <= found.bound_rad[i]


def angle(found: Array, true: list[Fraction], sign: int) -> float:
    with mpmath.workprec(300):
        biggest = max(map(abs, true))
        a = [mpmath.mpf(float(x)) for x in found]
        b = [sign * mpmath.mpf((x / biggest).numerator) / (x / biggest).denominator for x in true]
        cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        dot = sum(x * y for x, y in zip(a, b, strict=True))
        return float(mpmath.atan2(mpmath.sqrt(sum(c * c for c in cross)), dot))


LIMITS = {
    (np.float64, Level.EXACT): 1e-15,
    (np.float64, Level.CERTIFIED): 1e-14,
    (np.float64, Level.GUARDED): 2.0**-36,
    (np.float32, Level.EXACT): 1e-7,
    (np.float32, Level.CERTIFIED): 1e-7,
    (np.float32, Level.GUARDED): 2.0**-17 + 1e-7,
}


@pytest.mark.usefixtures("_small_chunks")
@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("dtype", FLOATS)
@pytest.mark.parametrize("level", Level)
def test_normals_are_within_their_bounds_and_their_statuses_exact(
    level: Level, dtype: type, name: str
) -> None:
    A = families(dtype, 40)[name]
    rng = np.random.default_rng(9)
    for n in (
        of_type(dtype, rng.normal(size=(40, 3))),
        of_type(dtype, rng.integers(-1, 2, (40, 3)).astype(float)),
        any_bits(rng, (40, 3), dtype),
    ):
        found = nmatrix.transform_normals(A, n, level=level, status=True)
        check_normals(A, n, found, LIMITS[dtype, level])
        assert found.normals.dtype == dtype
        for matrix in A[:2]:  # one for all
            found = nmatrix.transform_normals(matrix, n, level=level, status=True)
            check_normals(np.broadcast_to(matrix, A.shape), n, found, LIMITS[dtype, level])


@pytest.mark.parametrize("level", Level)
def test_bounds_hold_for_directions_as_they_were_written(level: Level) -> None:
    """A certified direction loses bits in a narrower array, wherever its normal came from."""
    A = np.array([[1, 2, 0], [0, 1, 3], [1, 0, 1]], np.float32)
    n = np.array([[3e30, 7e30, 2e30], [3e-30, 7e-30, 2e-30], [1, 2, 3]], np.float32)
    out = np.zeros((3, 3))
    for room in (None, out, out.astype(np.float32)):
        found = nmatrix.transform_normals(A, n, level=level, out=room, status=True)
        check_normals(np.broadcast_to(A, (3, 3, 3)), n, found, LIMITS[np.float32, level])


@pytest.mark.parametrize("dtype", FLOATS)
@pytest.mark.parametrize("level", Level)
def test_a_power_of_two_changes_no_bit_of_a_direction(level: Level, dtype: type) -> None:
    reach = np.finfo(dtype).maxexp - 30
    few = families(dtype, 60)
    A = np.concatenate([few["ordinary"], few["near singular"], few["small integers"]])
    n = of_type(dtype, np.random.default_rng(2).normal(size=(len(A), 3)))
    for scale in (dtype(2.0**power) for power in (-reach, -reach // 3, -1, 30, reach // 2, reach)):
        for maps in (A, A[0]):
            once = nmatrix.transform_normals(maps, n, level=level, status=True)
            again = nmatrix.transform_normals(maps * scale, n, level=level, status=True)
            assert (once.normals == again.normals).all()
        once = nmatrix.normal_matrix(A, kind=ORIENTED, level=level)
        again = nmatrix.normal_matrix(A * scale, kind=ORIENTED, level=level)
        one, other = (np.abs(given).max(axis=(1, 2)) for given in (once, again))
        ratio = (one / np.where(other == 0, 1, other).astype(np.float64))[:, None, None]
        assert (np.frexp(ratio)[0] == np.where(ratio == 0, 0, 0.5)).all()
        assert (again * ratio == once).all()


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("dtype", (np.float16, *FLOATS))
@pytest.mark.parametrize("level", Level)
def test_a_matrix_alone_comes_as_it_does_among_many(level: Level, dtype: type, name: str) -> None:
    """One by one, in few, in many: the same bits."""
    A = families(dtype, 150)[name]
    for kind in NormalMatrixKind:
        if kind is INVERSE:
            A = A[[i for i, one in enumerate(A) if has_inverse(one)]]
        found = nmatrix.normal_matrix(A, kind=kind, level=level)
        for few in (1, 2, 5, 40):
            parts = [A[i : i + few] for i in range(0, len(A), few)]
            some = [nmatrix.normal_matrix(part, kind=kind, level=level) for part in parts]
            same = np.concatenate([found[:0], *some])
            assert (found == same).all()
            assert (np.signbit(found) == np.signbit(same)).all()


@pytest.mark.parametrize("name", (*NAMES, *NORMAL_FAMILIES))
@pytest.mark.parametrize("dtype", FLOATS)
@pytest.mark.parametrize("level", [Level.CERTIFIED, Level.GUARDED])
def test_the_compiled_loop_gives_the_bits_of_the_arrays(
    level: Level, dtype: type, name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("numba", reason="numba is not installed")
    if name in NAMES:
        A = families(dtype, 400)[name]
    else:
        rng = np.random.default_rng(6)
        A = of_type(dtype, [NORMAL_FAMILIES[name](rng) for _ in range(400)])
    few = A[[i for i, one in enumerate(A) if has_inverse(one)]]
    for kind, given in ((ORIENTED, A), (INVERSE, few)):
        monkeypatch.setattr(batched, "is_compiled", lambda: False)
        by_arrays = nmatrix.normal_matrix(given, kind=kind, level=level)
        monkeypatch.setattr(batched, "is_compiled", lambda: True)
        by_loop = nmatrix.normal_matrix(given, kind=kind, level=level)
        assert by_loop.tobytes() == by_arrays.tobytes()
        in_place = given.copy()
        nmatrix.normal_matrix(in_place, kind=kind, level=level, out=in_place)
        assert in_place.tobytes() == by_arrays.tobytes()
    with pytest.raises(NoAnswerError, match=r"A\[1\]"):
        nmatrix.normal_matrix([E3, np.diag((1.0, 1, 0))], level=level)


def test_a_compiled_loop_that_is_not_installed_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("NMATRIX_COMPILED", "1")
    monkeypatch.setattr(batched, "find_spec", lambda name: None)
    with pytest.raises(nmatrix.MissingPackageError, match=r"the package numba.*install .numba>="):
        batched.is_compiled.__wrapped__()


def has_inverse(A: Array) -> bool:
    """An inverse transpose that the type of the matrix holds."""
    try:
        nmatrix.normal_matrix(A)
    except nmatrix.NMatrixError:
        return False
    return True


SAME: dict[str, Callable[[Array], Any]] = {
    "strided": lambda A: np.repeat(A, 2, axis=0)[::2],
    "reversed": lambda A: A[::-1].copy()[::-1],
    "by columns": np.asfortranarray,
    "big-endian": lambda A: A.astype(A.dtype.newbyteorder(">")),
    "read-only": lambda A: np.frombuffer(A.tobytes(), A.dtype).reshape(A.shape),
    "planes": lambda A: np.ascontiguousarray(np.moveaxis(A, 0, -1)).transpose(
        -1, *range(A.ndim - 1)
    ),
    "unaligned": lambda A: np.frombuffer(b"x" + A.tobytes(), A.dtype, offset=1).reshape(A.shape),
}


@pytest.mark.parametrize("name", SAME)
@pytest.mark.parametrize("dtype", FLOATS)
@pytest.mark.parametrize("level", Level)
def test_the_layout_of_an_array_changes_no_bit(level: Level, dtype: type, name: str) -> None:
    A = families(dtype, 50)["small integers"]
    signs = np.signbit(nmatrix.normal_matrix(A, kind=ORIENTED, level=level))
    room = SAME["planes"](np.empty_like(A))
    nmatrix.normal_matrix(A, kind=ORIENTED, level=level, out=room)
    assert (np.signbit(room) == signs).all()
    A = families(dtype, 50)["ordinary"]
    n = of_type(dtype, np.random.default_rng(2).normal(size=(50, 3)))
    for kind in NormalMatrixKind:
        found = nmatrix.normal_matrix(SAME[name](A), kind=kind, level=level)
        assert found.dtype == dtype
        assert (found == nmatrix.normal_matrix(A, kind=kind, level=level)).all()
        out = SAME[name](np.empty_like(A))
        if out.flags.writeable:
            nmatrix.normal_matrix(A, kind=kind, level=level, out=out)
            assert (out == found).all()
    found = nmatrix.transform_normals(SAME[name](A), SAME[name](n), level=level)
    assert (found == nmatrix.transform_normals(A, n, level=level)).all()
    found = nmatrix.transform_normals(A[0], SAME[name](n), level=level)
    assert found.dtype == dtype
    assert (found == nmatrix.transform_normals(A[0], n, level=level)).all()


SHAPES = [((), ()), ((), (7,)), ((7,), ()), ((4, 1), (5,)), ((1,), (2, 3)), ((2, 3, 4), (4,))]


@pytest.mark.parametrize(("maps", "normals"), SHAPES)
@pytest.mark.parametrize("level", Level)
def test_leading_axes_broadcast(
    level: Level, maps: tuple[int, ...], normals: tuple[int, ...]
) -> None:
    rng = np.random.default_rng(1)
    A, n = rng.normal(size=(*maps, 3, 3)), rng.normal(size=(*normals, 3))
    shape = np.broadcast_shapes(maps, normals)
    found = nmatrix.transform_normals(A, n, level=level, status=True)
    assert found.normals.shape == (*shape, 3)
    assert found.status.shape == found.bound_rad.shape == shape
    A, n = np.broadcast_to(A, (*shape, 3, 3)), np.broadcast_to(n, (*shape, 3))
    for index in np.ndindex(shape):
        exact = np.array(LinearMap.of(A[index].tolist()).normal(n[index].tolist()).direction)
        assert np.abs(found.normals[index] - exact).max() <= found.bound_rad[index]
        assert found.status[index] == NormalStatus.OK
    again = nmatrix.normal_matrix(A, level=level)
    assert again.shape == A.shape
    for index in np.ndindex(shape):
        assert np.allclose(again[index], np.linalg.inv(A[index]).T, rtol=1e-9)


@pytest.mark.parametrize("level", Level)
def test_the_affine_part_of_four_by_four_is_left_alone(level: Level) -> None:
    A = np.random.default_rng(1).normal(size=(20, 3, 3))
    M = np.broadcast_to(np.eye(4), (20, 4, 4)).copy()
    M[:, :3, :3], M[:, :3, 3] = A, 1e30
    assert (nmatrix.normal_matrix(M, level=level) == nmatrix.normal_matrix(A, level=level)).all()
    given = nmatrix.transform_normals(M, (1, 2, 3), level=level)
    assert (given == nmatrix.transform_normals(A, (1, 2, 3), level=level)).all()


@pytest.mark.parametrize("level", Level)
def test_the_first_normal_without_an_image_is_named_with_its_reason(level: Level) -> None:
    A = np.broadcast_to(np.eye(3), (2, 3, 3, 3)).copy()
    A[1, 2] = np.diag([1.0, 0, 1])
    with pytest.raises(NoAnswerError, match=r"n\[1, 2\] \(1 0 0\): a silhouette"):
        nmatrix.transform_normals(A, (1, 0, 0), level=level)
    with pytest.raises(NoAnswerError, match=r"n\[1\] \(0 0 0\): the normal is the zero vector"):
        nmatrix.transform_normals(np.eye(3), [[0, 0, 1], [0, 0, 0]], level=level)
    n = np.array([[0, 0, 1.0], [0, 0, 0]])
    with pytest.raises(NoAnswerError, match=r"n\[1\]"):
        nmatrix.transform_normals(np.eye(3), n, level=level, out=n)


@pytest.mark.parametrize("level", Level)
def test_empty_batches_give_empty_results(level: Level) -> None:
    A, n = np.zeros((0, 3, 3), np.float32), np.zeros((0, 3), np.float32)
    for kind in NormalMatrixKind:
        assert nmatrix.normal_matrix(A, kind=kind, level=level).shape == (0, 3, 3)
    assert nmatrix.transform_normals(A, n, level=level).shape == (0, 3)
    assert nmatrix.transform_normals(np.eye(3), n, level=level, status=True).status.shape == (0,)
    assert nmatrix.cofactor_matrix(A).shape == (0, 3, 3)
    assert nmatrix.normalize(n).shape == (0, 3)
    assert np.shape(nmatrix.angle_between(n, (1, 0, 0))) == (0,)


@pytest.mark.parametrize("level", Level)
def test_no_warning_leaks_and_no_floating_point_error(level: Level) -> None:
    with np.errstate(all="raise"):
        for dtype in (np.float16, *FLOATS):
            rng = np.random.default_rng(4)
            for A in (
                any_bits(rng, (30, 3, 3), dtype),
                of_type(dtype, rng.normal(size=(30, 3, 3))),
            ):
                n = any_bits(rng, (30, 3), dtype)
                for some in (A, A[:2], A[0]):
                    nmatrix.normal_matrix(some, kind=ORIENTED, level=level)
                nmatrix.transform_normals(A, n, level=level, status=True)
                nmatrix.transform_normals(A[0], n, level=level, status=True)
                nmatrix.normalize(n[n.any(axis=1)])
        nmatrix.normal_matrix(np.eye(3) * 1e-300, level=level)


HOSTILE = (1e308, -1e308, 1e200, 1e-200, 1e-308, 5e-324, 0.0, 1.0)


@pytest.mark.parametrize("dtype", (np.float16, *FLOATS))
@pytest.mark.parametrize("name", nmatrix.__all__)
def test_numbers_at_the_ends_of_the_range_are_answered_or_refused_without_a_warning(
    name: str, dtype: type
) -> None:
    """Every function that takes numbers, given as many numbers as each of its parameters has."""
    function = getattr(nmatrix, name)
    rng = np.random.default_rng(11)
    shapes = {"A": (3, 3), "axis": (3,), "xyzw": (4,), "window": (4,), "clip": None}
    vectors = ("n", "v", "a", "b", "eye", "target", "up", "turns")
    shapes |= dict.fromkeys(vectors, (3,)) | dict.fromkeys(("translate", "scale", "shear"), (3,))
    numbers = ("turn", "fov_y", "aspect", "near", "far", "width", "height", "elevation", "angle")
    shapes |= dict.fromkeys((*numbers, "roll"), ())
    if isinstance(function, type) or not callable(function):
        return
    parameters = inspect.signature(function).parameters
    known = [one for one in parameters if shapes.get(one) is not None]
    others = [parameters[one] for one in parameters if one not in known]
    if any(one.default is one.empty and one.kind is not one.VAR_KEYWORD for one in others):
        return  # it takes more than numbers
    with np.errstate(all="raise"):
        for _ in range(30 if known else 0):
            given = {one: of_type(dtype, rng.choice(HOSTILE, shapes[one])) for one in known}
            with suppress(nmatrix.NMatrixError):
                function(**given)


@pytest.mark.parametrize("level", Level)
def test_numbers_of_any_real_type_come_as_what_they_are(level: Level) -> None:
    A = [[1, 2, 0], [0, 4, 0], [0, 0, -8]]
    wanted = np.linalg.inv(A).T
    same: list[Any] = [A, np.array(A, np.int8), np.array(A, object), np.array(A, np.longdouble)]
    same += [np.array(A, np.int64), [[Fraction(x) for x in row] for row in A]]
    same += [[[Decimal(x) for x in row] for row in A]]
    for given in same:
        found = nmatrix.normal_matrix(given, level=level)
        assert found.dtype == np.float64
        assert (found == wanted).all()
    half = nmatrix.normal_matrix(np.array(A, np.float16), level=level)
    assert half.dtype == np.float16
    assert (half == wanted).all()
    assert nmatrix.transform_normals(A, np.float16([1, 0, 0]), level=level).dtype == np.float16
    big = nmatrix.normal_matrix(np.diag([2**60, 1, 1]), level=level)
    assert big[0, 0] == 2.0**-60


@pytest.mark.parametrize("level", ["exact", "certified", "guarded"])
def test_words_are_taken_for_enums(level: str) -> None:
    A = np.random.default_rng(1).normal(size=(30, 3, 3))
    for kind in ("oriented", "inverse-transpose"):
        by_word = nmatrix.normal_matrix(A, kind=kind, level=level)
        by_enum = nmatrix.normal_matrix(A, kind=NormalMatrixKind(kind), level=Level(level))
        assert (by_word == by_enum).all()
    for call in (
        nmatrix.normal_matrix,
        lambda A, **word: nmatrix.transform_normals(A, A[0], **word),
    ):
        with pytest.raises(IllegalValueError, match=r"level.*exact, certified, guarded"):
            call(A, level="exakt")
    with pytest.raises(IllegalValueError, match=r"kind.*inverse-transpose, oriented"):
        nmatrix.normal_matrix(A, kind=None)


@pytest.mark.parametrize("level", [Level.CERTIFIED, Level.GUARDED])
@pytest.mark.parametrize("family", ["ordinary", "flat", "wild"])
def test_memory_is_input_output_and_a_few_mebibytes(family: str, level: Level) -> None:
    rng = np.random.default_rng(1)
    A = rng.normal(size=(100_000, 3, 3))
    n = rng.normal(size=(100_000, 3))
    if family == "flat":
        A *= [1, 1e-5, 1]
    elif family == "wild":
        A *= 2.0 ** rng.integers(-400, 400, size=(len(A), 1, 1))
    told = len(n) * (1 + 8 + 4 * len(NormalStatus.TWO_SIDED))  # statuses and bounds
    limit = (4 if level is Level.CERTIFIED else 8) << 20
    runs: list[tuple[int, Callable[[], object]]] = [
        (4 << 20, lambda: nmatrix.normal_matrix(A, kind=ORIENTED, level=level, out=A)),
        (4 << 20, lambda: nmatrix.normal_matrix(A, level=level, out=A)),
        (told, lambda: nmatrix.transform_normals(A, n, level=level, out=n, status=True)),
        (told, lambda: nmatrix.transform_normals(A[0], n, level=level, out=n, status=True)),
    ]
    for result, run in runs:
        tracemalloc.start()
        run()
        _, peak = tracemalloc.get_traced_memory()
        tracemalloc.stop()
        assert peak < result + limit


E3, X = np.eye(3), (1.0, 0.0, 0.0)
FUNCTIONS: dict[str, tuple[Callable[[Any], object], Any]] = {
    "A of normal_matrix": (nmatrix.normal_matrix, E3),
    "A of cofactor_matrix": (nmatrix.cofactor_matrix, E3),
    "A of transform_normals": (lambda A: nmatrix.transform_normals(A, X), E3),
    "A of classify": (nmatrix.classify, E3),
    "n of transform_normals": (lambda n: nmatrix.transform_normals(E3, n), X),
    "v of normalize": (nmatrix.normalize, X),
    "a of angle_between": (lambda a: nmatrix.angle_between(a, X), X),
    "b of angle_between": (lambda b: nmatrix.angle_between(X, b), X),
}
GARBAGE: dict[str, Callable[[Array], Any]] = {
    "None": lambda good: None,
    "text": lambda good: "text",
    "words": lambda good: good.astype(str),
    "bytes": lambda good: good.astype("S3"),
    "objects": lambda good: np.full(good.shape, object()),
    "text in objects": lambda good: good.astype(str).astype(object),
    "complex": lambda good: good + 1j,
    "masked": np.ma.masked_array,
    "ragged": lambda good: [[1, 2], [3]],
    "a dictionary": lambda good: {"A": good},
    "one number": lambda good: 2.0,
    "nothing": lambda good: [],
    "a row too few": lambda good: good[..., :2],
    "nan": lambda good: good * np.nan,
    "infinite": lambda good: np.where(good > 0, np.inf, 0.0),
    "a long integer": lambda good: good.astype(int) * (2**53 + 1),
    "huge integers": lambda good: good.astype(int).astype(object) * 10**400,
    "a signalling nan": lambda good: np.full(good.shape, Decimal("sNaN")),
    "dates": lambda good: good.astype("datetime64[s]"),
}


@pytest.mark.parametrize("garbage", GARBAGE)
@pytest.mark.parametrize("function", FUNCTIONS)
def test_garbage_is_refused_with_the_name_of_the_parameter(function: str, garbage: str) -> None:
    call, good = FUNCTIONS[function]
    call(good)
    with pytest.raises(IllegalValueError, match=rf"^{function[0]}\b"):
        call(GARBAGE[garbage](np.array(good)))


OTHERS: dict[str, tuple[Callable[[], object], str]] = {
    "a projection": (lambda: nmatrix.normal_matrix(np.diag([1, 1, 1, 2])), "last row .0 0 0 2."),
    "one projection of two": (
        lambda: nmatrix.transform_normals([np.eye(4), np.eye(4)[::-1]], X),
        r"A\[1\] with last row",
    ),
    "3×4": (lambda: nmatrix.classify(np.zeros((3, 4))), r"A of shape \(3, 4\)"),
    "a batch": (lambda: nmatrix.classify([E3, E3]), "classify them in turn"),
    "a negative tolerance": (lambda: nmatrix.classify(E3, -1), "tolerance"),
    "no tolerance": (lambda: nmatrix.classify(E3, float("nan")), "tolerance"),
    "a word for a tolerance": (lambda: nmatrix.classify(E3, "small"), "tolerance"),  # type: ignore[arg-type]
    "axes that do not match": (lambda: nmatrix.transform_normals([E3] * 2, [X] * 3), "broadcast"),
    "angles that do not match": (lambda: nmatrix.angle_between([X] * 2, [X] * 3), "broadcast"),
    "a short out": (lambda: nmatrix.normal_matrix(E3, out=np.zeros((2, 3, 3))), "out of shape"),
    "whole numbers out": (lambda: nmatrix.normal_matrix(E3, out=np.zeros((3, 3), int)), "int64"),
    "a list out": (lambda: nmatrix.transform_normals(E3, X, out=[0, 0, 0]), "out, a list"),  # type: ignore[call-overload]
    "a read-only out": (
        lambda: nmatrix.transform_normals(E3, X, out=np.broadcast_to(0.0, 3)),
        "read-only",
    ),
    "a large cofactor": (lambda: nmatrix.cofactor_matrix([E3, E3 * 1e160]), r"A\[1\]: a cofactor"),
    "one bad number in many": (
        lambda: nmatrix.normal_matrix(
            np.where(np.arange(9e5) == 899_996, np.nan, 1).reshape(-1, 3, 3)
        ),
        r"A\[99999, 1, 2\] \(nan\)",
    ),
}


@pytest.mark.parametrize("case", OTHERS)
def test_what_does_not_fit_is_refused_with_a_reason(case: str) -> None:
    call, says = OTHERS[case]
    with pytest.raises(IllegalValueError, match=says):
        call()


def test_a_zero_vector_has_no_direction_and_is_named() -> None:
    with pytest.raises(NoAnswerError, match=r"v\[1\] \(0 0 0\)"):
        nmatrix.normalize([X, (0, 0, 0)])
    with pytest.raises(NoAnswerError, match=r"b \(0 0 0\)"):
        nmatrix.angle_between(X, (0, 0, 0))


def test_what_stays_runs_over_leading_axes_in_its_own_type() -> None:
    v = of_type(np.float32, np.random.default_rng(1).normal(size=(2, 3, 3)))
    assert nmatrix.normalize(v).dtype == nmatrix.cofactor_matrix(v).dtype == np.float32
    found = nmatrix.angle_between(v, X)
    for index in np.ndindex(2, 3):
        assert found[index] == nmatrix.angle_between(v[index], X)
