"""What Hypothesis draws for the guarantees: floats of every kind, hard matrices, hard triangles."""

from __future__ import annotations

import struct
from math import inf, isfinite, ldexp, nextafter

import numpy as np
from hypothesis import strategies as st

from nmatrix.studies.hardcases.coverage import half_pixel_grid

Matrix = list[list[float]]

SMALLEST = 5e-324

bit_patterns = (
    st.binary(min_size=8, max_size=8).map(lambda raw: struct.unpack("<d", raw)[0]).filter(isfinite)
)
small_integers = st.integers(-3, 3).map(float)
powers = st.integers(-1070, 1020).map(lambda e: 2.0**e)
subnormals = st.integers(-(2**20), 2**20).map(lambda k: k * SMALLEST)
entries = st.one_of(bit_patterns, small_integers, powers, subnormals, st.floats(-10, 10))


def three_by_three(numbers: st.SearchStrategy[float]) -> st.SearchStrategy[Matrix]:
    return st.lists(st.lists(numbers, min_size=3, max_size=3), min_size=3, max_size=3)


def near_singular(rows: Matrix, a: int, b: int, shift: int) -> Matrix:
    """Make the third row a combination of the others, a few units in the last place off."""
    third = [a * x + b * y for x, y in zip(rows[0], rows[1], strict=True)]
    for _ in range(abs(shift)):
        third[0] = nextafter(third[0], inf if shift > 0 else -inf)
    return [rows[0], rows[1], third]


def on_a_ladder(rows: Matrix, down: list[int], across: list[int]) -> Matrix:
    """Scale rows and columns by powers of two."""
    return [
        [ldexp(x, i + j) for x, j in zip(row, across, strict=True)]
        for row, i in zip(rows, down, strict=True)
    ]


steps = st.lists(st.integers(-250, 250), min_size=3, max_size=3)
matrices = three_by_three(entries)
cancelling = st.builds(
    near_singular,
    st.lists(st.lists(st.floats(-4, 4), min_size=3, max_size=3), min_size=2, max_size=2),
    st.integers(-3, 3),
    st.integers(-3, 3),
    st.integers(-3, 3),
)
ladders = st.builds(on_a_ladder, three_by_three(st.floats(-10, 10)), steps, steps)
subnormal_matrices = three_by_three(subnormals)
any_matrix = st.one_of(matrices, cancelling, ladders, subnormal_matrices)
vectors = st.lists(entries, min_size=3, max_size=3)

# Triangles (N, 3, 2) that fill a canvas of 64 × 64, with corners on samples or half way between.
half_pixel_grids = st.integers(0, 2**32 - 1).map(
    lambda seed: half_pixel_grid(np.random.default_rng(seed))
)
