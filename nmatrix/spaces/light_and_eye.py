"""Lights and the eye as a space sees them: directions as vectors, positions as points.

B is the 3×3 block of S = `space_from_world`. A light direction is a vector and moves by B; the
course's rule moves it by B⁻ᵀ, as if it were a normal. They agree when B is a rotation or a
mirror, and up to length when it scales alike everywhere. Numbers stay exact until a writer rounds.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from math import isfinite, nan
from operator import add, mul

from nmatrix.enums import Space
from nmatrix.errors import IllegalValueError
from nmatrix.linear import rational
from nmatrix.linear.angle import DEGREES, exact_angle_between
from nmatrix.linear.rational import RationalMatrix, RationalVector
from nmatrix.linear.rounding import integers, nearest, over_root_of_any_size, unit
from nmatrix.spaces.exact_maps import ExactMaps

Three = tuple[float, ...]


@dataclass(frozen=True)
class LightInSpace:
    """One light in one space; what the light does not have is None."""

    space: Space
    space_from_world: RationalMatrix
    direction: Three | None
    direction_unnormalised: RationalVector | None
    direction_course_rule: Three | None
    rules_differ_deg: float | None
    position: RationalVector | None


@dataclass(frozen=True)
class EyeInSpace:
    """The eye in one space, and what the course's float64 formula makes of it."""

    space: Space
    eye: RationalVector
    eye_by_inverse_mv: Three | None
    relative_difference: Fraction | None


def light_in(maps: ExactMaps, space: Space) -> LightInSpace:
    """Bring the light into a space, by the vector rule and by the course's.

    Examples
    --------
    >>> # A light from above, seen by an object that is twice as tall: the vector rule halves y,
    >>> # the course's rule doubles it.
    >>> from nmatrix.scene.setup import Light, Setup
    >>> from nmatrix.scene.world import World
    >>> tall = Setup(World(scale=(1, 2, 1)), light=Light(direction=(1, -1, 0)))
    >>> seen = light_in(tall.maps, Space.OBJECT)
    >>> [float(component) for component in seen.direction_unnormalised]
    [1.0, -0.5, 0.0]
    """
    space_from_world = maps.space_from_world(space)
    d, p = maps.light.direction, maps.light.position
    moved = None if d is None else space_from_world.exact_vector(d)
    course = None if d is None else _course_rule(rational.linear_part(space_from_world.exact), d)
    return LightInSpace(
        space=space,
        space_from_world=space_from_world.exact,
        direction=_unit(moved),
        direction_unnormalised=moved,
        direction_course_rule=_unit(course),
        rules_differ_deg=_degrees_between(moved, course),
        position=None if p is None else space_from_world.exact_point(p),
    )


def eye_in(maps: ExactMaps, space: Space) -> EyeInSpace:
    """Bring the eye into a space, exactly and by the course's formula.

    The course inverts the product V·M in floats and reads the last column; with a translation t
    that loses |t|/|x| units in the last place.
    """
    exact = maps.eye_in(space)
    course = _eye_by_inverse(maps, space)
    return EyeInSpace(
        space=space,
        eye=exact,
        eye_by_inverse_mv=course,
        relative_difference=None if course is None else _relative(exact, course),
    )


def _course_rule(B: RationalMatrix, direction: RationalVector) -> RationalVector:
    return rational.apply(rational.inverse_transpose(B), direction)


def _eye_by_inverse(maps: ExactMaps, space: Space) -> Three | None:
    try:
        V = maps.camera_from_world.matrix
        world_from_space = maps.space_from_world(space).inverse().matrix
    except IllegalValueError:  # an entry beyond float64, which such a program cannot hold
        return None
    columns = list(zip(*world_from_space, strict=True))
    MV = [[_float_dot(row, column) for column in columns] for row in V]
    found = _last_column_of_inverse(MV)
    return found[:3] if all(map(isfinite, found)) else None


def _last_column_of_inverse(A: Sequence[Sequence[float]]) -> Three:
    """Solve A x = e by Gaussian elimination with partial pivoting, as float64 programs do.

    Examples
    --------
    >>> _last_column_of_inverse([[1.0, 0, 3], [0, 2.0, 4], [0, 0, 1.0]])
    (-3.0, -2.0, 1.0)
    >>> _last_column_of_inverse([[1.0, 1.0], [1.0, 1.0]])
    (nan, nan)
    """
    size = len(A)
    rows = [[*row, float(i == size - 1)] for i, row in enumerate(A)]
    for i in range(size):
        pivot = max(range(i, size), key=lambda row: abs(rows[row][i]))
        if rows[pivot][i] == 0:
            return (nan,) * size
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for row in rows[i + 1 :]:
            factor = row[i] / rows[i][i]
            row[i:] = [
                one - factor * other for one, other in zip(row[i:], rows[i][i:], strict=True)
            ]
    x = [0.0] * size
    for i in reversed(range(size)):
        known = _float_dot(rows[i][i + 1 : size], x[i + 1 :])
        x[i] = (rows[i][size] - known) / rows[i][i]
    return tuple(x)


def _float_dot(a: Iterable[float], b: Iterable[float]) -> float:
    """Add products from the left, each rounded; `sum` rounds otherwise from Python 3.12 on."""
    return reduce(add, map(mul, a, b), 0.0)


def _relative(exact: RationalVector, course: Three) -> Fraction | None:
    difference = [Fraction(c) - e for c, e in zip(course, exact, strict=True)]
    error, size = rational.dot(difference, difference), rational.dot(exact, exact)
    if error == 0:
        return error
    if size == 0:
        return None
    square = error / size
    return over_root_of_any_size(square.numerator, square.numerator * square.denominator)


def _unit(v: RationalVector | None) -> Three | None:
    return None if v is None else unit(integers(v)[0])


def _degrees_between(a: RationalVector | None, b: RationalVector | None) -> float | None:
    if a is None or b is None:
        return None
    return nearest(exact_angle_between(integers(a)[0], integers(b)[0]) * DEGREES)
