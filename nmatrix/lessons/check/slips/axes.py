"""Mistakes with axis systems: F on both sides, on one side, and y for z.

F tells vectors of one system in the other; a matrix M between two frames becomes F · M · F⁻¹.
"""

from __future__ import annotations

from itertools import product as choices

from nmatrix.lessons.check.computation import Rule
from nmatrix.lessons.check.question import Matrices, Question, Subject, raw_answer, way_between
from nmatrix.lessons.check.slips.view import Z, with_negated
from nmatrix.linear.rational import RationalMatrix, identity, product, transpose

SIDES = ((True, True), (True, False), (False, True))  # of a matrix: rows, columns


def flipped_on_both_sides(question: Question, by: Matrices) -> RationalMatrix | None:
    """Take F · M · F."""
    M = by.world_from_object
    if question.subject is Subject.WORLD:
        return transpose(with_negated(transpose(with_negated(M, Z)), Z))
    if question.asks_for_way:
        return None
    F, _ = way_between(question, by)
    return product(F, M, F)


def flipped_on_the_left(question: Question, by: Matrices) -> RationalMatrix | None:
    """Take F · M."""
    M = by.world_from_object
    if question.subject is Subject.WORLD:
        return with_negated(M, Z)
    return None if question.asks_for_way else product(way_between(question, by)[0], M)


def flipped_on_the_right(question: Question, by: Matrices) -> RationalMatrix | None:
    """Take M · F⁻¹."""
    M = by.world_from_object
    if question.subject is Subject.WORLD:
        return transpose(with_negated(transpose(M), Z))
    return None if question.asks_for_way else product(M, way_between(question, by)[1])


def _rows_exchanged(A: RationalMatrix, y_sign: int, z_sign: int) -> RationalMatrix:
    """Exchange the rows of y and z, with a sign or without."""
    x, y, z, w = A
    return x, tuple(y_sign * entry for entry in z), tuple(z_sign * entry for entry in y), w


def _up_taken(y_sign: int, z_sign: int, *, before: bool, after: bool) -> Rule:
    """Exchange y and z in what comes out, in what goes in, or in both."""

    def rule(question: Question, by: Matrices) -> RationalMatrix:
        told = identity(4) if question.asks_for_way else raw_answer(question, by)
        if before:
            told = _rows_exchanged(told, y_sign, z_sign)
        if after:
            told = transpose(_rows_exchanged(transpose(told), y_sign, z_sign))
        return told

    return rule


OTHER_UPS = tuple(
    _up_taken(*signs, before=before, after=after)
    for signs, (before, after) in choices(((1, 1), (1, -1), (-1, 1)), SIDES)
)
