"""Building matrices as arrays: row-major, column vectors, each the exact matrix rounded once.

Every parameter may have leading axes; they broadcast, and one matrix is built for each place.
Angles are radians, `Angle`, or texts that say their unit ("30deg"). A float type that comes in goes
out again; lists and integers give float64.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import astuple
from math import inf, pi
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from nmatrix.api import arrays, places
from nmatrix.api.places import Array, Turns
from nmatrix.enums import Api, Convention, Handedness, chosen
from nmatrix.errors import IllegalValueError
from nmatrix.linear import affine, projection, rational, view
from nmatrix.linear.angle import Angle, as_angle
from nmatrix.linear.projection import ClipSpace, Window, clip_space
from nmatrix.linear.viewport import window_from_ndc
from nmatrix.scene.given import refuse_together

XYZ, SIDES = (3,), (4,)


def world(
    *,
    translate: ArrayLike = (0, 0, 0),
    rotate: Turns = None,
    quaternion: ArrayLike | None = None,
    axis_angle: tuple[ArrayLike, Turns] | None = None,
    scale: ArrayLike = (1, 1, 1),
    shear: ArrayLike = (0, 0, 0),
    order: str | None = None,
    convention: str | Convention = Convention.STANDARD,
) -> Array:
    """Build `world_from_object` = T · R · diag(scale) · H(shear).

    Parameters
    ----------
    translate, scale, shear
        (..., 3) in world units; one number is a uniform scale; shear is xy, xz, yz.
    rotate
        Three angles (..., 3) about x, y, z; or instead `quaternion` (..., 4), x y z w of any
        length but zero, or `axis_angle`, an axis (..., 3) and an angle (...).
    order
        A permutation of XYZ (about the turned axes, the default) or of xyz (about the fixed ones).
    convention
        standard, polimi or polimi-assignments: how three angles make a rotation.

    Returns
    -------
    Array
        (..., 4, 4), every entry within 4 units of roundoff of the largest. Near a map that
        is turned, sheared and flattened no floats may be exactly singular: `Setup` keeps it exact.

    Raises
    ------
    IllegalValueError
        For values that are not that, for two rotations at once, an order without three angles.
    NoAnswerError
        For a zero quaternion or axis.

    Examples
    --------
    >>> world(scale=(1, 2, 1), translate=(5, 0, 0))[:2].tolist()
    [[1.0, 0.0, 0.0, 5.0], [0.0, 2.0, 0.0, 0.0]]
    """
    named = chosen(Convention, convention, "convention")
    ways = {"rotate": rotate, "quaternion": quaternion, "axis_angle": axis_angle, "order": order}
    if named is not Convention.STANDARD:
        ways["convention"] = named
    given = {name: value for name, value in ways.items() if value is not None}
    refuse_together("quaternion", ("rotate", "axis_angle"), given, "both are the rotation")
    refuse_together("axis_angle", ("rotate",), given, "both are the rotation")
    for whole in ("quaternion", "axis_angle"):
        refuse_together(whole, ("order", "convention"), given, "those are for angles")
    refuse_together("convention", ("order",), given, "the course fixes the order")
    turned, *how = _rotation(given, affine.checked_order("XYZ" if order is None else order), named)
    return places.each(
        lambda move, size, slant, *turn: affine.compose(turned(*turn), size, slant, move),
        (
            places.real("translate", translate, XYZ),
            _scale(scale),
            places.real("shear", shear, XYZ),
            *how,
        ),
    )


def rotation(turns: Turns, order: str = "XYZ") -> Array:
    """Build the rotation (..., 4, 4) by three angles (..., 3) about x, y, z.

    Examples
    --------
    >>> rotation((0, 0, Angle.degrees(90)))[:2].tolist()
    [[0.0, -1.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]]
    """
    checked = affine.checked_order(order)
    return places.each(
        lambda angles: _grown(affine.rotation(angles, checked)),
        (places.turns("turns", turns, XYZ),),
    )


def quaternion(xyzw: ArrayLike) -> Array:
    """Build the rotation (..., 4, 4) of quaternions (..., 4), x y z w of any length but zero.

    Dividing by the squared length normalises without a root, so the result is exact.

    Raises
    ------
    NoAnswerError
        For the zero quaternion.

    Examples
    --------
    >>> quaternion((0, 0, 1, 1))[:2].tolist()
    [[0.0, -1.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]]
    """
    given = (places.real("xyzw", xyzw, SIDES),)
    return places.each(lambda parts: _grown(affine.rotation_from_quaternion(parts)), given)


def axis_angle(axis: ArrayLike, turn: Turns) -> Array:
    """Build the rotation (..., 4, 4) about an axis (..., 3) of any length but zero, right-handed.

    Raises
    ------
    NoAnswerError
        For the zero axis.

    Examples
    --------
    >>> axis_angle((0, 0, 7), Angle.degrees(90))[:2].tolist()
    [[0.0, -1.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]]
    """
    return places.each(
        lambda along, angle: _grown(affine.rotation_about_axis(along, angle)),
        (places.real("axis", axis, XYZ), places.turns("turn", turn, ())),
    )


def look_at(
    eye: ArrayLike,
    target: ArrayLike,
    up: ArrayLike = (0, 1, 0),
    *,
    handed: str | Handedness = Handedness.RIGHT,
) -> Array:
    """Build `camera_from_world` for cameras at `eye` that look at `target`, all (..., 3).

    The view direction is never altered. Where `up` is exactly parallel to it, the world's z or y
    takes its place, so that straight down and straight up have +x on the right.

    Raises
    ------
    NoAnswerError
        If eye and target coincide, or `up` is zero.

    Examples
    --------
    >>> look_at((0, 0, 5), (0, 0, 0))[2].tolist()
    [0.0, 0.0, 1.0, -5.0]
    >>> look_at((0, 0, 5), (0, 0, 0), handed="left")[2].tolist()
    [0.0, 0.0, -1.0, 5.0]
    """
    hand = chosen(Handedness, handed, "handed")
    return places.each(
        lambda at, to, upward: view.look_at(at, to, upward, hand).camera_from_world,
        (
            places.real("eye", eye, XYZ),
            places.real("target", target, XYZ),
            places.real("up", up, XYZ),
        ),
    )


def first_person(
    eye: ArrayLike,
    elevation: Turns,
    angle: Turns,
    roll: Turns = 0.0,
    *,
    convention: str | Convention = Convention.STANDARD,
) -> Array:
    """Build `camera_from_world` = Rz(−roll) · Rx(−elevation) · Ry(−angle) · T(−eye).

    Elevation looks up, the angle to the left by the right-hand rule (to the right under polimi).

    Examples
    --------
    >>> first_person((1, 2, 3), 0.0, 0.0)[:3, 3].tolist()
    [-1.0, -2.0, -3.0]
    """
    named = chosen(Convention, convention, "convention")
    return places.each(
        lambda at, up, sideways, about: view.first_person(at, up, sideways, about, named),
        (
            places.real("eye", eye, XYZ),
            places.turns("elevation", elevation, ()),
            places.turns("angle", angle, ()),
            places.turns("roll", roll, ()),
        ),
    )


def perspective(
    fov_y: Turns,
    aspect: ArrayLike,
    near: ArrayLike,
    far: ArrayLike = inf,
    clip: ClipSpace | str = projection.DEFAULT_CLIP_SPACE,
) -> Array:
    """Build `clip_from_camera` for a vertical field of view.

    Parameters
    ----------
    fov_y
        Between 0 and π radians, an `Angle` or a text with its unit.
    aspect
        Width over height.
    near, far
        Distances from the eye, 0 < near < far; far may be infinite.
    clip
        A `ClipSpace`, or the name of an interface: opengl, vulkan, direct3d, metal, webgpu.

    Raises
    ------
    IllegalValueError
        For a field outside (0, π), an aspect or near that is not positive, near > far.
    NoAnswerError
        For near = far.

    Examples
    --------
    >>> perspective(Angle.degrees(90), 2.0, 1.0)[0].tolist()
    [0.5, 0.0, 0.0, 0.0]
    """
    space = clip_space(clip, "clip")
    return places.each(
        lambda fov, ratio, n, f: projection.perspective(_half(fov), ratio, n, f, space),
        (
            places.turns("fov_y", fov_y, ()),
            places.real("aspect", aspect, ()),
            places.real("near", near, ()),
            places.distance("far", far),
        ),
    )


def frustum(
    window: Window | ArrayLike,
    near: ArrayLike,
    far: ArrayLike = inf,
    clip: ClipSpace | str = projection.DEFAULT_CLIP_SPACE,
) -> Array:
    """Build `clip_from_camera` through a rectangle of the near plane: left, right, bottom, top.

    Examples
    --------
    >>> frustum((-1, 3, -1, 1), 1.0)[0].tolist()
    [0.5, 0.0, 0.5, 0.0]
    """
    return _through(projection.frustum, window, near, far, clip)


def orthographic(
    window: Window | ArrayLike,
    near: ArrayLike,
    far: ArrayLike,
    clip: ClipSpace | str = projection.DEFAULT_CLIP_SPACE,
) -> Array:
    """Build `clip_from_camera` of a parallel view of a box: left, right, bottom, top.

    Examples
    --------
    >>> orthographic((-2, 2, -1, 1), 0, 10)[2].tolist()
    [0.0, 0.0, -0.2, -1.0]
    """
    return _through(projection.orthographic, window, near, far, clip)


def viewport(width: ArrayLike, height: ArrayLike, api: str | Api = Api.OPENGL) -> Array:
    """Build `window_from_ndc` as an interface has it: x, y in pixels, z the depth 0 to 1.

    x counts from the left, y from the bottom for OpenGL and from the top for all others.

    Examples
    --------
    >>> (viewport(640, 480, "direct3d") @ [0, 1, 0.25, 1]).tolist()
    [320.0, 0.0, 0.25, 1.0]
    """
    clip = clip_space(chosen(Api, api, "api"), "api")

    def build(w: float, h: float) -> rational.RationalMatrix:
        if not (w > 0 and h > 0):
            raise IllegalValueError(
                f"viewport ({w:g} × {h:g})", "both sides are positive", "try viewport(640, 480)"
            )
        return window_from_ndc(w, h, clip)

    return places.each(build, (places.real("width", width, ()), places.real("height", height, ())))


def _rotation(given: dict[str, Any], order: str, convention: Convention) -> tuple[Any, ...]:
    """Choose the builder of a world's rotation, and the parameters that it takes."""
    if "quaternion" in given:
        parts = places.real("quaternion", given["quaternion"], SIDES)
        return affine.rotation_from_quaternion, parts
    if "axis_angle" in given:
        try:
            axis, turn = given["axis_angle"]
        except (TypeError, ValueError):
            raise IllegalValueError(
                f"axis_angle, a {type(given['axis_angle']).__name__}",
                "it is a pair of an axis and an angle",
                "try axis_angle=((0, 1, 0), Angle.degrees(30))",
            ) from None
        return (
            affine.rotation_about_axis,
            places.real("axis", axis, XYZ),
            places.turns("turn", turn, ()),
        )
    angles = places.turns("rotate", given.get("rotate", (0, 0, 0)), XYZ)
    return (lambda turns: affine.rotation(turns, order, convention)), angles


def _through(
    build: Callable[..., rational.RationalMatrix],
    window: Window | ArrayLike,
    near: ArrayLike,
    far: ArrayLike,
    clip: ClipSpace | str,
) -> Array:
    """Build projections through a window."""
    space = clip_space(clip, "clip")
    sides: Any = astuple(window) if isinstance(window, Window) else window
    return places.each(
        lambda four, n, f: build(Window(*four), n, f, space),
        (
            places.real("window", sides, SIDES),
            places.real("near", near, ()),
            places.distance("far", far),
        ),
    )


def _half(fov: Angle | float) -> Angle:
    if isinstance(fov, Angle) and fov.sine > 0:
        return fov.half()
    if not isinstance(fov, Angle) and 0 < fov < pi:
        return as_angle(fov / 2)
    in_degrees = not isinstance(fov, Angle) and 2 * pi < fov < 180
    raise IllegalValueError(
        f"fov_y ({fov!r})",
        "a field of view lies between 0 and π radians, both excluded",
        f"write Angle.degrees({fov:g})" if in_degrees else "try Angle.degrees(60)",
    )


def _scale(scale: ArrayLike) -> places.Parameter:
    if arrays.reals(scale, "scale").ndim > 0:
        return places.real("scale", scale, XYZ)
    thrice: Any = [scale] * 3
    is_typed = isinstance(scale, np.ndarray | np.generic)
    return places.real("scale", np.asarray(thrice) if is_typed else thrice, XYZ)


def _grown(block: rational.RationalMatrix) -> rational.RationalMatrix:
    return rational.affine_matrix(block)
