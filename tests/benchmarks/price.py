"""What the certified level costs on every kind of map, worst kinds included, as a table for docs.

`python tests/benchmarks/price.py` prints times over `np.linalg.inv` on as many Gaussian matrices,
with their intervals; `--quick` takes fewer matrices.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np

import nmatrix
from nmatrix.studies.hardcases.families import (
    Draw,
    any_bits,
    near_singular,
    powers_of_two,
    subnormal,
)
from nmatrix.studies.harness import SEED, Harness, Ratio, Run

Array = np.ndarray

EXTREMES = np.array([0.0, 5e-324, 2.0**-1022, 1.0, 2.0**1023])


def gaussian(rng: np.random.Generator) -> Array:
    return rng.normal(size=(3, 3))


def extremes(rng: np.random.Generator) -> Array:
    """Make a matrix of nothing but zeros, ones, and the smallest and largest floats."""
    return rng.choice(EXTREMES, size=(3, 3)) * rng.choice([-1.0, 1.0], size=(3, 3))


def near_singular_ladder(rng: np.random.Generator) -> Array:
    """Make a near singular matrix with columns of any size, which pairs of floats cannot hold."""
    return np.ldexp(near_singular(rng), rng.integers(-400, 401, size=(1, 3)))


def flattened(rng: np.random.Generator) -> Array:
    """Make a matrix of rank 2, exactly, though no entry need be zero."""
    A = rng.integers(-999, 1000, size=(3, 3)).astype(float)
    A[2] = A[0] + A[1]
    return A


def rank_one(rng: np.random.Generator) -> Array:
    return np.outer(*rng.integers(1, 1000, size=(2, 3))).astype(float)


def repeated_row(rng: np.random.Generator) -> Array:
    """Make a matrix of random bits whose last row is its first."""
    A = any_bits(rng)
    A[2] = A[0]
    return A


def turned_anyhow(A: Array, rng: np.random.Generator) -> Array:
    return rng.normal(size=A.shape[:2])


def stretched_most(A: Array, _rng: np.random.Generator) -> Array:
    """Choose normals along what A stretches most: their images all but cancel."""
    return np.einsum("nij,i->nj", A, [0.3, 0.5, 0.81])


def along_the_first_row(A: Array, _rng: np.random.Generator) -> Array:
    return A[:, 0]


@dataclass(frozen=True)
class Family:
    """Maps of one kind, and normals to carry through them."""

    name: str
    draw: Draw
    normals: Callable[[Array, np.random.Generator], Array] = turned_anyhow


FAMILIES = (
    Family("Gaussian", gaussian),
    Family("subnormal", subnormal),
    Family("any bit patterns", any_bits),
    Family("ladders of powers of two", powers_of_two),
    Family("near singular", near_singular),
    Family("near singular, and normals that cancel", near_singular, stretched_most),
    Family("near singular, on a ladder of powers of two", near_singular_ladder),
    Family("zeros and the ends of the range", extremes),
    Family("rank 2 in whole numbers", flattened),
    Family("rank 1 in whole numbers", rank_one),
    Family("all zeros", lambda _: np.zeros((3, 3))),
    Family("silhouettes of any bit patterns", repeated_row, along_the_first_row),
)


def rows(count: int) -> Iterator[tuple[str, Ratio, Ratio]]:
    """Measure normal matrices, then normals, of each family over an inverse."""
    harness = Harness(time.perf_counter, max_seconds=3.0)
    rng = np.random.default_rng(SEED)
    usual = rng.normal(size=(count, 3, 3))
    out = np.empty_like(usual)

    def over_inverse(run: Run) -> Ratio:
        return harness.ratio(run, lambda: np.linalg.inv(usual))

    for family in FAMILIES:
        A = np.array([family.draw(rng) for _ in range(count)])
        n = family.normals(A, rng)
        matrices = partial(nmatrix.normal_matrix, A, kind="oriented", level="certified", out=out)
        normals = partial(nmatrix.transform_normals, A, n, level="certified", status=True)
        yield family.name, over_inverse(matrices), over_inverse(normals)


def short(found: Ratio) -> str:
    """Write a ratio with its interval, to two digits."""
    ratio, low, high = (
        f"{x:.0f}" if x >= 10 else f"{x:.1f}" for x in (found.ratio, found.low, found.high)
    )
    return f"{ratio} ({low}–{high})"


def main(count: int) -> None:
    print(f"{count} matrices; times over np.linalg.inv on as many Gaussian ones\n")
    print("| maps | normal matrices | normals |\n|---|---|---|")
    for name, matrices, normals in rows(count):
        print(f"| {name} | {short(matrices)} | {short(normals)} |", flush=True)


if __name__ == "__main__":
    main(1_000 if "--quick" in sys.argv else 5_000)
