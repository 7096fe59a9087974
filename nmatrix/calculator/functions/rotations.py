"""Rotations: about an axis, by a quaternion, by three angles, and back from a matrix.

Where a matrix also scales or shears, its rotation is the one of M = T · R · diag(scale) · H(shear).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from nmatrix.calculator.arithmetic.numbers import (
    Float64,
    Interval,
    Number,
    angle,
    degrees_of,
    is_negative,
    is_zero,
    may_be_positive,
    root,
    size,
)
from nmatrix.calculator.arithmetic.values import Value
from nmatrix.calculator.functions.function import (
    FOUR,
    Function,
    NoAnswerForArgumentError,
    Parameter,
    matrix,
    require_size,
    turn,
    vector,
    zero_vector,
)
from nmatrix.calculator.functions.matrices import block_of
from nmatrix.calculator.functions.vectors import length_of
from nmatrix.linear import rational
from nmatrix.linear.affine import AXES, cross_matrix, rotation_about, turned_by_quaternion
from nmatrix.linear.angle import Angle
from nmatrix.linear.decompose import (
    LOCKED,
    largest_component,
    middle_cosine_square,
    quaternion_products,
    turned_about_axes,
)
from nmatrix.linear.rational import ZERO, RationalMatrix, RationalVector

ORDERS = tuple(
    "".join(order)
    for axes in (AXES, AXES.lower())
    for order in ((a, b, c) for a in axes for b in axes for c in axes)
    if len(set(order)) == 3
)
ORDER = Parameter(
    "order", is_optional=True, words="a permutation of XYZ or of xyz, in quotes", choices=ORDERS
)


def about_axis(axis: RationalVector, turned: Angle) -> RationalMatrix:
    """Build the 3×3 rotation about an axis of any length but zero."""
    square = rational.dot(axis, axis)
    s, c = turned.sine / length_of(axis), turned.cosine
    along, crossed = (1 - c) / square, cross_matrix(axis)
    return tuple(
        tuple(
            (c if i == j else ZERO) + along * axis[i] * axis[j] + s * crossed[i][j]
            for j in range(3)
        )
        for i in range(3)
    )


def by_quaternion(quaternion: RationalVector) -> RationalMatrix:
    """Build the 3×3 rotation of a quaternion x, y, z, w of any length but zero."""
    square = rational.dot(quaternion, quaternion)
    rows = turned_by_quaternion(quaternion, square)
    return tuple(tuple(entry / square for entry in row) for row in rows)


def _axis_angle(axis: Value, turned: Value) -> Value:
    require_size(axis, 3, "an axis of three numbers")
    if is_zero(rational.dot(axis.vector, axis.vector)):
        raise zero_vector(axis, "a rotation about no axis")
    return Value(rational.affine_matrix(about_axis(axis.vector, angle(turned.scalar))))


def _quaternion(q: Value) -> Value:
    require_size(q, 4, "a quaternion x, y, z, w")
    if is_zero(rational.dot(q.vector, q.vector)):
        why, step = "it has no direction", "no rotation is 0, 0, 0, 1"
        raise NoAnswerForArgumentError(q, "the quaternion 0, 0, 0, 0", why, step)
    return Value(rational.affine_matrix(by_quaternion(q.vector)))


def rotation_of(M: Value) -> RationalMatrix:
    """Find the rotation of a matrix: what is left where scale and shear are taken out.

    The columns are made unit and perpendicular, the first one first; those that are perpendicular
    as far as is known stay so. A mirror turns the column round that leaves the smallest rotation.

    Raises
    ------
    NoAnswerError
        If the 3×3 block is singular.
    """
    a, b, c = rational.transpose(block_of(M).matrix)
    x = _unit(M, a)
    y = _unit(M, _without(x, b))
    z = _unit(M, _without(y, _without(x, c)))
    axes = [x, y, z]
    if is_negative(rational.determinant(tuple(axes))):
        flipped = min(range(3), key=lambda i: float(axes[i][i]))
        axes[flipped] = tuple(-one for one in axes[flipped])
    return rational.transpose(axes)


def _without(unit: RationalVector, v: RationalVector) -> RationalVector:
    along = rational.dot(unit, v)
    if isinstance(along, Interval) and along.low <= 0 <= along.high:
        return v
    return tuple(one - along * axis for one, axis in zip(v, unit, strict=True))


def _unit(M: Value, v: RationalVector) -> RationalVector:
    if is_zero(rational.dot(v, v)):
        why = "its determinant is 0, and it flattens space"
        raise NoAnswerForArgumentError(M, "the rotation of a singular matrix", why, "use another")
    length = length_of(v)
    return tuple(one / length for one in v)


def _quaternion_of(M: Value) -> Value:
    products = quaternion_products(rotation_of(M), lambda one, other: one + other)
    place = largest_component(products, size)
    twice = Value(root(products[place][place])).scalar
    found: Sequence[Number] = [one / (2 * twice) for one in products[place]]
    turned_round = not may_be_positive(found[3])
    return Value(tuple(-one for one in found) if turned_round else tuple(found))


def _euler(M: Value, order: str) -> Value:
    R = rotation_of(M)
    square = middle_cosine_square(R, order)
    cosine = None if _is_locked(square) else Value(root(square)).scalar
    return Value(tuple(degrees_of(*one) for one in turned_about_axes(R, order, cosine)))


def _euler_remarks(M: Value, order: str) -> list[str]:
    if not _is_locked(middle_cosine_square(rotation_of(M), order)):
        return []
    return ["The middle angle is a quarter turn, a gimbal lock: the last one is taken as 0."]


def _is_locked(square: Number) -> bool:
    """Tell whether a squared cosine is 0, of floats all but their rounding."""
    return size(square) <= LOCKED if isinstance(square, Float64) else is_zero(square)


def _rotate(axis: str) -> Function:
    def compute(turned: Value) -> Value:
        return Value(rational.affine_matrix(rotation_about(axis, angle(turned.scalar))))

    name = axis.lower()
    quarter = {
        "x": "[1 0 0 0; 0 0 -1 0; 0 1 0 0; 0 0 0 1]",
        "y": "[0 0 1 0; 0 1 0 0; -1 0 0 0; 0 0 0 1]",
        "z": "[0 -1 0 0; 1 0 0 0; 0 0 1 0; 0 0 0 1]",
    }
    return Function(
        (turn(),),
        f"a rotation about the {name} axis, by the right-hand rule",
        f"a rotation about {name}, in degrees",
        f"R{name}(θ)",
        f"rotate_{name}(90)",
        quarter[name],
        compute,
    )


FUNCTIONS: dict[str, Function] = {
    **{f"rotate_{axis.lower()}": _rotate(axis) for axis in AXES},
    "axis_angle": Function(
        (vector("axis"), turn()),
        "a rotation about any axis, by the right-hand rule",
        "what is along the axis stays, the rest turns",
        "R = cos θ I + (1 − cos θ) a aᵀ + sin θ [a]×",
        "axis_angle([1, 1, 1], 120)",
        "[0 0 1 0; 1 0 0 0; 0 1 0 0; 0 0 0 1]",
        _axis_angle,
    ),
    "quaternion": Function(
        (vector("q"),),
        "the rotation of a quaternion x, y, z, w, of any length",
        "v is turned to q v q⁻¹",
        "q = (sin(θ/2) a, cos(θ/2))",
        "quaternion(0, 0, 1, 1)",
        "rotate_z(90)",
        _quaternion,
        gathers=FOUR,
    ),
    "quaternion_of": Function(
        (matrix("M"),),
        "the unit quaternion x, y, z, w of the rotation in a matrix, with w ≥ 0",
        "4 w² is 1 + the trace, and differences of entries give the rest",
        "q = (sin(θ/2) a, cos(θ/2))",
        "quaternion_of(rotate_z(90))",
        "[0, 0, √2/2, √2/2]",
        _quaternion_of,
    ),
    "euler": Function(
        (matrix("M"), replace(ORDER, default="XYZ")),
        "the three angles about x, y and z, in degrees, of the rotation in a matrix; the order is "
        "that of the product",
        "entries of the product of three rotations, read backwards",
        "XYZ: R = Rx Ry Rz, ZYX: R = Rz Ry Rx",
        'euler(rotate_z(30) @ rotate_x(45), "ZYX")',
        "[45, 0, 30]",
        _euler,
        remarks=_euler_remarks,
    ),
}
