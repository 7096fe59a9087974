"""What each statement does to a session: a line in, another session and a reply out.

Nothing is printed here, and files are read and written by whoever runs the session.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import assert_never

from nmatrix.calculator.arithmetic.values import Value, ValueKind
from nmatrix.calculator.language.faults import PlacedError
from nmatrix.calculator.language.statements import (
    Keyword,
    Statement,
    is_open,
    statement,
    statements,
)
from nmatrix.calculator.language.tokens import LONGEST
from nmatrix.calculator.names import other_meaning
from nmatrix.calculator.sessions.handbook import FORMATS, USAGE, page
from nmatrix.calculator.sessions.session import Files, NoFiles, Reply, Session, Settings
from nmatrix.enums import Format, InverseBy, Numbers
from nmatrix.errors import IllegalValueError, NMatrixError, counted, did_you_mean, placed
from nmatrix.report import Report, Table, Text
from nmatrix.working.working import written

MOST_DIGITS = 17
LONGEST_CELL = 40  # characters of a value that a table shows whole
# What other programs call a statement, alone in a line.
OTHER_WORDS = {
    **dict.fromkeys(("exit", "exit()", "quit()", "bye"), Keyword.QUIT),
    **dict.fromkeys(("who", "whos", "ls", "names"), Keyword.VARS),
    **dict.fromkeys(("?", "help()", "man"), Keyword.HELP),
}
WITHOUT_WORDS = (Keyword.VARS, Keyword.UNDO, Keyword.QUIT)

Outcome = tuple[Session, Reply]


def enter(session: Session, text: str, files: Files) -> Outcome:
    """Carry out one statement; whatever it holds, an error is a reply.

    Examples
    --------
    >>> from nmatrix.calculator.sessions.session import NoFiles
    >>> session, reply = enter(Session({}), "half = 1/2", NoFiles())
    >>> session.names["half"].scalar, enter(session, "half +", NoFiles())[1].error.exit_code
    (Fraction(1, 2), 2)
    """
    if len(text) > LONGEST:
        why = f"it has {len(text)} characters, {LONGEST} are read"
        return session, Reply(error=IllegalValueError("statement", why, "write it in parts"))
    asked = statement(text)
    try:
        return _carried_out(session, asked, files)
    except PlacedError as error:
        return session, Reply(error=error, at=asked.at + error.position)
    except NMatrixError as error:
        return session, Reply(error=error, at=asked.at)
    except ModuleNotFoundError as error:
        from nmatrix.requirements import missing_part

        absent = missing_part(error, "letters")
        if absent is None:
            raise
        return session, Reply(error=absent, at=asked.at)


def _carried_out(session: Session, asked: Statement, files: Files) -> Outcome:
    if asked.keyword is not None:
        return _ordered(asked.keyword, session, asked, files)
    if asked.name is not None and other_meaning(asked.name):
        return session, _taken(asked.name, asked.whole)
    if not asked.text and asked.name is None:
        return session, Reply()
    if asked.text in OTHER_WORDS and asked.text not in session.names:
        step = f"write {USAGE[OTHER_WORDS[asked.text]][0]}"
        raise IllegalValueError(asked.text, "there is no such statement", step)
    return session.valued(asked)


def _ordered(  # noqa: PLR0911 - one branch for each
    keyword: Keyword, session: Session, asked: Statement, files: Files
) -> Outcome:
    if asked.text and keyword in WITHOUT_WORDS:
        raise _refused(asked, "it stands alone")
    match keyword:
        case Keyword.HELP:
            return session, Reply(page(asked.text))
        case Keyword.SHOW:
            return session, _show(session, asked)
        case Keyword.VARS:
            return session, Reply(_vars(session))
        case Keyword.UNDO:
            return _undo(session)
        case Keyword.STEPS | Keyword.NUMBERS | Keyword.DIGITS:
            settings = _SETTINGS[keyword](session.settings, asked)
            return session.changed(asked, settings=settings), Reply()
        case Keyword.SAVE:
            return _save(session, asked, files)
        case Keyword.LOAD:
            return _load(session, asked, files)
        case Keyword.QUIT:
            return session, Reply(quits=True)
        case _:
            assert_never(keyword)


def _taken(name: str, text: str) -> Reply:
    step = f"write {name[:8]}_1 = … for instance"
    error = IllegalValueError(f"name {name[:40]}", other_meaning(name), step)
    return Reply(error=error, at=text.rindex(name, 0, text.index("=")))


def _refused(asked: Statement, why: str) -> IllegalValueError:
    """Refuse what stands behind a keyword."""
    assert asked.keyword is not None  # it is refused by one
    what = f"{asked.keyword} ({asked.text[:40]})" if asked.text else f"{asked.keyword}"
    return IllegalValueError(what, why, f"write {USAGE[asked.keyword][0]}")


def _said(text: str) -> Reply:
    return Reply(Report("calc", {}, (Text(text),)))


def _show(session: Session, asked: Statement) -> Reply:
    """Show a value again, in a format."""
    match asked.text.split():
        case [name]:
            format_ = Format.TEXT
        case [name, "as", word]:
            if word not in FORMATS:
                step = did_you_mean(word, FORMATS, f"the formats are {', '.join(FORMATS)}")
                raise IllegalValueError(f"format ({word[:40]})", "there is no such format", step)
            format_ = Format(word)
        case _:
            raise _refused(asked, "it takes a name, and perhaps a format")
    if name not in session.names:
        step = did_you_mean(name, session.names, "write vars to see the names")
        raise IllegalValueError(f"name {name[:40]}", "it has no value", step)
    return Reply(session.shown(name), format=format_)


def _vars(session: Session) -> Report:
    rows = tuple((name, _told(value)) for name, value in session.names.items())
    return Report("calc", {}, (Table(("name", "value"), rows),))


def _told(value: Value) -> str:
    """Tell a value in a line: a short one whole, of another its size, and what it means."""
    told = value.shape
    if value.kind is ValueKind.TRUTH:
        told = "yes" if value.entries else "no"
    elif value.kind is not ValueKind.MATRIX and (value.exact or value.letters):
        texts = list(map(written, value.numbers))
        whole = texts[0] if value.kind is ValueKind.SCALAR else f"( {'  '.join(texts)} )"
        told = whole if len(whole) <= LONGEST_CELL else told
    return f"{told}, {value.meaning}" if value.meaning and str(value.meaning) else told


def _undo(session: Session) -> Outcome:
    if session.before is None:
        raise IllegalValueError("undo", "nothing was changed yet", "write vars to see the names")
    gone = session.entered[len(session.before.entered) :]
    first, *more = gone[0].split("\n") if len(gone) == 1 else (counted(len(gone), "statement"),)
    back = replace(session.before, own_files=session.own_files)
    return back, _said(f"taken back: {first}{' …' if any(map(str.strip, more)) else ''}")


def _steps(settings: Settings, asked: Statement) -> Settings:
    match asked.text.split():
        case [("on" | "off") as word]:
            return replace(settings, steps=word == "on")
        case ["by", word] if word in list(InverseBy):
            return replace(settings, steps=True, by=InverseBy(word))
    raise _refused(asked, f"steps are on or off, and by {', '.join(InverseBy)} for an inverse")


def _numbers(settings: Settings, asked: Statement) -> Settings:
    if asked.text not in list(Numbers):
        raise _refused(asked, f"numbers are {', '.join(Numbers)}")
    return replace(settings, numbers=Numbers(asked.text))


def _digits(settings: Settings, asked: Statement) -> Settings:
    text = asked.text
    if text.isascii() and text.isdigit() and len(text) < 3 and 1 <= int(text) <= MOST_DIGITS:
        return replace(settings, digits=int(text))
    raise _refused(asked, f"decimals have 1 to {MOST_DIGITS} digits")


_SETTINGS: dict[Keyword, Callable[[Settings, Statement], Settings]] = {
    Keyword.STEPS: _steps,
    Keyword.NUMBERS: _numbers,
    Keyword.DIGITS: _digits,
}


def _file(asked: Statement) -> str:
    """Read the name of a file, in quotes or without."""
    text = asked.text
    name = text[1:-1] if len(text) > 2 and text[0] == text[-1] and text[0] in "\"'" else text
    if not name or not name.isprintable():
        raise _refused(asked, "it takes the name of a file")
    return name


def _save(session: Session, asked: Statement, files: Files) -> Outcome:
    """Write the statements that made the session what it is."""
    name = _file(asked)
    lines = []
    for one in map(str.rstrip, session.entered):
        lines += [one, ""] if is_open(one) else [one]  # a matrix without brackets needs an end
    files.write(name, "".join(f"{line}\n" for line in lines), force=name in session.own_files)
    told = f"{counted(len(session.entered), 'statement')} in {name}"
    return replace(session, own_files=session.own_files | {name}), _said(told)


def _load(session: Session, asked: Statement, files: Files) -> Outcome:
    """Carry out the statements of a file: all of them, or none if one fails."""
    name, loaded, count = _file(asked), session, 0
    for place, text in statements(files.read(name).split("\n")):
        loaded, reply = enter(loaded, text, NoFiles())
        if reply.error is not None:
            raise placed(reply.error, f"{name}, line {place}")
        if reply.quits:
            break
        count += bool(statement(text).text or statement(text).keyword)
    kept = replace(loaded, own_files=session.own_files | {name})
    if loaded.entered != session.entered:
        kept = replace(kept, before=session)  # so that one undo takes all of it back
    return kept, _said(f"{counted(count, 'statement')} of {name}")
