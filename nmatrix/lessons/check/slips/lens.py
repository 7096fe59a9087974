"""Mistakes with the lens: its angle and aspect ratio, and the rows of its matrix.

A lens that is given by its field of view is a window on the near plane, symmetric about the axis;
a mistake with the angle makes another window of it. P is `clip_from_camera`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from fractions import Fraction
from math import atan, degrees, isinf, radians, tan

from nmatrix.enums import DepthRange, Handedness
from nmatrix.lessons.check.computation import Computation, Entries, Place, misplaced
from nmatrix.lessons.check.question import Matrices, Question
from nmatrix.linear.projection import Window
from nmatrix.linear.rational import ONE, ZERO, RationalVector, diagonal, product
from nmatrix.linear.values import with_fields
from nmatrix.scene.lens import Lens

OTHER_HAND = {Handedness.RIGHT: Handedness.LEFT, Handedness.LEFT: Handedness.RIGHT}
SWAPPED_DEPTH = {
    DepthRange.ZERO_TO_ONE: DepthRange.REVERSED,
    DepthRange.REVERSED: DepthRange.ZERO_TO_ONE,
}
STEEPEST = 1e6  # a tangent that is what floats leave of an infinite one
DEPTH = 2  # the row of z


def has_numbers(question: Question) -> bool:
    """Recognise a lens that is described by numbers and not by its matrix."""
    return question.setup.lens.matrix is None


def has_angle(question: Question) -> bool:
    """Recognise a lens that is given by its field of view."""
    return is_by_angle(question.setup.lens)


def is_by_angle(lens: Lens) -> bool:
    """Recognise a lens that is given by its field of view."""
    return not any((lens.matrix, lens.ortho, lens.frustum, lens.measured))


def angle_in_another_unit(lens: Lens) -> Iterator[Lens]:
    """Take the field of view for radians, or convert it once too often."""
    for convert in (degrees, radians):
        yield _seeing(lens, tan(radians(convert(lens.fov_degrees)) / 2))


def angle_in_another_unit_if_given(lens: Lens) -> Iterator[Lens]:
    """Take the field of view for radians beside the other angles of a scene."""
    if is_by_angle(lens):
        yield from angle_in_another_unit(lens)


def whole_or_quarter_angle(lens: Lens) -> Iterator[Lens]:
    """Take the tangent of the whole field of view, or halve it twice."""
    half = atan(_tangent(lens))
    for angle in (2 * half, half / 2):
        if abs(tan(angle)) < STEEPEST:
            yield _seeing(lens, tan(angle))


def tangent_for_cotangent(lens: Lens) -> Iterator[Lens]:
    """Take the tangent for the focal length, which is its reciprocal."""
    yield _seeing(lens, 1 / _tangent(lens))


def aspect_inverted(lens: Lens) -> Iterator[Lens]:
    """Take height over width."""
    yield _of_shape(lens, float(1 / lens.aspect_ratio))


def aspect_left_out(lens: Lens) -> Iterator[Lens]:
    """Take one focal length for x and y."""
    yield _of_shape(lens, 1.0)


def horizontal_fov(lens: Lens) -> Iterator[Lens]:
    """Measure the angle from left to right."""
    yield _seeing(lens, float(_tangent(lens) / lens.aspect_ratio))


def other_depth_ranges(lens: Lens) -> Iterator[Lens]:
    """Map near and far to every other depth range."""
    for depth in DepthRange:
        yield _with_clip(lens, depth, lens.clip.handed)


def of_the_other_hand(lens: Lens) -> Iterator[Lens]:
    """Project for a camera that looks along the other z."""
    yield _with_clip(lens, lens.clip.depth, OTHER_HAND[lens.clip.handed])


def near_far_swapped(question: Question) -> tuple[Computation, ...]:
    """Slip in the third row; in a frustum in the focal lengths as well."""
    lens = question.setup.lens
    if lens.matrix is not None or isinf(lens.far):
        return ()
    if lens.frustum is not None:
        return misplaced(_near_far_exchanged_in_frustum)(question)
    return misplaced(_near_far_exchanged, entries=Entries.ROW_Z)(question)


def y_turned(_: Question, right: Matrices) -> Matrices:
    """Negate the second row."""
    return _with_row(right, 1, tuple(-x for x in right.clip_from_camera[1]))


def _signed(slope: int, offset: int) -> Place:
    """Change signs in the third row: of z, of the constant."""

    def place(_: Question, right: Matrices) -> Matrices:
        x, y, z, w = right.clip_from_camera[DEPTH]
        return _with_row(right, DEPTH, (x, y, slope * z, offset * w))

    return place


DEPTH_SIGNS = (_signed(1, -1), _signed(-1, 1), _signed(-1, -1))


def other_factor(question: Question, right: Matrices) -> Matrices | None:
    """Lose the 2 of 2fn, or write it where the depth range has none."""
    if right.clip_from_camera[3][3]:
        return None  # a parallel view has no such product
    x, y, z, w = right.clip_from_camera[DEPTH]
    from_minus_one = question.setup.lens.clip.depth is DepthRange.MINUS_ONE_TO_ONE
    return _with_row(right, DEPTH, (x, y, z, w / 2 if from_minus_one else w * 2))


def no_depth(_: Question, right: Matrices) -> Matrices:
    """Leave the third row 0."""
    return _with_row(right, DEPTH, (ZERO,) * 4)


def _last_row(change: Callable[[RationalVector], RationalVector]) -> Place:
    """Write another last row in a perspective matrix."""

    def place(_: Question, right: Matrices) -> Matrices | None:
        row = right.clip_from_camera[3]
        return _with_row(right, 3, change(row)) if row[2] and not row[3] else None

    return place


LAST_ROWS = (
    _last_row(lambda row: tuple(-x for x in row)),
    _last_row(lambda _: (ZERO, ZERO, ZERO, ONE)),
    _last_row(lambda _: (ZERO,) * 4),
)


def _near_far_exchanged(question: Question, right: Matrices) -> Matrices:
    """Exchange near and far in the formulas of the third row.

    From −1 to 1 that turns the row's sign, from 0 to 1 it is reversed depth.
    """
    clip = question.setup.lens.clip
    if clip.depth is DepthRange.MINUS_ONE_TO_ONE:
        row = tuple(-x for x in right.clip_from_camera[DEPTH])
    else:
        lens = _with_clip(question.setup.lens, SWAPPED_DEPTH[clip.depth], clip.handed)
        row = lens.clip_from_camera[DEPTH]
    return _with_row(right, DEPTH, row)


def _near_far_exchanged_in_frustum(question: Question, right: Matrices) -> Matrices:
    """Exchange near and far of a frustum, whose focal lengths hold near too."""
    swapped = _near_far_exchanged(question, right)
    ratio = Fraction(question.setup.lens.far) / Fraction(question.setup.lens.near)
    widened = product(swapped.clip_from_camera, diagonal((ratio, ratio, ONE, ONE)))
    return replace(swapped, clip_from_camera=widened)


def _with_row(right: Matrices, place: int, row: RationalVector) -> Matrices:
    P = right.clip_from_camera
    return replace(right, clip_from_camera=(*P[:place], row, *P[place + 1 :]))


def _tangent(lens: Lens) -> float:
    """Measure how high the window is at distance 1, above the axis."""
    if lens.frustum is not None:
        return lens.frustum.top / lens.near
    return tan(radians(lens.fov_degrees) / 2)


def _seeing(lens: Lens, tangent: float) -> Lens:
    """Open a window that is so high at distance 1, above the axis."""
    top = lens.near * tangent
    right = float(top * lens.aspect_ratio)
    return with_fields(lens, frustum=Window(-right, right, -top, top))


def _of_shape(lens: Lens, aspect: float) -> Lens:
    shaped = with_fields(lens, aspect=aspect)
    return shaped if lens.frustum is None else _seeing(shaped, _tangent(lens))


def _with_clip(lens: Lens, depth: DepthRange, handed: Handedness) -> Lens:
    return with_fields(lens, clip=replace(lens.clip, depth=depth, handed=handed))
