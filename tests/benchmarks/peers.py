"""Who draws the same frame: a C++ loop, Mesa's llvmpipe, and Python with NumPy per triangle."""

from __future__ import annotations

import ctypes
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from ctypes import POINTER, c_double, c_float, c_int32, c_int64, c_uint8
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from frames import AMBIENT, BACKGROUND, DIFFUSE, Frame

Array = np.ndarray
Draw = Callable[[], Array]


class AbsentError(Exception):
    """A peer that this machine does not have, and why."""


@cache
def compiled() -> ctypes.CDLL:
    """Return the loop, compiled on the spot for this processor."""
    compiler = shutil.which("g++") or shutil.which("gcc")
    if compiler is None:
        raise AbsentError("no C++ loop: neither g++ nor gcc is here")
    library = Path(tempfile.mkdtemp()) / "loop.so"
    source = Path(__file__).with_name("loop.cpp")
    flags = "-O3 -march=native -ffast-math -std=c++17 -shared -fPIC -lstdc++ -x c++".split()
    subprocess.run([compiler, *flags, source, "-o", library], check=True)
    return ctypes.CDLL(str(library))


def at(array: Array, kind: type) -> Any:
    return array.ctypes.data_as(POINTER(kind))


def cpp(frame: Frame) -> Draw:
    """Return the plain loop."""
    draw, mesh, size = compiled().draw, frame.mesh, frame.size
    positions, normals = (np.ascontiguousarray(one) for one in (mesh.positions, mesh.normals))
    triangles = np.ascontiguousarray(mesh.triangles, np.int64)
    matrix, light = np.ascontiguousarray(frame.matrix), frame.to_light.astype(np.float32)
    nearest, image = np.empty((size, size), np.float32), np.empty((size, size), np.uint8)

    def run() -> Array:
        draw(
            *(at(positions, c_double), at(normals, c_double), c_int64(len(positions))),
            *(at(triangles, c_int64), c_int64(len(triangles))),
            *(at(matrix, c_double), at(light, c_float), frame.front, size, size),
            *(at(nearest, c_float), at(image, c_uint8)),
        )
        return image

    return run


def exact_counts(frame: Frame) -> Array:
    """Return how many front faces cover each sample, by whole numbers alone."""
    projected, size = frame.projected(), frame.size
    hits = np.zeros((size, size), np.int32)
    triangles = np.ascontiguousarray(projected.triangles.T, np.int64)
    compiled().count(
        *(at(projected.x, c_double), at(projected.y, c_double), at(triangles, c_int64)),
        *(c_int64(len(triangles)), frame.front, size, size, at(hits, c_int32)),
    )
    return hits


VERTEX = """
#version 330
uniform mat4 clip_from_object;
in vec3 position; in vec3 normal; out vec3 n;
void main() {
  n = normal;
  gl_Position = clip_from_object * vec4(position, 1);
  gl_Position.y = -gl_Position.y;  // rows from the top down, as pictures have them
}
"""
FRAGMENT = """
#version 330
uniform vec3 to_light; uniform float ambient; uniform float diffuse;
in vec3 n; out float level;
void main() { level = ambient + diffuse * max(dot(normalize(n), to_light), 0); }
"""


@cache
def context() -> Any:
    try:
        import moderngl
    except ImportError as error:
        raise AbsentError("no llvmpipe: pip install 'moderngl>=5.12'") from error
    try:
        return moderngl.create_context(standalone=True, backend="egl")
    except Exception as error:
        raise AbsentError(f"no llvmpipe: {error}") from error


def opengl(frame: Frame) -> Draw:
    """Return Mesa's renderer on the processor, with the picture read back."""
    gl, size = context(), (frame.size, frame.size)
    program = gl.program(VERTEX, FRAGMENT)
    program["clip_from_object"].write(frame.matrix.T.astype("f4").tobytes())
    program["to_light"].write(frame.to_light.astype("f4").tobytes())
    program["ambient"], program["diffuse"] = AMBIENT, DIFFUSE
    vertices = np.hstack([frame.mesh.positions, frame.mesh.normals]).astype("f4")
    indices = gl.buffer(frame.mesh.triangles.astype("i4").tobytes())
    buffers = [(gl.buffer(vertices.tobytes()), "3f 3f", "position", "normal")]
    drawn = gl.vertex_array(program, buffers, indices)
    target = gl.framebuffer([gl.renderbuffer(size, 1)], gl.depth_renderbuffer(size))
    image = np.empty(size, np.uint8)

    def run() -> Array:
        target.use()
        gl.enable(gl.DEPTH_TEST | gl.CULL_FACE)
        gl.front_face = "cw"
        target.clear(BACKGROUND)
        drawn.render()
        target.read_into(image, components=1, alignment=1)
        return image

    return run


def python(frame: Frame) -> Draw:
    """Return the way of tutorials: a loop over triangles, NumPy inside each one's box."""
    return lambda: _python(frame)


def _python(frame: Frame) -> Array:
    mesh, size = frame.mesh, frame.size
    clip = np.c_[mesh.positions, np.ones(len(mesh.positions))] @ frame.matrix.T
    x, y, z = (clip[:, :3] / clip[:, 3:]).T
    x, y = (x + 1) * size / 2 - 0.5, (1 - y) * size / 2 - 0.5
    image, nearest = np.full((size, size), BACKGROUND), np.full((size, size), 2.0)
    normals = mesh.normals / clip[:, 3:]
    for a, b, c in mesh.triangles.tolist():
        area = (x[b] - x[a]) * (y[c] - y[a]) - (x[c] - x[a]) * (y[b] - y[a])
        if area * frame.front <= 0:
            continue
        left, right = max(0, int(np.ceil(min(x[a], x[b], x[c])))), max(x[a], x[b], x[c])
        top, bottom = max(0, int(np.ceil(min(y[a], y[b], y[c])))), max(y[a], y[b], y[c])
        right, bottom = min(size - 1, int(right)), min(size - 1, int(bottom))
        if left > right or top > bottom:
            continue
        i, j = np.meshgrid(np.arange(left, right + 1), np.arange(top, bottom + 1))
        v = ((i - x[a]) * (y[c] - y[a]) - (x[c] - x[a]) * (j - y[a])) / area
        w = ((x[b] - x[a]) * (j - y[a]) - (i - x[a]) * (y[b] - y[a])) / area
        u = 1 - v - w
        depth = u * z[a] + v * z[b] + w * z[c]
        inside = (u >= 0) & (v >= 0) & (w >= 0)
        inside &= depth < nearest[top : bottom + 1, left : right + 1]
        if not inside.any():
            continue
        shares = np.stack([u[inside], v[inside], w[inside]], axis=1)
        n = shares @ normals[[a, b, c]]
        cosine = n @ frame.to_light / np.linalg.norm(n, axis=1)
        image[j[inside], i[inside]] = AMBIENT + DIFFUSE * np.maximum(cosine, 0)
        nearest[j[inside], i[inside]] = depth[inside]
    return np.rint(image * 255).astype(np.uint8)
