"""A session of the calculator on a terminal: its prompt at once, and the rest while someone thinks.

The prompt stands before the calculator is loaded. What is typed till then waits in the terminal.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from nmatrix.calculator import PROMPT
from nmatrix.errors import defect

if TYPE_CHECKING:
    from nmatrix.calculator.sessions.session import Session
    from nmatrix.cli.line_readers import LineReader
    from nmatrix.output.write import OutputOptions

Begin = Callable[[], "tuple[Session, Callable[[], OutputOptions]]"]


def on_terminal() -> bool:
    """Whether someone types, and reads what comes."""
    return sys.stdin is not None and sys.stdin.isatty() and sys.stdout.isatty()


def usual_session() -> tuple[Session, Callable[[], OutputOptions]]:
    """Begin a session without any option."""
    from nmatrix.calculator.names import EVERY_NAME, names_of
    from nmatrix.calculator.sessions.session import Session, Settings
    from nmatrix.cli.shared_options import CommonOptions
    from nmatrix.cli.show import options_of
    from nmatrix.scene.setup import Setup

    common = CommonOptions().as_text()
    settings = Settings(digits=common.digits_checked)
    return Session(names_of(Setup(), EVERY_NAME), settings), lambda: options_of(common)


def converse(begin: Begin) -> None:
    """Hold a session until someone leaves it; an error ends a line, and nothing else."""
    with _keys_waiting() as terminal:
        _put(PROMPT)
        begun, options = begin()
        reader = _reader()
        terminal.heed(echoes=reader.needs_echo)
        _put("\r")
        session: Session | None = begun
        while session is not None:
            try:
                session = _after_a_line(session, reader, options())
            except KeyboardInterrupt:
                reader.end_line()


def _after_a_line(session: Session, reader: LineReader, options: OutputOptions) -> Session | None:
    """Read a statement and show what it comes to; there is no session after the last one."""
    from nmatrix.cli.show import put
    from nmatrix.output.transcript import Disk, turn

    try:
        statement = reader.read(session.names)
    except (EOFError, OSError):  # Ctrl-D, or the terminal is gone
        put("\n")
        return None
    try:
        done = turn(session, statement, options, Disk())
        put(done.text)
    except KeyboardInterrupt:
        put("interrupted\n")
        return session
    except Exception as error:  # the session outlives what should not happen
        if "NMATRIX_DEBUG" in os.environ:
            raise
        put(f"error: {defect(error)}\n")
        return session
    return None if done.reply.quits else done.session


def _reader() -> LineReader:
    from nmatrix.cli.line_readers import History, reader_of

    return reader_of(History.usual())


class _Terminal:
    """A terminal whose keys wait unseen until someone reads them."""

    def __init__(self) -> None:
        import signal
        import termios

        self.usual = termios.tcgetattr(0)
        waiting = self.usual.copy()
        waiting[3] &= ~(termios.ECHO | termios.ICANON)
        self.interrupted = signal.signal(signal.SIGINT, signal.SIG_IGN)  # it drops the line itself
        termios.tcsetattr(0, termios.TCSANOW, waiting)

    def heed(self, *, echoes: bool) -> None:
        """Let Ctrl-C be heard, and let the terminal show its keys where the reader does not."""
        import signal

        signal.signal(signal.SIGINT, self.interrupted)
        if echoes:
            self.leave()

    def leave(self) -> None:
        """Put the terminal back as it was."""
        import termios

        termios.tcsetattr(0, termios.TCSANOW, self.usual)


class _NoTerminal:
    """What there is where keys cannot be made to wait."""

    def heed(self, *, echoes: bool) -> None:
        """Do nothing."""

    def leave(self) -> None:
        """Do nothing."""


@contextmanager
def _keys_waiting() -> Iterator[_Terminal | _NoTerminal]:
    """Keep keys unseen, till the end if the reader shows them itself."""
    try:
        terminal: _Terminal | _NoTerminal = _Terminal()
    except (ImportError, OSError):  # Windows
        terminal = _NoTerminal()
    try:
        yield terminal
    finally:
        terminal.heed(echoes=True)


def _put(text: str) -> None:
    sys.stdout.write(text)
    sys.stdout.flush()
