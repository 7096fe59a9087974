"""Many normals at once: length one, the side that is seen, normal maps, the angle between two."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import NormalRule
from nmatrix.raster.loaded_scene import Body, LoadedScene
from nmatrix.raster.shading.space import (
    Measure,
    column,
    dot,
    length,
    quotient,
    world_face_normals,
    world_normals,
)

Array = NDArray[Any]


def unit(vectors: Array, shortest: float = 0.0) -> Array:
    """Return vectors (..., 3) at length one; what is not longer than `shortest` becomes zero.

    Each is scaled by its largest component first, so no square over- or underflows.

    Examples
    --------
    >>> unit(np.array([[3e-200, 0, 4e-200], [0, 0, 0]])).tolist()
    [[0.6, 0.0, 0.8], [0.0, 0.0, 0.0]]
    """
    largest = np.abs(vectors).max(axis=-1, keepdims=True)
    scaled = quotient(vectors, largest)
    length = np.sqrt((scaled * scaled).sum(axis=-1, keepdims=True))
    kept = (largest > shortest) & (length > 0)
    return np.asarray(np.divide(scaled, length, out=np.zeros_like(vectors), where=kept))


def turned_towards(normals: Array, to_eye: Array) -> Array:
    """Return normals (3, …) on the side that is seen, for surfaces whose sides are alike.

    Examples
    --------
    >>> turned_towards(np.array([[0.0], [-1.0], [0.0]]), np.array([[0.0], [2.0], [1.0]])).tolist()
    [[-0.0], [1.0], [-0.0]]
    """
    behind = (normals * to_eye).sum(axis=0) < 0
    return np.asarray(np.where(behind, -normals, normals))


def normals_by(loaded: LoadedScene, body: Body, rule: NormalRule) -> Array:
    """Return a body's normals (3, V) in the world by a rule, turned to the eye if it is flat."""
    normals = world_normals(loaded, body, rule)
    return _seen_from(loaded, body, rule, normals, body.positions_world)


def face_normals_by(loaded: LoadedScene, body: Body, rule: NormalRule) -> Array:
    """Return the triangles' own normals (3, F) in the world, as `normals_by` those of vertices."""
    middles = body.positions_world[body.mesh.triangles].mean(axis=1)
    return _seen_from(loaded, body, rule, world_face_normals(loaded, body, rule), middles)


def _seen_from(
    loaded: LoadedScene, body: Body, rule: NormalRule, normals: Array, places: Array
) -> Array:
    if body.linear_map.rank == 3 or rule is not NormalRule.EXACT:
        return normals
    return turned_towards(normals, column(loaded.eye) - places.T)


def bumped(normals: Array, tangents: Array, signs: Array, texels: Array, measure: Measure) -> Array:
    """Return normals (3, m), of any length, that a normal map makes of interpolated ones.

    Tangents are vectors and move by A; normals move by its inverse transpose. t·n = 0 survives
    only so. They are brought to true lengths before they are added, and the sum goes back as a
    normal.

    Parameters
    ----------
    normals, tangents
        (3, m) in the shading space.
    signs
        (1, m) which way the bitangent b = ±(n × t) points: as the mesh says, times the sign of
        the determinant of the map to the space, since a mirror turns a cross product around.
    texels
        (3, m) levels of the map in [0, 1]; ½ ½ 1 leaves the normal as it is.

    Examples
    --------
    >>> up, east, plus = np.array([[0.0], [0], [1]]), np.array([[1.0], [0], [0]]), np.ones((1, 1))
    >>> bumped(up, east, plus, np.array([[0.5], [0.5], [1]]), Measure()).ravel().tolist()
    [0.0, 0.0, 1.0]
    """
    n = measure.normal_in_world(normals)
    n = quotient(n, length(n))
    t = measure.vector_in_world(tangents)
    t = t - n * dot(n, t)
    t = quotient(t, length(t))
    b = np.cross(n, t, axis=0) * signs
    x, y, z = texels * 2.0 - 1.0
    return measure.normal_from_world(x * t + y * b + z * n)


def angles_deg(a: Array, b: Array) -> Array:
    """Return the angles between unit vectors in degrees: atan2 of |a×b| and a·b, never acos."""
    sine = np.sqrt((np.cross(a, b) ** 2).sum(axis=1))
    return np.asarray(np.degrees(np.arctan2(sine, (a * b).sum(axis=1))))
