"""A surface has an inside if every edge is shared by two triangles turned against each other."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest

from nmatrix.scene.meshes import watertight
from nmatrix.scene.meshes.shapes import box, sphere, torus
from nmatrix.scene.meshes.watertight import is_watertight


def counted(positions: np.ndarray, triangles: np.ndarray) -> bool:
    """Return the same by counting edges one by one."""
    names: dict[tuple[float, ...], int] = {}
    place = [names.setdefault(tuple((row + 0.0).tolist()), len(names)) for row in positions]
    edges: Counter[tuple[int, int]] = Counter()
    for row in triangles.tolist():
        a, b, c = (place[i] for i in row)
        if len({a, b, c}) == 3:
            edges.update([(a, b), (b, c), (c, a)])
    return all(n == 1 and edges[end, start] == 1 for (start, end), n in edges.items())


@pytest.mark.parametrize("shape", [sphere, torus, box])
def test_shapes_are_closed_until_a_triangle_is_gone_turned_or_doubled(shape) -> None:
    mesh = shape()
    faces = mesh.triangles
    turned, doubled = faces.copy(), np.vstack([faces, faces[:1]])
    turned[0] = turned[0, ::-1]
    for triangles in (faces, faces[1:], turned, doubled, np.vstack([faces, faces])):
        assert is_watertight(mesh.positions, triangles) == counted(mesh.positions, triangles)
    assert is_watertight(mesh.positions, faces)
    assert not is_watertight(mesh.positions, faces[1:])


def test_parts_and_groups_change_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    mesh = torus()
    monkeypatch.setattr(watertight, "PART", 100)
    monkeypatch.setattr(watertight, "MOST_KEYS", 500)
    assert is_watertight(mesh.positions, mesh.triangles)
    assert not is_watertight(mesh.positions, np.vstack([mesh.triangles, mesh.triangles]))
    monkeypatch.setattr(watertight, "_is_balanced", lambda *_: True)  # the screen alone is no proof
    assert not is_watertight(mesh.positions, mesh.triangles[1:])


def test_random_meshes_are_judged_as_by_counting() -> None:
    random = np.random.default_rng(5)
    corners = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [-0.0, 0, 0]])
    found = set()
    for _ in range(400):
        faces = random.integers(0, 5, (int(random.integers(1, 5)), 3))
        found.add(is_watertight(corners, faces))
        assert is_watertight(corners, faces) == counted(corners, faces)
    closed = np.array([[0, 2, 1], [4, 1, 3], [1, 2, 3], [0, 3, 2]])
    assert is_watertight(corners, closed)
    assert counted(corners, closed)
