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
from nmatrix.scene.shot import Shot

OTHER_HAND = {Handedness.RIGHT: Handedness.LEFT, Handedness.LEFT: Handedness.RIGHT}
SWAPPED_DEPTH = {
    DepthRange.ZERO_TO_ONE: DepthRange.REVERSED,
    DepthRange.REVERSED: DepthRange.ZERO_TO_ONE,
}


def by_angle(lens: Lens) -> bool:
    """Return whether a lens is given by its field of view."""
    return lens.matrix is None and lens.ortho is None and lens.frustum is None


def degrees_as_radians(shot: Shot) -> Iterator[Shot]:
    """Give the scene whose field of view is the same number in radians."""
    yield _seen_through(shot, _window(shot.lens, tan(shot.lens.fov_degrees / 2)))


def aspect_inverted(shot: Shot) -> Iterator[Shot]:
    """Give the scene with height over width."""
    lens = shot.lens
    inverted = replace(lens, aspect=1 / lens.aspect)
    if lens.frustum is not None:
        inverted = replace(inverted, frustum=_window(inverted, lens.frustum.top / lens.near))
    yield replace(shot, lens=inverted)


def horizontal_fov(shot: Shot) -> Iterator[Shot]:
    """Give the scene whose angle is measured from left to right."""
    lens = shot.lens
    across = tan(radians(lens.fov_degrees) / 2)
    if lens.frustum is not None:
        across = lens.frustum.top / lens.near
    yield _seen_through(shot, _window(lens, across / lens.aspect))


def depth_range(shot: Shot) -> Iterator[Shot]:
    """Give the scenes with the other depth ranges."""
    for depth in DepthRange:
        yield _with_clip(shot, depth, shot.lens.clip.handed)


def wrong_handedness(shot: Shot) -> Iterator[Shot]:
    """Give the scene for a camera that looks along the other z."""
    yield _with_clip(shot, shot.lens.clip.depth, OTHER_HAND[shot.lens.clip.handed])


def near_far_swapped(shot: Shot) -> Iterator[Shot]:
    """Give the scene with near and far exchanged in the formulas of the third row.

    From −1 to 1 that turns the row's sign, from 0 to 1 it is reversed depth. A far plane at
    infinity cannot be exchanged.
    """
    lens, sign = shot.lens, ONE
    if isinf(lens.far):
        return
    if lens.clip.depth is DepthRange.MINUS_ONE_TO_ONE:
        sign = -ONE
    else:
        lens = _with_clip(shot, SWAPPED_DEPTH[lens.clip.depth], lens.clip.handed).lens
    third_row = diagonal((ONE, ONE, sign, ONE))
    yield replace(shot, lens=replace(lens, matrix=product(third_row, lens.clip_from_camera)))


def near_far_swapped_in_frustum(shot: Shot) -> Iterator[Shot]:
    """Give the same for a frustum, whose focal lengths hold near too."""
    for swapped in near_far_swapped(shot):
        ratio = Fraction(shot.lens.far) / Fraction(shot.lens.near)
        matrix = product(swapped.lens.clip_from_camera, diagonal((ratio, ratio, ONE, ONE)))
        yield replace(swapped, lens=replace(swapped.lens, matrix=matrix))


def _window(lens: Lens, tangent: float) -> Window:
    """Return the window of a view that is so high at distance 1, above the axis."""
    top = lens.near * tangent
    right = top * lens.aspect
    return Window(-right, right, -top, top)


def _seen_through(shot: Shot, window: Window) -> Shot:
    return replace(shot, lens=replace(shot.lens, frustum=window))


def _with_clip(shot: Shot, depth: DepthRange, handed: Handedness) -> Shot:
    clip = replace(shot.lens.clip, depth=depth, handed=handed)
    return replace(shot, lens=replace(shot.lens, clip=clip))
