"""What a program draws: one object in its shading space, its lights, and what is computed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from functools import cached_property

from nmatrix.enums import Effect, NormalRule, Shading, Space
from nmatrix.linear import rational
from nmatrix.linear.projection import DEFAULT_CLIP_SPACE, ClipSpace
from nmatrix.linear.rational import RationalMatrix, RationalVector, rational_vector
from nmatrix.linear.rounding import integers, unit
from nmatrix.linear.rules import NormalTransform, normal_transform
from nmatrix.scene.light import PlacedLight
from nmatrix.scene.material import WHITE, Colour, Material
from nmatrix.scene.scene import Fog
from nmatrix.spaces.exact_maps import ExactMaps
from nmatrix.spaces.shading_spaces import PROFILES
from nmatrix.spaces.transform import Transform

# Bands, highlights, ranges and squares end this far beside round numbers: on them, where boxes and
# lamps like to stand, the last bit would decide, and differently in each space and on each machine.
EDGE = 1e-6
# Of light on a surface that asks a shadow map: flatter light would need more slack there, and shows
# nothing any more.
LEAST_COSINE = 1.0 / 64.0
PLAIN_TARGET, SRGB_TARGET = "RGBA8", "SRGB8_ALPHA8"  # the second takes linear light


class FrontFace(StrEnum):
    """The sense in which the corners of front faces follow each other on the canvas."""

    CCW = "ccw"
    CW = "cw"

    @classmethod
    def of_sign(cls, front: int) -> FrontFace:
        """Return the sense of corners whose area has a sign on the canvas, where y runs down."""
        return cls.CW if front > 0 else cls.CCW


class CullFace(StrEnum):
    """The sides that are not drawn."""

    BACK = "back"
    FRONT = "front"


@dataclass(frozen=True)
class ShadowView:
    """One shadow map of a light: rows of x, y, distance and w, and the slack where w is 1."""

    light_from_world: RationalMatrix
    slack: float


@dataclass(frozen=True)
class Shaded:
    """One object, its material and lights, and the effects that its shaders compute.

    Parameters
    ----------
    ambient
        The light that comes from everywhere.
    rule
        The rule that carries normals.
    shadows
        The views of each light that has shadow maps, by its name.
    sagitta
        How far the round surface that normals feign rises above the triangles, in the world.
    has_zero_normals
        True if the mesh has vertices without a normal.
    target
        The format of the framebuffer.
    clip
        The clip space that `maps.clip_from_camera` leads to.
    texture_has_alpha, vertices_have_alpha
        True if the opacity differs with them.
    swollen_by
        How far the vertices move outwards in the world, for a hull that is seen from inside.
    """

    maps: ExactMaps
    space: Space
    shading: Shading
    material: Material
    lights: tuple[PlacedLight, ...]
    effects: frozenset[Effect]
    front_face: FrontFace = FrontFace.CCW
    ambient: Colour = WHITE
    fog: Fog | None = None
    rule: NormalRule = NormalRule.EXACT
    shadows: Mapping[str, tuple[ShadowView, ...]] = field(default_factory=dict)
    sagitta: float = 0.0
    has_zero_normals: bool = False
    target: str = PLAIN_TARGET
    clip: ClipSpace = DEFAULT_CLIP_SPACE
    texture_has_alpha: bool = False
    vertices_have_alpha: bool = False
    swollen_by: float = 0.0

    @property
    def is_lit_at_fragments(self) -> bool:
        """True if light is evaluated at fragments, and not at vertices alone."""
        return self.shading is Shading.PHONG

    @property
    def moves_vertices(self) -> bool:
        """True if the vertices' positions and normals are not stored in the shading space."""
        return PROFILES[self.space].moves_vertices

    @property
    def is_flattened(self) -> bool:
        """True if the object has no volume, so that its two sides are alike."""
        return self.maps.world_from_object.linear_map.rank < 3

    @property
    def is_sided(self) -> bool:
        """True if backs are lit as backs."""
        return Effect.BACK_FACES in self.effects and not self.is_flattened

    @property
    def is_linear(self) -> bool:
        """True if levels are linear light until the end."""
        return Effect.GAMMA in self.effects or self.target == SRGB_TARGET

    @property
    def cull_face(self) -> CullFace | None:
        """The side that is not drawn, or None where both are."""
        if self.swollen_by:
            return CullFace.FRONT
        is_cut_off = Effect.BACK_FACES not in self.effects and not self.is_flattened
        return CullFace.BACK if is_cut_off else None

    @property
    def world_from_vertex(self) -> RationalMatrix:
        """The map from where the vertices are stored to the world."""
        if PROFILES[self.space].vertices_in is not Space.OBJECT:
            return rational.identity(4)
        return self.maps.world_from_object.exact

    @property
    def clip_from_world(self) -> RationalMatrix:
        """P·V."""
        return rational.product(self.maps.clip_from_camera, self.maps.camera_from_world.exact)

    @property
    def clip_from_vertex(self) -> RationalMatrix:
        """P·V·M, or P·V where the vertices were baked into world space."""
        return rational.product(self.clip_from_world, self.world_from_vertex)

    @cached_property
    def space_from_vertex(self) -> RationalMatrix:
        """The map from where the vertices are stored to the shading space."""
        if not self.moves_vertices:
            return rational.identity(4)
        return self.maps.space_from_object(self.space).exact

    @cached_property
    def normal_transform(self) -> NormalTransform | None:
        """The matrix that the rule makes for normals; None if it has none for this map."""
        return normal_transform(self.rule, self.space_from_vertex)

    @property
    def normals_can_vanish(self) -> bool:
        """True if a vertex may have no normal in the space."""
        return self.has_zero_normals or self.is_flattened or self.normal_transform is None

    @property
    def is_mirrored(self) -> bool:
        """True if a mirror lies between the vertices and where lengths are measured."""
        measured = Effect.METRIC in self.effects
        of = self.maps.world_from_object.exact if measured else self.space_from_vertex
        return rational.determinant(rational.linear_part(of)) < 0

    @cached_property
    def _space_from_world(self) -> Transform:
        return self.maps.space_from_world(self.space)

    def point(self, point: RationalVector) -> RationalVector:
        """Bring a point of the world into the space."""
        return self._space_from_world.exact_point(point)

    def direction(self, vector: RationalVector) -> RationalVector:
        """Bring a direction of the world into the space, at true length one."""
        of_length_one = rational_vector(unit(integers(vector)[0]))
        return self._space_from_world.exact_vector(of_length_one)

    def from_space(self, of_world: RationalMatrix) -> RationalMatrix:
        """Return the matrix that does to points of the space what one does to the world's."""
        if self.space is Space.OBJECT:
            return rational.product(of_world, self.maps.world_from_object.exact)
        back = rational.inverse(self._space_from_world.exact)
        return rational.product(of_world, back)
