"""The opacity of a surface at fragments: its material's, times that of its texture and vertices.

What a material cuts out is no part of the surface: it hides nothing, casts no shadow and is not
counted. So holes are found where samples are covered, before anything is coloured.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.raster.loaded_scene import Body
from nmatrix.raster.shading.texture import sample_alpha
from nmatrix.raster.triangles.fragments import Fragments, Grid, VertexOutputs, interpolate
from nmatrix.raster.triangles.vertices import Projected
from nmatrix.raster.triangles.visibility import Kept, Runs

Array = NDArray[Any]


def opacity_inputs(body: Body, projected: Projected) -> dict[str, Array]:
    """Return what the opacity at fragments reads, at the vertices (k, V)."""
    found, mesh = {}, body.mesh
    if body.texture_has_alpha and mesh.uv is not None:
        found["uv"] = projected.per_vertex(mesh.uv.T)
    if body.vertices_have_alpha and mesh.colours is not None:
        found["alpha"] = projected.per_vertex(mesh.colours.T[3:])
    return found


def opacity(body: Body, fragments: Fragments) -> Array:
    """Return the opacity (m,) at fragments that have these inputs."""
    material = body.material
    found = np.full(len(fragments), material.opacity)
    if body.texture_has_alpha and material.texture is not None:
        found *= sample_alpha(material.texture, fragments["uv"])
    if body.vertices_have_alpha:
        found *= fragments["alpha"][0]
    return found


def clear(body: Body) -> Callable[[Fragments], Array] | None:
    """Return what tells a body's opacity at fragments, or None where it hides what is behind."""
    return (lambda found: opacity(body, found)) if body.material.is_clear else None


def solid(body: Body, projected: Projected) -> Kept | None:
    """Return what tells samples of a body from its holes, or None if it has none."""
    cutoff, inputs = body.material.alpha_cutoff, opacity_inputs(body, projected)
    if cutoff is None or (not inputs and body.material.opacity >= cutoff):
        return None
    outputs = VertexOutputs(inputs)

    def kept(triangle: Array, row: Array, column: Array) -> Array:
        runs = Runs(triangle, row, column, np.ones_like(row))
        found = interpolate(projected, runs, Grid(columns=0), outputs)
        return np.asarray(opacity(body, found) >= cutoff)

    return kept
