"""World matrices: move, turn, scale and shear, exact until one rounding at the end.

M = T(translate) · R · diag(scale) · H(shear), column vectors; rotations by the right-hand rule.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from operator import mul

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

AXES = "XYZ"
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


def rotation(turns: Sequence[Angle | float], order: str = "XYZ") -> RationalMatrix:
    """Build the 3×3 rotation by three angles, always given about x, y, z.

    Capitals are intrinsic: the product reads as the order does, `XYZ` is Rx·Ry·Rz. Small letters
    are extrinsic: the product reads backwards, `xyz` is Rz·Ry·Rx.

    Raises
    ------
    IllegalValueError
        If the order is not a permutation of `XYZ` or of `xyz`.
    """
    about = {axis: rotation_about(axis, turn) for axis, turn in zip(AXES, turns, strict=True)}
    sequence = checked_order(order) if order.isupper() else checked_order(order)[::-1].upper()
    return _known(product(*(about[axis] for axis in sequence)))


def course_rotation(turns: Sequence[Angle | float], convention: Convention) -> RationalMatrix:
    """Build the rotation of the course's library from its three angles.

    Its first angle turns about y and its second about x; in the labs' version the y and z
    rotations turn the other way, too.
    """
    rx, ry, rz = map(as_angle, turns)
    if convention is Convention.POLIMI:
        rx, rz = -rx, -rz
    return _known(
        product(rotation_about("X", ry), rotation_about("Y", rx), rotation_about("Z", rz))
    )


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
    turns = [turn(angle) for angle in degrees]
    if convention is Convention.STANDARD:
        return rotation(turns, order)
    return course_rotation(turns, convention)


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
    (x, y, z, w), _ = integers(quaternion)
    square = x * x + y * y + z * z + w * w
    if square == 0:
        raise NoAnswerError(
            "quaternion (0 0 0 0)",
            "it has no direction",
            f"no rotation is {quantity('quaternion')} 0 0 0 1",
        )
    return tuple(
        tuple(Fraction(entry, square) for entry in row)
        for row in (
            (square - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)),
            (2 * (x * y + z * w), square - 2 * (x * x + z * z), 2 * (y * z - x * w)),
            (2 * (x * z - y * w), 2 * (y * z + x * w), square - 2 * (x * x + y * y)),
        )
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
    x, y, z = a
    crossed = ((ZERO, -z, y), (z, ZERO, -x), (-y, x, ZERO))
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
