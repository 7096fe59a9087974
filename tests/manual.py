"""The manual page, `docs/nmatrix.1`: the words of every help page, as `man` shows them.

`python tests/manual.py` writes it anew, with the day on which its words changed; a test compares.
"""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterable, Mapping
from datetime import UTC, datetime
from pathlib import Path

from typer.core import TyperArgument, TyperOption

from nmatrix.cli import help as pages
from nmatrix.cli.app import load
from nmatrix.cli.catalogue import COMMANDS, Panel
from nmatrix.samples import samples
from nmatrix.version import __version__

PAGE = Path(__file__).resolve().parents[1] / "docs" / "nmatrix.1"
WIDTH = 78
EXAMPLE = 67  # characters of a command line that is not broken
WHOLE_WORDS = {"break_on_hyphens": False, "break_long_words": False}
SPECIAL = {
    "\\": r"\e",
    "-": r"\-",
    "'": r"\(aq",
    '"': r"\(dq",
    "`": r"\(ga",
    "^": r"\(ha",
    "~": r"\(ti",
}
VARIABLES = {
    "COLUMNS": "How wide text may be, 40 to 1000; usually as the terminal, 80 at most.",
    "NO_COLOR": "Text without colours, unless --color always or FORCE_COLOR wants them.",
    "FORCE_COLOR": "Colours in text, wherever it goes.",
    "NMATRIX_COMPILED": "In Python, batches run in the loop that Numba compiles.",
    "NMATRIX_DEBUG": "A defect shows where it happened.",
}
NUMBERS = """\
A number is decimal (0.5, 1e-3) or a fraction (1/3); a matrix is its rows, with semicolons between
them ("1 0 0; 0 2 0; 0 0 1"), what another program printed, or the name of a file; - is standard
input. An option is known by its whole name alone."""
FILES = {
    "~/.local/state/nmatrix/history": "What was typed into nmatrix calc.",
    " ".join(samples(".obj", ".toml", ".csv", ".vert", ".frag")): (
        "Samples, found by name wherever no file has that name."
    ),
}


def manual(day: str) -> str:
    """Write the page as it is on a day."""
    lines = [f'.TH NMATRIX 1 {day} "nmatrix {__version__}" "User Commands"']
    lines += [".nh", ".ad l"]  # an option must not be broken, nor stretched
    lines += [".SH NAME", f"nmatrix \\- {plain(pages.ABOUT[:1].lower() + pages.ABOUT[1:-1])}"]
    lines += [".SH SYNOPSIS", ".B nmatrix", r"\fICOMMAND\fR [\fIARGUMENTS\fR] [\fIOPTIONS\fR]"]
    lines += [".SH DESCRIPTION", *prose(NUMBERS), ".PP", *prose(pages.CONVENTIONS)]
    lines += [".SH OPTIONS", *table({", ".join(k): v for k, v in pages.PROGRAM_OPTIONS.items()})]
    lines += table(pages.HELP_PAGES)
    takers: dict[str, list[str]] = {}
    groups: dict[str, dict[str, str]] = {}
    for panel in Panel:
        lines += [f".SH COMMANDS: {panel.upper()}"]
        for name in (name for name, one in COMMANDS.items() if one.panel is panel):
            lines += of_command(name, takers, groups)
    lines += [".SH GROUPS OF OPTIONS", *prose("An option means the same in every command.")]
    for panel, rows in groups.items():
        lines += [f".SS {plain(panel)}", *prose(", ".join(takers[panel])), *table(rows)]
    lines += [".SH ENVIRONMENT", *table({**pages.VARIABLES, **VARIABLES})]
    lines += [".SH FILES", *table(FILES)]
    lines += [".SH EXIT STATUS", *table({str(code): one for code, one in pages.exit_codes().items()})]
    lines += [".SH EXAMPLES", *examples(pages.EXAMPLES)]
    lines += [".SH SEE ALSO", *prose("nmatrix help --docs")]
    return "\n".join([*lines, ""])


def of_command(
    name: str, takers: dict[str, list[str]], groups: dict[str, dict[str, str]]
) -> list[str]:
    """Write the section of a command, and note its groups."""
    command = load(name)
    options = [one for one in command.params if isinstance(one, TyperOption)]
    arguments = [one for one in command.params if isinstance(one, TyperArgument)]
    places = [f"{one.metavar}" if one.required else f"[{one.metavar}]" for one in arguments]
    lines = [f".SS {plain(' '.join(['nmatrix', name, *places, '[OPTIONS]']))}"]
    for number, text in enumerate((command.help or "").split("\n\n")):
        lines += [*([".PP"] if number else []), *prose(text)]
    lines += table({str(one.metavar): pages.description_of(one) for one in arguments})
    own = [one for one in options if one.rich_help_panel is None]
    lines += table({pages.as_typed(one): pages.description_of(one) for one in own})
    by_panel = pages.by_panel(options)
    for panel, listed in by_panel.items():
        takers.setdefault(panel, []).append(name)
        for one in listed:
            rows = groups.setdefault(panel, {})
            rows.setdefault(pages.as_typed(one), pages.description_of(one))
    if by_panel:
        names = (
            f"{panel} ({' '.join(max(one.opts, key=len) for one in listed)})"
            for panel, listed in by_panel.items()
        )
        lines += [".PP", *prose(f"Groups: {', '.join(names)}.")]
    return [*lines, ".PP", *examples(command.examples)]


def table(rows: Mapping[str, str]) -> list[str]:
    """Write what is typed, and below each what it does."""
    return [
        line
        for typed, about in rows.items()
        for line in (".TP", rf"\fB{plain(typed)}\fR", *prose(about))
    ]


def examples(written: Iterable[str]) -> list[str]:
    """Write command lines as they are typed, long ones as a shell lets them go on."""
    lines = (
        textwrap.wrap(one, EXAMPLE, subsequent_indent="    ", **WHOLE_WORDS) for one in written
    )
    typed = " \\\n".join
    return [".RS 4", ".nf", *(plain(typed(one)) for one in lines), ".fi", ".RE"]


def prose(text: str) -> list[str]:
    """Write sentences, each from the start of a line, as the format wants them."""
    sentences = re.split(r"(?<=[.:?]) (?=[A-Z])", " ".join(text.split()))
    wrapped = (textwrap.wrap(plain(one), WIDTH, **WHOLE_WORDS) for one in sentences)
    return [plain_start(line) for lines in wrapped for line in lines]


def plain(text: str) -> str:
    """Write a text so that no character of it is an order, in ASCII."""
    spelled = "".join(
        SPECIAL.get(one, one if one.isascii() else f"\\[u{ord(one):04X}]") for one in text
    )
    return plain_start(spelled)


def plain_start(line: str) -> str:
    """Keep a line that begins with a point from being an order."""
    return rf"\&{line}" if line.startswith(".") else line


def day_of(page: str) -> str:
    """Read the day of a page."""
    return page.split(maxsplit=4)[3]


if __name__ == "__main__":
    before = PAGE.read_text("ascii") if PAGE.exists() else ".TH NMATRIX 1 never"
    if before != manual(day_of(before)):
        PAGE.write_text(manual(f"{datetime.now(UTC):%Y-%m-%d}"), "ascii")
