"""How fast normals are computed: `python tests/benchmarks/normals.py` prints ratios of one run.

Each line takes turns with its reference, and the median of the ratios is printed.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from statistics import median

import numpy as np

import nmatrix

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
    planes = np.ascontiguousarray(rows.transpose(1, 2, 0)).transpose(2, 0, 1)
    wild = rows * 2.0 ** rng.integers(-400, 400, size=(count, 1, 1))
    short = rows.astype(np.float32)
    n, matrix = rng.normal(size=(count, 3)), rng.normal(size=(3, 3))
    room = {id(one): np.empty_like(one) for one in (rows, planes, wild, short)}
    carried = np.empty_like(n)

    def inv() -> object:
        return np.linalg.inv(rows)

    def line() -> object:
        return naive(n, matrix)

    def matrices(given: np.ndarray, level: str, kind: str = "oriented") -> Run:
        return lambda: nmatrix.normal_matrix(given, kind=kind, level=level, out=room[id(given)])

    def normals(given: np.ndarray, level: str) -> Run:
        return lambda: nmatrix.transform_normals(given, n, level=level, out=carried)

    table: list[tuple[str, Run, Run, str]] = [
        ("guarded, (N, 3, 3)", matrices(rows, "guarded"), inv, "≥ 6"),
        ("guarded, planes", matrices(planes, "guarded"), inv, "≥ 8"),
        ("guarded, float32", matrices(short, "guarded"), inv, "≥ 6"),
        ("guarded A⁻ᵀ", matrices(rows, "guarded", "inverse-transpose"), inv, "≥ 5"),
        ("certified, (N, 3, 3)", matrices(rows, "certified"), inv, "≥ 1"),
        ("certified, any exponents", matrices(wild, "certified"), inv, "≥ 0.5"),
        ("certified A⁻ᵀ", matrices(rows, "certified", "inverse-transpose"), inv, "≥ 1"),
        ("certified normals, N maps", normals(rows, "certified"), inv, "≥ 1"),
        ("guarded normals, one map", normals(matrix, "guarded"), line, "≥ 2"),
        ("certified normals, one map", normals(matrix, "certified"), line, "≥ 0.5"),
    ]
    print(f"{count} normals; how many times faster than np.linalg.inv, or than the naive line")
    for name, run, reference, goal in table:
        print(f"  {name:28}{ratio(run, reference, rounds):8.2f}   goal {goal}")


if __name__ == "__main__":
    quick = "--quick" in sys.argv
    main(100_000 if quick else 1_000_000, 3 if quick else 9)
