"""How the matrices of an answer come about, line by line: what `steps` adds to four commands."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import chain
from sys import maxsize

from nmatrix.enums import NormalRule, Space
from nmatrix.linear.rational import linear_part
from nmatrix.report import Block, Heading, Report, Step, Text, Vector
from nmatrix.scene.setup import Setup
from nmatrix.surds import TooManyRootsError
from nmatrix.working.determinants import cofactors
from nmatrix.working.inverses import determinant_by_cofactors, inverse_transpose
from nmatrix.working.products import product
from nmatrix.working.projection import projection_matrix
from nmatrix.working.vectors import unit
from nmatrix.working.view import view_matrix
from nmatrix.working.working import (
    NEAR,
    SHORT,
    Entry,
    Matrix,
    Notation,
    Working,
    exactly_or_near,
    middle,
    stands_for,
)
from nmatrix.working.world import world_matrix

SIX_DIGITS = "Numbers with a point show six digits of what is computed with."


@dataclass(frozen=True)
class Part:
    """The lines of one matrix or vector, and what they arrive at."""

    title: str
    steps: Sequence[Step]


def with_steps(report: Report, parts: Sequence[Part]) -> Report:
    """Add steps to an answer, at its end, in all of it and in its short form.

    Examples
    --------
    >>> line = SHORT.step("1 + 1 = 2", because="the sum", proved=True)
    >>> answer = with_steps(Report("calc", {}, ()), [Part("The sum", (line,))])
    >>> answer.data["steps"] == (line,), answer.blocks[0].text
    (True, 'The sum, step by step')
    """
    steps = tuple(chain.from_iterable(one.steps for one in parts))
    blocks = tuple(_blocks(parts))
    brief = report.brief
    if brief is not None:  # who asks for the steps has asked for more than a screen
        brief = replace(brief, blocks=(*brief.blocks, *blocks), lines=maxsize)
    return replace(
        report,
        data={**report.data, "steps": steps},
        blocks=(*report.blocks, *blocks),
        brief=brief,
    )


def _blocks(parts: Sequence[Part]) -> Iterator[Block]:
    for part in parts:
        yield Heading(f"{part.title}, step by step")
        yield from part.steps
    if any(_has_point(step) for part in parts for step in part.steps):
        yield Text(SIX_DIGITS)


def _has_point(step: Step) -> bool:
    cells = (
        (part,) if isinstance(part, str) else chain.from_iterable(part)
        for part in step.formula.parts
    )
    return any("." in text for text in chain.from_iterable(cells))


def of_world(setup: Setup) -> Sequence[Part]:
    """Work out the world matrix and its normal matrix.

    Examples
    --------
    >>> [part.title for part in of_world(Setup())]
    ['The world matrix', 'The normal matrix']
    """
    M = world_matrix(setup.world)
    return (
        Part("The world matrix", M.steps),
        *_of_normals(_block(M.value), NormalRule.EXACT, ()),
    )


def of_view(setup: Setup) -> Sequence[Part]:
    """Work out the view matrix.

    Examples
    --------
    >>> len(of_view(Setup())[0].steps)
    8
    """
    return (Part("The view matrix", view_matrix(setup.view).steps),)


def of_projection(setup: Setup) -> Sequence[Part]:
    """Work out the projection matrix.

    Examples
    --------
    >>> all(step.verified for step in of_projection(Setup())[0].steps)
    True
    """
    return (Part("The projection matrix", projection_matrix(setup.lens).steps),)


def of_normals(
    setup: Setup, space: Space, method: NormalRule, normals: Sequence[Vector]
) -> Sequence[Part]:
    """Work out the matrix that carries normals to a space by a method, and each normal.

    Examples
    --------
    >>> found = of_normals(Setup(), Space.WORLD, NormalRule.EXACT, ((0, 1, 0),))
    >>> [part.title for part in found]
    ['The normal matrix', 'Normal 1']
    """
    return _of_normals(_exact_block(setup, space), method, normals)


def _exact_block(setup: Setup, space: Space) -> Matrix:
    """Find the 3×3 block with its roots; where there are too many, or elsewhere, without."""
    with suppress(TooManyRootsError):
        if space in (Space.WORLD, Space.STATIC):
            return _block(world_matrix(setup.world).value)
        if space is Space.CAMERA:
            V, M = view_matrix(setup.view).value, world_matrix(setup.world).value
            return SHORT.product(_block(V), _block(M))
    A = linear_part(setup.maps.space_from_object(space).exact)
    return tuple(tuple(map(stands_for, row)) for row in A)


def _block(M: Matrix) -> Matrix:
    return tuple(tuple(row[:3]) for row in M[:3])


def _of_normals(A: Matrix, method: NormalRule, normals: Sequence[Vector]) -> Sequence[Part]:
    try:
        by, carrier = SHORT, _carrier(A, method, SHORT)
    except TooManyRootsError:
        A = _without_roots(A)
        by, carrier = NEAR, _carrier(A, method, NEAR)
    name = _name(method, by, A)
    return (
        Part("The normal matrix", carrier.steps),
        *(
            Part(f"Normal {i}", _carried(carrier.value, name, tuple(map(stands_for, n))))
            for i, n in enumerate(normals, 1)
        ),
    )


def _without_roots(A: Matrix) -> Matrix:
    return tuple(tuple(middle(entry) for entry in row) for row in A)


def _name(method: NormalRule, by: Notation, A: Matrix) -> str:
    if method is NormalRule.NONE:
        return "A"
    is_cofactor = method is NormalRule.COFACTOR or by.is_zero(by.determinant(A))
    return "C" if is_cofactor else "A⁻ᵀ"


def _carrier(A: Matrix, method: NormalRule, by: Notation) -> Working:
    """Work out what a method multiplies normals by; of a singular map the cofactors."""
    if method is NormalRule.NONE:
        step = by.step("A = ", A, because="the 3×3 block itself", proved=True)
        return Working((step,), A)
    if method is NormalRule.COFACTOR or by.is_zero(by.determinant(A)):
        C = cofactors(A, by=by)
        line, _ = determinant_by_cofactors(A, C.value, "A", by)
        return Working((*C.steps, line), C.value)
    return inverse_transpose(A, by=by)


def _carried(carrier: Matrix, name: str, n: Sequence[Entry]) -> Sequence[Step]:
    """Multiply a normal, and bring what comes out to length 1."""

    def carried(by: Notation) -> Working:
        rows, v = carrier, n
        if by is NEAR:
            (v,), rows = _without_roots((v,)), _without_roots(rows)
        image = product(rows, v, (name, "n"), by=by)
        if all(map(by.is_zero, image.value)):
            return image
        length = unit(image.value, "m", "n′", by)
        m = by.step("m = ", image.value, because=f"{name} n gets a name", proved=True)
        return Working((*image.steps, m, *length.steps), length.value)

    return exactly_or_near(carried).steps
