"""Lines on meshes by geometry: where they lie, how many there are, what of them is seen."""

from __future__ import annotations

import numpy as np
import pytest

from nmatrix.raster.overlay.mesh_lines import (
    creases,
    edges_of,
    isoline,
    seen,
    silhouettes,
    visible_pieces,
)
from nmatrix.raster.proofs.letter import letter_r
from nmatrix.scene.meshes.mesh import Mesh
from nmatrix.scene.meshes.shapes import box, cone, plane, sphere, torus


def length(chains) -> float:
    return sum(float(np.sqrt((np.diff(one, axis=0) ** 2).sum(axis=1)).sum()) for one in chains)


def test_the_edge_of_the_light_on_a_ball_is_one_closed_great_circle() -> None:
    ball, to_light = sphere(32, 64), np.array([2.0, 3.0, 6.0]) / 7
    (line,) = isoline(ball.positions, ball.triangles, ball.normals @ to_light)
    assert (line[0] == line[-1]).all()
    assert np.abs(line @ to_light).max() < 1e-12
    assert length([line]) == pytest.approx(2 * np.pi, rel=2e-3)


def test_a_line_through_vertices_is_one_line() -> None:
    """The equator of the mesh: every crossing is a vertex, on whose one side the function is 0."""
    ball = sphere(16, 32)
    (line,) = isoline(ball.positions, ball.triangles, ball.positions[:, 1])
    assert np.abs(line[:, 1]).max() < 1e-12
    assert length([line]) == pytest.approx(2 * np.pi, rel=1e-2)


def test_where_nothing_changes_its_sign_there_is_no_line() -> None:
    ball = sphere(8, 16)
    assert isoline(ball.positions, ball.triangles, np.ones(len(ball.positions))) == []


def test_lines_stop_at_a_hard_edge_where_the_light_jumps() -> None:
    cube = box()
    lines = isoline(cube.positions, cube.triangles, cube.normals @ np.array([1.0, 2.0, 3.0]))
    assert lines == [], "each face is lit or not, as a whole"


@pytest.mark.parametrize(("mesh", "sharp"), [(box(), 24.0), (sphere(6, 8), 0.0)])
def test_a_cube_has_twelve_creases_and_a_coarse_ball_has_none(mesh: Mesh, sharp: float) -> None:
    edge = np.ptp(mesh.positions[:, 0])
    assert length([mesh.positions[one] for one in creases(mesh)]) == pytest.approx(sharp / 2 * edge)


def test_a_sheet_ends_in_its_rim_and_a_cone_in_its_base() -> None:
    sheet = plane()
    rim = 4 * np.ptp(sheet.positions[:, 0])
    assert length([sheet.positions[one] for one in creases(sheet)]) == pytest.approx(rim)
    base = [cone().positions[one] for one in creases(cone())]
    assert np.ptp(np.concatenate(base)[:, 1]) == 0


def test_the_letter_has_one_hole_and_is_closed() -> None:
    letter = letter_r()
    edges = edges_of(letter)
    assert (edges.count == 2).all()
    faces = len(letter.triangles)
    assert len(edges.vertex) - len(edges.ends) + faces == 0, "Euler: a ring"
    a, b, c = (letter.positions[letter.triangles[:, i]] for i in range(3))
    outwards = np.cross(b - a, c - a)
    assert (a * outwards).sum() / 6 > 0.8
    for corner in range(3):
        normals = letter.normals[letter.triangles[:, corner]]
        assert ((outwards * normals).sum(axis=1) > 0).all()
    assert np.ptp(letter.positions, axis=0)[1:] == pytest.approx([2, 0.48])
    right, left = (letter.positions[:, 0] > 0.3).sum(), (letter.positions[:, 0] < -0.3).sum()
    assert right > left, "the bowl is on the right"


def test_silhouettes_part_what_faces_the_eye_from_what_does_not() -> None:
    ring = torus(24, 48)
    eye = np.array([0.0, 0.0, 9.0])
    for chain in silhouettes(ring, ring.positions, eye):
        for point in chain:
            near = np.flatnonzero((ring.positions == point).all(axis=1))
            towards = (ring.normals[near] * (eye - point)).sum(axis=1)
            assert np.abs(towards).min() < 0.35 * 9, "normals there look past the eye"


def wall(width: int = 40, height: int = 30) -> np.ndarray:
    """A wall at depth ½ over the left half; nothing on the right."""
    farthest = np.full((height, width), np.inf)
    farthest[:, : width // 2] = 0.5
    return farthest


@pytest.mark.parametrize(("depth", "begins"), [(0.4, 2), (0.5, 2), (0.6, 19)])
def test_what_is_behind_a_wall_is_left_out(depth: float, begins: int) -> None:
    (piece,) = visible_pieces(np.array([[2.5, 10, depth], [37.5, 10, depth]]), wall())
    assert piece[0, 0] == pytest.approx(begins + 0.5)
    assert piece[-1, 0] == pytest.approx(37.5)


def test_a_line_that_goes_through_a_wall_is_cut_where_it_does() -> None:
    farthest = np.full((30, 40), 0.5)
    (piece,) = visible_pieces(np.array([[2.5, 10, 0.2], [34.5, 20, 0.8]]), farthest)
    assert piece[-1, 2] == pytest.approx(0.5, abs=0.03)


def test_a_line_on_a_steep_surface_is_seen_all_along() -> None:
    columns = np.arange(40)[None, :] + 0.5
    farthest = np.broadcast_to(columns / 40, (30, 40))
    line = np.array([[3.2, 4.0, 3.2 / 40], [33.7, 22.0, 33.7 / 40]])
    (piece,) = visible_pieces(line, farthest)
    assert (piece[[0, -1]] == line).all()
    hidden = line + np.array([0, 0, 6 / 40])  # six pixels' change of depth behind it
    assert visible_pieces(hidden, farthest) == []


def test_what_is_outside_of_the_picture_is_not_seen() -> None:
    points = np.array([[-1.0, 5, 0.1], [5, -0.1, 0.1], [40, 5, 0.1], [5, 30, 0.1], [5, 5, 0.1]])
    assert seen(points, wall()).tolist() == [False, False, False, False, True]
