"""One object, one camera and one light as exact maps; every shading space is one matrix of them.

M is `world_from_object`, V `camera_from_world`, S `space_from_world`, B the 3×3 block of S. Where
B is not rigid, vectors are measured by the metric B⁻ᵀB⁻¹ (in object space AᵀA), normals by BBᵀ.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property

from nmatrix.enums import Frame, Handedness, Space
from nmatrix.errors import IllegalValueError, NoAnswerError, quantity
from nmatrix.linear import rational
from nmatrix.linear.classify import BUILT, Classification, classify
from nmatrix.linear.rational import RationalMatrix, RationalVector, rational_vector
from nmatrix.linear.view import looking_along
from nmatrix.spaces.shading_spaces import PROFILES
from nmatrix.spaces.transform import Transform

ORIGIN: RationalVector = rational_vector((0, 0, 0))
UPWARDS: RationalVector = rational_vector((0, 1, 0))


@dataclass(frozen=True)
class WorldLight:
    """A light in world space: the direction in which it travels, its position, or both."""

    direction: RationalVector | None
    position: RationalVector | None


@dataclass(frozen=True)
class ExactMaps:
    """What all shading spaces are derived from, in world units.

    `target` and `up` are the camera's; the light's own view uses them where it has no direction.
    `to_digits` are the maps that these stand for, if a matrix of them was rounded.
    """

    world_from_object: Transform
    camera_from_world: Transform
    clip_from_camera: RationalMatrix
    eye: RationalVector
    light: WorldLight
    target: RationalVector = ORIGIN
    up: RationalVector = UPWARDS
    custom_from_world: Transform | None = None
    tolerance: float = BUILT
    to_digits: ExactMaps | None = None

    @cached_property
    def clip_from_object(self) -> RationalMatrix:
        """Return P · V · M exactly."""
        return rational.product(
            self.clip_from_camera, self.camera_from_world.exact, self.world_from_object.exact
        )

    def space_from_world(self, space: Space) -> Transform:
        """Build the one matrix that makes a space, S.

        Raises
        ------
        NoAnswerError
            Object space of a singular world matrix; light space of a light without direction.
        IllegalValueError
            Custom space without its matrix.
        """
        return _FROM_WORLD[space](self)

    def space_from_object(self, space: Space) -> Transform:
        """Return `space_from_world @ world_from_object`; in static space it is baked once."""
        return self.space_from_world(space) @ self.world_from_object

    def eye_in(self, space: Space) -> RationalVector:
        """Return the eye in a space: subtract first, then solve; never through a product."""
        if PROFILES[space].eye_is_origin:
            return ORIGIN
        return self.space_from_world(space).exact_point(self.eye)

    def is_rigid(self, space: Space) -> bool:
        """Recognise a space whose coordinates keep the lengths and angles of the world."""
        if space in (Space.WORLD, Space.STATIC):
            return True
        maps = self.to_digits or self
        return classify(maps.space_from_world(space).exact, self.tolerance).is_rigid

    def classified(self, space: Space) -> Classification:
        """Classify the map from the object to a space, to the digits that were given."""
        maps = self.to_digits or self
        stands_for = maps.space_from_object(space).exact
        return classify(self.space_from_object(space).exact, self.tolerance, stands_for)

    def vector_world_from_space(self, space: Space) -> RationalMatrix:
        """Return B⁻¹, which takes vectors of the space back to world lengths and angles."""
        return rational.inverse(rational.linear_part(self.space_from_world(space).exact))

    def normal_world_from_space(self, space: Space) -> RationalMatrix:
        """Return Bᵀ, which takes normals of the space back to world lengths and angles."""
        return rational.transpose(rational.linear_part(self.space_from_world(space).exact))

    def metric(self, space: Space) -> RationalMatrix | None:
        """Return the metric B⁻ᵀB⁻¹, or None where the space is rigid and the metric is 1.

        It is for teaching; what computes applies its factors, |v| = |B⁻¹v| and |n| = |Bᵀn|, since
        the product squares the condition number.

        Examples
        --------
        >>> from nmatrix.scene.setup import Setup
        >>> from nmatrix.scene.world import World
        >>> tall = Setup(World(scale=(1, 2, 1))).maps
        >>> rational.to_floats(tall.metric(Space.OBJECT))  # AᵀA
        ((1.0, 0.0, 0.0), (0.0, 4.0, 0.0), (0.0, 0.0, 1.0))
        """
        if self.is_rigid(space):
            return None
        back = self.vector_world_from_space(space)
        return rational.product(rational.transpose(back), back)


def _object_from_world(maps: ExactMaps) -> Transform:
    linear_map = maps.world_from_object.linear_map
    if not linear_map.integer_determinant:
        raise NoAnswerError(
            "object space of a singular world matrix (determinant 0)",
            f"M flattens space to rank {linear_map.rank}, so no M⁻¹ leads back to the object",
            "shade in world or camera space, or give every axis a scale other than 0",
        )
    return maps.world_from_object.inverse()


def _light_from_world(maps: ExactMaps) -> Transform:
    position = maps.light.position or ORIGIN
    towards = maps.light.direction
    if towards is None:
        towards = tuple(t - p for t, p in zip(maps.target, position, strict=True))
    if not any(towards):
        raise NoAnswerError(
            "light space",
            "the light stands at the target and has no direction",
            f"give {quantity('light_direction')}",
        )
    seen = looking_along(position, towards, maps.up, Handedness.RIGHT)
    return Transform(Frame.LIGHT, Frame.WORLD, seen.camera_from_world)


def _custom_from_world(maps: ExactMaps) -> Transform:
    if maps.custom_from_world is None:
        raise IllegalValueError(
            "space custom",
            "it is whatever matrix you give, and none was given",
            f'try {quantity("space_matrix")} "2 0 0; 0 1 0; 0 0 1"',
        )
    if not maps.custom_from_world.linear_map.integer_determinant:
        raise NoAnswerError(
            "space matrix (determinant 0)",
            "it flattens space, so directions in it have no meaning",
            "give an invertible matrix",
        )
    return maps.custom_from_world


def _unmoved(to: Frame) -> Callable[[ExactMaps], Transform]:
    found = Transform(to, Frame.WORLD, rational.identity(4))
    return lambda maps: found


_FROM_WORLD: Mapping[Space, Callable[[ExactMaps], Transform]] = {
    Space.WORLD: _unmoved(Frame.WORLD),
    Space.CAMERA: lambda maps: maps.camera_from_world,
    Space.OBJECT: _object_from_world,
    Space.STATIC: _unmoved(Frame.STATIC),
    Space.LIGHT: _light_from_world,
    Space.CUSTOM: _custom_from_world,
}
