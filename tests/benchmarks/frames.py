"""The frames that are drawn: a mesh, a camera, one light at infinity, and nmatrix's two ways."""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path

import numpy as np

from nmatrix.linear.projection import front_sign
from nmatrix.linear.rational import identity
from nmatrix.raster.image import levels
from nmatrix.raster.loaded_scene import LoadedScene, loaded
from nmatrix.raster.planning.plan import Plan, planned
from nmatrix.raster.render import render
from nmatrix.raster.shading.space import as_array
from nmatrix.raster.triangles.fragments import Fragments, VertexOutputs
from nmatrix.raster.triangles.picture import Drawable, Drawing, Picture
from nmatrix.raster.triangles.spans import Canvas
from nmatrix.raster.triangles.vertices import Projected, project
from nmatrix.scene.camera import View
from nmatrix.scene.lens import Lens
from nmatrix.scene.light import SceneLight
from nmatrix.scene.material import Material, grey
from nmatrix.scene.meshes.file import read_mesh
from nmatrix.scene.meshes.mesh import Mesh
from nmatrix.scene.meshes.shapes import torus
from nmatrix.scene.scene import Scene, SceneObject, Settings
from nmatrix.scene.words import LightKind

sys.path.insert(0, str(Path(__file__).parents[1]))
from conftest import CHECKOUT, data_folder

__all__ = [
    "CHECKOUT",
    "MATT",
    "Frame",
    "core",
    "frames",
    "panes",
    "scene",
    "screen",
    "with_uv",
]

Array = np.ndarray
AMBIENT, DIFFUSE, BACKGROUND = 0.2, 0.8, 30 / 255
TO_LIGHT = (0.3, 0.5, 0.8)
MATT = Material("matt", ambient=grey(AMBIENT), diffuse=grey(DIFFUSE))


@dataclass(frozen=True)
class Given:
    """A mesh that is there already, where scenes expect to read one."""

    ready: Mesh

    def mesh(self) -> Mesh:
        return self.ready


@dataclass(frozen=True, eq=False)
class Frame:
    """One mesh under one camera on a square canvas."""

    name: str
    mesh: Mesh
    size: int
    per_side: int = 1
    is_screen: bool = False
    others: tuple[Mesh, ...] = field(default=())
    material: Material = MATT

    @cached_property
    def loaded(self) -> LoadedScene:
        """Return the frame's scene, loaded."""
        return loaded(self.scene)

    @property
    def scene(self) -> Scene:
        """Return the frame as a scene."""
        low, high = self.mesh.positions.min(axis=0), self.mesh.positions.max(axis=0)
        centre = (low + high) / 2
        radius = float(np.sqrt(((self.mesh.positions - centre) ** 2).sum(axis=1).max()))
        eye = centre + np.array([0.45, 0.35, 1.0]) * 2.0 * radius
        view = View(eye=tuple(eye.tolist()), target=tuple(centre.tolist()))
        lens = Lens(fov_degrees=50, near=0.3 * radius, far=10 * radius)
        if self.is_screen:
            view = View(eye=(0, 0, 1), target=(0, 0, 0))
            lens = Lens(fov_degrees=90, near=0.5, far=2)
        objects = tuple(
            SceneObject(str(i), Given(one), identity(4), self.material)
            for i, one in enumerate((self.mesh, *self.others))
        )
        sun = SceneLight("sun", LightKind.DIRECTIONAL, direction=tuple(-one for one in TO_LIGHT))
        settings = Settings(
            size=(self.size, self.size), samples=self.per_side**2, background=grey(BACKGROUND)
        )
        return Scene(objects, (sun,), view, lens, settings)

    @cached_property
    def matrix(self) -> Array:
        """Return `clip_from_object`."""
        return as_array(self.loaded.clip_from_object(self.loaded.bodies[0]))

    @cached_property
    def front(self) -> int:
        """Return the sign of the area of front faces on the canvas."""
        exact = self.loaded.clip_from_object(self.loaded.bodies[0])
        return front_sign(exact, self.loaded.clip)

    @cached_property
    def to_light(self) -> Array:
        """Return the unit vector to the light."""
        return np.array(TO_LIGHT) / np.linalg.norm(TO_LIGHT)

    @property
    def canvas(self) -> Canvas:
        """Return the canvas."""
        return self.loaded.canvas

    def projected(self, mesh: Mesh | None = None) -> Projected:
        """Return front faces on the canvas."""
        return project(mesh or self.mesh, self.matrix, self.canvas, self.loaded.clip, -self.front)

    def drawing(self) -> Drawing:
        """Return the core's own drawing: positions and normals in, Lambert's cosine per sample."""
        drawables = []
        for mesh in (self.mesh, *self.others):
            projected = self.projected(mesh)
            outputs = VertexOutputs(
                directions={"normal": projected.per_vertex(np.ascontiguousarray(mesh.normals.T))}
            )
            drawables.append(Drawable(projected, outputs, self.lambert))
        return Drawing(drawables, self.canvas, np.array([BACKGROUND]))

    def lambert(self, found: Fragments) -> Array:
        """Return levels (1, m) of fragments; their normals are used up."""
        x, y, z = found["normal"]
        cosine = x * self.to_light[0]
        cosine += y * self.to_light[1]
        cosine += z * self.to_light[2]
        squares = found["normal"]
        squares *= squares
        x += y
        x += z
        cosine /= np.sqrt(x, out=x)
        np.maximum(cosine, 0.0, out=cosine)
        cosine *= DIFFUSE
        cosine += AMBIENT
        return cosine[None]

    def picture(self) -> Picture:
        """Draw with the core."""
        return self.drawing().picture(levels)

    @cached_property
    def plan(self) -> Plan:
        """Return the plan, made once."""
        return planned(self.loaded)


def core(frame: Frame) -> Callable[[], Array]:
    """Return nmatrix's core: project, see, shade."""
    return lambda: frame.picture().image[:, :, 0]


def scene(frame: Frame) -> Callable[[], Array]:
    """Return the whole renderer under a plan."""
    plan = frame.plan
    return lambda: render(plan, levels).image[:, :, 0]


def screen() -> Mesh:
    """Return a square that fills the screen, its normals different at every corner."""
    positions = np.array([[-1.0, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
    normals = positions * 0.5 + [0, 0, 1]
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    return Mesh(positions, normals, np.array([[0, 1, 2], [0, 2, 3]]))


def with_uv(mesh: Mesh) -> Mesh:
    """Return a mesh with texture coordinates: its own x and y."""
    return replace(mesh, uv=(mesh.positions[:, :2] + 1) / 2)


def panes(count: int) -> Mesh:
    """Return squares that fill the screen, one behind the other."""
    one = screen()
    deep = np.linspace(0.0, -0.9, count)[:, None, None] * [0, 0, 1]
    triangles = one.triangles + len(one.positions) * np.arange(count)[:, None, None]
    return Mesh(
        (one.positions + deep).reshape(-1, 3),
        np.tile(one.normals, (count, 1)),
        triangles.reshape(-1, 3),
    )


def frames(sizes: tuple[int, ...] = (512, 1024)) -> list[Frame]:
    """Return the frames of the table; mesh files only where the reference data is."""
    meshes = {}
    folder = data_folder()
    if folder is not None:
        for name in ("stanford-bunny", "spot"):
            meshes[name] = read_mesh(folder / "meshes" / f"{name}.obj")
    meshes["torus"] = torus(32, 32)
    found = [Frame(name, mesh, size) for name, mesh in meshes.items() for size in sizes]
    return found + [Frame("screen", screen(), size, is_screen=True) for size in sizes]
