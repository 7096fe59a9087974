"""Taking a world matrix apart: M = T(translate) · R · diag(scale) · H(shear).

Gram and Schmidt on the columns a, b, c of the 3×3 block, in exact fractions: the shears are
rational, the scales are single roots, and only R's angles need a rounded function.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import atan2, degrees, hypot, isqrt, sqrt

from nmatrix.errors import IllegalValueError
from nmatrix.linear.affine import AXES
from nmatrix.linear.rational import (
    RationalMatrix,
    RationalVector,
    Rows,
    determinant,
    dot,
    linear_part,
    rounded_for_display,
    translation,
    transpose,
)
from nmatrix.linear.rounding import integers, root, unit

Three = tuple[float, ...]
Exact = tuple[Fraction, ...]  # floats, but for what no float64 can hold


@dataclass(frozen=True)
class Parts:
    """The parts of a world matrix; angles in degrees, about x, y, z in the order asked for."""

    translate: Exact
    quaternion: Three
    rotate: Three
    scale: Exact
    shear: Exact


def parts(world_from_object: RationalMatrix, order: str = "XYZ") -> Parts | None:
    """Return translation, rotation, scale and shear, or None for a singular matrix.

    A mirror puts one minus sign on the scale, on the axis that leaves the smallest rotation.

    Examples
    --------
    >>> from nmatrix.linear.affine import compose
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
    axes = [unit(integers(axis)[0]) for axis in (a, b, c)]
    scale = [_length(axis) for axis in (a, b, c)]
    if det < 0:
        flipped = min(range(3), key=lambda i: axes[i][i])
        axes[flipped] = tuple(-x for x in axes[flipped])
        scale[flipped] = -scale[flipped]
    R = tuple(zip(*axes, strict=True))
    return Parts(
        translate=rounded_for_display((translation(world_from_object),))[0],
        quaternion=quaternion_of(R),
        rotate=angles_of(R, order),
        scale=tuple(scale),
        shear=rounded_for_display(((xy, xz, yz),))[0],
    )


def _length(axis: RationalVector) -> Fraction:
    """Return the length of an axis, rounded once; beyond float64 the whole number below it."""
    square = dot(axis, axis)
    try:
        return Fraction(root(square))
    except IllegalValueError:
        return Fraction(isqrt(square.numerator // square.denominator))


def quaternion_of(R: Rows) -> Three:
    """Return the unit quaternion x, y, z, w (w ≥ 0) of a rotation, within a few ulp.

    Its largest component is taken first, so nothing cancels.
    """
    squares = [
        1 + R[0][0] - R[1][1] - R[2][2],
        1 - R[0][0] + R[1][1] - R[2][2],
        1 - R[0][0] - R[1][1] + R[2][2],
        1 + R[0][0] + R[1][1] + R[2][2],
    ]
    products = [
        [squares[0], R[0][1] + R[1][0], R[0][2] + R[2][0], R[2][1] - R[1][2]],
        [R[0][1] + R[1][0], squares[1], R[1][2] + R[2][1], R[0][2] - R[2][0]],
        [R[0][2] + R[2][0], R[1][2] + R[2][1], squares[2], R[1][0] - R[0][1]],
        [R[2][1] - R[1][2], R[0][2] - R[2][0], R[1][0] - R[0][1], squares[3]],
    ]
    # A tie goes to w, so that a plain rotation keeps its half angle.
    largest = max((3, 0, 1, 2), key=lambda i: squares[i])
    row = products[largest]
    size = sqrt(sum(x * x for x in row))
    sign = -1.0 if row[3] < 0 else 1.0
    return tuple(sign * x / size + 0.0 for x in row)


def angles_of(R: Rows, order: str = "XYZ") -> Three:
    """Return the three angles about x, y, z in degrees that give R in this order.

    Where the middle angle is ±90° only the sum of the outer two is known; the last one is then 0.
    """
    sequence = order if order.isupper() else order[::-1].upper()
    i, j, k = (AXES.index(axis) for axis in sequence)
    even = 1.0 if (j - i) % 3 == 1 else -1.0
    middle = atan2(even * R[i][k], hypot(R[i][i], R[i][j]))
    if hypot(R[i][i], R[i][j]) > 1e-15:
        first = atan2(-even * R[j][k], R[k][k])
        last = atan2(-even * R[i][j], R[i][i])
    else:
        first, last = atan2(even * R[k][j], R[j][j]), 0.0
    found = {i: first, j: middle, k: last}
    return tuple(degrees(found[axis]) + 0.0 for axis in range(3))
