"""What commands and option groups share: the Output panel, and how typed words are read."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, fields, replace
from functools import cached_property, partial
from typing import Annotated, Any

from typer import Option

from nmatrix.cli.environment import usual, usual_number
from nmatrix.cli.show import ColorWhen
from nmatrix.cli.sources import Sources
from nmatrix.enums import AxisName, Convention, Format, Handedness, Layout, Numbers
from nmatrix.errors import IllegalValueError
from nmatrix.output.write import MOST_DIGITS
from nmatrix.reading.angles import angle, radians_remark
from nmatrix.reading.numbers import number, numbers
from nmatrix.report import Vector

# Options of two groups, of which a command may take only one.
in_conventions = partial(Option, rich_help_panel="Conventions")
in_output = partial(Option, rich_help_panel="Output")

ReadNumbers = Callable[..., Vector]  # `numbers`, or `fractions`

StepsOption = Annotated[
    bool, Option("--steps", help="Show line by line how the matrices come about.")
]
ConventionOption = Annotated[
    Convention | None,
    in_conventions("--convention", help="How angles make a matrix (default: standard)."),
]
HandedOption = Annotated[
    Handedness | None,
    in_conventions("--handed", help="The camera looks down −z (right, the default) or +z (left)."),
]
SHARED = ("convention", "handed")
USUAL_DIGITS = 6
MOST_POINTS = 100  # of an exercise
AXES = f"{', '.join(AxisName)}, or three signed axes."
OUTSIDE = "Read files too that a file names outside of its own folder."


@dataclass(frozen=True)
class CommonOptions:
    """How to write the answer, and in which order matrices are read and written."""

    typed_format: Annotated[
        Format | None, in_output("--format", "-f", help="How to write the answer (text).")
    ] = None
    json: Annotated[bool, in_output("--json", help="The same as --format json.")] = False
    digits: Annotated[
        str | None, in_output(metavar="N", help="Significant digits for people, 1 to 17 (6).")
    ] = None
    numbers: Annotated[
        Numbers | None, in_output(help="Numbers for people: 1/3 and √3/2, or 0.333333 (decimal).")
    ] = None
    layout: Annotated[Layout, in_output(help="Order of written matrices.")] = Layout.ROW_MAJOR
    input_layout: Annotated[
        Layout | None, in_output(help="Order of matrices that are read (each notation's own).")
    ] = None
    color: Annotated[ColorWhen | None, in_output(help="Colours in text (auto).")] = None
    full: Annotated[bool, in_output("--full", help="Show all of the answer as text.")] = False

    def __post_init__(self) -> None:
        if self.json and self.typed_format not in (None, Format.JSON):
            raise IllegalValueError(
                f"--json with --format {self.typed_format}",
                "they name two formats",
                "keep one of them",
            )

    @property
    def format_is_typed(self) -> bool:
        """Whether the command line says the format, and not the environment."""
        return self.json or self.typed_format is not None

    @cached_property
    def format(self) -> Format:
        """The format of the answer: typed, of the environment, or text."""
        if self.json:
            return Format.JSON
        return self.typed_format or usual("NMATRIX_FORMAT", Format) or Format.TEXT

    def as_text(self) -> CommonOptions:
        """Write text, where the format of the environment is of no use."""
        return replace(self, typed_format=Format.TEXT)

    @property
    def colour_when(self) -> ColorWhen:
        """When text has colours: typed, of the environment, or on a terminal."""
        return self.color or usual("NMATRIX_COLOR", ColorWhen) or ColorWhen.AUTO

    @cached_property
    def sources(self) -> Sources:
        """The matrices of the command line, read in their order."""
        return Sources(self.input_layout)

    @property
    def digits_checked(self) -> int:
        """The number of digits, which a float64 must have."""
        among = range(1, MOST_DIGITS + 1)
        if self.digits is None:
            return usual_number("NMATRIX_DIGITS", among) or USUAL_DIGITS
        why = f"a float64 has 1 to {MOST_DIGITS} significant digits"
        return whole_number(self.digits, "--digits", among, USUAL_DIGITS, why)


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


def among(
    known: Iterable[str] | Callable[..., Iterable[str]], *arguments: str
) -> Callable[[str], list[str]]:
    """Complete a word by those that are known; a function that knows them is asked only then.

    Examples
    --------
    >>> among(("world", "camera"))("w")
    ['world']
    """

    def complete(incomplete: str) -> list[str]:
        words = known if isinstance(known, Iterable) else known(*arguments)
        return [word for word in words if word.startswith(incomplete)]

    return complete


def option_name(field: str) -> str:
    """Spell a field as its option.

    Examples
    --------
    >>> option_name("world_matrix")
    '--world-matrix'
    """
    return f"--{field.replace('_', '-')}"


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
