"""How long commands take, as ratios to importing what they need, in one interleaved run.

Run it by hand: `python tests/benchmarks/startup.py`. Absolute times mean nothing on a shared
machine; medians of interleaved pairs do.
"""

from __future__ import annotations

import compileall
import random
import subprocess
import sys
import time
from pathlib import Path
from statistics import median

import nmatrix

ROUNDS = 21
MODULE = [sys.executable, "-m", "nmatrix"]


def seconds(words: list[str]) -> float:
    start = time.perf_counter()
    done = subprocess.run(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
    spent = time.perf_counter() - start
    assert done.returncode in (0, 1), words  # 1: `check` found a mistake
    return spent


def ratio(words: list[str], imports: str) -> float:
    """Return the median time of a command over the median time of an import."""
    base = [sys.executable, "-c", f"import {imports}"]
    pairs = [(seconds(base), seconds(words)) for _ in range(ROUNDS + 1)][1:]
    return median(b for _, b in pairs) / median(a for a, _ in pairs)


def normals() -> float:
    """Return the median microseconds of one exact unit normal on ordinary numbers."""
    from nmatrix.linear.exact import LinearMap

    rng, times = random.Random(1), []
    for _ in range(3000):
        A = [[rng.gauss(0, 1) for _ in range(3)] for _ in range(3)]
        n = [rng.gauss(0, 1) for _ in range(3)]
        start = time.perf_counter()
        LinearMap.of(A).normal(n)
        times.append(time.perf_counter() - start)
    return median(times) * 1e6


def main() -> None:
    # An installed package has its bytecode; a checkout may not.
    compileall.compile_dir(Path(nmatrix.__file__).parent, quiet=1)
    rows = [
        ("world --scale 1 2 1", "numpy, typer", 1.15),
        ("--help", "typer", 2.5),
        ("derive", "sympy", 1.5),
    ]
    for line, imports, goal in rows:
        found = ratio([*MODULE, *line.split()], imports)
        print(f"nmatrix {line:22} {found:5.2f} x (import {imports}), goal {goal}")
    print(f"one exact normal {normals():23.0f} µs, goal 100")


if __name__ == "__main__":
    main()
