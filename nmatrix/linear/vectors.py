"""Unit vectors and angles for single vectors, right for every finite length, tiny or huge."""

from __future__ import annotations

from collections.abc import Sequence
from math import isfinite

from nmatrix.errors import IllegalValueError, NoAnswerError
from nmatrix.linear import rounding
from nmatrix.linear.angle import Angle, exact_angle_between
from nmatrix.linear.rounding import integers, nearest


def normalize(vector: Sequence[float]) -> tuple[float, ...]:
    """Return the vector at length one, every component correctly rounded.

    The components are integers over one power of two, so nothing over- or underflows, from
    5e-324 to 1.7e308.

    Raises
    ------
    NoAnswerError
        For the zero vector.
    IllegalValueError
        For a component that is not finite.

    Examples
    --------
    >>> normalize((3e-320, 4e-320, 0.0))
    (0.6, 0.8, 0.0)
    """
    return rounding.unit(_direction(vector))


def angle_between(a: Sequence[float], b: Sequence[float]) -> float:
    """Return the angle between two vectors in radians, correctly rounded.

    Raises
    ------
    NoAnswerError
        If one of them is the zero vector.

    Examples
    --------
    >>> angle_between((1, 0, 0), (1, 1e-200, 0))
    1e-200
    """
    return nearest(exact_angle_between(_direction(a), _direction(b)))


def direction_from_angles(alpha: Angle, beta: Angle) -> tuple[float, ...]:
    """Return the unit direction (cos α cos β, sin α, cos α sin β), each component rounded once.

    Examples
    --------
    >>> direction_from_angles(Angle.degrees(-60), Angle.degrees(-120))
    (-0.25, -0.8660254037844386, -0.4330127018922193)
    """
    exact = (alpha.cosine * beta.cosine, alpha.sine, alpha.cosine * beta.sine)
    return tuple(map(nearest, exact))


def _direction(vector: Sequence[float]) -> list[int]:
    if not all(map(isfinite, vector)):
        raise IllegalValueError(
            f"vector ({' '.join(map(str, vector))})",
            "a component is not a finite number",
            "use finite components",
        )
    direction, _ = integers(vector)
    if not any(direction):
        raise NoAnswerError(
            f"vector ({' '.join('0' for _ in direction)})",
            "it has length zero and no direction",
            "give one non-zero component",
        )
    return direction
