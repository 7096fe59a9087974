"""Help: examples first, then what fits on a screen, then every description for those who ask.

Help is written like an answer, in lines of styled pieces, so that it prints on every terminal.
A long page lists the options of its groups by name; `--help --full` describes them, and
`nmatrix help options` describes each group once.
"""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from typer.core import TyperArgument, TyperOption

from nmatrix.cli.catalogue import COMMANDS, Panel
from nmatrix.output.style import Line, Span, Style

if TYPE_CHECKING:
    from nmatrix.cli.command import GatheringCommand

LONGEST = 60  # lines of a page without --full
WIDTH = 80
_LEFT, _WIDEST_LEFT = 2, 30
SHORT_CHOICES = 24  # characters of a list of words that stands in place of a value

EXAMPLES = (
    "nmatrix world --scale 1 2 1",
    'nmatrix normal "1 0 0; 0 2 0; 0 0 1" --normal 1 1 0',
    "nmatrix space camera -f glsl",
)
ABOUT = "The matrices of computer graphics, exact and explained."
CONVENTIONS = "Conventions: column vectors, right-handed world, the camera looks down −z, degrees."
PROGRAM_OPTIONS: Mapping[tuple[str, ...], str] = {
    ("--help", "-h"): "Show this page; of a command: nmatrix COMMAND --help.",
    ("--version", "-V"): "Print the version.",
    ("--install-completion",): "Let TAB complete in bash, zsh or fish.",
    ("--show-completion",): "Print the script that does so.",
}
HELP_PAGES = {
    "nmatrix help COMMAND": "The same as nmatrix COMMAND --help.",
    "nmatrix help options": "The groups of options, each explained once.",
    "nmatrix help --docs": "Where the documentation is.",
}
OPTIONS_PAGE = "options"
PAGES = (OPTIONS_PAGE,)
VARIABLES = {
    "NMATRIX_FORMAT": "as --format",
    "NMATRIX_DIGITS": "as --digits",
    "NMATRIX_COLOR": "as --color",
    "NMATRIX_THEME": "as --theme",
    "NMATRIX_PYODIDE": "as --pyodide",
}
FULL_HELP = "Show this page; --help --full describes the options of the groups too."
A_DOCUMENT = "conventions.md"
SITE = "Build it; it needs the extra docs, and no network."
CHECKOUT = Path(__file__).resolve().parents[2]


def overview() -> list[Line]:
    """Write the page that the program shows before any command is chosen."""
    page = [*_examples(EXAMPLES), *_usage("COMMAND [ARGUMENTS] [OPTIONS]")]
    page += [*_wrapped(ABOUT), (), *_wrapped(CONVENTIONS)]
    page += _section("Options", {", ".join(names): one for names, one in PROGRAM_OPTIONS.items()})
    page += _section("Help", HELP_PAGES)
    for panel in Panel:
        listed = {name: one.sentence for name, one in COMMANDS.items() if one.panel is panel}
        page += _section(panel, listed)
    return page


def of_command(command: GatheringCommand, *, full: bool) -> list[Line]:
    """Write the page of a command; a long one names the options of its groups, unless `full`."""
    page = _of_command(command, described=True)
    return page if full or len(page) <= LONGEST else _of_command(command, described=False)


def _of_command(command: GatheringCommand, *, described: bool) -> list[Line]:
    options = [one for one in command.params if isinstance(one, TyperOption)]
    arguments = [one for one in command.params if isinstance(one, TyperArgument)]
    places = [f"{one.metavar}" if one.required else f"[{one.metavar}]" for one in arguments]
    page = [
        *_examples(command.examples),
        *_usage(" ".join([command.name or "", *places, "[OPTIONS]"])),
    ]
    page += [line for text in (command.help or "").split("\n\n") for line in _wrapped(text)]
    page += _section("Arguments", {str(one.metavar): description_of(one) for one in arguments})
    own = {as_typed(one): description_of(one) for one in options if one.rich_help_panel is None}
    page += _section(
        "Options", {**own, "--help, -h": "Show this page." if described else FULL_HELP}
    )
    groups = by_panel(options)
    if described:
        for panel, listed in groups.items():
            page += _section(panel, {as_typed(one): description_of(one) for one in listed})
        return page
    page += _section("Groups", {panel: _names(listed) for panel, listed in groups.items()})
    return page


def of_options(commands: Iterable[GatheringCommand]) -> list[Line]:
    """Explain the groups of options once, each with the commands that take any of it."""
    takers: dict[str, list[str]] = {}
    described: dict[str, dict[str, str]] = {}
    for command in commands:
        options = [one for one in command.params if isinstance(one, TyperOption)]
        for panel, listed in by_panel(options).items():
            takers.setdefault(panel, []).append(command.name or "")
            for one in listed:
                described.setdefault(panel, {}).setdefault(as_typed(one), description_of(one))
    page = [*_wrapped("A command takes whole groups of options; an option means the same in each.")]
    for panel, rows in described.items():
        page += _section(panel, rows, f"{panel}: {_some(takers[panel])}")
    page += _section("Environment", VARIABLES, "Environment: defaults, where no option is given")
    return page


def of_documentation() -> list[Line]:
    """Tell where the documentation is, which a packed program does not bring along."""
    if (folder := documents()) is not None:
        page = [  # a path is told whole, so that it can be copied
            *_wrapped("The documentation is here; its README.md says what is where:"),
            (Span(f"  {folder}"),),
        ]
        if (builder := folder / "website").is_dir():
            page += _section("As a site, with search", {f"python {builder} -o site": SITE})
        return page
    return [
        *_wrapped(
            "The documentation is the folder docs of an installed nmatrix and of its sources; it "
            "is not packed into this program, which explains itself:"
        ),
        *_section(
            "Help",
            {
                **HELP_PAGES,
                "nmatrix derive all": "The mathematics, each step proved.",
            },
        ),
    ]


def exit_codes() -> dict[int, str]:
    """List what a program that calls this one reads: 0, those of the errors, and two more.

    Examples
    --------
    >>> exit_codes()[0], exit_codes()[130]
    ('Done.', 'Interrupted.')
    """
    from nmatrix.cli.app import DEFECT, INTERRUPTED
    from nmatrix.errors import NMatrixError

    kinds = [
        one for one in NMatrixError.__subclasses__() if one.__module__ == NMatrixError.__module__
    ]
    refused = {one.exit_code: (one.__doc__ or "").partition("\n")[0] for one in kinds}
    return {0: "Done.", **refused, DEFECT: "A defect of nmatrix.", INTERRUPTED: "Interrupted."}


def documents() -> Path | None:
    """Find the documentation: the folder docs of a checkout, else where a wheel has put it."""
    if (CHECKOUT / "docs" / A_DOCUMENT).is_file():
        return CHECKOUT / "docs"
    from importlib.metadata import PackageNotFoundError, files

    try:
        brought = files("nmatrix") or ()
    except PackageNotFoundError:
        return None
    found = (Path(str(one.locate())) for one in brought if one.name == A_DOCUMENT)
    return next((one.resolve().parent for one in found if one.is_file()), None)


def _some(names: list[str]) -> str:
    return "every command" if len(names) == len(COMMANDS) else ", ".join(names)


def _examples(examples: Iterable[str]) -> list[Line]:
    return [*((Span(f"  {one}"),) for one in examples), ()]


def _usage(words: str) -> list[Line]:
    return [(Span("Usage:", Style.TITLE), Span(f" nmatrix {words}")), ()]


def _wrapped(text: str, indent: int = 0, width: int = WIDTH) -> list[Line]:
    pad = " " * indent
    lines = textwrap.wrap(text, width, initial_indent=pad, subsequent_indent=pad)
    return [(Span(one),) for one in lines]


def _section(name: str, rows: Mapping[str, str], title: str = "") -> list[Line]:
    """Write a heading and its rows: what is typed on the left, what it does on the right."""
    if not rows:
        return []
    page = [(), *((Span(line[0].text, Style.TITLE),) for line in _wrapped(title or name))]
    left = min(max(map(len, rows)), _WIDEST_LEFT) + 2 + _LEFT
    for typed, about in rows.items():
        lines = textwrap.wrap(about, WIDTH - left, break_on_hyphens=False) or [""]
        head = f"{'':{_LEFT}}{typed}"
        if len(head) > left - 2:
            page.append((Span(head, Style.TITLE),))
        else:
            page.append((Span(f"{head:{left}}", Style.TITLE), Span(lines.pop(0))))
        page += [(Span(f"{'':{left}}{line}"),) for line in lines]
    return page


def by_panel(options: Iterable[TyperOption]) -> dict[str, list[TyperOption]]:
    """Sort the options of a command into its groups."""
    found: dict[str, list[TyperOption]] = {}
    for one in options:
        if one.rich_help_panel is not None:
            found.setdefault(str(one.rich_help_panel), []).append(one)
    return found


def _names(options: Iterable[TyperOption]) -> str:
    return " ".join(name for one in options for name in _spellings(one))


def _spellings(one: TyperOption) -> list[str]:
    return sorted(one.opts, key=len, reverse=True)


def _choices(one: TyperArgument | TyperOption) -> list[str]:
    return [str(word) for word in getattr(one.type, "choices", ())]


def as_typed(one: TyperOption) -> str:
    """Write an option as it is typed, with the name of its value, or its words if they are few."""
    names = ", ".join(_spellings(one))
    if one.is_flag:
        return names
    words = "|".join(_choices(one))
    if words and len(words) <= SHORT_CHOICES:
        return f"{names} {words}"
    return f"{names} {one.metavar or 'WORD'}"


def description_of(one: TyperArgument | TyperOption) -> str:
    """Describe an option, with its words where they are many, and its default."""
    about = one.help or ""
    words = _choices(one)
    if len("|".join(words)) > SHORT_CHOICES and not all(word in about for word in words):
        about += f" One of {', '.join(words)}."
    default = getattr(one.default, "value", one.default)
    is_told = default in (None, False, "", ()) or callable(default) or "(" in about
    return about if is_told or one.required else f"{about} Usually {default}."
