"""`nmatrix calc`: an expression, or a session from a file, a pipe or a terminal."""

from __future__ import annotations

from collections.abc import Iterable
from enum import StrEnum
from typing import TYPE_CHECKING, Annotated

from typer import Argument, Option

from nmatrix.cli.camera_options import LensOptions, ViewOptions
from nmatrix.cli.command import EXPRESSION
from nmatrix.cli.prompt import converse, on_terminal
from nmatrix.cli.scene_options import OptionGroups, SceneOptions
from nmatrix.cli.shared_options import CommonOptions
from nmatrix.cli.show import options_of, put, show
from nmatrix.cli.world_options import WorldOptions
from nmatrix.enums import Format, InverseBy, Numbers
from nmatrix.errors import IllegalValueError, printable
from nmatrix.report import Code, Report

if TYPE_CHECKING:
    from nmatrix.calculator.values import Value

ENDINGS = (".txt", ".calc", ".nmatrix", ".md")  # of files, and of no expression


class Source(StrEnum):
    """What `nmatrix calc` is given."""

    EXPRESSION = "expression"
    STATEMENTS = "statements"
    TERMINAL = "terminal"


HELP = {
    "calc": r"""nmatrix calc "inverse_transpose(linear(M))" --scale 1 2 1

nmatrix calc "P @ V @ M @ point(\[1, 1, 1])" --steps

nmatrix calc "det(A) * inverse(A)" --let "A=2 1; 1 1"

Over M, V, P, literals and --let names. Alone it is a session, where help tells more; a file of
statements, or - for stdin, runs with the same answers.""",
}


def calc(
    *,
    world: WorldOptions,
    view: ViewOptions,
    lens: LensOptions,
    scene: SceneOptions,
    common: CommonOptions,
    expression: Annotated[
        str | None,
        Argument(
            metavar=EXPRESSION,
            help="What to compute, a file of statements, or - for stdin.",
            show_default=False,
        ),
    ] = None,
    let: Annotated[
        list[str] | None,
        Option("--let", metavar="NAME=MATRIX", help="Name a matrix; repeat for more."),
    ] = None,
    steps: Annotated[bool, Option("--steps", help="Show every operation.")] = False,
    by: Annotated[
        InverseBy | None, Option("--by", help="Work inverses out in this way (with --steps).")
    ] = None,
    float64: Annotated[
        bool, Option("--float", help="Round every product and sum to float64.")
    ] = False,
    untyped: Annotated[
        bool, Option("--untyped", help="Forget spaces: any map goes anywhere.")
    ] = False,
) -> None:
    """Show the value of an expression, or run a session."""
    from nmatrix.calculator.answer import report
    from nmatrix.calculator.names import EVERY_NAME
    from nmatrix.calculator.session import Session, Settings
    from nmatrix.calculator.values import Arithmetic
    from nmatrix.output.transcript import Disk, is_session, transcript

    source, text = _source(expression, common)
    settings = Settings(
        steps=steps or by is not None,
        by=by,
        numbers=common.numbers or Numbers.EXACT,
        digits=common.digits_checked,
        arithmetic=Arithmetic.FLOAT if float64 else Arithmetic.EXACT,
        untyped=untyped,
        layout=common.input_layout,
    )
    is_single = source is Source.EXPRESSION and not is_session(text)
    used = text if is_single else EVERY_NAME
    names = _names(OptionGroups(world, view, lens, scene=scene), let or (), used, common)
    session = Session(names, settings)
    if source is Source.TERMINAL:
        _tell(common)
        converse(lambda: (session, lambda: options_of(common)))
    elif is_single:
        show(
            report(session.calculation(text), with_steps=settings.steps, inverse_by=settings.by),
            common,
        )
    else:
        _show_run(transcript(session, text, options_of(common), Disk()), common)


def _show_run(run: Report, common: CommonOptions) -> None:
    """Show a transcript as it is, with its colours, or what it holds in another format."""
    if common.format is not Format.TEXT:
        show(run, common)
        return
    put("".join(block.text for block in run.blocks if isinstance(block, Code)))
    _tell(common)
    if run.failure is not None:
        raise run.failure


def _tell(common: CommonOptions) -> None:
    """Tell what was remarked on the options."""
    remarks = (*common.sources.about, *common.sources.remarks)
    if remarks:
        show(Report("calc", {}, ()), common)


def _source(expression: str | None, common: CommonOptions) -> tuple[Source, str]:
    """Find out what is asked; the name of a file of statements holds a point."""
    from nmatrix.output.transcript import text_of
    from nmatrix.reading.files import existing_file, file_bytes

    if expression is None and on_terminal():
        if common.format_is_typed and common.format is not Format.TEXT:
            raise IllegalValueError(
                f"--format {common.format}",
                "a session on a terminal is text",
                f"write show M as {common.format} there",
            )
        return Source.TERMINAL, ""
    if expression is None or expression == "-":
        content = common.sources.standard_input("cut it down")
        return Source.STATEMENTS, text_of(content, "standard input")
    path = existing_file(expression) if "." in expression else None
    if path is not None:
        return Source.STATEMENTS, text_of(file_bytes(path), f"file ({printable(expression)})")
    if expression.endswith(ENDINGS) and expression.isprintable():
        raise IllegalValueError(
            f"file ({printable(expression)})", "there is no such file", "check the path"
        )
    return Source.EXPRESSION, expression


def _names(
    groups: OptionGroups, definitions: Iterable[str], text: str, common: CommonOptions
) -> dict[str, Value]:
    """Name M, of V and P what the text may ask for, and the matrices of --let."""
    from nmatrix.calculator.names import names_of, with_name

    setup = groups.setup(common, is_of_node=False)
    piped = (groups.world.world_matrix or "").partition("#")[0] == "-"  # stdin is read once
    names = names_of(setup, text, None if piped else groups.typed_world(common, setup))
    for definition in definitions:
        name, equals, matrix = definition.partition("=")
        if not equals:
            raise IllegalValueError(
                f"--let ({definition[:40]})", "it is NAME=MATRIX", 'try --let "A=1 0; 0 2"'
            )
        names = with_name(names, name.strip(), common.sources.literal(matrix.strip()).rows_exact)
    return names
