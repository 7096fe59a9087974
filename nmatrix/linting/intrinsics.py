"""The functions of the shading languages: what they make of values, and where they are judged."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Protocol

from nmatrix.linting import tree
from nmatrix.linting.algebra import made_matrix, made_vector
from nmatrix.linting.judging import Judge
from nmatrix.linting.tree import Expression
from nmatrix.linting.values import (
    ANYTHING,
    Because,
    Carried,
    Matrix,
    Scalar,
    Value,
    Vector,
    joined,
)


class Evaluating(Protocol):
    """What a function asks of the evaluation that calls it."""

    judge: Judge

    def is_given(self, expression: Expression) -> bool:
        """Whether a value is the same for all vertices or fragments."""


Intrinsic = Callable[[Evaluating, tree.Call, list[Value]], Value]


def _first_vector(arguments: list[Value]) -> Vector | None:
    return arguments[0] if arguments and isinstance(arguments[0], Vector) else None


def _two(arguments: list[Value]) -> tuple[Vector, Vector] | None:
    if len(arguments) >= 2:
        one, other = arguments[0], arguments[1]
        if isinstance(one, Vector) and isinstance(other, Vector):
            return one, other
    return None


def _normalize(self: Evaluating, call: tree.Call, arguments: list[Value]) -> Value:
    one = _first_vector(arguments)
    return ANYTHING if one is None else self.judge.normalised(call, one)


def _dot(self: Evaluating, call: tree.Call, arguments: list[Value]) -> Value:
    pair = _two(arguments)
    return Scalar() if pair is None else self.judge.dotted(call, *pair)


def _distance(self: Evaluating, call: tree.Call, arguments: list[Value]) -> Value:
    pair = _two(arguments)
    if pair is not None:
        self.judge.meet(call, *pair)
    return Scalar(is_clamped=True)


def _cross(self: Evaluating, call: tree.Call, arguments: list[Value]) -> Value:
    pair = _two(arguments)
    return Vector(size=3) if pair is None else self.judge.crossed(call, *pair)


def _reflect(self: Evaluating, call: tree.Call, arguments: list[Value]) -> Value:
    pair = _two(arguments)
    return Vector(size=3) if pair is None else self.judge.reflected(call, *pair)


def _refract(self: Evaluating, call: tree.Call, arguments: list[Value]) -> Value:
    pair = _two(arguments)
    if pair is None:
        return Vector(size=3)
    self.judge.meet(call, *pair)
    return Vector(Carried.DIRECTION, pair[0].space or pair[1].space, 3)


def _faceforward(self: Evaluating, call: tree.Call, arguments: list[Value]) -> Value:
    return arguments[0] if arguments else ANYTHING


def _pow(self: Evaluating, call: tree.Call, arguments: list[Value]) -> Value:
    return self.judge.powered(call, arguments[0]) if arguments else ANYTHING


def _transpose(self: Evaluating, call: tree.Call, arguments: list[Value]) -> Value:
    if arguments and isinstance(arguments[0], Matrix):
        return replace(arguments[0].transposed, because=Because.ARITHMETIC)
    return ANYTHING


def _inverse(self: Evaluating, call: tree.Call, arguments: list[Value]) -> Value:
    if not arguments or not isinstance(arguments[0], Matrix):
        return ANYTHING
    is_given = self.is_given(call.arguments[0])
    return self.judge.inverted(call, arguments[0], is_given=is_given)


def _origin(arguments: list[Value]) -> str:
    numbers = (one for one in arguments if isinstance(one, Scalar))
    return next((one.origin for one in numbers if one.origin), "")


def _clamped(self: Evaluating, call: tree.Call, arguments: list[Value]) -> Value:
    if arguments and all(isinstance(one, Scalar) for one in arguments):
        is_cosine = any(isinstance(one, Scalar) and one.is_cosine for one in arguments)
        return Scalar(is_cosine, is_clamped=True, origin=_origin(arguments))
    return Vector(size=_size(arguments))


def _smaller(self: Evaluating, call: tree.Call, arguments: list[Value]) -> Value:
    if arguments and all(isinstance(one, Scalar) for one in arguments):
        numbers = [one for one in arguments if isinstance(one, Scalar)]
        is_cosine = any(one.is_cosine for one in numbers)
        is_clamped = all(one.is_clamped for one in numbers)
        return Scalar(is_cosine, is_clamped, origin=_origin(arguments))
    return Vector(size=_size(arguments))


def _mixed(self: Evaluating, call: tree.Call, arguments: list[Value]) -> Value:
    return joined(arguments[0], arguments[1]) if len(arguments) == 3 else ANYTHING


def _number(self: Evaluating, call: tree.Call, arguments: list[Value]) -> Value:
    return Scalar(is_clamped=True) if _size(arguments) == 0 else Vector(size=_size(arguments))


def _texture(self: Evaluating, call: tree.Call, arguments: list[Value]) -> Value:
    if len(arguments) > 1 and isinstance(arguments[1], Vector) and arguments[1].size < 4:
        self.judge.undivided(call, arguments[1], call.arguments[1])
    return Vector(size=4)


def _size(arguments: list[Value]) -> int:
    return max((one.size for one in arguments if isinstance(one, Vector)), default=0)


def _vector(size: int) -> Intrinsic:
    return lambda _, call, arguments: made_vector(size, arguments)


def _matrix(size: int) -> Intrinsic:
    return lambda _, call, arguments: made_matrix(size, arguments)


def _float(self: Evaluating, call: tree.Call, arguments: list[Value]) -> Value:
    return arguments[0] if arguments and isinstance(arguments[0], Scalar) else Scalar()


INTRINSICS: dict[str, Intrinsic] = {
    **{f"vec{size}": _vector(size) for size in (2, 3, 4)},
    **{f"mat{size}": _matrix(size) for size in (2, 3, 4)},
    "float": _float,
    "normalize": _normalize,
    "dot": _dot,
    "distance": _distance,
    "cross": _cross,
    "reflect": _reflect,
    "refract": _refract,
    "faceforward": _faceforward,
    "pow": _pow,
    "transpose": _transpose,
    "inverse": _inverse,
    "max": _clamped,
    "clamp": _clamped,
    "saturate": _clamped,
    "abs": _clamped,
    "min": _smaller,
    "mix": _mixed,
    "length": _number,
    "texture": _texture,
    "texture2D": _texture,
    "textureCube": _texture,
    "texture2DLod": _texture,
    "tex2D": _texture,
    "tex2Dlod": _texture,
    "texCUBE": _texture,
}
