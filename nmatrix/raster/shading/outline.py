"""Outlines by an inverted hull: the body again, swollen, black, and seen from the inside alone.

The faces of the hull that look to the eye are left out and the others lie behind the body, so what
shows of them is the rim that reaches beyond it. No light is asked: flat, Gouraud and Phong shading
have one outline, and a face at a grazing angle stays as it is.
"""

from __future__ import annotations

from dataclasses import replace
from math import sqrt

import numpy as np

from nmatrix.enums import Effect, Frame, NormalRule, Space
from nmatrix.linear import rational
from nmatrix.raster.loaded_scene import Body, LoadedScene
from nmatrix.raster.shading.space import ShadingSpace
from nmatrix.spaces.transform import Transform

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


def hull(loaded: LoadedScene, body: Body) -> Body:
    """Return the hull of a body as a body of the world, turned inside out.

    A vertex p with the welded normal n of its mesh goes to

        clip_from_object · p + clip_from_world · (t · N n / |N n|, 0),

    where N carries normals from the object to the world (the inverse transpose, whatever rule the
    light is computed by) and t is the `thickness`. Its front faces are culled; where the map is a
    mirror, the winding is turned already.
    """
    space = ShadingSpace(loaded, body, Space.WORLD, uses_metric=False)
    outwards = space.unit_normals(space.carried(NormalRule.EXACT, body.mesh.hull_normals))
    moved = space.positions() + thickness(body) * outwards
    is_mirrored = rational.determinant(rational.linear_part(body.world_from_object.exact)) < 0
    triangles = body.mesh.triangles if is_mirrored else body.mesh.triangles[:, ::-1]
    mesh = replace(body.mesh, positions=moved.T, triangles=np.ascontiguousarray(triangles), uv=None)
    return replace(body, mesh=mesh, world_from_object=_STILL)


_STILL = Transform(Frame.WORLD, Frame.OBJECT, rational.identity(4))
