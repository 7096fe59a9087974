"""Textures: moved, wrapped, read between four texels; sizes and coordinates that are too large."""

from __future__ import annotations

from math import cos, floor, radians, sin
from pathlib import Path
from struct import pack
from zlib import crc32

import numpy as np
import pytest
from PIL import Image

from nmatrix.errors import IllegalValueError
from nmatrix.raster.shading.texture import from_srgb, sample, sample_alpha
from nmatrix.scene.images import read_image
from nmatrix.scene.material import EmbeddedImage, Texture
from nmatrix.scene.words import Filter, Pattern, Wrap

LEVELS = np.random.default_rng(5).integers(0, 256, (3, 5, 3), np.uint8)  # rows, columns, channels
UV = np.random.default_rng(6).uniform(-3, 3, (2, 400))


@pytest.fixture
def image(tmp_path: Path) -> Path:
    path = tmp_path / "a.png"
    Image.fromarray(LEVELS).save(path)
    return path


def wrapped(i: int, size: int, wrap: Wrap) -> int:
    """Walk from texel to texel: the texel that stands at place i."""
    period = {Wrap.REPEAT: [*range(size)], Wrap.MIRROR: [*range(size), *reversed(range(size))]}
    if wrap is Wrap.CLAMP:
        return min(max(i, 0), size - 1)
    return period[wrap][i % len(period[wrap])]


def texel_mean(u: float, v: float, wraps: tuple[Wrap, Wrap]) -> np.ndarray:
    rows = LEVELS[::-1] / 255
    height, width = rows.shape[:2]
    x, y = u * width - 0.5, v * height - 0.5
    total = np.zeros(3)
    for i in (floor(x), floor(x) + 1):
        for j in (floor(y), floor(y) + 1):
            weight = (1 - abs(x - i)) * (1 - abs(y - j))
            total += weight * rows[wrapped(j, height, wraps[1]), wrapped(i, width, wraps[0])]
    return total


@pytest.mark.parametrize("along_v", Wrap)
@pytest.mark.parametrize("along_u", Wrap)
def test_every_wrap_reads_the_texels_that_a_walk_finds(
    along_u: Wrap, along_v: Wrap, image: Path
) -> None:
    wraps = (along_u, along_v)
    found = sample(Texture(image, wraps), UV, linear=False)
    expected = np.array([texel_mean(u, v, wraps) for u, v in UV.T]).T
    assert np.abs(found - expected).max() < 1e-13


def test_coordinates_are_scaled_then_turned_then_moved(image: Path) -> None:
    placed = Texture(image, scale=(2, -0.5), rotation_degrees=35, offset=(0.3, -0.7))
    u, v = 2 * UV[0], -0.5 * UV[1]
    c, s = cos(radians(35)), sin(radians(35))
    moved = np.stack([c * u - s * v + 0.3, s * u + c * v - 0.7])
    expected = sample(Texture(image), moved, linear=False)
    assert np.abs(sample(placed, UV, linear=False) - expected).max() < 1e-12


@pytest.mark.parametrize("wrap", Wrap)
def test_a_checker_is_wrapped_as_an_image_of_eight_squares(wrap: Wrap) -> None:
    u = np.array([-0.3, -0.05, 0.05, 0.95, 1.05, 1.3, 2.2])
    found = sample(Texture(Pattern.CHECKER, (wrap, wrap)), np.stack([u, 0 * u]), linear=False)
    places = [wrapped(floor(one * 8), 8, wrap) for one in u]
    assert found[0].tolist() == [1.0 if place % 2 == 0 else 0.35 for place in places]


@pytest.mark.parametrize("wrap", Wrap)
@pytest.mark.parametrize("far", [1e17, 1e30, 1e308])
def test_coordinates_however_large_have_a_colour(far: float, wrap: Wrap, image: Path) -> None:
    uv = np.array([[far, -far, far, 0], [far, far, 0, -far]])
    with np.errstate(all="raise", under="ignore"):
        for source in (image, Pattern.CHECKER):
            texture = Texture(source, (wrap, wrap), scale=(0.5, 0.5))
            found = sample(texture, uv, linear=True)
            assert ((found >= 0) & (found <= 1)).all()


def test_levels_are_made_linear_before_they_are_mixed(image: Path) -> None:
    middle = np.array([[0.5 / 5], [0.5 / 3]])
    found = sample(Texture(image), middle, linear=True)
    assert (found[:, 0] == from_srgb(LEVELS[-1, 0] / 255.0)).all()


def header_of_png(width: int, height: int) -> bytes:
    """The first bytes of a PNG that claims a size, and nothing of its pixels."""
    header = b"IHDR" + pack(">2I5B", width, height, 8, 2, 0, 0, 0)
    chunk = pack(">I", 13) + header + pack(">I", crc32(header))
    end = pack(">I", 0) + b"IEND" + pack(">I", crc32(b"IEND"))
    return b"\x89PNG\r\n\x1a\n" + chunk + pack(">I", 0) + b"IDAT" + pack(">I", crc32(b"IDAT")) + end


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("sides", [(8193, 8192), (30000, 30000), (2_000_000_000, 2)])
def test_an_image_that_is_too_large_is_refused_by_its_header(sides: tuple[int, int]) -> None:
    """Whether our own limit would meet it first, or that of the library that reads it."""
    bomb = EmbeddedImage("bomb", header_of_png(*sides))
    with pytest.raises(IllegalValueError) as caught:
        read_image(bomb)
    size = " × ".join(map(str, sides))
    more = "more than 8192 × 8192 are not read"
    assert str(caught.value) == f"bomb: it has {size} pixels, {more}; save it smaller"
    assert Image.MAX_IMAGE_PIXELS, "the library's own limit stays as it was"


@pytest.mark.parametrize(
    ("content", "why"),
    [
        (b"\xabKTX 20\xbb\r\n\x1a\n" + bytes(80), "it is KTX2, which is not read"),
        (b"DDS " + bytes(124), "it is DDS, which is not read"),
        (b"%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 9 9\n", "it is PostScript, which"),
        (b"no image at all", "it is no image"),
        (b"", "it is no image"),
        (header_of_png(4, 4), "its pixels are damaged or cut short"),
    ],
)
def test_what_cannot_be_read_says_why_in_one_line(content: bytes, why: str) -> None:
    with pytest.raises(IllegalValueError, match=f"^a: {why}[^\n]*; [^\n]+$"):
        read_image(EmbeddedImage("a", content))


def test_the_nearest_texel_is_read_where_a_sampler_asks_for_it(image: Path) -> None:
    found = sample(Texture(image, filter=Filter.NEAREST), UV, linear=False)
    rows = LEVELS[::-1] / 255
    for (u, v), colour in zip(UV.T, found.T, strict=True):
        assert (colour == rows[floor(v * 3) % 3, floor(u * 5) % 5]).all()


def test_an_image_without_alpha_is_opaque_and_one_with_it_is_as_it_says(
    image: Path, tmp_path: Path
) -> None:
    clear = np.random.default_rng(7).integers(0, 256, (3, 5, 4), np.uint8)
    Image.fromarray(clear).save(tmp_path / "clear.png")
    middles = np.stack(np.meshgrid((np.arange(5) + 0.5) / 5, (np.arange(3) + 0.5) / 3))
    uv = middles.reshape(2, -1)
    assert (sample_alpha(Texture(image), uv) == 1.0).all()
    found = sample_alpha(Texture(tmp_path / "clear.png"), uv)
    assert np.abs(found * 255 - clear[::-1, :, 3].ravel()).max() < 1e-9
