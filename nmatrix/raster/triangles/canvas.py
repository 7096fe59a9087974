"""The canvas: pixels, and the samples that each of them is made of."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Canvas:
    """A picture's size in pixels, and samples along one side of a pixel.

    Examples
    --------
    >>> Canvas(640, 480, per_side=2).columns
    1280
    """

    width: int
    height: int
    per_side: int = 1

    @property
    def columns(self) -> int:
        """Return the samples in a row."""
        return self.width * self.per_side

    @property
    def rows(self) -> int:
        """Return the samples in a column."""
        return self.height * self.per_side

    @property
    def aspect(self) -> float:
        """Return width over height."""
        return self.width / self.height
