"""Projection matrices: `clip_from_camera` for every depth range, hand and direction of y.

n is near, f far (which may be infinite: the limit is taken in the formula, exactly); g is −1
where the camera looks down −z (right-handed) and +1 where it looks down +z, so w = g·z. The z row
of a perspective matrix is [0 0 g·a c], of an orthographic one too. Nothing is rounded here, so that
near, far and the sides lie exactly where they were put; who shows a matrix rounds it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from math import inf
from typing import Any

from nmatrix.enums import (
    API_PRESETS,
    Api,
    ClipY,
    DepthRange,
    Handedness,
    WindowOrigin,
    chosen,
)
from nmatrix.errors import IllegalValueError, NoAnswerError, quantity
from nmatrix.linear.angle import Angle
from nmatrix.linear.rational import ONE, ZERO, RationalMatrix, determinant, exactly
from nmatrix.linear.values import read_fields, real
from nmatrix.report import Displayed, Quantity, Report

Sides = tuple[Fraction, Fraction, Fraction, Fraction]  # left, right, bottom, top

CLIP_PARTS = ("depth", "handed", "clip_y")  # what may be given beside an interface


@dataclass(frozen=True)
class ClipSpace(Displayed):
    """What the receiving interface expects: depth range, handedness, direction of y, origin."""

    depth: DepthRange = DepthRange.MINUS_ONE_TO_ONE
    handed: Handedness = Handedness.RIGHT
    clip_y: ClipY = ClipY.UP
    origin: WindowOrigin = WindowOrigin.LOWER_LEFT

    def __post_init__(self) -> None:
        read_fields(
            self,
            depth=partial(chosen, DepthRange),
            handed=partial(chosen, Handedness),
            clip_y=partial(chosen, ClipY),
            origin=partial(chosen, WindowOrigin),
        )

    @property
    def parts(self) -> dict[str, DepthRange | Handedness | ClipY]:
        """What a matrix decides of it; the origin of the window is not in it."""
        return {"depth": self.depth, "handed": self.handed, "clip_y": self.clip_y}

    def _repr_report_(self) -> Report:
        """Tell its parts, and the interfaces that have just these."""
        names = [api.value for api, preset in API_PRESETS.items() if ClipSpace(*preset) == self]
        parts = (*self.parts.items(), ("origin", self.origin))
        return Report.of_value(
            *(Quantity(name, word.value, name.replace("_", " ")) for name, word in parts),
            Quantity("apis", ", ".join(names) or None, "as in"),
        )

    @property
    def forward_z(self) -> int:
        """Return g, the sign of z in front of the camera."""
        return -1 if self.handed is Handedness.RIGHT else 1

    @property
    def y_sign(self) -> int:
        """Return 1 where y in clip space points up, −1 where it points down."""
        return 1 if self.clip_y is ClipY.UP else -1

    @property
    def window_y_sign(self) -> int:
        """Return 1 where window y counts upwards from the bottom, −1 where down from the top.

        Where y in clip space points down, the interface counts from the top.
        """
        counts_up = self.origin is WindowOrigin.LOWER_LEFT and self.clip_y is ClipY.UP
        return 1 if counts_up else -1


def clip_space(given: object, name: str) -> ClipSpace:
    """Return a clip space, or that of an interface: opengl, vulkan, direct3d, metal, webgpu.

    Examples
    --------
    >>> clip_space("vulkan", "clip").clip_y
    <ClipY.DOWN: 'down'>
    """
    return (
        given if isinstance(given, ClipSpace) else ClipSpace(*API_PRESETS[chosen(Api, given, name)])
    )


def clip_space_over(base: ClipSpace, given: Mapping[str, Any]) -> ClipSpace:
    """Lay what was given over a clip space: an interface (`api`) first, then each part by itself.

    Examples
    --------
    >>> clip_space_over(ClipSpace(), {"api": "vulkan", "depth": "reversed"}).depth
    <DepthRange.REVERSED: 'reversed'>
    """
    if given.get("api") is not None:
        base = clip_space(given["api"], "api")
    return replace(base, **{name: given[name] for name in CLIP_PARTS if given.get(name)})


def front_sign(clip_from_object: RationalMatrix, space: ClipSpace) -> int:
    """Return the sign that the area of a front face has on the canvas, where y runs down.

    The rows of x, y and of what grows away from the eye (w, or depth in a parallel view) turn a
    triangle's sense or keep it: the sign of their determinant says which, exactly. It is 0 for a
    map that flattens: then both sides are alike.
    """
    x, y, z, w = (row[:3] for row in clip_from_object)
    away = w
    if not any(w):
        away = tuple(-one for one in z) if space.depth is DepthRange.REVERSED else z
    turn = determinant((x, y, away)) * space.y_sign
    return (turn > 0) - (turn < 0)


@dataclass(frozen=True)
class Window(Displayed):
    """The rectangle that a frustum or a box cuts out of the near plane."""

    left: float
    right: float
    bottom: float
    top: float

    def __post_init__(self) -> None:
        read_fields(self, left=real, right=real, bottom=real, top=real)

    def _repr_report_(self) -> Report:
        """Tell its four sides."""
        return Report.of_value(*(Quantity(side, value, side) for side, value in vars(self).items()))

    def sides(self, read: Callable[[float], Fraction] = Fraction) -> Sides:
        """Return the four sides exactly."""
        return read(self.left), read(self.right), read(self.bottom), read(self.top)


DEFAULT_CLIP_SPACE = ClipSpace()
NDC_DEPTH: Mapping[DepthRange, tuple[int, int]] = {  # at the near plane, at the far plane
    DepthRange.MINUS_ONE_TO_ONE: (-1, 1),
    DepthRange.ZERO_TO_ONE: (0, 1),
    DepthRange.REVERSED: (1, 0),
}
CENTRED = (ZERO, ZERO)  # the view axis goes through the middle of the window


def perspective(
    half_fov_y: Angle,
    aspect: float | Fraction,
    near: float | Fraction,
    far: float | Fraction,
    clip: ClipSpace = DEFAULT_CLIP_SPACE,
) -> RationalMatrix:
    """Build the projection of a symmetric perspective view.

    The height of the view at distance 1 is 2·tan(fov/2); its width is `aspect` times that.

    Parameters
    ----------
    half_fov_y
        Half of the vertical field of view, between 0 and a quarter turn.
    aspect
        Width over height, positive.
    near, far
        Distances along the view direction, 0 < near < far; far may be infinite.
    clip
        Depth range, handedness and direction of y.

    Raises
    ------
    IllegalValueError
        For a field outside (0°, 180°), an aspect or near that is not positive, near > far.
    NoAnswerError
        For near = far.

    Examples
    --------
    >>> for row in perspective(Angle.degrees(45), 2.0, 1.0, inf):
    ...     print(*row)
    1/2 0 0 0
    0 1 0 0
    0 0 -1 -2
    0 0 -1 0
    """
    focal = _focal_lengths(half_fov_y, aspect)
    return perspective_rows(focal, CENTRED, perspective_depth(near, far, clip.depth), clip)


def _focal_lengths(half_fov_y: Angle, aspect: float | Fraction) -> tuple[Fraction, Fraction]:
    """Return the focal lengths in x and y: cot(fov/2), for x over the aspect."""
    if half_fov_y.sine <= 0 or half_fov_y.cosine <= 0:
        raise IllegalValueError(
            "the field of view",
            "it must lie between 0 and 180 degrees, both excluded",
            f"try {quantity('fov')} 60",
        )
    check_aspect(aspect)
    focal = half_fov_y.cosine / half_fov_y.sine
    return focal / exactly(aspect), focal


def perspective_rows(
    focal: tuple[Fraction, Fraction],
    centre: tuple[Fraction, Fraction],
    depth_row: tuple[Fraction, Fraction],
    clip: ClipSpace,
) -> RationalMatrix:
    """Build a perspective matrix of its focal lengths, off-centre terms and z row; w = g·z."""
    g, y = clip.forward_z, clip.y_sign
    slope, offset = depth_row
    return (
        (focal[0], ZERO, -g * centre[0], ZERO),
        (ZERO, y * focal[1], -g * y * centre[1], ZERO),
        (ZERO, ZERO, g * slope, offset),
        (ZERO, ZERO, Fraction(g), ZERO),
    )


def frustum(
    window: Window,
    near: float | Fraction,
    far: float | Fraction,
    clip: ClipSpace = DEFAULT_CLIP_SPACE,
) -> RationalMatrix:
    """Build the projection of a perspective view through any rectangle of the near plane.

    Examples
    --------
    >>> print(*frustum(Window(0, 2, -1, 1), 1.0, inf)[0])
    1 0 1 0
    """
    return through(window.sides(), exactly(near), perspective_depth(near, far, clip.depth), clip)


def through(
    sides: Sides, distance: Fraction, depth_row: tuple[Fraction, Fraction], clip: ClipSpace
) -> RationalMatrix:
    """Build a perspective matrix of any rectangle at a distance, and of its z row.

    Raises
    ------
    NoAnswerError
        If two opposite sides coincide and the window encloses nothing.

    Examples
    --------
    >>> sides = tuple(map(Fraction, (0, 2, -1, 1)))
    >>> row = perspective_depth(3.0, inf, DepthRange.MINUS_ONE_TO_ONE)
    >>> through(sides, ONE, row, ClipSpace()) == frustum(Window(0, 6, -3, 3), 3.0, inf)
    True
    """
    _check_extent(sides)
    left, right, bottom, top = sides
    width, height = right - left, top - bottom
    return perspective_rows(
        (2 * distance / width, 2 * distance / height),
        ((right + left) / width, (top + bottom) / height),
        depth_row,
        clip,
    )


def sides_seen(P: RationalMatrix, clip: ClipSpace) -> Sides | None:
    """Find the rectangle at distance 1 that a perspective matrix shows; of any other, None.

    Examples
    --------
    >>> print(*sides_seen(frustum(Window(0, 6, -3, 3), 3.0, inf), ClipSpace()))
    0 2 -1 1
    """
    if not is_lens(P) or P[3][3]:
        return None
    forward, y = clip.forward_z, clip.y_sign
    across, upwards = forward * P[0][2], forward * y * P[1][2]
    wide, high = P[0][0], y * P[1][1]
    return (
        (-1 - across) / wide,
        (1 - across) / wide,
        (-1 - upwards) / high,
        (1 - upwards) / high,
    )


def _check_extent(sides: Sides) -> None:
    """Refuse a rectangle whose opposite sides coincide."""
    for low, high, names in ((*sides[:2], "left and right"), (*sides[2:], "bottom and top")):
        if low == high:
            raise NoAnswerError(
                f"{names} ({float(low):g} and {float(high):g})",
                "they coincide, so the view has no extent",
                "move one of them",
            )


def orthographic(
    window: Window,
    near: float | Fraction,
    far: float | Fraction,
    clip: ClipSpace = DEFAULT_CLIP_SPACE,
) -> RationalMatrix:
    """Build the projection of a parallel view; near may be zero or behind the camera.

    Examples
    --------
    >>> print(*orthographic(Window(-2, 2, -1, 1), -1.0, 1.0)[2])
    0 0 -1 0
    """
    return parallel(window.sides(), orthographic_depth(near, far, clip.depth), clip)


def parallel(sides: Sides, depth_row: tuple[Fraction, Fraction], clip: ClipSpace) -> RationalMatrix:
    """Build an orthographic matrix of the sides of its box, and of its z row."""
    _check_extent(sides)
    left, right, bottom, top = sides
    slope, offset = depth_row
    y = clip.y_sign
    return (
        (2 / (right - left), ZERO, ZERO, -(right + left) / (right - left)),
        (ZERO, 2 * y / (top - bottom), ZERO, -y * (top + bottom) / (top - bottom)),
        (ZERO, ZERO, clip.forward_z * slope, offset),
        (ZERO, ZERO, ZERO, ONE),
    )


def is_lens(rows: Sequence[Sequence[float | Fraction]]) -> bool:
    """Recognise a projection by its zeros: x and y are scaled, and w is ±z or 1.

    Examples
    --------
    >>> is_lens(perspective(Angle.degrees(45), 1, 1, inf)), is_lens([[1, 0, 0, 0]] * 4)
    (True, False)
    """
    x, y, z, w = rows
    if not (x[0] and y[1]) or x[1] or y[0] or z[0] or z[1] or w[0] or w[1]:
        return False
    if (abs(w[2]), w[3]) == (1, 0):
        return bool(z[3]) and not (x[3] or y[3])
    return (w[2], w[3]) == (0, 1) and bool(z[2]) and not (x[2] or y[2])


def perspective_depth(
    near: float | Fraction, far: float | Fraction, depth: DepthRange
) -> tuple[Fraction, Fraction]:
    """Return a and c of the z row, so that a + c/z is `NDC_DEPTH` at z = near and at z = far.

    For an infinite far a is the depth there itself: the limit of the same formula.
    """
    if not near > 0:
        raise IllegalValueError(
            f"near ({float(near):g})",
            "a perspective view needs a near plane in front of the eye",
            f"try {quantity('near')} 0.1",
        )
    check_near_far(near, far)
    at_near, at_far = NDC_DEPTH[depth]
    n = exactly(near)
    if far == inf:
        return Fraction(at_far), (at_near - at_far) * n
    f = exactly(far)
    return (at_far * f - at_near * n) / (f - n), (at_near - at_far) * f * n / (f - n)


def orthographic_depth(
    near: float | Fraction, far: float | Fraction, depth: DepthRange
) -> tuple[Fraction, Fraction]:
    """Return a and c of the z row of a parallel view: a·z + c is `NDC_DEPTH` at near and far."""
    check_near_far(near, far)
    if far == inf:
        raise IllegalValueError(
            "far (inf)",
            "a parallel view divides depth by far − near",
            f"give a finite {quantity('far')}",
        )
    at_near, at_far = NDC_DEPTH[depth]
    n, f = exactly(near), exactly(far)
    return (at_far - at_near) / (f - n), (at_near * f - at_far * n) / (f - n)


def check_near_far(near: float | Fraction, far: float | Fraction) -> None:
    """Refuse near beyond far, and near at far."""
    if far == inf:
        return
    if near == far:
        raise NoAnswerError(
            f"near and far ({float(near):g} and {float(far):g})",
            "they coincide, so depth has no range",
            "move one of them",
        )
    if not near < far:
        raise IllegalValueError(
            f"near and far ({float(near):g} and {float(far):g})",
            "near must be the smaller one",
            f"swap them; for 1 at near and 0 at far use {quantity('depth')} reversed",
        )


def check_aspect(aspect: float | Fraction) -> None:
    """Refuse an aspect ratio that is not positive."""
    if not aspect > 0:
        raise IllegalValueError(
            f"aspect ({float(aspect):g})",
            "width over height must be positive",
            f"try {quantity('aspect')} 1.5",
        )
