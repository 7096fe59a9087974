"""Lights that cannot light a body, and the bodies that can stand between it and a light."""

from __future__ import annotations

from math import cos, radians, sin
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import Effect
from nmatrix.raster.loaded_scene import Body, LoadedScene, PlacedLight
from nmatrix.raster.planning.facts import Facts
from nmatrix.raster.planning.seen_body import SeenBody
from nmatrix.raster.shading.space import column, dot
from nmatrix.raster.triangles.products import chunks
from nmatrix.scene.words import LightKind

Array = NDArray[Any]

FLAT = 1e-9  # of the radius: what lies this close to a plane cannot stand in its own light
EDGE_ON = 1e-9  # cosines nearer to 0 than this are left to the picture


def why_dark(facts: Facts, placed: PlacedLight) -> str | None:
    """Find the reason why a light cannot change a sample of a body, or None if it may.

    Each reason is exact: what is left out would add zero.
    """
    if not any(placed.colour):
        return "is black"
    if placed.position is not None:
        nearest, _ = facts.seen.distances(column(placed.position)[:, 0])
        if nearest > placed.light.range:
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
    size = float(np.sqrt(aside @ aside))
    angle = radians(placed.light.cone_degrees[1])
    outwards = -sin(angle) * axis
    if size > 0.0:
        outwards = outwards + cos(angle) * (aside / size)
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
    space, normals = seen.space, seen.normals
    if placed.position is None:
        assert placed.direction is not None  # a light is somewhere or comes from somewhere
        return bool((dot(normals, space.direction(placed.direction)) >= EDGE_ON).all())
    way = space.point(placed.position) - space.positions()
    margin = -EDGE_ON * float(space.measure.vector_length(way).max())
    if not (dot(normals, way) <= margin).all():
        return False
    return all(
        bool((dot(normals.take(corners[i], 1), way.take(corners[j], 1)) <= margin).all())
        for corners in chunks(body.mesh.triangles.T)
        for i in range(3)
        for j in range(3)
        if i != j
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
