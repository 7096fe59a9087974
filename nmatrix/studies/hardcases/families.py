"""Directed random cases: inputs made to be hard, reproducible by their seed."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import cycle
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.studies.hardcases.case import Case
from nmatrix.studies.hardcases.coverage import EDGES, half_pixel_grid, once_case
from nmatrix.studies.hardcases.normals import normal_case

Array = NDArray[Any]
Draw = Callable[[np.random.Generator], Array]

LARGEST_STEP = 3  # units in the last place by which a row misses the others


def near_singular(rng: np.random.Generator) -> Array:
    """Return a matrix whose last row is a combination of the others, but for a few last bits."""
    A = rng.normal(size=(3, 3))
    A[2] = rng.integers(-3, 4) * A[0] + rng.integers(-3, 4) * A[1]
    steps = rng.integers(-LARGEST_STEP, LARGEST_STEP + 1, size=3)
    A[2] += steps * np.spacing(A[2])
    return A[rng.permutation(3)]


def powers_of_two(rng: np.random.Generator) -> Array:
    """Return a matrix whose rows and columns stand on a ladder of powers of two."""
    ladder = rng.integers(-300, 301, size=(3, 1)) + rng.integers(-200, 201, size=(1, 3))
    return np.asarray(np.ldexp(rng.normal(size=(3, 3)), ladder))


def subnormal(rng: np.random.Generator) -> Array:
    """Return a matrix of a few of the smallest floats there are."""
    return rng.integers(-9, 10, size=(3, 3)) * 5e-324


def any_bits(rng: np.random.Generator) -> Array:
    """Return a matrix of random bit patterns; what is not finite becomes 1."""
    bits = rng.integers(0, 2**64, size=(3, 3), dtype=np.uint64).view(np.float64)
    return np.where(np.isfinite(bits), bits, 1.0)


def mirrored(rng: np.random.Generator) -> Array:
    """Return a matrix with a negative determinant, stretched by up to 10⁸."""
    U, V = (np.linalg.qr(rng.normal(size=(3, 3)))[0] for _ in range(2))
    A = U @ np.diag([1.0, 1e-4, 1e-8]) @ V
    return np.asarray(A if np.linalg.det(A) < 0 else -A)


NORMAL_FAMILIES: dict[str, Draw] = {
    "near singular": near_singular,
    "powers of two": powers_of_two,
    "subnormal": subnormal,
    "bit patterns": any_bits,
    "mirrored": mirrored,
}
GRID = "half-pixel grid"
NAMES = (*NORMAL_FAMILIES, GRID)


def random_cases(count: int, seed: int) -> Iterator[Case]:
    """Generate so many cases, the families in turn; the first ones do not depend on the count.

    Examples
    --------
    >>> [one.title for one in random_cases(2, 7)]
    ['near singular', 'powers of two']
    """
    rng = np.random.default_rng(seed)
    made_by = f"--random {count} --seed {seed} "
    for id_, family in zip(random_ids(count), cycle(NAMES), strict=False):
        yield _case(id_, family, rng, made_by)


def random_ids(count: int) -> list[str]:
    """Name so many random cases."""
    return [f"S{i}" for i in range(count)]


def _case(id_: str, family: str, rng: np.random.Generator, made_by: str) -> Case:
    if family == GRID:
        triangles = half_pixel_grid(rng)
        given = f"{len(triangles)} triangles with corners on halves of pixels"
        reason = "every edge may run through samples"
        return replace(once_case(id_, family, given, triangles, reason, EDGES), made_by=made_by)
    A = NORMAL_FAMILIES[family](rng)
    n = tuple(rng.normal(size=3).tolist())
    return replace(normal_case(id_, family, A, n, "made to be hard"), made_by=made_by)
