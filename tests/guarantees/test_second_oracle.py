"""A second exact oracle, written by others: it must agree with ours on every finite matrix."""

from __future__ import annotations

from fractions import Fraction

import flint
from hypothesis import given, settings
from hypothesis import strategies as st

from nmatrix.linear.exact import LinearMap

entries = st.one_of(
    st.floats(allow_nan=False, allow_infinity=False),
    st.integers(-3, 3).map(float),
    st.integers(-1070, 1020).map(lambda e: 2.0**e),
)
matrices = st.lists(st.lists(entries, min_size=3, max_size=3), min_size=3, max_size=3)


def rational(value: float) -> flint.fmpq:
    top, bottom = value.as_integer_ratio()
    return flint.fmpq(top, bottom)


def ours(value: flint.fmpq) -> Fraction:
    return Fraction(int(value.p), int(value.q))


@given(matrices)
@settings(max_examples=300, deadline=None)
def test_determinant_rank_and_inverse_agree(rows: list[list[float]]) -> None:
    theirs = flint.fmpq_mat([[rational(x) for x in row] for row in rows])
    linear_map = LinearMap.of(rows)
    assert linear_map.determinant == ours(theirs.det())
    assert linear_map.rank == theirs.rank()
    if linear_map.rank == 3:
        inverse = theirs.inv().transpose()
        for i in range(3):
            for j in range(3):
                assert linear_map.inverse_transpose[i][j] == ours(inverse[i, j])
