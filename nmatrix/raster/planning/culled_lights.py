"""Lights that cannot light a body."""

from __future__ import annotations

from math import cos, radians, sin
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import Effect, Shading
from nmatrix.raster.planning.facts import Facts
from nmatrix.raster.planning.seen_body import SeenBody
from nmatrix.raster.shading.space import column, dot
from nmatrix.raster.triangles.products import chunks
from nmatrix.scene.light import PlacedLight
from nmatrix.scene.words import LightKind
from nmatrix.shaders.shaded import EDGE

Array = NDArray[Any]

EDGE_ON = 1e-9  # cosines nearer to 0 than this are left to the picture


def why_dark(facts: Facts, placed: PlacedLight) -> str | None:
    """Find the reason why a light cannot change a sample of a body, or None if it may.

    Each reason is exact: what is left out would add zero.
    """
    if not any(placed.colour):
        return "is black"
    if placed.position is not None:
        nearest, _ = facts.seen.distances(column(placed.position)[:, 0])
        if nearest > placed.light.range * (1.0 + EDGE):
            return f"ends at {placed.light.range:g}, and the body begins at {nearest:.4g}"
        if placed.light.kind is LightKind.SPOT and _is_outside_of_cone(facts.seen, placed):
            return f"shines past it: its cone ends at {placed.light.cone_degrees[1]:g}°"
    is_dark = not facts.lights_backs and _is_behind(facts, placed)
    return "is behind every face" if is_dark else None


def _is_outside_of_cone(seen: SeenBody, placed: PlacedLight) -> bool:
    """Return True if a plane through the lamp parts its cone from the box around the body.

    The plane touches the cone along the ray that is nearest to the box's middle.
    """
    assert placed.position is not None and placed.direction is not None  # it is a spot
    lamp, axis = column(placed.position)[:, 0], column(placed.direction)[:, 0]
    axis /= np.sqrt(axis @ axis)
    way = seen.body.centre - lamp
    aside = way - axis * (axis @ way)
    aside -= axis * (axis @ aside)  # once more: little may be left of it, and most of that rounding
    size = float(np.sqrt(aside @ aside))
    angle = radians(placed.light.cone_degrees[1])
    outwards = -axis  # a body around the axis is past the cone if it is behind the lamp
    if size > EDGE_ON * float(np.sqrt(way @ way)):
        outwards = cos(angle) * (aside / size) - sin(angle) * axis
    low, high = seen.body.box
    # The corner of the box that reaches least outwards.
    least = float(outwards @ (np.where(outwards > 0, low, high) - lamp))
    return least > EDGE_ON * float(np.abs([low, high, lamp]).max())


def _is_behind(facts: Facts, placed: PlacedLight) -> bool:
    """Return True if n·l ≤ 0 for every normal and every place that interpolation can make.

    Both are mixtures of a triangle's corners, so it is enough to ask each normal with each corner.
    Only a body whose backs are not seen is asked: the back of a face turns to the light. What
    faces the light edge-on counts as lit: there rounding decides.
    """
    body, seen = facts.body, facts.seen
    if placed.light.kind is LightKind.AMBIENT or body.linear_map.rank < 3:
        return False
    if facts.decision(Effect.BACK_FACES).on or body.material.normal_map is not None:
        return False
    space, is_flat = seen.space, facts.loaded.settings.shading is Shading.FLAT
    if placed.position is None:
        assert placed.direction is not None  # a light is somewhere or comes from somewhere
        travel = space.direction(placed.direction)
        some = is_flat or (dot(seen.few_normals, travel) >= EDGE_ON).all()
        return bool(some and (dot(seen.lit_normals, travel) >= EDGE_ON).all())
    normals = seen.lit_normals
    way = space.point(placed.position) - space.positions()
    margin = -EDGE_ON * float(space.measure.vector_length(way).max())
    if is_flat:
        corners = body.mesh.triangles.T
        return all(bool((dot(normals, way.take(one, 1)) <= margin).all()) for one in corners)
    if not (dot(normals, way) <= margin).all():
        return False
    return all(
        bool((dot(normals.take(corners[i], 1), way.take(corners[j], 1)) <= margin).all())
        for corners in chunks(body.mesh.triangles.T)
        for i in range(3)
        for j in range(3)
        if i != j
    )
