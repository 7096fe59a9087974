"""Determinants by expansion, by Sarrus and by elimination; minors and cofactors."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import prod

from nmatrix.enums import DeterminantBy
from nmatrix.errors import IllegalValueError
from nmatrix.report import Formula, Step
from nmatrix.typed import LOWERED
from nmatrix.working.elimination import Elimination
from nmatrix.working.working import (
    EXACT,
    Entry,
    Matrix,
    Notation,
    Proof,
    Working,
    added,
    cells_or_entries,
    chain,
    lines,
    lowered,
    transposed,
    without,
)

EXPANDED = 4  # rows of the largest matrix that is expanded unless it is asked for
MOST_EXPANDED = 6  # rows; the next one would take thousands of lines
Product = tuple[int, tuple[Entry, ...]]  # a sign, and what is multiplied


def det(
    A: Matrix,
    name: str = "A",
    method: DeterminantBy | None = None,
    by: Notation = EXACT,
    *,
    shown: bool = True,
) -> Working:
    """Work a determinant out.

    Without a method a 3×3 matrix is taken by Sarrus, or expanded where a row or a column has two
    zeros, 4×4 is expanded, and what is larger eliminated.

    Parameters
    ----------
    A
        A square matrix.
    name
        What it is called.
    method
        Sarrus is for 3×3, expansion for at most 6×6.
    shown
        Whether its numbers are written down first.

    Raises
    ------
    IllegalValueError
        For a matrix that the method is not for.

    Examples
    --------
    >>> found = det(((1, 2), (3, 4)), shown=False)
    >>> found.steps[0].formula.parts, found.value
    (('det A = 1·4 − 2·3 = 4 − 6 = −2',), -2)
    """
    n = len(A)
    if method is DeterminantBy.SARRUS and n != 3:
        raise IllegalValueError(
            f"{n}×{n} by Sarrus", "his rule is for 3×3", "expand it, or eliminate"
        )
    if method is DeterminantBy.EXPANSION and n > MOST_EXPANDED:
        raise IllegalValueError(
            f"{n}×{n} by expansion", "that takes thousands of lines", "eliminate"
        )
    first = [by.step(f"{name} = ", A, because="as it is given", proved=True)] if shown else []
    chosen = _usual(A, by) if method is None else method
    if n <= 2 or chosen is DeterminantBy.SARRUS:
        found = _short_rule(A, f"det {name}", by)
    elif chosen is DeterminantBy.EXPANSION:
        found = _expanded(A, name, by)
    else:
        found = _eliminated(A, name, by)
    return Working((*first, *found.steps), found.value)


def _usual(A: Matrix, by: Notation) -> DeterminantBy:
    if len(A) == 3:
        zeros = max(_zeros(line, by) for line in (*A, *transposed(A)))
        return DeterminantBy.EXPANSION if zeros >= 2 else DeterminantBy.SARRUS
    return DeterminantBy.EXPANSION if len(A) <= EXPANDED else DeterminantBy.ELIMINATION


def _zeros(line: Sequence[Entry], by: Notation) -> int:
    return sum(map(by.is_zero, line))


def _known(A: Matrix, value: Entry, by: Notation) -> bool:
    """Compare a determinant with that of the transpose, which is expanded along another line."""
    return by.same(by.determinant(transposed(A)), value)


def _diagonals(A: Matrix) -> tuple[Product, ...]:
    """List the products of the rule for up to three rows: those down to the right, then others."""
    n = len(A)
    if n == 1:
        return ((1, (A[0][0],)),)
    if n == 2:
        return ((1, (A[0][0], A[1][1])), (-1, (A[0][1], A[1][0])))
    down = tuple((1, tuple(A[i][(k + i) % 3] for i in range(3))) for k in range(3))
    up = tuple((-1, tuple(A[i][(k - i) % 3] for i in range(3))) for k in (2, 0, 1))
    return (*down, *up)


def _short_rule(A: Matrix, name: str, by: Notation) -> Working:
    """Multiply along the diagonals, and add with their signs: a line for each."""
    terms = _diagonals(A)
    line, value = sum_of(terms, by)
    n = len(A)
    about = {
        1: "the only entry",
        2: "down to the right, minus down to the left",
        3: "Sarrus: three products down to the right, minus three down to the left",
    }[n]
    proved = _known(A, value, by)
    return Working(
        tuple(lines(name, line, (about, "the products", "the sum"), proved=proved)), value
    )


def sum_of(terms: Sequence[Product], by: Notation) -> tuple[tuple[str, str, str], Entry]:
    """Write a sum of products, the products, and their sum; the value is the sum.

    Examples
    --------
    >>> sum_of([(1, (2, 4)), (-1, (3, -1))], EXACT)
    (('2·4 − 3·(−1)', '8 − (−3)', '11'), 11)
    """
    products = [by.tidy(prod(rest, start=first)) for _, (first, *rest) in terms]
    value = by.sum(sign * one for (sign, _), one in zip(terms, products, strict=True))
    first = "".join(
        _signed(sign, "·".join(_factors(factors, by, is_first=not i and sign > 0)), is_first=not i)
        for i, (sign, factors) in enumerate(terms)
    )
    second = added(
        by.write(one) if sign > 0 else f"−{by.factor(one)}"
        for (sign, _), one in zip(terms, products, strict=True)
    )
    return (first, second, by.write(value)), value


def _factors(factors: Sequence[Entry], by: Notation, *, is_first: bool) -> Iterator[str]:
    for place, one in enumerate(factors):
        yield by.factor(one, is_first=is_first and not place)


def _signed(sign: int, text: str, *, is_first: bool) -> str:
    if is_first:
        return text if sign > 0 else f"−{text}"
    return f" + {text}" if sign > 0 else f" − {text}"


def _expanded(A: Matrix, name: str, by: Notation) -> Working:
    """Expand along the row or column with most zeros; each smaller determinant gets its lines."""
    n = len(A)
    ways = [(_zeros(A[i], by), -i, "row") for i in range(n)]
    ways += [(_zeros(line, by), -i, "column") for i, line in enumerate(transposed(A))]
    _, minus, kind = max(ways, key=lambda one: (one[0], one[2] == "row", one[1]))
    k = -minus
    places = [(k, j) if kind == "row" else (j, k) for j in range(n)]
    places = [(i, j) for i, j in places if not by.is_zero(A[i][j])]
    along = f"along {kind} {k + 1}"
    if not places:
        zero = A[k][0] if kind == "row" else A[0][k]
        about = f"{kind} {k + 1} holds nothing but 0"
        last = by.step(f"det {name} = 0", because=about, proved=_known(A, zero, by))
        return Working((last,), zero)
    smaller = [det(without(A, i, j), "", None, by, shown=False) for i, j in places]
    terms = [
        ((-1) ** (i + j), (A[i][j], one.value)) for (i, j), one in zip(places, smaller, strict=True)
    ]
    texts, value = sum_of(terms, by)
    proved = _known(A, value, by)
    names = [f"m{_indices(name)}{lowered(i + 1, j + 1)}" for i, j in places]
    steps: list[Step] = [_first_line(A, name, places, along, by, proved=proved)]
    for minor_name, (i, j) in zip(names, places, strict=True):
        part = without(A, i, j)
        steps += _minor(part, minor_name, by)
    about = f"the entries {along} times their determinants, with the signs of the chessboard"
    steps += lines(f"det {name}", texts, (about, "the products", "the sum"), proved=proved)
    return Working(tuple(steps), value)


def _indices(name: str) -> str:
    """Read what was left out already: a minor of M₁₂ without row 3 and column 1 is M₁₂₃₁."""
    return name[1:] if name[:1] == "M" and set(name[1:]) <= set(LOWERED) else ""


def _first_line(
    A: Matrix,
    name: str,
    places: Sequence[tuple[int, int]],
    along: str,
    by: Notation,
    *,
    proved: bool,
) -> Step:
    parts: list[str | tuple[tuple[str, ...], ...]] = []
    for count, (i, j) in enumerate(places):
        sign = (-1) ** (i + j)
        text = by.factor(A[i][j], is_first=not count and sign > 0)
        parts += [_signed(sign, text, is_first=not count) + " · det "]
        parts += [by.rows(without(A, i, j))]
    head, *rest = parts
    about = f"expanded {along}: an entry that is 0 needs no determinant"
    if len(places) == len(A):
        about = f"expanded {along}"
    return Step(Formula((f"det {name} = {head}", *rest)), about, bool(proved))


def _minor(A: Matrix, name: str, by: Notation) -> list[Step]:
    """Work a smaller determinant out, under a name of its own."""
    if len(A) <= 2:
        return list(_short_rule(A, name, by).steps)
    inner = f"M{name[1:]}"
    found = det(A, inner, None, by, shown=False)
    part = by.step(f"{inner} = ", A, because="what is left of the matrix", proved=True)
    last = by.step(
        f"{name} = det {inner} = {by.write(found.value)}",
        because="the determinant just found",
        proved=_known(A, found.value, by),
    )
    return [part, *found.steps, last]


def _eliminated(A: Matrix, name: str, by: Notation) -> Working:
    """Bring the matrix to a triangle, and multiply its diagonal."""
    n = len(A)
    work = Elimination([tuple(row) for row in A], by)
    work.to_echelon(n, reduced=False)
    other = Elimination([tuple(row) for row in transposed(A)], by)
    other.to_echelon(n, reduced=False)
    if len(work.pivots) < n:
        zero = work.rows[-1][-1]
        about = "a row is left without a pivot"
        last = by.step(f"det {name} = 0", because=about, proved=len(other.pivots) < n)
        return Working((*work.steps, last), zero)
    diagonal = tuple(work.rows[i][i] for i in range(n))
    sign = (-1) ** work.swaps
    texts, value = sum_of([(sign, diagonal)], by)
    others = sum_of([((-1) ** other.swaps, tuple(other.rows[i][i] for i in range(n)))], by)[1]
    turned = f"; {work.swaps} exchanges of rows change the sign" if sign < 0 else ""
    turned = turned.replace("1 exchanges of rows change", "one exchange of rows changes")
    last = by.step(
        f"det {name} = {texts[0]} = {texts[2]}" if n > 1 else f"det {name} = {texts[2]}",
        because=f"the product of the pivots{turned}",
        proved=by.same(value, others),
    )
    return Working((*work.steps, last), value)


def cofactors(A: Matrix, name: str = "A", by: Notation = EXACT, *, shown: bool = True) -> Working:
    """Work out the cofactor matrix C: a determinant for each entry, with a sign.

    Raises
    ------
    IllegalValueError
        For a matrix that is not 2×2 to 4×4.

    Examples
    --------
    >>> cofactors(((1, 2), (3, 4))).value
    ((4, -3), (-2, 1))
    """
    n = len(A)
    if not 2 <= n <= EXPANDED:
        raise IllegalValueError(
            f"{n}×{n} by cofactors", "the steps are for 2×2 to 4×4", "take row operations"
        )
    first = [by.step(f"{name} = ", A, because="as it is given", proved=True)] if shown else []
    minors = tuple(tuple(by.determinant(without(A, i, j)) for j in range(n)) for i in range(n))
    value = tuple(
        tuple(by.tidy((-1) ** (i + j) * x) for j, x in enumerate(row))
        for i, row in enumerate(minors)
    )
    d = by.determinant(A)
    proved = by.same(
        by.product(transposed(A), value),
        tuple(tuple(d if i == j else d - d for j in range(n)) for i in range(n)),
    )
    about = "the cofactors: the signs + − + of a chessboard put to the minors"
    if not by.spells_out:
        about = "the cofactors: the determinants of what is left, with the signs of a chessboard"
    signed = by.step("C = ", value, because=about, proved=proved)
    return Working((*first, *_minors(A, minors, by, proved=proved), signed), value)


def _minors(A: Matrix, value: Matrix, by: Notation, *, proved: bool) -> list[Step]:
    """Write the determinants that are left without a row and a column."""
    n = len(A)
    if not by.spells_out:
        return []
    about = "without row {row} and column {column}"
    if n <= 3:
        cells = [
            [sum_of(_diagonals(without(A, i, j)), by)[0][0] for j in range(n)] for i in range(n)
        ]
        because = "the minors: each the determinant of what is left without its row and column"
        return cells_or_entries(
            "D", cells, value, because, Proof(by, "D", "the minors", about, proved)
        )
    steps: list[Step] = []
    for i in range(n):
        for j in range(n):
            entry, part = f"D{lowered(i + 1, j + 1)}", without(A, i, j)
            terms = [one for one in _diagonals(part) if not any(map(by.is_zero, one[1]))]
            texts = sum_of(terms, by)[0] if terms else [by.write(value[i][j])]
            where = f"{about.format(row=i + 1, column=j + 1)}; products with a 0 are left out"
            if len(terms) == len(_diagonals(part)):
                where = about.format(row=i + 1, column=j + 1)
            parts = (f"{entry} = det ", by.rows(part), chain("", texts))
            steps.append(Step(Formula(parts), where, proved))
    return [*steps, by.step("D = ", value, because="the minors", proved=proved)]
