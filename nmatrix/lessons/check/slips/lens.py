"""Mistakes with the lens: its angle, its aspect ratio, its depth, its hand.

A lens that is given by its field of view is a window on the near plane, symmetric about the axis;
a mistake with the angle makes another window of it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from math import isinf, radians, tan

from nmatrix.enums import DepthRange, Handedness
from nmatrix.linear.projection import Window
from nmatrix.linear.rational import ONE, diagonal, product
from nmatrix.scene.lens import Lens
from nmatrix.scene.setup import Setup

OTHER_HAND = {Handedness.RIGHT: Handedness.LEFT, Handedness.LEFT: Handedness.RIGHT}
SWAPPED_DEPTH = {
    DepthRange.ZERO_TO_ONE: DepthRange.REVERSED,
    DepthRange.REVERSED: DepthRange.ZERO_TO_ONE,
}


def by_angle(lens: Lens) -> bool:
    """Return whether a lens is given by its field of view."""
    return lens.matrix is None and lens.ortho is None and lens.frustum is None


def degrees_as_radians(setup: Setup) -> Iterator[Setup]:
    """Give the scene whose field of view is the same number in radians."""
    yield _seen_through(setup, _window(setup.lens, tan(setup.lens.fov_degrees / 2)))


def aspect_inverted(setup: Setup) -> Iterator[Setup]:
    """Give the scene with height over width."""
    lens = setup.lens
    inverted = replace(lens, aspect=1 / lens.aspect)
    if lens.frustum is not None:
        inverted = replace(inverted, frustum=_window(inverted, lens.frustum.top / lens.near))
    yield replace(setup, lens=inverted)


def horizontal_fov(setup: Setup) -> Iterator[Setup]:
    """Give the scene whose angle is measured from left to right."""
    lens = setup.lens
    across = tan(radians(lens.fov_degrees) / 2)
    if lens.frustum is not None:
        across = lens.frustum.top / lens.near
    yield _seen_through(setup, _window(lens, across / lens.aspect))


def depth_range(setup: Setup) -> Iterator[Setup]:
    """Give the scenes with the other depth ranges."""
    for depth in DepthRange:
        yield _with_clip(setup, depth, setup.lens.clip.handed)


def wrong_handedness(setup: Setup) -> Iterator[Setup]:
    """Give the scene for a camera that looks along the other z."""
    yield _with_clip(setup, setup.lens.clip.depth, OTHER_HAND[setup.lens.clip.handed])


def near_far_swapped(setup: Setup) -> Iterator[Setup]:
    """Give the scene with near and far exchanged in the formulas of the third row.

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
    yield replace(setup, lens=replace(lens, matrix=product(third_row, lens.clip_from_camera)))


def near_far_swapped_in_frustum(setup: Setup) -> Iterator[Setup]:
    """Give the same for a frustum, whose focal lengths hold near too."""
    for swapped in near_far_swapped(setup):
        ratio = Fraction(setup.lens.far) / Fraction(setup.lens.near)
        matrix = product(swapped.lens.clip_from_camera, diagonal((ratio, ratio, ONE, ONE)))
        yield replace(swapped, lens=replace(swapped.lens, matrix=matrix))


def _window(lens: Lens, tangent: float) -> Window:
    """Return the window of a view that is so high at distance 1, above the axis."""
    top = lens.near * tangent
    right = top * lens.aspect
    return Window(-right, right, -top, top)


def _seen_through(setup: Setup, window: Window) -> Setup:
    return replace(setup, lens=replace(setup.lens, frustum=window))


def _with_clip(setup: Setup, depth: DepthRange, handed: Handedness) -> Setup:
    clip = replace(setup.lens.clip, depth=depth, handed=handed)
    return replace(setup, lens=replace(setup.lens, clip=clip))
