"""What can keep a light's light off a body: balls between balls, so never one too few."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.raster.loaded_scene import Body, LoadedScene, PlacedLight

Array = NDArray[Any]

FLAT = 1e-9  # of the radius: what lies this close to a plane cannot stand in its own light


def occluders(loaded: LoadedScene, placed: PlacedLight, body: Body) -> list[str]:
    """Return the names of bodies that can stand between a light and a body."""
    return [
        one.name
        for one in loaded.bodies
        if one.material.opacity == 1.0
        and (_can_shade_itself(one) if one is body else _is_between(placed, one, body))
    ]


def _can_shade_itself(body: Body) -> bool:
    """Return whether a body has any thickness: its least spread about its middle.

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
        travel = np.array([float(one) for one in placed.direction])
        travel /= np.sqrt(travel @ travel)
        ahead = -float(way @ travel)
        aside = float(np.sqrt(max(0.0, way @ way - ahead * ahead)))
        return ahead > -reach and aside < reach
    place = np.array([float(one) for one in placed.position])
    to_light = place - body.centre
    size = float(to_light @ to_light)
    share = float(np.clip(way @ to_light / size, 0.0, 1.0)) if size else 0.0
    nearest = way - share * to_light
    return float(np.sqrt(nearest @ nearest)) < reach
