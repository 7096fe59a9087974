"""Functions of numbers: roots, sines of degrees, sizes."""

from __future__ import annotations

from nmatrix.calculator.functions.function import Function, scalar, turn
from nmatrix.calculator.numbers import angle, is_negative, root
from nmatrix.calculator.values import Value
from nmatrix.errors import NoAnswerError


def _sqrt(x: Value) -> Value:
    if is_negative(x.scalar):
        raise NoAnswerError("the root of a negative number", "no real square is", "use another")
    return Value(root(x.scalar))


FUNCTIONS: dict[str, Function] = {
    "sqrt": Function(
        (scalar(),),
        "the square root",
        "what squared gives it",
        "√x √x = x",
        "sqrt(12)",
        _sqrt,
    ),
    "sin": Function(
        (turn(),),
        "the sine of an angle in degrees",
        "the height on the unit circle",
        "sin θ",
        "sin(60)",
        lambda x: Value(angle(x.scalar).sine),
    ),
    "cos": Function(
        (turn(),),
        "the cosine of an angle in degrees",
        "the way to the right on the unit circle",
        "cos θ",
        "cos(60)",
        lambda x: Value(angle(x.scalar).cosine),
    ),
}
