"""Inverses by the adjugate, by row operations and by blocks; the matrix that carries normals."""

from __future__ import annotations

from nmatrix.enums import InverseBy
from nmatrix.errors import IllegalValueError, NoAnswerError
from nmatrix.report import Step
from nmatrix.working.determinants import EXPANDED, cofactors, sum_of
from nmatrix.working.elimination import identity_beside
from nmatrix.working.products import product, unit_check
from nmatrix.working.working import (
    EXACT,
    ONE,
    Entry,
    Matrix,
    Notation,
    Vector,
    Working,
    chain,
    identity,
    raised,
    transposed,
)


def inverse(
    A: Matrix, name: str = "A", method: InverseBy | None = None, by: Notation = EXACT
) -> Working:
    """Invert a matrix; the last line multiplies it by its inverse.

    Without a method an affine 4×4 matrix is taken by blocks, up to 3×3 by the adjugate, and what
    is larger by row operations.

    Parameters
    ----------
    A
        A square matrix.
    name
        What it is called.
    method
        The adjugate is for 2×2 to 4×4, blocks are for affine 4×4.

    Raises
    ------
    NoAnswerError
        If A is singular.
    IllegalValueError
        For a matrix that the method is not for.

    Examples
    --------
    >>> [[str(x) for x in row] for row in inverse(((4, 0), (0, -2))).value]
    [['1/4', '0'], ['0', '-1/2']]
    """
    is_affine = _is_affine(A, by)
    if method is None:
        small = InverseBy.ADJUGATE if 2 <= len(A) < EXPANDED else InverseBy.GAUSS
        method = InverseBy.BLOCKS if is_affine else small
    if method is InverseBy.BLOCKS and not is_affine:
        raise IllegalValueError(
            "an inverse by blocks", "the last row is not 0 0 0 1", "take the adjugate"
        )
    if method is InverseBy.BLOCKS:
        return _by_blocks(A, name, by)
    if method is InverseBy.GAUSS:
        return _by_gauss(A, name, by)
    return _by_adjugate(A, name, by)


def inverse_transpose(A: Matrix, name: str = "A", by: Notation = EXACT) -> Working:
    """Work out A⁻ᵀ as the cofactors over the determinant: of a 3×3 block it carries normals.

    Raises
    ------
    NoAnswerError
        If A is singular.

    Examples
    --------
    >>> [[str(x) for x in row] for row in inverse_transpose(((2, 1), (0, 1))).value]
    [['1/2', '0'], ['-1/2', '1']]
    """
    C = cofactors(A, name, by)
    found, d = determinant_by_cofactors(A, C.value, name, by)
    if by.is_zero(d):
        raise _singular()
    named = raised(name, "⁻ᵀ")
    about = "the cofactors over the determinant"
    last, value = _over(f"{named} = C / det {name}", C.value, d, about, by)
    check = unit_check(transposed(A), value, (raised(name, "ᵀ"), named), by)
    return Working((*C.steps, found, last, check), value)


def determinant_by_cofactors(
    A: Matrix, C: Matrix, name: str, by: Notation = EXACT
) -> tuple[Step, Entry]:
    """Multiply a row of A with its cofactors: the line, and the determinant.

    Examples
    --------
    >>> step, value = determinant_by_cofactors(((1, 2), (3, 4)), ((4, -3), (-2, 1)), "A")
    >>> step.formula.parts, value
    (('det A = 1·4 + 2·(−3) = 4 − 6 = −2',), -2)
    """
    texts, value = sum_of([(1, pair) for pair in zip(A[0], C[0], strict=True)], by)
    column = by.dot([row[0] for row in A], [row[0] for row in C])
    about = "the first row times its cofactors"
    line = chain(f"det {name}", texts if by.spells_out else texts[-1:])
    return by.step(line, because=about, proved=by.same(value, column)), value


def _over(head: str, C: Matrix, d: Entry, because: str, by: Notation) -> tuple[Step, Matrix]:
    """Divide every entry by the determinant: the line, and the result."""
    factor = by.tidy(ONE / d)
    value = tuple(by.scaled(row, factor) for row in C)
    proved = by.same(tuple(by.scaled(row, d) for row in value), C)
    if by.same(d, ONE):
        return by.step(f"{head} = ", value, because=because, proved=proved), value
    text = by.factor(factor, is_first=True)
    return by.step(f"{head} = {text} · ", C, " = ", value, because=because, proved=proved), value


def _by_adjugate(A: Matrix, name: str, by: Notation) -> Working:
    C = cofactors(A, name, by)
    line, d = determinant_by_cofactors(A, C.value, name, by)
    if by.is_zero(d):
        raise _singular()
    turned = transposed(C.value)
    named = raised(name, "⁻¹")
    adjugate = by.step(
        "Cᵀ = ",
        turned,
        because="the adjugate: the cofactors transposed",
        proved=by.same(transposed(turned), C.value),
    )
    about = "the adjugate over the determinant"
    last, value = _over(f"{named} = Cᵀ / det {name}", turned, d, about, by)
    check = unit_check(A, value, (name, named), by)
    return Working((*C.steps, line, adjugate, last, check), value)


def _by_gauss(A: Matrix, name: str, by: Notation) -> Working:
    n = len(A)
    work = identity_beside(A, identity(n), name, by)
    work.to_echelon(n, reduced=True)
    if len(work.pivots) < n:
        raise _singular()
    value = tuple(tuple(row[n:]) for row in work.rows)
    named = raised(name, "⁻¹")
    check = unit_check(A, value, (name, named), by)
    read = by.step(
        f"{named} = ",
        value,
        because=f"{name} has become I, so I has become the inverse",
        proved=check.verified,
    )
    return Working((*work.steps, read, check), value)


def _by_blocks(M: Matrix, name: str, by: Notation) -> Working:
    """Invert an affine matrix: its block, and where that takes the translation, turned round."""
    block, letter = tuple(tuple(row[:3]) for row in M[:3]), "B" if name == "A" else "A"
    offset = tuple(row[3] for row in M[:3])
    first = by.step(f"{name} = ", M, because="as it is given", proved=True)
    parts = by.step(
        f"{letter} = ",
        block,
        ",  t = ",
        offset,
        because="its 3×3 block and its translation",
        proved=by.same(affine(block, offset), M),
    )
    inner = inverse(block, letter, InverseBy.ADJUGATE, by)
    back = _taken_back(inner.value, offset, letter, by)
    value = affine(inner.value, back.value)
    named = raised(name, "⁻¹")
    last = by.step(
        f"{named} = ",
        value,
        because=f"{letter}⁻¹ is its block and −{letter}⁻¹ t its translation",
        proved=by.is_identity(by.product(value, M)),
    )
    check = unit_check(M, value, (name, named), by)
    return Working((first, parts, *inner.steps[1:], *back.steps, last, check), value)


def _taken_back(block: Matrix, offset: Vector, letter: str, by: Notation) -> Working:
    """Take a translation through the inverse of a block, and turn it round: −A⁻¹ t."""
    there = product(block, offset, (f"{letter}⁻¹", "t"), by=by)
    value = by.scaled(there.value, -ONE)
    proved = by.same(by.scaled(value, -ONE), there.value)
    turned = by.step(f"−{letter}⁻¹ · t = ", value, because="every sign changed", proved=proved)
    return Working((*there.steps, turned), value)


def affine(block: Matrix, offset: Vector) -> Matrix:
    """Put a 3×3 block and a translation into a 4×4 matrix."""
    zero = ONE - ONE
    rows = tuple((*row, t) for row, t in zip(block, offset, strict=True))
    return (*rows, (zero, zero, zero, ONE))


def _is_affine(A: Matrix, by: Notation) -> bool:
    return len(A) == 4 and all(
        by.same(entry, ONE if i == 3 else ONE - ONE) for i, entry in enumerate(A[3])
    )


def _singular() -> NoAnswerError:
    return NoAnswerError(
        "a singular matrix (determinant 0)",
        "it flattens space, so nothing undoes it",
        "ask for the cofactor matrix, which always exists",
    )
