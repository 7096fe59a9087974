"""Previews: what a terminal is sent is the picture, read back as the terminal reads it."""

from __future__ import annotations

import io
import re
from base64 import standard_b64decode

import numpy as np
import pytest
from PIL import Image
from read_terminal import characters, pixels_of_sixels

from nmatrix.canvas.glyphs import Verdict
from nmatrix.canvas.slide import Slide
from nmatrix.enums import Theme
from nmatrix.output.inline_images import CHUNK, inline_image, sixel
from nmatrix.output.preview import NARROWEST, PALETTE, Part, parts_of, preview
from nmatrix.output.style import Style
from nmatrix.output.terminal import Colours, Drawing, Screen, abilities
from nmatrix.output.write import Charset

rng = np.random.default_rng(7)
KITTY = re.compile(r"\x1b_G([^;]*);([^\x1b]*)\x1b\\")
ITERM2 = re.compile(r"\x1b\]1337;File=([^:]*):([^\a]*)\a")
PROTOCOLS = [one for one in Drawing if one.has_pixels]


def ramp(height: int, width: int) -> np.ndarray:
    """Return a picture whose pixels all differ, smooth enough to be made smaller."""
    y, x = np.mgrid[0:height, 0:width]
    red, green = 255 * x // max(width - 1, 1), 255 * y // max(height - 1, 1)
    return np.stack([red, green, 255 - red], axis=2).astype(np.uint8)


def sent(text: str, drawing: Drawing) -> tuple[dict[str, str], np.ndarray]:
    """Return what a terminal was told about a picture, and its pixels."""
    if drawing is Drawing.SIXEL:
        return {}, pixels_of_sixels(text)
    found = (KITTY if drawing is Drawing.KITTY else ITERM2).findall(text)
    separator = "," if drawing is Drawing.KITTY else ";"
    told = dict(one.split("=") for one in found[0][0].split(separator))
    png = standard_b64decode("".join(chunk for _, chunk in found))
    return told, np.asarray(Image.open(io.BytesIO(png)))


@pytest.mark.parametrize("drawing", PROTOCOLS)
@pytest.mark.parametrize("shape", [(1, 1), (64, 64), (7, 13), (90, 160)])
def test_a_picture_arrives_as_it_was_sent(drawing: Drawing, shape: tuple[int, int]) -> None:
    image = ramp(*shape)
    screen = Screen(200, 100, drawing)
    _, found = sent(preview(image, (), screen), drawing)
    assert found.shape == image.shape
    slack = 0 if drawing is not Drawing.SIXEL else 24  # it has 256 colours, in percents
    assert np.abs(found.astype(int) - image).max() <= slack


@pytest.mark.parametrize("drawing", PROTOCOLS)
def test_a_large_picture_is_made_smaller_to_fit_the_terminal(drawing: Drawing) -> None:
    image = ramp(900, 1600)
    screen = Screen(80, 24, drawing, cell=(10, 20))
    told, found = sent(preview(image, (), screen), drawing)
    height, width = found.shape[:2]
    assert width <= 800
    assert height <= 22 * 20
    assert width / height == pytest.approx(16 / 9, rel=0.02)
    if drawing is not Drawing.SIXEL:
        columns, lines = (
            int(told[one]) for one in (("c", "r") if "c" in told else ("width", "height"))
        )
        assert columns * 10 == width
        assert abs(lines * 20 - height) <= 20


def test_kitty_is_asked_for_no_answer_and_gets_short_pieces() -> None:
    noise = rng.integers(0, 256, (80, 80, 3), np.uint8)
    pieces = KITTY.findall(inline_image(Image.fromarray(noise), (10, 5), Drawing.KITTY))
    assert len(pieces) > 2
    assert all("q=2" in told and len(data) <= CHUNK for told, data in pieces)
    assert [told.endswith("m=1") for told, _ in pieces] == [True] * (len(pieces) - 1) + [False]


def test_sixels_keep_every_pixel_of_few_colours() -> None:
    colours = np.array([[0, 0, 0], [255, 0, 0], [51, 102, 204], [255, 255, 255]], np.uint8)
    image = colours[rng.integers(0, 4, (31, 57))]
    assert np.array_equal(pixels_of_sixels(sixel(Image.fromarray(image))), image)


@pytest.mark.parametrize("drawing", [one for one in Drawing if not one.has_pixels])
def test_what_is_no_protocol_sends_no_picture(drawing: Drawing) -> None:
    with pytest.raises(ValueError, match="no protocol"):
        inline_image(Image.new("RGB", (2, 2)), (1, 1), drawing)


def test_half_blocks_show_two_pixels_in_a_character() -> None:
    image = ramp(20, 40)
    shown = characters(preview(image, (), Screen(80, 24, Drawing.HALF_BLOCKS)))
    assert shown.letters == ["▀" * 40] * 10
    assert np.array_equal(shown.halves(), image)


def test_a_terminal_of_256_colours_is_sent_the_nearest_of_them() -> None:
    screen = Screen(80, 24, Drawing.HALF_BLOCKS, Colours.PALETTE)
    known = np.array(PALETTE, np.uint8).reshape(16, 15, 3)
    assert np.array_equal(characters(preview(known, (), screen)).halves(), known)
    image = rng.integers(0, 256, (20, 40, 3), np.uint8)
    text = preview(image, (), screen)
    assert "8;2;" not in text
    assert np.abs(characters(text).halves().astype(int) - image).mean() < 30


def test_a_shaded_colour_keeps_its_hue_in_256_colours() -> None:
    shades = (np.linspace(0.3, 1, 40)[None, :, None] * [230, 50, 40]).astype(np.uint8)
    screen = Screen(80, 24, Drawing.HALF_BLOCKS, Colours.PALETTE)
    red, green, blue = np.moveaxis(
        characters(preview(np.repeat(shades, 2, axis=0), (), screen)).halves().astype(int), 2, 0
    )
    assert (red > 2 * np.maximum(green, blue)).all()
    assert (abs(green - blue) < 48).all()


def test_the_whole_width_of_a_terminal_is_used() -> None:
    image = ramp(900, 1600)
    for columns in (80, 120, 200):
        text = preview(image, (), Screen(columns, 100, Drawing.HALF_BLOCKS))
        assert len(characters(text).letters[0]) == columns


def test_a_preview_is_no_higher_than_the_terminal() -> None:
    for drawing in (Drawing.HALF_BLOCKS, Drawing.CHARACTERS):
        for shape in ((900, 1600), (8192, 64), (64, 8192), (1, 1)):
            lines = preview(ramp(*shape), (), Screen(80, 24, drawing)).splitlines()
            assert 1 <= len(lines) <= 22


PARTS = tuple(Part(np.full((50, 36, 3), 60 * i, np.uint8), f"✓ part {i}: words") for i in range(4))


@pytest.mark.parametrize(("columns", "beside"), [(40, 1), (80, 2), (120, 2), (160, 4)])
def test_parts_stand_beside_one_another_as_far_as_they_can_be_read(
    columns: int, beside: int
) -> None:
    text = preview(
        np.zeros((90, 160, 3), np.uint8), PARTS, Screen(columns, 60, Drawing.HALF_BLOCKS)
    )
    shown = characters(text)
    assert max(map(len, shown.letters)) <= columns
    told = [line for line in shown.letters if "part" in line]
    assert [line.count("part") for line in told] == [beside] * (4 // beside)
    assert all(f"part {i}: words" in text for i in range(4))
    assert columns // beside >= NARROWEST
    assert Style.RIGHT.value in text


def test_words_are_written_beside_a_picture_too_small_to_read_them() -> None:
    image = ramp(900, 1600)
    small, large = (
        preview(image, PARTS, Screen(columns, 200, Drawing.KITTY)) for columns in (80, 180)
    )
    assert "part 3: words" in small
    assert "part" not in large


def test_without_colour_parts_are_drawn_in_plain_characters() -> None:
    screen = Screen(80, 60, Drawing.CHARACTERS, charset=Charset.ASCII)
    text = preview(ramp(9, 16), PARTS, screen)
    assert "\x1b" not in text
    assert text.isascii()
    assert "ok part 0: words" in text
    assert "@" in text


def test_each_word_of_a_slide_stands_with_its_nearest_stage() -> None:
    slide = Slide.of("The claim", (320, 180), Theme.LIGHT)
    left, right = slide.body(200).columns(2, 20)
    slide.canvas.text((left.x, left.y - 60), "Group", 24)
    first = slide.panel(left, "A *n*", Verdict.WRONG, "it *leans*")
    slide.panel(right, "A^{−T}*n*", Verdict.RIGHT, "it stands")
    slide.large_number(right.x, slide.frame.bottom - 68, "36.9°", "off")
    slide.canvas.text((right.x + 10, right.y + 30), "on the stage", 24)
    image = ramp(180, 320)
    one, other = parts_of(slide, image)
    assert one.words == "Group: ✗ A n\nit leans"
    assert other.words == "✓ A⁻ᵀn\nit stands 36.9° off"
    k, box = slide.canvas.scale, first.stage
    corner = image[round(k * box.y), round(k * box.x)]
    assert np.array_equal(one.image[0, 0], corner)
    assert one.image.shape[:2] == (round(k * box.height), round(k * box.width))


BLOCKS = Drawing.HALF_BLOCKS
ENVIRONMENTS = [
    ({}, BLOCKS, Colours.PALETTE),
    ({"TERM": "xterm-256color"}, BLOCKS, Colours.PALETTE),
    ({"TERM": "xterm-256color", "COLORTERM": "truecolor"}, BLOCKS, Colours.ALL),
    ({"TERM": "xterm-kitty", "KITTY_WINDOW_ID": "1"}, Drawing.KITTY, Colours.ALL),
    ({"TERM": "xterm-256color", "KITTY_WINDOW_ID": "1"}, Drawing.KITTY, Colours.ALL),
    ({"TERM": "xterm-ghostty", "TERM_PROGRAM": "ghostty"}, Drawing.KITTY, Colours.ALL),
    ({"TERM_PROGRAM": "iTerm.app", "LC_TERMINAL": "iTerm2"}, Drawing.ITERM2, Colours.ALL),
    ({"LC_TERMINAL": "iTerm2", "SSH_TTY": "/dev/pts/1"}, Drawing.ITERM2, Colours.ALL),
    ({"TERM_PROGRAM": "WezTerm"}, Drawing.ITERM2, Colours.ALL),
    ({"TERM": "foot"}, Drawing.SIXEL, Colours.ALL),
    ({"KONSOLE_VERSION": "230805"}, Drawing.SIXEL, Colours.PALETTE),
    ({"KONSOLE_VERSION": "211203"}, BLOCKS, Colours.PALETTE),
    ({"TERM_PROGRAM": "Apple_Terminal", "TERM": "xterm-256color"}, BLOCKS, Colours.PALETTE),
    # Started from a terminal that draws pictures, these inherit its variables and draw none.
    ({"TERM_PROGRAM": "vscode", "KITTY_WINDOW_ID": "1"}, BLOCKS, Colours.ALL),
    ({"TERM_PROGRAM": "vscode", "LC_TERMINAL": "iTerm2"}, BLOCKS, Colours.ALL),
    ({"VTE_VERSION": "7600", "KITTY_WINDOW_ID": "1"}, BLOCKS, Colours.ALL),
    ({"TERM": "alacritty", "WEZTERM_PANE": "0"}, BLOCKS, Colours.ALL),
    ({"OS": "Windows_NT", "TERM_PROGRAM": "WezTerm"}, BLOCKS, Colours.ALL),
    # These stand between a program and the terminal, and pass no pictures on.
    ({"TMUX": "/tmp/tmux,1,0", "TERM": "xterm-kitty"}, BLOCKS, Colours.PALETTE),
    ({"TERM": "tmux-256color", "LC_TERMINAL": "iTerm2"}, BLOCKS, Colours.PALETTE),
    ({"TERM": "screen.xterm-256color", "KITTY_WINDOW_ID": "1"}, BLOCKS, Colours.PALETTE),
    ({"STY": "1.pts", "COLORTERM": "truecolor", "KITTY_WINDOW_ID": "1"}, BLOCKS, Colours.PALETTE),
    ({"ZELLIJ": "0", "TERM": "xterm-kitty"}, BLOCKS, Colours.PALETTE),
]


@pytest.mark.parametrize(("environment", "drawing", "colours"), ENVIRONMENTS)
def test_a_terminal_is_known_by_what_it_sets(
    environment: dict[str, str], drawing: Drawing, colours: Colours
) -> None:
    assert abilities(environment) == (drawing, colours)
