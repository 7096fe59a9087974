"""Functions that build maps: rotations, translations, scales, shears."""

from __future__ import annotations

from collections.abc import Callable

from nmatrix.calculator.functions.function import Function, require_size, turn, vector
from nmatrix.calculator.numbers import angle
from nmatrix.calculator.values import Value
from nmatrix.linear import affine, rational
from nmatrix.linear.rational import RationalMatrix, RationalVector


def _rotate(axis: str) -> Function:
    def compute(turned: Value) -> Value:
        return Value(rational.affine_matrix(affine.rotation_about(axis, angle(turned.scalar))))

    name = axis.lower()
    return Function(
        (turn(),),
        f"a rotation about the {name} axis, by the right-hand rule",
        f"a rotation about {name}, in degrees",
        f"R{name}(θ)",
        f"rotate_{name}(30)",
        compute,
    )


def _builder(
    name: str, does: str, formula: str, make: Callable[[RationalVector], RationalMatrix]
) -> Function:
    def compute(v: Value) -> Value:
        require_size(v, 3, "three numbers")
        return Value(make(v.vector))

    return Function((vector(),), does, does, formula, f"{name}(1, 2, 3)", compute, gathers=True)


FUNCTIONS: dict[str, Function] = {
    "rotate_x": _rotate("X"),
    "rotate_y": _rotate("Y"),
    "rotate_z": _rotate("Z"),
    "translate": _builder(
        "translate",
        "a translation",
        "[I t; 0 1]",
        lambda v: rational.affine_matrix(rational.identity(3), v),
    ),
    "scale": _builder(
        "scale",
        "a scale along the axes",
        "diag(x, y, z, 1)",
        lambda v: rational.affine_matrix(rational.diagonal(v)),
    ),
    "shear": _builder(
        "shear",
        "a shear xy, xz, yz",
        "x′ = x + xy·y + xz·z, y′ = y + yz·z",
        lambda v: rational.affine_matrix(affine.shear_matrix(v)),
    ),
}
