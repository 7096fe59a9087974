"""World matrices: move, turn, scale and shear, exact until one rounding at the end.

M = T(translate) · R · diag(scale) · H(shear), column vectors; rotations by the right-hand rule.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from operator import mul
from typing import TypeVar

from nmatrix.enums import Convention
from nmatrix.errors import IllegalValueError, NoAnswerError, quantity
from nmatrix.linear.angle import KNOWN_BITS, Angle, as_angle
from nmatrix.linear.rational import (
    ONE,
    ZERO,
    RationalMatrix,
    RationalVector,
    affine_matrix,
    identity,
    numbers_like,
    product,
    rational_vector,
)
from nmatrix.linear.rounding import integers, inverse_root, quotient
from nmatrix.report import Number

Real = TypeVar("Real", int, Fraction)

AXES = "XYZ"
Turn = TypeVar("Turn", int, float, Fraction, Angle)  # all can turn the other way
CANCELLED = Fraction(1, 1 << 125)  # of its terms: a sum below it is what their rounding left


def rotation_about(axis: str, turn: Angle | float) -> RationalMatrix:
    """Build the 3×3 rotation about one axis (`X`, `Y` or `Z`) by an angle or by radians.

    Examples
    --------
    >>> from nmatrix.linear.rational import to_floats
    >>> to_floats(rotation_about("Z", Angle.degrees(90)))
    ((0.0, -1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    """
    angle = as_angle(turn)
    s, c = angle.sine, angle.cosine
    zero, one = (0.0, 1.0) if isinstance(s, float) else (ZERO, ONE)
    if axis == "X":
        return ((one, zero, zero), (zero, c, -s), (zero, s, c))
    if axis == "Y":
        return ((c, zero, s), (zero, one, zero), (-s, zero, c))
    return ((c, -s, zero), (s, c, zero), (zero, zero, one))


def checked_order(order: str) -> str:
    """Refuse an order that is no permutation of XYZ (intrinsic) or of xyz (extrinsic).

    Raises
    ------
    IllegalValueError
        For mixed case, a repeated axis or another length.
    """
    if not isinstance(order, str) or sorted(order) not in (list(AXES), list(AXES.lower())):
        raise IllegalValueError(
            f"order ({str(order)[:20] if isinstance(order, str) else type(order).__name__})",
            "it must hold each axis once, in capitals (about the turned axes) or in small letters "
            "(about the fixed axes)",
            f"try {quantity('order')} XYZ or {quantity('order')} zyx",
        )
    return order


def sequence(
    turns: Sequence[Turn], order: str = "XYZ", convention: Convention = Convention.STANDARD
) -> tuple[tuple[str, Turn], ...]:
    """List the three turns by their axes, as the product of their rotations reads.

    Capitals are intrinsic: the product reads as the order does, `XYZ` is Rx·Ry·Rz. Small letters
    are extrinsic: the product reads backwards, `xyz` is Rz·Ry·Rx. The first angle of the course's
    library turns about y and its second about x; in the labs' version the y and z rotations turn
    the other way, too.

    Raises
    ------
    IllegalValueError
        If the order is not a permutation of `XYZ` or of `xyz`.

    Examples
    --------
    >>> sequence((10, 20, 30), "ZYX"), sequence((10, 20, 30), convention=Convention.POLIMI)
    ((('Z', 30), ('Y', 20), ('X', 10)), (('X', 20), ('Y', -10), ('Z', -30)))
    """
    x, y, z = turns
    if convention is Convention.POLIMI:
        return ("X", y), ("Y", -x), ("Z", -z)
    if convention is not Convention.STANDARD:
        return ("X", y), ("Y", x), ("Z", z)
    about = {"X": x, "Y": y, "Z": z}
    axes = checked_order(order) if order.isupper() else checked_order(order)[::-1].upper()
    return tuple((axis, about[axis]) for axis in axes)


def rotation(
    turns: Sequence[Angle | float],
    order: str = "XYZ",
    convention: Convention = Convention.STANDARD,
) -> RationalMatrix:
    """Build the 3×3 rotation by three angles about x, y, z, in the order that `sequence` says."""
    angles = sequence([as_angle(turn) for turn in turns], order, convention)
    return _known(product(*(rotation_about(axis, turn) for axis, turn in angles)))


def rotation_by(
    degrees: Sequence[Number],
    order: str = "XYZ",
    convention: Convention = Convention.STANDARD,
    turn: Callable[[Number], Angle] = Angle.degrees,
) -> RationalMatrix:
    """Build the rotation by three angles in degrees, in an order or by a course's convention.

    Examples
    --------
    >>> rotation_by((90, 0, 0), convention=Convention.POLIMI) == rotation_by((0, -90, 0))
    True
    """
    return rotation([turn(angle) for angle in degrees], order, convention)


def _known(R: RationalMatrix) -> RationalMatrix:
    """Cut a product of sines to the bits that are known.

    √½ · √½ is then ½, so that what lies halfway between two floats is rounded to the even one.
    A proof's sines are polynomials, which nothing cuts.
    """
    if isinstance(R[0][0], float):
        return R
    return tuple(
        tuple(
            quotient(entry.numerator, entry.denominator, KNOWN_BITS)
            if isinstance(entry, Fraction)
            else entry
            for entry in row
        )
        for row in R
    )


def rotation_from_quaternion(quaternion: Sequence[float | Fraction]) -> RationalMatrix:
    """Build the 3×3 rotation of a quaternion x, y, z, w of any length but zero, exactly.

    Dividing by the squared length normalises without a root, so the result is rational.

    Raises
    ------
    NoAnswerError
        For the zero quaternion.

    Examples
    --------
    >>> from nmatrix.linear.rational import to_floats
    >>> to_floats(rotation_from_quaternion((0, 0, 1, 1)))
    ((0.0, -1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    """
    components, _ = integers(quaternion)
    square = sum(one * one for one in components)
    if square == 0:
        raise NoAnswerError(
            "quaternion (0 0 0 0)",
            "it has no direction",
            f"no rotation is {quantity('quaternion')} 0 0 0 1",
        )
    return tuple(
        tuple(Fraction(entry, square) for entry in row)
        for row in turned_by_quaternion(components, square)
    )


def turned_by_quaternion(
    quaternion: Sequence[Real], square: Real
) -> tuple[tuple[Real, Real, Real], ...]:
    """Build the rotation of a quaternion x, y, z, w times the square of its length."""
    x, y, z, w = quaternion
    return (
        (square - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)),
        (2 * (x * y + z * w), square - 2 * (x * x + z * z), 2 * (y * z - x * w)),
        (2 * (x * z - y * w), 2 * (y * z + x * w), square - 2 * (x * x + y * y)),
    )


def rotation_about_axis(axis: Sequence[float | Fraction], turn: Angle | float) -> RationalMatrix:
    """Return the 3×3 rotation about an axis of any length but zero, by the right-hand rule.

    R = cos θ·I + (1 − cos θ)·a aᵀ/a² + sin θ/|a|·[a]×: only the length needs a root, of 160 bits.

    Raises
    ------
    NoAnswerError
        For the zero axis.

    Examples
    --------
    >>> [[int(x) for x in row] for row in rotation_about_axis((0, 0, 2), Angle.degrees(90))]
    [[0, -1, 0], [1, 0, 0], [0, 0, 1]]
    """
    a = rational_vector(axis)
    square = sum(component * component for component in a)
    if not square:
        raise NoAnswerError("axis (0 0 0)", "it has no direction", "try 0 1 0")
    angle = as_angle(turn)
    s, c = angle.sine * inverse_root(square), angle.cosine
    crossed = cross_matrix(a)
    along = (1 - c) / square
    return _known(
        tuple(
            tuple(
                sum_of_rounded(c * (i == j), along * a[i] * a[j], s * crossed[i][j])
                for j in range(3)
            )
            for i in range(3)
        )
    )


def cross_matrix(a: RationalVector) -> RationalMatrix:
    """Build [a]×, the matrix that takes v to a × v.

    Examples
    --------
    >>> for row in cross_matrix((Fraction(1), Fraction(2), Fraction(3))):
    ...     print(*row)
    0 -3 2
    3 0 -1
    -2 1 0
    """
    x, y, z = a
    return ((ZERO, -z, y), (z, ZERO, -x), (-y, x, ZERO))


def sum_of_rounded(*terms: Fraction) -> Fraction:
    """Add terms known to 130 bits; where nothing is left but their rounding, that is 0.

    Examples
    --------
    >>> sum_of_rounded(Fraction(1), Fraction(-1) + Fraction(1, 1 << 129))
    Fraction(0, 1)
    """
    total = sum(terms, ZERO)
    return total if abs(total) > CANCELLED * max(map(abs, terms)) else ZERO


def shear_matrix(shear: RationalVector) -> RationalMatrix:
    """Build H, which moves x along y (xy) and along z (xz), and y along z (yz)."""
    xy, xz, yz = shear
    zero, one = numbers_like((shear,), (ZERO, ONE))
    return ((one, xy, xz), (zero, one, yz), (zero, zero, one))


def compose(
    turned: RationalMatrix,
    scale: Sequence[float | Fraction] = (1, 1, 1),
    shear: Sequence[float | Fraction] = (0, 0, 0),
    translate: Sequence[float | Fraction] = (0, 0, 0),
) -> RationalMatrix:
    """Build M = T · R · diag(scale) · H as an exact 4×4 matrix.

    Examples
    --------
    >>> from nmatrix.linear.rational import to_floats
    >>> to_floats(compose(identity(3), scale=(1, 2, 1), translate=(5, 0, 0)))[0:2]
    ((1.0, 0.0, 0.0, 5.0), (0.0, 2.0, 0.0, 0.0))
    """
    stretch = numbers_like(turned, scale)
    block = tuple(tuple(map(mul, row, stretch)) for row in turned)  # R · diag(scale)
    if any(shear):
        block = product(block, shear_matrix(numbers_like(turned, shear)))
    return affine_matrix(block, numbers_like(turned, translate))


def translation_matrix(offset: Sequence[float | Fraction]) -> RationalMatrix:
    """Build the 4×4 matrix that moves points by the offset."""
    return affine_matrix(identity(3), rational_vector(offset))
