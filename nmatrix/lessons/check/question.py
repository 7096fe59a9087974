"""What is asked: one quantity of one scene; and the right answer to it, exactly.

M is `world_from_object`, V `camera_from_world`, S `space_from_world`, B the 3×3 block of S·M.
A vector is written with its w: 0 for a direction, 1 for a point.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction
from functools import lru_cache

from nmatrix.enums import Space
from nmatrix.errors import IllegalValueError, NoAnswerError, quantity
from nmatrix.linear.exact import LinearMap
from nmatrix.linear.rational import (
    ONE,
    ZERO,
    RationalMatrix,
    RationalVector,
    apply,
    identity,
    inverse,
    linear_part,
    product,
    rational_vector,
)
from nmatrix.linear.rounding import integers, unit
from nmatrix.report import Vector
from nmatrix.scene.camera import View
from nmatrix.scene.setup import Setup
from nmatrix.scene.world import World


class Subject(StrEnum):
    """What a student may be asked for."""

    WORLD = "world"
    VIEW = "view"
    PROJECTION = "projection"
    NORMAL = "normal"
    LIGHT = "light"
    EYE = "eye"


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
    """

    subject: Subject
    setup: Setup
    space: Space = Space.WORLD
    unit: bool = False
    tolerance: Fraction | None = None
    normal: Vector | None = None
    light: LightPart = LightPart.DIRECTION

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

    @property
    def is_direction(self) -> bool:
        """Whether a vector without a place is asked for."""
        if self.subject is Subject.NORMAL:
            return self.normal is not None
        return self.subject is Subject.LIGHT and self.light is LightPart.DIRECTION

    @property
    def is_vector(self) -> bool:
        """Whether a direction or a point is asked for, not a matrix."""
        return self.is_direction or self.subject in (Subject.LIGHT, Subject.EYE)

    @property
    def any_length(self) -> bool:
        """Whether the answer counts up to a positive factor."""
        return not self.unit and (self.is_direction or self.subject is Subject.NORMAL)


@dataclass(frozen=True)
class Matrices:
    """The matrices that an answer is computed from; a mistake may replace one of them."""

    world_from_object: RationalMatrix
    camera_from_world: RationalMatrix
    space_from_world: RationalMatrix

    @property
    def space_from_object(self) -> RationalMatrix:
        """S·M."""
        return product(self.space_from_world, self.world_from_object)


def right_matrices(question: Question) -> Matrices:
    """Build M, V and S as they should be.

    Raises
    ------
    NoAnswerError
        Where the space does not exist, as object space of a singular world matrix.
    """
    M = _world_from_object(question.setup.world)
    V = _camera_from_world(question.setup.view)
    return Matrices(M, V, _space_from_world(question, M, V))


@lru_cache(maxsize=256)  # two mistakes at once leave most of a scene as one of them does
def _world_from_object(world: World) -> RationalMatrix:
    return world.world_from_object


@lru_cache(maxsize=64)
def _camera_from_world(view: View) -> RationalMatrix:
    return view.placed().camera_from_world


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
    S = by.space_from_world
    if question.subject is Subject.WORLD:
        return by.world_from_object
    if question.subject is Subject.VIEW:
        return by.camera_from_world
    if question.subject is Subject.PROJECTION:
        return question.setup.lens.clip_from_camera
    if question.subject is Subject.EYE:
        return (apply(S, (*question.setup.camera.eye, ONE)),)
    if question.subject is Subject.LIGHT:
        return (apply(S, light_vector(question)),)
    return _normal(question, LinearMap.of(linear_part(by.space_from_object)))


def light_vector(question: Question) -> RationalVector:
    """Take the light's direction or position in world space, with its w.

    Raises
    ------
    IllegalValueError
        If the light has no such part.
    """
    light = question.setup.light.placed()
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
    return ((*rational_vector(unit(integers(direction)[0])), w),)


def _normal(question: Question, linear_map: LinearMap) -> RationalMatrix:
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
