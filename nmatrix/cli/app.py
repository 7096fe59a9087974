"""The program: it finds a command's module on demand, and turns every error into one line."""

from __future__ import annotations

import os
import warnings
from collections.abc import Sequence
from importlib import import_module
from itertools import pairwise
from typing import TYPE_CHECKING

import typer
from typer.exceptions import TyperException

from nmatrix.cli.catalogue import COMMANDS
from nmatrix.cli.command import (
    HELP_OPTIONS,
    GatheringCommand,
    asks_for,
    examples_and_notes,
    with_flat_options,
)
from nmatrix.cli.environment import usual
from nmatrix.cli.prompt import converse, on_terminal, usual_session
from nmatrix.cli.show import ColorWhen, fail, put, show_page
from nmatrix.errors import IllegalValueError, NMatrixError, defect, printable, refusal
from nmatrix.version import __version__

if TYPE_CHECKING:
    from nmatrix.output.style import Line

ILLEGAL, DEFECT, INTERRUPTED = 2, 70, 130


def load(name: str) -> GatheringCommand:
    """Import the module of a command and give its groups and its help to Typer."""
    one = COMMANDS[name]
    module = import_module(f"nmatrix.cli.{one.module}")
    examples, notes = examples_and_notes(module.HELP[name])
    stop = "" if one.sentence.endswith("?") else "."
    single = typer.Typer(add_completion=False, rich_markup_mode=None)
    single.command(
        name,
        cls=GatheringCommand,
        help=f"{one.sentence}{stop} {notes}".rstrip(),
        add_help_option=False,
    )(with_flat_options(getattr(module, name)))
    command = typer.main.get_command(single)
    assert isinstance(command, GatheringCommand)  # that class was asked for
    command.examples = examples
    return command


def run(arguments: Sequence[str]) -> int:
    """Run one command line; if it fails, one line on stderr and an exit code."""
    when = _colours_asked_for(arguments)
    if "NMATRIX_DEBUG" not in os.environ:
        warnings.simplefilter("ignore")
    try:
        return _run(list(arguments), when)
    except NMatrixError as error:
        from nmatrix.cli.shared_options import option_name

        told, next_step = error.spelled(option_name), error.parts[-1]
        if "nmatrix " in next_step and told.endswith(next_step):
            from nmatrix.cli.next_steps import with_own_words

            told = told.removesuffix(next_step) + with_own_words(next_step, arguments)
        return fail(told, error.exit_code, when)
    except TyperException as error:
        return _usage(error, when)
    except OSError as error:
        if "NMATRIX_DEBUG" in os.environ:
            raise
        return fail(_told(error), ILLEGAL, when)
    except (KeyboardInterrupt, typer.Abort):
        return fail("interrupted", INTERRUPTED, when)
    except Exception as error:  # the last line of defence against a traceback
        if "NMATRIX_DEBUG" in os.environ:
            raise
        return _unforeseen(error, arguments, when)


def _unforeseen(error: Exception, arguments: Sequence[str], when: ColorWhen) -> int:
    """Tell of a package that is not installed, or of a defect."""
    from nmatrix.requirements import missing_part

    absent = missing_part(error, next(iter(arguments), "nmatrix"))
    if absent is not None:
        return fail(str(absent), absent.exit_code, when)
    return fail(f"{defect(error)}; set NMATRIX_DEBUG=1 to see where", DEFECT, when)


def _run(words: list[str], when: ColorWhen) -> int:
    """Answer what stands before a command, or run the command."""
    if not words:
        from nmatrix.cli import help as pages

        show_page(pages.overview(), when)
        return ILLEGAL
    first, *others = words
    if first == "help":
        show_page(_page_of_help(others), when)
    elif first.startswith("-"):
        _answer_for_the_program(first, others, when)
    elif words == ["calc"] and on_terminal():
        converse(usual_session)
    else:
        command = load(_known(first))
        if asks_for(HELP_OPTIONS, others):
            from nmatrix.cli import help as pages

            show_page(pages.of_command(command, full=asks_for(("--full",), others)), when)
            return 0
        code = command.main(others, prog_name=f"nmatrix {first}", standalone_mode=False)
        return code if isinstance(code, int) else 0
    return 0


def _known(name: str) -> str:
    """Check that a command is one."""
    if name in COMMANDS:
        return name
    from nmatrix.cli.meanings import command_for

    raise IllegalValueError(
        f"command ({printable(name[:40])})", "there is no such command", command_for(name)
    )


def _page_of_help(words: list[str]) -> list[Line]:
    """Choose the page that `nmatrix help` is asked for."""
    from nmatrix.cli import help as pages

    if "--docs" in words:
        return pages.of_documentation()
    names = [word for word in words if not word.startswith("-")]
    if not names:
        return pages.overview()
    if names[0] == pages.OPTIONS_PAGE:
        return pages.of_options(map(load, COMMANDS))
    return pages.of_command(load(_known(names[0])), full="--full" in words)


def _answer_for_the_program(option: str, others: list[str], when: ColorWhen) -> None:
    """Answer an option that stands before any command."""
    from nmatrix.cli.shells import SHELLS, install, shell_named

    match option:
        case "--help" | "-h":
            show_page(_page_of_help(others), when)
        case "--version" | "-V":
            put(f"nmatrix {__version__}\n")
        case "--install-completion":
            put(f"{install(shell_named(next(iter(others), None)))}\n")
        case "--show-completion":
            put(SHELLS[shell_named(next(iter(others), None))].script)
        case "--":
            raise IllegalValueError("arguments", "no command stands there", "see --help")
        case _:
            from nmatrix.cli.meanings import program_option_for

            name = option.partition("=")[0]
            raise IllegalValueError(
                f"option ({printable(name[:40])})",
                "it is unknown before a command",
                program_option_for(name),
            )


def _colours_asked_for(arguments: Sequence[str]) -> ColorWhen:
    """Look whether colours are unwanted, in words that may be wrong elsewhere."""
    for one in ColorWhen:
        if ("--color", one) in pairwise(arguments) or f"--color={one}" in arguments:
            return one
    return usual("NMATRIX_COLOR", ColorWhen) or ColorWhen.AUTO


def _usage(error: TyperException, when: ColorWhen) -> int:
    """Show a refusal of the argument parser."""
    message = error.format_message().rstrip(".")
    told = f"arguments: {message[:1].lower()}{message[1:]}; see --help"
    return fail(told, error.exit_code, when)


def _told(error: OSError) -> str:
    """Tell what the file system refused."""
    name = "a file" if error.filename is None else f"file ({printable(str(error.filename))})"
    return f"{name}: {refusal(error)}; check the path and its permissions"
