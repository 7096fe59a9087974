"""The Python face: functions on arrays and frozen values, over the exact core.

Arrays are row-major and hold column-vector matrices; angles are radians or an `Angle`. Every
matrix that comes back is the exact one rounded once. Batches run over the leading axes, one exact
computation each.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import inf
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from nmatrix.enums import (
    Api,
    ClipY,
    Convention,
    DepthRange,
    Frame,
    Handedness,
    Kind,
    NormalStatus,
    Space,
)
from nmatrix.errors import (
    FrameError,
    IllegalValueError,
    MissingPackageError,
    NMatrixError,
    NoAnswerError,
)
from nmatrix.linear import affine, projection, rational, view
from nmatrix.linear.angle import Angle, as_angle
from nmatrix.linear.classify import Classification
from nmatrix.linear.classify import classify as _classify
from nmatrix.linear.exact import LinearMap
from nmatrix.linear.projection import ClipSpace, Window
from nmatrix.linear.vectors import angle_between
from nmatrix.linear.vectors import normalize as _normalize

Array = NDArray[np.float64]
Turn = Angle | float

__all__ = [
    "Angle",
    "Api",
    "Classification",
    "ClipSpace",
    "ClipY",
    "Convention",
    "DepthRange",
    "Frame",
    "FrameError",
    "Handedness",
    "IllegalValueError",
    "Kind",
    "MissingPackageError",
    "NMatrixError",
    "NoAnswerError",
    "NormalStatus",
    "Space",
    "Window",
    "angle_between",
    "classify",
    "cofactor_matrix",
    "first_person",
    "frustum",
    "look_at",
    "normal_matrix",
    "normalize",
    "orthographic",
    "perspective",
    "rotation",
    "transform_normals",
    "world",
]


def rotation(turns: Sequence[Turn], order: str = "XYZ") -> Array:
    """Return the 3×3 rotation by three angles about x, y, z, in radians or as `Angle`.

    Examples
    --------
    >>> rotation((0, 0, Angle.degrees(90))).tolist()
    [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]
    """
    return np.array(rational.to_floats(affine.rotation(turns, order)))


def world(
    *,
    translate: Sequence[float] = (0, 0, 0),
    rotate: Sequence[Turn] = (0, 0, 0),
    scale: Sequence[float] = (1, 1, 1),
    shear: Sequence[float] = (0, 0, 0),
    order: str = "XYZ",
) -> Array:
    """Return `world_from_object` = T · R · diag(scale) · H(shear), a (4, 4) array.

    Examples
    --------
    >>> world(scale=(1, 2, 1), translate=(5, 0, 0))[:2].tolist()
    [[1.0, 0.0, 0.0, 5.0], [0.0, 2.0, 0.0, 0.0]]
    """
    turned = affine.rotation(rotate, order)
    return np.array(rational.to_floats(affine.compose(turned, scale, shear, translate)))


def look_at(
    eye: Sequence[float],
    target: Sequence[float],
    up: Sequence[float] = (0, 1, 0),
    *,
    handed: Handedness = Handedness.RIGHT,
) -> Array:
    """Return `camera_from_world` for a camera at `eye` that looks at `target`, a (4, 4) array.

    Raises
    ------
    NoAnswerError
        If eye and target coincide, or `up` is zero.

    Examples
    --------
    >>> look_at((0, 0, 5), (0, 0, 0))[2].tolist()
    [0.0, 0.0, 1.0, -5.0]
    """
    return np.array(view.look_at(eye, target, up, handed).camera_from_world)


def first_person(eye: Sequence[float], elevation: Turn, angle: Turn, roll: Turn = 0.0) -> Array:
    """Return `camera_from_world` = Rz(−roll) · Rx(−elevation) · Ry(−angle) · T(−eye).

    Examples
    --------
    >>> first_person((1, 2, 3), 0.0, 0.0)[:3, 3].tolist()
    [-1.0, -2.0, -3.0]
    """
    return np.array(rational.to_floats(view.first_person(eye, elevation, angle, roll)))


def perspective(
    fov_y: Turn,
    aspect: float,
    near: float,
    far: float = inf,
    clip: ClipSpace = projection.DEFAULT_CLIP_SPACE,
) -> Array:
    """Return `clip_from_camera` for a vertical field of view in radians or as `Angle`.

    Examples
    --------
    >>> perspective(Angle.degrees(90), 2.0, 1.0)[0].tolist()
    [0.5, 0.0, 0.0, 0.0]
    """
    half = fov_y.half() if isinstance(fov_y, Angle) else as_angle(fov_y / 2)
    return np.array(projection.perspective(half, aspect, near, far, clip))


def frustum(
    window: Window,
    near: float,
    far: float = inf,
    clip: ClipSpace = projection.DEFAULT_CLIP_SPACE,
) -> Array:
    """Return `clip_from_camera` through any rectangle of the near plane, a (4, 4) array."""
    return np.array(projection.frustum(window, near, far, clip))


def orthographic(
    window: Window,
    near: float,
    far: float,
    clip: ClipSpace = projection.DEFAULT_CLIP_SPACE,
) -> Array:
    """Return `clip_from_camera` of a parallel view, a (4, 4) array."""
    return np.array(projection.orthographic(window, near, far, clip))


def classify(matrix: ArrayLike, tolerance: float = 1e-12) -> Classification:
    """Say what kind of map a (3, 3) or affine (4, 4) matrix is; rank and mirroring are exact.

    Examples
    --------
    >>> classify(np.diag([1.0, -1.0, 1.0])).mirrored
    True
    """
    return _classify(_finite(matrix).tolist(), tolerance)


def normal_matrix(matrices: ArrayLike) -> Array:
    """Return the inverse transpose of the 3×3 blocks, (..., 3, 3), correctly rounded.

    Raises
    ------
    NoAnswerError
        If a matrix is singular; `cofactor_matrix` exists even then.

    Examples
    --------
    >>> normal_matrix(np.diag([1.0, 2.0, 4.0])).diagonal().tolist()
    [1.0, 0.5, 0.25]
    """
    return _for_each_block(matrices, lambda block: block.inverse_transpose)


def cofactor_matrix(matrices: ArrayLike) -> Array:
    """Return det · inverse transpose of the 3×3 blocks, (..., 3, 3), correctly rounded.

    Examples
    --------
    >>> cofactor_matrix(np.diag([1.0, 2.0, 0.0])).diagonal().tolist()
    [0.0, 0.0, 2.0]
    """
    return _for_each_block(matrices, lambda block: block.cofactor_matrix)


def transform_normals(matrix: ArrayLike, normals: ArrayLike) -> Array:
    """Carry normals (..., 3) through one (3, 3) or (4, 4) matrix, to unit length.

    Every component is correctly rounded; mirrors keep the outward side.

    Raises
    ------
    NoAnswerError
        If a normal has no image: the zero vector, or a silhouette of a flattening map.

    Examples
    --------
    >>> transform_normals(np.diag([1.0, 2.0, 1.0]), [1, 2, 0]).round(4).tolist()
    [0.7071, 0.7071, 0.0]
    """
    block = LinearMap.of(_finite(matrix)[:3, :3].tolist())
    given = _finite(normals)
    out = np.empty_like(given)
    for index in np.ndindex(given.shape[:-1]):
        found = block.normal(given[index].tolist())
        if found.direction is None:
            raise NoAnswerError(
                f"normal {list(index)} ({given[index].tolist()})", found.reason, "leave it out"
            )
        out[index] = found.direction
    return out


def normalize(vectors: ArrayLike) -> Array:
    """Return vectors (..., 3) at length one, correctly rounded, whatever their length was.

    Examples
    --------
    >>> normalize([3e-320, 4e-320, 0]).tolist()
    [0.6, 0.8, 0.0]
    """
    given = _finite(vectors)
    out = np.empty_like(given)
    for index in np.ndindex(given.shape[:-1]):
        out[index] = _normalize(given[index].tolist())
    return out


def _for_each_block(
    matrices: ArrayLike, answer: Callable[[LinearMap], rational.RationalMatrix]
) -> Array:
    given = _finite(matrices)
    if given.ndim < 2 or given.shape[-2:] not in ((3, 3), (4, 4)):
        raise IllegalValueError(
            f"an array of shape {given.shape}",
            "matrices are (..., 3, 3) or (..., 4, 4)",
            "reshape it",
        )
    out = np.empty((*given.shape[:-2], 3, 3))
    for index in np.ndindex(given.shape[:-2]):
        block = LinearMap.of(given[index][:3, :3].tolist())
        out[index] = rational.to_floats(answer(block))
    return out


def _finite(values: ArrayLike) -> NDArray[Any]:
    given = np.asarray(values, dtype=np.float64)
    if not np.isfinite(given).all():
        first = np.argwhere(~np.isfinite(given))[0].tolist()
        raise IllegalValueError(
            f"entry {first} ({given[tuple(first)]})",
            "it is not a finite number",
            "use finite numbers",
        )
    return given
