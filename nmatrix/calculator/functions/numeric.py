"""Functions of numbers: roots, sines and angles in degrees, sizes, the least and the largest."""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction

from nmatrix.calculator.arithmetic.numbers import (
    Float64,
    Interval,
    Number,
    angle,
    bounds,
    degrees_of,
    enclosed,
    exact_degrees,
    is_negative,
    is_zero,
    may_be_positive,
    root,
)
from nmatrix.calculator.arithmetic.values import Value
from nmatrix.calculator.functions.function import (
    Function,
    NoAnswerForArgumentError,
    scalar,
    turn,
    vector,
)

MOST_NUMBERS = 64  # of which the least is taken


def _sqrt(x: Value) -> Value:
    if is_negative(x.scalar):
        why = "no real number squared is negative"
        raise NoAnswerForArgumentError(x, "the root of a negative number", why, "use another")
    return Value(root(x.scalar))


def _tangent(x: Value) -> Value:
    turned = angle(x.scalar)
    if is_zero(turned.cosine):
        why = "there the cosine is 0 and the tangent has no value"
        raise NoAnswerForArgumentError(x, "the tangent of a quarter turn", why, "use another angle")
    return Value(turned.sine / turned.cosine)


def _leg(x: Value, name: str) -> Number:
    """Compute the square of the other leg, 1 − x², of a right triangle with the hypotenuse 1."""
    square = 1 - x.scalar * x.scalar
    if not may_be_positive(square):
        why = f"no {name} is above 1 or below -1"
        raise NoAnswerForArgumentError(x, f"a {name} beyond 1", why, "use one within")
    return square


def _asin(x: Value) -> Value:
    square = _leg(x, "sine")
    if isinstance(x.scalar, Float64):
        return Value(Float64(math.degrees(math.asin(x.scalar.value))))
    sharp = exact_degrees(x.scalar * x.scalar, square)
    if sharp is not None:
        return Value(-sharp if x.scalar < 0 else sharp)
    return Value(degrees_of(x.scalar, root(square)))


def _acos(x: Value) -> Value:
    square = _leg(x, "cosine")
    if isinstance(x.scalar, Float64):
        return Value(Float64(math.degrees(math.acos(x.scalar.value))))
    sharp = exact_degrees(square, x.scalar * x.scalar)
    if sharp is not None:
        return Value(180 - sharp if x.scalar < 0 else sharp)
    return Value(degrees_of(root(square), x.scalar))


def _atan2(y: Value, x: Value) -> Value:
    if is_zero_exactly(y.scalar) and is_zero_exactly(x.scalar):
        what, why = "the angle of (0, 0)", "it is no direction"
        raise NoAnswerForArgumentError(y, what, why, "use another point")
    return Value(degrees_of(y.scalar, x.scalar))


def is_zero_exactly(x: Number) -> bool:
    """Tell whether a number is known to be 0."""
    return not isinstance(x, Interval) and is_zero(x)


def _extreme(choose: Callable[..., Number]) -> Callable[[Value], Value]:
    def compute(v: Value) -> Value:
        found = v.vector[0]
        for x in v.vector[1:]:
            if isinstance(found, Interval) or isinstance(x, Interval):
                (a, b), (c, d) = bounds(found), bounds(x)
                found = enclosed(choose(a, c), choose(b, d))
            else:
                found = choose(found, x)  # type: ignore[assignment]  # one of the two
        return Value(found)

    return compute


FUNCTIONS: dict[str, Function] = {
    "sqrt": Function(
        (scalar(),),
        "the square root",
        "what squared gives it",
        "√x · √x = x",
        "sqrt(12)",
        "2√3",
        _sqrt,
    ),
    "sin": Function(
        (turn(),),
        "the sine of an angle in degrees",
        "the height on the unit circle",
        "sin θ",
        "sin(60)",
        "√3/2",
        lambda x: Value(angle(x.scalar).sine),
    ),
    "cos": Function(
        (turn(),),
        "the cosine of an angle in degrees",
        "the way to the right on the unit circle",
        "cos θ",
        "cos(60)",
        "1/2",
        lambda x: Value(angle(x.scalar).cosine),
    ),
    "tan": Function(
        (turn(),),
        "the tangent of an angle in degrees",
        "the sine over the cosine",
        "tan θ = sin θ / cos θ",
        "tan(60)",
        "√3",
        _tangent,
    ),
    "asin": Function(
        (scalar(),),
        "the angle from −90° to 90° with this sine, in degrees",
        "the angle whose sine it is",
        "sin(asin x) = x",
        "asin(1/2)",
        "30",
        _asin,
    ),
    "acos": Function(
        (scalar(),),
        "the angle from 0° to 180° with this cosine, in degrees",
        "the angle whose cosine it is",
        "cos(acos x) = x",
        "acos(-1/2)",
        "120",
        _acos,
    ),
    "atan": Function(
        (scalar(),),
        "the angle between −90° and 90° with this tangent, in degrees",
        "the angle whose tangent it is",
        "tan(atan x) = x",
        "atan(√3)",
        "60",
        lambda x: Value(degrees_of(x.scalar, Fraction(1))),
    ),
    "atan2": Function(
        (scalar("y"), scalar("x")),
        "the angle of the direction (x, y), from −180° to 180°, in degrees",
        "counter-clockwise from the x axis",
        "tan θ = y / x, in the quadrant of (x, y)",
        "atan2(1, -1)",
        "135",
        _atan2,
    ),
    "abs": Function(
        (scalar(),),
        "the size of a number, without its sign",
        "−x where x is negative",
        "|x|",
        "abs(-3/2)",
        "3/2",
        lambda x: Value(abs(x.scalar)),
    ),
    "min": Function(
        (vector(),),
        "the smallest of some numbers",
        "the smallest",
        "min(a, b) ≤ a, b",
        "min(2, √3, 7/4)",
        "√3",
        _extreme(min),
        gathers=range(1, MOST_NUMBERS + 1),
    ),
    "max": Function(
        (vector(),),
        "the largest of some numbers",
        "the largest",
        "max(a, b) ≥ a, b",
        "max(2, √3, 7/4)",
        "2",
        _extreme(max),
        gathers=range(1, MOST_NUMBERS + 1),
    ),
}
