"""`cost spaces`: the multiplications that a shading space costs, counted, beside their time."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import NormalRule, Space
from nmatrix.raster.loaded_scene import Body, LoadedScene, loaded
from nmatrix.raster.shading.space import ShadingSpace
from nmatrix.scene.geometry import LoadedGeometry, ShapeGeometry
from nmatrix.scene.light import SceneLight
from nmatrix.scene.meshes.mesh import Mesh
from nmatrix.scene.scene import Scene, SceneObject, Settings
from nmatrix.scene.words import LightKind, Shape
from nmatrix.scene.world import World
from nmatrix.spaces.cost import cost
from nmatrix.spaces.shading_spaces import PROFILES, USUAL_SPACES
from nmatrix.spaces.uniforms import Request
from nmatrix.studies.harness import Harness, Run
from nmatrix.studies.rows import Row, Task

Array = NDArray[Any]

VERTICES, QUICK = (100, 10_000, 1_000_000), (100, 10_000)
MULTIPLICATIONS = "multiplications a vertex"
PLACE = World(rotate_degrees=(20, 30, 10), scale=(1, 2, 1))


def tasks(harness: Harness, counts: tuple[int, ...]) -> list[Task]:
    """Return each space and number of vertices still to be measured."""
    return [partial(_row, harness, count, space) for count in counts for space in USUAL_SPACES]


def _row(harness: Harness, count: int, space: Space) -> Row:
    """Return the row of a space; its error is the counted cost."""
    ready = _studio(count)
    (body,) = ready.bodies
    counted = cost(ready.maps(body), Request(space)).per_vertex_multiplications
    timing = harness.ratio(
        _vertex_stage(ready, body, space), _vertex_stage(ready, body, Space.WORLD)
    )
    return Row(space.value, f"{count} vertices", float(counted), MULTIPLICATIONS, timing)


def _vertex_stage(ready: LoadedScene, body: Body, space: Space) -> Run:
    """Return what a space does to every vertex: clip space, and position and normal in the space.

    Object space leaves both as they are; static space found both done when the mesh was baked.
    """
    clip = np.array([[float(x) for x in row] for row in ready.clip_from_object(body)])
    shaded = ShadingSpace(ready, body, space, uses_metric=space is Space.OBJECT)
    positions = body.mesh.positions.T

    def run() -> None:
        clip[:, :3] @ positions + clip[:, 3:]
        if PROFILES[space].moves_vertices:
            shaded.positions()
            shaded.normals(NormalRule.EXACT)

    return run


def _studio(count: int) -> LoadedScene:
    """Return a scene of one mesh with so many vertices."""
    mesh = ShapeGeometry(Shape.SPHERE).mesh()
    which = np.arange(count) % len(mesh.positions)
    repeated = Mesh(mesh.positions[which], mesh.normals[which], mesh.triangles[:1] * 0)
    shown = SceneObject("many", LoadedGeometry(repeated), PLACE.world_from_object)
    lights = (SceneLight("sun", LightKind.DIRECTIONAL),)
    return loaded(Scene((shown,), lights, settings=replace(Settings(), size=(64, 64))))
