"""Functions of the spectrum: eigenvalues, singular values, and the polar decomposition.

They come from exact polynomials, so that no eigenvalue is lost where two are close, and a value is
a fraction or a sum of roots wherever it is one.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache
from itertools import pairwise

from nmatrix.calculator.functions.elimination import is_exact
from nmatrix.calculator.functions.function import (
    ArgumentError,
    Function,
    NoAnswerForArgumentError,
    matrix,
    require_square,
    word,
)
from nmatrix.calculator.functions.matrices import determinant
from nmatrix.calculator.functions.roots import middle, real_roots
from nmatrix.calculator.numbers import (
    Float64,
    Number,
    bits_of,
    bounds,
    enclosed,
    is_negative,
    is_zero,
    root,
)
from nmatrix.calculator.values import Value
from nmatrix.errors import counted, quantity
from nmatrix.linear import rational
from nmatrix.linear.rational import ONE, ZERO, RationalMatrix
from nmatrix.surds import Surd

LONGEST = 512  # bits of an entry: the polynomials have so many more
SQUARE_ROOT, ROTATION = "stretch", "rotation"


def _checked(A: Value, what: str) -> None:
    """Refuse floats, and entries that are too long."""
    if any(isinstance(x, Float64) for x in A.numbers):
        why = "they are found exactly, and not by operations that are rounded one by one"
        raise ArgumentError(A, f"{what} in float64", why, f"leave {quantity('float')} out")
    bits = max(map(bits_of, A.numbers))
    if bits > LONGEST:
        why = f"they take {bits} bits, {LONGEST} are allowed here"
        raise ArgumentError(A, f"entries for {what}", why, "use shorter ones")


def _eigenvalues(A: Value) -> Value:
    require_square(A)
    _checked(A, "eigenvalues")
    found = spectrum(A.matrix)
    if not found:
        why = "no vector keeps its direction: the map turns them all"
        step = "use one that keeps a direction"
        raise NoAnswerForArgumentError(A, "a matrix without real eigenvalues", why, step)
    return Value(tuple(one for one, times in found for _ in range(times)))


def _eigenvalues_remarks(A: Value) -> list[str]:
    left = len(A.matrix) - sum(times for _, times in spectrum(A.matrix))
    if not left:
        return []
    told = counted(left, "eigenvalue is", "eigenvalues are")
    return [f"{told} no real number: there the map turns."]


@lru_cache(maxsize=4)  # the value and its remark ask one after the other
def spectrum(A: RationalMatrix) -> tuple[tuple[Number, int], ...]:
    """Find the real eigenvalues, each with its multiplicity, the largest first.

    Raises
    ------
    NoAnswerError
        If the entries are known to so many digits only, and the matrix is not symmetric.
    """
    found: dict[int, tuple[Number, int]] = {}
    for block in _diagonal_blocks(A):
        for one, times in _of_block(block):
            place = next((i for i, (other, _) in found.items() if _is_same(one, other)), len(found))
            found[place] = (one, times + found.get(place, (one, 0))[1])
    return tuple(sorted(found.values(), key=lambda one: middle(one[0]), reverse=True))


def _is_same(one: Number, other: Number) -> bool:
    exact = isinstance(one, Fraction | Surd) and isinstance(other, Fraction | Surd)
    return exact and one == other


def _diagonal_blocks(A: RationalMatrix) -> list[RationalMatrix]:
    """Part a block-triangular matrix: its eigenvalues are those of the blocks."""
    n = len(A)
    for k in range(1, n):
        below = all(_is_known_zero(x) for row in A[k:] for x in row[:k])
        above = all(_is_known_zero(x) for row in A[:k] for x in row[k:])
        if below or above:
            first, second = tuple(row[:k] for row in A[:k]), tuple(row[k:] for row in A[k:])
            return [first, *_diagonal_blocks(second)]
    return [A]


def _is_known_zero(x: Number) -> bool:
    return isinstance(x, Fraction) and x == 0


def _of_block(A: RationalMatrix) -> list[tuple[Number, int]]:
    if len(A) == 1:
        return [(A[0][0], 1)]
    if is_exact(A):
        return real_roots(characteristic(A))
    near = _near_symmetric(A)
    if near is not None:
        return [(one, 1) for one in near]
    if len(A) > 2:
        what = "eigenvalues of entries that are known to so many digits only"
        raise ArgumentError(Value(A), what, "from 3×3 on they are not told", "use rational entries")
    (a, b), (c, d) = A
    square = (a - d) * (a - d) + 4 * b * c
    if is_negative(square):
        return []
    apart = Value(root(square)).scalar
    return [((a + d + sign * apart) / 2, 1) for sign in (1, -1)]


def characteristic(A: RationalMatrix) -> tuple[Fraction, ...]:
    """Compute det(t I − A), the coefficient of the highest power last (Faddeev and Le Verrier).

    Examples
    --------
    >>> print(*characteristic(rational.rational_matrix([[2, 1], [1, 3]])))
    5 -5 1
    """
    n, found = len(A), [ONE]
    M = rational.identity(n)
    for k in range(1, n + 1):
        product = rational.product(A, M)
        trace = sum((product[i][i] for i in range(n)), ZERO)
        found.append(-trace / k)
        M = tuple(
            tuple(product[i][j] + (found[-1] if i == j else ZERO) for j in range(n))
            for i in range(n)
        )
    return tuple(reversed(found))


def _near_symmetric(A: RationalMatrix) -> list[Number] | None:
    """Enclose the eigenvalues of a matrix of bounds that is symmetric; None of any other.

    They move less than the matrix (Weyl). Where only the bounds are symmetric, that tells of real
    eigenvalues as long as no two of them may meet (Bauer and Fike).
    """
    central, off = _middle(A)
    if rational.transpose(central) != central:
        return None
    near = [one for one, times in real_roots(characteristic(central)) for _ in range(times)]
    found: list[Number] = [enclosed(bounds(one)[0] - off, bounds(one)[1] + off) for one in near]
    apart = all(bounds(x)[0] > bounds(y)[1] for x, y in pairwise(found))
    return found if apart or rational.transpose(A) == A else None


def _middle(A: RationalMatrix) -> tuple[RationalMatrix, Fraction]:
    """Take the middles of all bounds, and how far in sum the entries may be from them."""
    ends = [[bounds(x) for x in row] for row in A]
    off = sum((high - low for row in ends for low, high in row), ZERO) / 2
    return tuple(tuple((low + high) / 2 for low, high in row) for row in ends), off


def _gram(A: RationalMatrix) -> RationalMatrix:
    """Multiply AᵀA, or A Aᵀ if that is smaller."""
    B = rational.transpose(A)
    return rational.product(*((A, B) if len(A) < len(B) else (B, A)))


def singular(A: RationalMatrix) -> list[Number]:
    """Find all singular values, the largest first."""
    if not is_exact(A):
        middle, off = _middle(A)
        ends = map(bounds, singular(middle))
        return [enclosed(max(ZERO, low - off), high + off) for low, high in ends]
    return [root(one) for one, times in spectrum(_gram(A)) for _ in range(times)]


def _singular_values(A: Value) -> Value:
    _checked(A, "singular values")
    return Value(tuple(singular(A.matrix)))


def _polar(A: Value, part: str) -> Value:
    require_square(A)
    _checked(A, "a polar decomposition")
    M = A.matrix
    if rational.is_affine(M) and any(x != 0 for x in rational.translation(M)):
        why = "a translation is no part of it"
        raise ArgumentError(A, "polar of a map that moves", why, "write polar(linear(M))")
    is_rotation = part == ROTATION
    if is_rotation and is_zero(determinant(M)):
        why = "its determinant is 0, so several rotations belong to it"
        raise NoAnswerForArgumentError(A, "polar of a singular matrix", why, 'ask for "stretch"')
    return Value(_polar_factor(M, is_rotation=is_rotation))


def _polar_factor(A: RationalMatrix, *, is_rotation: bool) -> RationalMatrix:
    """Find the rotation or the stretch of a matrix, of its blocks one by one."""
    for k in range(1, len(A)):
        beside = (*(x for row in A[k:] for x in row[:k]), *(x for row in A[:k] for x in row[k:]))
        if all(map(_is_known_zero, beside)):
            first, second = tuple(row[:k] for row in A[:k]), tuple(row[k:] for row in A[k:])
            left = (_polar_factor(block, is_rotation=is_rotation) for block in (first, second))
            return _on_the_diagonal(*left)
    if len(A) == 1:
        size = abs(A[0][0])
        return ((A[0][0] / size if is_rotation else size,),)
    if len(A) == 2:
        return _polar_of_two(A, is_rotation=is_rotation)
    if not is_exact(A):
        return _polar_of_bounds(A, is_rotation=is_rotation)
    B = rational.product(rational.transpose(A), A)
    distinct = Value(tuple(one for one, _ in spectrum(B))).vector
    roots = Value(tuple(map(root, distinct))).vector
    weights = [1 / one for one in roots] if is_rotation else roots
    found = _interpolated(B, distinct, weights)
    return rational.product(A, found) if is_rotation else found


def _on_the_diagonal(first: RationalMatrix, second: RationalMatrix) -> RationalMatrix:
    right, left = (ZERO,) * len(second), (ZERO,) * len(first)
    return (*((*row, *right) for row in first), *((*left, *row) for row in second))


def _polar_of_bounds(A: RationalMatrix, *, is_rotation: bool) -> RationalMatrix:
    """Enclose a factor by that of the matrix in the middle.

    The rotation moves at most by 2/(σ + σ′) of what the matrix does, of whose two least singular
    values these are (Li, 1995), and the stretch by √2 of it.
    """
    central, off = _middle(A)
    moves = Fraction(3, 2)
    if is_rotation:
        least = bounds(singular(central)[-1])[0]
        if least <= off:
            what, why = "a polar decomposition", "its entries leave open if it is singular"
            raise NoAnswerForArgumentError(Value(A), what, why, "use rational entries")
        moves = 2 / (2 * least - off)
    near = _polar_factor(central, is_rotation=is_rotation)
    return tuple(tuple(_widened(x, moves * off) for x in row) for row in near)


def _widened(x: Fraction, by: Fraction) -> Fraction:
    low, high = bounds(x)
    return Value(enclosed(low - by, high + by)).scalar


def _polar_of_two(A: RationalMatrix, *, is_rotation: bool) -> RationalMatrix:
    """Decompose a 2×2 matrix: U = (A ± cof A)/s and √(AᵀA) = (AᵀA + |det|)/s, by one root s."""
    B, det = rational.product(rational.transpose(A), A), determinant(A)
    size = abs(det)
    over = Value(root(B[0][0] + B[1][1] + 2 * size)).scalar
    if is_zero(over):
        return A
    added = rational.cofactor_matrix(A) if is_rotation else rational.diagonal((size, size))
    sign = -1 if is_rotation and is_negative(det) else 1
    return tuple(
        tuple((x + sign * y) / over for x, y in zip(*rows, strict=True))
        for rows in zip(A if is_rotation else B, added, strict=True)
    )


def _interpolated(
    B: RationalMatrix, at: Sequence[Fraction], values: Sequence[Fraction]
) -> RationalMatrix:
    """Compute f(B) of a symmetric matrix from f at its eigenvalues (Lagrange)."""
    n = len(B)
    total = tuple((ZERO,) * n for _ in range(n))
    for i, value in enumerate(values):
        term = rational.diagonal((value,) * n)
        for j, other in enumerate(at):
            if i != j:
                shifted = tuple(
                    tuple((x - other if r == c else x) for c, x in enumerate(row))
                    for r, row in enumerate(B)
                )
                term = rational.scaled(rational.product(term, shifted), 1 / (at[i] - other))
        total = tuple(
            tuple(x + y for x, y in zip(*rows, strict=True))
            for rows in zip(total, term, strict=True)
        )
    return total


FUNCTIONS: dict[str, Function] = {
    "eigenvalues": Function(
        (matrix(),),
        "the real eigenvalues, the largest first, each as often as it is a root",
        "the roots of the characteristic polynomial",
        "det(A − λ I) = 0",
        "eigenvalues([2 1; 1 2])",
        "[3, 1]",
        _eigenvalues,
        remarks=_eigenvalues_remarks,
    ),
    "singular_values": Function(
        (matrix(),),
        "the singular values, the largest first: how much A stretches at most and at least",
        "the roots of the eigenvalues of AᵀA",
        "σᵢ = √λᵢ(AᵀA)",
        "singular_values([1 1; 0 1])",
        "[(√5 + 1)/2, (√5 - 1)/2]",
        _singular_values,
    ),
    "polar": Function(
        (matrix(), word("part", ROTATION, SQUARE_ROOT, default=ROTATION)),
        'the rotation U, or mirrored rotation, that is nearest to A; with "stretch" the symmetric '
        "matrix S that is left",
        "the stretch is the root of AᵀA, the rotation what is left",
        "A = U S, S = √(AᵀA)",
        "polar([3 0; 4 5])",
        "[2√5/5 -√5/5; √5/5 2√5/5]",
        _polar,
    ),
}
