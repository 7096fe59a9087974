"""Textures: colours by u and v, which repeat outside of the unit square."""

from __future__ import annotations

import io
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.errors import IllegalValueError
from nmatrix.scene.material import CHECKER, ImageSource

Array = NDArray[Any]

SQUARES = 8  # of the checker, along a unit of u and of v
EDGE = 1e-6  # of a square: they begin beside round numbers, on which the last bit would decide
DARK = 0.35
MOST_PIXELS = 1 << 26


def sample(texture: ImageSource | str, uv: Array, *, linear: bool) -> Array:
    """Return the texture's colours (channels, m) at coordinates (2, m), v upwards.

    Images are read between their four nearest texels; `linear` takes sRGB levels to linear light.

    Examples
    --------
    >>> sample(CHECKER, np.array([[0.01, 0.13], [0.01, 0.01]]), linear=False).tolist()
    [[1.0, 0.35]]
    """
    if texture == CHECKER:
        squares = np.floor(uv * SQUARES + EDGE)
        return np.asarray(np.where((squares[0] + squares[1]) % 2 == 0, 1.0, DARK)[None])
    image = read_image(Path(texture) if isinstance(texture, str) else texture)
    return _between(from_srgb(image) if linear else image, uv)


@lru_cache(maxsize=16)
def read_image(source: ImageSource) -> Array:
    """Return an image as (3, height, width) levels in [0, 1], its last row first.

    Raises
    ------
    IllegalValueError
        For a file that is missing, is no image, or is too large.
    """
    from PIL import Image

    file = source if isinstance(source, Path) else io.BytesIO(source.content)
    try:
        with Image.open(file) as opened:
            if opened.width * opened.height > MOST_PIXELS:
                raise IllegalValueError(
                    f"{source} ({opened.width}×{opened.height})",
                    f"a texture has {MOST_PIXELS} pixels at the most",
                    "make it smaller",
                )
            levels = np.asarray(opened.convert("RGB"))
    except IllegalValueError:
        raise
    except (OSError, ValueError, Image.DecompressionBombError):
        raise IllegalValueError(f"{source}", "it is no image", "check it") from None
    return np.ascontiguousarray(levels[::-1].transpose(2, 0, 1) / 255.0)


def from_srgb(levels: Array) -> Array:
    """Return linear light for sRGB levels in [0, 1]."""
    return np.where(levels <= 0.04045, levels / 12.92, ((levels + 0.055) / 1.055) ** 2.4)


def to_srgb(light: Array) -> Array:
    """Return sRGB levels for linear light in [0, 1].

    Examples
    --------
    >>> np.round(to_srgb(np.array([0.0, 0.5, 1.0])), 4).tolist()
    [0.0, 0.7354, 1.0]
    """
    bright = 1.055 * np.maximum(light, 0.0031308) ** (1 / 2.4) - 0.055
    return np.where(light <= 0.0031308, light * 12.92, bright)


def _between(image: Array, uv: Array) -> Array:
    """Return the mean of the four texels around each place, by nearness."""
    _, height, width = image.shape
    x, y = uv[0] * width - 0.5, uv[1] * height - 0.5
    left, low = np.floor(x), np.floor(y)
    right_part, high_part = x - left, y - low
    columns = [(left + i).astype(np.intp) % width for i in (0, 1)]
    rows = [(low + j).astype(np.intp) % height for j in (0, 1)]
    lower, upper = (
        image[:, row, columns[0]] * (1 - right_part) + image[:, row, columns[1]] * right_part
        for row in rows
    )
    return np.asarray(lower * (1 - high_part) + upper * high_part)
