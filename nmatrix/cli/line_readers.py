"""How statements are typed on a terminal: with prompt_toolkit, else readline, else as they come.

All three keep one history, and take a paste as if it were typed line by line.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from shutil import get_terminal_size
from typing import TYPE_CHECKING, Protocol

from nmatrix.calculator import MORE, PROMPT
from nmatrix.calculator.offers import Offer, offers
from nmatrix.calculator.statements import is_open, statements
from nmatrix.calculator.tokens import LONGEST
from nmatrix.output.transcript import LONGEST as LONGEST_TEXT

if TYPE_CHECKING:
    from prompt_toolkit.key_binding import KeyBindings, KeyPressEvent
    from prompt_toolkit.key_binding.key_processor import KeyPress

KEPT = 2000  # statements of the history
HINT = "help lists what can be written"


class LineReader(Protocol):
    """Reads one statement after the other.

    `needs_echo` is one that leaves it to the terminal to show keys.
    """

    needs_echo: bool

    def read(self, names: Iterable[str]) -> str:
        """Read a statement; TAB offers these names.

        Raises
        ------
        EOFError
            For Ctrl-D.
        KeyboardInterrupt
            For Ctrl-C, which ends the line.
        """
        ...

    def end_line(self) -> None:
        """Go to a new line after an interrupt, if the cursor is still behind something."""
        ...


@dataclass(frozen=True)
class History:
    """The statements of all sessions in a file, one a line, written whole or not at all."""

    path: Path

    @classmethod
    def usual(cls) -> History:
        """Take the file in the folder that the system has for such things."""
        state = os.environ.get("XDG_STATE_HOME") or os.environ.get("LOCALAPPDATA") or ""
        folder = Path(state) if Path(state).is_absolute() else Path("~/.local/state")
        with suppress(RuntimeError):  # nobody is at home
            folder = folder.expanduser()
        return cls(folder / "nmatrix" / "history")

    def statements(self) -> list[str]:
        """Read the statements, the oldest first; none where there is no file."""
        try:
            lines = self.path.read_text("utf-8", "replace").split("\n")[:-1]
        except OSError:
            return []
        return [_unfolded(line) for line in lines[-KEPT:] if line]

    def keep(self, statement: str) -> None:
        """Append a statement; a file that cannot be written is no error."""
        line = f"{_folded(statement)}\n".encode("utf-8", "replace")
        with suppress(OSError):
            self.path.parent.mkdir(parents=True, exist_ok=True)
            file = os.open(self.path, os.O_WRONLY | os.O_CREAT | os.O_APPEND, 0o600)
            try:
                os.write(file, line)
            finally:
                os.close(file)


def _folded(statement: str) -> str:
    r"""Write a statement in one line.

    Examples
    --------
    >>> _folded("[1\n2]"), _unfolded(_folded("[1\n2]")) == "[1\n2]"
    ('[1\\n2]', True)
    """
    return statement.replace("\\", "\\\\").replace("\r", "").replace("\n", "\\n")


def _unfolded(line: str) -> str:
    return "\\".join(part.replace("\\n", "\n") for part in line.split("\\\\"))


def reader_of(history: History) -> LineReader:
    """Choose the best reader that there is."""
    if os.environ.get("TERM") != "dumb":
        try:
            return _ToolkitReader(history)
        except ImportError:
            pass
    return _PlainReader(history)


def completed(names: Iterable[str], before: str) -> Offer:
    """Offer words, and the files that are there."""
    offer = offers(names, before)
    if not offer.is_file:
        return offer
    folder, slash, begun = offer.begun.rpartition("/")
    with suppress(OSError, ValueError, RuntimeError):
        there = sorted(Path(folder + slash or ".").expanduser().iterdir())
        found = (one for one in there if one.name.startswith(begun) and one.name.isprintable())
        words = (f"{folder}{slash}{one.name}{'/' if one.is_dir() else ''}" for one in found)
        return Offer(offer.begun, tuple(words), is_file=True)
    return Offer(offer.begun, is_file=True)


class _PlainReader:
    """Reads lines by `input`, which readline completes and remembers where it is there."""

    needs_echo = True

    def __init__(self, history: History) -> None:
        self.history = history
        self.names: tuple[str, ...] = ()
        self.offered: tuple[str, ...] = ()
        self.waiting = ""  # a line that begins the next statement
        try:
            import readline
        except ImportError:  # Windows
            return
        self.readline = readline
        for one in history.statements():
            for line in one.split("\n"):
                readline.add_history(line)
        readline.set_completer(self._completion)
        readline.set_completer_delims(" \t\n()[]{},;=+-*/@^.")
        if "libedit" in (readline.__doc__ or ""):
            readline.parse_and_bind("bind ^I rl_complete")
        else:
            readline.parse_and_bind("tab: complete")
            readline.parse_and_bind("set enable-bracketed-paste off")

    def read(self, names: Iterable[str]) -> str:
        self.names = tuple(names)
        lines, self.waiting = [self._begun()], ""
        while is_open("\n".join(lines)):
            line = input(MORE)
            if len(list(statements([*lines, line]))) > 1:
                self._wait(line)
                break
            lines.append(line)
        text = "\n".join(lines)
        if text.strip():
            self.history.keep(text)
        return text

    def _begun(self) -> str:
        if not self.waiting:
            return input(PROMPT)
        print(f"{PROMPT}{self.waiting}")
        return self.waiting

    def _wait(self, line: str) -> None:
        """Take a line off the screen, and show it again as the beginning of the next statement."""
        rows = -(-(len(MORE) + len(line) or 1) // get_terminal_size().columns)
        if os.environ.get("TERM") != "dumb":
            print(f"\x1b[{rows}A\r\x1b[J", end="", flush=True)
        self.waiting = line

    def end_line(self) -> None:
        print()

    def _completion(self, _: str, place: int) -> str | None:
        if place == 0:
            before = self.readline.get_line_buffer()[: self.readline.get_endidx()]
            offer = completed(self.names, before)
            known = len(before) - self.readline.get_begidx()  # readline replaces that much
            self.offered = tuple(one[len(offer.begun) - known :] for one in offer.words)
        return self.offered[place] if place < len(self.offered) else None


class _ToolkitReader:
    """Reads with prompt_toolkit: lines that go on, a paste, search, completion."""

    needs_echo = False

    def __init__(self, history: History) -> None:
        from prompt_toolkit import PromptSession
        from prompt_toolkit.completion import Completer, Completion
        from prompt_toolkit.history import History as ToolkitHistory
        from prompt_toolkit.shortcuts import CompleteStyle

        reader = self

        class Kept(ToolkitHistory):
            def load_history_strings(self) -> Iterator[str]:
                return reversed(history.statements())

            def store_string(self, string: str) -> None:
                history.keep(string)

        class Offered(Completer):
            def get_completions(self, document, complete_event):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN202 - of prompt_toolkit
                offer = completed(reader.names, document.text_before_cursor)
                for one in offer.words:
                    yield Completion(one, start_position=-len(offer.begun))

        self.names: tuple[str, ...] = ()
        self.placeholder = HINT
        self.session: PromptSession[str] = PromptSession(
            history=Kept(),
            completer=Offered(),
            complete_while_typing=False,
            complete_style=CompleteStyle.READLINE_LIKE,
            key_bindings=_keys(),
            multiline=True,
            prompt_continuation=MORE,
            enable_suspend=True,
        )

    def read(self, names: Iterable[str]) -> str:
        self.names = tuple(names)
        hint, self.placeholder = self.placeholder, ""
        return self.session.prompt(PROMPT, placeholder=[("fg:ansibrightblack", hint)])

    def end_line(self) -> None:
        """Do nothing: prompt_toolkit has gone to a new line."""


def _keys() -> KeyBindings:
    """Bind Enter, which goes on in open brackets, and a paste."""
    from prompt_toolkit.enums import DEFAULT_BUFFER
    from prompt_toolkit.filters import has_focus
    from prompt_toolkit.key_binding import KeyBindings
    from prompt_toolkit.keys import Keys

    keys = KeyBindings()
    typing = has_focus(DEFAULT_BUFFER)

    @keys.add(Keys.Enter, filter=typing)
    def _(event: KeyPressEvent) -> None:
        buffer = event.current_buffer
        (_, first), *others = statements(buffer.text.split("\n"))
        if others:  # a line that goes on with nothing is a statement of its own
            rest = "\n".join(one for _, one in others)
            event.key_processor.feed_multiple(_presses(f"{rest}\n"), first=True)
            buffer.text = first
        elif is_open(buffer.text):
            buffer.insert_text("\n")
            return
        buffer.validate_and_handle()

    @keys.add(Keys.BracketedPaste, filter=typing)
    def _(event: KeyPressEvent) -> None:
        text = event.data.replace("\r\n", "\n").replace("\r", "\n").replace("\t", " ")
        if len(text) > LONGEST_TEXT:
            text = f"# {len(text)} characters are too many to paste: load them as a file"
        first, more, rest = text.partition("\n")
        room = max(0, LONGEST + 1 - len(event.current_buffer.text))
        event.current_buffer.insert_text(first[:room])
        if more:
            event.key_processor.feed_multiple(_presses(more + rest), first=True)

    return keys


def _presses(text: str) -> list[KeyPress]:
    """Make the keys that type a text: every line whole, and Enter between two."""
    from prompt_toolkit.key_binding.key_processor import KeyPress
    from prompt_toolkit.keys import Keys

    found: list[KeyPress] = []
    for place, line in enumerate(text.split("\n")):
        if place:
            found.append(KeyPress(Keys.Enter))
        if line:
            found.append(KeyPress(Keys.BracketedPaste, line))
    return found
