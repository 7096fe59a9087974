"""The setup: one object, one camera, one lens, one light, and the exact maps between them."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property, partial

from nmatrix.enums import Frame
from nmatrix.errors import IllegalValueError, NoAnswerError, quantity
from nmatrix.linear.angle import Angle, direction_from_angles
from nmatrix.linear.classify import BUILT
from nmatrix.linear.rational import (
    RationalMatrix,
    RationalVector,
    RoundedMatrix,
    rational_vector,
)
from nmatrix.linear.values import named, number, read_fields, refuse_beside, vector
from nmatrix.reading.angles import turns
from nmatrix.reading.arrays import read_affine
from nmatrix.report import Displayed, Quantity, Report, Vector
from nmatrix.scene.camera import PlacedCamera, View
from nmatrix.scene.lens import Lens
from nmatrix.scene.light import USUAL_DIRECTION
from nmatrix.scene.world import World
from nmatrix.spaces.exact_maps import ExactMaps, WorldLight
from nmatrix.spaces.transform import Transform


@dataclass(frozen=True)
class Light(Displayed):
    """A light: the direction in which it travels, or two angles for it, and a position."""

    direction: Vector | None = None
    angles_degrees: Vector | None = None
    position: Vector | None = None

    def __post_init__(self) -> None:
        read_fields(
            self,
            direction=named("light_direction", vector),
            angles_degrees=named("light_angles", partial(turns, size=2)),
            position=named("light_position", vector),
        )
        names = {"angles_degrees": "light_angles", "direction": "light_direction"}
        both = "both are the direction"
        refuse_beside(self, "angles_degrees", ("direction",), both, names=names)

    def _repr_report_(self) -> Report:
        """Tell the direction in which the light travels and its position, in world space."""
        placed = self.placed()
        told = (
            Quantity("direction", placed.direction, "light direction in world space"),
            Quantity("position", placed.position, "light position in world space"),
        )
        return Report.of_value(*(one for one in told if one.value is not None))

    def placed(self) -> WorldLight:
        """Return the light in world space; nothing given means along −1 −1 −1.

        Raises
        ------
        NoAnswerError
            For a direction of length zero.
        """
        return WorldLight(
            self._direction(),
            None if self.position is None else rational_vector(self.position),
        )

    def _direction(self) -> RationalVector | None:
        if self.angles_degrees is not None:
            alpha, beta = map(Angle.degrees, self.angles_degrees)
            return rational_vector(direction_from_angles(alpha, beta))
        if self.direction is None:
            return None if self.position is not None else rational_vector(USUAL_DIRECTION)
        if not any(self.direction):
            raise NoAnswerError(
                "light direction (0 0 0)",
                "light that travels nowhere lights nothing",
                f"try {quantity('light_direction')} -1 -1 -1",
            )
        return rational_vector(self.direction)


@dataclass(frozen=True)
class Setup(Displayed):
    """Everything that a command can ask about, in one value."""

    world: World = field(default_factory=World)
    view: View = field(default_factory=View)
    lens: Lens = field(default_factory=Lens)
    light: Light = field(default_factory=Light)
    space_matrix: RationalMatrix | None = None
    tolerance: float | Fraction = BUILT

    def __post_init__(self) -> None:
        read_fields(self, space_matrix=read_affine, tolerance=number)
        if not 0 <= self.tolerance < 1:
            named = f"{quantity('tolerance')} ({self.tolerance})"
            raise IllegalValueError(named, "it lies in [0, 1)", "try 1e-9")

    def _repr_report_(self) -> Report:
        """Tell the matrices, the eye and the light."""
        parts = (self.world, self.view, self.lens, self.light)
        blocks = (block for part in parts for block in part._repr_report_().blocks)
        return Report.of_value(*blocks)

    @cached_property
    def camera(self) -> PlacedCamera:
        """Return the placed camera."""
        return self.view.placed()

    @cached_property
    def maps(self) -> ExactMaps:
        """Return the exact maps that every space is derived from.

        Examples
        --------
        >>> Setup().maps.eye
        (Fraction(0, 1), Fraction(0, 1), Fraction(5, 1))
        """
        return ExactMaps(
            world_from_object=self.placed_world,
            camera_from_world=Transform(Frame.CAMERA, Frame.WORLD, self.camera.camera_from_world),
            clip_from_camera=self.lens.clip_from_camera,
            eye=self.camera.eye,
            light=self.light.placed(),
            target=rational_vector(self.view.target),
            up=rational_vector(self.view.up),
            custom_from_world=None
            if self.space_matrix is None
            else Transform(Frame.CUSTOM, Frame.WORLD, self.space_matrix),
            tolerance=float(self.tolerance),
            to_digits=None if self.to_digits is self else self.to_digits.maps,
        )

    @cached_property
    def to_digits(self) -> Setup:
        """The setup with every rounded matrix replaced by what it stands for."""
        world, view, space = self.world, self.view, self.space_matrix
        if not any(
            isinstance(one, RoundedMatrix) for one in (world.matrix, view.typed_matrix, space)
        ):
            return self
        from nmatrix.linear.rounded import meant  # most matrices are built, or exact

        return replace(
            self,
            world=world if world.matrix is None else replace(world, matrix=meant(world.matrix)),
            view=view if view.typed_matrix is None else view.with_matrix(meant(view.typed_matrix)),
            space_matrix=None if space is None else meant(space),
        )

    @property
    def placed_world(self) -> Transform:
        """Return `world_from_object` with its frames."""
        return Transform(Frame.WORLD, Frame.OBJECT, self.world.world_from_object)

    @property
    def remarks(self) -> tuple[str, ...]:
        """Return the remarks of the world and the camera, each sentence once."""
        return tuple(dict.fromkeys((*self.world.remarks, *self.camera.remarks)))
