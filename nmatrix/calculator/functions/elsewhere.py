"""What other programs call the functions, and what is written here instead.

A student's first try is the word of MATLAB, NumPy, Mathematica or GLSL: the refusal of it is the
place to say the word of the calculator.
"""

from __future__ import annotations

from nmatrix.calculator.functions import FUNCTIONS
from nmatrix.errors import did_you_mean

_BRACKETS = "write its numbers, [1 0; 0 1]"
_NOT_EXACT = "numbers are fractions, roots and multiples of pi, and there is no such function"
_SHOWN = "a value is shown by its name alone in a line"
INSTEAD: dict[str, str] = {
    **dict.fromkeys(("inv", "minverse", "matrixinverse"), "write inverse(A), or A^-1"),
    **dict.fromkeys(("eye", "identitymatrix", "mat_identity"), "write identity(4)"),
    **dict.fromkeys(("zeros", "ones", "diag", "matrix", "array"), _BRACKETS),
    **dict.fromkeys(("determinant",), "write det(A)"),
    **dict.fromkeys(("eig", "eigvals", "eigenvals", "eigh"), "write eigenvalues(A)"),
    **dict.fromkeys(("svd", "svdvals", "cond"), "write singular_values(A)"),
    **dict.fromkeys(("null", "kernel", "nullspace", "ker"), "write null_space(A)"),
    **dict.fromkeys(("rowreduce", "echelon", "gauss"), "write rref(A)"),
    **dict.fromkeys(("linsolve", "linearsolve", "mldivide", "lstsq"), "write solve(A, b)"),
    **dict.fromkeys(("tr",), "write trace(A)"),
    **dict.fromkeys(("adj", "adjoint"), "write adjugate(A)"),
    **dict.fromkeys(("cof", "minors", "cofactors"), "write cofactor(A)"),
    **dict.fromkeys(("len", "mag", "magnitude"), "write length(v)"),
    **dict.fromkeys(("unit", "normalise", "normalized"), "write normalize(v)"),
    **dict.fromkeys(("distance", "dist"), "write length(b - a)"),
    **dict.fromkeys(("inner", "vdot", "scalar"), "write dot(a, b)"),
    **dict.fromkeys(("matmul", "mtimes", "multiply", "mul"), "write A @ B"),
    **dict.fromkeys(("pow", "mpower", "matrix_power"), "write x^2 or A^2"),
    **dict.fromkeys(("mix",), "write lerp(a, b, t)"),
    **dict.fromkeys(("skew", "hat"), "write cross_matrix(a)"),
    **dict.fromkeys(("mat3", "sub3x3from4x4"), "write linear(M) for the 3×3 block of M"),
    **dict.fromkeys(("mat4", "mat2"), _BRACKETS),
    **dict.fromkeys(("vec2", "vec3"), "write its numbers, [x, y, z]"),
    **dict.fromkeys(("vec4",), "write point(v) for w = 1, vector(v) for w = 0"),
    **dict.fromkeys(("rotate", "rot", "rotation"), "write rotate_z(90), or axis_angle(axis, 90)"),
    **dict.fromkeys(("quat",), "write quaternion(x, y, z, w)"),
    **dict.fromkeys(("arcsin", "sin_inv"), "write asin(x)"),
    **dict.fromkeys(("arccos",), "write acos(x)"),
    **dict.fromkeys(("arctan",), "write atan(x)"),
    **dict.fromkeys(("arctan2",), "write atan2(y, x)"),
    **dict.fromkeys(("radians", "deg2rad", "degtorad"), "angles are degrees as they are"),
    **dict.fromkeys(("degrees", "rad2deg"), "write the unit behind the angle, 1.57rad"),
    **dict.fromkeys(("exp", "log", "ln", "log2", "log10", "sinh", "cosh", "tanh"), _NOT_EXACT),
    **dict.fromkeys(("mod", "floor", "ceil", "round", "sign", "cbrt", "sum"), _NOT_EXACT),
    **dict.fromkeys(("print", "disp", "display", "echo", "printf"), _SHOWN),
}  # fmt: skip


def instead_of(name: str) -> str:
    """Tell what to write for a function that does not exist.

    Examples
    --------
    >>> [instead_of(name) for name in ("Inv", "lookAt")]
    ['write inverse(A), or A^-1', 'did you mean look_at?']
    """
    return INSTEAD.get(name.casefold()) or did_you_mean(
        name, FUNCTIONS, "in a session, help functions lists them"
    )
