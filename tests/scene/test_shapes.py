"""Shapes: closed, wound outwards, with the normals of the surface that they stand for."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest

from nmatrix.scene.meshes.mesh import Mesh
from nmatrix.scene.meshes.shapes import box, cone, plane, sphere, torus

CLOSED = {
    "sphere": sphere(12, 24),
    "torus": torus(12, 24),
    "box": box(3),
    "cone": cone(24),
}
ALL = {**CLOSED, "plane": plane(3)}


def check_winding(mesh: Mesh) -> None:
    a, b, c = (mesh.positions[mesh.triangles[:, i]] for i in range(3))
    face = np.cross(b - a, c - a)
    area = np.sqrt((face * face).sum(axis=1))
    assert (area > 1e-12).all(), "a triangle without area"
    for i in range(3):
        along = (face * mesh.normals[mesh.triangles[:, i]]).sum(axis=1) / area
        assert (along > 0.5).all(), "a triangle faces inwards"


@pytest.mark.parametrize("name", ALL)
def test_every_triangle_winds_outwards(name: str) -> None:
    check_winding(ALL[name])


def test_one_turned_triangle_is_noticed() -> None:
    triangles = box(2).triangles.copy()
    triangles[5] = triangles[5][::-1]
    with pytest.raises(AssertionError):
        check_winding(Mesh(box(2).positions, box(2).normals, triangles))


def open_edges(mesh: Mesh) -> int:
    """Count directed edges that no neighbour runs backwards, with coincident vertices as one."""
    _, place = np.unique(np.rint(mesh.positions * 1e9), axis=0, return_inverse=True)
    corners = place.ravel()[mesh.triangles]
    edges = Counter((int(t[i]), int(t[(i + 1) % 3])) for t in corners for i in range(3))
    return sum(edges[(b, a)] != n for (a, b), n in edges.items())


@pytest.mark.parametrize("name", CLOSED)
def test_the_surface_is_closed(name: str) -> None:
    mesh = CLOSED[name]
    assert open_edges(mesh) == 0
    assert open_edges(Mesh(mesh.positions, mesh.normals, mesh.triangles[1:])) == 3


@pytest.mark.parametrize("name", ALL)
def test_normals_have_length_one(name: str) -> None:
    assert np.abs((ALL[name].normals ** 2).sum(axis=1) - 1).max() < 1e-14


@pytest.mark.parametrize(
    ("name", "volume"),
    [
        ("sphere", 4 * np.pi / 3),
        ("torus", 2 * np.pi**2 * 1.0 * 0.4**2),
        ("box", 8.0),
        ("cone", 2 * np.pi / 3),
    ],
)
def test_the_volume_is_the_one_of_the_solid(name: str, volume: float) -> None:
    fine = {"sphere": sphere(96, 192), "torus": torus(96, 192), "box": box(4), "cone": cone(256)}
    mesh = fine[name]
    a, b, c = (mesh.positions[mesh.triangles[:, i]] for i in range(3))
    found = (np.cross(a, b) * c).sum() / 6
    assert found == pytest.approx(volume, rel=2e-3)
