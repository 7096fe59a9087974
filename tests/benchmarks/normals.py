"""How fast normals are computed: `python tests/benchmarks/normals.py` prints ratios of one run.

Each line takes turns with its reference, and the median of the ratios is printed.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from statistics import median

import numpy as np
from nmatrix.linear.carrying import carried_by_column, carried_by_row

from nmatrix.enums import Level
from nmatrix.linear.batched import normal_matrices, normal_matrices_by_row

Run = Callable[[], object]


def ratio(run: Run, reference: Run, rounds: int) -> float:
    """Return how many times longer the reference takes."""
    found = []
    for _ in range(rounds + 1):
        took = []
        for one in (run, reference, reference, run):
            started = time.perf_counter()
            one()
            took.append(time.perf_counter() - started)
        found.append((took[1] + took[2]) / (took[0] + took[3]))
    return median(found[1:])


def naive(normals: np.ndarray, matrix: np.ndarray) -> np.ndarray:
    moved = normals @ matrix.T
    return moved / np.linalg.norm(moved, axis=1, keepdims=True)


def main(count: int, rounds: int) -> None:
    rng = np.random.default_rng(1)
    rows = rng.normal(size=(count, 3, 3))
    planes = np.ascontiguousarray(rows.transpose(1, 2, 0))
    wild = rows * 2.0 ** rng.integers(-400, 400, size=(count, 1, 1))
    by_row, by_plane = np.empty_like(rows), np.empty_like(planes)
    n, matrix = rng.normal(size=(count, 3)), rng.normal(size=(3, 3))
    turned = np.ascontiguousarray(n.T)
    out, out_turned = np.empty_like(n), np.empty_like(turned)

    def inv() -> object:
        return np.linalg.inv(rows)

    def line() -> object:
        return naive(n, matrix)

    table: list[tuple[str, Run, Run, str]] = [
        (
            "guarded, (N, 3, 3)",
            lambda: normal_matrices_by_row(rows, by_row, Level.GUARDED),
            inv,
            "≥ 12",
        ),
        (
            "guarded, (3, 3, N)",
            lambda: normal_matrices(planes, by_plane, Level.GUARDED),
            inv,
            "≥ 20",
        ),
        (
            "certified, (N, 3, 3)",
            lambda: normal_matrices_by_row(rows, by_row, Level.CERTIFIED),
            inv,
            "≥ 1",
        ),
        (
            "certified, (3, 3, N)",
            lambda: normal_matrices(planes, by_plane, Level.CERTIFIED),
            inv,
            "≥ 1",
        ),
        (
            "certified, any exponents",
            lambda: normal_matrices_by_row(wild, by_row, Level.CERTIFIED),
            inv,
            "≥ 0.5",
        ),
        ("one matrix, (N, 3)", lambda: carried_by_row(matrix, n, out), line, "≥ 2.5"),
        (
            "one matrix, (3, N)",
            lambda: carried_by_column(matrix, turned, out_turned),
            line,
            "≥ 4.8",
        ),
    ]
    print(f"{count} normals; how many times faster than np.linalg.inv, or than the naive line")
    for name, run, reference, goal in table:
        print(f"  {name:26}{ratio(run, reference, rounds):8.2f}   goal {goal}")


if __name__ == "__main__":
    quick = "--quick" in sys.argv
    main(100_000 if quick else 1_000_000, 3 if quick else 9)
