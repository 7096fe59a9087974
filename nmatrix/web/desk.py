"""What a page may ask the program in its browser: plain values in, and plain values out.

A `Desk` keeps the one thing that lasts between two questions, the session of the calculator, which
is a frozen value and goes in and out as text. Everything else is answered by the same functions
that the command line calls, so that a page can say nothing that a terminal would not.
"""

from __future__ import annotations

import shlex
from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass, replace
from importlib.util import find_spec
from typing import Any, Protocol

from nmatrix.calculator.language.statements import is_open, statements
from nmatrix.calculator.names import EVERY_NAME, names_of
from nmatrix.calculator.sessions.offers import offers
from nmatrix.calculator.sessions.session import NoFiles, Session, Settings
from nmatrix.enums import Format
from nmatrix.errors import IllegalValueError, NMatrixError, defect, printable
from nmatrix.lessons.check.mistake import MistakeId
from nmatrix.lessons.check.mistakes import MISTAKES
from nmatrix.lessons.check.question import Subject
from nmatrix.lessons.exercises.exercise import LETTERS, Choice, ExerciseKind
from nmatrix.lessons.exercises.scheme import SCHEME, Sheet
from nmatrix.lessons.exercises.sheet import MOST, exercise
from nmatrix.linear.values import whole
from nmatrix.output.mathml import prose
from nmatrix.output.transcript import Turn, echo, text_of, turn
from nmatrix.output.write import OutputOptions, write
from nmatrix.report import Block, Report, Table
from nmatrix.requirements import missing
from nmatrix.scene.setup import Setup
from nmatrix.spaces.shading_spaces import PROFILES
from nmatrix.version import __version__
from nmatrix.web.pipe import run_between_pipes, split_line

Answer = dict[str, Any]  # what JSON holds

LONGEST = 100_000  # characters of a question; no shell takes a longer word than 131 thousand
SESSION = "session"
REMEMBERED = 500  # lines of a session that may be shown again with their steps
# What a command imports, whatever its options are; others find out on their way.
NEEDS = {
    "derive": ("sympy",),
    "render": ("numpy",),
    "plan": ("numpy", "msgspec"),
    "cost": ("numpy",),
    "stress": ("numpy",),
    "inspect": ("msgspec",),
    "lint": ("tree_sitter", "tree_sitter_glsl", "tree_sitter_hlsl"),
    "explore": ("numpy",),
}


class Described(Protocol):
    """What the catalogue tells of a command."""

    @property
    def panel(self) -> str:
        """Where the overview lists it."""
        ...

    @property
    def sentence(self) -> str:
        """What it does."""
        ...


@dataclass(frozen=True)
class Shell:
    """The command line, as the desk is given it by the room above.

    Parameters
    ----------
    run
        Runs one command line and returns its exit code.
    witnessed
        Collects the reports that are shown meanwhile.
    commands
        The catalogue.
    """

    run: Callable[[Sequence[str]], int]
    witnessed: Callable[[], AbstractContextManager[list[Report]]]
    commands: Mapping[str, Described]


class Desk:
    r"""Answers the questions of the pages, one after the other.

    Parameters
    ----------
    shell
        The command line.

    Examples
    --------
    >>> from nmatrix.cli.web import desk
    >>> desk().say("1/3 + 1/6")["turns"][0]["text"]
    'ans  1/2\n'
    """

    def __init__(self, shell: Shell) -> None:
        self._shell = shell
        self._session = _new_session()
        self._before: dict[int, tuple[Session, str]] = {}  # what led to each numbered line
        self._turns = 0

    def answer(self, name: str, asked: Mapping[str, Any]) -> Answer:
        """Answer a question by its name; what cannot be answered is a sentence under `error`."""
        try:
            _refuse_long(asked)
            asked = _well_formed(asked)
            return {one.__name__: one for one in self._questions()}[name](**asked)
        except NMatrixError as error:
            return {"error": str(error), "code": error.exit_code}
        except Exception as error:  # the page goes on
            return {"error": defect(error), "code": NMatrixError.exit_code}

    def _questions(self) -> tuple[Callable[..., Answer], ...]:
        return (
            self.command,
            self.shown,
            self.say,
            self.again,
            self.resume,
            self.complete,
            self.exercise,
            self.key,
            self.grade,
            self.sheet,
            self.catalogue,
        )

    # --- command lines ---

    def command(self, words: str | Sequence[str], files: Mapping[str, str] | None = None) -> Answer:
        """Run a command line in an empty folder, and collect what a pipe would: every byte of it.

        Parameters
        ----------
        words
            Its words, or the line as it is typed in a shell, with or without `nmatrix`.
        files
            Files of the folder by their names; `-` is standard input.

        Returns
        -------
        dict
            The exit code, the texts of stdout and stderr, and the files that were written.
        """
        return self._told(split_line(words), files or {})[0]

    def shown(self, words: str | Sequence[str], files: Mapping[str, str] | None = None) -> Answer:
        """Run a command line, and show its answer with formulas, as a notebook does."""
        split = split_line(words)
        told, reports = self._told(split, files or {})
        return {
            "code": told["code"],
            "html": "\n".join(_html(one, full="--full" in split) for one in reports),
            "text": told["out"],
            "err": told["err"],
            "files": told["files"],
            "command": shlex.join(["nmatrix", *split]),
        }

    def _told(self, words: Sequence[str], given: Mapping[str, str]) -> tuple[Answer, list[Report]]:
        with self._shell.witnessed() as reports:
            told = run_between_pipes(self._shell.run, words, given)
        return vars(told), reports

    # --- the session of the calculator ---

    def say(
        self, text: str, files: Mapping[str, str] | None = None, *, whole: bool = False
    ) -> Answer:
        """Carry out the statements of a text in the session.

        A last statement that goes on in the next line waits, unless the text is `whole`: `more` is
        what was typed of it. `load` reads one of `files`, and what `save` writes is given back.
        """
        drawer = _Drawer(dict(files or {}))
        typed = [one for _, one in statements(text.split("\n"))]
        more = typed.pop() if typed and not whole and is_open(typed[-1]) else ""
        turns, closed = [], False
        for one in typed:
            done = turn(self._session, one, OutputOptions(), drawer)
            turns.append(self._remembered(done))
            self._session = done.session
            if done.reply.quits:
                closed = True
                break
        saved = [{"name": name, "text": one} for name, one in drawer.written.items()]
        return {"turns": turns, "more": more, "closed": closed, "files": saved, **self._state()}

    def again(self, number: int, *, steps: bool = False, format: str = "text") -> Answer:
        """Show what a statement came to once more: with its steps, or in another format."""
        if number not in self._before:
            raise IllegalValueError(
                f"line ({number})", "its session has ended", "type the statement again"
            )
        session, statement = self._before[number]
        how = replace(session.settings, steps=steps)
        done = turn(replace(session, settings=how), statement, OutputOptions(), NoFiles())
        if format == Format.TEXT or done.reply.report is None:
            return {"html": _html_of(done), "text": done.text}
        return {"html": "", "text": _as(done, Format(format))}

    def resume(self, text: str = "") -> Answer:
        """Begin the session anew, with the statements of another one."""
        self._session = _new_session()
        self._before.clear()
        for _, one in statements(text.split("\n")) if text.strip() else ():
            self._session = turn(self._session, one, OutputOptions(), NoFiles()).session
        return self._state()

    def complete(self, text: str, cursor: int) -> Answer:
        """Offer what the word before the cursor may become."""
        offer = offers(self._session.names, text[:cursor])
        return {"begun": offer.begun, "words": list(offer.words)}

    def _remembered(self, done: Turn) -> Answer:
        """Tell a turn, and number it so that it may be shown again."""
        self._turns += 1
        self._before[self._turns] = (self._session, done.statement)
        self._before.pop(self._turns - REMEMBERED, None)
        return {
            "number": self._turns,
            "statement": done.statement,
            "echo": echo(done.statement),
            "html": _html_of(done),
            "text": done.text,
            "failed": done.error is not None,
            "is_value": bool(done.reply.keys),
        }

    def _state(self) -> Answer:
        """Tell the names that have values, and the statements that `resume` takes."""
        drawer = _Drawer({})
        listed = turn(self._session, "vars", OutputOptions(), drawer).reply.report
        turn(self._session, f"save {SESSION}", OutputOptions(), drawer)
        tables = () if listed is None else listed.blocks
        rows = [row for table in tables if isinstance(table, Table) for row in table.rows]
        return {
            "names": [{"name": str(name), "value": str(value)} for name, value in rows],
            "session": drawer.written.get(SESSION, ""),
            "settings": {
                "steps": self._session.settings.steps,
                "numbers": self._session.settings.numbers.value,
                "digits": self._session.settings.digits,
            },
        }

    # --- exercises ---

    def exercise(self, number: int, seed: str = "1", student: str = "") -> Answer:
        """Ask an exercise of a student's sheet: the task, and what an answer is made of."""
        one = exercise(whole(number, "exercise"), Sheet(seed, student))
        choices = one.grader.options if isinstance(one.grader, Choice) else ()
        rows, columns = one.cells
        return {
            "number": number,
            "most": MOST,
            "title": one.title,
            "kind": one.kind.value,
            "scheme": SCHEME,
            "html": _blocks(one.task),
            "form": one.form,
            "fields": None if choices else {"rows": rows, "columns": columns},
            "choices": [
                {"letter": letter, "html": prose(option.text)}
                for letter, option in zip(LETTERS, choices, strict=False)
            ],
        }

    def key(self, number: int, seed: str = "1", student: str = "") -> Answer:
        """Tell the worked solution of an exercise, and an answer that is right."""
        one = exercise(whole(number, "exercise"), Sheet(seed, student))
        return {"html": _blocks(one.key), "right": one.right}

    def grade(
        self, number: int, answer: str | Sequence[Sequence[str]], seed: str = "1", student: str = ""
    ) -> Answer:
        """Grade an answer as `check exercise` does: a text, or the cells of its rows."""
        text = answer if isinstance(answer, str) else _in_rows(answer)
        whose = [f"--seed={seed}", *([f"--student={student}"] if student else [])]
        words = ["check", "exercise", str(whole(number, "exercise")), *whose, "--", text]
        told, reports = self._told(words, {})
        if not reports:
            raise IllegalValueError(told["err"].removeprefix("error: ").rstrip())
        (found,) = reports
        mistake = found.data["mistake"]
        rule = MISTAKES[MistakeId(str(mistake))].rule if mistake else ""
        step = "" if found.failure is None else found.failure.parts[-1]
        return {
            **{name: found.data[name] for name in ("verdict", "mistake", "also", "explanation")},
            "wrong": found.data["wrong_entries"],
            "rule": rule,
            "next": step,
            "html": _html(found),
            "text": told["out"],
            "err": told["err"],
            "command": shlex.join(["nmatrix", *words]),
        }

    # --- spaces, and all that there is ---

    def sheet(self, space: str, options: Sequence[str] = ()) -> Answer:
        """Show the sheet of a shading space."""
        return self.shown(["space", space, *options])

    def catalogue(self) -> Answer:
        """List the commands, the kinds of exercises, the spaces and the formats."""
        return {
            "version": __version__,
            "commands": [
                {
                    "name": name,
                    "panel": str(one.panel),
                    "sentence": one.sentence,
                    "why_not": _why_not(name),
                }
                for name, one in self._shell.commands.items()
            ],
            "subjects": [one.value for one in Subject],
            "kinds": [one.value for one in ExerciseKind],
            "exercises": MOST,
            "spaces": [
                {
                    "name": one.space.value,
                    "symbol": one.symbol,
                    "used": one.used,
                    "is_usual": one.is_usual,
                }
                for one in PROFILES.values()
            ],
            "formats": [one.value for one in Format],
            "mistakes": {
                one.value: {"did": told.did, "rule": told.rule} for one, told in MISTAKES.items()
            },
        }


class _Drawer:
    """The files of a session: those that the page gave, and those that were saved."""

    def __init__(self, given: dict[str, str]) -> None:
        self.given = given
        self.written: dict[str, str] = {}

    def read(self, name: str) -> str:
        """Read a file that the page gave, or that was saved just now."""
        found = {**self.given, **self.written}
        if name not in found:
            step = "open it with the page's button"
            raise IllegalValueError(f"file ({printable(name)})", "the page has not got it", step)
        return text_of(found[name].encode(), f"file ({printable(name)})")

    def write(self, name: str, text: str, *, force: bool) -> None:
        """Give a file to the page, which knows none that it could lose."""
        self.written[name] = text


def _new_session() -> Session:
    return Session(names_of(Setup(), EVERY_NAME), Settings())


def _why_not(command: str) -> str:
    """Tell why a command cannot run here; nothing where it can."""
    absent = [one for one in NEEDS.get(command, ()) if find_spec(one) is None]
    return str(missing(command, *absent)) if absent else ""


def _refuse_long(asked: Mapping[str, Any]) -> None:
    """Refuse what no page means, before anything reads it."""
    length = sum(map(_length, asked.values()))
    if length > LONGEST:
        why = f"it has {length:,} characters, {LONGEST:,} are read"
        raise IllegalValueError("what was typed", why, "give less at once")


def _length(value: object) -> int:
    """Count the characters of all texts in a value."""
    if isinstance(value, str):
        return len(value)
    if isinstance(value, Mapping):
        return sum(map(_length, (*value.keys(), *value.values())))
    return sum(map(_length, value)) if isinstance(value, Sequence) else 0


def _well_formed(value: Any) -> Any:  # noqa: ANN401  # whatever JSON holds
    """Put a sign in the place of half a character, which a browser's text may hold."""
    if isinstance(value, str):
        return value.encode("utf-16", "surrogatepass").decode("utf-16", "replace")
    if isinstance(value, Mapping):
        return {_well_formed(key): _well_formed(one) for key, one in value.items()}
    return [*map(_well_formed, value)] if isinstance(value, Sequence) else value


def _in_rows(cells: Sequence[Sequence[str]]) -> str:
    """Write cells as an answer is typed: a column on one line, rows apart by semicolons."""
    for i, row in enumerate(cells, 1):
        for j, cell in enumerate(row, 1):
            if not str(cell).strip():
                where = f"cell (row {i}, column {j})" if len(row) > 1 else f"cell ({i})"
                raise IllegalValueError(where, "it is empty", "write a number there")
    rows = [" ".join(map(_number, row)) for row in cells]
    return (" " if all(len(row) == 1 for row in cells) else "; ").join(rows)


def _number(cell: str) -> str:
    """Write one cell; it holds one number, so that a comma in it is the point of many countries."""
    return "".join(str(cell).split()).replace(",", ".")


def _html(report: Report, *, full: bool = False) -> str:
    """Write a report as HTML with MathML: its short form unless all is asked for."""
    short = None if full else report.brief
    told = report if short is None else replace(report, blocks=short.blocks)
    return write(replace(told, data={}), OutputOptions(Format.MATHML))


def _html_of(done: Turn) -> str:
    """Write what a statement came to; an error, and what was asked for in a format, are text."""
    reply = done.reply
    if reply.report is None or reply.format is not Format.TEXT:
        return ""
    return _as(done, Format.MATHML)


def _as(done: Turn, format_: Format) -> str:
    assert done.reply.report is not None  # the caller has looked
    settings = done.session.settings
    how = OutputOptions(format_, settings.digits, numbers=settings.numbers)
    told = done.reply.report
    return write(replace(told, data={}) if format_ is Format.MATHML else told, how)


def _blocks(blocks: Sequence[Block]) -> str:
    return write(Report("exercise", {}, tuple(blocks)), OutputOptions(Format.MATHML))
