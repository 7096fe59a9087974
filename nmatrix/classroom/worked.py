"""The numbers of a scene in steps: its matrices, one normal on its way, and where A would lead.

n and t are a normal and a tangent of the object; A the 3×3 block of the world matrix M, C its
cofactors.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from fractions import Fraction
from functools import partial
from typing import TYPE_CHECKING

from nmatrix.enums import Space
from nmatrix.errors import NoAnswerError
from nmatrix.linear.rational import RationalVector
from nmatrix.report import Block, Cells, Heading, Table, Text
from nmatrix.spaces.light_and_eye import light_in
from nmatrix.surds import TooManyRootsError
from nmatrix.working.determinants import cofactors
from nmatrix.working.inverses import determinant_by_cofactors, inverse_transpose
from nmatrix.working.vectors import dot
from nmatrix.working.working import Matrix, Notation, middle, short, stands_for

if TYPE_CHECKING:
    from nmatrix.scene.setup import Setup

SHOWN_SPACES = (Space.OBJECT, Space.WORLD, Space.CAMERA)
DIGITS = 4  # of a number that is no short fraction or root
BY = Notation(partial(short, digits=DIGITS))
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
    M, V = maps.world_from_object.exact, maps.camera_from_world.exact
    try:
        numbers = tuple(_numbers(setup, _with_roots(M), _with_roots(V)))
    except TooManyRootsError:
        numbers = tuple(_numbers(setup, M, V))
    return (*numbers, _light_and_eye(setup))


def _with_roots(matrix: Matrix) -> Matrix:
    return tuple(tuple(map(stands_for, row)) for row in matrix)


def _numbers(setup: Setup, M: Matrix, V: Matrix) -> Iterator[Block]:
    A = tuple(tuple(row[:3]) for row in M[:3])
    yield Heading("The numbers of this scene, step by step")
    yield Text("1. The world matrix M, and its 3×3 block A, which leaves the translation out:")
    yield BY.formula("M = ", M, ",  A = ", A)
    yield from _normal_matrix(A)
    yield from _one_normal(setup, A)
    yield Text("The camera:")
    yield BY.formula("V = ", V)


def _normal_matrix(A: Matrix) -> Iterator[Block]:
    """Write the lines of the inverse transpose: cofactors, determinant, their quotient, a check."""
    yield Text("2. The cofactors C of A, and its determinant:")
    C = cofactors(A, by=BY, shown=False)
    line, det = determinant_by_cofactors(A, C.value, "A", BY)
    if BY.is_zero(det):
        yield from (step.formula for step in (*C.steps, line))
        yield Text("3. The determinant is 0: A flattens and has no inverse. C takes its place.")
        return
    *others, quotient, check = inverse_transpose(A, by=BY).steps[1:]
    yield from (step.formula for step in others)
    yield Text("3. The normal matrix is C over the determinant; the check gives I:")
    yield from (step.formula for step in (quotient, check))


def _one_normal(setup: Setup, A: Matrix) -> Iterator[Block]:
    """Carry the pair of a normal and a tangent on which A itself does worst."""
    C, det = cofactors(A, by=BY).value, BY.determinant(A)
    by, letter = (C, "C") if BY.is_zero(det) else (inverse_transpose(A, by=BY).value, "A⁻ᵀ")

    def lean(pair: tuple[RationalVector, RationalVector]) -> tuple[bool, Fraction]:
        n, t = pair
        wrong = BY.dot(BY.apply(A, n), BY.apply(A, t))
        return any(BY.apply(by, n)), abs(middle(wrong))

    n, t = max(PAIRS, key=lean)
    moved, right, wrong = BY.apply(A, t), BY.apply(by, n), BY.apply(A, n)
    yield Text("4. One normal n and one tangent t of the object, for which n · t = 0:")
    yield BY.formula("n = ", n, ",  t = ", t, ",  A t = ", moved)
    if all(map(BY.is_zero, right)):
        yield Text("C n is 0 for every n: A leaves a line or a point, which has no normal.")
        return
    yield BY.formula(f"{letter} n = ", right, ",  A n = ", wrong)
    yield Text(f"5. The right angle: {letter} n keeps it.")
    lines = (
        dot(right, moved, (f"({letter} n)", "(A t)"), BY),
        dot(wrong, moved, ("(A n)", "(A t)"), BY),
    )
    yield from (step.formula for one in lines for step in one.steps[2:])
    if BY.is_zero(det):
        return
    angle = setup.maps.world_from_object.linear_map.angle_without_deg(n)
    if angle is not None and not BY.is_zero(lines[1].value):
        yield Text(f"A n leans {short(Fraction(angle), DIGITS)}° away from {letter} n.")
    else:
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


def _in_a_row(vector: Sequence[float | Fraction]) -> str:
    return f"({', '.join(short(Fraction(x), DIGITS) for x in vector)})"
