"""A world matrix taken apart: M = T(translate) · R · diag(scale) · H(shear).

Gram and Schmidt on the columns a, b, c of the 3×3 block, in exact fractions: the shears are
rational, the scales are single roots, and only R's angles need a rounded function.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from math import isqrt
from typing import Any

from nmatrix.enums import Convention
from nmatrix.errors import IllegalValueError
from nmatrix.linear.affine import AXES, compose, rotation_by, sum_of_rounded
from nmatrix.linear.angle import Angle
from nmatrix.linear.rational import (
    ONE,
    ZERO,
    RationalMatrix,
    RationalVector,
    determinant,
    dot,
    linear_part,
    rational_vector,
    rounded_for_display,
    translation,
    transpose,
)
from nmatrix.linear.rounding import integers, inverse_root, nearest, root, short_text, unit
from nmatrix.report import Vector

LOCKED = Fraction(1, 1 << 104)  # cos² of the middle angle; float64 can miss a quarter turn by it
DECIMALS, DIGITS = 12, 13  # decimals of angles and shears, and digits of scales, without noise
HALF_TURN = 180


@dataclass(frozen=True)
class Parts:
    """The parts of a world matrix; angles in degrees.

    `rotate` is about x, y, z in this order, or the course's three angles under its convention.
    The axis is None where nothing turns. Parts that were given are what a matrix was built from;
    others are one choice of several.
    """

    translate: Vector
    quaternion: Vector
    rotate: Vector
    scale: Vector
    shear: Vector
    order: str
    convention: Convention
    axis: Vector | None
    angle_deg: float
    gimbal_lock: bool
    given: bool = False

    @property
    def unique(self) -> bool:
        """Whether nothing was chosen; a matrix can always be taken apart in several ways."""
        return self.given

    @property
    def other_angles(self) -> Vector:
        """Three other angles that turn alike.

        At a gimbal lock the first angle takes all of the turn; else, or where it does so already,
        the outer angles change by a half turn and the middle one goes on past its quarter turn.
        """
        if self.gimbal_lock:
            R = rotation_by(self.rotate, self.order, self.convention)
            merged = _rotation_parts(R, self.order, self.convention).rotate
            if merged != self.rotate:
                return merged
        first, middle, last = sequence(self.order)
        angles = list(_about_axes(self.rotate, self.convention))
        angles[middle] = HALF_TURN - angles[middle]
        for outer in (first, last):
            angles[outer] += HALF_TURN
        turned = (HALF_TURN - (HALF_TURN - Fraction(one)) % 360 for one in angles)
        return _as_typed(tuple(turned), self.convention)


def parts(
    world_from_object: RationalMatrix,
    order: str = "XYZ",
    convention: Convention = Convention.STANDARD,
) -> Parts | None:
    """Factor a matrix into translation, rotation, scale and shear; None if it is singular.

    A mirror puts one minus sign on the scale, on the axis that leaves the smallest rotation.
    Where the middle angle is a quarter turn the last one is 0. If the parts without the noise of
    their last digits build the same floats, they are the parts.

    Examples
    --------
    >>> from nmatrix.linear.rational import identity
    >>> [float(s) for s in parts(compose(identity(3), scale=(1, -2, 1), shear=(0.5, 0, 0))).scale]
    [1.0, -2.0, 1.0]
    """
    det = determinant(linear_part(world_from_object))
    if det == 0:
        return None
    a, b, c = transpose(linear_part(world_from_object))
    xy, xz = dot(a, b) / dot(a, a), dot(a, c) / dot(a, a)
    b = tuple(q - xy * p for p, q in zip(a, b, strict=True))
    yz = dot(b, c) / dot(b, b)
    c = tuple(r - xz * p - yz * q for p, q, r in zip(a, b, c, strict=True))
    axes = [_unit(axis) for axis in (a, b, c)]
    scale = [_length(axis) for axis in (a, b, c)]
    if det < 0:
        flipped = min(range(3), key=lambda i: axes[i][i])
        axes[flipped] = tuple(-x for x in axes[flipped])
        scale[flipped] = -scale[flipped]
    found = replace(
        _rotation_parts(transpose(axes), order, convention),
        translate=rounded_for_display((translation(world_from_object),))[0],
        scale=tuple(scale),
        shear=rounded_for_display(((xy, xz, yz),))[0],
    )
    return _without_noise(found, world_from_object)


def parts_given(
    rotation: RationalMatrix,
    rotate: Vector | None,
    order: str = "XYZ",
    convention: Convention = Convention.STANDARD,
) -> Parts:
    """Tell a rotation that was given: its angles if it was given by them, and its other forms.

    Examples
    --------
    >>> quarter = (0, 0, 90)
    >>> found = parts_given(rotation_by(quarter), quarter)
    >>> found.axis, found.angle_deg, found.gimbal_lock
    ((0.0, 0.0, 1.0), 90.0, False)
    """
    found = _rotation_parts(rotation, order, convention, ZERO if rotate else LOCKED)
    return replace(found, rotate=rotate or found.rotate, given=True)


def _rotation_parts(
    R: RationalMatrix, order: str, convention: Convention, locked: Fraction = LOCKED
) -> Parts:
    """Tell a rotation as angles, as a quaternion, and by its axis; nothing else is moved."""
    rotate, gimbal_lock = _angles(R, order, convention, locked)
    quaternion = quaternion_of(R)
    sine_square = dot(quaternion[:3], quaternion[:3])
    turned = 2 * _degrees(_root(sine_square), quaternion[3])
    return Parts(
        translate=(ZERO,) * 3,
        quaternion=unit(integers(quaternion)[0]),
        rotate=rotate,
        scale=(1, 1, 1),
        shear=(ZERO,) * 3,
        order=order,
        convention=convention,
        axis=unit(integers(quaternion[:3])[0]) if sine_square else None,
        angle_deg=nearest(turned),
        gimbal_lock=gimbal_lock,
    )


def quaternion_of(R: RationalMatrix) -> RationalVector:
    """Convert a rotation to a quaternion x, y, z, w of some length, w ≥ 0.

    Its largest component is taken first, so nothing cancels.
    """
    products = quaternion_products(R, sum_of_rounded)
    row = products[largest_component(products)]
    return tuple(-x for x in row) if row[3] < 0 else row


def quaternion_products(
    R: RationalMatrix, add: Callable[[Fraction, Fraction], Fraction]
) -> RationalMatrix:
    """Multiply the components of a rotation's unit quaternion in pairs, 4 qᵢ qⱼ; w comes last."""
    squares = [
        1 + R[0][0] - R[1][1] - R[2][2],
        1 - R[0][0] + R[1][1] - R[2][2],
        1 - R[0][0] - R[1][1] + R[2][2],
        1 + R[0][0] + R[1][1] + R[2][2],
    ]
    xy, xz, yz = (add(R[i][j], R[j][i]) for i, j in ((0, 1), (0, 2), (1, 2)))
    xw, yw, zw = (add(R[i][j], -R[j][i]) for i, j in ((2, 1), (0, 2), (1, 0)))
    return (
        (squares[0], xy, xz, xw),
        (xy, squares[1], yz, yw),
        (xz, yz, squares[2], zw),
        (xw, yw, zw, squares[3]),
    )


def largest_component(products: RationalMatrix, size: Callable[..., Any] = Fraction) -> int:
    """Find the largest component of a quaternion, of some of one size w if it is one of them.

    A plain rotation keeps its half angle so.
    """
    return max((3, 0, 1, 2), key=lambda i: size(products[i][i]))


def _angles(
    R: RationalMatrix, order: str, convention: Convention, locked: Fraction
) -> tuple[Vector, bool]:
    """Convert a rotation to its three angles; True where the middle one is a quarter turn."""
    square = middle_cosine_square(R, order)
    gimbal_lock = square <= locked
    cosine = None if gimbal_lock else _root(square)
    found = turned_about_axes(R, order, cosine)
    about = tuple(nearest(_degrees(*one)) + 0.0 for one in found)
    return _as_typed(about, convention), gimbal_lock


def middle_cosine_square(R: RationalMatrix, order: str) -> Fraction:
    """Compute cos² of the middle angle of an order; at 0 there is a gimbal lock."""
    i, j, _ = sequence(order)
    return R[i][i] * R[i][i] + R[i][j] * R[i][j]


def turned_about_axes(
    R: RationalMatrix, order: str, middle_cosine: Fraction | None
) -> tuple[tuple[Fraction, Fraction], ...]:
    """Find sine and cosine, times a common factor, of the angles about x, y and z in an order.

    Without the middle one's cosine there is a gimbal lock, and the last angle is 0.
    """
    i, j, k = sequence(order)
    even = 1 if (j - i) % 3 == 1 else -1
    found = {j: (even * R[i][k], ZERO if middle_cosine is None else middle_cosine)}
    if middle_cosine is None:
        found |= {i: (even * R[k][j], R[j][j]), k: (ZERO, ONE)}
    else:
        found |= {i: (-even * R[j][k], R[k][k]), k: (-even * R[i][j], R[i][i])}
    return tuple(found[axis] for axis in range(3))


def sequence(order: str) -> tuple[int, int, int]:
    """Return the axes of an order as the product reads, x is 0."""
    i, j, k = map(AXES.index, order if order.isupper() else order[::-1].upper())
    return i, j, k


def _as_typed(about: Vector, convention: Convention) -> Vector:
    """Turn angles about x, y, z into those of a convention: the course's first is about y."""
    x, y, z = about
    if convention is Convention.POLIMI:
        return 0 - y, x, 0 - z
    return (y, x, z) if convention is Convention.POLIMI_ASSIGNMENTS else about


def _about_axes(typed: Vector, convention: Convention) -> Vector:
    """Turn a convention's angles into those about x, y, z."""
    first, second, third = typed
    if convention is Convention.POLIMI:
        return second, 0 - first, 0 - third
    return (second, first, third) if convention is Convention.POLIMI_ASSIGNMENTS else typed


def _without_noise(found: Parts, world_from_object: RationalMatrix) -> Parts:
    """Drop the last digits of the parts if that builds the same floats."""
    rotate = tuple(nearest(round(Fraction(angle), DECIMALS)) for angle in found.rotate)
    scale, shear = rounded_for_display(
        (
            tuple(Fraction(short_text(Fraction(one), DIGITS)) for one in found.scale),
            tuple(round(Fraction(one), DECIMALS) for one in found.shear),
        )
    )
    R = rotation_by(rotate, found.order, found.convention)
    built = compose(R, scale, shear, rational_vector(found.translate))
    if rounded_for_display(built) != rounded_for_display(world_from_object):
        return found
    turned = _rotation_parts(R, found.order, found.convention)
    return replace(turned, translate=found.translate, rotate=rotate, scale=scale, shear=shear)


def _length(axis: RationalVector) -> Fraction:
    """Measure an axis, rounded once; beyond float64 the whole number below it."""
    square = dot(axis, axis)
    try:
        return Fraction(root(square))
    except IllegalValueError:
        return Fraction(isqrt(square.numerator // square.denominator))


def _unit(axis: RationalVector) -> RationalVector:
    over = inverse_root(dot(axis, axis))
    return tuple(x * over for x in axis)


def _root(square: Fraction) -> Fraction:
    return square * inverse_root(square) if square else ZERO


def _degrees(sine: Fraction, cosine: Fraction) -> Fraction:
    return Fraction(Angle(sine, cosine).in_degrees)
