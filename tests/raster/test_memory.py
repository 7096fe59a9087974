"""Memory follows tiles and chunks, never fragments: ten million triangles, 64 samples a pixel."""

from __future__ import annotations

import subprocess
import sys
import tracemalloc

import numpy as np
import pytest

from nmatrix.raster.triangles.fragments import Fragments, VertexOutputs
from nmatrix.raster.triangles.picture import Drawable, Drawing
from nmatrix.raster.triangles.spans import Canvas
from nmatrix.raster.triangles.vertices import Projected

MESH = """
import resource
import numpy as np
from nmatrix.scene.meshes.mesh import Mesh

cells, size, per_side = {cells}, {size}, {per_side}
side = cells + 1
positions, normals = np.zeros((2, side, side, 3))
positions[:, :, 0] = np.linspace(-1, 1, side)
positions[:, :, 1] = np.linspace(-1, 1, side)[:, None]
normals[:, :, 2] = 1
a = np.arange(cells)[:, None] * side + np.arange(cells)
triangles = np.empty((cells, cells, 2, 3), np.intp)
triangles[:, :, 0] = a[:, :, None] + [0, 1, side]
triangles[:, :, 1] = a[:, :, None] + [1, side + 1, side]
del a
mesh = Mesh(positions.reshape(-1, 3), normals.reshape(-1, 3), triangles.reshape(-1, 3))
"""

DRAWING = """
from nmatrix.linear.projection import ClipSpace
from nmatrix.raster.triangles.spans import Canvas
from nmatrix.raster.triangles.fragments import VertexOutputs
from nmatrix.raster.image import levels
from nmatrix.raster.triangles.picture import Drawable, Drawing
from nmatrix.raster.triangles.vertices import project

matrix = np.diag([0.9, 0.9, 0.5, 1.0])
matrix[3, 1] = 0.2
canvas = Canvas(size, size, per_side)
projected = project(mesh, matrix, canvas, ClipSpace())
outputs = VertexOutputs(directions={{"normal": projected.per_vertex(mesh.normals.T)}})

def lambert(found):
    x, y, z = found["normal"]
    return (z / np.sqrt(x * x + y * y + z * z))[None]

picture = Drawing([Drawable(projected, outputs, lambert)], canvas, np.zeros(1)).picture(levels)
assert picture.fragments > 0.5 * (size * per_side) ** 2 or cells > 1000, picture.fragments
"""

SCENE = """
from nmatrix.linear.rational import identity
from nmatrix.raster.planning.plan import planned
from nmatrix.raster.render import render
from nmatrix.raster.loaded_scene import loaded
from nmatrix.scene.geometry import LoadedGeometry
from nmatrix.scene.scene import Scene, SceneObject, Settings

grid = SceneObject("grid", LoadedGeometry(mesh), identity(4))
settings = Settings(size=(size, size), samples=per_side**2)
found = render(planned(loaded(Scene((grid,), settings=settings, has_camera=False))))
assert found.work.fragments > 0.2 * (size * per_side) ** 2, found.work
"""

RESIDENT = """
print(len(mesh.triangles), resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)
"""


def resident(way: str, cells: int, size: int, per_side: int) -> tuple[int, float]:
    """Return triangles and the most MiB that a process of its own has had in memory."""
    program = (MESH + way + RESIDENT).format(cells=cells, size=size, per_side=per_side)
    found = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    triangles, mebibytes = found.stdout.split()
    return int(triangles), float(mebibytes)


@pytest.mark.slow
@pytest.mark.parametrize("way", [DRAWING, SCENE], ids=["drawing", "scene"])
def test_ten_million_triangles_fit_in_a_gibibyte(way: str) -> None:
    triangles, mebibytes = resident(way, cells=2237, size=512, per_side=1)
    assert triangles >= 10**7
    assert mebibytes <= 1024


@pytest.mark.slow
def test_sixty_four_samples_of_a_large_picture_fit_in_a_gibibyte() -> None:
    assert resident(DRAWING, cells=20, size=2048, per_side=8)[1] <= 1024


@pytest.mark.parametrize("layers", [5, 60])
def test_memory_follows_the_tile_and_not_the_fragments(layers: int) -> None:
    size = 256
    edge = float(size * 512)
    x = np.tile([0.0, edge, 0.0], layers)
    y = np.tile([0.0, 0.0, edge], layers)
    corners = np.arange(3 * layers).reshape(-1, 3).T
    screens = Projected(x, y, np.full(len(x), 0.5), np.ones(len(x)), corners)
    normals = np.ones((3, len(x)))

    def colours(found: Fragments) -> np.ndarray:
        return found["normal"][:1]

    drawable = Drawable(screens, VertexOutputs(directions={"normal": normals}), colours)
    tracemalloc.start()
    picture = Drawing([drawable], Canvas(size, size), np.zeros(1)).picture()
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert picture.fragments == layers * size * size
    assert peak < 200 * size * size + 300 * layers
