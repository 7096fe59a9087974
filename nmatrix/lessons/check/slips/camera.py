"""Mistakes with the camera: its hand, and its lens with angle, aspect ratio and depth range.

A lens that is given by its field of view is a window on the near plane, symmetric about the axis;
a mistake with the angle makes another window of it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from math import isinf, radians, tan

from nmatrix.enums import DepthRange, Handedness
from nmatrix.lessons.check.computation import Computation
from nmatrix.lessons.check.question import Question
from nmatrix.linear.projection import Window
from nmatrix.linear.rational import ONE, RationalMatrix, diagonal, product
from nmatrix.scene.camera import View
from nmatrix.scene.lens import Lens
from nmatrix.scene.setup import Setup

OTHER_HAND = {Handedness.RIGHT: Handedness.LEFT, Handedness.LEFT: Handedness.RIGHT}
SWAPPED_DEPTH = {
    DepthRange.ZERO_TO_ONE: DepthRange.REVERSED,
    DepthRange.REVERSED: DepthRange.ZERO_TO_ONE,
}
OTHER_Z: RationalMatrix = diagonal((ONE, ONE, -ONE, ONE))


def has_numbers(setup: Setup) -> bool:
    """Recognise a lens that is described by numbers and not by its matrix."""
    return setup.lens.matrix is None


def has_angle(setup: Setup) -> bool:
    """Recognise a lens that is given by its field of view."""
    lens = setup.lens
    by_sides = (lens.ortho, lens.frustum, lens.measured)
    return has_numbers(setup) and not any(by_sides)


def view_of_the_other_hand(setup: Setup) -> Iterator[Setup]:
    """Turn a camera to the other z, mirrored or not.

    A look-at of the other hand also exchanges left and right; turning the sign of the third row
    alone leaves a mirror.
    """
    view = setup.view
    if view.matrix is None and view.angles is None:
        yield replace(setup, view=replace(view, handed=OTHER_HAND[view.handed]))
    mirrored = product(OTHER_Z, view.placed().camera_from_world)
    yield replace(setup, view=View(matrix=mirrored))


def angle_in_radians(setup: Setup) -> Iterator[Setup]:
    """Take the field of view for radians."""
    yield _seen_through(setup, _window(setup.lens, tan(setup.lens.fov_degrees / 2)))


def aspect_inverted(setup: Setup) -> Iterator[Setup]:
    """Take height over width."""
    lens = setup.lens
    inverted = replace(lens, aspect=float(1 / lens.aspect_ratio))
    if lens.frustum is not None:
        inverted = replace(inverted, frustum=_window(inverted, lens.frustum.top / lens.near))
    yield replace(setup, lens=inverted)


def horizontal_fov(setup: Setup) -> Iterator[Setup]:
    """Measure the angle from left to right."""
    lens = setup.lens
    across = tan(radians(lens.fov_degrees) / 2)
    if lens.frustum is not None:
        across = lens.frustum.top / lens.near
    yield _seen_through(setup, _window(lens, float(across / lens.aspect_ratio)))


def other_depth_ranges(setup: Setup) -> Iterator[Setup]:
    """Map near and far to every other depth range."""
    for depth in DepthRange:
        yield _with_clip(setup, depth, setup.lens.clip.handed)


def lens_of_the_other_hand(setup: Setup) -> Iterator[Setup]:
    """Project for a camera that looks along the other z."""
    yield _with_clip(setup, setup.lens.clip.depth, OTHER_HAND[setup.lens.clip.handed])


def near_far_swapped(question: Question) -> Computation | None:
    """Slip in the third row; in a frustum in the focal lengths as well."""
    if not has_numbers(question.setup):
        return None
    of_frustum = question.setup.lens.frustum is not None
    exchanged = _near_far_exchanged_in_frustum if of_frustum else _near_far_exchanged
    return Computation(describe=(exchanged,))


def _near_far_exchanged(setup: Setup) -> Iterator[Setup]:
    """Exchange near and far in the formulas of the third row.

    From −1 to 1 that turns the row's sign, from 0 to 1 it is reversed depth. A far plane at
    infinity cannot be exchanged.
    """
    lens, sign = setup.lens, ONE
    if isinf(lens.far):
        return
    if lens.clip.depth is DepthRange.MINUS_ONE_TO_ONE:
        sign = -ONE
    else:
        lens = _with_clip(setup, SWAPPED_DEPTH[lens.clip.depth], lens.clip.handed).lens
    third_row = diagonal((ONE, ONE, sign, ONE))
    matrix = product(third_row, lens.clip_from_camera)
    yield replace(setup, lens=Lens(matrix=matrix))  # whatever its clip space is


def _near_far_exchanged_in_frustum(setup: Setup) -> Iterator[Setup]:
    """Exchange near and far of a frustum, whose focal lengths hold near too."""
    for swapped in _near_far_exchanged(setup):
        ratio = Fraction(setup.lens.far) / Fraction(setup.lens.near)
        matrix = product(swapped.lens.clip_from_camera, diagonal((ratio, ratio, ONE, ONE)))
        yield replace(swapped, lens=Lens(matrix=matrix))


def _window(lens: Lens, tangent: float) -> Window:
    """Open a window that is so high at distance 1, above the axis."""
    top = lens.near * tangent
    right = float(top * lens.aspect_ratio)
    return Window(-right, right, -top, top)


def _seen_through(setup: Setup, window: Window) -> Setup:
    return replace(setup, lens=replace(setup.lens, frustum=window))


def _with_clip(setup: Setup, depth: DepthRange, handed: Handedness) -> Setup:
    clip = replace(setup.lens.clip, depth=depth, handed=handed)
    return replace(setup, lens=replace(setup.lens, clip=clip))
