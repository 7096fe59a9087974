"""View matrices: `camera_from_world` by a target or by two angles, and its axes.

f is the view direction, r the camera's right, u its up; the rows of the matrix are r, u and −f
(right-handed) or r, u and f (left-handed). Each entry is a quotient with one exact root, so each
is rounded once: the frame is orthonormal to rounding, however near or far the target is.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from nmatrix.enums import Convention, Handedness
from nmatrix.errors import NoAnswerError, quantity
from nmatrix.linear.affine import rotation_about
from nmatrix.linear.angle import Angle, as_angle
from nmatrix.linear.rational import (
    AFFINE_ROW,
    RationalMatrix,
    RationalVector,
    affine_matrix,
    apply,
    cross,
    dot,
    numbers_like,
    product,
    rational_vector,
)
from nmatrix.linear.rounding import integers, over_root, over_root_of_any_size


@dataclass(frozen=True)
class LookAt:
    """A view matrix made from a target; `stand_in` is the axis that took the place of `up`.

    The matrix holds floats, except an offset that is beyond all of them: it is known to 160 bits.
    """

    camera_from_world: RationalMatrix
    stand_in: RationalVector | None


def look_at(
    eye: Sequence[float | Fraction],
    target: Sequence[float | Fraction],
    up: Sequence[float | Fraction] = (0, 1, 0),
    handed: Handedness = Handedness.RIGHT,
) -> LookAt:
    """Build the view matrix of a camera at `eye` that looks at `target`, in world units.

    The view direction is never altered. If `up` is exactly parallel to it, the world's z or y takes
    its place, in the sense that puts +x on the right: what a camera sees that looks along −z and is
    then tilted straight down or up.

    Raises
    ------
    NoAnswerError
        If eye and target coincide, or `up` is the zero vector.

    Examples
    --------
    >>> for row in look_at((0, 0, 5), (0, 0, 0)).camera_from_world:
    ...     print(*row)
    1 0 0 0
    0 1 0 0
    0 0 1 -5
    0 0 0 1
    >>> print(*look_at((0, 5, 0), (0, 0, 0)).stand_in)
    0 0 -1
    """
    eye_world, target_world = rational_vector(eye), rational_vector(target)
    forward = tuple(t - e for e, t in zip(eye_world, target_world, strict=True))
    if not any(forward):
        raise NoAnswerError(
            f"eye and target ({' '.join(f'{float(x):g}' for x in eye)})",
            "they coincide, so there is no direction to look in",
            "move one of them",
        )
    return looking_along(eye_world, forward, rational_vector(up), handed)


def looking_along(
    eye: RationalVector, forward: RationalVector, up: RationalVector, handed: Handedness
) -> LookAt:
    """Build the view matrix of a camera at `eye` that looks along `forward`."""
    if not any(up):
        raise NoAnswerError("up (0 0 0)", "it has no direction", f"try {quantity('up')} 0 1 0")
    stand_in = None if any(cross(forward, up)) else upright_for(forward)
    rows = [_row(axis, eye) for axis in camera_axes(forward, stand_in or up, handed)]
    return LookAt((*rows, AFFINE_ROW), stand_in)


def camera_axes(
    forward: RationalVector, up: RationalVector, handed: Handedness
) -> tuple[RationalVector, RationalVector, RationalVector]:
    """Find the directions of the camera's own x, y and z in the world, of any length.

    Examples
    --------
    >>> F = Fraction
    >>> for axis in camera_axes((F(0), F(0), F(-2)), (F(0), F(1), F(0)), Handedness.RIGHT):
    ...     print(*axis)
    2 0 0
    0 4 0
    0 0 2
    """
    right = cross(forward, up)
    upward = cross(right, forward)
    if handed is Handedness.LEFT:
        return tuple(-x for x in right), upward, forward
    return right, upward, tuple(-x for x in forward)


def upright_for(forward: RationalVector) -> RationalVector:
    """Choose z or y, whichever is less aligned with the view, in the sense that puts +x right."""
    axis = min((2, 1), key=lambda i: abs(forward[i]))
    upright = tuple(Fraction(int(i == axis)) for i in range(3))
    sense = next(component for component in cross(forward, upright) if component)
    return upright if sense > 0 else tuple(-component for component in upright)


def _row(axis: RationalVector, eye: RationalVector) -> RationalVector:
    """Return the unit axis and minus the eye's coordinate along it, each rounded once."""
    direction, _ = integers(axis)
    square = sum(component * component for component in direction)
    along = -dot([Fraction(c) for c in direction], eye)
    offset = over_root_of_any_size(along.numerator, square * along.denominator**2)
    return (*(Fraction(over_root(component, square)) for component in direction), offset)


def first_person(
    eye: Sequence[float | Fraction],
    elevation: Angle | float,
    angle: Angle | float,
    roll: Angle | float = 0.0,
    convention: Convention = Convention.STANDARD,
) -> RationalMatrix:
    """Build the exact view matrix Rz(−roll) · Rx(−elevation) · Ry(∓angle) · T(−eye).

    The angle turns to the left by the right-hand rule, and to the right in the course's labs
    (`polimi`). Elevation looks up.

    Examples
    --------
    >>> from nmatrix.linear.rational import to_floats
    >>> to_floats(first_person((0, 0, 0), Angle.degrees(0), Angle.degrees(90)))[0]
    (0.0, 0.0, -1.0, 0.0)
    """
    sideways = as_angle(angle)
    turned = product(
        rotation_about("Z", -as_angle(roll)),
        rotation_about("X", -as_angle(elevation)),
        rotation_about("Y", sideways if convention is Convention.POLIMI else -sideways),
    )
    offset = apply(turned, numbers_like(turned, eye))
    return affine_matrix(turned, tuple(-component for component in offset))
