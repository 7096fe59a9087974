"""Made normals: smooth where a surface turns little, each face its own at sharp edges."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from nmatrix.scene.meshes import shapes
from nmatrix.scene.meshes.file import read_mesh
from nmatrix.scene.meshes.mesh import Mesh


def column(sides: int) -> str:
    """Write a column of so many sides, open above and below, with shared vertices."""
    lines = []
    for i in range(sides):
        x, z = np.cos(2 * np.pi * i / sides), np.sin(2 * np.pi * i / sides)
        lines += [f"v {x} 0 {z}", f"v {x} 1 {z}"]
    for i in range(sides):
        a, b = 2 * i + 1, 2 * ((i + 1) % sides) + 1
        lines.append(f"f {a} {a + 1} {b + 1} {b}")
    return "\n".join(lines) + "\n"


def made(tmp_path: Path, text: str) -> Mesh:
    path = tmp_path / "a.obj"
    path.write_text(text)
    return read_mesh(path)


def flatness(mesh: Mesh) -> float:
    """Measure the largest angle between a corner's normal and its face's, in degrees."""
    faces = mesh.face_normals[:, None, :]
    cosines = (mesh.normals[mesh.triangles] * faces).sum(axis=2)
    return float(np.degrees(np.arccos(np.clip(cosines.min(), -1, 1))))


@pytest.mark.parametrize("sides", range(3, 24))
def test_a_column_has_edges_where_its_faces_turn_by_more_than_the_crease(
    tmp_path: Path, sides: int
) -> None:
    mesh = made(tmp_path, column(sides))
    turn = 360 / sides
    expected = 0 if turn > 50 else turn / 2
    assert flatness(mesh) == pytest.approx(expected, abs=1e-5)


def test_a_cube_is_no_pillow_however_its_faces_are_cut(tmp_path: Path) -> None:
    corners = "".join(f"v {x} {y} {z}\n" for x in (0, 1) for y in (0, 1) for z in (0, 1))
    quads = ["1 2 4 3", "5 7 8 6", "1 5 6 2", "3 4 8 7", "1 3 7 5", "2 6 8 4"]
    faces = "".join(f"f {one}\n" for one in quads)
    cut = ""
    for one in quads:
        a, b, c, d = one.split()
        cut += f"f {a} {b} {c}\nf {a} {c} {d}\n"
    for text in (faces, cut):
        mesh = made(tmp_path, corners + text)
        assert flatness(mesh) < 1e-6
        assert sorted(map(tuple, np.unique(np.abs(mesh.normals), axis=0).tolist())) == [
            (0, 0, 1),
            (0, 1, 0),
            (1, 0, 0),
        ]


def test_smoothing_that_the_file_asks_for_goes_over_every_edge(tmp_path: Path) -> None:
    assert flatness(made(tmp_path, f"s 1\n{column(4)}")) == pytest.approx(45)
    assert flatness(made(tmp_path, f"s off\n{column(20)}")) == pytest.approx(0, abs=1e-5)


def test_a_smooth_surface_has_no_crease_and_shares_its_vertices(tmp_path: Path) -> None:
    ball = shapes.sphere(24, 48)
    places, at = np.unique(ball.positions.round(9), axis=0, return_inverse=True)
    rows = at.reshape(-1)[ball.triangles] + 1
    rows = rows[(rows != np.roll(rows, 1, axis=1)).all(axis=1)]
    text = "".join(f"v {x} {y} {z}\n" for x, y, z in places)
    mesh = made(tmp_path, text + "".join(f"f {a} {b} {c}\n" for a, b, c in rows))
    assert len(mesh.positions) == len(places)
    assert float((mesh.normals * mesh.positions).sum(axis=1).min()) > np.cos(np.radians(3))


def test_the_tip_of_a_cone_is_smooth_and_its_rim_has_an_edge(tmp_path: Path) -> None:
    sides = 100
    angles = 2 * np.pi * np.arange(sides) / sides
    text = "".join(f"v {np.cos(a)} 0 {-np.sin(a)}\n" for a in angles) + "v 0 1 0\nv 0 0 0\n"
    for i in range(1, sides + 1):
        after = i % sides + 1
        text += f"f {i} {after} {sides + 1}\nf {after} {i} {sides + 2}\n"
    mesh = made(tmp_path, text)
    below = mesh.normals[np.isclose(mesh.positions[:, 1], 0)]
    assert set(np.round(np.abs(below[:, 1]), 3).tolist()) == {1.0, 0.707}
