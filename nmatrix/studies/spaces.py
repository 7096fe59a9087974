"""`cost spaces`: the multiplications that a shading space takes, counted, beside their time."""

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
from nmatrix.shaders.cost import cost
from nmatrix.shaders.sheet import Request
from nmatrix.spaces.shading_spaces import PROFILES, USUAL_SPACES
from nmatrix.studies.harness import Run, Timed
from nmatrix.studies.measurements import Measurement, Task, Unit

Array = NDArray[Any]

FULL, QUICK = (100, 10_000, 1_000_000), (100, 10_000)
REFERENCE = Space.WORLD
PLACE = World(rotate_degrees=(20, 30, 10), scale=(1, 2, 1))


def tasks(timed: Timed, counts: tuple[int, ...]) -> list[Task]:
    """List the measurements: every space with every number of vertices."""
    return [partial(_row, timed, count, space) for count in counts for space in USUAL_SPACES]


def _row(timed: Timed, count: int, space: Space) -> Measurement:
    """Measure a space; its counted cost stands in the place of the error."""
    many = _scene_of(count)
    (body,) = many.bodies
    counted = float(cost(many.maps(body), Request(space)).per_vertex_multiplications)
    timing = timed(_vertex_stage(many, body, space), _vertex_stage(many, body, REFERENCE))
    return Measurement(
        space.value,
        f"{count} vertices",
        counted,
        Unit.MULTIPLICATIONS,
        timing,
        counted,
        is_reference=space is REFERENCE,
    )


def _vertex_stage(scene: LoadedScene, body: Body, space: Space) -> Run:
    """Return a run of the vertex stage: to clip space, and position and normal to the space.

    Object space needs neither, and static space had both done when the mesh was baked.
    """
    clip = np.array([[float(x) for x in row] for row in scene.clip_from_object(body)])
    shaded = ShadingSpace(scene, body, space, uses_metric=space is Space.OBJECT)
    positions = body.mesh.positions.T

    def run() -> None:
        clip[:, :3] @ positions + clip[:, 3:]
        if PROFILES[space].moves_vertices:
            shaded.positions()
            shaded.normals(NormalRule.EXACT)

    return run


def _scene_of(count: int) -> LoadedScene:
    """Build a scene of one mesh with so many vertices."""
    mesh = ShapeGeometry(Shape.SPHERE).mesh()
    which = np.arange(count) % len(mesh.positions)
    repeated = Mesh(mesh.positions[which], mesh.normals[which], mesh.triangles[:1] * 0)
    shown = SceneObject("many", LoadedGeometry(repeated), PLACE.world_from_object)
    lights = (SceneLight("sun", LightKind.DIRECTIONAL),)
    return loaded(Scene((shown,), lights, settings=replace(Settings(), size=(64, 64))))
