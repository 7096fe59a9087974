"""Lights that cannot light a body, and the bodies that can stand between it and a light."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import Shading
from nmatrix.raster.loaded_scene import Body, LoadedScene, PlacedLight
from nmatrix.raster.planning.facts import Facts
from nmatrix.raster.shading.space import column, dot, length, world_face_normals, world_normals
from nmatrix.raster.triangles.products import chunks
from nmatrix.scene.words import LightKind, Sides

Array = NDArray[Any]

FLAT = 1e-9  # of the radius: what lies this close to a plane cannot stand in its own light
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


def occluders(loaded: LoadedScene, placed: PlacedLight, body: Body) -> list[str]:
    """Return the names of bodies that can stand between a light and a body, never one too few.

    Bounding spheres decide.
    """
    return [
        one.name
        for one in loaded.bodies
        if one.material.opacity == 1.0
        and (_can_shade_itself(one) if one is body else _is_between(placed, one, body))
    ]


def _can_shade_itself(body: Body) -> bool:
    """Return True if a body has any thickness: its least spread about its middle.

    The triangular factor of all vertices follows part by part, and has their singular values.
    """
    factor = np.zeros((3, 3))
    for part in body.parts_world():
        stacked = np.vstack([factor, part.T - body.centre])
        factor = np.asarray(np.linalg.qr(stacked, mode="r"))
    thickness = float(np.linalg.svd(factor, compute_uv=False)[-1])
    return thickness > FLAT * body.radius * float(np.sqrt(len(body.mesh.positions)))


def _is_between(placed: PlacedLight, caster: Body, body: Body) -> bool:
    reach = caster.radius + body.radius
    way = caster.centre - body.centre
    if placed.position is None:
        assert placed.direction is not None  # a light is somewhere or comes from somewhere
        travel = column(placed.direction)[:, 0]
        travel /= np.sqrt(travel @ travel)
        ahead = -float(way @ travel)
        aside = float(np.sqrt(max(0.0, way @ way - ahead * ahead)))
        return ahead > -reach and aside < reach
    to_light = column(placed.position)[:, 0] - body.centre
    size = float(to_light @ to_light)
    share = float(np.clip(way @ to_light / size, 0.0, 1.0)) if size else 0.0
    nearest = way - share * to_light
    return float(np.sqrt(nearest @ nearest)) < reach
