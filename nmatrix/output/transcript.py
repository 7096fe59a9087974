"""A session of the calculator as text: each statement behind its prompt, its answer below.

A terminal, a file, a pipe and Python run statements by `turn`, so that their transcripts are alike.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from textwrap import wrap
from unicodedata import combining, east_asian_width

from nmatrix.calculator import MORE, PROMPT
from nmatrix.calculator.answer import KEYS
from nmatrix.calculator.language.faults import PlacedError
from nmatrix.calculator.language.statements import statement, statements
from nmatrix.calculator.sessions.orders import enter
from nmatrix.calculator.sessions.session import Files, Reply, Session
from nmatrix.errors import (
    IllegalValueError,
    NMatrixError,
    counted,
    placed,
    printable,
    refusal,
)
from nmatrix.errors import spelled as with_names
from nmatrix.output.files import write_file
from nmatrix.output.style import Span, Style, render, spelled
from nmatrix.output.style import printable as without_controls
from nmatrix.output.write import OutputOptions, write
from nmatrix.reading.files import decoded, file_bytes
from nmatrix.report import Code, Report, Value

AROUND = 30  # characters on either side of a caret under a long line
LONGEST = 100_000  # characters of a file of statements
_CONTROL = re.compile(r"[\x00-\x08\x0b\x0e-\x1f\x7f]")
# What a name stands for in a session; other names are options of `nmatrix calc`.
_SPELLED = {"let": "name = expression", "output": "save", "format": "as"}


@dataclass(frozen=True)
class Turn:
    """A statement that was carried out, and what is printed below it."""

    statement: str
    session: Session
    text: str
    reply: Reply

    @property
    def error(self) -> NMatrixError | None:
        """What it was refused with."""
        return self.reply.error

    @property
    def keys(self) -> dict[str, Value]:
        """What the data says of it: the keys of a calculation, or the error and its column."""
        at, error = self.reply.at, self.error
        return {
            **dict.fromkeys(KEYS, None),
            **self.reply.keys,
            "expression": self.statement,
            "error": None if error is None else error.spelled(_spell),
            "column": None if at is None else at - self.statement.rfind("\n", 0, at),
        }


class Disk:
    """The files of the folder in which the program runs."""

    def read(self, name: str) -> str:
        """Read a file of statements; ~ is the home folder.

        Raises
        ------
        IllegalValueError
            If there is none, or it holds something else.
        """
        return text_of(file_bytes(_path(name)), f"file ({printable(name)})")

    def write(self, name: str, text: str, *, force: bool) -> None:
        """Write a file whole, over an existing one only with `force`.

        Raises
        ------
        IllegalValueError
            If there is one, or it cannot be written.
        """
        path, told = _path(name), f"file ({printable(name)})"
        try:
            if path.exists() and not force:
                raise IllegalValueError(told, "it exists", "choose another name")
        except OSError as error:
            raise IllegalValueError(told, refusal(error), "choose another name") from None
        write_file(path, text.encode("utf-8", "replace"), force=force)


def _path(name: str) -> Path:
    try:
        return Path(name).expanduser()
    except RuntimeError:  # nobody is called so
        return Path(name)


def text_of(content: bytes, source: str) -> str:
    r"""Decode statements.

    Raises
    ------
    IllegalValueError
        For bytes that are no text, or too many.

    Examples
    --------
    >>> text_of(b"det(M)\r\n", "x")
    'det(M)\n'
    """
    text = decoded(content, source).replace("\r\n", "\n").replace("\r", "\n").removeprefix("\ufeff")
    found = _CONTROL.search(text)
    if found is not None:
        why = f"it holds the control character {found[0]!r}, so it is not text"
        raise IllegalValueError(source, why, "give it statements, a line each")
    if len(text) > LONGEST:
        why = f"it has {len(text)} characters, {LONGEST} are read"
        raise IllegalValueError(source, why, "cut it down")
    return text


def is_session(text: str) -> bool:
    r"""Tell statements from a single expression.

    Examples
    --------
    >>> [is_session(text) for text in ("det(M)", "d = det(M)", "det(M)\n2*ans", "vars")]
    [False, True, True, True]
    """
    asked = statement(text)
    return "\n" in text or asked.name is not None or asked.keyword is not None


def echo(statement: str) -> str:
    r"""Write a statement as a terminal shows it while it is typed.

    Examples
    --------
    >>> echo("A = [1 2\n3 4]")
    '> A = [1 2\n  3 4]\n'
    """
    first, *more = without_controls(statement.replace("\t", " ")).split("\n")
    lines = (PROMPT + first, *(MORE + line for line in more))
    return "".join(f"{line.rstrip()}\n" for line in lines)


def turn(session: Session, statement: str, options: OutputOptions, files: Files) -> Turn:
    """Carry out a statement, and write what it comes to.

    Examples
    --------
    >>> from nmatrix.calculator.sessions.session import NoFiles
    >>> print(turn(Session({}), "1/3 + 1/6", OutputOptions(), NoFiles()).text, end="")
    ans  1/2
    >>> print(turn(Session({}), "1 + )", OutputOptions(), NoFiles()).text, end="")
          ^
    error: ): a number, a name or a bracket belongs here
    """
    after, reply = enter(session, statement, files)
    if reply.report is not None:
        try:
            text = _written(reply.report, after, replace(options, format=reply.format))
        except NMatrixError as error:
            after, reply = session, Reply(error=error)
        else:
            return Turn(statement, after, text, reply)
    text = "" if reply.error is None else _refusal(statement, reply, options)
    return Turn(statement, after, text, reply)


def _written(report: Report, session: Session, options: OutputOptions) -> str:
    settings = session.settings
    how = replace(options, digits=settings.digits, numbers=settings.numbers)
    text = write(report.spelled(_spell), how)
    return text if text.endswith("\n") else f"{text}\n"


def _spell(name: str) -> str:
    return _SPELLED.get(name) or f"--{name.replace('_', '-')}"


def _refusal(statement: str, reply: Reply, options: OutputOptions) -> str:
    """Write an error, with a caret under the character where it lies."""
    assert reply.error is not None  # there is one to be told
    error = reply.error.without_caret if isinstance(reply.error, PlacedError) else reply.error
    line = spelled(f"error: {error.spelled(_spell)}", options.charset)
    first, *more = wrap(line, options.width, subsequent_indent=MORE, break_on_hyphens=False)
    head = render((Span("error:", Style.WRONG),), options.colour)
    told = "".join(f"{one}\n" for one in (head + first.removeprefix("error:"), *more))
    return told if reply.at is None else _caret(statement, reply.at, options) + told


def _caret(statement: str, at: int, options: OutputOptions) -> str:
    """Draw a caret, below the line or, where that is long or not the last, below a part of it."""
    begin = statement.rfind("\n", 0, at) + 1
    end = statement.find("\n", at)
    line = statement[begin:] if end < 0 else statement[begin:end]
    column = at - begin
    is_whole = len(line) + len(PROMPT) < options.width and line.isprintable()
    start, stop = (0, len(line)) if is_whole else (max(0, column - AROUND), column + AROUND)
    part = "".join(one if one.isprintable() else " " for one in line[start:stop])
    before = spelled(("…" if start else "") + part[: column - start], options.charset)
    caret = f"{' ' * (len(MORE) + _columns(before))}^\n"
    if is_whole and end < 0:
        return caret  # below what was typed: a prompt is as wide as a margin
    return (
        f"{MORE}{before}{spelled(part[column - start :], options.charset)}".rstrip() + f"\n{caret}"
    )


def _columns(text: str) -> int:
    """Count the columns that a text takes on a terminal."""
    return sum(0 if combining(one) else 1 + (east_asian_width(one) in "WF") for one in text)


def run(
    session: Session, text: str, options: OutputOptions, files: Files
) -> Iterator[tuple[int, Turn]]:
    """Carry out statements until one quits, each with the line that it begins in."""
    for line, one in statements(text.rstrip("\n").split("\n") if text.strip() else ()):
        done = turn(session, one, options, files)
        yield line, done
        session = done.session
        if done.reply.quits:
            break


def transcript(session: Session, text: str, options: OutputOptions, files: Files) -> Report:
    r"""Report a run of statements: the transcript, the names at its end, and every error.

    The report ends in the first error, and the run goes on behind it.

    Examples
    --------
    >>> from nmatrix.calculator.sessions.session import NoFiles
    >>> report = transcript(Session({}), "a = 1/2\na + Bb", OutputOptions(), NoFiles())
    >>> print(report.blocks[0].text.splitlines()[3], str(report.failure)[:14])
          ^ line 2: name B
    """
    done = list(run(session, text, options, files))
    written = "".join(f"{echo(one.statement)}{one.text}" for _, one in done)
    failed = [placed(one.error, f"line {line}") for line, one in done if one.error is not None]
    lines = [one.keys for _, one in done]
    return Report("calc", {"lines": lines}, (Code("text", written),), failure=_first(failed))


def _first(failed: list[NMatrixError]) -> NMatrixError | None:
    """Choose the error that a run ends in: the first, which counts the others."""
    if not failed:
        return None
    first, *others = failed
    what, why, next_step = (with_names(part, _spell) for part in first.parts)
    more = f"and {counted(len(others), 'other statement')} failed" if others else ""
    return type(first)(what, why, "; ".join(part for part in (next_step, more) if part))
