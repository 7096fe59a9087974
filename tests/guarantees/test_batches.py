"""Batches: where they are written, how much memory they take, what is refused and how."""

from __future__ import annotations

import re
import tracemalloc
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import nmatrix
from nmatrix.enums import Level
from nmatrix.errors import IllegalValueError
from nmatrix.linear import batched

Array = NDArray[Any]


def test_out_is_written_and_returned() -> None:
    A = np.random.default_rng(5).normal(size=(5000, 3, 3))
    out = np.empty_like(A)
    assert nmatrix.normal_matrices(A, out) is out
    assert (out == nmatrix.normal_matrices(A)).all()


@pytest.mark.parametrize("level", [Level.CERTIFIED, Level.GUARDED])
@pytest.mark.parametrize("family", ["ordinary", "flat", "wild"])
def test_memory_is_input_output_and_four_mebibytes(family: str, level: Level) -> None:
    rng = np.random.default_rng(1)
    A = rng.normal(size=(100_000, 3, 3))
    if family == "flat":
        A *= [1, 1e-5, 1]
    elif family == "wild":
        A *= 2.0 ** rng.integers(-400, 400, size=(len(A), 1, 1))
    out = np.empty_like(A)
    tracemalloc.start()
    batched.normal_matrices_by_row(A, out, level)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 4 << 20


MISUSE = [
    (np.zeros((0, 3, 3)), "0 matrices"),
    (np.zeros((3, 3)), "shape (3, 3)"),
    (np.zeros((2, 4, 4)), "shape (2, 4, 4)"),
    ("text", "numbers"),
    ([[["a"] * 3] * 3], "numbers"),
    (np.array([[[object()] * 3] * 3]), "numbers"),
    ([[1, 2], [3]], "numbers"),
]


@pytest.mark.parametrize(("given", "says"), MISUSE)
def test_bad_batches_are_refused_with_a_reason(given: object, says: str) -> None:
    with pytest.raises(IllegalValueError, match=re.escape(says)):
        nmatrix.normal_matrices(given)


CARRYING = [
    (np.zeros((4, 4)), np.ones((1, 3)), None, "matrix of shape (4, 4)"),
    (np.full((3, 3), np.nan), np.ones((1, 3)), None, "matrix [0, 0] (nan)"),
    (np.eye(3), np.ones((2, 4)), None, "normals of shape (2, 4)"),
    (np.eye(3), np.ones((2, 3)), np.ones((1, 3)), "out of shape (1, 3)"),
    (np.eye(3), np.ones((2, 3)), np.ones((2, 3), int), "out of shape (2, 3), int64"),
    (np.eye(3), np.ones((2, 3)), [[0, 0, 0]] * 2, "out of type list"),
]


@pytest.mark.parametrize(("matrix", "normals", "out", "says"), CARRYING)
def test_what_cannot_be_carried_is_refused(matrix, normals, out, says: str) -> None:
    with pytest.raises(IllegalValueError, match=re.escape(says)):
        nmatrix.carry_normals(matrix, normals, out)


@pytest.mark.parametrize("tolerance", [0.0, -1.0, float("nan")])
def test_a_tolerance_is_positive(tolerance: float) -> None:
    with pytest.raises(IllegalValueError, match="positive angle"):
        nmatrix.certified_normals([np.eye(3)], [[0, 0, 1]], tolerance)


def test_one_bad_number_in_many_is_named() -> None:
    A = np.ones((100_000, 3, 3))
    A[99_999, 1, 2] = np.nan
    with pytest.raises(IllegalValueError, match=r"\[99999, 1, 2\] \(nan\)"):
        nmatrix.normal_matrices(A)
