"""The world group: where an object stands, as parts or as one matrix."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property, partial

from nmatrix.enums import Convention, chosen
from nmatrix.errors import IllegalValueError, quantity
from nmatrix.linear import affine
from nmatrix.linear.angle import Angle
from nmatrix.linear.decompose import Parts, parts, parts_given
from nmatrix.linear.rank_keeping import rounded_keeping_rank
from nmatrix.linear.rational import (
    RationalMatrix,
    RoundedMatrix,
    linear_part,
    product,
    rational_vector,
    rounded_for_display,
)
from nmatrix.linear.rounding import integers, nearest, unit
from nmatrix.linear.values import listed, named, read_fields, refuse_beside, vector
from nmatrix.reading.angles import turn, turns
from nmatrix.reading.arrays import read_affine
from nmatrix.report import Displayed, Number, Quantity, Report, Vector

_CONVENTIONS = {
    Convention.POLIMI: (
        "convention polimi: the first angle turns about y, the second about x, and the y and z "
        "rotations turn against the right-hand rule: M = T · Rx(ry) · Ry(−rx) · Rz(−rz) · S",
    ),
    Convention.POLIMI_ASSIGNMENTS: (
        "convention polimi-assignments: the first angle turns about y and the second about x: "
        "M = T · Rx(ry) · Ry(rx) · Rz(rz) · S",
    ),
}
_EXACT_REMARK = (
    "The 3×3 block is computed with exactly: the printed floats are near it, but read back they "
    "are another map, of another rank, another side or another direction that vanishes."
)

_PARTS = ("translate", "quaternion", "axis_angle", "scale", "shear", "rotate_degrees")
_NAMES = {"matrix": "world_matrix", "rotate_degrees": "rotate"}


@dataclass(frozen=True)
class World(Displayed):
    """An object's place in the world; angles in degrees, as on the command line.

    Parameters
    ----------
    translate, scale, shear
        In world units; one number is a uniform scale; shear is xy, xz, yz.
    rotate_degrees
        About x, y, z, or the course's three angles under its conventions; numbers, `Angle` or
        texts such as "pi/6rad".
    quaternion
        x, y, z, w instead of the three angles; any length but zero.
    axis_angle
        x, y, z and the angle about that axis instead, by the right-hand rule; any length but zero.
    matrix
        A 4×4 matrix instead of the parts above; any array-like, 3×3 is its linear part.
    order, convention
        What the three angles mean; of a matrix, how its parts are told.

    Raises
    ------
    IllegalValueError
        For a value that is not that, an unknown order or convention, and for a quaternion or an
        order under a convention of the course.
    """

    translate: Vector = (0, 0, 0)
    rotate_degrees: Vector = (0, 0, 0)
    quaternion: Vector | None = None
    scale: Vector = (1, 1, 1)
    shear: Vector = (0, 0, 0)
    order: str = "XYZ"
    convention: Convention = Convention.STANDARD
    matrix: RationalMatrix | None = None
    axis_angle: Vector | None = None

    def __post_init__(self) -> None:
        read_fields(
            self,
            translate=vector,
            rotate_degrees=named("rotate", turns),
            quaternion=partial(vector, size=4),
            axis_angle=_read_axis_angle,
            scale=_read_scale,
            shear=vector,
            convention=partial(chosen, Convention),
            matrix=named("world_matrix", read_affine),
        )
        affine.checked_order(self.order)
        refuse_beside(self, "matrix", _PARTS, names=_NAMES)
        turned = ("rotate_degrees", "order")
        for whole in ("quaternion", "axis_angle"):
            refuse_beside(self, whole, turned, "it is the rotation", names=_NAMES)
        refuse_beside(self, "quaternion", ("axis_angle",), "both are the rotation", names=_NAMES)
        if self.convention is not Convention.STANDARD:
            if self.order != "XYZ":
                raise IllegalValueError(
                    f"{quantity('order')} {self.order} with "
                    f"{quantity('convention')} {self.convention}",
                    "the course's library fixes the order",
                    "leave one of them out",
                )
            for whole in ("quaternion", "axis_angle"):
                if getattr(self, whole) is not None:
                    raise IllegalValueError(
                        f"{quantity(whole)} with {quantity('convention')} {self.convention}",
                        "the course's library knows angles only",
                        "leave one of them out",
                    )

    def exact_by(self, turn: Callable[[Number], Angle]) -> RationalMatrix:
        """Return the matrix with every angle in degrees turned into sine and cosine by `turn`."""
        if self.matrix is not None:
            return self.matrix
        return affine.compose(self._rotation(turn), self.scale, self.shear, self.translate)

    def _rotation(self, turn: Callable[[Number], Angle]) -> RationalMatrix:
        if self.quaternion is not None:
            return affine.rotation_from_quaternion(self.quaternion)
        if self.axis_angle is not None:
            *axis, angle = self.axis_angle
            return affine.rotation_about_axis(axis, turn(angle))
        return affine.rotation_by(self.rotate_degrees, self.order, self.convention, turn)

    @property
    def exact(self) -> RationalMatrix:
        """Return the matrix before its one rounding."""
        return self.exact_by(Angle.degrees)

    @cached_property
    def world_from_object(self) -> RationalMatrix:
        """Round to the matrix of floats that is shown; what is derived from it is exact for it.

        An entry beyond the largest float64 stays the exact number that it is, and so does a 3×3
        block whose rank or mirroring floats would lose.

        Examples
        --------
        >>> World(scale=(1, 2, 1)).world_from_object[1][1]
        Fraction(2, 1)
        """
        return rounded_keeping_rank(self.exact)

    def under(self, world_from_parent: object) -> World:
        """Return the place in the world of an object that stands here under its parent, exactly.

        Examples
        --------
        >>> above = World(scale=(1, 2, 1)).world_from_object
        >>> int(World(translate=(0, 3, 0)).under(above).world_from_object[1][3])
        6
        """
        if world_from_parent is None:
            return self
        parent = read_affine(world_from_parent, "world_from_parent")
        M = product(parent, self.exact)
        return World(order=self.order, convention=self.convention, matrix=M)

    @cached_property
    def parts(self) -> Parts | None:
        """The parts that were given; of a matrix, those it can be taken apart into, or None.

        Of a matrix that was rounded they are the roundest that make its digits.

        Examples
        --------
        >>> World(scale=(-1, -1, -1)).parts.scale
        (Fraction(-1, 1), Fraction(-1, 1), Fraction(-1, 1))
        >>> World(matrix=[[-1, 0, 0], [0, -1, 0], [0, 0, -1]]).parts.rotate
        (180.0, 0.0, 0.0)
        """
        if isinstance(self.matrix, RoundedMatrix):
            from nmatrix.linear.identify import round_parts  # most matrices are exact

            return round_parts(self.matrix, self.order, self.convention)
        if self.matrix is not None:
            return parts(self.world_from_object, self.order, self.convention)
        quaternion = None if self.quaternion is None else rational_vector(self.quaternion)
        is_whole = quaternion is not None or self.axis_angle is not None
        angles = None if is_whole else rational_vector(self.rotate_degrees)
        found = parts_given(self._rotation(Angle.degrees), angles, self.order, self.convention)
        if self.axis_angle is not None:
            *axis, angle = rational_vector(self.axis_angle)
            found = replace(found, axis=unit(integers(axis)[0]), angle_deg=nearest(angle))
        return replace(
            found,
            translate=rational_vector(self.translate),
            quaternion=quaternion or found.quaternion,
            scale=rational_vector(self.scale),
            shear=rational_vector(self.shear),
        )

    def _repr_report_(self) -> Report:
        """Tell the world matrix."""
        M = self.world_from_object
        return Report.of_value(Quantity("world_from_object", M, "world ← object"))

    @property
    def remarks(self) -> tuple[str, ...]:
        """Explain a convention of the course, and a matrix that floats cannot hold."""
        block = linear_part(self.world_from_object)
        kept = (_EXACT_REMARK,) if rounded_for_display(block) != block else ()
        return (*_CONVENTIONS.get(self.convention, ()), *kept)


def _read_axis_angle(value: object, name: str) -> Vector:
    *axis, angle = listed(value, name, (4,))
    return (*vector(axis, name), turn(angle, f"{name}[3]"))


def _read_scale(scale: object, name: str) -> Vector:
    return vector(scale if hasattr(scale, "__len__") else (scale,) * 3, name)
