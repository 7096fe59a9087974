"""The certified level costs no more than an inverse: ratios of medians, taken in turns."""

from __future__ import annotations

import time
from collections.abc import Callable
from statistics import median

import numpy as np
import pytest

from nmatrix.enums import Level
from nmatrix.linear.batched import normal_matrices_by_row

COUNT, ROUNDS = 20_000, 9


def ratio(run: Callable[[], object], reference: Callable[[], object]) -> float:
    found = []
    for _ in range(ROUNDS + 1):
        took = []
        for one in (run, reference, reference, run):
            started = time.perf_counter()
            one()
            took.append(time.perf_counter() - started)
        found.append((took[0] + took[3]) / (took[1] + took[2]))
    return median(found[1:])


def cost(matrices: np.ndarray, times: int = 1) -> float:
    """Return the time of certified normal matrices over that of `np.linalg.inv`."""
    out = np.empty_like(matrices)

    def ours() -> None:
        for _ in range(times):
            normal_matrices_by_row(matrices, out, Level.CERTIFIED)

    return ratio(ours, lambda: np.linalg.inv(matrices))


@pytest.mark.slow
def test_certified_matrices_take_no_longer_than_an_inverse() -> None:
    rng = np.random.default_rng(1)
    ordinary = rng.normal(size=(COUNT, 3, 3))
    assert cost(ordinary) <= 1.0
    wild = ordinary * 2.0 ** rng.integers(-400, 400, size=(COUNT, 1, 1))
    assert cost(wild) <= 2.0


@pytest.mark.slow
def test_four_times_the_work_would_be_noticed() -> None:
    assert cost(np.random.default_rng(1).normal(size=(COUNT, 3, 3)), times=4) > 1.0
