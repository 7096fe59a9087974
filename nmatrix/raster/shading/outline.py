"""Outlines by an inverted hull: the body again, swollen, black, and seen from the inside alone.

The faces of the hull that look to the eye are left out and the others lie behind the body, so what
shows of them is the rim that reaches beyond it. No light is asked: flat, Gouraud and Phong shading
have one outline, and a face at a grazing angle stays as it is.
"""

from __future__ import annotations

from dataclasses import replace
from math import sqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import Effect, Frame, NormalRule, Space
from nmatrix.linear import rational
from nmatrix.raster.loaded_scene import Body, LoadedScene
from nmatrix.raster.shading.space import ShadingSpace
from nmatrix.scene.meshes.mesh import welded_normals
from nmatrix.spaces.transform import Transform

Array = NDArray[Any]

# What a hull takes over from its body: where its fragments are, how far away, and their fog.
OF_HULLS = frozenset(
    {Effect.POSITION, Effect.METRIC, Effect.PERSPECTIVE, Effect.EXACT_WEIGHTS, Effect.FOG}
)


def thickness(body: Body) -> float:
    """Return how far a body's hull stands off, as a length of the world: r (1 − √(1 − c²)).

    c is the material's `outline` and r the body's radius. On a ball seen from afar the rim where
    the cosine of normal and eye is below c is just as thick.

    Examples
    --------
    >>> from nmatrix.scene.material import Material
    >>> from nmatrix.scene.meshes.shapes import sphere
    >>> ball = Body("ball", sphere(), _STILL, Material(outline=0.6))
    >>> round(thickness(ball), 12)
    0.2
    """
    cosine = body.material.outline
    return body.radius * (1.0 - sqrt(1.0 - cosine * cosine))


def hull_normals(loaded: LoadedScene, body: Body) -> Array:
    """Return the unit vectors (3, V) of the world along which the vertices of a hull stand off.

    Each is the sum of the normals of the faces around a place, by their angles there, and one for
    all vertices in that place. They are taken in the world: a shear turns the faces around a corner
    by different angles, and carried together they might point into the body.
    """
    space = ShadingSpace(loaded, body, Space.WORLD, uses_metric=False)
    faces = space.face_normals(NormalRule.EXACT)
    return welded_normals(space.positions().T, body.mesh.triangles, faces.T).T


def hull(loaded: LoadedScene, body: Body) -> Body:
    """Return the hull of a body as a body of the world, turned inside out.

    A vertex p goes to

        clip_from_object · p + clip_from_world · (t · h, 0),

    where h is one of the `hull_normals` (geometry, whatever rule the light is computed by) and t
    the `thickness`. Its front faces are culled; where the map is a mirror, the winding is turned
    already.
    """
    moved = body.positions_world.T + thickness(body) * hull_normals(loaded, body)
    is_mirrored = rational.determinant(rational.linear_part(body.world_from_object.exact)) < 0
    triangles = body.mesh.triangles if is_mirrored else body.mesh.triangles[:, ::-1]
    mesh = replace(body.mesh, positions=moved.T, triangles=np.ascontiguousarray(triangles), uv=None)
    return replace(body, mesh=mesh, world_from_object=_STILL)


_STILL = Transform(Frame.WORLD, Frame.OBJECT, rational.identity(4))
