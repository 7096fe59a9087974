"""Every kind of working, of small fractions that are drawn; what has no answer refuses."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from fractions import Fraction

from nmatrix.enums import DeterminantBy, Handedness, InverseBy
from nmatrix.working import determinants, elimination, inverses, products, vectors, view
from nmatrix.working.working import Working

Make = Callable[[], Working]


def entry(draws: random.Random) -> Fraction:
    """Draw a small fraction; one in four is 0."""
    if draws.random() < 0.25:
        return Fraction(0)
    return Fraction(draws.randint(-9, 9), draws.choice((1, 1, 1, 2, 3, 4, 7)))


def matrix(draws: random.Random, rows: int, columns: int) -> tuple[tuple[Fraction, ...], ...]:
    return tuple(tuple(entry(draws) for _ in range(columns)) for _ in range(rows))


def column(draws: random.Random, n: int) -> tuple[Fraction, ...]:
    return tuple(entry(draws) for _ in range(n))


def workings(draws: random.Random) -> Iterator[tuple[str, Make]]:
    """List every kind of working, of numbers that are drawn."""
    n = draws.randint(2, 4)
    A, B, v = matrix(draws, n, n), matrix(draws, n, draws.randint(1, 4)), column(draws, n)
    wide = matrix(draws, n, draws.randint(2, 5))
    affine = inverses.affine(matrix(draws, 3, 3), column(draws, 3))
    a, b = column(draws, 3), column(draws, 3)
    yield "product", lambda: products.product(A, B)
    yield "product with a vector", lambda: products.product(A, v, result="w")
    yield "products in turn", lambda: products.chained([A, A, A], ("A", "B", "C"), "M")
    yield "sum", lambda: products.total(A, A)
    yield "difference", lambda: products.difference(a, b)
    yield "multiple", lambda: products.times(entry(draws), A, "W")
    yield "transpose", lambda: products.transpose(B)
    for by in DeterminantBy:
        yield f"det by {by}", lambda by=by: determinants.det(A, method=by)
    for way in InverseBy:
        if way is not InverseBy.BLOCKS:
            yield f"inverse by {way}", lambda way=way: inverses.inverse(A, method=way)
        yield f"affine inverse by {way}", lambda way=way: inverses.inverse(affine, method=way)
    yield "inverse transpose", lambda: inverses.inverse_transpose(A)
    yield "cofactors", lambda: determinants.cofactors(A)
    yield "rank", lambda: elimination.rank(wide)
    yield "rref", lambda: elimination.rref(wide)
    yield "solve", lambda: elimination.solve(A, v)
    yield "null space", lambda: elimination.null_space(wide)
    yield "dot", lambda: vectors.dot(a, b)
    yield "length", lambda: vectors.length(a)
    yield "normalize", lambda: vectors.normalize(a)
    yield "cross", lambda: vectors.cross(a, b)
    yield "angle", lambda: vectors.angle(a, b)
    yield "project", lambda: vectors.project(matrix(draws, 4, 4), a)
    hand = draws.choice(list(Handedness))
    yield "look at", lambda: view.look_at(a, b, handed=hand)
