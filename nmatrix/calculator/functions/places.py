"""Functions that say what a vector is and where, or that nobody shall know it."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from nmatrix.calculator.arithmetic.values import Value, ValueKind
from nmatrix.calculator.functions.function import (
    Argument,
    Function,
    Parameter,
    require_size,
    vector,
)
from nmatrix.enums import Frame

ANYTHING = tuple(kind for kind in ValueKind if kind is not ValueKind.TRUTH)
SPACE = Parameter(
    "space", is_optional=True, words=f"a space ({', '.join(Frame)})", choices=tuple(Frame)
)


def _with_w(w: int) -> Callable[..., Value]:
    """Write w behind a literal; what knows its kind knows its w."""

    def compute(v: Value, space: Argument | None = None) -> Value:
        is_clip = space == Frame.CLIP
        if is_clip and len(v.vector) == 4:
            return v
        require_size(v, 3, "a vector of 3")
        if is_clip or (space is None and v.meaning is None):
            return Value((*v.vector, Fraction(w)))
        return Value(v.vector)

    return compute


def _three(v: Value, _space: Argument | None) -> Value:
    require_size(v, 3, "a vector of 3")
    return Value(v.vector)


FUNCTIONS: dict[str, Function] = {
    "point": Function(
        parameters=(vector(), SPACE),
        does="a point: of a space, or else with its w behind it",
        rule="w = 1: points move with the translation",
        formula="(x, y, z) → (x, y, z, 1)",
        example="point([1, 2, 3], object)",
        result="[1, 2, 3]",
        compute=_with_w(1),
    ),
    "direction": Function(
        parameters=(vector(), SPACE),
        does="a direction of a space, whose w is 0",
        rule="w = 0: directions do not move with the translation",
        formula="M (x, y, z, 0) = A (x, y, z)",
        example="direction([0, -1, 0], world)",
        result="[0, -1, 0]",
        compute=_three,
    ),
    "normal": Function(
        parameters=(vector("n"), SPACE),
        does="a normal of a space, which maps carry by their inverse transpose",
        rule="normals move by the inverse transpose",
        formula="n′ = A⁻ᵀ n",
        example="normal([0, 1, 0], object)",
        result="[0, 1, 0]",
        compute=_three,
    ),
    "vector": Function(
        parameters=(vector(),),
        does="a direction in homogeneous coordinates",
        rule="w = 0: vectors do not",
        formula="(x, y, z) → (x, y, z, 0)",
        example="vector([1, 2, 3])",
        result="[1, 2, 3, 0]",
        compute=_with_w(0),
    ),
    "untyped": Function(
        parameters=(Parameter("x", ANYTHING),),
        does="the numbers of a value, whose space and kind are forgotten",
        rule="only its numbers are kept",
        formula="x",
        example="untyped(direction([0, 0, 1], world))",
        result="[0, 0, 1]",
        compute=lambda x: Value(x.entries),
    ),
}
