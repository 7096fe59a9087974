"""One body in one shading space: its matrices, lights and eye as floats, each rounded once.

S is `space_from_world` and B its 3×3 block. Where B is not rigid, lengths are measured by the
factors of the metric: |v| = |B⁻¹v| for vectors, |n| = |Bᵀn| for normals; the metric itself, which
would square the condition number, is never formed.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import NormalRule, Space
from nmatrix.linear import rational
from nmatrix.linear.rational import RationalMatrix, RationalVector, to_floats
from nmatrix.linear.rules import NormalTransform, normal_transform
from nmatrix.raster.loaded_scene import Body, LoadedScene
from nmatrix.raster.triangles.products import chunks, multiply
from nmatrix.spaces.exact_maps import ExactMaps

Array = NDArray[Any]


def dot(a: Array, b: Array) -> Array:
    """Return a · b for vectors (3, …) that may broadcast."""
    found = a[0] * b[0]
    found = found + a[1] * b[1]
    return np.asarray(found + a[2] * b[2])


def length(vectors: Array) -> Array:
    """Return the lengths of vectors (3, …)."""
    return np.asarray(np.sqrt(dot(vectors, vectors)))


def quotient(a: Array, b: Array) -> Array:
    """Return a / b, and 0 where b is not positive: vectors over their lengths (…), say."""
    return np.divide(a, b, out=np.zeros_like(a), where=b > 0)


@dataclass(frozen=True, eq=False)
class Measure:
    """True lengths in a space: by B⁻¹ for vectors, by Bᵀ for normals; None where B is rigid."""

    world_vector: Array | None = None
    world_normal: Array | None = None

    def vector_in_world(self, vectors: Array) -> Array:
        """Return vectors (3, …) with true lengths and angles."""
        return vectors if self.world_vector is None else multiply(self.world_vector, vectors)

    def normal_in_world(self, normals: Array) -> Array:
        """Return normals (3, …) with true lengths and angles."""
        return normals if self.world_normal is None else multiply(self.world_normal, normals)

    def vector_length(self, vectors: Array) -> Array:
        """Return |B⁻¹v|."""
        return length(self.vector_in_world(vectors))

    def normal_length(self, normals: Array) -> Array:
        """Return |Bᵀn|."""
        return length(self.normal_in_world(normals))

    def normal_from_world(self, normals: Array) -> Array:
        """Return normals (3, …) of the world as the space has them."""
        return normals if self.world_vector is None else multiply(self.world_vector.T, normals)


@dataclass(frozen=True, eq=False)
class ShadingSpace:
    """A body in the space that it is shaded in."""

    loaded: LoadedScene
    body: Body
    space: Space
    uses_metric: bool

    @cached_property
    def maps(self) -> ExactMaps:
        """Return the exact maps."""
        return self.loaded.maps(self.body)

    @cached_property
    def exact_from_world(self) -> RationalMatrix:
        """Return S."""
        return self.maps.space_from_world(self.space).exact

    @cached_property
    def exact_from_object(self) -> RationalMatrix:
        """Return S · M; in object space the identity, not a product that rounds."""
        if self.space is Space.OBJECT:
            self.maps.space_from_world(self.space)
            return rational.identity(4)
        if self.space in (Space.WORLD, Space.STATIC):
            return self.body.world_from_object.exact
        return rational.product(self.exact_from_world, self.body.world_from_object.exact)

    @cached_property
    def measure(self) -> Measure:
        """Return the measure of lengths: by the metric, or by the space's own coordinates."""
        if not self.uses_metric:
            return Measure()
        return Measure(
            as_array(self.maps.vector_world_from_space(self.space)),
            as_array(self.maps.normal_world_from_space(self.space)),
        )

    @property
    def handed(self) -> int:
        """Return −1 where a mirror lies between the object and where lengths are measured."""
        of = self.body.world_from_object.exact if self.uses_metric else self.exact_from_object
        return -1 if rational.determinant(rational.linear_part(of)) < 0 else 1

    def positions(self) -> Array:
        """Return the vertices (3, V) in the space."""
        return multiply(as_array(self.exact_from_object)[:3], self.body.mesh.positions.T)

    def vectors(self, of_object: Array) -> Array:
        """Return tangents (V, 3) and their like in the space, as (3, V)."""
        return multiply(as_array(self.exact_from_object)[:3, :3], of_object.T)

    def carried(self, rule: NormalRule, of_object: Array) -> Array:
        """Carry normals (n, 3) of the object by a rule: (3, n) at any length."""
        found = self._normal_transform(rule)
        if found is None:
            return np.zeros((3, len(of_object)))
        given = of_object.T
        if not np.isfinite(given).all():
            given = np.where(np.isfinite(given).all(axis=0), given, 0.0)
        return _transformed(found, given)

    def _normal_transform(self, rule: NormalRule) -> NormalTransform | None:
        if self.space in (Space.WORLD, Space.STATIC):
            return self.body.normal_transform(rule)
        return normal_transform(rule, self.exact_from_object)

    def carried_normals(self, rule: NormalRule) -> Array:
        """Carry the vertices' normals by a rule: (3, V) at any length."""
        return self.carried(rule, self.body.mesh.normals)

    def face_normals(self, rule: NormalRule) -> Array:
        """Carry the triangles' own normals by a rule, to true length one: (3, F)."""
        return self.unit_normals(self.carried(rule, self.body.mesh.face_normals))

    def normals(self, rule: NormalRule, of: Array | None = None) -> Array:
        """Carry normals (n, 3), all of the mesh by default, to true length one, or zero: (3, n).

        A rule that measures four components has its own idea of length, and keeps it.
        """
        carried = self.carried(rule, self.body.mesh.normals if of is None else of)
        return carried if rule is NormalRule.FOUR_COMPONENT else self.unit_normals(carried)

    def unit_normals(self, normals: Array) -> Array:
        """Return normals (3, …) at true length one; zero stays zero."""
        found = np.zeros(normals.shape)
        for given, unit in zip(chunks(normals), chunks(found), strict=True):
            size = np.abs(given).max(axis=0)
            scaled = quotient(given, size)
            long = self.measure.normal_length(scaled)
            np.divide(scaled, long, out=unit, where=long > 0)
        return found

    def point(self, point: RationalVector) -> Array:
        """Return a point of the world as a column (3, 1)."""
        return column(self.maps.space_from_world(self.space).exact_point(point))

    def direction(self, vector: RationalVector) -> Array:
        """Return a vector of the world as a column (3, 1) of true length one."""
        found = self.maps.space_from_world(self.space).exact_vector(vector)
        largest = max(map(abs, found))
        scaled = column([one / largest for one in found])
        return np.asarray(scaled / self.measure.vector_length(scaled))

    def raised(self, positions: Array, normals: Array, height: float) -> Array:
        """Return positions (3, m) moved along unit normals by a height in the world."""
        if self.uses_metric:
            along = self.measure.normal_in_world(normals)
            normals = multiply(as_array(self.exact_from_world)[:3, :3], along)
        return np.asarray(positions + height * normals)

    def light_from_space(self, light_from_world: RationalMatrix) -> Array:
        """Return the map from this space to a light's clip space."""
        world_from_space = (
            self.body.world_from_object.exact
            if self.space is Space.OBJECT
            else rational.inverse(self.exact_from_world)
        )
        return as_array(rational.product(light_from_world, world_from_space))


def _transformed(found: NormalTransform, normals: Array) -> Array:
    """Return normals (3, V) through a rule's matrix, at any length."""
    K = np.array(found.floats)[: found.components]
    carried = multiply(K if found.w else K[:, :3], normals)
    if found.components == 3:
        return carried
    return quotient(carried[:3], np.sqrt(dot(carried, carried) + carried[3] * carried[3]))


def world_normals(loaded: LoadedScene, body: Body, rule: NormalRule) -> Array:
    """Return the vertices' normals (3, V) in the world as a rule carries them."""
    return ShadingSpace(loaded, body, Space.WORLD, uses_metric=False).normals(rule)


def world_face_normals(loaded: LoadedScene, body: Body, rule: NormalRule) -> Array:
    """Return the triangles' own normals (3, F) in the world as a rule carries them."""
    return ShadingSpace(loaded, body, Space.WORLD, uses_metric=False).face_normals(rule)


def as_array(matrix: RationalMatrix) -> Array:
    """Return an exact matrix as float64, each entry rounded once."""
    return np.array(to_floats(matrix))


def column(vector: Sequence[Fraction]) -> Array:
    """Return an exact vector as a column (n, 1) of float64."""
    return np.array([[float(one)] for one in vector])
