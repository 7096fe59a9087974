"""The lens group: how camera space becomes clip space: an angle, a rectangle, a box, a matrix.

The ways in which cameras are measured (millimetres, pixels, four angles) are kept as they were
given: another near or another picture must not change what they see.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from math import atan, degrees, inf, radians, tan
from typing import TYPE_CHECKING, Any

from nmatrix.errors import IllegalValueError, quantity
from nmatrix.linear.angle import Angle
from nmatrix.linear.measured_lens import (
    FilmBack,
    HorizontalField,
    Intrinsics,
    MeasuredLens,
    Read,
    SideAngles,
    Turn,
    check_field,
    sides_at_distance_one,
)
from nmatrix.linear.projection import (
    CENTRED,
    CLIP_PARTS,
    DEFAULT_CLIP_SPACE,
    ClipSpace,
    Sides,
    Window,
    check_aspect,
    clip_space,
    clip_space_over,
    orthographic_depth,
    parallel,
    perspective,
    perspective_depth,
    perspective_rows,
    through,
)
from nmatrix.linear.rational import ONE, RationalMatrix, exactly, rounded_for_display
from nmatrix.linear.values import named, read_fields, real, refuse_beside, refused, vector
from nmatrix.linear.viewport import Viewport, read_viewport
from nmatrix.reading.angles import float_turn, turns
from nmatrix.reading.arrays import read_projection
from nmatrix.report import Displayed, Quantity, Report

if TYPE_CHECKING:
    from nmatrix.linear.lens_readings import LensReading


# The ways to say what a lens sees, each with what it may not stand beside: two ways at once, or an
# aspect where all four sides are said already. What is no way of its own belongs to the one before.
_WAYS = ("ortho", "frustum", "intrinsics", "angles", "focal", "fov_x", "fov")
_MEASURED = ("fov_x", "focal", "sensor", "intrinsics", "angles")
_BY_FOUR_SIDES = ("ortho", "frustum", "intrinsics", "angles")
EXCLUDES: Mapping[str, tuple[str, ...]] = {
    way: (*_WAYS[:place:-1], *(("aspect",) if way in _BY_FOUR_SIDES else ()))
    for place, way in enumerate(_WAYS)
} | {"sensor": tuple(way for way in _WAYS if way != "focal")}
SHAPES = (*EXCLUDES, "aspect")  # names of all that shapes the view
SAME_SHAPE = 0.01  # of an aspect: sides are whole pixels
TWO_SHAPES = "both shape the view"


@dataclass(frozen=True)
class Lens(Displayed):
    """A lens; the field of view is vertical and in degrees, distances in world units.

    `measured` takes the place of the field of view; `aspect` is None where nobody said it, and
    `viewport` the image in pixels, where there is one.
    Of a matrix the clip space is read from its entries, where `said` does not name its parts as
    known; the two may not contradict each other.
    """

    fov_degrees: float = 60.0
    aspect: float | None = None
    near: float = 0.1
    far: float = 100.0
    ortho: Window | None = None
    frustum: Window | None = None
    measured: MeasuredLens | None = None
    viewport: Viewport | None = None
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
            measured=_read_measured,
            viewport=read_viewport,
            matrix=named("projection_matrix", read_projection),
            clip=clip_space,
        )
        names = {"matrix": "projection_matrix"}
        refuse_beside(self, "matrix", ("ortho", "frustum", "measured"), names=names)
        refuse_beside(self, "ortho", ("frustum", "measured"), TWO_SHAPES)
        refuse_beside(self, "frustum", ("measured",), TWO_SHAPES)
        if isinstance(self.measured, Intrinsics):
            _ = self.measured_sides
        if self.matrix is not None:
            said = self.said or (() if self.clip is DEFAULT_CLIP_SPACE else CLIP_PARTS)
            object.__setattr__(self, "said", said)
            object.__setattr__(self, "clip", self._clip_read())

    def framing(self, aspect: float) -> Lens:
        """Show all that the lens frames in a picture of another shape, and more beside it.

        It is for an angle or a box; the angle is vertical, so only a narrower picture changes it.

        Examples
        --------
        >>> lens = Lens(fov_degrees=90, aspect=2)
        >>> lens.framing(4).fov_degrees, round(lens.framing(1).fov_degrees, 4)
        (90.0, 126.8699)
        """
        taller, wider = (
            max(one, 1.0) for one in (self.shape_of(aspect), 1 / self.shape_of(aspect))
        )
        if self.ortho is not None:
            x, y = self.ortho.left + self.ortho.right, self.ortho.bottom + self.ortho.top
            half = (self.ortho.right - self.ortho.left) / 2 * wider
            high = (self.ortho.top - self.ortho.bottom) / 2 * taller
            box = Window(x / 2 - half, x / 2 + half, y / 2 - high, y / 2 + high)
            return replace(self, ortho=box, aspect=aspect)
        if taller == 1.0:
            return replace(self, aspect=aspect)
        fov = 2 * degrees(atan(tan(radians(self.fov_degrees) / 2) * taller))
        return replace(self, fov_degrees=fov, aspect=aspect)

    def shape_of(self, aspect: float) -> float:
        """Divide the own aspect by another; it is 1 for what pixels cannot tell apart.

        Examples
        --------
        >>> Lens(aspect=2).shape_of(1), Lens(aspect=2).shape_of(1.99)
        (2.0, 1.0)
        """
        ratio = float(self.aspect_ratio) / aspect
        return ratio if abs(ratio - 1.0) > SAME_SHAPE else 1.0

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

    def _repr_report_(self) -> Report:
        """Tell the projection matrix."""
        P = self.clip_from_camera
        return Report.of_value(Quantity("clip_from_camera", P, "clip ← camera"))

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
        return self.exact_by(Angle.degrees, exactly)

    def exact_by(self, turn: Turn, read: Read) -> RationalMatrix:
        """Build the projection of numbers as `read` takes them and degrees turned by `turn`."""
        if self.matrix is not None:
            return self.matrix
        near, far = read(self.near), self.far if self.far == inf else read(self.far)
        if self.ortho is not None:
            depth_row = orthographic_depth(near, far, self.clip.depth)
            return parallel(self.ortho.sides(read), depth_row, self.clip)
        depth_row = perspective_depth(near, far, self.clip.depth)
        if self.frustum is not None:
            return through(self.frustum.sides(read), near, depth_row, self.clip)
        aspect = read(self.aspect_ratio)
        if isinstance(self.measured, HorizontalField):
            check_aspect(aspect)
            half = self.measured.half(turn, read)
            focal = half.cosine / half.sine
            return perspective_rows((focal, focal * aspect), CENTRED, depth_row, self.clip)
        if self.measured is not None:
            check_aspect(aspect)
            sides = sides_at_distance_one(self.measured, aspect, self.viewport, turn, read)
            return through(sides, ONE, depth_row, self.clip)
        check_field(self.fov_degrees, "fov", "vertical")
        return perspective(turn(read(self.fov_degrees) / 2), aspect, near, far, self.clip)

    @property
    def aspect_ratio(self) -> float | Fraction:
        """Width over height: as it was said, or the viewport's, or the sensor's, or 1.

        Examples
        --------
        >>> print(Lens(measured=FilmBack(50, (36, 24))).aspect_ratio)
        3/2
        """
        if self.aspect is not None:
            return self.aspect
        if self.viewport is not None:
            return self.viewport.aspect
        return self.measured.aspect if isinstance(self.measured, FilmBack) else 1.0

    @cached_property
    def measured_sides(self) -> Sides | None:
        """What a measured camera sees at distance 1: left, right, bottom, top."""
        if self.measured is None:
            return None
        check_aspect(self.aspect_ratio)
        return sides_at_distance_one(self.measured, Fraction(self.aspect_ratio), self.viewport)

    @property
    def remarks(self) -> tuple[str, ...]:
        """What a measured camera leaves to a convention, and how it was taken here."""
        match self.measured:
            case FilmBack() as film if float(film.aspect) != float(self.aspect_ratio):
                across = self.aspect_ratio >= 1
                return (
                    f"The picture has another aspect than the sensor, whose "
                    f"{'width lies across it' if across else 'height lies along it'}.",
                )
            case Intrinsics():
                return (
                    "cx and cy count from the image's upper left corner, as COLMAP does; OpenCV "
                    "counts from the middle of the first pixel: add 0.5 to its cx and cy.",
                )
            case SideAngles() as sides if sides.down > sides.up:
                return (
                    "down lies above up, which turns the picture upside down: the order is left, "
                    "right, down, up; OpenXR's own is left, right, up, down.",
                )
            case SideAngles() as sides if sides.left > sides.right:
                return ("left lies to the right of right, which mirrors the picture.",)
        return ()

    @property
    def clip_from_camera(self) -> RationalMatrix:
        """The projection matrix as it is shown, every entry rounded once to a float64.

        Examples
        --------
        >>> float(Lens(fov_degrees=90).clip_from_camera[1][1])
        1.0
        """
        return rounded_for_display(self.exact)


def _read_measured(given: object, name: str) -> MeasuredLens:
    """Read a measured lens that is given by the names of options."""
    found = measured_lens(given, None) if isinstance(given, Mapping) else given
    if isinstance(found, MeasuredLens):
        return found
    why, names = "it is no lens as they are measured", ", ".join(_MEASURED)
    raise refused(given, name, why, f"give a dict of {names}")


def measured_lens(given: Mapping[str, Any], base: MeasuredLens | None) -> MeasuredLens | None:
    """Make a measured lens of what was given by name, if that is one; else the base stays.

    A focal length or a sensor that is given alone replaces that of the base.

    Raises
    ------
    IllegalValueError
        For a value that is illegal, or a focal length without a sensor.
    """
    if "fov_x" in given:
        return HorizontalField(float_turn(given["fov_x"], "fov_x"))
    if "intrinsics" in given:
        return Intrinsics(*vector(given["intrinsics"], "intrinsics", size=4))
    if "angles" in given:
        return SideAngles(*map(float, turns(given["angles"], "angles", size=4)))
    film = {name: given[name] for name in ("focal", "sensor") if name in given}
    if not film:
        return base
    if isinstance(base, FilmBack):
        return replace(base, **film)
    if len(film) == 1:
        (name,), missing = film, {"focal": "sensor", "sensor": "focal"}
        usual = {"focal": "50", "sensor": "36 24"}[missing[name]]
        raise IllegalValueError(
            f"{quantity(name)} alone",
            "focal length and sensor make the angle together",
            f"add {quantity(missing[name])} {usual}",
        )
    return FilmBack(**film)


def _real_or_infinity(value: object, name: str) -> float:
    return inf if isinstance(value, float) and value == inf else real(value, name)


def _read_window(given: object, name: str) -> Window:
    if isinstance(given, Window):
        return given
    return Window(*(real(side, name) for side in vector(given, name, size=4)))
