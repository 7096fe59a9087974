"""Angles as colours: dark blue for none, yellow for the worst.

Lightness grows all the way, so the order survives a greyscale print and colour blindness.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.raster.image import Legend

Array = NDArray[Any]

STOPS = ((13, 8, 80), (78, 35, 140), (158, 50, 128), (214, 92, 82), (248, 160, 48), (250, 240, 110))
STEPS = 256
ROUNDING_DEG = 1e-6  # far above the rounding of this rasterizer, far below what can be seen
UNDEFINED = 0.5


@dataclass(frozen=True)
class Scale:
    """Colours from 0 to `largest_deg`.

    Angles that are rounding alone are shown on a scale to 1°, all dark: stretched to the full
    range they would look like a finding.
    """

    largest_deg: float

    @classmethod
    def reaching(cls, worst_deg: float | None) -> Scale:
        """Return the scale that ends at the worst angle."""
        return cls(worst_deg if worst_deg is not None and worst_deg > ROUNDING_DEG else 1.0)

    @property
    def legend(self) -> Legend:
        """Return the scale as the image shows it."""
        red, green, blue = (np.rint(channel * 255).astype(int).tolist() for channel in _colours().T)
        return Legend(tuple(zip(red, green, blue, strict=True)), f"{self.largest_deg:.3g}", "°")

    def colours(self, angle_deg: Array) -> Array:
        """Return a colour (…, 3) in [0, 1] for each angle.

        Examples
        --------
        >>> blue, yellow = Scale(90.0).colours(np.array([0.0, 90.0]))
        >>> bool(yellow.sum() > blue.sum())
        True
        """
        index = np.rint(angle_deg / self.largest_deg * (STEPS - 1)).astype(np.intp)
        return np.asarray(_colours()[index.clip(0, STEPS - 1)])


def _colours() -> Array:
    at, stops = np.linspace(0, 1, STEPS), np.linspace(0, 1, len(STOPS))
    return np.stack([np.interp(at, stops, [c[i] / 255 for c in STOPS]) for i in range(3)], axis=1)
