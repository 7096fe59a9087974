"""Tangents point where u grows, across the normal, and say which way v grows."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from nmatrix.scene.meshes.mesh import Mesh
from nmatrix.scene.meshes.shapes import box, cone, plane, sphere, torus
from nmatrix.scene.meshes.tangents import with_tangents

SHAPES = {
    "sphere": sphere(16, 32),
    "torus": torus(16, 32),
    "box": box(2),
    "plane": plane(2),
    "cone": cone(32),
}


@pytest.mark.parametrize("name", SHAPES)
def test_tangents_are_unit_vectors_across_the_normal(name: str) -> None:
    mesh = with_tangents(SHAPES[name])
    assert mesh.tangents is not None
    t = mesh.tangents[:, :3]
    assert np.abs((t * t).sum(axis=1) - 1).max() < 1e-12
    assert np.abs((t * mesh.normals).sum(axis=1)).max() < 1e-12
    assert set(mesh.tangents[:, 3].tolist()) <= {1.0, -1.0}


@pytest.mark.parametrize("name", ["sphere", "torus"])
def test_tangents_run_around_the_axis(name: str) -> None:
    mesh = with_tangents(SHAPES[name])
    assert mesh.tangents is not None
    x, _, z = mesh.positions.T
    around = np.stack([z, 0 * x, -x], axis=1)
    away = np.hypot(x, z) > 0.1
    along = (mesh.tangents[:, :3] * around).sum(axis=1)[away] / np.hypot(x, z)[away]
    assert np.abs(np.abs(along) - 1).max() < 0.02


def test_a_mirrored_texture_turns_the_sign() -> None:
    mesh = plane(2)
    assert mesh.uv is not None
    mirrored = with_tangents(replace(mesh, uv=mesh.uv * (-1, 1)))
    plain = with_tangents(mesh)
    assert plain.tangents is not None
    assert mirrored.tangents is not None
    assert mirrored.tangents[:, 2].tolist() == (-plain.tangents[:, 2]).tolist()
    assert mirrored.tangents[:, 3].tolist() == (-plain.tangents[:, 3]).tolist()


def test_without_coordinates_nothing_changes() -> None:
    mesh = Mesh(plane().positions, plane().normals, plane().triangles)
    assert with_tangents(mesh) is mesh
