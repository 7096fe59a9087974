"""Elimination and spectra: SymPy's rationals, planted eigenvalues, and mpmath's digits."""

from __future__ import annotations

import random
from fractions import Fraction

import mpmath
import pytest

from nmatrix.calculator.evaluate import calculate
from nmatrix.calculator.numbers import Interval, bounds
from nmatrix.calculator.values import Value
from nmatrix.errors import IllegalValueError, NoAnswerError
from nmatrix.linear.rational import identity, inverse, product, rational_matrix, transpose
from nmatrix.surds import Surd

DIGITS = 120


def value(expression, **names):
    return calculate(expression, {key: Value(one) for key, one in names.items()}).value


def is_true(expression, **names):
    return value(expression, **names).entries is True


def drawn(chance, rows, columns, largest=9):
    return tuple(
        tuple(
            Fraction(chance.randint(-largest, largest), chance.randint(1, 4))
            for _ in range(columns)
        )
        for _ in range(rows)
    )


def of_rank(chance, rows, columns, rank):
    """Multiply two matrices, so that the product has the rank for sure where both have it."""
    left = [[Fraction(i == j) for j in range(rank)] for i in range(rank)]
    left += [[Fraction(chance.randint(-3, 3)) for _ in range(rank)] for _ in range(rows - rank)]
    right = [
        [Fraction(i == j) for j in range(rank)]
        + [Fraction(chance.randint(-3, 3)) for _ in range(columns - rank)]
        for i in range(rank)
    ]
    chance.shuffle(left)
    return product(tuple(map(tuple, left)), tuple(map(tuple, right)))


def in_sympy(A):
    from sympy import Matrix, Rational

    return Matrix([[Rational(x.numerator, x.denominator) for x in row] for row in A])


def from_sympy(matrix):
    return tuple(tuple(Fraction(int(x.p), int(x.q)) for x in row) for row in matrix.tolist())


def invertible(chance, size):
    while True:
        A = rational_matrix(drawn(chance, size, size, 3))
        if in_sympy(A).det() != 0:
            return A


@pytest.mark.parametrize("shape", [(2, 2), (3, 4), (4, 3), (5, 7), (8, 8)])
def test_reduced_rows_and_ranks_are_sympys(shape):
    chance = random.Random(str(shape))
    for rank in range(1, min(shape) + 1):
        A = of_rank(chance, *shape, rank)
        assert value("rref(A)", A=A).entries == from_sympy(in_sympy(A).rref()[0])
        assert value("rank(A)", A=A).entries == rank == in_sympy(A).rank()


@pytest.mark.parametrize("size", [5, 6, 8])
def test_large_matrices_are_inverted_and_have_their_determinants_and_cofactors(size):
    chance = random.Random(size)
    A = invertible(chance, size)
    assert value("det(A)", A=A).entries == Fraction(str(in_sympy(A).det()))
    assert value("inverse(A) @ A", A=A).entries == identity(size)
    assert is_true("adjugate(A) == det(A) * inverse(A)", A=A)
    assert is_true("cofactor(A) == adjugate(A).T", A=A)
    flat = of_rank(chance, size, size, size - 1)
    assert value("det(A)", A=flat).entries == 0
    assert is_true("A @ adjugate(A) == 0 * A", A=flat)
    with pytest.raises(NoAnswerError, match="singular"):
        value("inverse(A)", A=flat)


@pytest.mark.parametrize("shape", [(2, 3), (3, 3), (4, 6), (6, 4)])
def test_what_vanishes_spans_all_that_does(shape):
    chance = random.Random(str(shape))
    for rank in range(1, min(shape) + 1):
        A = of_rank(chance, *shape, rank)
        if rank == shape[1]:
            with pytest.raises(NoAnswerError, match="only the zero vector"):
                value("null_space(A)", A=A)
            continue
        found = value("null_space(A)", A=A)
        columns = transpose(found.matrix) if rank < shape[1] - 1 else (found.vector,)
        assert len(columns) == shape[1] - rank == in_sympy(columns).rank()
        for one in columns:
            assert not any(x.entries for x in map(Value, product(A, transpose((one,)))[0]))
            assert all(x == (0,) for x in product(A, transpose((one,))))


@pytest.mark.parametrize("size", [2, 3, 4, 8])
def test_a_system_is_solved_or_told_to_have_none_or_many_solutions(size):
    chance = random.Random(size)
    A, x = invertible(chance, size), tuple(row[0] for row in drawn(chance, size, 1))
    b = tuple(row[0] for row in product(A, transpose((x,))))
    assert value("solve(A, b)", A=A, b=b).entries == x
    X = drawn(chance, size, 2)
    assert value("solve(A, B)", A=A, B=product(A, X)).entries == X
    tall = (*A, A[0])
    assert value("solve(A, b)", A=tall, b=(*b, b[0])).entries == x
    with pytest.raises(NoAnswerError, match="without a solution"):
        value("solve(A, b)", A=tall, b=(*b, b[0] + 1))
    with pytest.raises(NoAnswerError, match="many solutions"):
        value("solve(A, b)", A=A[:-1], b=b[:-1])


@pytest.mark.parametrize("size", [2, 3, 5, 8])
def test_l_times_u_is_the_matrix_with_its_rows_as_p_puts_them(size):
    chance = random.Random(size)
    for A in (invertible(chance, size), of_rank(chance, size, size, size - 1)):
        L, U, P = (value(f'lu(A, "{part}")', A=A).matrix for part in "LUP")
        assert product(L, U) == product(P, A)
        for i in range(size):
            assert L[i][i] == 1
            assert sorted(P[i]) == [0] * (size - 1) + [1]
            assert not any(L[i][i + 1 :])
            assert not any(U[i][:i])
    swapped = calculate("lu([0 1; 2 3])", {})
    assert "P A = L U" in swapped.remarks[0]
    assert not calculate("lu([1 1; 2 3])", {}).remarks


def with_blocks(blocks):
    """Put blocks on the diagonal of a matrix."""
    size = sum(map(len, blocks))
    rows = [[Fraction(0)] * size for _ in range(size)]
    start = 0
    for block in blocks:
        for i, row in enumerate(block):
            rows[start + i][start : start + len(row)] = row
        start += len(block)
    return tuple(map(tuple, rows))


def companion(*coefficients):
    """Build the matrix whose characteristic polynomial is xⁿ + … + c₁ x + c₀."""
    n = len(coefficients)
    return tuple(
        tuple(Fraction(-coefficients[i]) if j == n - 1 else Fraction(j == i - 1) for j in range(n))
        for i in range(n)
    )


@pytest.mark.parametrize("seed", range(12))
def test_planted_eigenvalues_are_found_exactly(seed):
    """Rational ones, one twice, and pairs a ± √b, hidden by a change of basis."""
    chance = random.Random(seed)
    rational = [Fraction(chance.randint(-9, 9), chance.randint(1, 5)) for _ in range(2)]
    a, b = Fraction(chance.randint(-4, 4), 3), Fraction(chance.choice([2, 3, 7, 12]), 5)
    blocks = [((rational[0],),), ((rational[0],),), ((rational[1],),)]
    blocks.append(((a, b), (Fraction(1), a)))  # a ± √b
    A = with_blocks(blocks[seed % 2 :])
    S = invertible(chance, len(A))
    found = value("eigenvalues(A)", A=product(S, A, inverse(S)))
    assert found.exact
    rest = list(found.vector)
    for one in rational[:1] * (2 - seed % 2) + rational[1:]:
        rest.remove(one)
    assert len(rest) == 2
    assert rest[0] > rest[1]
    assert [(x - a) * (x - a) for x in rest] == [b, b]
    assert rest[0] + rest[1] == 2 * a


@pytest.mark.parametrize(
    "coefficients",
    [(-1, -1, 0), (1, -3, 0), (-2, 0, 0), (1, 0, -10, 0), (3, -1, -7, 2, 0), (1, 1, 1, 1, 1, 1, 1)],
)
def test_other_real_eigenvalues_are_enclosed_and_complex_ones_left_out(coefficients):
    A = companion(*coefficients)
    with mpmath.workdps(DIGITS):
        roots = mpmath.polyroots([1, *reversed(coefficients)], maxsteps=500, extraprec=500)
        real = sorted((r.real for r in map(mpmath.mpc, roots) if abs(r.imag) < 1e-60), reverse=True)
    if not real:
        with pytest.raises(NoAnswerError, match="real number"):
            value("eigenvalues(A)", A=A)
        return
    calculation = calculate("eigenvalues(A)", {"A": Value(A)})
    found = list(calculation.value.numbers)
    assert len(found) == len(real)
    for one, right in zip(found, real, strict=True):
        low, high = bounds(one)
        near = Fraction(mpmath.nstr(right, DIGITS - 10))
        assert low - Fraction(1, 10**90) <= near <= high + Fraction(1, 10**90)
        assert high - low < Fraction(1, 10**80)
    missing = len(A) - len(real)
    assert bool(calculation.remarks) == bool(missing)
    assert not missing or calculation.remarks[0].startswith(f"{missing} eigenvalue")


def test_a_pair_of_quadratic_factors_of_a_quartic_is_seen():
    """x⁴ − 10x² + 1 has the roots ±√2 ± √3 and no such factor; (x² − 2)(x² − 3) has two."""
    assert not value("eigenvalues(A)", A=companion(1, 0, -10, 0)).exact
    found = value("eigenvalues(A)", A=companion(6, 0, -5, 0))
    assert [str(x) for x in found.vector] == ["√3", "√2", "−√2", "−√3"]


def test_eigenvalues_of_roots_and_of_sines():
    assert is_true("eigenvalues([√2 1; 0 √3]) == [√3, √2]")
    assert is_true("eigenvalues([√2 1; 1 √2]) == [√2 + 1, √2 - 1]")
    assert is_true("eigenvalues(axis_angle([1, 2, 2], 45)) == [1, 1]")
    found = value("eigenvalues([2 1 0; 1 sin(20) 1; 0 1 3])")
    with mpmath.workdps(60):
        middle = mpmath.sin(mpmath.radians(20))
        right = mpmath.eigsy(mpmath.matrix([[2, 1, 0], [1, middle, 1], [0, 1, 3]]))[0]
    for one, near in zip(found.numbers, sorted(right, reverse=True), strict=True):
        assert isinstance(one, Interval)
        assert one.low - Fraction(1, 10**50) <= Fraction(mpmath.nstr(near, 58))
        assert Fraction(mpmath.nstr(near, 58)) <= one.high + Fraction(1, 10**50)
        assert one.high - one.low < Fraction(1, 10**30)
    with pytest.raises(IllegalValueError, match="so many digits only"):
        value("eigenvalues([2 1 0; 1 sin(20) 1; 5 1 3])")


@pytest.mark.parametrize("shape", [(2, 2), (3, 3), (4, 4), (3, 5), (5, 2)])
def test_singular_values_are_mpmaths(shape):
    chance = random.Random(str(shape))
    for _ in range(3):
        A = drawn(chance, *shape)
        with mpmath.workdps(50):
            rows = mpmath.matrix([[mpmath.mpf(x.numerator) / x.denominator for x in r] for r in A])
            right = mpmath.svd_r(rows, compute_uv=False)
        found = list(value("singular_values(A)", A=A).numbers)
        assert len(found) == min(shape)
        for one, near in zip(found, right, strict=True):
            low, high = bounds(one)
            assert abs((low + high) / 2 - Fraction(mpmath.nstr(near, 45))) < Fraction(1, 10**30)
            assert high - low < Fraction(1, 10**60)


def test_singular_values_are_roots_where_they_are():
    assert is_true("singular_values(scale(-2, √3, 0)) == [2, √3, 1, 0]")
    assert is_true("singular_values([1 2; 2 4]) == [5, 0]")
    assert is_true("singular_values([1 1; 1 0]) == [(√5 + 1)/2, (√5 - 1)/2]")
    known = value("singular_values(linear(rotate_x(20) @ scale(1, 2, 3)))")
    for one, right in zip(known.numbers, (3, 2, 1), strict=True):
        assert one.low < right < one.high
        assert one.digits > 30


@pytest.mark.parametrize("seed", range(6))
def test_a_polar_decomposition_is_exact_for_two_rows(seed):
    A = drawn(random.Random(seed), 2, 2)
    assert is_true("polar(A) @ polar(A).T == identity(2)", A=A)
    assert is_true('polar(A) @ polar(A, "stretch") == A', A=A)
    assert is_true('polar(A, "stretch").T == polar(A, "stretch")', A=A)
    assert value('det(polar(A, "stretch"))', A=A).scalar == abs(value("det(A)", A=A).scalar)
    assert value('trace(polar(A, "stretch"))', A=A).scalar > 0


@pytest.mark.parametrize("seed", range(4))
def test_a_polar_decomposition_of_more_rows_holds_as_far_as_it_is_known(seed):
    A = invertible(random.Random(seed), 3 + seed % 2)
    U, S = (value(f"polar(A{part})", A=A).matrix for part in ("", ', "stretch"'))
    unit, again = product(transpose(U), U), product(U, S)
    for i, row in enumerate(A):
        for j, entry in enumerate(row):
            for found, right in (
                (unit[i][j], int(i == j)),
                (again[i][j], entry),
                (S[i][j], S[j][i]),
            ):
                off = bounds(found - right)
                assert off[0] <= 0 <= off[1]
                assert off[1] - off[0] < Fraction(1, 10**40)
    minors = [value("det(S)", S=tuple(row[:k] for row in S[:k])).scalar for k in range(1, len(S))]
    assert all(bounds(one)[0] > 0 for one in minors)


@pytest.mark.parametrize("scale", ["1, 2, 3", "2, 2, 2", "1, 1, 5", "-1, 2, 2"])
def test_a_polar_decomposition_of_a_turn_that_no_roots_tell(scale):
    turn = "linear(rotate_x(20) @ rotate_y(33) @ rotate_z(7))"
    signs = f"linear(scale({', '.join('-1' if '-' in x else '1' for x in scale.split(', '))}))"
    sizes = f"linear(scale({scale.replace('-', '')}))"
    for part, right in (("rotation", f"{turn} @ {signs}"), ("stretch", sizes)):
        found = value(f'polar({turn} @ linear(scale({scale})), "{part}") - {right}')
        for one in found.numbers:
            low, high = bounds(one)
            assert low <= 0 <= high
            assert high - low < Fraction(1, 10**35)
    assert is_true('polar(rotate_x(20), "stretch") ≈ identity(4)')
    known = value("polar(rotate_x(20) @ scale(3, 2, 2))")
    assert (known.matrix[0], known.matrix[3]) == ((1, 0, 0, 0), (0, 0, 0, 1))
    assert known.matrix[1][1].digits > 30


def test_eigenvalues_of_bounds_that_are_symmetric():
    with mpmath.workdps(60):
        s, c = (f(mpmath.radians(20)) for f in (mpmath.sin, mpmath.cos))
        right = mpmath.eigsy(mpmath.matrix([[2, s, 0], [s, c, 1], [0, 1, 3]]), eigvals_only=True)
    found = value("eigenvalues([2 sin(20) 0; sin(20) cos(20) 1; 0 1 3])")
    for one, near in zip(found.numbers, sorted(right, reverse=True), strict=True):
        low, high = bounds(one)
        assert low <= Fraction(mpmath.nstr(near, 58)) + Fraction(1, 10**55)
        assert high >= Fraction(mpmath.nstr(near, 58)) - Fraction(1, 10**55)
        assert high - low < Fraction(1, 10**35)
    with pytest.raises(IllegalValueError, match="so many digits only"):
        value("eigenvalues([sin(20) 0 1e-50; 0 sin(20) 0; 1e-50 1e-50 sin(20)])")


def test_a_polar_decomposition_parts_a_turn_from_a_scale():
    turned = "linear(rotate_z(30) @ rotate_x(45))"
    assert is_true(
        f"polar({turned} @ diagonal) == {turned}", diagonal=((2, 0, 0), (0, 3, 0), (0, 0, 5))
    )
    assert is_true('polar(linear(scale(2, 0, 3)), "stretch") == linear(scale(2, 0, 3))')
    with pytest.raises(IllegalValueError, match="that moves"):
        value("polar(translate(1, 2, 3))")


@pytest.mark.parametrize("k", [-3, -1, 0, 1, 2, 7])
def test_powers_are_products(k):
    A = invertible(random.Random(k), 3)
    right = identity(3)
    for _ in range(abs(k)):
        right = product(right, A if k > 0 else inverse(A))
    assert value(f"power(A, {k})", A=A).entries == right
    assert value(f"power(3/2, {k})").entries == Fraction(3, 2) ** k


@pytest.mark.parametrize(
    "expression", ["power(power(9, 9999), 9999)", "power(2, 99999)", "power([1 1; 1 0], 9999)"]
)
def test_towers_of_powers_are_refused(expression):
    with pytest.raises(IllegalValueError):
        value(expression)


def test_entries_that_are_too_long_for_a_spectrum_are_refused():
    with pytest.raises(IllegalValueError, match="bits"):
        value("eigenvalues([1e160 1; 1 1e-160])")


def test_surds_that_grow_give_way_to_bounds():
    roots = [f"√{p}" for p in (2, 3, 5, 7, 11, 13, 17, 19, 23)]
    A = f"[{'; '.join(' '.join(roots[3 * i : 3 * i + 3]) for i in range(3))}]"
    found = value(f"inverse({A}) @ {A}")
    assert not any(isinstance(x, Surd) for x in found.numbers)
    for i, row in enumerate(found.matrix):
        for j, entry in enumerate(row):
            low, high = bounds(entry)
            assert low <= (i == j) <= high
