"""The numbers of a scene in steps: its matrices, one normal on its way, and where A would lead.

n and t are a normal and a tangent of the object; A the 3×3 block of the world matrix M, C its
cofactors.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from fractions import Fraction
from typing import TYPE_CHECKING

from nmatrix.enums import Space
from nmatrix.errors import NoAnswerError
from nmatrix.lessons.notation import LARGEST_BOTTOM, written
from nmatrix.linear.rational import (
    RationalMatrix,
    RationalVector,
    apply,
    cofactor_matrix,
    determinant,
    dot,
    linear_part,
    scaled,
)
from nmatrix.linear.rounding import short_text
from nmatrix.report import Block, Cells, Formula, Heading, Table, Text
from nmatrix.spaces.light_and_eye import light_in

if TYPE_CHECKING:
    from nmatrix.scene.setup import Setup

SHOWN_SPACES = (Space.OBJECT, Space.WORLD, Space.CAMERA)
DIGITS = 4  # of a number that is no short fraction
LARGEST_TOP = 10**6  # of a number that is written out
_POWER = re.compile(r"\^(−?[0-9]+)")
_SMALL = str.maketrans("−0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
PAIRS = tuple(
    (tuple(map(Fraction, n)), tuple(map(Fraction, t)))
    for n, t in (
        ((1, 1, 0), (1, -1, 0)),
        ((1, 0, 1), (1, 0, -1)),
        ((0, 1, 1), (0, 1, -1)),
        ((1, 0, 0), (0, 1, 0)),
        ((0, 1, 0), (0, 0, 1)),
    )
)


def in_each(spaces: Iterable[Space], row: Callable[[Space], Cells]) -> tuple[Cells, ...]:
    """Make a row for each space that there is: a flattened world has no object space."""
    rows = []
    for space in spaces:
        with suppress(NoAnswerError):
            rows.append(row(space))
    return tuple(rows)


def worked(setup: Setup) -> tuple[Block, ...]:
    """Take one normal through the given scene, and its light and eye through the spaces."""
    maps = setup.maps
    M = maps.world_from_object.exact
    return (
        Heading("The numbers of this scene, step by step"),
        Text("1. The world matrix M, and its 3×3 block A, which leaves the translation out:"),
        _shown("M = ", M, ",  A = ", linear_part(M)),
        *_normal_matrix(linear_part(M)),
        *_one_normal(setup, linear_part(M)),
        Text("The camera:"),
        _shown("V = ", maps.camera_from_world.exact),
        _light_and_eye(setup),
    )


def _normal_matrix(A: RationalMatrix) -> Iterator[Block]:
    C, det = cofactor_matrix(A), determinant(A)
    yield Text("2. The cofactors C of A, and its determinant:")
    yield _shown("C = ", C, ",  det A = ", det)
    if det:
        yield Text("3. The normal matrix is C over the determinant:")
        yield _shown("A⁻ᵀ = C / det A = ", scaled(C, 1 / det))
    else:
        yield Text("3. The determinant is 0: A flattens and has no inverse. C takes its place.")


def _one_normal(setup: Setup, A: RationalMatrix) -> Iterator[Block]:
    """Carry the pair of a normal and a tangent on which A itself does worst."""
    C, det = cofactor_matrix(A), determinant(A)
    by, letter = (scaled(C, 1 / det), "A⁻ᵀ") if det else (C, "C")

    def lean(pair: tuple[RationalVector, RationalVector]) -> tuple[bool, Fraction]:
        n, t = pair
        return any(apply(by, n)), abs(dot(apply(A, n), apply(A, t)))

    n, t = max(PAIRS, key=lean)
    moved, Ct, wrong = apply(A, t), apply(by, n), apply(A, n)
    yield Text("4. One normal n and one tangent t of the object, for which n · t = 0:")
    yield _shown("n = ", _column(n), ",  t = ", _column(t), ",  A t = ", _column(moved))
    if not any(Ct):
        yield Text("C n is 0 for every n: A leaves a line or a point, which has no normal.")
        return
    yield _shown(f"{letter} n = ", _column(Ct), ",  A n = ", _column(wrong))
    yield Text(f"5. The right angle: {letter} n keeps it.")
    yield _shown(
        f"({letter} n) · (A t) = ", dot(Ct, moved), ",  (A n) · (A t) = ", dot(wrong, moved)
    )
    angle = setup.maps.world_from_object.linear_map.angle_without_deg(n) if det else None
    if angle is not None and dot(wrong, moved):
        yield Text(f"A n leans {_in_words(Fraction(angle))}° away from {letter} n.")
    elif det:
        yield Text("Here A n keeps it as well.")


def _light_and_eye(setup: Setup) -> Table:
    """Tabulate the light and the eye in each space that there is."""
    maps = setup.maps
    light = maps.light
    columns = ["space"]
    columns += ["l, to the light, length 1"] * (light.direction is not None)
    columns += ["the lamp"] * (light.position is not None)

    def row(space: Space) -> Cells:
        found = light_in(maps, space)
        towards = None if found.direction is None else tuple(-x for x in found.direction)
        there = (one for one in (towards, found.position) if one is not None)
        return (space.value, *map(_in_a_row, (*there, maps.eye_in(space))))

    rows = in_each(SHOWN_SPACES, row)
    return Table((*columns, "e, the eye"), rows, "The light and the eye, space by space")


def _shown(*parts: str | Fraction | RationalMatrix) -> Formula:
    """Put words, numbers and matrices side by side, in short numbers."""
    return Formula(tuple(_part(one) for one in parts))


def _part(part: str | Fraction | RationalMatrix) -> str | tuple[tuple[str, ...], ...]:
    if isinstance(part, str):
        return part
    if isinstance(part, Fraction):
        return _short(part)
    return tuple(tuple(map(_short, row)) for row in part)


def _short(x: Fraction) -> str:
    """Write a short fraction as it is, and any other number in four digits.

    Examples
    --------
    >>> _short(Fraction(-1, 2)), _short(Fraction(2, 3001)), _short(Fraction(10) ** 400)
    ('−1/2', '0.0006664', '10^400')
    """
    if x.denominator <= LARGEST_BOTTOM and abs(x) < LARGEST_TOP:
        return written(x)
    mantissa, mark, exponent = short_text(x, DIGITS).replace("-", "−").partition("e")
    if not mark:
        return mantissa
    power = f"10^{exponent.removeprefix('+').replace('−0', '−').lstrip('0')}"
    return power.join(mantissa.rsplit("1", 1)) if mantissa in ("1", "−1") else f"{mantissa}·{power}"


def _column(v: Sequence[Fraction]) -> RationalMatrix:
    return tuple((x,) for x in v)


def _in_a_row(vector: Sequence[float | Fraction]) -> str:
    return f"({', '.join(_in_words(Fraction(x)) for x in vector)})"


def _in_words(x: Fraction) -> str:
    """Write a number in a sentence or a cell.

    Examples
    --------
    >>> _in_words(Fraction(-3, 10**8))
    '−3·10⁻⁸'
    """
    return _POWER.sub(lambda power: power[1].translate(_SMALL), _short(x))
