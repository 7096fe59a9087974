"""Building matrices as arrays: row-major, column vectors, each the exact matrix rounded once."""

from __future__ import annotations

from collections.abc import Sequence
from math import inf

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import Handedness
from nmatrix.linear import affine, projection, rational, view
from nmatrix.linear.angle import Angle, as_angle
from nmatrix.linear.projection import ClipSpace, Window

Array = NDArray[np.float64]
Turn = Angle | float


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
