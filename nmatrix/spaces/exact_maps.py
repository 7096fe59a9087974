"""The stage: one object, one camera, one light, as exact maps; every space is one matrix of it.

M is `world_from_object`, V `camera_from_world`, S `space_from_world`.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from nmatrix.enums import Frame, Handedness, Space
from nmatrix.errors import IllegalValueError, NoAnswerError, quantity
from nmatrix.linear import rational
from nmatrix.linear.classify import BUILT, classify
from nmatrix.linear.rational import RationalMatrix, RationalVector, rational_vector
from nmatrix.linear.view import looking_along
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

    @cached_property
    def clip_from_object(self) -> RationalMatrix:
        """Return P · V · M exactly."""
        return rational.product(
            self.clip_from_camera, self.camera_from_world.exact, self.world_from_object.exact
        )

    def space_from_world(self, space: Space) -> Transform:
        """Return the one matrix that makes a space.

        Raises
        ------
        NoAnswerError
            Object space of a singular world matrix; light space of a light without direction.
        IllegalValueError
            Custom space without its matrix.
        """
        if space in (Space.WORLD, Space.STATIC):
            return Transform(Frame(space), Frame.WORLD, rational.identity(4))
        if space is Space.CAMERA:
            return self.camera_from_world
        if space is Space.OBJECT:
            return self._object_from_world()
        if space is Space.LIGHT:
            return self._light_from_world()
        return self._custom_from_world()

    def space_from_object(self, space: Space) -> Transform:
        """Return `space_from_world @ world_from_object`; in static space it is baked once."""
        return self.space_from_world(space) @ self.world_from_object

    def eye_in(self, space: Space) -> RationalVector:
        """Return the eye in a space: subtract first, then solve; never through a product."""
        if space is Space.CAMERA:
            return ORIGIN
        return self.space_from_world(space).exact_point(self.eye)

    def is_rigid(self, space: Space) -> bool:
        """Return whether lengths and angles read off this space's coordinates are true."""
        return classify(self.space_from_world(space).exact, self.tolerance).is_rigid

    def _object_from_world(self) -> Transform:
        linear_map = self.world_from_object.linear_map
        if not linear_map.integer_determinant:
            raise NoAnswerError(
                "object space of a singular world matrix (determinant 0)",
                f"M flattens space to rank {linear_map.rank}, so no M⁻¹ leads back to the object",
                "shade in world or camera space, or give every axis a scale other than 0",
            )
        return self.world_from_object.inverse()

    def _light_from_world(self) -> Transform:
        position = self.light.position or ORIGIN
        towards = self.light.direction
        if towards is None:
            towards = tuple(t - p for t, p in zip(self.target, position, strict=True))
        if not any(towards):
            raise NoAnswerError(
                "light space",
                "the light stands at the target and has no direction",
                f"give {quantity('light_direction')}",
            )
        seen = looking_along(position, towards, self.up, Handedness.RIGHT)
        return Transform(Frame.LIGHT, Frame.WORLD, rational.rational_matrix(seen.camera_from_world))

    def _custom_from_world(self) -> Transform:
        if self.custom_from_world is None:
            raise IllegalValueError(
                "space custom",
                "it is whatever matrix you give, and none was given",
                f'try {quantity("space_matrix")} "2 0 0; 0 1 0; 0 0 1"',
            )
        if not self.custom_from_world.linear_map.integer_determinant:
            raise NoAnswerError(
                "space matrix (determinant 0)",
                "it flattens space, so directions in it have no meaning",
                "give an invertible matrix",
            )
        return self.custom_from_world
