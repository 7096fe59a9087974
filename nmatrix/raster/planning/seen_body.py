"""One body as the camera and its shading space see it: what no lamp changes.

Each fact is computed when it is asked for, and once; drawing reads the same maps.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from math import inf, sqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import NormalRule, Shading
from nmatrix.linear.classify import most_excess
from nmatrix.linear.exact import LinearMap
from nmatrix.linear.projection import front_sign
from nmatrix.linear.rational import RationalMatrix, linear_part
from nmatrix.raster.loaded_scene import Body, LoadedScene
from nmatrix.raster.planning.shadow_casting import occluders
from nmatrix.raster.shading.space import ShadingSpace, as_array, column
from nmatrix.raster.triangles.clip import PLANES, all_beyond, inside
from nmatrix.raster.triangles.products import PART, chunks, multiply
from nmatrix.raster.triangles.visibility import STEPS
from nmatrix.scene.light import PlacedLight
from nmatrix.scene.meshes.mesh import least_cosine
from nmatrix.scene.words import DepthBuffer

Array = NDArray[Any]

NO_SPREAD = 1e-6  # of the radius: far less than any sample of a picture that holds the body
MANY_STEPS = 2.0**10  # of depth, between a front and a back that are told apart
OUTWARDS = 1e-9  # of a distance, and of a cosine: rounding is less
FEW = 64


@dataclass(frozen=True, eq=False)
class SeenBody:
    """A body of a loaded scene, under its camera and in its shading space."""

    loaded: LoadedScene
    body: Body
    _casters: dict[PlacedLight, list[Body]] = field(default_factory=dict, init=False)

    @cached_property
    def clip_from_object(self) -> RationalMatrix:
        """The exact map from the body to clip space."""
        return self.loaded.clip_from_object(self.body)

    @cached_property
    def front(self) -> int:
        """The sign of the area of front faces on the canvas; 0 where both sides are alike."""
        return front_sign(self.clip_from_object, self.loaded.clip)

    @cached_property
    def is_rigid(self) -> bool:
        """True if the shading space keeps the world's lengths and angles."""
        return self.loaded.maps(self.body).is_rigid(self.loaded.settings.space)

    @cached_property
    def space(self) -> ShadingSpace:
        """The body in its shading space, measured by the metric where that is not rigid."""
        space = self.loaded.settings.space
        return ShadingSpace(self.loaded, self.body, space, uses_metric=not self.is_rigid)

    @cached_property
    def map_to_space(self) -> LinearMap:
        """The 3×3 block of the map from the body to its shading space, exactly."""
        return LinearMap.of(linear_part(self.space.exact_from_object))

    @cached_property
    def _clip(self) -> Array:
        """The vertices (4, V) in clip space."""
        with np.errstate(over="ignore", invalid="ignore"):
            return multiply(as_array(self.clip_from_object), self.body.mesh.positions.T)

    def _clip_parts(self) -> Iterator[Array]:
        """Yield the vertices in clip space, some at a time (4, n); few are computed once."""
        if len(self.body.mesh.positions) <= PART:
            yield self._clip
            return
        matrix = as_array(self.clip_from_object)
        for part in chunks(self.body.mesh.positions.T):
            with np.errstate(over="ignore", invalid="ignore"):
                yield multiply(matrix, part)

    @cached_property
    def is_whole(self) -> bool:
        """True if no plane of the view cuts the body."""
        depth, canvas = self.loaded.clip.depth, self.loaded.canvas
        return all(bool(inside(part, depth, canvas).all()) for part in self._clip_parts())

    @cached_property
    def why_unseen(self) -> str | None:
        """The reason why no sample of the picture can show the body, or None if one may.

        All its vertices are on the outer side of one plane of the view, so all its points are; and
        what lets all light through leaves every sample as it was. An outline reaches farther.
        """
        if self.body.material.outline:
            return None
        material = self.body.material
        if material.alpha_cutoff is not None and material.opacity < material.alpha_cutoff:
            return "is a hole: its opacity is below its cutoff"
        if material.is_clear and not material.opacity:
            return "lets all light through"
        if not self.body.linear_map.rank:
            return "is shrunk to a point by its matrix"
        beyond = np.ones(len(PLANES), bool)
        for part in self._clip_parts():
            beyond &= all_beyond(part, self.loaded.clip.depth)
            if not beyond.any():
                return None
        return f"is {PLANES[int(beyond.argmax())]}"

    @cached_property
    def is_thin(self) -> bool:
        """True if fronts and backs may share a place: by the snap to 1/256 sample, or in depth.

        The thickness is the least spread of the vertices about their middle. Far away it must
        still take a sample on the canvas, and many steps of depth.
        """
        thickness = self.body.thickness
        if thickness <= NO_SPREAD * self.body.radius:
            return True
        canvas, rows = self.loaded.canvas, as_array(self.loaded.clip_from_camera)
        w = max(float(part[3].max()) for part in self._clip_parts())
        across = min(abs(rows[0, 0]) * canvas.columns, abs(rows[1, 1]) * canvas.rows) / 2 / w
        inwards = abs(rows[2, 2] * rows[3, 3] - rows[2, 3] * rows[3, 2]) / w / w
        steps = inwards * STEPS[DepthBuffer.FULL]
        return not (thickness * across >= 1.0 and thickness * steps >= MANY_STEPS)

    @property
    def is_parallel(self) -> bool:
        """True if w is the same everywhere."""
        return not any(self.clip_from_object[3][:3])

    @cached_property
    def w_ratio(self) -> float:
        """The largest ratio of w between corners of one triangle; infinite if one is cut."""
        if not self.is_whole:
            return inf
        w = np.concatenate([part[3] for part in self._clip_parts()])
        low, high = float(w.min()), float(w.max())
        if high <= 1.25 * low:  # one triangle's ratio is no larger than the whole body's
            return high / low
        of_corners = (w.take(part) for part in chunks(self.body.mesh.triangles.T))
        return max(float((one.max(axis=0) / one.min(axis=0)).max()) for one in of_corners)

    @cached_property
    def normals(self) -> Array:
        """The normals (3, V) of the vertices in the shading space, by the rule of the settings."""
        return self.space.normals(self.loaded.settings.normals)

    @property
    def lit_normals(self) -> Array:
        """The normals that light falls on: of vertices (3, V), or of faces (3, F) that are flat."""
        if self.loaded.settings.shading is Shading.FLAT:
            return self.space.face_normals(self.loaded.settings.normals)
        return self.normals

    @cached_property
    def few_normals(self) -> Array:
        """Some of the normals (3, n), from all over the mesh: enough to find that they vary."""
        mesh = self.body.mesh
        few = mesh.normals[:: 1 + len(mesh.normals) // FEW]
        return self.space.normals(self.loaded.settings.normals, few)

    @cached_property
    def keeps_angles(self) -> bool:
        """True if the angles between the mesh's normals are those between the picture's."""
        linear_map = self.body.linear_map
        is_exact = self.loaded.settings.normals is NormalRule.EXACT
        return is_exact and linear_map.rank == 3 and most_excess(linear_map) <= OUTWARDS

    @cached_property
    def normal_cosine(self) -> float:
        """The smallest cosine between the normals of one triangle's corners.

        It is −1, the worst, where some normal is not of length one: no bound holds for those.
        """
        if self.keeps_angles:
            return self.body.mesh.normal_cosine - OUTWARDS
        normals = self.space.measure.normal_in_world(self.normals)
        return least_cosine(normals, self.body.mesh.triangles)

    def shortest_normal(self, bend: float = 0.0) -> float:
        """Bound how short interpolation makes a normal: √((1 + 2 cos θ)/3), at the least.

        Normals that each bend by an angle in radians open θ by twice that.
        """
        cosine = self.normal_cosine - 2.0 * bend
        return sqrt(max(0.0, (1.0 + 2.0 * cosine) / 3.0))

    @cached_property
    def longest_edge(self) -> float:
        """A length that no edge of a triangle exceeds in the world."""
        places = self.body.positions_world
        longest = 0.0
        for part in chunks(self.body.mesh.triangles.T):
            a, b, c = (places.take(corner, 0) for corner in part)
            for p, q in ((a, b), (b, c), (c, a)):
                longest = max(longest, float(((p - q) ** 2).sum(axis=1).max()))
        return sqrt(longest)

    def distances(self, place: Array) -> tuple[float, float]:
        """Bound the distances from a place (3,) of the world to the body's points.

        A ball and a box hold the body; each gives a bound, and the better one is taken.
        """
        low, high = self.body.box
        way = place - self.body.centre
        middle = float(np.sqrt(way @ way))
        aside = np.maximum(np.maximum(low - place, place - high), 0.0)
        across = np.maximum(np.abs(place - low), np.abs(place - high))
        least = max(middle - self.body.radius, float(np.sqrt(aside @ aside)), 0.0)
        most = min(middle + self.body.radius, float(np.sqrt(across @ across)))
        rounding = OUTWARDS * (most + float(np.abs(place).max()))
        return max(least - rounding, 0.0), most + rounding

    def casters(self, placed: PlacedLight) -> list[Body]:
        """Find the opaque bodies that can keep a lamp's light off what is seen, once."""
        if placed not in self._casters:
            found = occluders(self.loaded, placed, self.body)
            self._casters[placed] = [one for one in found if not one.material.is_clear]
        return self._casters[placed]

    @cached_property
    def eye_distances(self) -> tuple[float, float]:
        """Bounds of the distances from the eye."""
        return self.distances(column(self.loaded.eye)[:, 0])

    @property
    def eye_is_outside(self) -> bool:
        """True if the eye is outside of the box around the body."""
        return self.eye_distances[0] > 0.0

    @property
    def is_lit_at_fragments(self) -> bool:
        """True if light is evaluated at fragments, and not at vertices alone."""
        return self.loaded.settings.shading is Shading.PHONG
