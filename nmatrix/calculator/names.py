"""The names that have values: M, V and P of a setup, and those that the user adds."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

from nmatrix.calculator.evaluate import CONSTANTS
from nmatrix.calculator.functions import FUNCTIONS
from nmatrix.calculator.numbers import angle
from nmatrix.calculator.statements import Keyword
from nmatrix.calculator.values import Value
from nmatrix.errors import IllegalValueError, quantity
from nmatrix.linear.rational import RationalMatrix
from nmatrix.scene.setup import Setup
from nmatrix.scene.world import World

SCENE_NAMES = ("M", "V", "P")
EVERY_NAME = " ".join(SCENE_NAMES)  # the text of those who may ask for all of them
ANSWERS = ("ans", "ans2")  # the last value of an expression, and the one before


def names_of(setup: Setup, expression: str, typed: World | None = None) -> dict[str, Value]:
    """Name M, V and P, the last two only where the expression may ask for them.

    `typed` is the world with its numbers as they were typed, where those are not the floats of the
    setup. M is built of its numbers and angles as the functions of the calculator are; V and P are
    the floats that their commands show.
    """
    world = typed or setup.world
    names = {"M": Value(world.exact_by(lambda degrees: angle(Fraction(degrees))))}
    if "V" in expression:
        names["V"] = Value(setup.camera.camera_from_world)
    if "P" in expression:
        names["P"] = Value(setup.lens.clip_from_camera)
    return names


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
    return next((told for told, names in others.items() if name in names), "")
