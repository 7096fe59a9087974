"""The names that an expression may use: M, V and P of a setup, and those that the user adds."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

from nmatrix.calculator.functions import FUNCTIONS
from nmatrix.calculator.meanings import SCENE
from nmatrix.calculator.numbers import angle
from nmatrix.calculator.values import Value
from nmatrix.errors import IllegalValueError, quantity
from nmatrix.linear.rational import RationalMatrix
from nmatrix.scene.setup import Setup
from nmatrix.scene.world import World


def names_of(setup: Setup, expression: str, typed: World | None = None) -> dict[str, Value]:
    """Name M, V and P, the last two only where the expression may ask for them.

    `typed` is the world with its numbers as they were typed, where those are not the floats of the
    setup. M is built of its numbers and angles as the functions of the calculator are; V and P are
    the floats that their commands show.
    """
    world = typed or setup.world
    names = {"M": Value(world.exact_by(lambda degrees: angle(Fraction(degrees))), SCENE["M"])}
    if "V" in expression:
        names["V"] = Value(setup.camera.camera_from_world, SCENE["V"])
    if "P" in expression:
        names["P"] = Value(setup.lens.clip_from_camera, SCENE["P"])
    return names


def with_name(names: Mapping[str, Value], name: str, rows: RationalMatrix) -> dict[str, Value]:
    """Add a name for a number, a vector (one row) or a matrix.

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
    if name in FUNCTIONS or name in SCENE or name in names:
        raise IllegalValueError(
            f"{quantity('let')} {name}", "the name is taken", "choose another one"
        )
    if len(rows) == 1:
        return {**names, name: Value(rows[0][0] if len(rows[0]) == 1 else rows[0])}
    return {**names, name: Value(rows)}
