"""Images as 8-bit levels, and the files that hold them with their numbers inside."""

from __future__ import annotations

import io
import json
from collections.abc import Mapping, Sequence
from typing import Any, assert_never

import numpy as np
from numpy.typing import NDArray
from PIL import Image, PngImagePlugin

from nmatrix.enums import PixelFormat
from nmatrix.errors import IllegalValueError

Array = NDArray[Any]

FRAME_MILLISECONDS = 60  # while an animation shows one
LARGEST_WEBP = 16383  # pixels on a side
IMAGE_DESCRIPTION = 0x010E  # the tag of Exif


def levels(image: Array) -> Array:
    """Return an image in [0, 1] as 8-bit levels."""
    return np.asarray(np.rint(np.clip(image, 0.0, 1.0) * 255).astype(np.uint8))


def png(image: Array, texts: Mapping[str, str]) -> bytes:
    """Return an image as a PNG file, with its numbers as text chunks."""
    return picture_file([image], texts, PixelFormat.PNG)


def picture_file(images: Sequence[Array], texts: Mapping[str, str], kind: PixelFormat) -> bytes:
    """Return images of one size as one file; several are an endless animation.

    Its numbers stand in the text chunks of a PNG, as JSON in the comment of a GIF or a JPEG, and as
    JSON in the Exif description of a WebP. PNG and WebP keep every level; a GIF has 256 colours.

    Raises
    ------
    IllegalValueError
        For a picture that is too large for a WebP.
    """
    height, width = images[0].shape[:2]
    if kind is PixelFormat.WEBP and max(width, height) > LARGEST_WEBP:
        raise IllegalValueError(
            f"a picture of {width} × {height} pixels",
            f"a WebP has {LARGEST_WEBP} on a side at the most",
            "end its name in .png, or draw it smaller",
        )
    first, *others = (Image.fromarray(np.ascontiguousarray(one)) for one in images)
    told = json.dumps(texts, ensure_ascii=False)
    how: dict[str, Any] = {}
    if others:
        how = {"save_all": True, "append_images": others, "duration": FRAME_MILLISECONDS, "loop": 0}
    match kind:
        case PixelFormat.PNG:
            how["pnginfo"] = chunks = PngImagePlugin.PngInfo()
            for key, value in texts.items():
                chunks.add_itxt(key, value)
        case PixelFormat.GIF:
            how["comment"] = told.encode()
        case PixelFormat.WEBP:
            exif = Image.Exif()
            exif[IMAGE_DESCRIPTION] = told
            how |= {"lossless": True, "exif": exif}
        case PixelFormat.JPEG:
            how |= {"comment": told.encode(), "quality": 95, "subsampling": 0}
        case _:
            assert_never(kind)
    out = io.BytesIO()
    first.save(out, kind.upper(), **how)
    return out.getvalue()
