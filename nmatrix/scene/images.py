"""Images: read by their headers first, so that neither a bomb nor an unknown format is decoded."""

from __future__ import annotations

import io
import struct
import warnings
from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from nmatrix.errors import IllegalValueError, printable
from nmatrix.scene.beside import check_ends
from nmatrix.scene.material import BLACK, EmbeddedImage, ImageSource, Material, Texture
from nmatrix.scene.words import Pattern

if TYPE_CHECKING:
    import PIL.Image

Array = NDArray[Any]

MOST_PIXELS = 8192 * 8192
MOST_OF_SCENE = 4 * MOST_PIXELS
AS_PNG = "save it as PNG"
# How files begin whose texels are packed for graphics cards.
UNREAD = {
    b"\xabKTX 20\xbb\r\n\x1a\n": "KTX2",
    b"\xabKTX 11\xbb\r\n\x1a\n": "KTX",
    b"sB": "Basis Universal",
    b"DDS ": "DDS",
    b"%!PS": "PostScript",
    b"\xc5\xd0\xd3\xc6": "PostScript",
}
# What is decoded here and by nothing else: for PostScript, Pillow would run another program.
KINDS = ("PNG", "JPEG", "WEBP", "TGA", "BMP", "GIF", "TIFF", "PPM", "PSD", "PCX", "SGI", "ICO")
LONGEST_MAGIC = max(map(len, UNREAD))
# What decoders raise over bytes that are none of their format.
UNREADABLE = (OSError, ValueError, SyntaxError, EOFError, IndexError, KeyError, struct.error)


def has_alpha(texture: Texture) -> bool:
    """Tell whether an image has any opacity of its own."""
    return not isinstance(texture.image, Pattern) and read_image(texture.image).alpha is not None


@dataclass
class Room:
    """The pixels that the images of one scene may still have, and why images were not read.

    Each image is tried once, however many materials name it.
    """

    left: int = MOST_OF_SCENE
    tried: dict[ImageSource, IllegalValueError | None] = field(default_factory=dict)

    def read(self, source: ImageSource) -> None:
        """Read an image if there is room for it.

        Raises
        ------
        IllegalValueError
            If there is not, or it cannot be read.
        """
        if source not in self.tried:
            self.tried[source] = self._error(source)
        error = self.tried[source]
        if error is not None:
            raise error

    def _error(self, source: ImageSource) -> IllegalValueError | None:
        try:
            with _opened(source) as opened:
                pixels = opened.width * opened.height
            if self.left < pixels <= MOST_PIXELS:  # what is larger is refused for itself
                why = "with it the scene has more pixels of images than can be held"
                raise IllegalValueError(f"{source}", why, "save them smaller")
            read_image(source)
        except IllegalValueError as error:
            return error
        self.left -= pixels
        return None


def with_readable_images(material: Material, room: Room) -> tuple[Material, list[str]]:
    """Leave out optional images that cannot be read or have no room, and say why.

    Raises
    ------
    IllegalValueError
        For an image that is not optional.
    """
    told, lost = [], dict[str, Any]()
    for name, found in material.textures.items():
        if found.is_optional and not isinstance(found.image, Pattern):
            try:
                room.read(found.image)
            except IllegalValueError as error:
                shown = printable(Path(found.image.name).name)
                told.append(f"An image is not drawn: {shown}: {error.parts[1]}.")
                lost[name] = None
                if found is material.emission_texture:
                    lost["emission"] = BLACK  # what of it would have shone is not known
    return replace(material, **lost) if lost else material, told


class Image(NamedTuple):
    """An image as bytes, its last row first: (height, width, 3), and (height, width, 1) or None."""

    colours: Array
    alpha: Array | None


@lru_cache(maxsize=64)  # more than most scenes have: each stripe of a picture asks for all
def read_image(source: ImageSource) -> Image:
    """Read an image, if its header tells of a kind and a size that are read.

    Raises
    ------
    IllegalValueError
        For a file that is missing, is no image, is damaged, or is too large.
    """
    try:
        with _opened(source) as opened:
            if opened.width * opened.height > MOST_PIXELS:
                size = f"{opened.width} × {opened.height} pixels"
                why = f"it has {size}, more than 8192 × 8192 are not read"
                raise IllegalValueError(f"{source}", why, "save it smaller")
            with warnings.catch_warnings(action="ignore"):
                is_clear = opened.has_transparency_data
                levels = np.asarray(opened.convert("RGBA" if is_clear else "RGB"))[::-1]
    except IllegalValueError:
        raise
    except UNREADABLE:
        why = "its pixels are damaged or cut short"
        raise IllegalValueError(f"{source}", why, "save it again") from None
    colours = np.ascontiguousarray(levels[..., :3])
    return Image(colours, np.ascontiguousarray(levels[..., 3:]) if is_clear else None)


def _opened(source: ImageSource) -> PIL.Image.Image:
    """Open an image of any size, as far as its header."""
    import PIL.Image

    own_limit = PIL.Image.MAX_IMAGE_PIXELS  # its error does not tell the size
    try:
        begin = _beginning(source)
        for magic, kind in UNREAD.items():
            if begin.startswith(magic):
                raise IllegalValueError(f"{source}", f"it is {kind}, which is not read", AS_PNG)
        PIL.Image.MAX_IMAGE_PIXELS = None
        with warnings.catch_warnings(action="ignore"):
            if isinstance(source, EmbeddedImage):
                return PIL.Image.open(io.BytesIO(source.content), formats=KINDS)
            return PIL.Image.open(source, formats=KINDS)
    except FileNotFoundError:
        raise IllegalValueError(f"{source}", "there is no such file", "check the name") from None
    except IllegalValueError:
        raise
    except UNREADABLE:
        raise IllegalValueError(f"{source}", "it is no image", "check it") from None
    finally:
        PIL.Image.MAX_IMAGE_PIXELS = own_limit


def _beginning(source: ImageSource) -> bytes:
    if isinstance(source, EmbeddedImage):
        return source.content[:LONGEST_MAGIC]
    check_ends(source)
    with source.open("rb") as file:
        return file.read(LONGEST_MAGIC)
