"""A body drawn again with one thing about its surface changed."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import Effect
from nmatrix.raster.image import levels
from nmatrix.raster.picture import Drawable, Drawing
from nmatrix.raster.proofs.brief import Shown
from nmatrix.raster.render import surface_of
from nmatrix.raster.shading_space import as_array
from nmatrix.raster.surface import Surface
from nmatrix.raster.vertices import front_sign, project

Array = NDArray[Any]


def redrawn(shown: Shown, change: Callable[[Surface], Surface]) -> Array:
    """Return the image (height, width, channels) of the only body under a changed surface."""
    studio, (plan,) = shown.studio, shown.plan.bodies
    exact = studio.clip_from_object(plan.body)
    front = front_sign(exact, studio.clip)
    culled = 0 if Effect.BACK_FACES in plan.effects else -front
    projected = project(plan.body.mesh, as_array(exact), studio.canvas, studio.clip, culled)
    surface = change(surface_of(shown.plan, plan, {}, front))
    background = np.array(studio.settings.background[: shown.plan.channels])
    drawable = Drawable(projected, surface.reads(projected), surface.colours)
    return Drawing([drawable], studio.canvas, background).picture().image


def as_levels(image: Array) -> Array:
    """Return an image of one or three channels as 8-bit levels of three."""
    return levels(np.broadcast_to(image, (*image.shape[:2], 3)))
