"""What commands and option groups share: the Output panel, and how typed words are read."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from enum import StrEnum
from functools import cached_property, partial
from typing import Annotated, Any

from typer import Option

from nmatrix.cli.show import ColorWhen
from nmatrix.cli.sources import Sources
from nmatrix.enums import Convention, Format, Handedness, Layout
from nmatrix.errors import IllegalValueError
from nmatrix.output.write import MOST_DIGITS
from nmatrix.reading.angles import angle, radians_remark
from nmatrix.reading.numbers import number, numbers
from nmatrix.report import Vector

# Options of two groups, of which a command may take only one.
in_conventions = partial(Option, rich_help_panel="Conventions")
in_output = partial(Option, rich_help_panel="Output")

ReadNumbers = Callable[..., Vector]  # `numbers`, or `fractions`

ConventionOption = Annotated[
    Convention | None,
    in_conventions("--convention", help="How angles make a matrix (default: standard)."),
]
HandedOption = Annotated[
    Handedness | None,
    in_conventions("--handed", help="The camera looks down −z (right, the default) or +z (left)."),
]
SHARED = ("convention", "handed")
OUTSIDE = "Read files too that a file names outside of its own folder."


@dataclass(frozen=True)
class CommonOptions:
    """How to write the answer, and in which order matrices are read and written."""

    format: Annotated[Format, in_output("--format", "-f", help="How to write the answer.")] = (
        Format.TEXT
    )
    digits: Annotated[
        str, in_output(metavar="N", help="Significant digits for people, 1 to 17.")
    ] = "6"
    layout: Annotated[Layout, in_output(help="Order of written matrices.")] = Layout.ROW_MAJOR
    input_layout: Annotated[
        Layout | None, in_output(help="Order of matrices that are read (each notation's own).")
    ] = None
    color: Annotated[ColorWhen, in_output(help="Colours in text.")] = ColorWhen.AUTO
    full: Annotated[bool, in_output("--full", help="Show all of the answer as text.")] = False

    @cached_property
    def sources(self) -> Sources:
        """The matrices of the command line, read in their order."""
        return Sources(self.input_layout)

    @property
    def digits_checked(self) -> int:
        """The number of digits, which a float64 must have."""
        why = f"a float64 has 1 to {MOST_DIGITS} significant digits"
        return whole_number(self.digits, "--digits", range(1, MOST_DIGITS + 1), 6, why)


@dataclass(frozen=True)
class OptionGroup:
    """A group whose options are None until somebody types them."""

    @property
    def given(self) -> dict[str, Any]:
        """The typed options that only this group has, by field.

        Examples
        --------
        >>> from nmatrix.cli.world_options import WorldOptions
        >>> WorldOptions(scale="1 2 1", convention=Convention.POLIMI).given
        {'scale': '1 2 1'}
        """
        return self.typed(*(one.name for one in fields(self) if one.name not in SHARED))

    def typed(self, *names: str) -> dict[str, Any]:
        """Collect those of these options that were typed, by field."""
        return {name: getattr(self, name) for name in names if getattr(self, name) is not None}

    def degrees(
        self, sources: Sources, read: ReadNumbers = numbers, **counts: int
    ) -> dict[str, Any]:
        """Read so many angles, in degrees, of each option that was typed, by field.

        Where they look like radians, that is remarked.
        """
        found: dict[str, Any] = {}
        for name, text in self.typed(*counts).items():
            angles = read(text, counts[name], option_name(name), angle)
            found[name] = angles if counts[name] > 1 else angles[0]
            remark = radians_remark(text, name)
            if remark is not None:
                sources.remark(remark)
        return found

    def numbers(self, read: ReadNumbers = numbers, **counts: int) -> dict[str, Any]:
        """Read so many numbers of each option that was typed, by field; one is a number alone."""
        return {
            name: number(text, option_name(name))
            if counts[name] == 1
            else read(text, counts[name], option_name(name))
            for name, text in self.typed(*counts).items()
        }


def option_name(field: str) -> str:
    """Spell a field as its option.

    Examples
    --------
    >>> option_name("world_matrix")
    '--world-matrix'
    """
    return f"--{field.replace('_', '-')}"


def completed_from(words: type[StrEnum]) -> Callable[[str], list[str]]:
    """Make the completion of an option whose value is words with commas between them.

    Examples
    --------
    >>> completed_from(Layout)("row-major,c")
    ['row-major,column-major']
    """

    def complete(incomplete: str) -> list[str]:
        before, comma, word = incomplete.rpartition(",")
        return [f"{before}{comma}{one}" for one in words if one.startswith(word)]

    return complete


def whole_number(text: str, option: str, among: range, example: int, why: str = "") -> int:
    """Read a whole number of a range.

    Raises
    ------
    IllegalValueError
        If it is none, or outside; `why` says the rule where the range alone does not.

    Examples
    --------
    >>> whole_number("36", "--frames", range(1, 10_001), 2)
    36
    """
    if text.isascii() and text.isdigit() and len(text) < 9 and int(text) in among:
        return int(text)
    rule = why or f"it is a whole number from {among[0]} to {among[-1]}"
    raise IllegalValueError(f"{option} ({text[:20]})", rule, f"try {option} {example}")
