"""Functions that build worlds: translations, scales, shears, and all of them in one."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from nmatrix.calculator.functions.function import (
    THREE,
    ArgumentError,
    Function,
    Parameter,
    require_size,
    vector,
    word,
    zero_vector,
)
from nmatrix.calculator.functions.rotations import ORDER, about_axis, by_quaternion
from nmatrix.calculator.numbers import angle, is_zero
from nmatrix.calculator.values import Value, ValueKind
from nmatrix.enums import Convention
from nmatrix.linear import rational
from nmatrix.linear.affine import rotation, shear_matrix
from nmatrix.linear.rational import ONE, RationalMatrix, RationalVector

CONVENTIONS = {one.value.replace("-", "_"): one for one in Convention}
NOTHING = Value((Fraction(0),) * 3)
_ONE_OR_THREE = (ValueKind.SCALAR, ValueKind.VECTOR)


def _three(v: Value, what: str = "three numbers") -> RationalVector:
    require_size(v, 3, what)
    return v.vector


def _factors(v: Value) -> RationalVector:
    return (v.scalar,) * 3 if v.kind is ValueKind.SCALAR else _three(v)


def _translate(v: Value) -> Value:
    return Value(rational.affine_matrix(rational.identity(3), _three(v)))


def _scale(v: Value) -> Value:
    return Value(rational.affine_matrix(rational.diagonal(_factors(v))))


def _shear(v: Value) -> Value:
    return Value(rational.affine_matrix(shear_matrix(_three(v))))


def composed(
    turned: RationalMatrix, scale: RationalVector, shear: RationalVector, translate: RationalVector
) -> RationalMatrix:
    """Multiply T · R · diag(scale) · H(shear)."""
    block = rational.product(turned, rational.diagonal(scale), shear_matrix(shear))
    return rational.affine_matrix(block, translate)


def _world(translate: Value, rotate: Value | None, *others: Value | str | None) -> Value:
    scale, shear, quaternion, axis_angle, order, convention = others
    assert isinstance(scale, Value)  # they have defaults
    assert isinstance(shear, Value)
    given = [one for one in (rotate, quaternion, axis_angle) if one is not None]
    if len(given) > 1:
        why = "rotate, quaternion and axis_angle are each the whole rotation"
        raise ArgumentError(given[1], "two rotations", why, "keep one of them")
    if order and convention not in (None, Convention.STANDARD):
        raise ArgumentError(
            order, "order= with convention=", "the course fixes it", "leave one out"
        )
    beside = next((one for one in (order, convention) if one is not None), None)
    if beside is not None and rotate is None and given:
        why = "an order and a convention are for three angles"
        raise ArgumentError(beside, "a rotation as a whole", why, "leave one out")
    turned = _rotation(rotate, quaternion, axis_angle, str(order or "XYZ"), str(convention or ""))
    return Value(composed(turned, _factors(scale), _three(shear), _three(translate)))


def _rotation(
    rotate: Value | None,
    quaternion: Value | str | None,
    axis_angle: Value | str | None,
    order: str,
    convention: str,
) -> RationalMatrix:
    if isinstance(quaternion, Value):
        require_size(quaternion, 4, "a quaternion x, y, z, w")
        _require_direction(quaternion, quaternion.vector)
        return by_quaternion(quaternion.vector)
    if isinstance(axis_angle, Value):
        require_size(axis_angle, 4, "an axis and its angle, x, y, z, angle")
        *axis, turned = axis_angle.vector
        _require_direction(axis_angle, tuple(axis))
        return about_axis(tuple(axis), angle(turned))
    turns = list(map(angle, _three(rotate or NOTHING, "three angles")))
    named = CONVENTIONS.get(convention, Convention.STANDARD)
    return rotation(turns, order, named)


def _require_direction(given: Value, v: RationalVector) -> None:
    if is_zero(rational.dot(v, v)):
        raise zero_vector(given, "a rotation about no axis")


def _builder(
    names: tuple[str, str, str], does: str, rule: str, formula: str, compute: Callable[..., Value]
) -> Function:
    name, example, result = names
    parameter = Parameter("v", _ONE_OR_THREE) if name == "scale" else vector()
    return Function(
        (parameter,), does, rule, formula, f"{name}{example}", result, compute, gathers=THREE
    )


FUNCTIONS: dict[str, Function] = {
    "translate": _builder(
        ("translate", "(1, 2, 3)", "[1 0 0 1; 0 1 0 2; 0 0 1 3; 0 0 0 1]"),
        "a translation",
        "a translation: the offset is the last column",
        "[I t; 0 1]",
        _translate,
    ),
    "scale": _builder(
        ("scale", "(1, 2, 1)", "[1 0 0 0; 0 2 0 0; 0 0 1 0; 0 0 0 1]"),
        "a scale along the axes, by three factors or by one",
        "a scale: the factors are the diagonal",
        "diag(x, y, z, 1)",
        _scale,
    ),
    "shear": _builder(
        ("shear", "(1, 2, 3)", "[1 1 2 0; 0 1 3 0; 0 0 1 0; 0 0 0 1]"),
        "a shear: x along y by xy and along z by xz, y along z by yz",
        "a shear xy, xz, yz",
        "x′ = x + xy·y + xz·z, y′ = y + yz·z",
        _shear,
    ),
    "world": Function(
        (
            vector("translate", NOTHING),
            Parameter(
                "rotate",
                (ValueKind.VECTOR,),
                is_optional=True,
                words="three angles about x, y and z, in degrees",
                is_angle=True,
            ),
            Parameter("scale", _ONE_OR_THREE, Value(ONE)),
            vector("shear", NOTHING),
            Parameter(
                "quaternion", (ValueKind.VECTOR,), is_optional=True, words="a vector x, y, z, w"
            ),
            Parameter(
                "axis_angle",
                (ValueKind.VECTOR,),
                is_optional=True,
                words="a vector x, y, z, angle",
            ),
            ORDER,
            word("convention", *CONVENTIONS),
        ),
        "the matrix of an object's place: moved, turned by three angles in degrees, a quaternion "
        "or an axis with its angle, scaled and sheared",
        "T · R · S · H: the shear comes first, the translation last",
        "M = T · R · diag(scale) · H(shear)",
        "world(translate=[1, 2, 3], rotate=[0, 90, 0], scale=2)",
        "[0 0 2 1; 0 2 0 2; -2 0 0 3; 0 0 0 1]",
        _world,
    ),
}
