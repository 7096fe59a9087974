"""A real terminal: what a command writes to one, of each kind, with its pixels and its colours."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Callable

import pytest
from read_terminal import characters, pixels_of_sixels

from nmatrix.output.style import Style

pty = pytest.importorskip("pty")
fcntl = pytest.importorskip("fcntl")
termios = pytest.importorskip("termios")
struct = pytest.importorskip("struct")

LINES, COLUMNS, WIDTH, HEIGHT = 40, 100, 1000, 800
KNOWN = ("TERM", "TMUX", "STY", "ZELLIJ", "COLORTERM", "TERM_PROGRAM", "LC_TERMINAL", "NO_COLOR")
KNOWN += ("KITTY_WINDOW_ID", "WEZTERM_PANE", "KONSOLE_VERSION", "VTE_VERSION", "FORCE_COLOR", "OS")
Shown = Callable[..., str]
DRAWN = "render slope.obj --size 120 80"
SLOPE = "v 0 0 0\nv 1 0 0\nv 0 1 1\nf 1 2 3\n"


@pytest.fixture
def shown(tmp_path) -> Shown:
    """Run a line on a terminal of its own and return all that it was sent."""

    (tmp_path / "slope.obj").write_text(SLOPE)

    def call(line: str, **environment: str) -> str:
        ours, theirs = pty.openpty()
        fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", LINES, COLUMNS, WIDTH, HEIGHT))
        clean = {name: value for name, value in os.environ.items() if name not in KNOWN}
        with subprocess.Popen(
            [sys.executable, "-m", "nmatrix", *line.split()],
            stdin=theirs,
            stdout=theirs,
            stderr=theirs,
            cwd=tmp_path,
            env={**clean, "PYTHONIOENCODING": "utf-8", **environment},
        ):
            os.close(theirs)
            found = b""
            try:
                while piece := os.read(ours, 65536):
                    found += piece
            except OSError:  # Linux says so when the other side is closed
                pass
        os.close(ours)
        return found.decode().replace("\r\n", "\n")

    return call


PICTURE = {
    "xterm-kitty": "\x1b_Ga=T,f=100,q=2,",
    "foot": '\x1bP0;1q"1;1;',
}


@pytest.mark.parametrize("term", PICTURE)
def test_a_terminal_that_takes_pictures_gets_one(shown: Shown, term: str) -> None:
    found = shown(f"{DRAWN} --preview", TERM=term)
    assert found.count(PICTURE[term]) == 1
    assert "▀" not in found
    assert "image_" not in found


def test_the_pixels_of_a_terminal_are_known(shown: Shown) -> None:
    found = shown("render slope.obj --size 1600 900 --preview", TERM="foot")
    height, width = pixels_of_sixels(found).shape[:2]
    assert width <= WIDTH
    assert width >= WIDTH - 20 or height >= HEIGHT - 60


def test_another_terminal_gets_half_blocks_over_its_whole_width(shown: Shown) -> None:
    found = shown(f"{DRAWN} --preview", TERM="xterm-256color")
    blocks = [line for line in characters(found).letters if "▀" in line]
    assert blocks
    assert max(map(len, blocks)) <= COLUMNS
    assert "8;5;" in found
    assert "8;2;" not in found


@pytest.mark.parametrize(
    "environment",
    [{"TERM": "dumb"}, {"TERM": "xterm-kitty", "NO_COLOR": "1"}],
    ids=["dumb", "NO_COLOR"],
)
def test_without_colour_a_terminal_gets_characters(shown: Shown, environment: dict) -> None:
    found = shown(f"{DRAWN} --preview", **environment)
    assert "\x1b" not in found
    assert "..." in found


def test_an_error_is_red_on_a_terminal_alone(shown: Shown, nmatrix) -> None:
    line = "world --scale x"
    found = shown(line, TERM="xterm-256color")
    assert found.startswith(f"{Style.WRONG}error:\x1b[0m ")
    bare = re.sub(r"\x1b\[[\d;]*m", "", found)
    assert bare == nmatrix(line).err
    for plainly in (f"{line} --color never", f"{line} --color=never"):
        assert "\x1b" not in shown(plainly, TERM="xterm-256color")
    assert "\x1b" not in shown(line, TERM="xterm-256color", NO_COLOR="1")
