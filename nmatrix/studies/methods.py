"""Every way to carry a normal through a map that is in use: ours, and the ones to compare with.

A method takes matrices (N, 3, 3) and normals (N, 3) and returns unit normals (N, 3). Where it has
no answer it returns what such programs return: zeros or NaN. Each method that is not ours fails
somewhere; the hard cases show where.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from importlib.util import find_spec
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

from nmatrix.enums import Level
from nmatrix.linear.batched import transform_normals

Array = NDArray[Any]
Carry = Callable[[Array, Array], Array]


@dataclass(frozen=True)
class Method:
    """One way to carry normals: its name in tables, a phrase about it, and the function itself.

    `multiplications` are those of its formula, divisions included, for one normal through a map of
    its own and before it is normalised; one of longer numbers counts as the products of its 64-bit
    words, and LAPACK's are those of the textbooks. `is_ours` marks those of which nmatrix promises
    the right answer on every input. The guarded one is nmatrix's too and promises less: 2⁻³⁶ rad.
    Those that are not batched work on one matrix after the other, and take long. Everybody knows
    the everyday ones, or will use them.
    """

    name: str
    title: str
    carry: Carry
    multiplications: int
    is_ours: bool = False
    is_batched: bool = True
    is_everyday: bool = False

    def normals(self, A: Array, n: Array) -> Array:
        """Carry normals (N, 3) through matrices (N, 3, 3), without NumPy's warnings."""
        with np.errstate(all="ignore"):
            return self.carry(A, n)


def _ours(level: Level) -> Carry:
    """Return nmatrix's own way at one level."""

    def carry(A: Array, n: Array) -> Array:
        found = np.empty(n.shape)
        for part, normals in transform_normals(A, n, level):
            found[part] = normals.directions.T
        return found

    return carry


def inverse(A: Array, n: Array) -> Array:
    """Use `np.linalg.inv(A).T @ n`; a matrix that raises has no answer."""
    return _unit(_times(each_or_nan(np.linalg.inv, A).transpose(0, 2, 1), n))


def solve(A: Array, n: Array) -> Array:
    """Use `np.linalg.solve(A.T, n)`."""
    found = np.full(n.shape, np.nan)
    for i in range(len(A)):
        try:
            found[i] = np.linalg.solve(A[i].T, n[i])
        except np.linalg.LinAlgError:
            continue
    return _unit(found)


def by_qr(A: Array, n: Array) -> Array:
    """Substitute back through A = Q R: A⁻ᵀ n = Q R⁻ᵀ n."""
    Q, R = np.linalg.qr(A)
    return _unit(_times(Q, solve(R, n)))


def by_svd(A: Array, n: Array) -> Array:
    """Use singular values: A⁻ᵀ n = U Σ⁻¹ Vᵀ n."""
    U, size, V = np.linalg.svd(A)
    return _unit(_times(U, _times(V, n) / size))


def inverse_4x4(A: Array, n: Array) -> Array:
    """Use the inverse transpose of the 4×4 matrix with a translation, w = 0."""
    affine = np.zeros((len(A), 4, 4))
    affine[:, :3, :3], affine[:, 3, 3] = A, 1.0
    affine[:, :3, 3] = np.abs(A).max(axis=(1, 2))[:, None]
    return _unit(_times(each_or_nan(np.linalg.inv, affine)[:, :3, :3].transpose(0, 2, 1), n))


def plain_cofactor(A: Array, n: Array) -> Array:
    """Use cross products of the rows, with no sign: a mirror turns normals inwards."""
    return _unit(_times(_cofactors(A), n))


def signed_cofactor(A: Array, n: Array) -> Array:
    """Use the cofactors times the sign of `np.linalg.det`."""
    sign = np.sign(np.linalg.det(A))
    return _unit(_times(_cofactors(A), n) * sign[:, None])


def zero_matrix(A: Array, n: Array) -> Array:
    """Divide cofactors by the determinant; one of 0 makes a matrix of zeros, as in engines."""
    C = _cofactors(A)
    determinant = (A[:, 0] * C[:, 0]).sum(axis=1)[:, None]
    return _unit(np.where(determinant == 0, 0.0, _times(C, n) / determinant))


def identity_matrix(A: Array, n: Array) -> Array:
    """Use the inverse transpose; where that raises, the identity."""
    found = inverse(A, n)
    return np.where(np.isfinite(found).all(axis=1, keepdims=True), found, _unit(n))


def determinant_test(A: Array, n: Array) -> Array:
    """Use A itself where the determinant is 1, "since it only rotates"; else the inverse."""
    rotates = np.asarray(np.abs(np.linalg.det(A) - 1) < 1e-6).reshape(-1, 1)
    return np.where(rotates, matrix_itself(A, n), inverse(A, n))


def matrix_itself(A: Array, n: Array) -> Array:
    """Use A n, the common mistake."""
    return _unit(_times(A, n))


def oriented_cofactor(A: Array, n: Array) -> Array:
    """Use the cofactors times the sign of their determinant, all in the type of the numbers."""
    C = _cofactors(A)
    determinant = (A[:, 0] * C[:, 0]).sum(axis=1)[:, None]
    carried = (C * n[:, None]).sum(axis=2)  # numpy-quaddtype 1.0 has no products of stacks
    return _unit(np.where(determinant < 0, -carried, carried))


def in_precision(dtype: DTypeLike, carry: Carry) -> Carry:
    """Make a method that works in another type of floats, to which its inputs are rounded first."""
    return lambda A, n: carry(A.astype(dtype), n.astype(dtype)).astype(np.float64)


def in_quad_precision(A: Array, n: Array) -> Array:
    """Use cofactors in floats of 113 bits, by numpy-quaddtype."""
    from numpy_quaddtype import QuadPrecDType

    return in_precision(QuadPrecDType(), oriented_cofactor)(A, n)


def in_balls(A: Array, n: Array) -> Array:
    """Solve Aᵀx = n in FLINT's balls, which hold the true x; no answer where A may be singular."""
    import flint

    found = np.full(n.shape, np.nan)
    with flint.ctx.workprec(BALL_BITS):
        for i, (matrix, normal) in enumerate(zip(A.tolist(), n.tolist(), strict=True)):
            try:
                transposed = flint.arb_mat(matrix).transpose()
                x = transposed.solve(flint.arb_mat([[entry] for entry in normal])).entries()
            except (ValueError, ZeroDivisionError):
                continue
            largest = max((abs(component) for component in x), key=lambda size: size.mid())
            if largest > 0:
                found[i] = [float((component / largest).mid()) for component in x]
    return _unit(found)


BALL_BITS = 200

METHODS: tuple[Method, ...] = (
    Method(
        "exact",
        "whole numbers, correctly rounded",
        _ours(Level.EXACT),
        42,
        is_ours=True,
        is_batched=False,
    ),
    Method(
        "certified",
        "cofactors with an error bound",
        _ours(Level.CERTIFIED),
        130,
        is_ours=True,
        is_everyday=True,
    ),
    Method("guarded", "plain cofactors under a guard", _ours(Level.GUARDED), 39, is_everyday=True),
    Method("inverse", "np.linalg.inv(A).T", inverse, 44, is_everyday=True),
    Method("solve", "np.linalg.solve(A.T, n)", solve, 17, is_batched=False),
    Method("qr", "QR and back substitution", by_qr, 62, is_batched=False),
    Method("svd", "singular values", by_svd, 305, is_everyday=True),
    Method("inverse-4x4", "inverse transpose of the 4×4", inverse_4x4, 93),
    Method("cofactor", "plain cofactors, no sign", plain_cofactor, 27, is_everyday=True),
    Method("signed-cofactor", "plain cofactors, sign of np.linalg.det", signed_cofactor, 38),
    Method("zero-matrix", "C/det, zeros where det is 0", zero_matrix, 33),
    Method("identity", "inverse, identity where it raises", identity_matrix, 44),
    Method("determinant-test", "A itself where det is 1", determinant_test, 64),
    Method("matrix", "A itself", matrix_itself, 9, is_everyday=True),
    Method(
        "float32-inverse",
        "the inverse in float32",
        in_precision(np.float32, inverse),
        44,
        is_everyday=True,
    ),
    Method(
        "float32-cofactor", "cofactors in float32", in_precision(np.float32, signed_cofactor), 38
    ),
    Method(
        "float16-cofactor",
        "cofactors in float16",
        in_precision(np.float16, plain_cofactor),
        27,
        is_everyday=True,
    ),
)
# Contestants of other packages, where these are installed.
VISITORS = {
    "numpy_quaddtype": Method(
        "quad-cofactor", "cofactors in floats of 113 bits", in_quad_precision, 120
    ),
    "flint": Method(
        "flint-balls",
        f"arb_mat.solve in balls of {BALL_BITS} bits",
        in_balls,
        272,
        is_batched=False,
    ),
}
METHODS += tuple(one for package, one in VISITORS.items() if find_spec(package))


def method(name: str) -> Method:
    """Return a method by its name.

    Examples
    --------
    >>> tall, slanted = np.diag([1.0, 2, 1])[None], np.array([[1.0, 1, 0]])
    >>> method("matrix").normals(tall, slanted).round(3).tolist()
    [[0.447, 0.894, 0.0]]
    >>> method("exact").normals(tall, slanted).round(3).tolist()
    [[0.894, 0.447, 0.0]]
    """
    return next(one for one in METHODS if one.name == name)


def _cofactors(A: Array) -> Array:
    rows = [np.cross(A[:, (i + 1) % 3], A[:, (i + 2) % 3]) for i in range(3)]
    return np.stack(rows, axis=1)


def _times(matrices: Array, vectors: Array) -> Array:
    return np.asarray((matrices @ vectors[:, :, None])[:, :, 0])


def _unit(vectors: Array) -> Array:
    """Return vectors at length one, zero where they are zero; normalising is no method's fault."""
    largest = np.abs(vectors).max(axis=1, keepdims=True)
    scaled = vectors / np.where(largest == 0, 1, largest)
    long = np.sqrt((scaled * scaled).sum(axis=1, keepdims=True))
    return np.asarray(scaled / np.where(long == 0, 1, long))


def each_or_nan(function: Callable[[Array], Array], A: Array) -> Array:
    """Apply a function to matrices (N, 3, 3) or (N, 4, 4); those for which it raises become NaN."""
    try:
        return function(A)
    except np.linalg.LinAlgError:
        found = np.full(A.shape, np.nan, A.dtype)
    for i in range(len(A)):
        try:
            found[i] = function(A[i])
        except np.linalg.LinAlgError:
            continue
    return found
