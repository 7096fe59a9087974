"""What is asked: one quantity of one scene; and the right answer to it, exactly.

M is `world_from_object`, V `camera_from_world`, S `space_from_world`, B the 3×3 block of S·M.
A vector is written with its w: 0 for a direction, 1 for a point.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction
from functools import cached_property, lru_cache
from math import cos, hypot, radians, sin
from typing import TYPE_CHECKING, Any

from nmatrix.enums import Space
from nmatrix.errors import IllegalValueError, NoAnswerError, quantity
from nmatrix.linear.angle import Angle
from nmatrix.linear.exact import LinearMap
from nmatrix.linear.rational import (
    ONE,
    ZERO,
    RationalMatrix,
    RationalVector,
    apply,
    determinant,
    identity,
    inverse,
    inverse_transpose,
    linear_part,
    numbers_in_floats,
    numbers_like,
    product,
    rational_vector,
    translation,
)
from nmatrix.linear.rounding import integers, unit
from nmatrix.linear.viewport import Viewport, window_from_ndc
from nmatrix.report import Number, Vector
from nmatrix.scene.camera import PlacedCamera, View
from nmatrix.scene.lens import Lens
from nmatrix.scene.setup import Light, Setup
from nmatrix.scene.world import World
from nmatrix.spaces.exact_maps import WorldLight

if TYPE_CHECKING:
    from nmatrix.linear.axes import AxisChange

FARTHEST = 100_000  # of places, for a first look in floats
TURN = 360
TINY = 1e-9  # a w that may be what floats left of 0
STEEP = Fraction(1, 10**6)  # of a determinant to the cube of the largest entry


class Subject(StrEnum):
    """What a student may be asked for."""

    WORLD = "world"
    VIEW = "view"
    PROJECTION = "projection"
    NORMAL = "normal"
    LIGHT = "light"
    EYE = "eye"
    TRACE = "trace"
    AXES = "axes"


class LightPart(StrEnum):
    """Which part of a light is meant."""

    DIRECTION = "direction"
    POSITION = "position"


@dataclass(frozen=True)
class Question:
    """One quantity of a scene.

    Parameters
    ----------
    subject, setup, space
        What is asked for, of which scene, in which space.
    unit
        Whether a unit vector is asked for, or the inverse transpose itself and no multiple of it.
    tolerance
        How far an entry may be off, in place of the digits given.
    normal
        A normal to carry, in object space; without one the normal matrix is asked for.
    light
        Which part of the light; needed where the light has both.
    point, window
        The vertex to trace, in object space, into normalised device coordinates or into a window.
    axes
        The axis systems: their F is asked for, or with a world matrix M, F · M · F⁻¹.
    """

    subject: Subject
    setup: Setup
    space: Space = Space.WORLD
    unit: bool = False
    tolerance: Fraction | None = None
    normal: Vector | None = None
    light: LightPart = LightPart.DIRECTION
    point: Vector = (0, 0, 0)
    window: Viewport | None = None
    axes: AxisChange | None = None

    def __post_init__(self) -> None:
        if self.tolerance is not None and self.tolerance < 0:
            raise IllegalValueError(
                f"{quantity('tolerance')} ({float(self.tolerance):g})",
                "it is not negative",
                "try 0.001",
            )
        if self.unit and not self.is_direction and self.subject is not Subject.NORMAL:
            raise IllegalValueError(
                f"{quantity('unit')} with {self.subject}",
                "only a direction has a length to bring to 1",
                "leave it out",
            )
        if self.subject is Subject.AXES and self.axes is None:
            raise IllegalValueError(
                "check axes",
                "it compares a way between two axis systems",
                "name both, such as from blender to opengl",
            )

    @cached_property
    def is_direction(self) -> bool:
        """Whether a vector without a place is asked for."""
        if self.subject is Subject.NORMAL:
            return self.normal is not None
        return self.subject is Subject.LIGHT and self.light is LightPart.DIRECTION

    @cached_property
    def is_vector(self) -> bool:
        """Whether a direction or a point is asked for, not a matrix."""
        return self.is_direction or self.subject in (Subject.LIGHT, Subject.EYE, Subject.TRACE)

    @cached_property
    def is_point(self) -> bool:
        """Whether a place is asked for, of which any w but 0 counts."""
        return self.is_vector and not self.is_direction and self.subject is not Subject.TRACE

    @cached_property
    def parts(self) -> tuple[str, ...]:
        """The parts of the scene that the answer, or a wrong matrix in its place, depends on."""
        subject = self.subject
        if subject is Subject.PROJECTION:
            return ("lens",)
        if subject is Subject.VIEW:
            return ("view",)
        if subject is Subject.TRACE:
            return ("world", "view", "lens")
        if self.asks_for_way:
            return ()
        seen = ("view",) if self.space is Space.CAMERA else ()
        lit = ("light",) if subject is Subject.LIGHT or self.space is Space.LIGHT else ()
        return ("world", *seen, *lit)

    @cached_property
    def asks_for_way(self) -> bool:
        """Whether the way between two axis systems is asked for, and no matrix told by it."""
        return self.subject is Subject.AXES and self.setup.world == World()

    @cached_property
    def any_length(self) -> bool:
        """Whether the answer counts up to a positive factor."""
        return not self.unit and (self.is_direction or self.subject is Subject.NORMAL)


@dataclass(frozen=True, eq=False)
class Matrices:
    """The matrices that an answer is computed from; a mistake may replace one of them.

    Their entries are exact, or floats for a first look: the same functions take both.
    """

    world_from_object: RationalMatrix
    camera_from_world: RationalMatrix
    space_from_world: RationalMatrix
    clip_from_camera: RationalMatrix

    @property
    def space_from_object(self) -> RationalMatrix:
        """S·M."""
        return product(self.space_from_world, self.world_from_object)


def right_matrices(question: Question) -> Matrices:
    """Build M, V, S and P as they should be.

    Raises
    ------
    NoAnswerError
        Where the space does not exist, as object space of a singular world matrix.
    """
    setup, subject = question.setup, question.subject
    M = identity(4) if subject is Subject.PROJECTION else _world_from_object(setup.world)
    V = identity(4) if subject is Subject.PROJECTION else _camera_from_world(setup.view)
    projects = subject in (Subject.PROJECTION, Subject.TRACE)
    P = _clip_from_camera(setup.lens) if projects else identity(4)
    return Matrices(M, V, _space_from_world(question, M, V), P)


FloatsOf = Callable[[Callable[[Any], RationalMatrix], Any], RationalMatrix]


def float_matrices(question: Question, floats_of: FloatsOf) -> Matrices:
    """Build M, V, S and P of floats, a few units of their last place off.

    `floats_of` calls a builder with a part of the scene, unless it remembers what that gave.

    Raises
    ------
    ArithmeticError, NMatrixError
        Where the space does not exist, or floats do not tell.
    """
    setup, subject, space = question.setup, question.subject, question.space
    if subject is Subject.PROJECTION:
        return Matrices(IN_FLOATS, IN_FLOATS, IN_FLOATS, floats_of(_float_lens, setup.lens))
    M, V = floats_of(_float_world, setup.world), floats_of(_float_view, setup.view)
    P = floats_of(_float_lens, setup.lens) if subject is Subject.TRACE else IN_FLOATS
    if space in (Space.WORLD, Space.STATIC):
        S = IN_FLOATS
    elif space is Space.CAMERA:
        S = V
    elif space is Space.OBJECT:
        S = inverse(M)
    else:
        S = _floats(setup.maps.space_from_world(space).exact)
    return Matrices(M, V, S, P)


def is_of_usual_size(question: Question) -> bool:
    """Decide if floats tell answers apart: nothing is far away, and no flat map is inverted."""
    try:
        at = right_matrices(question)
        places = [eye_of(question.setup.view), rational_vector(question.point)]
        places += [translation(at.world_from_object), translation(at.camera_from_world)]
        places += [
            rational_vector(question.normal or ()),
            rational_vector(question.setup.view.target),
        ]
        if question.subject is Subject.LIGHT:
            places.append(light_vector(question))
    except NoAnswerError:
        return False
    block = linear_part(at.world_from_object)
    largest = max(abs(entry) for row in block for entry in row)
    if largest >= FARTHEST or any(abs(x) >= FARTHEST for place in places for x in place):
        return False
    is_inverted = question.subject is Subject.NORMAL or question.space is Space.OBJECT
    return not is_inverted or abs(determinant(block)) > STEEP * largest**3


def _floats(A: RationalMatrix) -> RationalMatrix:
    return A if isinstance(A[0][0], float) else tuple(numbers_in_floats(row) for row in A)


IN_FLOATS = _floats(identity(4))


@lru_cache(maxsize=256)  # two mistakes at once leave most of a scene as one of them does
def _world_from_object(world: World) -> RationalMatrix:
    return world.world_from_object


def _camera_from_world(view: View) -> RationalMatrix:
    return _placed(view).camera_from_world


@lru_cache(maxsize=64)
def _placed(view: View) -> PlacedCamera:
    return view.placed()


@lru_cache(maxsize=64)
def _placed_light(light: Light) -> WorldLight:
    return light.placed()


@lru_cache(maxsize=64)
def _clip_from_camera(lens: Lens) -> RationalMatrix:
    return lens.clip_from_camera


def _float_world(world: World) -> RationalMatrix:
    return _floats(world.matrix or world.exact_by(_float_angle))


def _float_view(view: View) -> RationalMatrix:
    found = view.by_angles(_float_angle) if view.angles else _camera_from_world(view)
    return _floats(found)


def _float_lens(lens: Lens) -> RationalMatrix:
    return _floats(lens.exact)


@lru_cache(maxsize=256)
def _float_angle(degrees: Number) -> Angle:
    turned = radians(degrees % TURN)  # exactly, or a huge angle would turn by noise
    return Angle(sin(turned), cos(turned))  # type: ignore[arg-type]  # sums and products will do


def _space_from_world(question: Question, M: RationalMatrix, V: RationalMatrix) -> RationalMatrix:
    """Build S; the exact maps, which also build the projection, only where they must be asked."""
    space = question.space
    if space in (Space.WORLD, Space.STATIC):
        return identity(4)
    if space is Space.CAMERA:
        return V
    if space is Space.OBJECT and LinearMap.of(linear_part(M)).integer_determinant:
        return inverse(M)
    return question.setup.maps.space_from_world(space).exact


def right_answer(question: Question) -> RationalMatrix:
    """Compute the right answer exactly: a matrix, or a vector as one row x, y, z, w.

    Raises
    ------
    NoAnswerError
        Where there is none: the normal matrix of a singular map, a normal that vanishes.

    Examples
    --------
    >>> from nmatrix.scene.world import World
    >>> tall = Setup(World(scale=(1, 2, 1)))
    >>> right_answer(Question(Subject.NORMAL, tall))[1][1]
    Fraction(1, 2)
    """
    if question.subject is Subject.EYE:
        return ((*question.setup.maps.eye_in(question.space), ONE),)
    return finished(question, raw_answer(question, right_matrices(question)))


def raw_answer(question: Question, by: Matrices) -> RationalMatrix:
    """Compute the answer of these matrices before a direction is brought to length one."""
    return _ANSWERS[question.subject](question, by)


def _moved_eye(question: Question, by: Matrices) -> RationalMatrix:
    S = by.space_from_world
    return (apply(S, numbers_like(S, (*eye_of(question.setup.view), ONE))),)


def _moved_light(question: Question, by: Matrices) -> RationalMatrix:
    S = by.space_from_world
    return (apply(S, numbers_like(S, light_vector(question))),)


def eye_of(view: View) -> RationalVector:
    """Take the eye in world space: as it was given, or out of the camera's matrix."""
    return rational_vector(view.eye) if view.typed_matrix is None else _placed(view).eye


def clip_point(question: Question, by: Matrices) -> RationalVector:
    """Take the vertex to clip space, undivided."""
    M = by.world_from_object
    world = apply(M, numbers_like(M, (*question.point, ONE)))
    return apply(by.clip_from_camera, apply(by.camera_from_world, world))


def traced(question: Question, by: Matrices) -> RationalVector:
    """Take the vertex to normalised device coordinates, or to the window, with w = 1.

    Raises
    ------
    NoAnswerError
        For a vertex that is not in front of the eye.
    """
    x, y, z, w = clip_point(question, by)
    if isinstance(w, float) and abs(w) < TINY:
        raise ArithmeticError("floats do not tell on which side of the eye it is")
    if w <= 0:
        raise NoAnswerError(
            f"clip w ({float(w):g})", "the vertex is not in front of the eye", "move it or the eye"
        )
    return in_window(question, (x / w, y / w, z / w, ONE))


def in_window(question: Question, ndc: RationalVector) -> RationalVector:
    """Take normalised device coordinates to the window, if that is asked for."""
    if question.window is None:
        return ndc
    size = question.window
    return apply(window_from_ndc(size.width, size.height, question.setup.lens.clip), ndc)


def _told_in_other_axes(question: Question, by: Matrices) -> RationalMatrix:
    """Take F, or F · M · F⁻¹."""
    F, back = way_between(question, by)
    return F if question.asks_for_way else product(F, by.world_from_object, back)


def way_between(question: Question, by: Matrices) -> tuple[RationalMatrix, RationalMatrix]:
    """Take F, from one axis system to the other, and F⁻¹."""
    assert question.axes is not None  # a question of axes has them
    F, back = _there_and_back(question.axes)
    if isinstance(by.world_from_object[0][0], float):
        return _floats(F), _floats(back)
    return F, back


@lru_cache(maxsize=8)
def _there_and_back(axes: AxisChange) -> tuple[RationalMatrix, RationalMatrix]:
    return axes.to_from, inverse(axes.to_from)


def light_vector(question: Question) -> RationalVector:
    """Take the light's direction or position in world space, with its w.

    Raises
    ------
    IllegalValueError
        If the light has no such part.
    """
    light = _placed_light(question.setup.light)
    part = light.direction if question.light is LightPart.DIRECTION else light.position
    if part is None:
        raise IllegalValueError(
            f"light {question.light}",
            "this light has none",
            f"give {quantity(f'light_{question.light}')} X Y Z",
        )
    return (*part, ZERO if question.light is LightPart.DIRECTION else ONE)


def finished(question: Question, raw: RationalMatrix) -> RationalMatrix:
    """Bring a direction to length one, if a unit vector is asked for."""
    if not question.unit or not question.is_vector:
        return raw
    *direction, w = raw[0]
    if not any(direction):
        return raw
    if isinstance(direction[0], float):
        length = hypot(*direction)
        return ((*(x / length for x in direction), w),)
    return ((*rational_vector(unit(integers(direction)[0])), w),)


def _normal(question: Question, by: Matrices) -> RationalMatrix:
    block = linear_part(by.space_from_object)
    if isinstance(block[0][0], float):
        N = inverse_transpose(block)
        if question.normal is None:
            return N
        return ((*apply(N, numbers_like(N, question.normal)), ZERO),)
    linear_map = LinearMap.of(block)
    if question.normal is None:
        return linear_map.inverse_transpose
    n = rational_vector(question.normal)
    found = linear_map.normal(n)
    if found.direction is None:
        raise NoAnswerError(
            f"normal ({' '.join(f'{float(x):g}' for x in n)})", found.reason, "choose another one"
        )
    flattens = not linear_map.integer_determinant
    N = linear_map.cofactor_matrix if flattens else linear_map.inverse_transpose
    return ((*apply(N, n), ZERO),)


_ANSWERS: Mapping[Subject, Callable[[Question, Matrices], RationalMatrix]] = {
    Subject.WORLD: lambda _, by: by.world_from_object,
    Subject.VIEW: lambda _, by: by.camera_from_world,
    Subject.PROJECTION: lambda _, by: by.clip_from_camera,
    Subject.NORMAL: _normal,
    Subject.LIGHT: _moved_light,
    Subject.EYE: _moved_eye,
    Subject.TRACE: lambda question, by: (traced(question, by),),
    Subject.AXES: _told_in_other_axes,
}
