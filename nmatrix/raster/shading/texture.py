"""Textures: colours and opacity by u and v, which are moved and wrapped first."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.scene.images import read_image
from nmatrix.scene.material import DARK, SQUARES, Texture
from nmatrix.scene.words import Filter, Pattern, Wrap
from nmatrix.shaders.shaded import EDGE

Array = NDArray[Any]

FARTHEST = 2.0**36  # of u and v: times the pixels of an image, whole numbers still hold it


def sample(texture: Texture, uv: Array, *, linear: bool) -> Array:
    """Return the texture's colours (channels, m) at coordinates (2, m), v upwards.

    Images are read between their four nearest texels; `linear` takes sRGB levels to linear light.

    Examples
    --------
    >>> from nmatrix.scene.images import read_image
    >>> from nmatrix.scene.material import CHECKER
    >>> sample(CHECKER, np.array([[0.01, 0.13], [0.01, 0.01]]), linear=False).tolist()
    [[1.0, 0.35]]
    """
    uv = _placed(texture, uv)
    if isinstance(texture.image, Pattern):
        column, row = (
            _wrapped(np.floor(one * SQUARES + EDGE), SQUARES, how)
            for one, how in zip(uv, texture.wrap, strict=True)
        )
        return np.asarray(np.where((column + row) % 2 == 0, 1.0, DARK)[None])
    return _read(read_image(texture.image).colours, _levels(linear=linear), uv, texture)


def sample_alpha(texture: Texture, uv: Array) -> Array:
    """Read the texture's opacity (m,) at coordinates (2, m): 1 where an image has none."""
    alpha = None if isinstance(texture.image, Pattern) else read_image(texture.image).alpha
    if alpha is None:
        return np.ones(uv.shape[1])
    return np.asarray(_read(alpha, _levels(linear=False), _placed(texture, uv), texture)[0])


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
    if rows != ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0)):
        u, v = uv
        with np.errstate(over="ignore", invalid="ignore"):
            uv = np.nan_to_num(np.stack([a * u + b * v + c for a, b, c in rows]))
    return np.asarray(np.clip(uv, -FARTHEST, FARTHEST))


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


def _read(image: Array, levels: Array, uv: Array, texture: Texture) -> Array:
    """Read what an image (height, width, k) holds at each place: levels (k, m)."""
    height, width, depth = image.shape
    texels = image.reshape(-1, depth)

    def at(row: Array, column: Array) -> Array:
        across = _wrapped(column, width, texture.wrap[0])
        place = _wrapped(row, height, texture.wrap[1]) * width + across
        return np.asarray(levels.take(texels.take(place, axis=0).T))

    if texture.filter is Filter.NEAREST:
        return at(np.floor(uv[1] * height), np.floor(uv[0] * width))
    x, y = uv[0] * width - 0.5, uv[1] * height - 0.5
    left, low = np.floor(x), np.floor(y)
    right_part, high_part = x - left, y - low
    lower, upper = (
        at(row, left) * (1 - right_part) + at(row, left + 1) * right_part for row in (low, low + 1)
    )
    return np.asarray(lower * (1 - high_part) + upper * high_part)
