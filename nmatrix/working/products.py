"""Products and sums of matrices and vectors, entry by entry."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from nmatrix.report import Step
from nmatrix.working.working import (
    EXACT,
    ONE,
    Entry,
    Matrix,
    Notation,
    Proof,
    Vector,
    Working,
    added,
    cells_or_entries,
    fits,
    identity,
    is_matrix,
    raised,
    transposed,
)


def product(
    A: Matrix,
    B: Matrix | Vector,
    names: tuple[str, str] = ("A", "B"),
    result: str = "",
    by: Notation = EXACT,
) -> Working:
    """Multiply two matrices, or a matrix and a vector, each entry a row times a column.

    Parameters
    ----------
    A, B
        n×m, and m×k or a vector of m.
    names
        What the two are called.
    result
        What their product is called.

    Examples
    --------
    >>> found = product(((2, 0), (1, 3)), (1, 4))
    >>> found.steps[1].formula.parts, found.value
    (('A · B = ', (('2·1 + 0·4',), ('1·1 + 3·4',))), (2, 13))
    """
    is_vector = not is_matrix(B)
    right: Matrix = tuple((x,) for x in B) if is_vector else B
    value = by.product(A, right)
    again = transposed(by.product(transposed(right), transposed(A)))
    proved = by.same(value, again)
    what = " · ".join(f"({name})" if " + " in name else name for name in names)
    name, sums = _named_sums(what, result, A, right, by)
    letter = name if name != what else "P"
    where = "row {row} times the column" if is_vector else "row {row} times column {column}"
    proof = Proof(by, letter, "the sums", where, proved)
    steps = [
        by.step(
            f"{name} = " if name == what else f"{name} = {what} = ",
            A,
            " · ",
            right,
            because="each entry will be a row of the first times the column of the second"
            if is_vector
            else "each entry will be a row of the first times a column of the second",
            proved=proved,
        ),
        *cells_or_entries(name, sums[0], value, sums[1], proof),
    ]
    return Working(tuple(steps), tuple(row[0] for row in value) if is_vector else value)


def _named_sums(
    what: str, result: str, A: Matrix, B: Matrix, by: Notation
) -> tuple[str, tuple[list[list[str]], str]]:
    """Write all sums of a product, without zeros if only so they find room, under one name.

    What finds no room at all gets a name, so that its entries have one.
    """
    pairs = [[tuple(zip(row, column, strict=True)) for column in transposed(B)] for row in A]
    full = [[by.products(one) for one in row] for row in pairs]
    short = [[_without_zeros(one, by) for one in row] for row in pairs]
    name = result or what
    if fits(f"{name} = ", full):
        return name, (full, "row times column")
    if fits(f"{name} = ", short):
        return name, (short, "row times column; products with a factor 0 are left out")
    return result or "P", (full, "row times column")


def _without_zeros(pairs: Sequence[tuple[Entry, Entry]], by: Notation) -> str:
    kept = [(a, b) for a, b in pairs if not (by.is_zero(a) or by.is_zero(b))]
    return by.products(kept) if kept else "0"


def unit_check(
    A: Matrix, B: Matrix, names: tuple[str, str], by: Notation = EXACT, because: str = "the check"
) -> Step:
    """Multiply what must give I: the last line of a calculation.

    Examples
    --------
    >>> unit_check(((2, 0), (0, 1)), ((ONE / 2, 0), (0, 1)), ("A", "B")).verified
    True
    """
    found = by.product(A, B)
    proved = by.is_identity(found) and by.is_identity(by.product(B, A))
    shown = identity(len(A)) if proved else found
    end = " = I" if proved else ""
    return by.step(f"{names[0]} · {names[1]} = ", shown, end, because=because, proved=proved)


def chained(
    matrices: Sequence[Matrix], names: Sequence[str], result: str, by: Notation = EXACT
) -> Working:
    """Multiply several matrices in turn, from left to right.

    Examples
    --------
    >>> D = ((2, 0), (0, 3))
    >>> chained([D, D, D], ("A", "B", "C"), "M").value
    ((8, 0), (0, 27))
    """
    value, name = matrices[0], names[0]
    steps: list[Step] = []
    for i in range(1, len(matrices)):
        is_last = i == len(matrices) - 1
        found = product(value, matrices[i], (name, names[i]), result if is_last else "", by)
        steps += found.steps
        value, name = found.value, f"{name} · {names[i]}"
    return Working(tuple(steps), value)


def total(
    A: Matrix | Vector,
    B: Matrix | Vector,
    names: tuple[str, str] = ("A", "B"),
    result: str = "",
    by: Notation = EXACT,
) -> Working:
    """Add two matrices or vectors.

    Examples
    --------
    >>> total((1, 2), (3, -4)).steps[1].formula.parts
    ('A + B = ', (('1 + 3',), ('2 − 4',)))
    """
    return _entrywise(A, B, f"{names[0]} + {names[1]}", result, by, sign=1)


def difference(
    A: Matrix | Vector,
    B: Matrix | Vector,
    names: tuple[str, str] = ("A", "B"),
    result: str = "",
    by: Notation = EXACT,
) -> Working:
    """Subtract a matrix or a vector from another.

    Examples
    --------
    >>> difference((1, 2), (3, -4)).steps[1].formula.parts
    ('A − B = ', (('1 − 3',), ('2 − (−4)',)))
    """
    return _entrywise(A, B, f"{names[0]} − {names[1]}", result, by, sign=-1)


def _entrywise(
    A: Matrix | Vector, B: Matrix | Vector, what: str, result: str, by: Notation, *, sign: int
) -> Working:
    left, right = (one if is_matrix(one) else tuple((x,) for x in one) for one in (A, B))
    value = tuple(
        tuple(by.tidy(a + sign * b) for a, b in zip(r, s, strict=True))
        for r, s in zip(left, right, strict=True)
    )
    cells = [
        [
            added([by.write(a), by.write(b)]) if sign > 0 else f"{by.write(a)} − {by.factor(b)}"
            for a, b in zip(r, s, strict=True)
        ]
        for r, s in zip(left, right, strict=True)
    ]
    back = [
        [by.tidy(c - sign * b) for c, b in zip(r, s, strict=True)]
        for r, s in zip(value, right, strict=True)
    ]
    proved = by.same(left, back)
    name, letter = result or what, result or "S"
    mark = " + " if sign > 0 else " − "
    if not result and not fits(f"{name} = ", cells):
        name = letter
    proof = Proof(by, letter, "the results", "row {row}, column {column}", proved)
    steps = [
        by.step(
            f"{name} = " if name == what else f"{name} = {what} = ",
            left,
            mark,
            right,
            because="entry by entry",
            proved=proved,
        ),
        *cells_or_entries(name, cells, value, "the entries at the same places", proof),
    ]
    return Working(tuple(steps), value if is_matrix(A) else tuple(row[0] for row in value))


def times(
    factor: Entry, A: Matrix | Vector, name: str, what: str = "", by: Notation = EXACT
) -> Working:
    """Multiply every entry by a number; `what` is how the product is called, `name` the result.

    Examples
    --------
    >>> times(3, (1, -2), "w", "3 v").value
    (3, -6)
    """
    rows = A if is_matrix(A) else tuple((x,) for x in A)
    value = tuple(by.scaled(row, factor) for row in rows)
    proved = by.is_zero(factor) or by.same(
        rows, [[by.tidy(x * (ONE / factor)) for x in r] for r in value]
    )
    step = by.step(
        f"{name} = {what} = {by.factor(factor, is_first=True)} · "
        if what
        else f"{name} = {by.factor(factor, is_first=True)} · ",
        rows,
        " = ",
        value,
        because="every entry times the number",
        proved=proved,
    )
    return Working((step,), value if is_matrix(A) else tuple(row[0] for row in value))


def transpose(A: Matrix, name: str = "A", by: Notation = EXACT) -> Working:
    """Exchange rows and columns.

    Examples
    --------
    >>> transpose(((1, 2), (3, 4))).value
    ((1, 3), (2, 4))
    """
    value = transposed(A)
    step = by.step(
        f"{raised(name, 'ᵀ')} = ",
        value,
        because="the rows have become columns",
        proved=by.same(transposed(value), tuple(map(tuple, A))),
    )
    return Working((*given([(name, A)], by), step), value)


def given(values: Sequence[tuple[str, Matrix | Vector]], by: Notation = EXACT) -> Iterator[Step]:
    """Write down what a calculation starts from.

    Examples
    --------
    >>> [step.formula.parts for step in given([("v", (1, 2))])]
    [('v = ', (('1',), ('2',)))]
    """
    for name, value in values:
        yield by.step(f"{name} = ", value, because="as it is given", proved=True)
