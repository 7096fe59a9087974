"""A body drawn again with one thing about its surface changed."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.raster.image import levels
from nmatrix.raster.proofs.brief import Shown
from nmatrix.raster.render import Change, render

Array = NDArray[Any]


def redrawn(shown: Shown, change: Change) -> Array:
    """Return the image (height, width, channels) under changed surfaces."""
    return render(shown.plan, change=change).image


def as_levels(image: Array) -> Array:
    """Return an image of one or three channels as 8-bit levels of three."""
    return levels(np.broadcast_to(image, (*image.shape[:2], 3)))
