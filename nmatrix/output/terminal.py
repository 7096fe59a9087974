"""What a terminal can draw, told by its environment: nothing is asked of it, so nothing can hang.

A terminal is believed only where it names itself. Inside tmux and screen, which keep pictures from
the terminal behind them, and on Windows, whose console drops them, half blocks are all there is.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum

from nmatrix.output.write import Charset

CELL = (8, 16)  # pixels of a character where the terminal does not tell


class Drawing(StrEnum):
    """The ways to draw: three protocols for pictures, half blocks in colour, and characters."""

    KITTY = "kitty"
    ITERM2 = "iterm2"
    SIXEL = "sixel"
    HALF_BLOCKS = "half-blocks"
    CHARACTERS = "characters"

    @property
    def has_pixels(self) -> bool:
        """True where a picture is sent as one."""
        return self in (Drawing.KITTY, Drawing.ITERM2, Drawing.SIXEL)


class Colours(StrEnum):
    """How many colours a character may have."""

    ALL = "all"
    PALETTE = "256"


@dataclass(frozen=True)
class Screen:
    """A terminal to draw on: characters across and down, the pixels of each, and what it can."""

    columns: int
    lines: int
    drawing: Drawing
    colours: Colours = Colours.ALL
    cell: tuple[int, int] = CELL
    charset: Charset = Charset.UNICODE


@dataclass(frozen=True)
class _Known:
    """A variable whose value matches, and what the terminal that sets it can draw.

    Without `colours`, COLORTERM is believed.
    """

    variable: str
    pattern: str
    drawing: Drawing = Drawing.HALF_BLOCKS
    colours: Colours | None = None


# The first that matches decides. Variables reach programs that are started from a terminal, and
# other terminals among them: so TERM and TERM_PROGRAM, which each sets anew, come before the rest.
_TERMINALS = (
    _Known("OS", "Windows_NT", colours=Colours.ALL),
    _Known("STY", ".+", colours=Colours.PALETTE),
    _Known("TMUX", ".+"),
    _Known("ZELLIJ", ".+"),
    _Known("TERM", "(screen|tmux).*"),
    _Known("TERM", "xterm-(kitty|ghostty)", Drawing.KITTY, Colours.ALL),
    _Known("TERM", "(foot|mlterm|contour)(-.*)?", Drawing.SIXEL, Colours.ALL),
    _Known("TERM", "alacritty(-.*)?", colours=Colours.ALL),
    _Known("TERM_PROGRAM", "ghostty", Drawing.KITTY, Colours.ALL),
    _Known("TERM_PROGRAM", "iTerm.app|WezTerm", Drawing.ITERM2, Colours.ALL),
    _Known("TERM_PROGRAM", "vscode", colours=Colours.ALL),
    _Known("TERM_PROGRAM", ".+"),
    _Known("LC_TERMINAL", "iTerm2", Drawing.ITERM2, Colours.ALL),
    _Known("KONSOLE_VERSION", r"(220[4-9]|22[1-9]\d|2[3-9]\d\d|[3-9]\d{3})\d\d", Drawing.SIXEL),
    _Known("KONSOLE_VERSION", ".+"),
    _Known("VTE_VERSION", ".+", colours=Colours.ALL),
    _Known("ALACRITTY_WINDOW_ID", ".+", colours=Colours.ALL),
    _Known("XTERM_VERSION", ".+"),
    _Known("KITTY_WINDOW_ID", ".+", Drawing.KITTY, Colours.ALL),
    _Known("WEZTERM_PANE", ".+", Drawing.ITERM2, Colours.ALL),
)
_UNKNOWN = _Known("", "")


def abilities(environment: Mapping[str, str]) -> tuple[Drawing, Colours]:
    """Recognise the terminal by the variables that it sets.

    Examples
    --------
    >>> abilities({"TERM": "xterm-kitty"})
    (<Drawing.KITTY: 'kitty'>, <Colours.ALL: 'all'>)
    >>> abilities({"TERM": "xterm-kitty", "TMUX": "/tmp/tmux-0/default,1,0"})[0]
    <Drawing.HALF_BLOCKS: 'half-blocks'>
    """
    found = next((one for one in _TERMINALS if _matches(one, environment)), _UNKNOWN)
    told = environment.get("COLORTERM") in ("truecolor", "24bit")
    return found.drawing, found.colours or (Colours.ALL if told else Colours.PALETTE)


def _matches(one: _Known, environment: Mapping[str, str]) -> bool:
    return re.fullmatch(one.pattern, environment.get(one.variable, "")) is not None
