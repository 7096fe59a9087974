"""The group: it finds a command's module on demand, and turns every error into one line."""

from __future__ import annotations

import os
import sys
import warnings
from collections.abc import Sequence
from importlib import import_module
from itertools import pairwise
from typing import TYPE_CHECKING, Annotated

import typer
from typer.core import TyperCommand, TyperGroup
from typer.exceptions import TyperException

from nmatrix.cli.catalogue import COMMANDS, Panel
from nmatrix.cli.command import (
    GatheringCommand,
    examples_and_notes,
    with_flat_options,
)
from nmatrix.cli.show import ColorWhen, fail, put
from nmatrix.errors import IllegalValueError, NMatrixError, did_you_mean
from nmatrix.version import __version__

if TYPE_CHECKING:
    from typer._click import Command, Context, HelpFormatter

DEFECT, INTERRUPTED = 70, 130


class OnDemandGroup(TyperGroup):
    """A group that imports one command's module when that command is asked for."""

    def list_commands(self, ctx: Context) -> list[str]:
        """List the names in the order of the panels."""
        return list(COMMANDS)

    def get_command(self, ctx: Context, cmd_name: str) -> Command | None:
        """Load one command, importing only its module."""
        if cmd_name not in COMMANDS:
            return None
        return _placeholder(cmd_name) if ctx.resilient_parsing else load(cmd_name)

    def parse_args(self, ctx: Context, args: list[str]) -> list[str]:
        """Refuse an unknown option before the command in our own words."""
        if not ctx.resilient_parsing:
            known = [name for one in self.get_params(ctx) for name in one.opts]
            first = args[0].partition("=")[0] if args else ""
            if first.startswith("-") and first not in (*known, "--"):
                raise IllegalValueError(
                    f"option ({first[:40]})",
                    "it is unknown before a command",
                    did_you_mean(first, known, "try nmatrix world -f json"),
                )
        return super().parse_args(ctx, args)

    def resolve_command(
        self, ctx: Context, args: list[str]
    ) -> tuple[str | None, Command | None, list[str]]:
        """Find the command, or say which one was probably meant."""
        if not ctx.resilient_parsing and args[0] not in COMMANDS:
            raise IllegalValueError(
                f"command ({args[0][:40]})",
                "there is no such command",
                did_you_mean(args[0], COMMANDS, f"the commands are {', '.join(COMMANDS)}"),
            )
        return super().resolve_command(ctx, args)

    def format_help(self, ctx: Context, formatter: HelpFormatter) -> None:
        """Write the examples, then everything else."""
        formatter.write("".join(f"  {example}\n" for example in EXAMPLES) + "\n")
        super().format_help(ctx, formatter)

    def format_commands(self, ctx: Context, formatter: HelpFormatter) -> None:
        """Write one section for each panel, from the catalogue, importing no command."""
        width = max(map(len, COMMANDS))
        for panel in Panel:
            listed = [(name, one) for name, one in COMMANDS.items() if one.panel is panel]
            with formatter.section(panel):
                formatter.write_dl([(f"{name:{width}}", one.sentence) for name, one in listed])


def _placeholder(name: str) -> TyperCommand:
    one = COMMANDS[name]
    return TyperCommand(name, help=one.sentence, rich_help_panel=one.panel)


def load(name: str) -> Command:
    """Import the module of a command and give its groups and its help to Typer."""
    one = COMMANDS[name]
    module = import_module(f"nmatrix.cli.{one.module}")
    examples, notes = examples_and_notes(module.HELP[name])
    stop = "" if one.sentence.endswith("?") else "."
    single = typer.Typer(add_completion=False, rich_markup_mode="rich")
    single.command(name, cls=GatheringCommand, help=f"{one.sentence}{stop} {notes}".rstrip())(
        with_flat_options(getattr(module, name))
    )
    command = typer.main.get_command(single)
    if isinstance(command, GatheringCommand):
        command.examples = examples
    return command


def _show_version(*, wanted: bool) -> None:
    if wanted:
        sys.stdout.write(f"nmatrix {__version__}\n")
        raise typer.Exit


# Plain help for the overview: importing rich would take longer than all the rest.
app = typer.Typer(
    cls=OnDemandGroup, no_args_is_help=True, pretty_exceptions_enable=False, rich_markup_mode=None
)

EXAMPLES = (
    "nmatrix world --scale 1 2 1",
    'nmatrix normal "1 0 0; 0 2 0; 0 0 1" --normal 1 1 0',
    "nmatrix space camera -f glsl",
)
OVERVIEW = """\
The matrices of computer graphics, exact and explained.

Conventions: column vectors, right-handed world, the camera looks down −z, degrees;
docs/conventions.md has them all.
"""


@app.callback(help=OVERVIEW)
def _overview(
    *,
    version: Annotated[
        bool,
        typer.Option(
            "--version",
            callback=lambda value: _show_version(wanted=value),
            is_eager=True,
            help="Print the version and leave.",
        ),
    ] = False,
) -> None:
    """Hold the options that stand before a command."""


def run(arguments: Sequence[str]) -> int:
    """Run one command line; if it fails, one line on stderr and an exit code."""
    when = _colours_asked_for(arguments)
    if "NMATRIX_DEBUG" not in os.environ:
        warnings.simplefilter("ignore")
    try:
        code = typer.main.get_command(app).main(
            list(arguments), prog_name="nmatrix", standalone_mode=False
        )
    except NMatrixError as error:
        from nmatrix.cli.shared_options import option_name

        return fail(error.spelled(option_name), error.exit_code, when)
    except TyperException as error:
        return _usage(error, when)
    except (KeyboardInterrupt, typer.Abort):
        return fail("interrupted", INTERRUPTED, when)
    except Exception as error:  # the last line of defence against a traceback
        if "NMATRIX_DEBUG" in os.environ:
            raise
        return fail(
            f"a defect of nmatrix ({type(error).__name__}: {error}): it should not happen; "
            "set NMATRIX_DEBUG=1 to see where",
            DEFECT,
            when,
        )
    return code if isinstance(code, int) else 0


def _colours_asked_for(arguments: Sequence[str]) -> ColorWhen:
    """Look whether colours are unwanted, in words that may be wrong elsewhere."""
    is_never = ("--color", "never") in pairwise(arguments) or "--color=never" in arguments
    return ColorWhen.NEVER if is_never else ColorWhen.AUTO


def _usage(error: TyperException, when: ColorWhen) -> int:
    """Show a refusal of the argument parser; without arguments, the help."""
    if type(error).__name__ == "NoArgsIsHelpError":
        put(f"{error.format_message()}\n")
        return error.exit_code
    message = error.format_message().rstrip(".")
    told = f"arguments: {message[:1].lower()}{message[1:]}; see --help"
    return fail(told, error.exit_code, when)
