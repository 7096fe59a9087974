"""Textures: colours by u and v, which are moved and wrapped first."""

from __future__ import annotations

import io
import warnings
from functools import cache, lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.errors import IllegalValueError
from nmatrix.scene.material import DARK, SQUARES, ImageSource, Texture
from nmatrix.scene.words import Pattern, Wrap
from nmatrix.shaders.shaded import EDGE

Array = NDArray[Any]

MOST_PIXELS = 8192 * 8192
FARTHEST = 2.0**36  # of u and v: times the pixels of an image, whole numbers still hold it


def sample(texture: Texture, uv: Array, *, linear: bool) -> Array:
    """Return the texture's colours (channels, m) at coordinates (2, m), v upwards.

    Images are read between their four nearest texels; `linear` takes sRGB levels to linear light.

    Examples
    --------
    >>> from nmatrix.scene.material import CHECKER
    >>> sample(CHECKER, np.array([[0.01, 0.13], [0.01, 0.01]]), linear=False).tolist()
    [[1.0, 0.35]]
    """
    uv = np.clip(_placed(texture, uv), -FARTHEST, FARTHEST)
    if isinstance(texture.image, Pattern):
        column, row = (
            _wrapped(np.floor(one * SQUARES + EDGE), SQUARES, how)
            for one, how in zip(uv, texture.wrap, strict=True)
        )
        return np.asarray(np.where((column + row) % 2 == 0, 1.0, DARK)[None])
    return _between(read_image(texture.image), _levels(linear=linear), uv, texture.wrap)


@lru_cache(maxsize=16)
def read_image(source: ImageSource) -> Array:
    """Return an image as (height, width, 3) bytes, its last row first.

    Raises
    ------
    IllegalValueError
        For a file that is missing, is no image, or is too large.
    """
    from PIL import Image

    file = source if isinstance(source, Path) else io.BytesIO(source.content)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", Image.DecompressionBombWarning)
            opened = Image.open(file)
        with opened:
            if opened.width * opened.height > MOST_PIXELS:
                raise _too_large(f"{source} ({opened.width}×{opened.height})")
            levels = np.asarray(opened.convert("RGB"))
    except IllegalValueError:
        raise
    except Image.DecompressionBombError:
        raise _too_large(f"{source}") from None
    except (OSError, ValueError):
        raise IllegalValueError(f"{source}", "it is no image", "check it") from None
    return np.ascontiguousarray(levels[::-1])


def _too_large(what: str) -> IllegalValueError:
    return IllegalValueError(
        what,
        f"a texture has {MOST_PIXELS} pixels at the most",
        "save it at 8192×8192 or smaller",
    )


@cache
def _levels(*, linear: bool) -> Array:
    """Return what each of the 256 levels of an image stands for: itself, or its linear light."""
    levels = np.arange(256) / 255.0
    return from_srgb(levels) if linear else levels


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


def _placed(texture: Texture, uv: Array) -> Array:
    """Return the coordinates on the image; without a scale, a turn and a move they stay."""
    rows = texture.uv_map
    if rows == ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0)):
        return uv
    u, v = uv
    with np.errstate(over="ignore", invalid="ignore"):
        return np.asarray(np.nan_to_num(np.stack([a * u + b * v + c for a, b, c in rows])))


def _wrapped(index: Array, size: int, wrap: Wrap) -> Array:
    """Return which of `size` texels stands at a whole number of texels from 0.

    Examples
    --------
    >>> [_wrapped(np.arange(-2.0, 5), 3, one).tolist() for one in (Wrap.CLAMP, Wrap.MIRROR)]
    [[0, 0, 0, 1, 2, 2, 2], [1, 0, 0, 1, 2, 2, 1]]
    """
    found = index.astype(np.intp)
    if wrap is Wrap.CLAMP:
        return np.clip(found, 0, size - 1)
    if wrap is Wrap.MIRROR:
        found %= 2 * size
        return np.minimum(found, 2 * size - 1 - found)
    return np.asarray(found % size)


def _between(image: Array, levels: Array, uv: Array, wrap: tuple[Wrap, Wrap]) -> Array:
    """Return the mean (3, m) of the four texels around each place, by nearness."""
    height, width, _ = image.shape
    texels = image.reshape(-1, 3)
    x, y = uv[0] * width - 0.5, uv[1] * height - 0.5
    left, low = np.floor(x), np.floor(y)
    right_part, high_part = x - left, y - low
    columns = [_wrapped(left + i, width, wrap[0]) for i in (0, 1)]
    rows = [_wrapped(low + j, height, wrap[1]) * width for j in (0, 1)]

    def at(row: Array, column: Array) -> Array:
        return levels.take(texels.take(row + column, axis=0).T)

    lower, upper = (
        at(row, columns[0]) * (1 - right_part) + at(row, columns[1]) * right_part for row in rows
    )
    return np.asarray(lower * (1 - high_part) + upper * high_part)
