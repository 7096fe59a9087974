"""Mistakes with the camera: the other hand."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from nmatrix.lessons.check.slips.lens import OTHER_HAND
from nmatrix.linear.rational import ONE, RationalMatrix, diagonal, product
from nmatrix.scene.camera import View
from nmatrix.scene.setup import Setup

OTHER_Z: RationalMatrix = diagonal((ONE, ONE, -ONE, ONE))


def wrong_handedness(setup: Setup) -> Iterator[Setup]:
    """Give the scenes of a camera that looks along the other z, mirrored or not.

    A look-at of the other hand also exchanges left and right; turning the sign of the third row
    alone leaves a mirror.
    """
    view = setup.view
    if view.matrix is None and view.angles is None:
        yield replace(setup, view=replace(view, handed=OTHER_HAND[view.handed]))
    mirrored = product(OTHER_Z, view.placed().camera_from_world)
    yield replace(setup, view=View(eye=view.eye, matrix=mirrored))
