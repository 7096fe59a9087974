"""Colours of text: each is legible on the default background of every terminal that is known."""

from __future__ import annotations

import re
from dataclasses import dataclass
from itertools import combinations

import pytest

from nmatrix.cli.app import load
from nmatrix.cli.help import of_command
from nmatrix.output import Charset, Colour, OutputOptions, write
from nmatrix.output.style import AXES, MARKS, Style, plain, render
from nmatrix.report import Report, Text, Tone, Verdict

LEGIBLE = 3.0  # WCAG's least contrast of large text and of signs
Rgb = tuple[int, int, int]


@dataclass(frozen=True)
class Terminal:
    """A theme as it is shipped: paper, ink, and the sixteen colours that are its own."""

    name: str
    paper: str
    ink: str
    sixteen: str

    def colour(self, index: int) -> Rgb:
        """Return one of the 256 colours: 16 of the theme's, the cube of 216, and 24 greys."""
        if index < 16:
            return rgb(self.sixteen.split()[index])
        if index >= 232:
            return (8 + 10 * (index - 232),) * 3
        steps = (0, 95, 135, 175, 215, 255)
        red, rest = divmod(index - 16, 36)
        return steps[red], steps[rest // 6], steps[rest % 6]


XTERM = (
    "000000 cd0000 00cd00 cdcd00 0000ee cd00cd 00cdcd e5e5e5 "
    "7f7f7f ff0000 00ff00 ffff00 5c5cff ff00ff 00ffff ffffff"
)
CAMPBELL = (
    "0c0c0c c50f1f 13a10e c19c00 0037da 881798 3a96dd cccccc "
    "767676 e74856 16c60c f9f1a5 3b78ff b4009e 61d6d6 f2f2f2"
)
CONSOLE = (
    "000000 800000 008000 808000 000080 800080 008080 c0c0c0 "
    "808080 ff0000 00ff00 ffff00 0000ff ff00ff 00ffff ffffff"
)
SOLARIZED = (
    "073642 dc322f 859900 b58900 268bd2 d33682 2aa198 eee8d5 "
    "002b36 cb4b16 586e75 657b83 839496 6c71c4 93a1a1 fdf6e3"
)
VS_CODE_DARK = (
    "000000 cd3131 0dbc79 e5e510 2472c8 bc3fbc 11a8cd e5e5e5 "
    "666666 f14c4c 23d18b f5f543 3b8eea d670d6 29b8db e5e5e5"
)
VS_CODE_LIGHT = (
    "000000 cd3131 107c10 949800 0451a5 bc05bc 0598bc 555555 "
    "666666 cd3131 14ce14 b5ba00 0451a5 bc05bc 0598bc a5a5a5"
)
TERMINALS = (
    Terminal("xterm, black", "000000", "e5e5e5", XTERM),
    Terminal("xterm, white", "ffffff", "000000", XTERM),
    Terminal("VS Code, dark", "1e1e1e", "cccccc", VS_CODE_DARK),
    Terminal("VS Code, light", "ffffff", "333333", VS_CODE_LIGHT),
    Terminal("Solarized, dark", "002b36", "839496", SOLARIZED),
    Terminal("Solarized, light", "fdf6e3", "657b83", SOLARIZED),
    Terminal("Windows Terminal", "0c0c0c", "cccccc", CAMPBELL),
    Terminal("Windows console", "000000", "c0c0c0", CONSOLE),
    Terminal("Windows PowerShell", "012456", "eeedf0", CONSOLE),
)
NAMED = pytest.mark.parametrize("terminal", TERMINALS, ids=lambda one: one.name)


def rgb(digits: str) -> Rgb:
    return int(digits[:2], 16), int(digits[2:4], 16), int(digits[4:], 16)


def luminance(colour: Rgb) -> float:
    linear = (
        level / 12.92 if level <= 0.04045 else ((level + 0.055) / 1.055) ** 2.4
        for level in (channel / 255 for channel in colour)
    )
    return sum(part * one for part, one in zip((0.2126, 0.7152, 0.0722), linear, strict=True))


def contrast(a: Rgb, b: Rgb) -> float:
    dark, light = sorted((luminance(a), luminance(b)))
    return (light + 0.05) / (dark + 0.05)


def shown(escape: str, terminal: Terminal) -> Rgb:
    """Return the colour in which a terminal shows text after an escape."""
    codes = [int(code) for code in re.findall(r"\d+", escape)]
    assert 2 not in codes or 38 in codes, "how faint faint text is, each terminal decides"
    if 38 in codes:
        return terminal.colour(codes[codes.index(38) + 2])
    for code in codes:
        if 30 <= code < 38 or 90 <= code < 98:
            return terminal.colour(code - 30 if code < 38 else code - 82)
    return rgb(terminal.ink)


def test_the_measure_knows_what_is_written_about_contrast() -> None:
    assert contrast((0, 0, 0), (255, 255, 255)) == pytest.approx(21)
    xterm = TERMINALS[0]
    assert shown("\x1b[34m", xterm) == (0, 0, 238)
    assert contrast(shown("\x1b[34m", xterm), rgb(xterm.paper)) < LEGIBLE


@NAMED
@pytest.mark.parametrize("style", Style)
def test_a_style_is_legible_on_the_background(style: Style, terminal: Terminal) -> None:
    assert contrast(shown(style.value, terminal), rgb(terminal.paper)) >= LEGIBLE


def test_help_is_printed_in_styles_that_are_legible() -> None:
    page = of_command(load("render"), full=True)
    assert {span.style for line in page for span in line} == {Style.PLAIN, Style.TITLE}


def test_what_means_something_else_has_another_colour() -> None:
    meaning = [*AXES.values(), *MARKS.values(), Style.DIM]
    for a, b in combinations(meaning, 2):
        colours = shown(a.value, TERMINALS[0]), shown(b.value, TERMINALS[0])
        apart = [abs(x - y) for x, y in zip(*colours, strict=True)]
        assert max(apart) >= 80, (a.name, b.name)


@pytest.mark.parametrize(
    ("tone", "style"),
    [(Tone.RIGHT, Style.RIGHT), (Tone.WRONG, Style.WRONG), (Tone.NEUTRAL, Style.TITLE)],
)
def test_a_verdict_has_the_colour_of_what_it_says(tone: Tone, style: Style) -> None:
    report = Report("x", {}, (Verdict("So it is.", tone),))
    coloured = write(report, OutputOptions(colour=Colour.ANSI))
    assert coloured == f"{style}So it is.\x1b[0m\n"
    assert write(report, OutputOptions()) == "So it is.\n"


def test_marks_in_any_line_have_their_colour_and_no_letter_changes() -> None:
    text = "✗ A n, ✓ A⁻ᵀn"
    found = render(plain(text), Colour.ANSI)
    assert found == f"{Style.WRONG}✗\x1b[0m A n, {Style.RIGHT}✓\x1b[0m A⁻ᵀn"
    report = Report("x", {}, (Text(text),))
    assert f"{Style.WRONG}✗" in write(report, OutputOptions(colour=Colour.ANSI))
    assert write(report, OutputOptions(charset=Charset.ASCII)).isascii()
