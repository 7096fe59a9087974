"""A transform is exact whatever it is made of, and its three verbs are three rules."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from nmatrix.enums import Frame
from nmatrix.errors import IllegalValueError, NoAnswerError
from nmatrix.spaces.transform import Transform

ROWS = [[1, 0, 0, 5], [0, 2, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
TALL = Transform(Frame.WORLD, Frame.OBJECT, ROWS)


@pytest.mark.parametrize("kind", [np.float64, np.float32, np.int64])
def test_an_array_of_any_type_makes_the_same_transform_as_its_numbers(kind: type) -> None:
    assert Transform(Frame.WORLD, Frame.OBJECT, np.array(ROWS, kind)) == TALL
    assert all(type(entry) is Fraction for row in TALL.exact for entry in row)


def test_nine_numbers_move_nothing() -> None:
    block = [row[:3] for row in ROWS[:3]]
    assert Transform(Frame.WORLD, Frame.OBJECT, block).point((0, 0, 0)) == (0, 0, 0)


@pytest.mark.parametrize(
    "rows",
    [
        [[1, 0], [0, 1]],
        [[1, 0, 0], [0, 1], [0, 0, 1]],
        [*ROWS[:3], [0, 0, 1, 0]],
        [[float("nan"), 0, 0], [0, 1, 0], [0, 0, 1]],
        [[float("inf"), 0, 0], [0, 1, 0], [0, 0, 1]],
        [["a", 0, 0], [0, 1, 0], [0, 0, 1]],
        1.0,
    ],
)
def test_what_is_no_affine_matrix_is_refused_by_name(rows: object) -> None:
    with pytest.raises(IllegalValueError, match=r"^matrix"):
        Transform(Frame.WORLD, Frame.OBJECT, rows)


def test_points_vectors_and_normals_move_by_three_rules() -> None:
    assert TALL.point((1, 1, 0)) == (6, 2, 0)
    assert TALL.vector((1, 1, 0)) == (1, 2, 0)
    assert TALL.normal((3, 8, 0)) == (0.6, 0.8, 0)  # (3, 4, 0) after the inverse transpose
    back = TALL.inverse()
    assert (back.to, back.source) == (Frame.OBJECT, Frame.WORLD)
    assert back.point((6, 2, 0)) == (1, 1, 0)


def test_a_flattened_map_has_no_way_back_and_leaves_some_normals_without_an_image() -> None:
    flat = Transform(Frame.WORLD, Frame.OBJECT, [[1, 0, 0], [0, 0, 0], [0, 0, 1]])
    with pytest.raises(NoAnswerError, match="rank 2"):
        flat.inverse()
    assert flat.normal((0, 1, 0)) == (0, 1, 0)
    with pytest.raises(NoAnswerError, match="silhouette"):
        flat.normal((1, 0, 0))


def test_a_notebook_shows_its_frames_and_its_matrix() -> None:
    shown = Transform(Frame.CAMERA, Frame.OBJECT, [[1e-7, 0, 0], [0, 1 / 3, 0], [0, 0, 2.5]])
    latex = shown._repr_mimebundle_()["text/latex"]
    assert r"\text{camera} \leftarrow \text{object} = \begin{bmatrix}" in latex
    assert r"0 & \frac{1}{3} & 0 & 0 \\" in latex
