"""How fast normals are computed: `python tests/benchmarks/normals.py` prints ratios of one run.

Each line takes turns with its reference. For a million it is the median of the ratios; for few, the
least time of each, of many calls. `NMATRIX_COMPILED=1` measures the compiled loop.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from functools import partial
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


def ratio_of_few(run: Run, reference: Run, calls: int) -> float:
    """Return how many times longer the reference takes, both at their best."""
    least = [float("inf")] * 2
    for _ in range(15):
        for i, one in enumerate((run, reference)):
            started = time.thread_time()
            for _ in range(calls):
                one()
            least[i] = min(least[i], time.thread_time() - started)
    return least[1] / least[0]


def few(sizes: tuple[int, ...]) -> None:
    """Print how the levels compare with an inverse for few matrices, near singular ones too."""
    rng = np.random.default_rng(2)
    print("times faster than np.linalg.inv, for so many matrices (N, 3, 3):")
    print(" " * 30 + "".join(f"{count:>8}" for count in sizes))
    for level in ("guarded", "certified"):
        for kind in ("oriented", "inverse-transpose"):
            ratios = []
            for count in sizes:
                A = rng.normal(size=(count, 3, 3))
                room = np.empty_like(A)
                call = partial(nmatrix.normal_matrix, A, kind=kind, level=level, out=room)
                calls = max(1, 3000 // (count + 10))
                ratios.append(ratio_of_few(call, partial(np.linalg.inv, A), calls))
            print(f"  {level + ', ' + kind:28}" + "".join(f"{one:8.2f}" for one in ratios))


def hard(count: int) -> None:
    """Print what it costs where plain sums settle nothing."""
    rng = np.random.default_rng(3)
    A, n = rng.normal(size=(count, 3, 3)), rng.normal(size=(count, 3))
    near = A.copy()
    near[:, 2] = 2 * A[:, 0] - A[:, 1]
    flat = rng.integers(-9, 10, (count, 3, 3)) * 1.0
    flat[:, 2] = flat[:, 0] + flat[:, 1]
    bits = rng.integers(0, 2**64, size=A.shape, dtype=np.uint64).view(np.float64)
    bits = np.where(np.isfinite(bits), bits, 1.0)
    bits_flat = bits.copy()
    bits_flat[:, 2] = bits[:, 0]
    families = {"near singular": near, "flat": flat, "any bits": bits, "any bits, flat": bits_flat}
    print(f"{count} hard ones: how many times longer than np.linalg.inv of ordinary ones")
    print(" " * 22 + "".join(f"{name:>18}" for name in families))
    for level in ("guarded", "certified"):
        for name in ("matrices", "normals"):
            ratios = []
            for given in families.values():
                matrices = partial(nmatrix.normal_matrix, given, kind="oriented", level=level)
                normals = partial(nmatrix.transform_normals, given, n, level=level, status=True)
                run = matrices if name == "matrices" else normals
                ratios.append(1 / ratio_of_few(run, partial(np.linalg.inv, A), 1))
            print(f"  {level + ' ' + name:20}" + "".join(f"{one:18.2f}" for one in ratios))


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
        ("guarded, planes", matrices(planes, "guarded"), inv, "≥ 6"),
        ("guarded, float32", matrices(short, "guarded"), inv, "≥ 6"),
        ("guarded A⁻ᵀ", matrices(rows, "guarded", "inverse-transpose"), inv, "≥ 5"),
        ("certified, (N, 3, 3)", matrices(rows, "certified"), inv, "≥ 1"),
        ("certified, any exponents", matrices(wild, "certified"), inv, "≥ 0.5"),
        ("certified A⁻ᵀ", matrices(rows, "certified", "inverse-transpose"), inv, "≥ 1"),
        ("certified normals, N maps", normals(rows, "certified"), inv, "≥ 1"),
        ("guarded normals, one map", normals(matrix, "guarded"), line, "≥ 1.5"),
        ("certified normals, one map", normals(matrix, "certified"), line, "≥ 0.2"),
    ]
    print(f"{count} normals; how many times faster than np.linalg.inv, or than the naive line")
    for name, run, reference, goal in table:
        print(f"  {name:28}{ratio(run, reference, rounds):8.2f}   goal {goal}")


if __name__ == "__main__":
    quick = "--quick" in sys.argv
    few((1, 10, 32, 100, 1000))
    hard(2_000)
    main(100_000 if quick else 1_000_000, 3 if quick else 9)
