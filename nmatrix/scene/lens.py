"""The lens group: how camera space becomes clip space: an angle, a rectangle, a box, a matrix."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import inf

from nmatrix.errors import IllegalValueError, quantity
from nmatrix.linear.angle import Angle, float_turn
from nmatrix.linear.projection import (
    DEFAULT_CLIP_SPACE,
    ClipSpace,
    Window,
    clip_space,
    frustum,
    orthographic,
    perspective,
)
from nmatrix.linear.rational import RationalMatrix, rounded_for_display
from nmatrix.linear.values import named, read_fields, real, refuse_beside, vector
from nmatrix.reading.arrays import read_projection


@dataclass(frozen=True)
class Lens:
    """A lens; the field of view is vertical and in degrees, distances in world units."""

    fov_degrees: float = 60.0
    aspect: float = 1.0
    near: float = 0.1
    far: float = 100.0
    ortho: Window | None = None
    frustum: Window | None = None
    matrix: RationalMatrix | None = None
    clip: ClipSpace = DEFAULT_CLIP_SPACE

    def __post_init__(self) -> None:
        read_fields(
            self,
            fov_degrees=named("fov", float_turn),
            aspect=real,
            near=real,
            far=_real_or_infinity,
            ortho=_read_window,
            frustum=_read_window,
            matrix=named("projection_matrix", read_projection),
            clip=clip_space,
        )
        names = {"matrix": "projection_matrix"}
        refuse_beside(self, "matrix", ("ortho", "frustum"), names=names)
        refuse_beside(self, "ortho", ("frustum",), "both shape the view")

    @property
    def exact(self) -> RationalMatrix:
        """The projection before it is rounded, which has every plane exactly where it was put.

        A field of view's cotangent is irrational mostly; it is known to some 160 bits.

        Raises
        ------
        IllegalValueError
            For a field outside (0°, 180°), an aspect or near that is not positive, near > far.
        NoAnswerError
            For near = far, left = right or bottom = top.

        Examples
        --------
        >>> print(*Lens(near=1, far=7).exact[2])
        0 0 -4/3 -7/3
        """
        if self.matrix is not None:
            return self.matrix
        if self.ortho is not None:
            return orthographic(self.ortho, self.near, self.far, self.clip)
        if self.frustum is not None:
            return frustum(self.frustum, self.near, self.far, self.clip)
        check_fov(self.fov_degrees)
        half = Angle.degrees(Fraction(self.fov_degrees) / 2)
        return perspective(half, self.aspect, self.near, self.far, self.clip)

    @property
    def clip_from_camera(self) -> RationalMatrix:
        """The projection matrix as it is shown, every entry rounded once to a float64.

        Examples
        --------
        >>> float(Lens(fov_degrees=90).clip_from_camera[1][1])
        1.0
        """
        return rounded_for_display(self.exact)


def _real_or_infinity(value: object, name: str) -> float:
    return inf if isinstance(value, float) and value == inf else real(value, name)


def _read_window(given: object, name: str) -> Window:
    if isinstance(given, Window):
        return given
    return Window(*(real(side, name) for side in vector(given, name, size=4)))


def check_fov(degrees: float) -> None:
    """Refuse a field of view outside (0°, 180°)."""
    if not 0 < degrees < 180:
        raise IllegalValueError(
            f"fov ({degrees:g})",
            "a vertical field of view lies between 0 and 180 degrees, both excluded",
            f"try {quantity('fov')} 60",
        )
