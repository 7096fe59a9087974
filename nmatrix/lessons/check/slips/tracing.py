"""Mistakes at the end of a vertex's way: no division by w, and y from the other side."""

from __future__ import annotations

from fractions import Fraction

from nmatrix.lessons.check.question import Matrices, Question, clip_point, in_window, traced
from nmatrix.linear.rational import ONE, RationalMatrix


def ends_before_the_window(question: Question) -> bool:
    """Recognise a vertex that is not taken to the window, where y may be counted either way."""
    return question.window is None


def not_divided(question: Question, by: Matrices) -> RationalMatrix:
    """Stop at clip coordinates, or take them to the window as they are."""
    clip = clip_point(question, by)
    return (clip if question.window is None else in_window(question, (*clip[:3], ONE)),)


def y_from_the_other_side(question: Question, by: Matrices) -> RationalMatrix | None:
    """Count y of the window from the bottom where it counts from the top, or the reverse."""
    if question.window is None:
        return None
    x, y, z, w = traced(question, by)
    return ((x, Fraction(question.window.height) - y, z, w),)
