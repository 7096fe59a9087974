"""The lens group: how camera space becomes clip space: an angle, a rectangle, a box, a matrix."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import inf
from typing import TYPE_CHECKING

from nmatrix.errors import IllegalValueError, quantity
from nmatrix.linear.angle import Angle, float_turn
from nmatrix.linear.projection import (
    CLIP_PARTS,
    DEFAULT_CLIP_SPACE,
    ClipSpace,
    Window,
    clip_space,
    clip_space_over,
    frustum,
    orthographic,
    perspective,
)
from nmatrix.linear.rational import RationalMatrix, rounded_for_display
from nmatrix.linear.values import named, read_fields, real, refuse_beside, vector
from nmatrix.reading.arrays import read_projection

if TYPE_CHECKING:
    from nmatrix.linear.lens_readings import LensReading


@dataclass(frozen=True)
class Lens:
    """A lens; the field of view is vertical and in degrees, distances in world units.

    Of a matrix the clip space is read from its entries, where `said` does not name its parts as
    known; the two may not contradict each other.
    """

    fov_degrees: float = 60.0
    aspect: float = 1.0
    near: float = 0.1
    far: float = 100.0
    ortho: Window | None = None
    frustum: Window | None = None
    matrix: RationalMatrix | None = None
    clip: ClipSpace = DEFAULT_CLIP_SPACE
    said: tuple[str, ...] = ()

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
        if self.matrix is not None:
            said = self.said or (() if self.clip is DEFAULT_CLIP_SPACE else CLIP_PARTS)
            object.__setattr__(self, "said", said)
            object.__setattr__(self, "clip", self._clip_read())

    @cached_property
    def readings(self) -> tuple[LensReading, ...]:
        """What a given matrix may be as a projection, with what is said of it, likeliest first."""
        said = {part: self.clip.parts[part] for part in self.said}
        return tuple(one for one in self._allowed if one.fits(said))

    @cached_property
    def _allowed(self) -> tuple[LensReading, ...]:
        """What the entries of a given matrix allow."""
        if self.matrix is None:
            return ()
        from nmatrix.linear.lens_readings import lens_readings  # most lenses are built

        return lens_readings(self.matrix)

    def _clip_read(self) -> ClipSpace:
        """Return the clip space of the likeliest reading, and of a matrix without one what is said.

        Raises
        ------
        IllegalValueError
            If the entries allow no reading with what is said.
        """
        if self.readings:
            found = self.readings[0]
            unsaid = {
                part: word for part, word in found.clip.parts.items() if part not in self.said
            }
            return clip_space_over(self.clip, unsaid)
        if not self._allowed:
            return self.clip
        said = {part: self.clip.parts[part] for part in self.said}
        wrong = [p for p in said if not any(one.fits({p: said[p]}) for one in self._allowed)]
        read = self._allowed[0].clip.parts
        told, are = (
            " ".join(f"{quantity(part)} {words[part]}" for part in wrong or said)
            for words in (said, read)
        )
        raise IllegalValueError(
            f"{quantity('projection_matrix')} with {told}",
            f"its entries say {are}",
            "leave it out, or give another matrix",
        )

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
