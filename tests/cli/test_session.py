"""A session on a real terminal, in a pipe and from a file: the same lines, the same answers."""

from __future__ import annotations

import importlib.util
import os
import re
import select
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import pytest

import nmatrix as package
from nmatrix.cli.line_readers import History

pty = pytest.importorskip("pty")
fcntl = pytest.importorskip("fcntl")
termios = pytest.importorskip("termios")
struct = pytest.importorskip("struct")

TOOLKIT = importlib.util.find_spec("prompt_toolkit") is not None
READERS = ["plain", pytest.param("toolkit", marks=pytest.mark.skipif(not TOOLKIT, reason="extra"))]
SIZE = struct.pack("HHHH", 50, 80, 0, 0)
ESCAPE = re.compile(r"\x1b\[[0-9;?]*[a-zA-Z]|\x1b[=>]|\x1b\][^\x07]*\x07")
LONGEST = 30  # seconds that a slow machine may take for a line
# It makes the terminal its own first, so that Ctrl-C reaches it.
OWN_TERMINAL = """
import fcntl, termios
fcntl.ioctl(0, termios.TIOCSCTTY, 0)
from nmatrix.__main__ import main
main()
"""
LINES = """\
# the world
M = [2 0
  0 1/2]
det(M)
x = M @ [1, 2] + Qq
inverse(M) @ M == identity(2)
steps on
det(M)
show M as glsl
numbers both
1/3
undo
B = 1 2
3 4

B^2
quit
"""


EVENING = (Path(__file__).parents[2] / "docs" / "samples" / "evening.calc").read_text("utf-8")


class Terminal:
    """A terminal with a session on it; keys go in, and what it was sent comes out."""

    def __init__(self, folder: Path, reader: str, *words: str) -> None:
        self.ours, theirs = pty.openpty()
        fcntl.ioctl(theirs, termios.TIOCSWINSZ, SIZE)
        path = f"{Path(package.__file__).parents[1]}"
        if reader == "plain":  # a package of that name that is none
            (folder / "none" / "prompt_toolkit").mkdir(parents=True, exist_ok=True)
            (folder / "none" / "prompt_toolkit" / "__init__.py").write_text("raise ImportError\n")
            path = f"{folder / 'none'}{os.pathsep}{path}"
        self.process = subprocess.Popen(
            [sys.executable, "-c", OWN_TERMINAL, "calc", *words],
            stdin=theirs,
            stdout=theirs,
            stderr=theirs,
            cwd=folder,
            start_new_session=True,
            env={**os.environ, "PYTHONPATH": path, "TERM": "xterm", "PYTHONIOENCODING": "utf-8",
                 "NO_COLOR": "1", "PROMPT_TOOLKIT_NO_CPR": "1",
                 "XDG_STATE_HOME": str(folder / "state")},
        )  # fmt: skip
        os.close(theirs)
        self.raw, self.place = "", 0
        self.until("> ")

    def type(self, keys: str) -> None:
        os.write(self.ours, keys.encode())

    @property
    def seen(self) -> str:
        """What was sent, without the signs that move and colour."""
        return ESCAPE.sub("", self.raw).replace("\r", "")

    def until(self, wanted: str) -> None:
        """Wait for a text behind the one that was waited for before."""
        assert self.comes(wanted, LONGEST), f"{wanted!r} did not come, but {self.seen!r}"

    def comes(self, wanted: str, seconds: float) -> bool:
        """Wait so long for a text at the most."""
        end = time.monotonic() + seconds
        while (found := self.seen.find(wanted, self.place)) < 0:
            ready, _, _ = select.select([self.ours], [], [], max(0.0, end - time.monotonic()))
            if not ready:
                return False
            self.raw += os.read(self.ours, 65536).decode(errors="replace")
        self.place = found + len(wanted)
        return True

    def interrupt(self) -> None:
        """Type Ctrl-C: one that falls between two waits of Python is heard with the next key."""
        for _ in range(LONGEST):
            self.type("\x03")
            if self.comes(">", 1):
                return
        raise AssertionError(f"Ctrl-C ends nothing: {self.seen!r}")

    def answer(self, line: str, wanted: str) -> None:
        """Type a line, and wait for its answer and the next prompt."""
        self.type(f"{line}\r")
        self.until(f"{wanted}\n")
        self.until(">")

    def until_end(self) -> int:
        """Wait for the end."""
        with suppress(OSError):  # Linux says so when the other side is closed
            while piece := os.read(self.ours, 65536):
                self.raw += piece.decode(errors="replace")
        return self.process.wait(LONGEST)

    def close(self) -> None:
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()
        os.close(self.ours)


@pytest.fixture(params=READERS)
def terminal(tmp_path, request) -> Iterator[Terminal]:
    found = Terminal(tmp_path, request.param)
    yield found
    found.close()


def test_a_file_a_pipe_and_python_print_the_same_bytes(nmatrix, own_folder):
    Path("lesson.txt").write_text(LINES)
    wanted = str(package.calc(LINES))
    assert wanted.startswith("> # the world\n> M = [2 0\n    0 1/2]\nM\n")
    code, out, err = nmatrix("calc lesson.txt")
    assert out == wanted
    assert code == 2
    assert err.startswith("error: line 5: name Qq (character 14): ")
    assert err.count("\n") == 1
    for words in ((), ("-",)):
        piped = subprocess.run(
            [sys.executable, "-m", "nmatrix", "calc", *words],
            input=LINES, capture_output=True, text=True, check=False, encoding="utf-8",
            env={**os.environ, "PYTHONIOENCODING": "utf-8",
                 "PYTHONPATH": str(Path(package.__file__).parents[1])},
        )  # fmt: skip
        assert (piped.returncode, piped.stdout, piped.stderr) == (code, out, err)


@pytest.mark.parametrize(
    ("text", "code", "others"),
    [("1/0\n1/\n", 3, True), ("1/\n1/0\n", 2, True), ("1\n1/0", 3, False), ("1\n", 0, False)],
)
def test_a_run_ends_in_the_code_of_its_first_error(nmatrix, own_folder, text, code, others):
    Path("lines.txt").write_text(text)
    found = nmatrix("calc lines.txt")
    assert found.code == code
    assert ("and 1 other statement failed" in found.err) == others
    Path("nothing.txt").write_text("\n")
    assert nmatrix("calc nothing.txt") == (0, "", "")


@pytest.mark.parametrize("content", [b"\x00", b"\xff\xfe\xff", b"1+" * 10**6])
def test_what_is_no_text_is_refused_at_once(nmatrix, own_folder, content):
    Path("file.txt").write_bytes(content)
    found = nmatrix("calc file.txt")
    assert (found.code, found.out) == (2, "")
    assert found.is_one_line


def test_a_terminal_shows_what_a_file_prints(terminal):
    """Line for line; how a line looks while it is typed is the reader's business."""
    terminal.type(LINES.replace("\n", "\r"))
    assert terminal.until_end() == 0
    position = 0
    for line in str(package.calc(LINES)).splitlines():
        if line.strip() and not line.startswith(("> ", "  ")):
            position = terminal.seen.find(f"\n{line}\n", position)
            assert position >= 0, line


def test_an_evening_is_the_same_on_a_terminal_from_a_file_and_in_python(
    terminal, nmatrix, own_folder
) -> None:
    """The sixty lines of the documentation: the course from an object to the shader's matrix."""
    assert EVENING.count("\n") == 60
    wanted = str(package.calc(EVENING))
    Path("evening.calc").write_text(EVENING, "utf-8")
    assert nmatrix("calc evening.calc").out == wanted
    position = 0
    for line in EVENING.splitlines():
        terminal.type(f"{line}\r")
        terminal.until("> ")
    terminal.type("\x04")
    assert terminal.until_end() == 0
    for line in wanted.splitlines():
        if line.strip() and not line.startswith(("> ", "  ")):
            position = terminal.seen.find(f"\n{line}\n", position)
            assert position >= 0, line


def test_ctrl_c_ends_the_line_and_ctrl_d_the_session(terminal):
    terminal.answer("a = 5", "a  5")
    terminal.type("b = [1 2")
    terminal.until("b = [1 2")
    terminal.interrupt()
    terminal.answer("a + 1/", "it ends too early")
    terminal.answer("a * 7", "ans  35")
    terminal.type("\x04")
    assert terminal.until_end() == 0


def test_tab_completes_a_name_and_the_arrow_brings_a_line_back(terminal):
    terminal.answer("Neptune = 11", "Neptune  11")
    terminal.answer("2*Nep\t", "ans  22")
    terminal.answer("\x1b[A\x1b[A", "Neptune  11")


def test_a_kill_leaves_the_history_whole(terminal, tmp_path):
    terminal.type("k = [1\r2]\r")
    terminal.until("k  ( 1  2 )\n")
    os.kill(terminal.process.pid, signal.SIGKILL)
    history = History(tmp_path / "state" / "nmatrix" / "history")
    assert history.statements() == ["k = [1\n2]"]


def test_options_are_there_from_the_start(tmp_path):
    terminal = Terminal(tmp_path, "plain", "--scale", "2", "3", "4", "--let", "T=5 0; 0 1")
    terminal.answer("det(M) * det(T)", "ans  120")
    terminal.close()


def test_a_history_that_cannot_be_written_is_no_error(tmp_path):
    (tmp_path / "file").write_text("")
    history = History(tmp_path / "file" / "history")
    history.keep("1 + 1")
    assert history.statements() == []


def test_a_line_of_the_history_that_was_cut_is_left_out(tmp_path):
    history = History(tmp_path / "history")
    for one in ("a = 1", "back\\slash \\n", "M = [1\n2]"):
        history.keep(one)
    with history.path.open("a") as file:
        file.write("a half")
    assert history.statements() == ["a = 1", "back\\slash \\n", "M = [1\n2]"]


def test_a_run_has_colours_where_they_are_wanted(nmatrix, own_folder):
    Path("lines.txt").write_text("1 +\n")
    assert (
        "\x1b[1;38;5;166merror:\x1b[0m expression" in nmatrix("calc lines.txt --color always").out
    )
    assert "\x1b" not in nmatrix("calc lines.txt").out
    remark = nmatrix("calc lines.txt --rotate 0 0 1.5708").out
    assert remark.splitlines()[-1].startswith("• ") or "radians" in remark


@pytest.mark.parametrize(
    ("options", "line", "wanted"),
    [
        ("--numbers both", "1/3", "ans  1/3 ≈ 0.333333"),
        ("--digits 3 --numbers decimal", "1/3", "ans  0.333"),
        ("--float", "0.1 + 0.2", "ans  0.3\n\n• Every product, sum,"),
        ("--untyped", "V @ P @ M == V @ P @ M", "ans  yes"),
        ("--steps", "det([2 1; 1 1])", "  det A = 2·1 − 1·1 = 2 − 1 = 1"),
        ("--by gauss", "inverse([2 1; 1 1])", "R₂ ← R₂ − R₁"),
        ("--input-layout column-major", "1 2; 3 4", "  ⎡ 1  3 ⎤"),
        ("--eye 0 0 9", "V[2, 3]", "ans  -9"),
    ],
)
def test_options_are_what_a_session_begins_with(nmatrix, own_folder, options, line, wanted):
    Path("lines.txt").write_text(line)
    found = nmatrix(f"calc lines.txt {options}")
    assert found.code == 0, found.err
    assert wanted in found.out


def test_words_that_have_no_place_in_a_session_are_refused(nmatrix, tmp_path):
    assert "there is no such file" in nmatrix("calc lesson.txt").err
    assert nmatrix("calc 'd = 2'").out == "> d = 2\nd  2\n"
