"""Lights that cannot light a body."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import Shading
from nmatrix.raster.loaded_scene import Body, LoadedScene
from nmatrix.raster.planning.facts import Facts
from nmatrix.raster.shading.space import column, dot, length, world_face_normals, world_normals
from nmatrix.raster.triangles.products import chunks
from nmatrix.scene.light import PlacedLight
from nmatrix.scene.words import LightKind, Sides

Array = NDArray[Any]

EDGE_ON = 1e-9  # cosines nearer to 0 than this are left to the picture


def why_dark(facts: Facts, placed: PlacedLight) -> str | None:
    """Return the reason why a light cannot change a sample of a body, or None if it may.

    Each reason is exact: what is left out would add zero.
    """
    body = facts.body
    if not any(placed.colour):
        return "is black"
    if placed.position is not None:
        way = column(placed.position)[:, 0] - body.centre
        gap = float(np.sqrt((way**2).sum())) - body.radius
        if gap > placed.light.range * (1 + 1e-9):
            return f"ends at {placed.light.range:g}, and the body begins at {gap:.4g}"
    is_dark = not facts.lights_backs and _is_behind(facts.loaded, body, placed)
    return "is behind every face" if is_dark else None


def _is_behind(loaded: LoadedScene, body: Body, placed: PlacedLight) -> bool:
    """Return True if n·l ≤ 0 for every normal and every place that interpolation can make.

    Both are mixtures of a triangle's corners, so it is enough to ask each normal with each corner.
    Only a body that is seen from one side is asked: the back of a face turns to the light. What
    faces the light edge-on counts as lit: there rounding decides.
    """
    if placed.light.kind is LightKind.AMBIENT or body.linear_map.rank < 3:
        return False
    one_sided = body.material.sides is Sides.FRONT
    if body.material.sides is Sides.AS_NEEDED:
        one_sided = body.mesh.is_closed and body.material.opacity == 1.0
    if not one_sided or body.material.normal_map is not None:
        return False
    is_flat = loaded.settings.shading is Shading.FLAT
    of_kind = world_face_normals if is_flat else world_normals
    normals = of_kind(loaded, body, loaded.settings.normals)
    if placed.position is None:
        assert placed.direction is not None  # a light is somewhere or comes from somewhere
        travel = column(placed.direction)
        return bool((dot(normals, travel) >= EDGE_ON * length(travel)).all())
    way = column(placed.position) - body.positions_world.T
    margin = -EDGE_ON * float(length(way).max())
    if is_flat:
        return all(
            bool((dot(normals, way[:, body.mesh.triangles[:, j]]) <= margin).all())
            for j in range(3)
        )
    return all(
        bool((dot(normals[:, corners[i]], way[:, corners[j]]) <= margin).all())
        for corners in chunks(body.mesh.triangles.T)
        for i in range(3)
        for j in range(3)
    )
