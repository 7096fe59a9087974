"""The names that have values: M, V and P of a setup, and those that the user adds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from fractions import Fraction

from nmatrix.calculator.evaluate import CONSTANTS
from nmatrix.calculator.functions import FUNCTIONS
from nmatrix.calculator.functions.camera import lens_value, looking_at
from nmatrix.calculator.functions.rotations import about_axis, by_quaternion
from nmatrix.calculator.meanings import SCENE
from nmatrix.calculator.numbers import angle
from nmatrix.calculator.statements import Keyword
from nmatrix.calculator.values import Value
from nmatrix.errors import IllegalValueError, quantity
from nmatrix.linear.affine import compose, rotation_by
from nmatrix.linear.angle import Angle
from nmatrix.linear.rational import RationalMatrix, RationalVector
from nmatrix.linear.view import first_person
from nmatrix.report import Number
from nmatrix.scene.camera import View
from nmatrix.scene.setup import Setup
from nmatrix.scene.world import World

SCENE_NAMES = tuple(SCENE)
EVERY_NAME = " ".join(SCENE_NAMES)  # the text of those who may ask for all of them
LONGEST_NAME = 40
ANSWERS = ("ans", "ans2")  # the last value of an expression, and the one before
THROUGH_THE_LENS = ("P", "depth_of", "distance_of")
SHORT = 15  # digits of a decimal that a float64 tells from every other one
LARGEST_BOTTOM = 10**4  # of a ratio that a longer decimal is read as: 16/9, 1/3


def names_of(setup: Setup, expression: str, typed: World | None = None) -> dict[str, Value]:
    """Name M, V and P, the last two only where the expression may ask for them.

    `typed` is the world with its numbers as they were typed, where those are not the floats of the
    setup. All three are exact: every number is the one that was typed, and roots and sines are
    those of the functions of the calculator.
    """
    names = {"M": Value(_world(typed or setup.world), SCENE["M"])}
    if "V" in expression:
        names["V"] = Value(_view(setup.view), SCENE["V"])
    if any(word in expression for word in THROUGH_THE_LENS):
        lens = setup.lens
        P = lens_value(lens.exact_by(_turn, as_typed), lens.clip)
        names["P"] = replace(P, meaning=SCENE["P"])
    return names


def as_typed(number: Number) -> Fraction:
    """Take a float as the decimal that a person types for it, or as the short ratio that it is.

    Examples
    --------
    >>> print(as_typed(0.1), as_typed(16 / 9), as_typed(Fraction(1, 3)), as_typed(2))
    1/10 16/9 1/3 2
    """
    if not isinstance(number, float):
        return Fraction(number)
    decimal = Fraction(repr(number))
    if len(repr(number).lstrip("-0.").partition("e")[0].replace(".", "")) <= SHORT:
        return decimal
    ratio = decimal.limit_denominator(LARGEST_BOTTOM)
    return ratio if float(ratio) == number else decimal


def _all_typed(numbers: Sequence[Number]) -> RationalVector:
    return tuple(map(as_typed, numbers))


def _turn(degrees: Number) -> Angle:
    return angle(as_typed(degrees))


def _world(world: World) -> RationalMatrix:
    if world.matrix is not None:
        return world.matrix
    if world.quaternion is not None:
        turned = by_quaternion(_all_typed(world.quaternion))
    elif world.axis_angle is not None:
        *axis, turn = world.axis_angle
        turned = about_axis(_all_typed(axis), _turn(turn))
    else:
        turned = rotation_by(world.rotate_degrees, world.order, world.convention, _turn)
    return compose(turned, *map(_all_typed, (world.scale, world.shear, world.translate)))


def _view(view: View) -> RationalMatrix:
    if view.angles is not None:
        aim = view.angles
        elevation, sideways, roll = map(_turn, (aim.elevation, aim.angle, aim.roll))
        return first_person(_all_typed(view.eye), elevation, sideways, roll, view.convention)
    if not view.is_aimed:
        return view.placed().camera_from_world
    eye, target, up = (Value(_all_typed(one)) for one in (view.eye, view.target, view.up))
    return looking_at(eye, target, up, view.handed)


def with_name(names: Mapping[str, Value], name: str, rows: RationalMatrix) -> dict[str, Value]:
    """Add a name for a number, a vector or a matrix.

    Raises
    ------
    IllegalValueError
        For what is no name, or is taken.

    Examples
    --------
    >>> with_name({}, "a", ((Fraction(2),),))["a"].scalar
    Fraction(2, 1)
    """
    if not (name.isascii() and name.isidentifier()):
        raise IllegalValueError(
            f"{quantity('let')} ({name[:40]})",
            "it is NAME=MATRIX",
            f'try {quantity("let")} "A=1 0; 0 2"',
        )
    if name in SCENE_NAMES or name in names or other_meaning(name):
        why = other_meaning(name) or "the name is taken"
        raise IllegalValueError(f"{quantity('let')} {name}", why, "choose another one")
    return {**names, name: value_of(rows)}


def value_of(rows: RationalMatrix) -> Value:
    """Make a number, a vector (of one row or one column) or a matrix of rows.

    Examples
    --------
    >>> value_of(((Fraction(1),), (Fraction(2),))).shape
    'a vector of 2'
    """
    if len(rows[0]) == 1:
        rows = (tuple(row[0] for row in rows),)
    if len(rows) == 1:
        return Value(rows[0][0] if len(rows[0]) == 1 else rows[0])
    return Value(rows)


def other_meaning(name: str) -> str:
    """Tell what else a name means, so that no value may have it; empty if it is free.

    Examples
    --------
    >>> other_meaning("det"), other_meaning("M")
    ('it is a function', '')
    """
    others = {
        "it is a function": FUNCTIONS,
        "it begins a statement": list(Keyword),
        "it is a number": CONSTANTS,
        "it is the last value, or the one before": ANSWERS,
    }
    if len(name) > LONGEST_NAME:
        return f"it has {len(name)} letters, a name has {LONGEST_NAME} at the most"
    return next((told for told, names in others.items() if name in names), "")
