"""The view group: where the camera stands and looks, as a target, as two angles or as a matrix."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

from nmatrix.enums import Convention, Handedness, chosen
from nmatrix.errors import IllegalValueError, NoAnswerError, quantity
from nmatrix.linear import rational
from nmatrix.linear.angle import Angle
from nmatrix.linear.rational import (
    RationalMatrix,
    RationalVector,
    rational_vector,
    rounded_for_display,
)
from nmatrix.linear.values import listed, named, read_fields, refuse_beside, vector
from nmatrix.linear.view import first_person, look_at
from nmatrix.reading.angles import float_turn
from nmatrix.reading.arrays import read_affine
from nmatrix.report import Displayed, Number, Quantity, Report, Vector
from nmatrix.scene.measured_view import Extrinsics, MeasuredView, measured_view

_POLIMI = (
    "convention polimi: a positive angle looks to the right: V = Rx(−elevation) · Ry(+angle) · "
    "T(−eye)"
)

AIM = ("target", "up")  # where to look, unless angles say so
ANGLES = ("elevation", "angle", "roll")
MEASURED = ("extrinsics", "pose")  # the whole place in one matrix, as a view matrix is


@dataclass(frozen=True)
class PlacedCamera:
    """A camera as matrices: what is shown, and the eye as it was given."""

    camera_from_world: RationalMatrix
    eye: RationalVector
    remarks: tuple[str, ...] = ()


@dataclass(frozen=True)
class FirstPerson(Displayed):
    """Where to look by angles, in degrees: up, sideways, and about the view direction."""

    elevation: float = 0.0
    angle: float = 0.0
    roll: float = 0.0

    def __post_init__(self) -> None:
        read_fields(self, elevation=float_turn, angle=float_turn, roll=float_turn)

    def _repr_report_(self) -> Report:
        """Tell the three angles."""
        angles = vars(self).items()
        return Report.of_value(*(Quantity(name, value, name, "°") for name, value in angles))


@dataclass(frozen=True)
class View(Displayed):
    """A camera in world units; `angles`, `matrix` or `measured` take the place of the target."""

    eye: Vector = (0, 0, 5)
    target: Vector = (0, 0, 0)
    up: Vector = (0, 1, 0)
    angles: FirstPerson | None = None
    matrix: RationalMatrix | None = None
    measured: MeasuredView | None = None
    handed: Handedness = Handedness.RIGHT
    convention: Convention = Convention.STANDARD

    def __post_init__(self) -> None:
        read_fields(
            self,
            eye=vector,
            target=vector,
            up=vector,
            angles=_read_angles,
            matrix=named("view_matrix", read_affine),
            measured=measured_view,
            handed=partial(chosen, Handedness),
            convention=partial(chosen, Convention),
        )
        refuse_beside(self, "matrix", ("eye", *AIM, "angles"), names={"matrix": "view_matrix"})
        measured_as = "extrinsics" if isinstance(self.measured, Extrinsics) else "pose"
        names = {"matrix": "view_matrix", "measured": measured_as}
        refuse_beside(self, "measured", ("eye", *AIM, "angles", "matrix"), names=names)
        refuse_beside(self, "angles", AIM, "both say where to look")
        if self.angles is not None and self.handed is Handedness.LEFT:
            raise IllegalValueError(
                f"{quantity('elevation')}/{quantity('angle')} with {quantity('handed')} left",
                "the two angles are defined for a camera that looks down −z",
                f"use {quantity('target')}, or leave {quantity('handed')} out",
            )

        if self.measured is not None and self.handed is Handedness.LEFT:
            raise IllegalValueError(
                f"{quantity(measured_as)} with {quantity('handed')} left",
                "a measured camera becomes one that looks down −z, and a left-handed one looks "
                "down +z",
                f"leave out {quantity('handed')} left, and {quantity('api')} direct3d",
            )

    def _repr_report_(self) -> Report:
        """Tell the view matrix and the eye."""
        placed = self.placed()
        return Report.of_value(
            Quantity("camera_from_world", placed.camera_from_world, "camera ← world"),
            Quantity("eye", placed.eye, "eye in world space"),
        )

    @property
    def is_aimed(self) -> bool:
        """Whether the camera looks at a target."""
        return (self.angles, self.matrix, self.measured) == (None, None, None)

    @property
    def typed_matrix(self) -> RationalMatrix | None:
        """The matrix that the camera was given as, in whatever sense."""
        return self.matrix if self.measured is None else self.measured.matrix

    def with_matrix(self, matrix: RationalMatrix) -> View:
        """Return the camera that another matrix in that same sense makes."""
        if self.measured is None:
            return replace(self, matrix=matrix)
        return replace(self, measured=replace(self.measured, matrix=matrix))

    def placed(self) -> PlacedCamera:
        """Return the view matrix and the eye.

        Raises
        ------
        NoAnswerError
            If eye and target coincide, `up` is zero, or a given matrix is singular.

        Examples
        --------
        >>> [float(row[3]) for row in View().placed().camera_from_world]
        [0.0, 0.0, -5.0, 1.0]
        """
        if self.matrix is not None:
            return PlacedCamera(self.matrix, _eye_of(self.matrix))
        if self.measured is not None:
            return PlacedCamera(self.measured.camera_from_world, self.measured.eye)
        if self.angles is not None:
            remarks = (_POLIMI,) if self.convention is Convention.POLIMI else ()
            exact = rounded_for_display(self.by_angles(Angle.degrees))
            return PlacedCamera(exact, rational_vector(self.eye), remarks)
        found = look_at(self.eye, self.target, self.up, self.handed)
        remarks = () if found.stand_in is None else (_instead_of_up(found.stand_in),)
        return PlacedCamera(found.camera_from_world, rational_vector(self.eye), remarks)

    def by_angles(self, turn: Callable[[Number], Angle]) -> RationalMatrix:
        """Build the view matrix of the two angles and the roll, which `turn` makes of degrees."""
        assert self.angles is not None  # that is when it is asked for
        given = self.angles
        elevation, angle, roll = turn(given.elevation), turn(given.angle), turn(given.roll)
        return first_person(self.eye, elevation, angle, roll, self.convention)


def _read_angles(given: object, name: str) -> FirstPerson:
    if isinstance(given, FirstPerson):
        return given
    return FirstPerson(*listed(given, name, (2, 3)))  # type: ignore[arg-type]  # all read there


def _instead_of_up(stand_in: RationalVector) -> str:
    """Tell which axis took the place of up, and how the other picture is asked for."""
    taken, other = (" ".join(str(sign * x) for x in stand_in) for sign in (1, -1))
    place = next(i for i, x in enumerate(stand_in) if x)
    axis = f"{'+' if stand_in[place] > 0 else '−'}{'xyz'[place]}"
    return (
        f"up is exactly parallel to the view direction, so it says nothing about roll; {axis} took "
        f"its place, as {quantity('up')} {taken} does; {quantity('up')} {other} gives the picture "
        "upside down"
    )


def _eye_of(camera_from_world: RationalMatrix) -> RationalVector:
    if rational.determinant(rational.linear_part(camera_from_world)) == 0:
        raise NoAnswerError(
            "view matrix (determinant 0)",
            "it flattens space, so no eye can be read from it",
            "give an invertible matrix",
        )
    return rational.translation(rational.inverse(camera_from_world))
